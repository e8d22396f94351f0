#include "core/integrate/stable_step.hpp"

#include <algorithm>
#include <limits>

namespace grainbench {

namespace {

/// (1) from the largest of k/m and kappa/I [1/s^2].
double step_of(double largest_ratio) {
    return largest_ratio > 0.0 ? 1.0 / std::sqrt(largest_ratio)
                               : std::numeric_limits<double>::infinity();
}

/// Largest of k/m and kappa/I [1/s^2] of a particle of inverse mass and sums of K_s n^2, K_s and
/// K_n n^2 (2).
double largest_ratio(double inverse_mass,
                     const double* shear,
                     const double* normal,
                     double rolling,
                     double twisting) {
    double turning = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        turning =
            std::max(turning, (1.0 + rolling) * (shear[3] - shear[axis]) + twisting * shear[axis]);
    }
    double largest = 2.5 * inverse_mass * turning;
    for (int axis = 0; axis < 3 && normal != nullptr; ++axis) {
        largest = std::max(largest, inverse_mass * (normal[axis] + (shear[3] - shear[axis])));
    }
    return largest;
}

struct Rows {
    std::size_t first, last;
};

/// Calls act(slab, rows) for all slabs; the last has the rows that pad the columns, and images.
template <class Act>
void for_each_slab(const ParticleState& particles, const Workers& workers, const Act& act) {
    const std::size_t count = std::max<std::size_t>(particles.slab_count(), 1);
    const std::size_t rows = particles.positions().size() / 4;
    const std::size_t size = particles.slab_size();
    workers.for_each(count, [&](std::size_t slab) {
        act(slab, Rows{slab * size, slab + 1 == count ? rows : (slab + 1) * size});
    });
}

}  // namespace

void StableStep::clear(const ParticleState& particles,
                       bool rotation_rules,
                       double rolling,
                       double twisting,
                       const Workers& workers) {
    rolling_ = rolling;
    twisting_ = twisting;
    const std::size_t size = particles.positions().size();
    const std::size_t normal_size = rotation_rules ? 0 : size;
    if (are_zero_ && shear_.size() == size && normal_.size() == normal_size) {
        return;
    }
    shear_.resize(size);
    normal_.resize(normal_size);
    for_each_slab(particles, workers, [&](std::size_t, Rows rows) {
        std::fill(shear_.begin() + 4 * rows.first, shear_.begin() + 4 * rows.last, 0.0);
        if (!rotation_rules) {
            std::fill(normal_.begin() + 4 * rows.first, normal_.begin() + 4 * rows.last, 0.0);
        }
    });
}

void StableStep::fold_images(const ParticleState& particles) {
    for (Index row = particles.size(); row < particles.row_count(); ++row) {
        for (Column<double>* column : {&shear_, &normal_}) {
            for (std::size_t c = 0; c < 4 && !column->empty(); ++c) {
                double& of_image = (*column)[4 * std::size_t{row} + c];
                (*column)[4 * std::size_t{particles.owner(row)} + c] += of_image;
                of_image = 0.0;
            }
        }
    }
}

StepSums StableStep::sums() {
    return {shear_.data(), normal_.empty() ? nullptr : normal_.data(), rolling_, twisting_};
}

double StableStep::limit(ParticleState& particles,
                         bool keeps,
                         const Kernels& kernels,
                         const Workers& workers) {
    const ParticleView all = particles.view();
    largest_.assign(std::max<std::size_t>(particles.slab_count(), 1), 0.0);
    for_each_slab(particles, workers, [&](std::size_t slab, Rows rows) {
        ParticleView part = all;
        part.velocity += 4 * rows.first;
        part.padded_count = rows.last - rows.first;
        StepSums of_part = sums();
        of_part.shear += 4 * rows.first;
        of_part.normal += of_part.normal == nullptr ? 0 : 4 * rows.first;
        largest_[slab] = kernels.largest_step_ratio(part, of_part, !keeps);
    });
    are_zero_ = !keeps;
    return step_of(*std::max_element(largest_.begin(), largest_.end()));
}

double StableStep::limit_of(const ParticleState& particles, Index slot) const {
    const std::size_t at = 4 * std::size_t{slot};
    return step_of(largest_ratio(particles.inverse_mass(slot),
                                 shear_.data() + at,
                                 normal_.empty() ? nullptr : normal_.data() + at,
                                 rolling_,
                                 twisting_));
}

double StableStep::single_contact_limit(const ParticleState& particles,
                                        const ContactTable& table,
                                        Index material_count) {
    double smallest = std::numeric_limits<double>::infinity();
    for (Index slot = 0; slot < particles.size(); ++slot) {
        for (Index material = 0; material < material_count; ++material) {
            const StepStiffness k = table.step_stiffness(
                particles.species(slot), material, particles.radius(slot), 0.0);
            const double shear[4] = {0.0, 0.0, k.shear, k.shear};
            const double normal[4] = {0.0, 0.0, k.normal, 0.0};
            smallest = std::min(smallest,
                                step_of(largest_ratio(particles.inverse_mass(slot),
                                                      shear,
                                                      normal,
                                                      table.rolling_ratio(),
                                                      table.twisting_ratio())));
        }
    }
    return smallest;
}

double kinematic_limit(const ParticleState& particles, const BodyForces& body, double tolerance) {
    double smallest = std::numeric_limits<double>::infinity();
    for (Index slot = 0; slot < particles.size(); ++slot) {
        const double epsilon = tolerance * particles.radius(slot);
        const Vec3 v = particles.velocity(slot);
        const Vec3 a = body.acceleration(particles, slot);
        const double speeds[3] = {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
        const double accelerations[3] = {std::abs(a.x), std::abs(a.y), std::abs(a.z)};
        for (int axis = 0; axis < 3; ++axis) {
            const double root =
                std::sqrt(speeds[axis] * speeds[axis] + 2.0 * accelerations[axis] * epsilon);
            if (root > 0.0) {
                smallest = std::min(smallest, 2.0 * epsilon / (speeds[axis] + root));
            }
        }
    }
    return smallest;
}

}  // namespace grainbench
