/// What holds for every law of the table, seen in a contact of two spheres that goes through the
/// pass as in the engine: a law that breaks one of these is wrong whatever its equation.
#include "core/contact/contact_table.hpp"
#include "core/kernels/kernels.hpp"
#include "core/state/aligned.hpp"

#include "tests/unit/core/all_laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace grainbench {
namespace {

constexpr std::uint64_t seed = 20260301;

Contact hertzian(double young) {
    Contact contact;
    contact.stiffness = HertzStiffness::Params{.young_modulus = young, .poisson_ratio = 0.3};
    contact.normal = HertzSpring::Params{};
    return contact;
}

Contact linear() {
    Contact contact;
    contact.stiffness = ConstantStiffness::Params{.normal = 1e5, .shear = 4e4};
    contact.normal = LinearSpring::Params{};
    return contact;
}

Contact rough() {
    Contact contact = linear();
    contact.friction = CoulombFriction::Params{0.4};
    return contact;
}

/// The smallest set of laws in which one acts. A law without one does not compile.
template <class Law>
Contact contact_with();

template <>
Contact contact_with<ConstantStiffness>() {
    return linear();
}

template <>
Contact contact_with<DeformabilityStiffness>() {
    Contact contact = rough();
    contact.stiffness = DeformabilityStiffness::Params{.modulus = 1e7, .ratio = 2.0};
    return contact;
}

template <>
Contact contact_with<HertzStiffness>() {
    return hertzian(1e8);
}

template <>
Contact contact_with<LinearSpring>() {
    return linear();
}

template <>
Contact contact_with<IncrementalSpring>() {
    Contact contact = linear();
    contact.normal = IncrementalSpring::Params{};
    return contact;
}

template <>
Contact contact_with<HertzSpring>() {
    return hertzian(1e8);
}

template <>
Contact contact_with<JkrAdhesion>() {
    Contact contact = hertzian(1e7);
    contact.normal = JkrAdhesion::Params{1.0};
    contact.friction = MindlinFriction::Params{0.4};
    return contact;
}

template <>
Contact contact_with<WaltonBraunSpring>() {
    Contact contact = rough();
    contact.normal = WaltonBraunSpring::Params{0.6};
    return contact;
}

template <>
Contact contact_with<CoulombFriction>() {
    return rough();
}

template <>
Contact contact_with<MindlinFriction>() {
    Contact contact = hertzian(1e8);
    contact.friction = MindlinFriction::Params{0.4};
    return contact;
}

template <>
Contact contact_with<ViscousDamping>() {
    Contact contact = rough();
    contact.damping = ViscousDamping::Params{.normal = 0.2, .shear = 0.2, .mode = 3};
    return contact;
}

template <>
Contact contact_with<RestitutionDamping>() {
    Contact contact = contact_with<MindlinFriction>();
    contact.damping = RestitutionDamping::Params{0.6, true};
    return contact;
}

template <>
Contact contact_with<LinearCohesion>() {
    Contact contact = rough();
    contact.cohesion = LinearCohesion::Params{0.1, 1e-6};
    return contact;
}

template <>
Contact contact_with<RollingResistance>() {
    Contact contact = contact_with<MindlinFriction>();
    contact.rolling = RollingResistance::Params{0.1, 0.7};
    return contact;
}

template <>
Contact contact_with<TwistingResistance>() {
    Contact contact = contact_with<MindlinFriction>();
    contact.twisting = TwistingResistance::Params{0.1, 0.7};
    return contact;
}

/// One body at the end of a step, with its velocities during the step.
struct Body {
    Vec3 position{}, velocity{}, spin{};
};

struct Loads {
    Vec3 force_i{}, force_j{}, torque_i{}, torque_j{};
};

constexpr double radius_i = 0.003;
constexpr double radius_j = 0.005;
constexpr double timestep = 1e-6;

/// Two spheres and the history of their contact.
class Probe {
public:
    explicit Probe(const Contact& contact) : table_(contact, Materials(scene())) {
        position_.assign(4 * std::size_t{8}, 0.0);
        velocity_.assign(4 * std::size_t{8}, 0.0);
        spin_.assign(4 * std::size_t{8}, 0.0);
        loads_.assign(load_row * std::size_t{8}, 0.0);
        loaded_.assign(8, 0);
        rows_.assign(4 * std::size_t{history_packets(table_.history_size()) + 1}, 0.0);
    }

