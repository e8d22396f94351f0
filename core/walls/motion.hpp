/// Motions of walls as a scene describes them, and their velocity at a time.
#pragma once

#include "core/describe.hpp"
#include "core/types.hpp"

#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

namespace grainbench {

struct FixedMotion {
    static constexpr std::string_view key = "fixed";

    static constexpr auto fields() { return std::tuple{}; }
};

struct ConstantMotion {
    static constexpr std::string_view key = "constant";
    Vec3 velocity{};

    static constexpr auto fields() {
        return std::tuple{
            required(&ConstantMotion::velocity, "velocity", "m/s", any_number(), "velocity")};
    }
};

/// v = velocity * sin(2 pi frequency t + phase)
struct SinusoidMotion {
    static constexpr std::string_view key = "sinusoid";
    Vec3 velocity{};
    double frequency = 1.0;
    double phase = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            required(
                &SinusoidMotion::velocity, "velocity", "m/s", any_number(), "velocity amplitude"),
            required(&SinusoidMotion::frequency, "frequency", "Hz", positive(), "frequency"),
            field(&SinusoidMotion::phase, "phase", "rad", any_number(), "phase at the start")};
    }
};

/// Rotation about an axis through a point, with the right hand.
struct RotationMotion {
    static constexpr std::string_view key = "rotation";
    Vec3 point{};
    Vec3 axis{0.0, 0.0, 1.0};
    double rate = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            required(&RotationMotion::point, "point", "m", any_number(), "a point of the axis"),
            required(&RotationMotion::axis, "axis", "1", any_number(), "axis, of any length but 0"),
            required(&RotationMotion::rate, "rate", "rad/s", any_number(), "angular speed")};
    }
};

/// Piecewise linear speed along a direction; repeats with its last time as period if asked.
struct TableMotion {
    static constexpr std::string_view key = "table";
    Vec3 direction{0.0, 0.0, 1.0};
    std::vector<double> times;
    std::vector<double> speeds;
    bool repeat = false;

    static constexpr auto fields() {
        return std::tuple{
            field(&TableMotion::direction,
                  "direction",
                  "1",
                  any_number(),
                  "direction, of any length but 0"),
            required(&TableMotion::times, "times", "s", at_least(0.0), "ascending, from 0"),
            required(&TableMotion::speeds, "speeds", "m/s", any_number(), "speed at each time"),
            field(&TableMotion::repeat,
                  "repeat",
                  "",
                  any_number(),
                  "repeat from the start after the last time; else keep the last speed")};
    }
};

/// The example's shaking: a square wave of velocity with logistic flanks, tabulated (202 points a
/// period) and interpolated linearly; zero net displacement over a period.
struct SmoothedSquareMotion {
    static constexpr std::string_view key = "smoothed_square";
    Vec3 direction{0.0, 0.0, 1.0};
    double frequency = 10.0;
    double amplitude = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            field(&SmoothedSquareMotion::direction,
                  "direction",
                  "1",
                  any_number(),
                  "direction, of any length but 0"),
            required(&SmoothedSquareMotion::frequency, "frequency", "Hz", positive(), "frequency"),
            required(
                &SmoothedSquareMotion::amplitude, "amplitude", "m/s", at_least(0.0), "peak speed")};
    }
};

using WallMotion = std::variant<FixedMotion,
                                ConstantMotion,
                                SinusoidMotion,
                                RotationMotion,
                                TableMotion,
                                SmoothedSquareMotion>;

/// Velocity of a wall at one instant.
struct WallVelocity {
    Vec3 linear{};   ///< [m/s] of the point `centre`
    Vec3 angular{};  ///< [rad/s]
};

/// A motion made ready for evaluation. The smoothed square wave and tables become one table here.
class MotionEvaluator {
public:
    MotionEvaluator() = default;

    /// \param start [s] time at which the motion begins, its own t = 0
    MotionEvaluator(const WallMotion& motion, double start);

    /// Velocity at time t >= start [s].
    WallVelocity at(double t) const;

    bool is_fixed() const { return kind_ == Kind::fixed; }

    /// Point about which the wall turns; the origin where it does not.
    const Vec3& centre() const { return centre_; }

private:
    enum class Kind { fixed, constant, sinusoid, rotation, table };

    double table_speed(double t) const;

    Kind kind_ = Kind::fixed;
    double start_ = 0.0;
    Vec3 direction_{};
    Vec3 centre_{};
    double frequency_ = 0.0;
    double phase_ = 0.0;
    bool repeat_ = false;
    std::vector<double> times_;
    std::vector<double> speeds_;
};

/// Nodes of one period of the smoothed square wave: pairs of time [s] and speed [m/s].
std::vector<std::pair<double, double>> smoothed_square_table(double frequency, double amplitude);

}  // namespace grainbench
