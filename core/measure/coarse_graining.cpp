#include "core/measure/coarse_graining.hpp"

#include "core/measure/contact_loads.hpp"
#include "core/measure/smoothing_kernel.hpp"

#include <algorithm>

namespace grainbench {

namespace {

Tensor outer(const Vec3& a, const Vec3& b) {
    return {a.x * b.x,
            a.x * b.y,
            a.x * b.z,
            a.y * b.x,
            a.y * b.y,
            a.y * b.z,
            a.z * b.x,
            a.z * b.y,
            a.z * b.z};
}

void add(Tensor& sum, double factor, const Tensor& part) {
    for (std::size_t k = 0; k < sum.size(); ++k) {
        sum[k] += factor * part[k];
    }
}

double trace(const Tensor& a) {
    return a[0] + a[4] + a[8];
}

/// Places [first, last) along one axis.
struct Range {
    Index first, last;
};

class Grid {
public:
    explicit Grid(const CoarseGrainingObservable& wanted) : low_(wanted.box.low) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            counts[axis] = static_cast<Index>(wanted.counts[axis]);
        }
        const Vec3 edge = wanted.box.high - wanted.box.low;
        spacing = {edge.x / counts[0], edge.y / counts[1], edge.z / counts[2]};
    }

    std::size_t size() const { return std::size_t{counts[0]} * counts[1] * counts[2]; }

    /// Calls visit(cell, centre) for the cells whose centre is in a box.
    template <class Visit>
    void for_each_in(const Vec3& low, const Vec3& high, Visit&& visit) const {
        const Range x = range(low.x - low_.x, high.x - low_.x, spacing.x, counts[0]);
        const Range y = range(low.y - low_.y, high.y - low_.y, spacing.y, counts[1]);
        const Range z = range(low.z - low_.z, high.z - low_.z, spacing.z, counts[2]);
        for (Index k = z.first; k < z.last; ++k) {
            for (Index j = y.first; j < y.last; ++j) {
                const std::size_t row = (std::size_t{k} * counts[1] + j) * counts[0];
                for (Index i = x.first; i < x.last; ++i) {
                    visit(row + i,
                          Vec3{low_.x + (i + 0.5) * spacing.x,
                               low_.y + (j + 0.5) * spacing.y,
                               low_.z + (k + 0.5) * spacing.z});
                }
            }
        }
    }

    std::array<Index, 3> counts{};
    Vec3 spacing{};  ///< [m]

private:
    static Range range(double low, double high, double spacing, Index count) {
        const double first = std::ceil(low / spacing - 0.5);
        const double last = std::floor(high / spacing - 0.5) + 1.0;
        const auto within = [&](double place) {
            return static_cast<Index>(std::clamp(place, 0.0, static_cast<double>(count)));
        };
        return {within(first), within(last)};
    }

    Vec3 low_;
};

Vec3 mean_velocity(const MeasureView& view) {
    Vec3 momentum{};
    double mass = 0.0;
    for (Index slot = 0; slot < view.particles.size(); ++slot) {
        momentum += view.particles.mass(slot) * view.full_velocity(slot);
        mass += view.particles.mass(slot);
    }
    return mass > 0.0 ? (1.0 / mass) * momentum : Vec3{};
}

/// Where a body is seen that reaches so far: where it stands, and beyond the periodic ends that are
/// near.
std::vector<Vec3> sights(const MeasureView& view, Index slot, double reach) {
    std::vector<Vec3> shifts;
    const Vec3 centre = view.position(slot);
    view.particles.box().collect_shifts(centre, reach, shifts);
    std::vector<Vec3> places{centre};
    for (const Vec3& shift : shifts) {
        places.push_back(centre + shift);
    }
    return places;
}

