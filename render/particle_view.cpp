#include "render/particle_view.hpp"

#include "core/error.hpp"

#include "io/json/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>

namespace grainbench::render {
namespace {

using Keep = std::vector<char>;  // 1 for particles that are drawn

struct Unit {
    std::string_view array;
    std::string_view unit;
};

/// Units of the arrays that we write; others have none that we know.
constexpr std::array units{Unit{"radius", "m"},
                           Unit{"diameter", "m"},
                           Unit{"velocity", "m/s"},
                           Unit{"angular_velocity", "rad/s"},
                           Unit{"force", "N"}};

std::string label_of(const ArrayColour& colour) {
    if (!colour.label.empty()) {
        return colour.label;
    }
    std::string label = colour.array;
    std::replace(label.begin(), label.end(), '_', ' ');
    if (colour.component != Component::magnitude) {
        label += fmt::format(", {}", name_of(colour.component));
    }
    for (const Unit& known : units) {
        if (known.array == colour.array) {
            label += fmt::format(" [{}]", known.unit);
        }
    }
    return label;
}

const io::PointArray& array_named(const io::ParticleFile& file, const std::string& name) {
    std::vector<std::string_view> known;
    for (const io::PointArray& array : file.arrays) {
        if (array.name == name) {
            return array;
        }
        known.push_back(array.name);
    }
    const std::string_view nearest = io::nearest_name(name, known);
    throw_bad_input({.what = fmt::format("the particle files have no array '{}'", name),
                     .where = "/particles/colour/array",
                     .likely_cause = "a slip of the keys, or an array that this run did not write",
                     .next_step = nearest.empty() ? "choose one of " + io::list_names(known)
                                                  : fmt::format("write '{}', or choose one of {}",
                                                                nearest,
                                                                io::list_names(known))});
}

/// One number for each particle.
std::vector<double> values_of(const io::PointArray& array, Component component) {
    const std::size_t width = array.components;
    const std::size_t count = array.values.size() / width;
    const auto chosen = static_cast<std::size_t>(component);  // 0 = magnitude, then x, y, z
    if (chosen > width || (chosen > 0 && width == 1)) {
        throw_bad_input({.what = fmt::format(
                             "the array '{}' has no component {}", array.name, name_of(component)),
                         .where = "/particles/colour/component",
                         .likely_cause = "it holds one number for each particle",
                         .next_step = "take 'component' out"});
    }
    std::vector<double> values(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double* numbers = array.values.data() + k * width;
        if (chosen > 0) {
            values[k] = numbers[chosen - 1];
        } else if (width == 1) {
            values[k] = numbers[0];
        } else {
            double sum = 0.0;
            for (std::size_t c = 0; c < width; ++c) {
                sum += numbers[c] * numbers[c];
            }
            values[k] = std::sqrt(sum);
        }
    }
    return values;
}

/// Number of a species in the files. Files of one run agree on it.
std::int32_t species_number(const io::ParticleFile& file,
                            const std::string& name,
                            const char* where) {
    const std::vector<std::string>& names = file.provenance.species_names;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        const std::vector<std::string_view> known(names.begin(), names.end());
        throw_bad_input({.what = fmt::format("the run has no species '{}'", name),
                         .where = where,
                         .likely_cause = "a slip of the keys, or a look made for another scene",
                         .next_step = "choose from " + io::list_names(known)});
    }
    return static_cast<std::int32_t>(found - names.begin());
}

bool is_inside(const Vec3& x, const Box& box) {
    return x.x >= box.low.x && x.x <= box.high.x && x.y >= box.low.y && x.y <= box.high.y &&
           x.z >= box.low.z && x.z <= box.high.z;
}

double coordinate(const Vec3& x, Axis axis) {
    return axis == Axis::x ? x.x : axis == Axis::y ? x.y : x.z;
}

/// Takes out the particles that the test refuses.
void keep_if(Keep& keep, const std::function<bool(std::size_t)>& test) {
    for (std::size_t k = 0; k < keep.size(); ++k) {
        keep[k] = keep[k] != 0 && test(k) ? 1 : 0;
    }
}

std::vector<char> species_marks(const io::ParticleFile& file,
                                const std::vector<std::string>& names,
                                const char* where) {
    std::vector<char> marks(file.provenance.species_names.size(), 0);
    for (const std::string& name : names) {
        marks[static_cast<std::size_t>(species_number(file, name, where))] = 1;
    }
    return marks;
}

Keep kept_by(const std::vector<ParticleFilter>& filters, const io::ParticleFile& file) {
    const ParticleFrame& frame = file.frame;
    Keep keep(frame.size(), 1);
    const auto apply = Overloaded{
        [&](const LayerFilter& filter) {
            const std::vector<char> marks =
                species_marks(file, filter.and_species, "/particles/filters/and_species");
            keep_if(keep, [&](std::size_t k) {
                const std::int64_t layer = frame.layer[k];
                return marks.at(static_cast<std::size_t>(frame.species[k])) != 0 ||
                       std::find(filter.layers.begin(), filter.layers.end(), layer) !=
                           filter.layers.end();
            });
        },
        [&](const SpeciesFilter& filter) {
            const std::vector<char> marks =
                species_marks(file, filter.species, "/particles/filters/species");
            keep_if(keep, [&](std::size_t k) {
                return marks.at(static_cast<std::size_t>(frame.species[k])) != 0;
            });
        },
        [&](const SliceFilter& filter) {
            keep_if(keep, [&](std::size_t k) {
                const double x = coordinate(frame.position[k], filter.axis);
                return x >= filter.low && x <= filter.high;
            });
        },
        [&](const RegionFilter& filter) {
            keep_if(keep, [&](std::size_t k) { return is_inside(frame.position[k], filter.box); });
        }};
    for (const ParticleFilter& filter : filters) {
        std::visit(apply, filter);
    }
    return keep;
}

template <class T>
std::vector<T> kept(const std::vector<T>& all, const Keep& keep) {
    std::vector<T> some;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (keep[k] != 0) {
            some.push_back(all[k]);
        }
    }
    return some;
}

