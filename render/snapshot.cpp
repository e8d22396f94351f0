#include "render/snapshot.hpp"

#include "core/error.hpp"

#include "io/json/field_writer.hpp"
#include "io/json/problems.hpp"
#include "io/text.hpp"
#include "io/vtk/session.hpp"

#include "render/annotation.hpp"
#include "render/camera_fit.hpp"
#include "render/offscreen.hpp"
#include "render/particle_view.hpp"
#include "render/run_frames.hpp"
#include "render/scene_view.hpp"
#include "render/trace_view.hpp"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace grainbench::render {
namespace {

namespace fs = std::filesystem;

constexpr double gap_between_realisations = 0.12;  // of the width of one

/// What stays the same for all frames of a run.
struct RunShape {
    std::vector<FitSphere> content;      ///< of all realisations, each at its own place
    std::vector<io::TraceTable> traces;  ///< empty if they are not drawn
};

/// The walls that the look names, in their order in the file.
std::vector<WallSurface> chosen_walls(const WallFrame& frame, const WallLook& look) {
    if (look.names.empty()) {
        return frame.walls;
    }
    std::vector<std::string_view> known;
    for (const WallSurface& wall : frame.walls) {
        known.push_back(wall.name);
    }
    for (const std::string& name : look.names) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            throw_bad_input({.what = fmt::format("the run has no wall '{}'", name),
                             .where = "/walls/names",
                             .likely_cause = "a slip of the keys, or a look for another scene",
                             .next_step = "choose from " + io::list_names(known)});
        }
    }
    std::vector<WallSurface> chosen;
    for (const WallSurface& wall : frame.walls) {
        if (std::find(look.names.begin(), look.names.end(), wall.name) != look.names.end()) {
            chosen.push_back(wall);
        }
    }
    return chosen;
}

/// The point itself, or where it comes to lie when the walls are cut.
Vec3 nearest_in(const std::optional<Box>& box, const Vec3& point) {
    return box ? Vec3{std::clamp(point.x, box->low.x, box->high.x),
                      std::clamp(point.y, box->low.y, box->high.y),
                      std::clamp(point.z, box->low.z, box->high.z)}
               : point;
}

void add_box(std::vector<FitSphere>& content, const Box& box) {
    for (int corner = 0; corner < 8; ++corner) {
        content.push_back({{(corner & 1) != 0 ? box.high.x : box.low.x,
                            (corner & 2) != 0 ? box.high.y : box.low.y,
                            (corner & 4) != 0 ? box.high.z : box.low.z},
                           0.0});
    }
}

/// All that the picture of an instant has to hold.
void add_instant(std::vector<FitSphere>& content,
                 const Instant& instant,
                 const ParticleView& view,
                 const Look& look) {
    for (std::size_t r = 0; r < instant.realisations.size(); ++r) {
        const Spheres& spheres = view.realisations.at(r);
        for (std::size_t k = 0; k < spheres.position.size(); ++k) {
            content.push_back({spheres.position[k], spheres.radius[k]});
        }
        if (look.walls) {
            for (const WallSurface& wall :
                 chosen_walls(instant.realisations[r].walls, *look.walls)) {
                for (const Vec3& point : wall.points) {
                    content.push_back({nearest_in(look.walls->region, point), 0.0});
                }
            }
        }
    }
}

