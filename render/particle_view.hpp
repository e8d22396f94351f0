/// Which particles a picture shows, in which colours, and what the colours mean: filters and
/// colours of a look applied to frames. Knows no VTK. Internal to render.
#pragma once

#include "core/types.hpp"

#include "render/colour_map.hpp"
#include "render/look.hpp"
#include "render/run_frames.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grainbench::render {

/// Spheres of one realisation; all columns have the same length.
struct Spheres {
    std::vector<Vec3> position;  ///< [m]
    std::vector<double> radius;  ///< [m]
    std::vector<Colour> colour;
};

/// Colours that stand for names.
struct ColourKey {
    std::string title;
    std::vector<std::pair<std::string, Colour>> entries;
};

/// Colours that stand for numbers.
struct ColourScale {
    std::string title;
    ColourMap map = ColourMap::viridis;
    Range range;
};

struct ParticleView {
    std::vector<Spheres> realisations;
    std::optional<ColourKey> key;  ///< of what is drawn; none where colours are a scale
    std::optional<ColourScale> scale;
};

/// Error(bad_input) that lists what there is if the look names an array or a species that is not in
/// the files.
ParticleView view_particles(const Instant& instant,
                            const ParticleLook& look,
                            const std::vector<std::string>& group_names);

/// The range of a scale: as asked for, or the extremes of the values; never empty.
Range range_of(const std::optional<Range>& asked, const std::vector<double>& values);

/// Where a value lies in a range, 0 to 1.
double fraction_in(const Range& range, double value);

}  // namespace grainbench::render
