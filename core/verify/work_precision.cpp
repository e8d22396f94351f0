#include "core/verify/work_precision.hpp"

#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainbench::verify {
namespace {

constexpr double stiffness = 1e5;
constexpr double speed = 1.0;  // [m/s] of the approach
constexpr double friction = 0.6;
constexpr double damping = 0.1;
constexpr double degree = pi / 180.0;

struct Impact {
    ImpactLaws laws;
    bool on_ball = false;
    double angle = 45.0 * degree;  ///< from the normal
    double timestep = 0.0;         ///< [s]
    double phase = 0.5;            ///< free way before the first touch, in steps
};

double impact_mass(bool on_ball) {
    return on_ball ? 0.5 * small_sphere.mass() : small_sphere.mass();
}

double contact_time(bool on_ball) {
    return half_period(impact_mass(on_ball), stiffness);
}

Laws laws_of(const ImpactLaws& wanted) {
    Laws laws{.normal = stiffness,
              .shear = stiffness,
              .incremental = wanted.incremental,
              .friction = friction};
    if (wanted.damping_mode) {
        laws.damping = damping;
        laws.damping_mode = *wanted.damping_mode;
    }
    return laws;
}

Scene impact_scene(const Impact& impact) {
    const double dt = impact.timestep;
    const double v_n = speed * std::cos(impact.angle);
    const double v_x = speed * std::sin(impact.angle);
    const double gap = impact.phase * v_n * dt;
    const double r = small_sphere.radius;
    Scene scene = scene_of(laws_of(impact.laws), dt, 1.3 * contact_time(impact.on_ball) + 6.0 * dt);
    if (impact.on_ball) {
        add_sphere(scene, {0.0, 0.0, r + 0.5 * gap}, {0.5 * v_x, 0.0, -0.5 * v_n});
        add_sphere(scene, {0.0, 0.0, -r - 0.5 * gap}, {-0.5 * v_x, 0.0, 0.5 * v_n});
    } else {
        add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
        add_sphere(scene, {0.0, 0.0, r + gap}, {v_x, 0.0, -v_n});
    }
    scene.output.history_cycles = 1;
    return scene;
}

/// Kinetic energy over that of approaching with `speed`.
double energy_of(const Run& run, bool on_ball) {
    const double m = small_sphere.mass();
    const double r = small_sphere.radius;
    double energy = 0.0;
    for (std::size_t k = 0; k < (on_ball ? 2U : 1U); ++k) {
        const Ball ball = run.ball(k);
        energy += 0.5 * m * dot(ball.velocity, ball.velocity) +
                  0.2 * m * r * r * dot(ball.spin, ball.spin);
    }
    return energy / (0.5 * impact_mass(on_ball) * speed * speed);
}

Outcomes outcomes_of(const Impact& impact) {
    Run run(impact_scene(impact));
    double steps_with_force = 0.0;
    run.each_cycle([&] { steps_with_force += norm(run.ball().force) > 0.0 ? 1.0 : 0.0; });
    const std::vector<double> ratios = run.series("overlap_ratio");
    const double v_n = speed * std::cos(impact.angle);
    const double v_x = speed * std::sin(impact.angle);
    const double t_c = contact_time(impact.on_ball);
    const Ball ball = run.ball(0);
    const Vec3 velocity = impact.on_ball ? ball.velocity - run.ball(1).velocity : ball.velocity;
    return {
        velocity.z / v_n,
        steps_with_force * impact.timestep / t_c,
        *std::max_element(ratios.begin(), ratios.end()) * small_sphere.radius / (v_n * t_c / pi),
        velocity.x / v_x,
        small_sphere.radius * ball.spin.y / v_x,
        energy_of(run, impact.on_ball)};
}

/// Calls visit(outcomes) for each phase.
template <class Visit>
void each_phase(Impact impact, Visit&& visit) {
    for (int p = 0; p < phases; ++p) {
        impact.phase = (p + 0.5) / phases;
        visit(outcomes_of(impact));
    }
}

WorkPoint point_at(const ImpactLaws& laws, double steps, const Outcomes& limit) {
    WorkPoint point{.steps = steps, .error = {}};
    each_phase({.laws = laws, .timestep = contact_time(false) / steps}, [&](const Outcomes& got) {
        for (std::size_t k = 0; k < got.size(); ++k) {
            point.error[k] += (got[k] - limit[k]) * (got[k] - limit[k]) / phases;
        }
    });
    for (double& error : point.error) {
        error = std::sqrt(error);
    }
    return point;
}

/// Slope of -log(error) over log(steps) by least squares, (2).
double order_of(const std::vector<WorkPoint>& points, std::size_t outcome) {
    double n = 0.0;
    double sum_x = 0.0;
    double sum_y = 0.0;
    double sum_xx = 0.0;
    double sum_xy = 0.0;
    for (const WorkPoint& point : points) {
        if (point.steps < fewest_for_order || !(point.error[outcome] > 0.0)) {
            continue;
        }
        const double x = std::log(point.steps);
        const double y = -std::log(point.error[outcome]);
        n += 1.0;
        sum_x += x;
        sum_y += y;
        sum_xx += x * x;
        sum_xy += x * y;
    }
    const double denominator = n * sum_xx - sum_x * sum_x;
    return n >= 3.0 ? (n * sum_xy - sum_x * sum_y) / denominator
                    : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<ImpactLaws> impact_laws() {
    std::vector<ImpactLaws> all;
    for (const bool incremental : {false, true}) {
        const std::string spring = incremental ? "incremental_spring" : "linear_spring";
        all.push_back({spring + ", undamped", incremental, std::nullopt});
        for (const int mode : {0, 1, 2, 3}) {
            all.push_back({spring + ", mode " + std::to_string(mode), incremental, mode});
        }
    }
    return all;
}

std::vector<WorkCurve> work_precision() {
    std::vector<WorkCurve> curves;
    for (const ImpactLaws& laws : impact_laws()) {
        WorkCurve curve{.laws = laws, .limit = {}, .points = {}, .order = {}};
        curve.limit = outcomes_of({.laws = laws, .timestep = contact_time(false) / finest_steps});
        for (const double steps :
             {3.0, 4.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 50.0, 100.0, 200.0, 400.0, 800.0}) {
            curve.points.push_back(point_at(laws, steps, curve.limit));
        }
        for (std::size_t k = 0; k < curve.order.size(); ++k) {
            curve.order[k] = order_of(curve.points, k);
        }
        curves.push_back(std::move(curve));
    }
    return curves;
}

std::vector<StepPoint> errors_against_step(const std::vector<double>& timesteps) {
    constexpr auto energy = static_cast<std::size_t>(Outcome::energy);
    constexpr auto restitution = static_cast<std::size_t>(Outcome::restitution);
    const std::array<double, 5> angles{15.0, 30.0, 45.0, 60.0, 75.0};
    const ImpactLaws undamped = impact_laws().front();
    std::vector<Outcomes> limits;
    for (const double angle : angles) {
        limits.push_back(outcomes_of({.laws = undamped,
                                      .on_ball = true,
                                      .angle = angle * degree,
                                      .timestep = small_pair_contact_time() / finest_steps}));
    }
    std::vector<StepPoint> points;
    for (const double dt : timesteps) {
        StepPoint point{.timestep = dt, .steps = small_pair_contact_time() / dt};
        for (std::size_t a = 0; a < angles.size(); ++a) {
            const Impact impact{
                .laws = undamped, .on_ball = true, .angle = angles[a] * degree, .timestep = dt};
            each_phase(impact, [&](const Outcomes& got) {
                const double of_energy = got[energy] - limits[a][energy];
                const double of_restitution = got[restitution] - limits[a][restitution];
                constexpr double weight = 1.0 / (phases * angles.size());
                point.energy_error += of_energy * of_energy * weight;
                point.restitution_error += of_restitution * of_restitution * weight;
                point.largest_error = std::max(point.largest_error, std::abs(of_energy));
            });
        }
        point.energy_error = std::sqrt(point.energy_error);
        point.restitution_error = std::sqrt(point.restitution_error);
        points.push_back(point);
    }
    return points;
}

double sticking_pair_limit() {
    // Two spheres, tangential spring at the surfaces: k (1/m + R^2/I) for each sphere, 7k/m in all.
    return 2.0 / std::sqrt(7.0 * stiffness / small_sphere.mass());
}

double small_pair_contact_time() {
    return contact_time(true);
}

}  // namespace grainbench::verify
