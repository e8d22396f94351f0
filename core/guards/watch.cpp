#include "core/guards/watch.hpp"

#include "core/guards/suspect.hpp"
#include "core/integrate/small_motions.hpp"
#include "core/walls/bounds.hpp"

#include <algorithm>

namespace grainbench {

namespace {

/// Part of the excess of energy that is forgiven at each look.
constexpr double forgiven = 0.02;

/// Part of the turnover that is remembered from look to look.
constexpr double remembered = 0.9;

/// Sum of speeds and places, in SI, that nothing granular reaches.
constexpr double beyond_measure = 1e30;

/// Numbers that wall_load_ keeps of each wall.
constexpr std::size_t load_size = 6;

bool is_closed(const WallShape& shape) {
    return std::visit(
        Overloaded{[](const BoxShape&) { return true; },
                   [](const Cylinder& c) { return c.part == CylinderPart::all; },
                   [](const FacetedCylinder& c) { return c.part == CylinderPart::all; },
                   [](const auto&) { return false; }},
        shape);
}

bool is_within(const Vec3& p, const Vec3& low, const Vec3& high, double margin) {
    return p.x >= low.x - margin && p.x <= high.x + margin && p.y >= low.y - margin &&
           p.y <= high.y + margin && p.z >= low.z - margin && p.z <= high.z + margin;
}

void put_text(Archive& archive, const std::string& name, const std::string& text) {
    archive.put(name, std::vector<std::uint8_t>(text.begin(), text.end()));
}

std::string text_in(const Archive& archive, const std::string& name) {
    const auto& bytes = archive.get<std::uint8_t>(name);
    return {bytes.begin(), bytes.end()};
}

/// Of the fastest particle in the full step, by energy.
std::optional<Index> most_energetic(const Engine& engine) {
    std::optional<Index> found;
    double most = -1.0;
    for (Index slot = 0; slot < engine.particles().size(); ++slot) {
        if (engine.particles().is_driven(slot)) {
            continue;
        }
        const Vec3 v = engine.particles().velocity(slot);
        const double energy = dot(v, v) / engine.particles().inverse_mass(slot);
        if (energy > most) {
            most = energy;
            found = slot;
        }
    }
    return found;
}

/// Deepest contact: the particle, and its overlap over the smaller radius.
std::pair<Index, double> deepest_contact(const Engine& engine) {
    const ParticleState& particles = engine.particles();
    Index deepest = 0;
    double largest = 0.0;
    const auto offer = [&](Index slot, double ratio) {
        if (ratio > largest) {
            largest = ratio;
            deepest = slot;
        }
    };
    for (const TouchingContact contact : engine.pairs().touching()) {
        const Index i = engine.pairs().objects().i[contact.place()];
        const Index j = engine.pairs().objects().j[contact.place()];
        const bool i_is_smaller = particles.radius(i) < particles.radius(j);
        const double overlap = particles.radius(i) + particles.radius(j) -
                               norm(particles.position(j) - particles.position(i));
        offer(i_is_smaller ? i : particles.owner(j),
              overlap / std::min(particles.radius(i), particles.radius(j)));
    }
    for (const WallContacts& contacts : engine.wall_contacts()) {
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            const double radius = particles.radius(contacts.particle(t));
            offer(contacts.particle(t), (radius - contacts.distance(t)) / radius);
        }
    }
    return {deepest, largest};
}

}  // namespace

