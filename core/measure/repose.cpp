#include "core/measure/repose.hpp"

#include <map>

namespace grainbench {

namespace {

/// Any horizontal direction.
Vec3 across(const Vec3& up) {
    return normalized(cross(up, std::abs(up.x) < 0.5 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0}));
}

struct Line {
    double slope;     ///< [1]
    double residual;  ///< [m] root mean square
};

/// Least squares through points (s, h), about their means: heights may be far from 0.
Line fit(const std::vector<std::pair<double, double>>& points) {
    const auto count = static_cast<double>(points.size());
    double mean_s = 0.0;
    double mean_h = 0.0;
    for (const auto& [s, h] : points) {
        mean_s += s / count;
        mean_h += h / count;
    }
    double ss = 0.0;
    double sh = 0.0;
    for (const auto& [s, h] : points) {
        ss += (s - mean_s) * (s - mean_s);
        sh += (s - mean_s) * (h - mean_h);
    }
    Line line{.slope = ratio(sh, ss), .residual = 0.0};
    for (const auto& [s, h] : points) {
        const double left = h - mean_h - line.slope * (s - mean_s);
        line.residual += left * left / count;
    }
    line.residual = std::sqrt(line.residual);
    return line;
}

}  // namespace

Repose::Repose(const ReposeObservable& wanted, const Vec3& up)
    : wanted_(wanted), up_(up), x_(across(up)) {
    if (const auto* slope = std::get_if<SlopeSurface>(&wanted_.surface)) {
        x_ = normalized(slope->along - dot(slope->along, up) * up);
        from_ = slope->from;
        to_ = slope->to;
    } else {
        const auto& heap = std::get<HeapSurface>(wanted_.surface);
        from_ = heap.inner;
        to_ = heap.outer;
    }
    y_ = cross(up_, x_);
}

Repose::Place Repose::place_of(const Vec3& position) const {
    Place place{.along = dot(position, x_),
                .height = dot(position, up_),
                .x = dot(position, x_),
                .y = dot(position, y_)};
    if (const auto* heap = std::get_if<HeapSurface>(&wanted_.surface)) {
        const Vec3 apart = position - heap->centre;
        place.along = norm(apart - dot(apart, up_) * up_);
    }
    return place;
}

void Repose::name_columns(std::vector<HistoryColumn>& columns) const {
    columns.push_back(
        {wanted_.name + ".angle", "degree", "of the free surface against the horizontal"});
    columns.push_back(
        {wanted_.name + ".residual", "m", "root mean square of the heights about the fit"});
}

void Repose::append_row(const MeasureView& view, std::vector<double>& row) const {
    std::map<std::pair<double, double>, Place> highest;
    for (Index slot = 0; slot < view.particles.size(); ++slot) {
        const Place place = place_of(view.position(slot));
        if (place.along < from_ || place.along > to_) {
            continue;
        }
        const auto [column, is_new] = highest.try_emplace(
            {std::floor(place.x / wanted_.cell), std::floor(place.y / wanted_.cell)}, place);
        if (!is_new && place.height > column->second.height) {
            column->second = place;
        }
    }
    std::vector<std::pair<double, double>> points;
    for (const auto& [column, place] : highest) {
        points.emplace_back(place.along, place.height);
    }
    if (points.size() < 3) {
        row.insert(row.end(), 2, std::numeric_limits<double>::quiet_NaN());
        return;
    }
    const Line line = fit(points);
    const bool falls = std::holds_alternative<HeapSurface>(wanted_.surface);
    row.push_back((falls ? -1.0 : 1.0) * std::atan(line.slope) * 180.0 / pi);  // (1)
    row.push_back(line.residual);
}

}  // namespace grainbench