double mean_radius(const ParticleView& view) {
    double sum = 0.0;
    double count = 0.0;
    for (const Spheres& spheres : view.realisations) {
        for (const double radius : spheres.radius) {
            sum += radius;
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : 1.0;
}

/// Averages squares of `factor` by `factor` pixels.
Image reduced(const Image& large, int factor) {
    const auto n = static_cast<std::size_t>(factor);
    Image small = blank_image({large.size.width / factor, large.size.height / factor}, 0);
    const auto width = static_cast<std::size_t>(small.size.width);
    const auto row_size = 3 * n * width;
    for (std::size_t y = 0; y < static_cast<std::size_t>(small.size.height); ++y) {
        for (std::size_t x = 0; x < 3 * width; ++x) {
            const std::size_t pixel = x / 3;
            const std::size_t colour = x % 3;
            unsigned sum = 0;
            for (std::size_t k = 0; k < n * n; ++k) {
                sum += large.rgb[(n * y + k / n) * row_size + 3 * (n * pixel + k % n) + colour];
            }
            small.rgb[y * 3 * width + x] = static_cast<std::uint8_t>((sum + n * n / 2) / (n * n));
        }
    }
    return small;
}

double median_interval(const std::vector<double>& times) {
    std::vector<double> intervals;
    for (std::size_t k = 1; k < times.size(); ++k) {
        intervals.push_back(times[k] - times[k - 1]);
    }
    if (intervals.empty()) {
        return 0.0;
    }
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    std::nth_element(intervals.begin(), middle, intervals.end());
    return *middle;
}

/// The look without what differs from machine to machine.
std::string look_text(const Look& look) {
    Look plain = look;
    plain.run.clear();
    plain.schema.clear();
    plain.times.clear();
    return io::write_value(plain).dump();
}

ImageText provenance_of(const Instant& instant,
                        const Look& look,
                        const std::string& program,
                        const std::string& gl_renderer) {
    const io::Provenance& first = instant.realisations.front().particles.provenance;
    std::string seeds;
    for (const RealisationInstant& realisation : instant.realisations) {
        const std::int64_t seed = realisation.particles.provenance.seed;
        seeds += fmt::format("{}{}", seeds.empty() ? "" : " ", seed);
    }
    return {{"Software", program},
            {"Simulated by", first.program},
            {"Scene", first.scene_title},
            {"Scene hash", first.scene_hash},
            {"Seed", seeds},
            {"Time [s]", io::to_text(instant.time)},
            {"Look", look_text(look)},
            {"GL renderer", gl_renderer}};
}

std::vector<std::string> labels_of(const Instant& instant) {
    std::vector<std::string> labels;
    for (const RealisationInstant& realisation : instant.realisations) {
        labels.push_back(fmt::format(
            "realisation {} (seed {})", realisation.number, realisation.particles.provenance.seed));
    }
    return labels;
}

}  // namespace

struct SnapshotPainter::Impl {
    RunFrames frames;
    Look look;
    std::string program;
    RunShape shape;
    Offscreen offscreen;

    Impl(const fs::path& run, Look chosen, std::string name)
        : frames(run, chosen.realisations), look(std::move(chosen)), program(std::move(name)) {
        if (look.traces) {
            shape.traces = frames.read_traces();
        }
        find_shape();
    }

    ParticleView particles_of(const Instant& instant) const {
        if (look.particles) {
            return view_particles(instant, *look.particles, frames.group_names());
        }
        ParticleView none;
        none.realisations.resize(instant.realisations.size());
        return none;
    }

    /// Looks at three frames and at all of the traces.
    void find_shape() {
        if (look.camera.fit) {
            add_box(shape.content, *look.camera.fit);
            return;
        }
        const std::size_t last = frames.times().size() - 1;
        for (const std::size_t frame : std::set<std::size_t>{0, last / 2, last}) {
            const Instant instant = frames.read(frame);
            add_instant(shape.content, instant, particles_of(instant), look);
        }
        for (const io::TraceTable& traces : shape.traces) {
            for (const TracePoint& point : traces.points) {
                shape.content.push_back({point.position, look.traces->radius});
            }
        }
    }

    Snapshot draw(std::size_t frame);
    void draw_realisations(vtkRenderer* renderer,
                           const Instant& instant,
                           const ParticleView& particles,
                           const std::optional<TraceView>& traces,
                           double line_width,
                           const std::vector<Vec3>& shifts) const;
    Annotation annotation_of(const Instant& instant,
                             const ParticleView& particles,
                             const std::optional<TraceView>& traces) const;
};

Annotation SnapshotPainter::Impl::annotation_of(const Instant& instant,
                                                const ParticleView& particles,
                                                const std::optional<TraceView>& traces) const {
    Annotation annotation{.title = look.title,
                          .time = {},
                          .key = {},
                          .scales = {},
                          .labels = {},
                          .has_scale_bar = look.scale_bar.has_value()};
    if (look.time_stamp) {
        annotation.time = time_text(instant.time, median_interval(frames.times()));
    }
    if (look.realisation_labels) {
        annotation.labels = labels_of(instant);
    }
    if (look.legend) {
        annotation.key = particles.key;
        if (particles.scale) {
            annotation.scales.push_back(*particles.scale);
        }
        if (traces) {
            annotation.scales.push_back(traces->scale);
        }
    }
    return annotation;
}

void SnapshotPainter::Impl::draw_realisations(vtkRenderer* renderer,
                                              const Instant& instant,
                                              const ParticleView& particles,
                                              const std::optional<TraceView>& traces,
                                              double line_width,
                                              const std::vector<Vec3>& shifts) const {
    for (std::size_t r = 0; r < shifts.size(); ++r) {
        add_spheres(renderer, particles.realisations[r], shifts[r]);
        if (traces) {
            add_traces(
                renderer, traces->paths[r], traces->colours[r], look.traces->radius, shifts[r]);
        }
    }
    for (std::size_t r = 0; look.walls && r < shifts.size(); ++r) {
        add_walls(renderer,
                  chosen_walls(instant.realisations[r].walls, *look.walls),
                  *look.walls,
                  look.background == Background::dark,
                  line_width,
                  shifts[r]);
    }
}

Snapshot SnapshotPainter::Impl::draw(std::size_t frame) {
    const Instant instant = frames.read(frame);
    const ParticleView particles = particles_of(instant);
    std::optional<TraceView> traces;
    if (look.traces) {
        traces = view_traces(shape.traces, *look.traces, instant.time);
    }

    std::vector<FitSphere> one = shape.content;
    if (!look.camera.fit) {
        add_instant(one, instant, particles, look);
    }
    // Side by side along the right of the picture, each where the widest would find place.
    const ViewAxes axes = view_axes(look.camera);
    double low = 0.0;
    double high = 0.0;
    for (const FitSphere& sphere : one) {
        const double place = dot(sphere.centre, axes.right);
        const bool is_first = &sphere == &one.front();
        low = is_first ? place - sphere.radius : std::min(low, place - sphere.radius);
        high = is_first ? place + sphere.radius : std::max(high, place + sphere.radius);
    }
    const double pitch = (1.0 + gap_between_realisations) * (high - low);
    std::vector<Vec3> shifts;
    std::vector<FitSphere> all;
    for (std::size_t r = 0; r < instant.realisations.size(); ++r) {
        shifts.push_back(pitch * static_cast<double>(r) * axes.right);
        for (const FitSphere& sphere : one) {
            all.push_back({sphere.centre + shifts.back(), sphere.radius});
        }
    }

    const int factor = look.anti_aliasing == AntiAliasing::supersampling ? 2 : 1;
    const ImageSize size{factor * static_cast<int>(look.width),
                         factor * static_cast<int>(look.height)};
    const io::VtkSession session;
    const AnnotationLayout annotation(annotation_of(instant, particles, traces),
                                      size,
                                      look.background == Background::dark,
                                      factor);
    const CameraPose pose = fit_camera(all, look.camera, size, annotation.frame());
    const double metres_per_pixel = 2.0 * pose.half_height / size.height;

    vtkNew<vtkRenderer> renderer;
    set_up(renderer, look, mean_radius(particles));
    const double line_width = std::max(1.0, size.height / 800.0);
    draw_realisations(renderer, instant, particles, traces, line_width, shifts);
    set_camera(renderer, pose, look.camera);
    std::vector<double> label_places;
    for (const Vec3& shift : shifts) {
        const Vec3 middle = pose.focus + (0.5 * (low + high) + dot(shift, axes.right) -
                                          dot(pose.focus, axes.right)) *
                                             axes.right;
        label_places.push_back(size.width * project(pose, look.camera, size, middle).x);
    }
    Overlay overlay(renderer);
    annotation.draw(overlay, metres_per_pixel, label_places);

    offscreen.window()->AddRenderer(renderer);
    Image image = offscreen.draw(size);
    offscreen.window()->RemoveRenderer(renderer);
    if (!session.error().empty()) {
        throw std::runtime_error("VTK could not draw: " + session.error());
    }
    if (factor > 1) {
        image = reduced(image, factor);
    }
    return {std::move(image), provenance_of(instant, look, program, offscreen.gl_renderer())};
}

SnapshotPainter::SnapshotPainter(const fs::path& run, Look look, std::string program)
    : impl_(std::make_unique<Impl>(run, std::move(look), std::move(program))) {}

SnapshotPainter::~SnapshotPainter() = default;

const std::vector<double>& SnapshotPainter::times() const {
    return impl_->frames.times();
}

std::size_t SnapshotPainter::nearest(double time) const {
    return impl_->frames.nearest(time);
}

Snapshot SnapshotPainter::draw(std::size_t frame) {
    return impl_->draw(frame);
}

bool run_has_layers(const fs::path& run) {
    return RunFrames(run, {}).has_layers();
}

void write_snapshot(const fs::path& run,
                    const Look& look,
                    double time,
                    const fs::path& png,
                    const std::string& program) {
    SnapshotPainter painter(run, look, program);
    const Snapshot snapshot = painter.draw(painter.nearest(time));
    write_png(png, snapshot.image, snapshot.text);
}

}  // namespace grainbench::render