GuardWatch::GuardWatch(const Scene& scene, Engine& engine)
    : guards_(scene.guards),
      population_changes_(population_changes(scene)),
      gravity_(scene.gravity.value_or(Vec3{})) {
    for (const Species& species : scene.particles.species) {
        density_.push_back(species.density);
    }
    const ParticleState& particles = engine.particles();
    double mass = 0.0;
    for (Index slot = 0; slot < particles.size(); ++slot) {
        mass += particles.mass(slot);
        origin_ += (1.0 / particles.size()) * particles.position(slot);
    }
    // At rest springs exchange as little with gravity; and round-off of potential energies.
    least_energy_ = 1e-5 * mass * norm(gravity_) * particles.smallest_radius();
    wall_load_.resize(load_size * (scene.walls.size() + engine.driven().names().size()));
    lost_.resize(particles.size());
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        Hold hold{.wall = w, .is_plane = false, .low = {}, .high = {}, .side = {}};
        if (const auto* plane = std::get_if<Plane>(&scene.walls[w].shape)) {
            hold.is_plane = true;
            hold.low = plane->point;
            hold.high = normalized(plane->normal);
        } else if (is_closed(scene.walls[w].shape)) {
            Bounds bounds;
            for (const Vec3& point : engine.walls()[w].surface().outline().points) {
                bounds.include(point);
            }
            hold.low = bounds.low;
            hold.high = bounds.high;
        } else {
            continue;
        }
        hold.side.resize(particles.size());
        for (Index slot = 0; slot < particles.size(); ++slot) {
            hold.side[static_cast<std::size_t>(particles.id(slot) - 1)] =
                side_of(hold, particles.position(slot));
        }
        holds_.push_back(std::move(hold));
    }
    if (watches_energy(engine)) {
        engine.want_stored_energies();
    }
}

std::int8_t GuardWatch::side_of(const Hold& hold, const Vec3& position) const {
    if (hold.is_plane) {
        return dot(position - hold.low, hold.high) < 0.0 ? -1 : 1;
    }
    return is_within(position, hold.low, hold.high, 0.0) ? 1 : 0;
}

/// What newcomers bring belongs to the budget, what leavers take does not. Energy of springs that
/// go with a leaver is left out: they are few, and the excess of one is forgiven.
void GuardWatch::change_population(const Engine& engine, const PopulationChange& change) {
    const ParticleState& particles = engine.particles();
    const std::size_t known = lost_.size();
    lost_.resize(static_cast<std::size_t>(particles.last_id()));
    for (Hold& hold : holds_) {
        hold.side.resize(lost_.size());
        for (Index slot = 0; slot < particles.size(); ++slot) {
            const auto at = static_cast<std::size_t>(particles.id(slot) - 1);
            if (at >= known) {
                const Vec3 here = engine.walls()[hold.wall].to_wall(particles.position(slot));
                hold.side[at] = side_of(hold, here);
            }
        }
    }
    const auto add = [&](const Sphere& sphere, double sign) {
        const double mass = sphere_mass(density_[sphere.species], sphere.radius);
        const double spin = norm(sphere.angular_velocity) * sphere.radius;
        const double fall = -mass * dot(gravity_, sphere.position - origin_);
        budget_ +=
            sign * (0.5 * mass * (dot(sphere.velocity, sphere.velocity) + 0.4 * spin * spin));
        budget_ += sign * fall;
        potential_ += sign * fall;
    };
    for (const Sphere& sphere : change.newcomers) {
        add(sphere, 1.0);
    }
    for (const Sphere& sphere : change.leavers) {
        add(sphere, -1.0);
    }
}

bool GuardWatch::watches_energy(const Engine& engine) const {
    return guards_.energy.action != GuardAction::ignore &&
           !std::holds_alternative<ScaledTimestep>(engine.scheme());
}

void GuardWatch::before_step(Engine& engine) const {
    if (is_due(engine.cycle() + 1) && watches_energy(engine)) {
        engine.want_stored_energies();
    }
}

void GuardWatch::after_step(Engine& engine) {
    check_travel(engine);
    add_wall_work(engine);
    way_ += engine.travel();
    if (way_ > 0.5 * guards_.overlap.bound * engine.particles().smallest_radius()) {
        check_overlap(engine);
    }
    check_timestep(engine);
    if (is_due(engine.cycle())) {
        look(engine);
        if (engine.has_stored_energies() && watches_energy(engine)) {
            check_energy(engine);
        }
        // At these cycles alone, so that when checkpoints are written does not change a run.
        if (guards_.lost.action == LostAction::remove) {
            check_lost(engine);
        }
    }
}

void GuardWatch::look(const Engine& engine) {
    check_finite(engine);
    check_overlap(engine);
    check_late(engine);
    if (guards_.lost.action != LostAction::remove) {
        check_lost(engine);
    }
    if (!has_budget_ && engine.has_stored_energies() && watches_energy(engine)) {
        check_energy(engine);
    }
}

