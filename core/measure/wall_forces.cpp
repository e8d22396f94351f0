#include "core/measure/wall_forces.hpp"

namespace grainbench {

WallForces::WallForces(const Scene& scene) {
    for (const Wall& wall : scene.walls) {
        names_.push_back(wall.name);
    }
}

void WallForces::name_columns(std::vector<HistoryColumn>& columns) const {
    for (const std::string& name : names_) {
        for (const char* axis : {"x", "y", "z"}) {
            columns.push_back({name + ".force_" + axis, "N", "of particles on the wall"});
        }
        for (const char* axis : {"x", "y", "z"}) {
            columns.push_back({name + ".torque_" + axis, "N m", "about the origin"});
        }
        columns.push_back({name + ".displacement_z", "m", "of the wall since the start"});
    }
}

void WallForces::append_row(const MeasureView& view, std::vector<double>& row) const {
    for (std::size_t w = 0; w < view.walls.size(); ++w) {
        const WallContacts& contacts = view.wall_contacts[w];
        Vec3 force{};
        Vec3 torque{};
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            force += contacts.force(t);
            torque += cross(contacts.point(view.particles, t), contacts.force(t));
        }
        row.insert(row.end(),
                   {force.x,
                    force.y,
                    force.z,
                    torque.x,
                    torque.y,
                    torque.z,
                    view.walls[w].displacement().z});
    }
}

}  // namespace grainbench
