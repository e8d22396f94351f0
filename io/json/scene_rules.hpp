/// What a scene must keep beyond the field tables: names that refer to each other, geometry that is
/// not degenerate, laws that fit together. Internal to io.
#pragma once

#include "core/scene.hpp"

#include "io/json/problems.hpp"

namespace grainbench::io {

/// Adds what is wrong with species, insertion, removal, walls and motions.
void check_bodies(const Scene& scene, Problems& problems);

/// Adds what is wrong with one set of contact laws, at `pointer` in the scene.
void check_contact(const Scene& scene,
                   const Contact& contact,
                   const std::string& pointer,
                   Problems& problems);

/// Adds what is wrong with stages, groups, layers, traces and output, and with what is measured.
void check_procedure(const Scene& scene, Problems& problems);

/// Adds what is wrong with what is measured.
void check_observables(const Scene& scene, Problems& problems);

/// Adds what is wrong with one motion, at `pointer` in the scene.
void check_motion(const WallMotion& motion, const std::string& pointer, Problems& problems);

/// Names of all items of a list, in order.
template <class T>
std::vector<std::string_view> names_of(const std::vector<T>& items) {
    std::vector<std::string_view> names;
    for (const T& item : items) {
        names.push_back(item.name);
    }
    return names;
}

/// Adds a problem for each name that is empty or stands twice.
void check_unique_names(const std::vector<std::string_view>& names,
                        const std::string& pointer,
                        Problems& problems);

/// Adds a problem if `name` is not among `known`.
void check_known(std::string_view name,
                 const std::vector<std::string_view>& known,
                 std::string_view kind,
                 const std::string& pointer,
                 Problems& problems);

/// Adds a problem if a direction has no length.
void check_direction(const Vec3& direction, const std::string& pointer, Problems& problems);

/// Adds a problem unless low < high on every axis.
void check_box(const Vec3& low, const Vec3& high, const std::string& pointer, Problems& problems);

}  // namespace grainbench::io
