/// Presets with slips of the keys: each is refused with the place in the document, or it is a scene
/// that runs, if only until a guard stops it with a reason.
#include "core/measure/memory_need.hpp"
#include "core/simulation.hpp"

#include "io/json/scene_json.hpp"

#include "tests/unit/io/scene_testing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace grainbench {
namespace {

using namespace testing_support;
using Pointer = Json::json_pointer;

/// Places of a document, structures before what they hold.
void list_places(const Json& value, const Pointer& at, std::vector<Pointer>& places) {
    places.push_back(at);
    if (value.is_object()) {
        for (const auto& entry : value.items()) {
            list_places(entry.value(), at / entry.key(), places);
        }
    }
    for (std::size_t k = 0; value.is_array() && k < value.size(); ++k) {
        list_places(value[k], at / k, places);
    }
}

Json slipped(const Json& value, std::mt19937& random) {
    static const std::array factors{
        -1.0, 0.0, 1e-300, 1e-6, 1e-3, 0.5, 10.0, 1e3, 1e6, 1e18, 1e300};
    const std::array<Json, 6> others{nullptr, true, "steel", Json::array(), Json::object(), 1e-9};
    if (value.is_number() && random() % 5 != 0) {
        return value.get<double>() * factors[random() % factors.size()];
    }
    if (value.is_string() && random() % 2 == 0) {
        auto text = value.get<std::string>();
        text.insert(random() % (text.size() + 1), 1, static_cast<char>('a' + random() % 26));
        return text;
    }
    return others[random() % others.size()];
}

/// One slip at one place.
void slip(Json& document, std::mt19937& random) {
    std::vector<Pointer> places;
    list_places(document, Pointer(), places);
    if (random() % 2 == 0) {  // numbers are what people change
        std::erase_if(places, [&](const Pointer& place) {
            return !place.empty() && !document[place].is_number();
        });
    }
    const Pointer at = places[1 + random() % (places.size() - 1)];
    Json& owner = document[at.parent_pointer()];
    switch (random() % 6) {
        case 0:
            if (owner.is_object()) {
                owner.erase(at.back());
            } else {
                owner.push_back(document[at]);
            }
            break;
        case 1:
            document[at] = document[places[1 + random() % (places.size() - 1)]];
            break;
        default:
            document[at] = slipped(document[at], random);
    }
}

/// Keeps what a test can wait for: the tries of random insertion.
void shorten(Scene& scene) {
    for (Insertion& insertion : scene.particles.insertion) {
        if (auto* entry = std::get_if<RandomInsertion>(&insertion)) {
            entry->tries = std::min<std::int64_t>(entry->tries, 200);
        }
    }
}

void expect_complete(const Error& error, const std::string& text) {
    const Diagnosis& d = error.diagnosis();
    EXPECT_FALSE(d.what.empty() || d.likely_cause.empty() || d.next_step.empty()) << text;
    EXPECT_NE(d.where.find("mutant.json: /"), std::string::npos) << error.what() << "\n" << text;
}

TEST(PresetMutation, FiveHundredAreRefusedWithTheirPlaceOrRun) {
    const std::vector<std::filesystem::path> presets = preset_files();
    int refused = 0;
    int stopped = 0;
    int ran = 0;
    for (unsigned n = 0; n < 500; ++n) {
        SCOPED_TRACE("mutant " + std::to_string(n));
        std::mt19937 random(n);
        Json document =
            Json::parse(io::write_scene(io::read_scene(presets[n % presets.size()], {}), {}));
        for (unsigned k = 0; k <= n % 2; ++k) {
            slip(document, random);
        }
        const std::string text = document.dump();
        Scene scene;
        try {
            scene = io::parse_scene(text, testing::TempDir(), "mutant.json");
            shorten(scene);
            if (estimate_memory(scene).bytes > 1e8) {
                continue;
            }
        } catch (const Error& error) {
            ASSERT_EQ(error.kind(), ErrorKind::bad_input) << error.what();
            expect_complete(error, text);
            ++refused;
            continue;
        }
        try {
            Observer nobody;
            Simulation simulation(scene, 0);
            simulation.advance(20, nobody);
            for (const Vec3& position : simulation.particle_frame().position) {
                ASSERT_TRUE(is_finite(position)) << text;
            }
            ++ran;
        } catch (const Error& error) {
            const Diagnosis& d = error.diagnosis();
            EXPECT_FALSE(d.what.empty() || d.where.empty() || d.likely_cause.empty() ||
                         d.next_step.empty())
                << error.what();
            ++stopped;
        }
    }
    EXPECT_GT(refused, 200);
    EXPECT_GT(ran, 100);
    EXPECT_GT(refused + stopped + ran, 480);
    RecordProperty("refused", refused);
    RecordProperty("stopped", stopped);
    RecordProperty("ran", ran);
}

}  // namespace
}  // namespace grainbench