void GuardWatch::act(GuardAction action,
                     const Engine& engine,
                     Diagnosis diagnosis,
                     std::string& warning) {
    diagnosis = blame_step_or(engine, std::move(diagnosis));
    if (action == GuardAction::stop) {
        throw Error(ErrorKind::unstable, std::move(diagnosis));
    }
    if (warning.empty()) {
        warning =
            diagnosis.what + " (" + diagnosis.where + "); likely cause: " + diagnosis.likely_cause;
    }
}

void GuardWatch::check_travel(const Engine& engine) {
    const double limit = guards_.speed.bound * engine.particles().smallest_radius();
    // The bound of all particles and walls together is nearly always enough.
    if (!(engine.travel() > limit) || guards_.speed.action == GuardAction::ignore ||
        engine.particles().size() == 0) {
        return;
    }
    const auto tell = [&](const std::string& who, double way, std::optional<Index> slot) {
        act(guards_.speed.action,
            engine,
            {.what = who + " moved by " + text_of(way / engine.particles().smallest_radius()) +
                     " of the smallest radius in one cycle, relative to the bed",
             .where = circumstances(engine, slot),
             .likely_cause = "the step is too long for this speed: bodies may pass through each "
                             "other unseen",
             .next_step = "set /timestep to a step below " +
                          text_of(engine.timestep() * limit / way) +
                          " s, or to automatic, which heeds speeds"},
            speed_warning_);
    };
    for (Index slot = 0; slot < engine.particles().size(); ++slot) {
        const double way =
            norm(engine.particles().velocity(slot) - engine.bed_velocity()) * engine.timestep();
        if (!(way <= limit)) {
            tell(name_of(engine, slot), way, slot);
            return;
        }
    }
    for (const WallBody& wall : engine.walls()) {
        const double way =
            wall.relative_speed_bound(0.0, engine.bed_velocity()) * engine.timestep();
        if (std::isfinite(way) && way > limit) {
            tell("wall '" + wall.name() + "'", way, std::nullopt);
            return;
        }
    }
}

void GuardWatch::add_wall_work(const Engine& engine) {
    for (std::size_t w = 0; w < engine.walls().size(); ++w) {
        const WallBody& wall = engine.walls()[w];
        if (!wall.moves()) {
            continue;
        }
        const WallContacts& contacts = engine.wall_contacts()[w];
        const WallVelocity& velocity = wall.velocity();
        const bool turns = norm(velocity.angular) > 0.0;
        Vec3 force{};
        Vec3 torque{};
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            force += contacts.force(t);
            if (turns) {
                torque += cross(contacts.point(engine.particles(), t) - wall.rotation_centre(),
                                contacts.force(t));
            }
        }
        add_work(w, {.force = force, .torque = torque, .velocity = velocity}, engine.timestep());
    }
    for (std::size_t n = 0; engine.driven().is_active() && n < engine.driven().size(); ++n) {
        add_work(engine.walls().size() + n, engine.driven_load(n), engine.timestep());
    }
}

/// \param place in wall_load_
void GuardWatch::add_work(std::size_t place, const GroupLoad& load, double timestep) {
    double* before = wall_load_.data() + load_size * place;
    const Vec3 force = 0.5 * (load.force + Vec3{before[0], before[1], before[2]});
    const Vec3 torque = 0.5 * (load.torque + Vec3{before[3], before[4], before[5]});
    supplied_ -= (dot(force, load.velocity.linear) + dot(torque, load.velocity.angular)) * timestep;
    std::copy_n(
        std::array{
            load.force.x, load.force.y, load.force.z, load.torque.x, load.torque.y, load.torque.z}
            .data(),
        load_size,
        before);
}

void GuardWatch::check_finite(const Engine& engine) const {
    const ParticleState& particles = engine.particles();
    Vec3 sum{};
    for (Index slot = 0; slot < particles.size(); ++slot) {
        sum += particles.velocity(slot) + particles.position(slot) + particles.spin(slot);
    }
    if (!is_finite(sum) || !(norm(sum) < beyond_measure)) {
        throw_runaway(engine);
    }
}

