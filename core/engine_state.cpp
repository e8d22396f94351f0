/// What an engine says of its state, and how it is saved and loaded.
#include "core/engine.hpp"

#include <algorithm>

namespace grainbench {

std::size_t Engine::contact_count() const {
    if (detection_.create_on_overlap) {
        return touching_count();
    }
    std::size_t count = pairs_.compute_object_count(particles_, *kernels_);
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        count += wall_contacts_[w].compute_object_count(particles_, walls_[w]);
    }
    return count;
}

std::size_t Engine::touching_count() const {
    std::size_t count = pairs_.touching().size();
    for (const WallContacts& contacts : wall_contacts_) {
        count += contacts.touching_count();
    }
    return count;
}

std::uint64_t Engine::late_count() const {
    std::uint64_t count = pairs_.late_count();
    for (const WallContacts& contacts : wall_contacts_) {
        count += contacts.late_count();
    }
    return count;
}

Vec3 Engine::full_velocity(Index slot) const {
    return particles_.velocity(slot) + 0.5 * timestep_ * body_.acceleration(particles_, slot);
}

Vec3 Engine::full_spin(Index slot) const {
    return particles_.spin(slot) + 0.5 * timestep_ * body_.angular_acceleration(particles_, slot);
}

Vec3 Engine::contact_force(Index slot) const {
    const bool weight_included = std::holds_alternative<ScaledTimestep>(scheme_);
    return weight_included ? particles_.force(slot) - particles_.mass(slot) * scene_gravity_
                           : particles_.force(slot);
}

double Engine::largest_overlap_ratio() const {
    double largest = 0.0;
    for (const TouchingContact contact : pairs_.touching()) {
        const Index i = pairs_.objects().i[contact.place()];
        const Index j = pairs_.objects().j[contact.place()];
        const double distance = norm(particles_.position(j) - particles_.position(i));
        const double smaller_radius = std::min(particles_.radius(i), particles_.radius(j));
        const double overlap = particles_.radius(i) + particles_.radius(j) - distance;
        largest = std::max(largest, overlap / smaller_radius);
    }
    for (const WallContacts& contacts : wall_contacts_) {
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            const double radius = particles_.radius(contacts.particle(t));
            largest = std::max(largest, (radius - contacts.distance(t)) / radius);
        }
    }
    return largest;
}

void Engine::save(Archive& archive) const {
    archive.put("engine/cycle", cycle_);
    archive.put("engine/numbers",
                std::vector<double>{time_,
                                    timestep_,
                                    stable_,
                                    bed_velocity_.x,
                                    bed_velocity_.y,
                                    bed_velocity_.z,
                                    bed_shift_.x,
                                    bed_shift_.y,
                                    bed_shift_.z,
                                    fastest_,
                                    0.0,  // older checkpoints have it by axis
                                    0.0,
                                    image_shift_.x,
                                    image_shift_.y,
                                    image_shift_.z,
                                    distance_when_sorted_});
    // Those of a cycle that left them for once are done with when it is saved; only the very first
    // state is looked at again after a restart. They are as much as all else together.
    const Records saved = keep_records_ || cycle_ == 0 ? has_records_ : Records::none;
    archive.put("engine/has_records", static_cast<std::uint64_t>(saved));
    particles_.save(archive);
    if (orientations_) {
        orientations_->save(archive);
    }
    driven_.save(archive);
    pairs_.save(archive, saved);
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        const std::string name = "wall-" + std::to_string(w + 1);
        walls_[w].save(archive, name);
        wall_contacts_[w].save(archive, name + "/contacts", saved);
    }
    if (ledger_) {
        ledger_->save(archive);
    }
    if (traffic_) {
        traffic_->save(archive);
    }
}

void Engine::load(const Archive& archive) {
    cycle_ = archive.count("engine/cycle");
    const auto& numbers = archive.get<double>("engine/numbers", 16);
    time_ = numbers[0];
    timestep_ = numbers[1];
    stable_ = numbers[2];
    bed_velocity_ = {numbers[3], numbers[4], numbers[5]};
    bed_shift_ = {numbers[6], numbers[7], numbers[8]};
    fastest_ = norm({numbers[9], numbers[10], numbers[11]});
    image_shift_ = {numbers[12], numbers[13], numbers[14]};
    distance_when_sorted_ = numbers[15];
    particles_.load(archive, changes_population_);
    if (orientations_) {
        orientations_->load(archive, particles_.size());
    }
    driven_.load(archive, particles_);
    const std::uint64_t saved = archive.count("engine/has_records");
    Archive::require(saved <= static_cast<std::uint64_t>(Records::stored_energy),
                     "engine/has_records");
    has_records_ = static_cast<Records>(saved);
    pairs_.load(archive, particles_, has_records_);
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        const std::string name = "wall-" + std::to_string(w + 1);
        walls_[w].load(archive, name);
        wall_contacts_[w].load(archive, name + "/contacts", particles_, walls_[w], has_records_);
    }
    if (ledger_) {
        ledger_->load(archive);
    }
    if (traffic_) {
        traffic_->load(archive);
    }
    const bool has_all = std::all_of(wall_contacts_.begin(),
                                     wall_contacts_.end(),
                                     [](const auto& wall) { return wall.has_all_records(); });
    Archive::require((pairs_.has_all_records() && has_all) || !(has_records() || keep_records_),
                     "pairs/records");
}

}  // namespace grainbench
