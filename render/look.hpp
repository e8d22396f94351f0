/// What a picture of particles looks like: a file of the format grainbench-render/1. Plain data, by
/// field tables as scenes are: presence is the switch, what is absent is not drawn.
#pragma once

#include "core/describe.hpp"
#include "core/scene.hpp"

#include "render/colour_map.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace grainbench {

namespace render {

enum class Background { light, dark };
enum class Projection { perspective, parallel };
enum class AntiAliasing { none, fxaa, supersampling };
enum class Component { magnitude, x, y, z };

}  // namespace render

template <>
struct EnumNames<render::Background> {
    static constexpr std::array<std::pair<render::Background, std::string_view>, 2> value{
        {{render::Background::light, "light"}, {render::Background::dark, "dark"}}};
};

template <>
struct EnumNames<render::Projection> {
    static constexpr std::array<std::pair<render::Projection, std::string_view>, 2> value{
        {{render::Projection::perspective, "perspective"},
         {render::Projection::parallel, "parallel"}}};
};

template <>
struct EnumNames<render::AntiAliasing> {
    static constexpr std::array<std::pair<render::AntiAliasing, std::string_view>, 3> value{
        {{render::AntiAliasing::none, "none"},
         {render::AntiAliasing::fxaa, "fxaa"},
         {render::AntiAliasing::supersampling, "supersampling"}}};
};

template <>
struct EnumNames<render::Component> {
    static constexpr std::array<std::pair<render::Component, std::string_view>, 4> value{
        {{render::Component::magnitude, "magnitude"},
         {render::Component::x, "x"},
         {render::Component::y, "y"},
         {render::Component::z, "z"}}};
};

namespace render {

/// Where the picture is taken from. The distance follows from what has to fit.
struct Camera {
    Vec3 direction{0.0, 1.0, -0.15};
    Vec3 up{0.0, 0.0, 1.0};
    Projection projection = Projection::perspective;
    double view_angle = 15.0;  ///< [deg]
    double zoom = 1.0;
    std::optional<Box> fit{};

    static constexpr auto fields() {
        return std::tuple{
            field(
                &Camera::direction, "direction", "1", any_number(), "from the eye into the scene"),
            field(&Camera::up, "up", "1", any_number(), "what points up in the picture"),
            field(&Camera::projection, "projection", "", any_number(), "kind of camera"),
            field(
                &Camera::view_angle,
                "view_angle",
                "deg",
                between(1.0, 120.0),
                "height of the picture as seen from the eye; large for a strong perspective. Only "
                "for perspective"),
            field(&Camera::zoom,
                  "zoom",
                  "1",
                  between(0.01, 100.0),
                  "1 = all that has to fit just fits; more cuts off, less leaves room"),
            field(&Camera::fit,
                  "fit",
                  "m",
                  any_number(),
                  "part of space that has to fit, of each realisation; absent = particles, walls "
                  "and traces at the start, in the middle and at the end of the run, and in the "
                  "frame drawn")};
    }
};

/// Ends of the scale of a field.
struct Range {
    double low = 0.0;
    double high = 1.0;

    static constexpr auto fields() {
        return std::tuple{
            required(&Range::low, "low", "", any_number(), "value of the dark end of the map"),
            required(&Range::high, "high", "", any_number(), "value of the light end; above low")};
    }
};

struct LayerColour {
    static constexpr std::string_view key = "layer";

    static constexpr auto fields() { return std::tuple{}; }
};

struct CurrentLayerColour {
    static constexpr std::string_view key = "current_layer";

    static constexpr auto fields() { return std::tuple{}; }
};

struct SpeciesColour {
    static constexpr std::string_view key = "species";

    static constexpr auto fields() { return std::tuple{}; }
};

struct GroupColour {
    static constexpr std::string_view key = "group";

    static constexpr auto fields() { return std::tuple{}; }
};

struct SpeedColour {
    static constexpr std::string_view key = "speed";
    ColourMap map = ColourMap::viridis;
    std::optional<Range> range{};

    static constexpr auto fields() {
        return std::tuple{
            field(&SpeedColour::map, "map", "", any_number(), "colours from slow to fast"),
            field(&SpeedColour::range,
                  "range",
                  "m/s",
                  any_number(),
                  "ends of the scale; absent = those of what is drawn, which differ from frame to "
                  "frame")};
    }
};

struct ArrayColour {
    static constexpr std::string_view key = "array";
    std::string array;
    Component component = Component::magnitude;
    ColourMap map = ColourMap::viridis;
    std::optional<Range> range{};
    std::string label{};