    double reach() const { return table_.reach(); }

    /// As the engine does it: what is out of reach has no force and forgets.
    Loads step(const Body& i, const Body& j) {
        const double gap = norm(j.position - i.position) - radius_i - radius_j;
        if (gap > reach()) {
            std::fill(rows_.begin(), rows_.end(), 0.0);
            acts_ = false;
            return {};
        }
        put(0, i, radius_i);
        put(1, j, radius_j);
        const Index first = 0;
        const Index second = 1;
        const TouchingContact touching(0, !acts_);
        acts_ = true;
        kernels_for("scalar").pair_pass({.particles = {position_.data(),
                                                       velocity_.data(),
                                                       spin_.data(),
                                                       loads_.data(),
                                                       loaded_.data(),
                                                       2,
                                                       8},
                                         .laws = table_.view(timestep),
                                         .i = &first,
                                         .j = &second,
                                         .touching = &touching,
                                         .touching_count = 1,
                                         .marks_loaded = true,
                                         .rows = rows_.data(),
                                         .records = nullptr,
                                         .stored = nullptr});
        return {vector(0, force_packet),
                vector(1, force_packet),
                vector(0, torque_packet),
                vector(1, torque_packet)};
    }

private:
    static Scene scene() {
        Scene scene;
        scene.particles.species = {{"small", radius_i, 1500.0}, {"large", radius_j, 1500.0}};
        return scene;
    }

    Vec3 vector(std::size_t row, LoadPacket which) const {
        const double* packet = &loads_[load_row * row + which];
        return {packet[0], packet[1], packet[2]};
    }

    void put(std::size_t row, const Body& body, double radius) {
        const auto set = [](double* packet, const Vec3& v, double w) {
            packet[0] = v.x;
            packet[1] = v.y;
            packet[2] = v.z;
            packet[3] = w;
        };
        const double mass = 4.0 / 3.0 * pi * radius * radius * radius * 1500.0;
        set(&position_[4 * row], body.position, radius);
        set(&velocity_[4 * row], body.velocity, 1.0 / mass);
        set(&spin_[4 * row], body.spin, static_cast<double>(row));
        set(&loads_[load_row * row + force_packet], {}, 0.0);
        set(&loads_[load_row * row + torque_packet], {}, 1.0 / (0.4 * mass * radius * radius));
    }

    ContactTable table_;
    Column<double> position_, velocity_, spin_, loads_, rows_;
    Column<std::uint8_t> loaded_;
    bool acts_ = false;
};

/// A smooth path of two spheres that begins and ends out of reach, with a slide, a roll and a twist
/// that all end where they began. On even paths these are so large that contacts slip, on odd ones
/// so small that they stick but for their first and last moments.
class Path {
public:
    Path(std::uint64_t number, double reach) : reach_(reach), size_(number % 2 == 0 ? 1.0 : 0.01) {
        std::mt19937_64 random(seed + number);
        const auto draw = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        depth_ = draw(5e-6, 2e-5);
        for (Wave* wave : {&slide_x_, &slide_y_, &roll_i_, &roll_j_, &twist_}) {
            *wave = {draw(-1.0, 1.0), draw(0.0, 2.0 * pi), std::floor(draw(1.0, 4.0))};
        }
        swell_ = {draw(0.0, 0.4), draw(0.0, 2.0 * pi), 2.0};
    }