/// Sums over particles: density, solid fraction, momentum, and m v v as the kinetic stress, with
/// velocities against `mean`.
void add_particles(const MeasureView& view,
                   const SmoothingKernel& kernel,
                   const Grid& grid,
                   const Vec3& mean,
                   FieldFrame& frame) {
    const Vec3 reach{kernel.reach(), kernel.reach(), kernel.reach()};
    for (const Index slot : view.particles.slots_by_id()) {
        const double mass = view.particles.mass(slot);
        const double radius = view.particles.radius(slot);
        const double volume = 4.0 / 3.0 * pi * radius * radius * radius;
        const Vec3 velocity = view.full_velocity(slot) - mean;
        const Tensor flux = outer(mass * velocity, velocity);
        for (const Vec3& at : sights(view, slot, kernel.reach())) {
            grid.for_each_in(at - reach, at + reach, [&](std::size_t cell, const Vec3& centre) {
                const double phi = kernel.at(dot(centre - at, centre - at));
                frame.density[cell] += mass * phi;  // (1)
                frame.solid_fraction[cell] += volume * phi;
                frame.velocity[cell] += (mass * phi) * velocity;
                add(frame.kinetic_stress[cell], phi, flux);
            });
        }
    }
}

void add_contacts(const MeasureView& view,
                  const SmoothingKernel& kernel,
                  const Grid& grid,
                  FieldFrame& frame) {
    const Vec3 reach{kernel.reach(), kernel.reach(), kernel.reach()};
    for_each_contact(view, [&](const ContactLoad& contact) {
        const double length = norm(contact.branch);
        if (length == 0.0) {
            return;
        }
        const Vec3 way = (1.0 / length) * contact.branch;
        const Tensor stress = outer(contact.force, way);  // the length cancels that of the integral
        for (const Vec3& start : sights(view, contact.i, kernel.reach() + length)) {
            const Vec3 end = start + contact.branch;
            const Vec3 low{
                std::min(start.x, end.x), std::min(start.y, end.y), std::min(start.z, end.z)};
            const Vec3 high{
                std::max(start.x, end.x), std::max(start.y, end.y), std::max(start.z, end.z)};
            grid.for_each_in(low - reach, high + reach, [&](std::size_t cell, const Vec3& centre) {
                const Vec3 apart = centre - start;
                const double along = dot(apart, way);
                const Vec3 off = apart - along * way;
                add(frame.contact_stress[cell],
                    kernel.along_line(dot(off, off), -along, length - along),
                    stress);  // (5)
            });
        }
    });
}

/// From sums to fields.
void finish(const Vec3& mean, FieldFrame& frame) {
    for (std::size_t cell = 0; cell < frame.density.size(); ++cell) {
        const double density = frame.density[cell];
        Vec3& velocity = frame.velocity[cell];
        if (density > 0.0) {
            velocity = (1.0 / density) * velocity;                                 // (2)
            add(frame.kinetic_stress[cell], -density, outer(velocity, velocity));  // (3)
            velocity += mean;
            frame.granular_temperature[cell] =
                std::max(0.0, trace(frame.kinetic_stress[cell]) / (3.0 * density));  // (4)
        }
        frame.pressure[cell] =
            (trace(frame.contact_stress[cell]) + trace(frame.kinetic_stress[cell])) / 3.0;  // (6)
    }
}

}  // namespace

FieldFrame coarse_grain(const CoarseGrainingObservable& wanted, const MeasureView& view) {
    const SmoothingKernel kernel(wanted.kernel, wanted.reach);
    const Grid grid(wanted);
    FieldFrame frame;
    frame.low = wanted.box.low;
    frame.spacing = grid.spacing;
    frame.counts = grid.counts;
    frame.density.resize(grid.size());
    frame.solid_fraction.resize(grid.size());
    frame.velocity.resize(grid.size());
    frame.granular_temperature.resize(grid.size());
    frame.pressure.resize(grid.size());
    frame.contact_stress.resize(grid.size());
    frame.kinetic_stress.resize(grid.size());
    const Vec3 mean = mean_velocity(view);
    add_particles(view, kernel, grid, mean, frame);
    add_contacts(view, kernel, grid, frame);
    finish(mean, frame);
    return frame;
}

}  // namespace grainbench