/// Looks at the estimate where the step was not chosen by it, and at the motions themselves where
/// the estimate says so, now and then, in the first cycles of a stage, and again where they grew.
void GuardWatch::check_timestep(Engine& engine) {
    if (guards_.timestep.action == GuardAction::ignore ||
        std::holds_alternative<ScaledTimestep>(engine.scheme())) {
        return;
    }
    bool is_suspect = early_looks_ > 0 || engine.cycle() % long_interval == 0 ||
                      (grows_ && is_due(engine.cycle()));
    early_looks_ -= early_looks_ > 0 ? 1 : 0;
    const auto* automatic = std::get_if<AutomaticTimestep>(&engine.scheme());
    const bool is_chosen =
        automatic != nullptr && automatic->safety_factor <= std::min(guards_.timestep.bound, 1.0);
    if (!is_chosen && engine.cycle() % (2 * interval) == 0) {
        is_suspect = check_estimate(engine) > 1.0 || is_suspect;
    }
    if (is_suspect) {
        check_growth(engine);
    }
}

/// The step over its estimate [1].
double GuardWatch::check_estimate(Engine& engine) {
    const double limit = engine.compute_touching_limit();
    const double ratio = engine.timestep() / limit;
    if (ratio > guards_.timestep.bound) {
        act(guards_.timestep.action,
            engine,
            {.what = "the step is " + text_of(ratio) + " times the estimated stable one, " +
                     text_of(limit) + " s",
             .where = circumstances(engine, std::nullopt),
             .likely_cause = "a particle has more contacts, or stiffer ones, than the step was "
                             "chosen for",
             .next_step = "leave out /timestep to have it chosen, or set it to " +
                          text_of(guards_.timestep.bound * limit) + " s or less"},
            timestep_warning_);
    }
    return ratio;
}

void GuardWatch::check_growth(const Engine& engine) {
    const double growth = engine.compute_growth(engine.timestep());
    const bool grew = std::exchange(grows_, growth > SmallMotions::least_growth);
    if (!grows_ || !grew) {
        return;  // or it is but the moment in which many meet
    }
    // An undamped mode of frequency w grows by g where (w dt)^2 = 2 + g + 1/g.
    const double critical = 2.0 * engine.timestep() / std::sqrt(2.0 + growth + 1.0 / growth);
    act(guards_.timestep.action,
        engine,
        {.what = "small motions grow by " + text_of(growth) +
                 " per cycle: the step is above the critical one of what touches, some " +
                 text_of(critical) + " s",
         .where = circumstances(engine, std::nullopt),
         .likely_cause = "a particle has more contacts, or stiffer ones, or stronger dashpots, "
                         "than the step was chosen for",
         .next_step =
             "set /timestep to less than " + text_of(critical) + " s, or lower its safety factor"},
        timestep_warning_);
}

void GuardWatch::check_overlap(const Engine& engine) {
    way_ = 0.0;
    if (guards_.overlap.action == GuardAction::ignore ||
        engine.largest_overlap_ratio() <= guards_.overlap.bound) {
        return;
    }
    const auto [slot, ratio] = deepest_contact(engine);
    const double stiffer = ratio / (0.1 * guards_.overlap.bound);
    act(guards_.overlap.action,
        engine,
        {.what = name_of(engine, slot) + " overlaps by " + text_of(ratio) +
                 " of the smaller radius, beyond " + text_of(guards_.overlap.bound),
         .where = circumstances(engine, slot),
         .likely_cause = "contacts too soft for their load or for the speed of impacts, or spheres "
                         "that overlapped from the start",
         .next_step = "make /contact/stiffness some " + text_of(stiffer * stiffer) +
                      " times stiffer, or part the spheres; /guards/overlap/bound allows more"},
        overlap_warning_);
}