    static constexpr auto fields() {
        return std::tuple{
            required(&ArrayColour::array,
                     "array",
                     "",
                     any_number(),
                     "point array of the particle files, such as force or contacts"),
            field(&ArrayColour::component,
                  "component",
                  "",
                  any_number(),
                  "which number of a vector; its length by default"),
            field(&ArrayColour::map, "map", "", any_number(), "colours from low to high"),
            field(&ArrayColour::range,
                  "range",
                  "",
                  any_number(),
                  "ends of the scale; absent = those of what is drawn, which differ from frame to "
                  "frame"),
            field(&ArrayColour::label,
                  "label",
                  "",
                  any_number(),
                  "text above the colour bar; absent = name and unit of the array")};
    }
};

using ParticleColour = std::
    variant<LayerColour, CurrentLayerColour, SpeciesColour, GroupColour, SpeedColour, ArrayColour>;

/// Keeps particles by the layer in which they started.
struct LayerFilter {
    static constexpr std::string_view key = "layers";
    std::vector<std::int64_t> layers;
    std::vector<std::string> and_species;

    static constexpr auto fields() {
        return std::tuple{required(&LayerFilter::layers,
                                   "layers",
                                   "1",
                                   at_least(0.0),
                                   "fixed layers to keep; 0 = particles without a layer"),
                          field(&LayerFilter::and_species,
                                "and_species",
                                "",
                                any_number(),
                                "species kept as well, whatever their layer")};
    }
};

struct SpeciesFilter {
    static constexpr std::string_view key = "species";
    std::vector<std::string> species;

    static constexpr auto fields() {
        return std::tuple{required(
            &SpeciesFilter::species, "species", "", any_number(), "names of species to keep")};
    }
};

/// Keeps particles whose centre lies between two planes.
struct SliceFilter {
    static constexpr std::string_view key = "slice";
    Axis axis = Axis::y;
    double low = 0.0;   ///< [m]
    double high = 0.0;  ///< [m]

    static constexpr auto fields() {
        return std::tuple{
            required(&SliceFilter::axis, "axis", "", any_number(), "normal of the planes"),
            required(&SliceFilter::low, "low", "m", any_number(), "lower plane"),
            required(&SliceFilter::high, "high", "m", any_number(), "upper plane; above low")};
    }
};

/// Keeps particles whose centre lies in a box.
struct RegionFilter {
    static constexpr std::string_view key = "region";
    Box box;

    static constexpr auto fields() {
        return std::tuple{required(&RegionFilter::box, "box", "", any_number(), "part of space")};
    }
};

using ParticleFilter = std::variant<LayerFilter, SpeciesFilter, SliceFilter, RegionFilter>;

struct ParticleLook {
    ParticleColour colour;
    std::vector<ParticleFilter> filters;

    static constexpr auto fields() {
        return std::tuple{
            field(&ParticleLook::colour, "colour", "", any_number(), "what the colours mean"),
            field(&ParticleLook::filters,
                  "filters",
                  "",
                  any_number(),
                  "particles are drawn if every filter keeps them")};
    }
};

struct WallLook {
    double opacity = 0.08;
    bool edges = true;
    std::vector<std::string> names;
    std::optional<Box> region;

    static constexpr auto fields() {
        return std::tuple{
            field(
                &WallLook::opacity, "opacity", "1", between(0.0, 1.0), "1 = hides what is behind"),
            field(
                &WallLook::edges, "edges", "", any_number(), "draw rims and sharp edges as lines"),
            field(&WallLook::names, "names", "", any_number(), "walls to draw; none named = all"),
            field(&WallLook::region,
                  "region",
                  "",
                  any_number(),
                  "cuts off what lies outside, such as the empty top of a tall container")};
    }
};

struct TimeColour {
    static constexpr std::string_view key = "time";
    ColourMap map = ColourMap::viridis;
    std::optional<Range> range{};

    static constexpr auto fields() {
        return std::tuple{
            field(&TimeColour::map, "map", "", any_number(), "colours from early to late"),
            field(&TimeColour::range,
                  "range",
                  "s",
                  any_number(),
                  "ends of the scale; absent = from 0 to the time of the frame")};
    }
};

/// Paths from the start to the time of the frame, as tubes.
struct TraceLook {
    std::variant<TimeColour, SpeedColour> colour;
    double radius = 5e-4;   ///< [m]
    double interval = 0.0;  ///< [s]

