#include "core/measure/regions.hpp"

namespace grainbench {

namespace {

bool is_in_box(const BoxShape& box, const Vec3& p) {
    return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x &&
           p.y <= box.high.y && p.z <= box.high.z;
}

bool is_in_cylinder(const CylinderRegion& cylinder, const Vec3& p) {
    const Vec3 axis = normalized(cylinder.axis);
    const Vec3 from_base = p - cylinder.base;
    const double height = dot(from_base, axis);
    return height >= 0.0 && height <= cylinder.height &&
           norm(from_base - height * axis) <= cylinder.radius;
}

}  // namespace

bool is_inside(const RegionShape& shape, const Vec3& point) {
    return std::visit(
        Overloaded{[&](const BoxShape& box) { return is_in_box(box, point); },
                   [&](const CylinderRegion& cylinder) { return is_in_cylinder(cylinder, point); }},
        shape);
}

Regions::Regions(const Scene& scene) : regions_(scene.observables.regions) {
    for (const Species& species : scene.particles.species) {
        species_.push_back(species.name);
    }
    for (const Group& group : scene.groups) {
        groups_.push_back(group.name);
    }
}

const std::vector<std::string>& Regions::kinds_of(const RegionObservable& region) const {
    static const std::vector<std::string> none;
    return !region.by ? none : *region.by == CountBy::species ? species_ : groups_;
}

void Regions::name_columns(std::vector<HistoryColumn>& columns) const {
    for (const RegionObservable& region : regions_) {
        columns.push_back({region.name + ".count", "1", "particles whose centre is in the region"});
        columns.push_back({region.name + ".mass", "kg", "of these particles"});
        for (const std::string& kind : kinds_of(region)) {
            columns.push_back({region.name + ".count." + kind, "1", "of these, those of " + kind});
        }
    }
}

void Regions::append_row(const MeasureView& view, std::vector<double>& row) const {
    for (const RegionObservable& region : regions_) {
        double count = 0.0;
        double mass = 0.0;
        // From 1 on, as groups are numbered; 0 is for what is in no group.
        std::vector<double> of_kind(kinds_of(region).size() + 1, 0.0);
        const bool by_group = region.by == CountBy::group;
        for (const Index slot : view.particles.slots_by_id()) {
            if (is_inside(region.shape, view.position(slot))) {
                count += 1.0;
                mass += view.particles.mass(slot);
                if (region.by) {
                    of_kind[by_group ? static_cast<Index>(view.groups[slot])
                                     : view.particles.species(slot) + 1] += 1.0;
                }
            }
        }
        row.push_back(count);
        row.push_back(mass);
        row.insert(row.end(), of_kind.begin() + 1, of_kind.end());
    }
}

}  // namespace grainbench