void GuardWatch::check_late(const Engine& engine) {
    if (guards_.late_contacts.action != GuardAction::stop ||
        engine.late_count() <= static_cast<std::uint64_t>(guards_.late_contacts.bound)) {
        return;
    }
    std::string unused;
    act(GuardAction::stop,
        engine,
        {.what = std::to_string(engine.late_count()) +
                 " contacts were found when they already overlapped, more than " +
                 std::to_string(guards_.late_contacts.bound),
         .where = circumstances(engine, std::nullopt),
         .likely_cause = "too many cycles between two searches for this speed",
         .next_step = "set /detection/trigger to displacement, or fewer cycles"},
        unused);
}

bool GuardWatch::is_lost(const Engine& engine, Index slot) const {
    const ParticleState& particles = engine.particles();
    const Vec3 p = particles.position(slot);
    const double radius = particles.radius(slot);
    if (guards_.lost.domain &&
        !is_within(p, guards_.lost.domain->low, guards_.lost.domain->high, 0.0)) {
        return true;
    }
    const auto at = static_cast<std::size_t>(particles.id(slot) - 1);
    return std::any_of(holds_.begin(), holds_.end(), [&](const Hold& hold) {
        const std::int8_t side = hold.side[at];
        if (side == 0) {
            return false;
        }
        const Vec3 here = engine.walls()[hold.wall].to_wall(p);
        return hold.is_plane ? side * dot(here - hold.low, hold.high) < -radius
                             : !is_within(here, hold.low, hold.high, radius);
    });
}

void GuardWatch::check_lost(const Engine& engine) {
    if (guards_.lost.action == LostAction::ignore || (holds_.empty() && !guards_.lost.domain)) {
        return;
    }
    for (Index slot = 0; slot < engine.particles().size(); ++slot) {
        std::uint8_t& lost = lost_[static_cast<std::size_t>(engine.particles().id(slot) - 1)];
        if (lost != 0 || !is_lost(engine, slot)) {
            continue;
        }
        lost = 1;
        ++lost_count_;
        if (guards_.lost.action == LostAction::remove) {
            leaving_.push_back(slot);
        } else if (guards_.lost.action == LostAction::stop) {
            std::string unused;
            act(GuardAction::stop,
                engine,
                {.what = name_of(engine, slot) + " has left the domain, or the wall that held it",
                 .where = circumstances(engine, slot),
                 .likely_cause = "a contact so soft, or a step so long, that it passed through a "
                                 "wall; or a domain that is too small",
                 .next_step = "stiffen /contact/stiffness, shorten the step, or widen "
                              "/guards/lost/domain"},
                unused);
        }
    }
}

GuardWatch::Energy GuardWatch::energy_of(const Engine& engine) const {
    const ParticleState& particles = engine.particles();
    const auto [translation, rotation] =
        kinetic_energies(particles, engine.body(), engine.timestep());
    Energy energy{.motion = translation + rotation, .potential = 0.0};
    for (Index slot = 0; slot < particles.size(); ++slot) {
        if (!particles.is_driven(slot)) {
            energy.potential -=
                particles.mass(slot) * dot(gravity_, particles.unwrapped(slot) - origin_);
        }
    }
    for (Index t = 0; t < engine.pairs().touching().size(); ++t) {
        energy.motion += engine.pairs().stored_energy(t);
    }
    for (const WallContacts& contacts : engine.wall_contacts()) {
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            energy.motion += contacts.stored_energy(t);
        }
    }
    return energy;
}

void GuardWatch::check_energy(const Engine& engine) {
    if (!(engine.gravity() == gravity_)) {
        gravity_ = engine.gravity();  // of a stage: potentials are others, the budget starts anew
        has_budget_ = false;
    }
    const Energy now = energy_of(engine);
    const double total = now.motion + now.potential;
    if (!has_budget_) {
        has_budget_ = true;
        budget_ = total;
        turnover_ = 0.0;
    } else {
        budget_ += supplied_;
        turnover_ =
            remembered * turnover_ + std::abs(supplied_) + std::abs(now.potential - potential_);
    }
    supplied_ = 0.0;
    potential_ = now.potential;
    const double excess = total - budget_;
    budget_ += excess < 0.0 ? excess : forgiven * excess;
    if (now.motion < least_energy_ || excess <= guards_.energy.bound * (now.motion + turnover_)) {
        return;
    }
    const std::optional<Index> suspect = most_energetic(engine);
    act(guards_.energy.action,
        engine,
        {.what = text_of(excess) + " J of the " + text_of(now.motion) +
                 " J in motion came neither from walls nor from gravity; most moves " +
                 (suspect ? name_of(engine, *suspect) : ""),
         .where = circumstances(engine, suspect),
         .likely_cause = "the timestep is above the stable one, or contacts were found late",
         .next_step = "lower the timestep or its safety factor, and look for contacts more often"},
        energy_warning_);
}

