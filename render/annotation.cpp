#include "render/annotation.hpp"

#include "render/chart_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace grainbench::render {
namespace {

constexpr double font_share = 0.019;       // of the side of a square as large as the picture
constexpr double largest_share = 0.04;     // of width and of height
constexpr double usual_least_font = 10.0;  // pixels
constexpr double smallest_font = 7.0;      // pixels; less cannot be read
constexpr double least_side = 80.0;        // pixels; pictures below have no room for text
constexpr double largest_side = 0.38;      // of the picture's width, for legend and colour bars

std::vector<Colour> steps_of(ColourMap map) {
    constexpr int count = 128;
    std::vector<Colour> colours;
    for (int k = 0; k < count; ++k) {
        colours.push_back(map_colour(map, (k + 0.5) / count));
    }
    return colours;
}

/// 1, 2 or 5 times a power of ten, the largest that is not above `most`.
double round_down(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    const double lead = most / power * (1.0 + 1e-12);
    return (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0) * power;
}

std::vector<Tick> ticks_of(const ColourScale& scale) {
    constexpr int wanted = 5;
    return ticks_of(AxisRange{.low = scale.range.low, .high = scale.range.high}, wanted);
}

}  // namespace

std::pair<double, std::string> round_length(double length) {
    struct Unit {
        double size;
        const char* name;
    };

    constexpr std::array units{Unit{1e3, "km"}, Unit{1.0, "m"}, Unit{1e-3, "mm"}, Unit{1e-6, "um"}};
    const double round = round_down(length);
    const auto unit = std::find_if(
        units.begin(), units.end() - 1, [&](const Unit& u) { return round >= 0.999 * u.size; });
    return {round, fmt::format("{:.6g} {}", round / unit->size, unit->name)};
}

std::string time_text(double time, double interval) {
    int decimals = 0;
    for (double scaled = interval; decimals < 7; scaled *= 10.0, ++decimals) {
        if (scaled > 0.5 && std::abs(scaled - std::round(scaled)) < 0.02 * scaled) {
            break;
        }
    }
    return fmt::format("t = {:.{}f} s", time, interval > 0.0 ? decimals : 6);
}

AnnotationLayout::AnnotationLayout(Annotation annotation,
                                   ImageSize size,
                                   bool is_background_dark,
                                   int pixel_scale)
    : annotation_(std::move(annotation)), size_(size) {
    const Colour ink = is_background_dark ? colour_of(0xE8E8E8) : colour_of(0x202020);
    font_.colour = ink;
    bold_ = font_;
    bold_.is_bold = true;
    title_font_ = bold_;
    const double width = size.width;
    const double height = size.height;
    double font_size =
        std::min(font_share * std::sqrt(width * height), largest_share * std::min(width, height));
    font_size = std::max(pixel_scale * usual_least_font, std::round(font_size));
    if (std::min(width, height) < pixel_scale * least_side) {
        font_size = 0.0;  // no room for text that can be read
    }
    while (font_size >= pixel_scale * smallest_font && !try_font(font_size)) {
        font_size -= 1.0;
    }
    if (font_size < pixel_scale * smallest_font) {
        is_empty_ = true;
        frame_ = {0.01, 0.99, 0.01, 0.99};
    }
}

bool AnnotationLayout::try_font(double size) {
    font_.size = size;
    bold_.size = size;
    title_font_.size = std::round(1.3 * size);
    const double margin = size;
    const double width = size_.width;
    const double height = size_.height;
    double top = height - margin;
    if (!annotation_.title.empty()) {
        const TextExtent title = extent_of(annotation_.title, title_font_);
        if (title.width + 2.0 * margin > width) {
            return false;
        }
        top -= title.height + margin;
    }
    double bottom = margin;
    if (annotation_.has_scale_bar || !annotation_.time.empty()) {
        bottom += 2.0 * line_height();
    }
    if (!annotation_.labels.empty()) {
        bottom += line_height();
    }
    double right = width - margin;
    if (const double side = side_width(); side > 0.0) {
        right -= side + margin;
        if (side > largest_side * width || side_height() > top - margin) {
            return false;
        }
    }
    // Labels stand beside each other, each below its realisation.
    double widest = 0.0;
    for (const std::string& label : annotation_.labels) {
        widest = std::max(widest, extent_of(label, font_).width + size);
    }
    if (widest * static_cast<double>(annotation_.labels.size()) > right - margin) {
        return false;
    }
    frame_ = {margin / width, right / width, bottom / height, top / height};
    return frame_.top - frame_.bottom > 0.4 && frame_.right - frame_.left > 0.4;
}

