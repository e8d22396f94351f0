#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

#include <array>

namespace grainbench::verify {

namespace {

constexpr double stiffness = 1e5;
constexpr double steps = 8000.0;  ///< in half an undamped period

/// Slow, so that the overlap stays below 2e-5 radii: the reference takes the lever arm as R.
constexpr double speed = 1e-3;

struct Rebound {
    double normal = 0.0;   ///< v_n' [m/s]
    double sliding = 0.0;  ///< v_x' [m/s]
    double turning = 0.0;  ///< R w' [m/s], positive as in rolling along x
};

/// Ball on plane with v_n downward and v_x along x.
Rebound impact(const Laws& laws, double v_n, double v_x) {
    const double r = small_sphere.radius;
    const double dt = half_period(small_sphere.mass(), stiffness) / steps;
    Scene scene = scene_of(laws, dt, 1.1 * steps * dt);
    add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
    add_sphere(scene, {0.0, 0.0, r + 0.5 * v_n * dt}, {v_x, 0.0, -v_n});
    Run run(scene);
    run.finish();
    const Ball ball = run.ball();
    return {.normal = ball.velocity.z, .sliding = ball.velocity.x, .turning = r * ball.spin.y};
}

Tolerance fine(double expected) {
    return relative(1e-3, expected, "first order in dt, 8000 steps in an impact");
}

void check_stick(Checks& checks) {
    for (const double ratio : {1.0, 2.0 / 7.0, 0.5, 0.8}) {
        const Rebound got = impact(
            {.normal = stiffness, .shear = ratio * stiffness, .friction = 1e6}, speed, speed);
        const double e_t = -std::cos(pi * std::sqrt(3.5 * ratio));
        const double v = 1.0 - 2.0 / 7.0 * (1.0 + e_t);
        const double w = 5.0 / 7.0 * (1.0 + e_t);
        checks.add("v_x'/v_x, k_s/k_n " + text_of(ratio), "1", v, got.sliding / speed, fine(v));
        checks.add("R w'/v_x, k_s/k_n " + text_of(ratio),
                   "1",
                   w,
                   got.turning / speed,
                   {1e-4, "first order in dt, 8000 steps in an impact"});
    }
}

void check_damped_stick(Checks& checks) {
    struct Row {
        double ratio, e_n, v, w;
    };

    for (const Row& row :
         {Row{1.0, 0.939841, 0.928108, 0.179729}, Row{2.0 / 7.0, 0.939841, 0.460249, 1.349378}}) {
        const Rebound got = impact({.normal = stiffness,
                                    .shear = row.ratio * stiffness,
                                    .friction = 1e6,
                                    .damping = 0.02,
                                    .damping_mode = 3},
                                   speed,
                                   speed);
        const auto add = [&](const std::string& what, double expected, double value) {
            checks.add(what + text_of(row.ratio), "1", expected, value, fine(expected));
        };
        add("e_n, k_s/k_n ", row.e_n, got.normal / speed);
        add("v_x'/v_x, k_s/k_n ", row.v, got.sliding / speed);
        add("R w'/v_x, k_s/k_n ", row.w, got.turning / speed);
    }
}

/// Angle from the normal [deg], then v_x'/v_x and R w'/v_x without damping and with beta = 0.02 in
/// mode 3; mu = 0.6, k_s = k_n (physics reference 10.1).
struct AngleRow {
    double angle, v, w, v_damped, w_damped;
};

constexpr std::array<AngleRow, 12> angle_table{{
    {5, 0.97305, 0.06737, 0.92644, 0.18390},
    {10, 0.96791, 0.08023, 0.92421, 0.18947},
    {20, 0.94900, 0.12750, 0.91620, 0.20951},
    {30, 0.90617, 0.23458, 0.89483, 0.26291},
    {40, 0.79334, 0.51666, 0.79552, 0.51121},
    {50, 0.68687, 0.78282, 0.69343, 0.76643},
    {60, 0.62266, 0.94335, 0.63180, 0.92050},
    {65, 0.60992, 0.97521, 0.61982, 0.95045},
    {70, 0.61769, 0.95579, 0.62807, 0.92984},
    {75, 0.67846, 0.80385, 0.68825, 0.77937},
    {80, 0.78841, 0.52898, 0.79485, 0.51287},
    {85, 0.89501, 0.26247, 0.89821, 0.25447},
}};

constexpr double friction = 0.6;

Rebound angled_impact(double angle, bool damped) {
    Laws laws{.normal = stiffness, .shear = stiffness, .friction = friction};
    if (damped) {
        laws.damping = 0.02;
        laws.damping_mode = 3;
    }
    const double radians = angle * pi / 180.0;
    return impact(laws, speed * std::cos(radians), speed * std::sin(radians));
}

void check_angles(Checks& checks, bool damped) {
    for (const AngleRow& row : angle_table) {
        const double v_x = speed * std::sin(row.angle * pi / 180.0);
        const Rebound got = angled_impact(row.angle, damped);
        const double v = damped ? row.v_damped : row.v;
        const double w = damped ? row.w_damped : row.w;
        checks.add(
            "v_x'/v_x at " + text_of(row.angle) + " deg", "1", v, got.sliding / v_x, fine(v));
        checks.add(
            "R w'/v_x at " + text_of(row.angle) + " deg", "1", w, got.turning / v_x, fine(w));
    }
}

void check_gross_sliding(Checks& checks) {
    for (const double angle : {75.0, 80.0, 85.0}) {
        const double v_n = speed * std::cos(angle * pi / 180.0);
        const double v_x = speed * std::sin(angle * pi / 180.0);
        const Rebound got = angled_impact(angle, false);
        const double lost = friction * 2.0 * v_n / v_x;
        const Tolerance tolerance{5e-5, "overlap over radius, 4e-5 at most, in the lever arm"};
        checks.add("v_x'/v_x at " + text_of(angle) + " deg",
                   "1",
                   1.0 - lost,
                   got.sliding / v_x,
                   tolerance);
        checks.add("R w'/v_x at " + text_of(angle) + " deg",
                   "1",
                   2.5 * lost,
                   got.turning / v_x,
                   tolerance);
    }
}

}  // namespace

std::vector<Case> oblique_cases() {
    return {
        {.name = "oblique/stick",
         .section = "10.1",
         .title = "sticking impact, four ratios of stiffness",
         .run = check_stick},
        {.name = "oblique/stick-damped",
         .section = "10.1",
         .title = "sticking impact with dashpots",
         .run = check_damped_stick},
        {.name = "oblique/angles",
         .section = "10.1",
         .title = "friction 0.6, twelve angles",
         .run = [](Checks& checks) { check_angles(checks, false); }},
        {.name = "oblique/angles-damped",
         .section = "10.1",
         .title = "friction 0.6 and dashpots, twelve angles",
         .run = [](Checks& checks) { check_angles(checks, true); }},
        {.name = "oblique/gross-sliding",
         .section = "10.1",
         .title = "sliding throughout, in closed form",
         .run = check_gross_sliding},
    };
}

}  // namespace grainbench::verify
