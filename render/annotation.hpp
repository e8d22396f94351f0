/// What stands around the particles: title, legend, colour bars, time, scale, names of
/// realisations. Room for them is set aside before the camera is placed, so that nothing covers a
/// particle. Internal to render.
#pragma once

#include "render/camera_fit.hpp"
#include "render/image.hpp"
#include "render/overlay.hpp"
#include "render/particle_view.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grainbench::render {

struct Annotation {
    std::string title;
    std::string time;
    std::optional<ColourKey> key;
    std::vector<ColourScale> scales;
    std::vector<std::string> labels;  ///< one for each realisation, or none
    bool has_scale_bar = false;
};

class AnnotationLayout {
public:
    /// Chooses the largest font, up to a fixed share of the picture, with which all has its place.
    /// A picture too small for readable text gets none.
    /// \param pixel_scale pixels that become one when the picture is reduced
    AnnotationLayout(Annotation annotation,
                     ImageSize size,
                     bool is_background_dark,
                     int pixel_scale);

    /// The part of the picture that is left for the particles.
    const Frame& frame() const { return frame_; }

    /// \param metres_per_pixel at the depth of the particles
    /// \param label_places horizontal middle of each realisation, in pixels
    void draw(Overlay& overlay,
              double metres_per_pixel,
              const std::vector<double>& label_places) const;

private:
    bool try_font(double size);
    double side_width() const;
    double side_height() const;
    void draw_side(Overlay& overlay) const;
    double draw_key(Overlay& overlay, double left, double top) const;
    double draw_scale(Overlay& overlay, const ColourScale& scale, double left, double top) const;
    void draw_foot(Overlay& overlay,
                   double metres_per_pixel,
                   const std::vector<double>& label_places) const;

    double line_height() const { return 1.5 * font_.size; }

    double bar_height() const { return 9.0 * line_height(); }

    Annotation annotation_;
    ImageSize size_;
    Font font_;
    Font bold_;
    Font title_font_;
    Frame frame_;
    bool is_empty_ = false;
};

/// The largest of 1, 2 and 5 times a power of ten that is not above a length, and how to write it:
/// "20 mm".
std::pair<double, std::string> round_length(double length);

/// A time with as many decimals as tell the frames of a run apart: "t = 0.40 s".
std::string time_text(double time, double interval);

}  // namespace grainbench::render
