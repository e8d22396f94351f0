#include "core/body/driven_groups.hpp"

#include "core/measure/selection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

namespace grainbench {

namespace {

Eigen::Vector3d eigen(const Vec3& v) {
    return {v.x, v.y, v.z};
}

Vec3 plain(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace

DrivenGroups::DrivenGroups(const Scene& scene, const ParticleState& particles) {
    std::set<Index> taken;
    const auto add = [&](const DrivenGroup& driven) {
        const bool is_known =
            std::any_of(members_.begin(), members_.end(), [&](const Member& member) {
                return member.name == driven.group;
            });
        if (is_known) {
            return;
        }
        Member member;
        member.name = driven.group;
        for (const Group& group : scene.groups) {
            if (group.name == driven.group) {
                member.slots = slots_of_group(scene, group, particles);
            }
        }
        if (member.slots.empty()) {
            throw_bad_input({.what = "the group '" + driven.group + "' holds no particle",
                             .where = "/driven",
                             .likely_cause = "an unknown group, or its species or box is empty",
                             .next_step = "check /groups and /particles/insertion"});
        }
        for (const Index slot : member.slots) {
            if (!taken.insert(slot).second) {
                throw_bad_input(
                    {.what = "a particle of the group '" + driven.group +
                             "' belongs to another driven group as well",
                     .where = "/driven",
                     .likely_cause = "groups overlap, and each would move it in its own way",
                     .next_step =
                         "give driven groups boxes or species that have nothing in common"});
            }
        }
        members_.push_back(std::move(member));
    };
    std::for_each(scene.driven.begin(), scene.driven.end(), add);
    for (const Stage& stage : scene.stages) {
        std::for_each(stage.driven.begin(), stage.driven.end(), add);
    }
}

std::vector<std::string> DrivenGroups::names() const {
    std::vector<std::string> names;
    for (const Member& member : members_) {
        names.push_back(member.name);
    }
    return names;
}

DrivenGroups::Member& DrivenGroups::member(const std::string& name) {
    return *std::find_if(members_.begin(), members_.end(), [&](const Member& member) {
        return member.name == name;
    });
}

void DrivenGroups::drive(const DrivenGroup& group, double t, ParticleState& particles) {
    Member& driven = member(group.group);
    active_count_ += driven.is_driven ? 0 : 1;
    driven.is_driven = true;
    driven.choice = group.motion;
    driven.start = t;
    driven.motion = MotionEvaluator(group.motion, t);
    for (const Index slot : driven.slots) {
        particles.set_driven(slot, true);
    }
}

/// The integrator kicks by half the old step and half the new one; from a full step on, only the
/// second half is due, so the first is taken back beforehand.
void DrivenGroups::release(const std::string& name,
                           const Vec3& gravity,
                           double timestep,
                           ParticleState& particles) {
    Member& driven = member(name);
    if (!driven.is_driven) {
        return;
    }
    driven.is_driven = false;
    --active_count_;
    for (const Index slot : driven.slots) {
        particles.set_driven(slot, false);
        const Vec3 a = particles.inverse_mass(slot) * particles.force(slot) + gravity;
        const Vec3 turn = particles.inverse_inertia(slot) * particles.torque(slot);
        particles.set_velocity(slot, particles.velocity(slot) - 0.5 * timestep * a);
        particles.set_spin(slot, particles.spin(slot) - 0.5 * timestep * turn);
    }
}

void DrivenGroups::begin_step(double t, double timestep, ParticleState& particles) {
    for (Member& driven : members_) {
        if (!driven.is_driven) {
            continue;
        }
        driven.velocity = driven.motion.at(t);
        const double rate = norm(driven.velocity.angular);
        const Vec3 axis = rate > 0.0 ? (1.0 / rate) * driven.velocity.angular : Vec3{1.0, 0.0, 0.0};
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(rate * timestep, eigen(axis)).toRotationMatrix();
        const Vec3& centre = driven.motion.centre();
        driven.place.clear();
        driven.speed.clear();
        for (const Index slot : driven.slots) {
            const Vec3 from = particles.position(slot);
            Vec3 to = from + timestep * driven.velocity.linear;
            Vec3 speed = driven.velocity.linear;
            if (rate > 0.0) {
                to =
                    centre + plain(turn * eigen(from - centre)) + timestep * driven.velocity.linear;
                speed = (1.0 / timestep) * (to - from);
            }
            driven.place.push_back(to);
            driven.speed.push_back(speed);
            particles.set_velocity(slot, speed);
            particles.set_spin(slot, driven.velocity.angular);
        }
    }
}

double DrivenGroups::end_move(const Vec3& frame, double fastest, ParticleState& particles) const {
    for (const Member& driven : members_) {
        for (std::size_t k = 0; k < driven.slots.size() && driven.is_driven; ++k) {
            const Index slot = driven.slots[k];
            particles.set_position(slot, driven.place[k]);
            particles.set_velocity(slot, driven.speed[k]);
            fastest = std::max(fastest, norm(driven.speed[k] - frame));
        }
    }
    return fastest;
}

GroupLoad DrivenGroups::load(std::size_t n,
                             const ParticleState& particles,
                             const Vec3& gravity) const {
    const Member& driven = members_[n];
    GroupLoad load{.force = {},
                   .torque = {},
                   .centre = driven.motion.centre(),
                   .velocity = driven.is_driven ? driven.velocity : WallVelocity{}};
    for (const Index slot : driven.slots) {
        const Vec3 force = particles.force(slot) - particles.mass(slot) * gravity;
        load.force += force;
        load.torque +=
            particles.torque(slot) + cross(particles.position(slot) - load.centre, force);
    }
    return load;
}

void DrivenGroups::change_population(const PopulationChange& change) {
    for (Member& driven : members_) {
        for (Index& slot : driven.slots) {
            slot = change.slot_after[slot];
        }
        std::erase(driven.slots, PopulationChange::gone);
    }
}

void DrivenGroups::save(Archive& archive) const {
    for (std::size_t n = 0; n < members_.size(); ++n) {
        const Member& driven = members_[n];
        const std::string name = "driven-" + std::to_string(n + 1);
        archive.put(name + "/slots", driven.slots);
        archive.put(name + "/start", driven.start);
        archive.put(name + "/velocity",
                    std::vector<double>{driven.velocity.linear.x,
                                        driven.velocity.linear.y,
                                        driven.velocity.linear.z,
                                        driven.velocity.angular.x,
                                        driven.velocity.angular.y,
                                        driven.velocity.angular.z});
    }
}

void DrivenGroups::load(const Archive& archive, const ParticleState& particles) {
    for (std::size_t n = 0; n < members_.size(); ++n) {
        Member& driven = members_[n];
        const std::string name = "driven-" + std::to_string(n + 1);
        driven.slots = archive.get<Index>(name + "/slots");
        for (const Index slot : driven.slots) {
            Archive::require(slot < particles.size(), name + "/slots");
        }
        // The choice of motion comes from the stages; only when it began is part of the state.
        driven.start = archive.number(name + "/start");
        if (driven.is_driven) {
            driven.motion = MotionEvaluator(driven.choice, driven.start);
        }
        const auto& v = archive.get<double>(name + "/velocity", 6);
        driven.velocity = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    }
}

}  // namespace grainbench