    static constexpr auto fields() {
        return std::tuple{
            field(&TraceLook::colour, "colour", "", any_number(), "what the colours mean"),
            field(&TraceLook::radius, "radius", "m", positive(), "of the tubes"),
            field(&TraceLook::interval,
                  "interval",
                  "s",
                  at_least(0.0),
                  "a tube follows the sliding mean over this time, such as some periods of "
                  "shaking, of "
                  "which only the drift is left; 0 = every recorded point")};
    }
};

/// Darkens places that little light from around would reach, so that depth reads.
struct AmbientOcclusion {
    std::optional<double> radius;

    static constexpr auto fields() {
        return std::tuple{field(&AmbientOcclusion::radius,
                                "radius",
                                "m",
                                positive(),
                                "how far away things cast shade; absent = four times the mean "
                                "radius of the particles")};
    }
};

struct Legend {
    static constexpr auto fields() { return std::tuple{}; }
};

struct TimeStamp {
    static constexpr auto fields() { return std::tuple{}; }
};

struct ScaleBar {
    static constexpr auto fields() { return std::tuple{}; }
};

struct RealisationLabels {
    static constexpr auto fields() { return std::tuple{}; }
};

struct Look {
    static constexpr std::string_view format_name = "grainbench-render/1";

    std::string schema;
    std::string format{format_name};
    std::string description;
    std::string run;
    std::vector<double> times;
    std::int64_t width = 1600;
    std::int64_t height = 1000;
    Background background = Background::light;
    std::string title;
    Camera camera;
    std::vector<std::int64_t> realisations;
    std::optional<ParticleLook> particles;
    std::optional<WallLook> walls;
    std::optional<TraceLook> traces;
    std::optional<AmbientOcclusion> ambient_occlusion;
    AntiAliasing anti_aliasing = AntiAliasing::fxaa;
    std::optional<Legend> legend;
    std::optional<TimeStamp> time_stamp;
    std::optional<ScaleBar> scale_bar;
    std::optional<RealisationLabels> realisation_labels;

    static constexpr auto fields() {
        return std::tuple{
            field(&Look::schema, "$schema", "", any_number(), "schema for editors; not read"),
            required(&Look::format, "format", "", any_number(), "\"grainbench-render/1\""),
            field(&Look::description, "description", "", any_number(), "what the picture shows"),
            field(&Look::run,
                  "run",
                  "",
                  any_number(),
                  "run folder, relative to this file; a look without it is for any run"),
            field(&Look::times,
                  "times",
                  "s",
                  at_least(0.0),
                  "of each the nearest frame is drawn; none = every frame"),
            field(&Look::width, "width", "px", between(1, 8192), "of the picture"),
            field(&Look::height, "height", "px", between(1, 8192), "of the picture"),
            field(&Look::background, "background", "", any_number(), "for paper or for slides"),
            field(&Look::title, "title", "", any_number(), "text above the picture"),
            field(&Look::camera, "camera", "", any_number(), "where it is seen from"),
            field(&Look::realisations,
                  "realisations",
                  "1",
                  at_least(1),
                  "numbers of those drawn side by side; none = all"),
            field(&Look::particles, "particles", "", any_number(), "draw particles"),
            field(&Look::walls, "walls", "", any_number(), "draw walls"),
            field(&Look::traces, "traces", "", any_number(), "draw paths of traced particles"),
            field(&Look::ambient_occlusion,
                  "ambient_occlusion",
                  "",
                  any_number(),
                  "shade between neighbours"),
            field(&Look::anti_aliasing,
                  "anti_aliasing",
                  "",
                  any_number(),
                  "smooth edges: fxaa is fast, supersampling draws four times the pixels"),
            field(&Look::legend,
                  "legend",
                  "",
                  any_number(),
                  "say what the colours mean, beside the picture"),
            field(&Look::time_stamp, "time_stamp", "", any_number(), "say the time of the frame"),
            field(&Look::scale_bar, "scale_bar", "", any_number(), "draw a length to compare with"),
            field(&Look::realisation_labels,
                  "realisation_labels",
                  "",
                  any_number(),
                  "say below each container which realisation it is, and its seed")};
    }
};

}  // namespace render

}  // namespace grainbench