    /// Body states at the end of step k of n.
    std::pair<Body, Body> at(int k, int n) const {
        const State now = state(static_cast<double>(k) / n);
        const State before = state(static_cast<double>(k - 1) / n);
        Body i;
        i.spin = (1.0 / timestep) * (now.turn_i - before.turn_i);
        Body j{.position = now.position};
        j.velocity = (1.0 / timestep) * (now.position - before.position);
        j.spin = (1.0 / timestep) * (now.turn_j - before.turn_j);
        return {i, j};
    }

private:
    struct Wave {
        double size, phase, number;

        /// Zero at both ends of the path.
        double at(double t) const {
            return size * (std::sin(2.0 * pi * number * t + phase) - std::sin(phase));
        }
    };

    struct State {
        Vec3 position, turn_i, turn_j;
    };

    State state(double t) const {
        const double swell = 1.0 + swell_.at(t);
        const double overlap =
            (depth_ + 2.0 * reach_) * std::pow(std::sin(pi * t), 2) * swell - 1.5 * reach_ - 1e-8;
        const double slide = 2e-5 * size_;
        const double distance = radius_i + radius_j - overlap;
        const Vec3 direction = normalized(
            Vec3{slide / radius_j * slide_x_.at(t), slide / radius_j * slide_y_.at(t), 1.0});
        const double turn = 5e-3 * size_;
        return {distance * direction,
                turn * Vec3{roll_i_.at(t), roll_j_.at(t), 0.0},
                turn * Vec3{roll_j_.at(t), -roll_i_.at(t), 2.0 * twist_.at(t)}};
    }

    double reach_, size_, depth_ = 0.0;
    Wave slide_x_{}, slide_y_{}, roll_i_{}, roll_j_{}, twist_{}, swell_{};
};

/// Rows of a rotation matrix.
using Rotation = std::array<Vec3, 3>;

Vec3 turned(const Rotation& q, const Vec3& v) {
    return {dot(q[0], v), dot(q[1], v), dot(q[2], v)};
}

template <class Law>
class LawRules : public testing::Test {
protected:
    static constexpr int paths = 12;
    static constexpr int steps = 1000;