std::vector<std::string> GuardWatch::warnings(const Engine& engine) const {
    std::vector<std::string> all;
    for (const std::string* one :
         {&overlap_warning_, &speed_warning_, &timestep_warning_, &energy_warning_}) {
        if (!one->empty()) {
            all.push_back(*one);
        }
    }
    if (guards_.late_contacts.action == GuardAction::warn &&
        engine.late_count() > static_cast<std::uint64_t>(guards_.late_contacts.bound)) {
        all.push_back(std::to_string(engine.late_count()) +
                      " contacts were found when they already overlapped; a displacement trigger "
                      "finds all in time");
    }
    if (lost_count_ > 0) {
        all.push_back(std::to_string(lost_count_) +
                      " particles left the domain, or the wall that held them" +
                      (guards_.lost.action == LostAction::remove ? ", and were deleted" : ""));
    }
    return all;
}

void GuardWatch::save(Archive& archive) const {
    archive.put("guards/numbers",
                std::vector<double>{has_budget_ ? 1.0 : 0.0,
                                    budget_,
                                    supplied_,
                                    turnover_,
                                    potential_,
                                    way_,
                                    grows_ ? 1.0 : 0.0,
                                    gravity_.x,
                                    gravity_.y,
                                    gravity_.z});
    archive.put("guards/early_looks", early_looks_);
    archive.put("guards/wall_load", wall_load_);
    archive.put("guards/lost", lost_);
    for (std::size_t h = 0; h < holds_.size() && population_changes_; ++h) {
        const std::vector<std::int8_t>& side = holds_[h].side;
        archive.put("guards/side-" + std::to_string(h + 1),
                    std::vector<std::uint8_t>(side.begin(), side.end()));
    }
    archive.put("guards/lost_count", lost_count_);
    put_text(archive, "guards/overlap_warning", overlap_warning_);
    put_text(archive, "guards/speed_warning", speed_warning_);
    put_text(archive, "guards/timestep_warning", timestep_warning_);
    put_text(archive, "guards/energy_warning", energy_warning_);
}

void GuardWatch::load(const Archive& archive) {
    const auto& numbers = archive.get<double>("guards/numbers", 10);
    has_budget_ = numbers[0] != 0.0;
    budget_ = numbers[1];
    supplied_ = numbers[2];
    turnover_ = numbers[3];
    potential_ = numbers[4];
    way_ = numbers[5];
    grows_ = numbers[6] != 0.0;
    gravity_ = {numbers[7], numbers[8], numbers[9]};
    early_looks_ = archive.count("guards/early_looks");
    wall_load_ = archive.get<double>("guards/wall_load", wall_load_.size());
    lost_ = population_changes_ ? archive.get<std::uint8_t>("guards/lost")
                                : archive.get<std::uint8_t>("guards/lost", lost_.size());
    for (std::size_t h = 0; h < holds_.size() && population_changes_; ++h) {
        const auto& side =
            archive.get<std::uint8_t>("guards/side-" + std::to_string(h + 1), lost_.size());
        holds_[h].side.assign(side.begin(), side.end());
    }
    lost_count_ = archive.count("guards/lost_count");
    overlap_warning_ = text_in(archive, "guards/overlap_warning");
    speed_warning_ = text_in(archive, "guards/speed_warning");
    timestep_warning_ = text_in(archive, "guards/timestep_warning");
    energy_warning_ = text_in(archive, "guards/energy_warning");
}

}  // namespace grainbench