double AnnotationLayout::side_width() const {
    double width = 0.0;
    if (annotation_.key) {
        width = extent_of(annotation_.key->title, bold_).width;
        for (const auto& entry : annotation_.key->entries) {
            width = std::max(width, 1.6 * font_.size + extent_of(entry.first, font_).width);
        }
    }
    for (const ColourScale& scale : annotation_.scales) {
        width = std::max(width, extent_of(scale.title, bold_).width);
        for (const Tick& tick : ticks_of(scale)) {
            width = std::max(width, 2.2 * font_.size + extent_of(tick.label, font_).width);
        }
    }
    return width;
}

double AnnotationLayout::side_height() const {
    double lines = 0.0;
    if (annotation_.key) {
        lines += 2.0 + static_cast<double>(annotation_.key->entries.size());
    }
    lines += 2.5 * static_cast<double>(annotation_.scales.size());
    return lines * line_height() + bar_height() * static_cast<double>(annotation_.scales.size());
}

void AnnotationLayout::draw(Overlay& overlay,
                            double metres_per_pixel,
                            const std::vector<double>& label_places) const {
    if (is_empty_) {
        return;
    }
    if (!annotation_.title.empty()) {
        const double middle = 0.5 * (frame_.left + frame_.right) * size_.width;
        const double width = extent_of(annotation_.title, title_font_).width;
        // Over the particles, but never out of the picture.
        const double place =
            std::clamp(middle, 0.5 * width + font_.size, size_.width - 0.5 * width - font_.size);
        overlay.add_text(annotation_.title,
                         title_font_,
                         place,
                         size_.height - font_.size - 1.2 * title_font_.size,
                         Justify::centre);
    }
    draw_side(overlay);
    draw_foot(overlay, metres_per_pixel, label_places);
}

void AnnotationLayout::draw_side(Overlay& overlay) const {
    const double left = frame_.right * size_.width + font_.size;
    const double room = frame_.top * size_.height;
    // In the middle of the height, beside the particles.
    const double middle = 0.5 * (frame_.top + frame_.bottom) * size_.height;
    double top = std::min(room, middle + 0.5 * side_height());
    if (annotation_.key) {
        top = draw_key(overlay, left, top);
    }
    for (const ColourScale& scale : annotation_.scales) {
        top = draw_scale(overlay, scale, left, top);
    }
}

double AnnotationLayout::draw_key(Overlay& overlay, double left, double top) const {
    double bottom = top - line_height();
    overlay.add_text(annotation_.key->title, bold_, left, bottom, Justify::left);
    const double side = std::round(0.9 * font_.size);
    for (const auto& [name, colour] : annotation_.key->entries) {
        bottom -= line_height();
        overlay.add_box(left, std::round(bottom), side, side, colour);
        overlay.add_text(name, font_, left + 1.6 * font_.size, bottom, Justify::left);
    }
    return bottom - line_height();
}

double AnnotationLayout::draw_scale(Overlay& overlay,
                                    const ColourScale& scale,
                                    double left,
                                    double top) const {
    const double title_bottom = top - line_height();
    overlay.add_text(scale.title, bold_, left, title_bottom, Justify::left);
    const double bottom = title_bottom - 0.5 * line_height() - bar_height();
    const double width = 1.2 * font_.size;
    overlay.add_ladder(left, bottom, width, bar_height(), steps_of(scale.map));
    for (const Tick& tick : ticks_of(scale)) {
        const double y = bottom + bar_height() * fraction_in(scale.range, tick.place);
        overlay.add_box(
            left + width, y, 0.5 * font_.size, std::max(1.0, 0.08 * font_.size), font_.colour);
        overlay.add_text(
            tick.label, font_, left + 2.2 * font_.size, y - 0.5 * font_.size, Justify::left);
    }
    return bottom - line_height();
}

void AnnotationLayout::draw_foot(Overlay& overlay,
                                 double metres_per_pixel,
                                 const std::vector<double>& label_places) const {
    const double left = frame_.left * size_.width;
    const double right = frame_.right * size_.width;
    overlay.add_text(annotation_.time, font_, left, font_.size, Justify::left);
    if (annotation_.has_scale_bar) {
        const double longest = 0.2 * (right - left);
        const auto [length, text] = round_length(longest * metres_per_pixel);
        const double width = length / metres_per_pixel;
        const double thickness = std::max(1.0, std::round(0.18 * font_.size));
        const double bar_bottom = font_.size + line_height();
        overlay.add_box(right - width, bar_bottom, width, thickness, font_.colour);
        overlay.add_text(text, font_, right - 0.5 * width, font_.size, Justify::centre);
    }
    const bool has_line_below = annotation_.has_scale_bar || !annotation_.time.empty();
    const double label_bottom = font_.size + (has_line_below ? 2.0 * line_height() : 0.0);
    for (std::size_t k = 0; k < annotation_.labels.size(); ++k) {
        overlay.add_text(
            annotation_.labels[k], font_, label_places.at(k), label_bottom, Justify::centre);
    }
}

}  // namespace grainbench::render
