/// What the effects on call must give: restitution of damped Hertz impacts and of the Walton-Braun
/// spring, pull-off of adhesive contacts, and the decay of rolling and spinning.
#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

#include <algorithm>
#include <array>

namespace grainbench::verify {

namespace {

constexpr double gravity = 9.8;

// --- restitution ---------------------------------------------------------------------------------

Contact hertz_contact(double young, std::optional<RestitutionDamping::Params> damping = {}) {
    Contact contact;
    contact.stiffness = HertzStiffness::Params{.young_modulus = young, .poisson_ratio = 0.3};
    contact.normal = HertzSpring::Params{};
    if (damping) {
        contact.damping = *damping;
    }
    return contact;
}

/// Relative speed after a head-on impact at 1 m/s over that before.
double restitution(const Contact& contact, double stretch, double ratio, double duration) {
    constexpr double steps = 2000.0;
    const double dt = duration / steps;
    Scene scene = scene_of({}, dt, stretch * duration);
    add_species(scene, "other", {ratio * small_sphere.radius, small_sphere.density});
    scene.contact = contact;
    const double r = small_sphere.radius;
    add_sphere(scene, {0.0, 0.0, r + 0.25 * dt}, {0.0, 0.0, -0.5});
    add_sphere(scene, {0.0, 0.0, -ratio * r - 0.25 * dt}, {0.0, 0.0, 0.5}, {}, "other");
    Run run(scene);
    run.finish();
    return run.ball(0).velocity.z - run.ball(1).velocity.z;
}

void check_hertz_restitution(Checks& checks) {
    constexpr double young = 1e8;
    for (const bool tension : {true, false}) {
        for (const double ratio : {1.0, 3.0, 10.0}) {
            for (const double e : {0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 1.0}) {
                const double r = small_sphere.radius;
                const double mass = small_sphere.mass() / (1.0 + 1.0 / (ratio * ratio * ratio));
                const double effective = r * ratio / (1.0 + ratio);
                const double modulus = young / (2.0 * (1.0 - 0.09));
                const double duration =
                    2.86827 * std::pow(mass * mass / (modulus * modulus * effective), 0.2);
                const Contact contact =
                    hertz_contact(young, RestitutionDamping::Params{e, tension});
                checks.add("e, asked for " + text_of(e) + ", radii 1 to " + text_of(ratio) +
                               (tension ? ", dashpot may pull" : ", dashpot may not pull"),
                           "1",
                           e,
                           restitution(contact, 4.0, ratio, duration),
                           {1e-2, "asked for"});
            }
        }
    }
}

void check_yielding_restitution(Checks& checks) {
    constexpr double stiffness = 1e5;
    for (const double e : {0.3, 0.5, 0.7, 0.9, 1.0}) {
        Contact contact;
        contact.stiffness = ConstantStiffness::Params{.normal = stiffness};
        contact.normal = WaltonBraunSpring::Params{e};
        const double duration = half_period(0.5 * small_sphere.mass(), stiffness);
        checks.add("e, asked for " + text_of(e),
                   "1",
                   e,
                   restitution(contact, 2.0, 1.0, duration),
                   {2e-3, "first order in dt, 2000 steps in an impact"});
    }
}

// --- pull-off ------------------------------------------------------------------------------------

struct PullOff {
    double tension = 0.0;  ///< [N] largest
    double gap = 0.0;      ///< [m] where it let go
    double contact = 0.0;  ///< [N] tension at no overlap
};

/// A ball too heavy to be slowed is drawn from a plane.
PullOff pull_off(const Contact& contact, double radius, double pressed, double way, double steps) {
    constexpr double speed = 0.01;
    const double dt = way / speed / steps;
    Scene scene = scene_of({}, dt, (pressed + 1.5 * way) / speed, {radius, 1e8});
    scene.contact = contact;
    add_plane(scene, "plane", {}, {0.0, 0.0, 1.0});
    add_sphere(scene, {0.0, 0.0, radius - pressed}, {0.0, 0.0, speed});
    Run run(scene);
    PullOff result;
    double before = -pressed;
    run.each_cycle([&] {
        const double gap = run.ball().position.z - radius;
        const double tension = -run.ball().force.z;
        result.tension = std::max(result.tension, tension);
        result.gap = tension > 0.0 ? gap : result.gap;
        if (before < 0.0 && gap >= 0.0) {
            result.contact = tension;
        }
        before = gap;
    });
    return result;
}

void check_jkr(Checks& checks) {
    constexpr double young = 1e7;
    constexpr double modulus = young / (2.0 * (1.0 - 0.09));
    for (const double work : {0.02, 0.1, 0.5}) {
        for (const double radius : {0.5e-3, 2e-3}) {
            Contact contact = hertz_contact(young);
            contact.normal = JkrAdhesion::Params{work};
            const double c = std::sqrt(2.0 * pi * work / modulus);
            const double unit = c * std::cbrt(radius * c);
            const PullOff got = pull_off(contact, radius, 0.5 * unit, unit, 4000.0);
            const double expected = 1.5 * pi * work * radius;
            const std::string at = ", w " + text_of(work) + " J/m^2, R " + text_of(radius) + " m";
            checks.add("pull-off force" + at,
                       "N",
                       expected,
                       got.tension,
                       relative(1e-3, expected, "largest of 4000 steps"));
            checks.add("tension without overlap" + at,
                       "N",
                       8.0 / 9.0 * expected,
                       got.contact,
                       relative(2e-3, expected, "at most one of 4000 steps late"));
            const double neck = 0.75 * std::cbrt(0.25) * unit;  // y^4 - y at y^3 = 1/4
            checks.add("length of the neck" + at,
                       "m",
                       neck,
                       got.gap,
                       relative(2e-3, neck, "one of 4000 steps"));
        }
    }
}

void check_linear_cohesion(Checks& checks) {
    constexpr double force = 1e-3;
    constexpr double reach = 1e-5;
    Contact contact;
    contact.stiffness = ConstantStiffness::Params{.normal = 1e5};
    contact.normal = LinearSpring::Params{};
    contact.cohesion = LinearCohesion::Params{force, reach};
    const PullOff got = pull_off(contact, 1e-3, 1e-8, reach, 4000.0);
    checks.add("pull-off force", "N", force, got.tension, relative(1e-3, force, "4000 steps"));
    checks.add("gap where it ends", "m", reach, got.gap, relative(1e-3, reach, "4000 steps"));

    // A ball under a ceiling stays there while its weight is below the force.
    const double weight = small_sphere.mass() * gravity;
    for (const double ratio : {1.01, 0.99}) {
        contact.cohesion = LinearCohesion::Params{ratio * weight, reach};
        contact.damping = ViscousDamping::Params{.normal = 0.3};
        Scene scene = scene_of({}, 2e-6, 0.05);
        scene.contact = contact;
        scene.gravity = {0.0, 0.0, -gravity};
        add_plane(scene, "ceiling", {}, {0.0, 0.0, -1.0});
        add_sphere(scene, {0.0, 0.0, -small_sphere.radius + 1e-9});
        Run run(scene);
        run.finish();
        const bool hangs = run.ball().position.z > -small_sphere.radius - reach;
        checks.add("hangs at a force of " + text_of(ratio) + " weights",
                   "1",
                   ratio > 1.0 ? 1.0 : 0.0,
                   hangs ? 1.0 : 0.0,
                   exact());
    }
}

// --- rolling and twisting ------------------------------------------------------------------------

constexpr double stiffness = 1e5;
constexpr double dt = 2e-6;

Scene floor_scene(const Contact& contact, double slope, double duration) {
    Scene scene = scene_of({}, dt, duration);
    scene.contact = contact;
    scene.gravity = gravity * Vec3{std::sin(slope), 0.0, -std::cos(slope)};
    add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
    return scene;
}

double resting_height(double slope) {
    return small_sphere.radius - small_sphere.mass() * gravity * std::cos(slope) / stiffness;
}

Contact rough_contact(double rolling, double twisting) {
    Contact contact = contact_of({.normal = stiffness,
                                  .shear = stiffness,
                                  .friction = 0.6,
                                  .damping = 0.3,
                                  .damping_mode = 3});
    if (rolling > 0.0) {
        contact.rolling = RollingResistance::Params{rolling};
    }
    if (twisting > 0.0) {
        contact.twisting = TwistingResistance::Params{twisting};
    }
    return contact;
}

void check_rolling_decay(Checks& checks) {
    for (const double mu : {0.02, 0.1}) {
        constexpr double v0 = 0.2;
        const double r = small_sphere.radius;
        const double deceleration = 5.0 / 7.0 * mu * gravity;
        const double stop = v0 / deceleration;
        Scene scene = floor_scene(rough_contact(mu, 0.0), 0.0, 0.5 * stop);
        scene.stages.push_back(scene.stages.back());
        scene.stages.back().duration = 0.7 * stop;
        add_sphere(scene, {0.0, 0.0, resting_height(0.0)}, {v0, 0.0, 0.0}, {0.0, v0 / r, 0.0});
        Run run(scene);
        while (run.simulation().time() < 0.5 * stop) {
            run.advance(1);
        }
        const double half = v0 - deceleration * run.simulation().time();
        const std::string of = ", mu_r " + text_of(mu);
        checks.add("v halfway" + of,
                   "m/s",
                   half,
                   run.ball().velocity.x,
                   relative(0.01, half, "asked for"));
        run.finish();
        const double way = 0.5 * v0 * stop;
        checks.add("way" + of, "m", way, run.ball().position.x, relative(0.01, way, "asked for"));
        checks.add("v at the end" + of,
                   "m/s",
                   0.0,
                   run.ball().velocity.x,
                   {0.01 * v0, "rocks in its elastic moment, which has no dashpot"});
    }
}

void check_rolling_incline(Checks& checks) {
    constexpr double mu = 0.1;
    for (const double ratio : {0.99, 1.01, 1.5}) {
        const double slope = std::atan(ratio * mu);
        Scene scene = floor_scene(rough_contact(mu, 0.0), slope, 1.0);
        add_sphere(scene, {0.0, 0.0, resting_height(slope)});
        Run run(scene);
        run.finish();
        const double t = run.simulation().time();
        const double acceleration = 5.0 / 7.0 * gravity * (std::sin(slope) - mu * std::cos(slope));
        const double way = ratio > 1.0 ? 0.5 * acceleration * t * t : 0.0;
        const std::string at = " in a second on a slope of " + text_of(ratio) + " mu_r";
        // What one percent of the slope would make.
        const double least = 0.5 * 5.0 / 7.0 * gravity * 0.01 * mu;
        checks.add("way" + at,
                   "m",
                   way,
                   run.ball().position.x,
                   {ratio < 1.4 ? 0.2 * least : 0.01 * way,
                    "a percent of slope makes five times as much"});
    }
}

void check_twisting_decay(Checks& checks) {
    constexpr double mu = 0.05;
    constexpr double w0 = 100.0;
    const double r = small_sphere.radius;
    const double deceleration = 2.5 * mu * gravity / r;
    Scene scene = floor_scene(rough_contact(0.0, mu), 0.0, 0.5 * w0 / deceleration);
    add_sphere(scene, {0.0, 0.0, resting_height(0.0)}, {}, {0.0, 0.0, w0});
    Run run(scene);
    run.finish();
    const double expected = w0 - deceleration * run.simulation().time();
    checks.add("spin about the normal",
               "rad/s",
               expected,
               run.ball().spin.z,
               relative(0.01, expected, "asked for"));
}

}  // namespace

std::vector<Case> effect_cases() {
    const auto test =
        [](const char* name, const char* section, const char* title, void (*run)(Checks&)) {
            return Case{.name = name, .section = section, .title = title, .run = run};
        };
    return {
        test("hertz/restitution",
             "9.1",
             "damped Hertz impacts of unequal spheres",
             check_hertz_restitution),
        test("walton-braun/restitution",
             "9.4",
             "impact of two spheres that yield",
             check_yielding_restitution),
        test("jkr/pull-off", "9.5", "adhesive sphere drawn from a plane", check_jkr),
        test("cohesion/pull-off",
             "9.6",
             "sphere with linear cohesion, drawn and hanging",
             check_linear_cohesion),
        test("rolling/decay", "10.4", "ball that rolls to rest", check_rolling_decay),
        test("rolling/threshold",
             "10.4",
             "ball with rolling resistance on a slope",
             check_rolling_incline),
        test("twisting/decay", "9.3", "ball that spins about its normal", check_twisting_decay)};
}

}  // namespace grainbench::verify
