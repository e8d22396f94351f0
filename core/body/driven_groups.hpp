/// Groups of particles that move as told (core/scene/driven.hpp).
///
/// Model    a driven particle has no inverse mass and no inverse inertia, so that no load moves it:
///          to a contact it is as heavy as a wall                                           (1)
///          x(t + dt) = c + u dt + R(omega dt) (x(t) - c)                                   (2)
/// Source   kinematics of a rigid body, as walls move (core/walls/wall_body.hpp).
/// Symbols  c centre of rotation [m]; u, omega velocity [m/s] and spin [rad/s] at the start of the
///          step; R rotation matrix.
/// Limits   driven particles neither feel walls nor each other. A particle that is released goes on
///          with the velocity it had.
#pragma once

#include "core/archive.hpp"
#include "core/scene.hpp"
#include "core/state/particle_state.hpp"
#include "core/walls/motion.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grainbench {

/// What contacts do to a driven group.
struct GroupLoad {
    Vec3 force{};   ///< [N]
    Vec3 torque{};  ///< [N m] about `centre`
    Vec3 centre{};  ///< [m]
    WallVelocity velocity;
};

class DrivenGroups {
public:
    DrivenGroups() = default;

    /// Finds the particles of all groups that are ever driven; none is yet.
    DrivenGroups(const Scene& scene, const ParticleState& particles);

    /// Names of all groups that are ever driven.
    std::vector<std::string> names() const;

    std::size_t size() const { return members_.size(); }

    /// False while nobody is driven.
    bool is_active() const { return active_count_ > 0; }

    /// Drives a group from time t on, or drives it otherwise.
    void drive(const DrivenGroup& group, double t, ParticleState& particles);

    /// \param gravity that acts on velocities [m/s^2]
    /// \param timestep of the last step [s]
    void release(const std::string& name,
                 const Vec3& gravity,
                 double timestep,
                 ParticleState& particles);

    /// Gives particles the velocities of the coming step, evaluated at its start t as everything
    /// else is.
    void begin_step(double t, double timestep, ParticleState& particles);

    /// Puts particles where the motion leads, after the integrator moved them somewhere else.
    /// \return largest speed relative to `frame`, at least `fastest` [m/s]
    double end_move(const Vec3& frame, double fastest, ParticleState& particles) const;

    /// Forces of all contacts on group n of names() [N], torque about the centre of its motion.
    /// \param gravity that is among the forces [m/s^2]
    GroupLoad load(std::size_t n, const ParticleState& particles, const Vec3& gravity) const;

    void change_population(const PopulationChange& change);

    void save(Archive& archive) const;
    void load(const Archive& archive, const ParticleState& particles);

private:
    struct Member {
        std::string name;
        std::vector<Index> slots;
        bool is_driven = false;
        WallMotion choice;
        double start = 0.0;  ///< [s] of the motion
        MotionEvaluator motion;
        WallVelocity velocity;
        std::vector<Vec3> place;  ///< [m] by slot, at the end of the step
        std::vector<Vec3> speed;  ///< [m/s] by slot, in the step
    };

    Member& member(const std::string& name);

    std::vector<Member> members_;
    std::size_t active_count_ = 0;
};

}  // namespace grainbench
