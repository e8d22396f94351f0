/// A wall on the move: its surface in its own frame, its pose in space, its motion.
#pragma once

#include "core/archive.hpp"
#include "core/scene.hpp"
#include "core/walls/motion.hpp"
#include "core/walls/surface.hpp"

#include <string>

namespace grainbench {

class WallBody {
public:
    WallBody(const Wall& wall, const std::string& where, Index material);

    const std::string& name() const { return name_; }

    Index material() const { return material_; }

    const Surface& surface() const { return surface_; }

    /// Another motion from time t on.
    void set_motion(const WallMotion& motion, double t);

    /// False where the present motion keeps the wall in its place for good.
    bool moves() const { return !motion_.is_fixed(); }

    /// Velocity of the coming step, evaluated at its start as everything else is.
    void begin_step(double t) { velocity_ = motion_.at(t); }

    /// Moves by one step with that velocity.
    void move(double dt);

    const WallVelocity& velocity() const { return velocity_; }

    /// Velocity of the material point of the wall that is at `point` in space.
    Vec3 velocity_at(const Vec3& point) const {
        return velocity_.linear + cross(velocity_.angular, point - motion_.centre());
    }

    /// Fixed point of a rotation [m].
    const Vec3& rotation_centre() const { return motion_.centre(); }

    /// Position of the wall's origin [m].
    const Vec3& displacement() const { return displacement_; }

    bool is_turned() const { return turned_; }

    /// Rows of the matrix that turns directions of the wall's frame into space.
    const double* rotation() const { return rotation_; }

    Vec3 to_wall(const Vec3& point) const;
    Vec3 to_space(const Vec3& point) const;
    Vec3 direction_to_space(const Vec3& direction) const;

    /// Bound on the speed of any particle relative to any point of the wall, from a bound on its
    /// speed relative to `frame` [m/s].
    double relative_speed_bound(double fastest, const Vec3& frame) const;

    void save(Archive& archive, const std::string& name) const;
    void load(const Archive& archive, const std::string& name);

private:
    std::string name_;
    Index material_ = 0;
    Surface surface_;
    WallMotion motion_choice_;
    double motion_start_ = 0.0;
    MotionEvaluator motion_;
    WallVelocity velocity_;
    Vec3 displacement_{};
    bool turned_ = false;
    double quaternion_[4] = {1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z
    double rotation_[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
};

}  // namespace grainbench