    /// Calls check(loads, other loads, largest force so far) along several paths, the second pair
    /// of bodies being changed by `change`.
    template <class Change, class Check>
    static void compare(const Change& change, const Check& check) {
        for (std::uint64_t path = 0; path < paths; ++path) {
            Probe probe(contact_with<Law>());
            Probe other(contact_with<Law>());
            const Path way(path, probe.reach());
            double largest = 0.0;
            for (int k = 1; k <= steps; ++k) {
                auto [i, j] = way.at(k, steps);
                const Loads loads = probe.step(i, j);
                change(i);
                change(j);
                largest = std::max(largest, norm(loads.force_j));
                check(loads, other.step(i, j), largest);
            }
            EXPECT_GT(largest, 0.0);
        }
    }
};

TYPED_TEST_SUITE(LawRules, AllLaws);

TYPED_TEST(LawRules, ActionEqualsReaction) {
    for (std::uint64_t path = 0; path < TestFixture::paths; ++path) {
        Probe probe(contact_with<TypeParam>());
        const Path way(path, probe.reach());
        for (int k = 1; k <= TestFixture::steps; ++k) {
            const auto [i, j] = way.at(k, TestFixture::steps);
            const Loads loads = probe.step(i, j);
            EXPECT_EQ(loads.force_i, -loads.force_j);
            // Angular momentum: a handful of roundings of forces times a distance of 8 mm.
            const Vec3 turning =
                loads.torque_i + loads.torque_j + cross(j.position - i.position, loads.force_j);
            EXPECT_LE(norm(turning), 1e-17 * (1.0 + 10.0 * norm(loads.force_j)));
        }
    }
}

TYPED_TEST(LawRules, IsTheSameInAFrameThatMoves) {
    const Vec3 frame{3.0, -2.0, 1.0};
    // Velocities of some m/s keep 1e-16 of that; an incremental law multiplies it with k dt = 0.1
    // kg/s and sums a thousand of them, a dashpot with some kg/s once.
    TestFixture::compare([&](Body& body) { body.velocity += frame; },
                         [](const Loads& a, const Loads& b, double largest) {
                             const double rounding = 1e-12 + 1e-12 * largest;
                             EXPECT_LE(norm(a.force_j - b.force_j), rounding);
                             EXPECT_LE(norm(a.torque_j - b.torque_j), rounding);
                         });
}

TYPED_TEST(LawRules, IsTheSameInATurnedFrame) {
    const Vec3 first = normalized(Vec3{1.0, 2.0, -0.5});
    const Vec3 second = normalized(cross(first, Vec3{0.3, -1.0, 2.0}));
    const Rotation q{first, second, cross(first, second)};
    // An overlap of 1e-5 m between distances of 8e-3 m keeps 1e-13 of itself.
    TestFixture::compare(
        [&](Body& body) {
            body = {turned(q, body.position), turned(q, body.velocity), turned(q, body.spin)};
        },
        [&](const Loads& a, const Loads& b, double largest) {
            const double rounding = 1e-12 + 1e-10 * largest;
            EXPECT_LE(norm(turned(q, a.force_j) - b.force_j), rounding);
            EXPECT_LE(norm(turned(q, a.torque_j) - b.torque_j), rounding);
        });
}

TYPED_TEST(LawRules, GivesNoEnergyOverAClosedPath) {
    for (std::uint64_t path = 0; path < TestFixture::paths; ++path) {
        Probe probe(contact_with<TypeParam>());
        const Path way(path, probe.reach());
        constexpr int fine = 8000;
        double work = 0.0;
        double exchanged = 0.0;
        Loads before;
        for (int k = 1; k <= fine; ++k) {
            const auto [i, j] = way.at(k, fine);
            const Loads now = probe.step(i, j);
            // Of the bodies on the contact, by the mean of the loads at both ends of the step.
            const double part = -0.5 * timestep *
                                (dot(before.force_j + now.force_j, j.velocity) +
                                 dot(before.torque_i + now.torque_i, i.spin) +
                                 dot(before.torque_j + now.torque_j, j.spin));
            work += part;
            exchanged += std::abs(part);
            before = now;
        }
        // The error of the mean goes with the square of the step; Hertz's spring, whose stiffness
        // begins at zero, makes most of it, 1.2e-8 of what is exchanged.
        EXPECT_GE(work, -3e-8 * exchanged) << "path " << path;
        EXPECT_GT(exchanged, 0.0);
    }
}

TYPED_TEST(LawRules, ForgetsWhatWasBeforeItOpened) {
    Probe probe(contact_with<TypeParam>());
    const Path first(1, probe.reach());
    const Path second(2, probe.reach());
    for (int k = 1; k <= TestFixture::steps; ++k) {
        const auto [i, j] = first.at(k, TestFixture::steps);
        probe.step(i, j);
    }
    Probe fresh(contact_with<TypeParam>());
    for (int k = 1; k <= TestFixture::steps; ++k) {
        const auto [i, j] = second.at(k, TestFixture::steps);
        EXPECT_EQ(probe.step(i, j).force_j, fresh.step(i, j).force_j) << "step " << k;
    }
}

// --- what is written about it --------------------------------------------------------------------

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

TYPED_TEST(LawRules, HasAParagraphAndAPreset) {
    const std::filesystem::path source(GRAINBENCH_SOURCE_DIR);
    const std::string key(TypeParam::Params::key);
    EXPECT_NE(text_of(source / "share/doc/laws.md").find("### `" + key + "`"), std::string::npos)
        << "share/doc/laws.md has no paragraph '### `" << key << "`'";
    bool shown = false;
    for (const auto& file : std::filesystem::directory_iterator(source / "presets/scenes")) {
        shown = shown || text_of(file).find("\"law\": \"" + key + "\"") != std::string::npos;
    }
    EXPECT_TRUE(shown) << "no scene in presets/scenes has \"law\": \"" << key << "\"";
}

}  // namespace
}  // namespace grainbench