/// Colours by a whole number of each particle, and the key of the numbers that occur.
void colour_by_number(ParticleView& view,
                      const std::vector<std::vector<std::int32_t>>& numbers,
                      Colour (*colour_of_number)(std::int32_t),
                      const std::string& title,
                      const std::function<std::string(std::int32_t)>& name) {
    std::map<std::int32_t, Colour> seen;
    for (std::size_t r = 0; r < numbers.size(); ++r) {
        for (const std::int32_t number : numbers[r]) {
            const Colour colour = colour_of_number(number);
            view.realisations[r].colour.push_back(colour);
            seen.emplace(number, colour);
        }
    }
    view.key = ColourKey{title, {}};
    for (const auto& [number, colour] : seen) {
        view.key->entries.emplace_back(name(number), colour);
    }
}

/// Colours by a value of each particle.
void colour_by_value(ParticleView& view,
                     const std::vector<std::vector<double>>& values,
                     ColourScale scale,
                     const std::optional<Range>& asked) {
    std::vector<double> all;
    for (const std::vector<double>& some : values) {
        all.insert(all.end(), some.begin(), some.end());
    }
    scale.range = range_of(asked, all);
    for (std::size_t r = 0; r < values.size(); ++r) {
        for (const double value : values[r]) {
            view.realisations[r].colour.push_back(
                map_colour(scale.map, fraction_in(scale.range, value)));
        }
    }
    view.scale = std::move(scale);
}

/// Applies colours of a look to the particles that are kept.
class Colouring {
public:
    Colouring(const Instant& instant,
              const std::vector<Keep>& keep,
              const std::vector<std::string>& group_names,
              ParticleView& view)
        : instant_(instant), keep_(keep), group_names_(group_names), view_(view) {}

    void operator()(const LayerColour& /*colour*/) {
        by_number(&ParticleFrame::layer, layer_colour, "layer at start", layer_name);
    }

    void operator()(const CurrentLayerColour& /*colour*/) {
        by_number(&ParticleFrame::current_layer, layer_colour, "layer now", layer_name);
    }

    void operator()(const SpeciesColour& /*colour*/) {
        const auto name = [&](std::int32_t number) {
            const auto& names = instant_.realisations.front().particles.provenance.species_names;
            const auto index = static_cast<std::size_t>(number);
            return index < names.size() ? names[index] : fmt::format("species {}", number);
        };
        by_number(&ParticleFrame::species, species_colour, "species", name);
    }

    void operator()(const GroupColour& /*colour*/) {
        const auto name = [&](std::int32_t number) {
            const auto index = static_cast<std::size_t>(number - 1);
            return number < 1                    ? std::string("none")
                   : index < group_names_.size() ? group_names_[index]
                                                 : fmt::format("group {}", number);
        };
        by_number(&ParticleFrame::group, group_colour, "group", name);
    }

    void operator()(const SpeedColour& colour) {
        by_array("velocity", Component::magnitude, {"speed [m/s]", colour.map, {}}, colour.range);
    }

    void operator()(const ArrayColour& colour) {
        by_array(colour.array, colour.component, {label_of(colour), colour.map, {}}, colour.range);
    }

private:
    static std::string layer_name(std::int32_t layer) {
        return layer < 1 ? "none" : std::to_string(layer);
    }

    void by_number(std::vector<std::int32_t> ParticleFrame::*column,
                   Colour (*colour_of_number)(std::int32_t),
                   const std::string& title,
                   const std::function<std::string(std::int32_t)>& name) {
        std::vector<std::vector<std::int32_t>> numbers;
        for (std::size_t r = 0; r < keep_.size(); ++r) {
            numbers.push_back(kept(instant_.realisations[r].particles.frame.*column, keep_[r]));
        }
        colour_by_number(view_, numbers, colour_of_number, title, name);
    }

    void by_array(const std::string& array,
                  Component component,
                  ColourScale scale,
                  const std::optional<Range>& asked) {
        std::vector<std::vector<double>> values;
        for (std::size_t r = 0; r < keep_.size(); ++r) {
            const io::ParticleFile& file = instant_.realisations[r].particles;
            values.push_back(kept(values_of(array_named(file, array), component), keep_[r]));
        }
        colour_by_value(view_, values, std::move(scale), asked);
    }

    const Instant& instant_;
    const std::vector<Keep>& keep_;
    const std::vector<std::string>& group_names_;
    ParticleView& view_;
};

}  // namespace

ParticleView view_particles(const Instant& instant,
                            const ParticleLook& look,
                            const std::vector<std::string>& group_names) {
    ParticleView view;
    std::vector<Keep> keep;
    for (const RealisationInstant& realisation : instant.realisations) {
        keep.push_back(kept_by(look.filters, realisation.particles));
        const ParticleFrame& frame = realisation.particles.frame;
        view.realisations.push_back(
            {kept(frame.position, keep.back()), kept(frame.radius, keep.back()), {}});
    }
    std::visit(Colouring(instant, keep, group_names, view), look.colour);
    return view;
}

Range range_of(const std::optional<Range>& asked, const std::vector<double>& values) {
    if (asked) {
        return *asked;
    }
    std::vector<double> finite;
    std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double value) {
        return std::isfinite(value);
    });
    if (finite.empty()) {
        return {};
    }
    const auto [low, high] = std::minmax_element(finite.begin(), finite.end());
    if (*low < *high) {
        return {*low, *high};
    }
    if (*low == 0.0) {
        return {0.0, 1.0};  // what is zero at the start, a time or a speed, is never negative
    }
    // One value: a scale around it.
    const double room = 0.5 * std::abs(*low);
    return {*low - room, *low + room};
}

double fraction_in(const Range& range, double value) {
    return (value - range.low) / (range.high - range.low);
}

}  // namespace grainbench::render
