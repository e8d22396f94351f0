#include "core/engine.hpp"

#include "core/guards/suspect.hpp"
#include "core/integrate/small_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainbench {

namespace {

std::vector<double> densities(const Scene& scene) {
    std::vector<double> density;
    for (const Species& species : scene.particles.species) {
        density.push_back(species.density);
    }
    return density;
}

std::vector<double> radii_of_sources(const Scene& scene) {
    std::vector<double> radii;
    for (const Source& source : scene.particles.sources) {
        for (const Species& species : scene.particles.species) {
            if (species.name == source.species) {
                radii.push_back(species.radius);
            }
        }
    }
    return radii;
}

/// Reach of lists of contact objects where particles are fast, over the radius
/// (share/doc/performance.md): lists that reach farther last longer, and more is tested in each
/// step.
constexpr double widest_reach = 0.16;

/// Travel that candidate lists allow, over the smallest radius, where particles are slow and where
/// they are fast: from a scan of the shaken bed of the example (share/doc/performance.md): longer
/// lists cost more per renewal, shorter ones age.
constexpr double slack_per_radius = 0.5;
constexpr double widest_slack_per_radius = 0.7;

/// The same where directions are periodic: the farther lists reach, the wider a box must be, and
/// the more images there are.
constexpr double slack_per_radius_of_images = 0.25;

/// [s] Step where nothing limits it, because there is no particle: walls move on, and frames come
/// at their times.
constexpr double unlimited_timestep = 1e-3;

/// The same for walls, whose lists are short and dear to build.
constexpr double wall_slack_per_radius = 1.5;

/// Way of one cycle, over the largest radius, after which no grid could hold the particles [1].
constexpr double hopeless_travel = 1e6;

/// Particles from which on slots are sorted anew: with fewer, what a step touches stays in the
/// cache.
constexpr Index scattered_from = 4096;

/// Growth of the mean distance of slots in contact after which they are sorted anew
/// (share/doc/performance.md).
constexpr double scattered_by = 1.5;

/// Cycles after which the stable step looks again at overlaps that grow: a contact takes ten or
/// more from its first touch to half its depth, which the expected impact covers meanwhile.
constexpr std::uint64_t cycles_of_stiffening = 16;

/// Where the cycles between searches are given, and where images are made as far as lists reach,
/// the tolerance alone says how far that is.
SearchSettings search_settings(const Scene& scene,
                               const ParticleState& particles,
                               bool brute_force) {
    const double slack = scene.periodic ? slack_per_radius_of_images : slack_per_radius;
    const auto* remap = std::get_if<RemapInterval>(&scene.detection.trigger);
    const bool is_exact = remap != nullptr || brute_force || scene.periodic;
    return {.tolerance = scene.detection.tolerance,
            .widest = is_exact ? 0.0 : widest_reach,
            .slack = slack * particles.smallest_radius(),
            .widest_slack = is_exact ? 0.0 : widest_slack_per_radius * particles.smallest_radius(),
            .interval = remap != nullptr ? remap->cycles : 0,
            .brute_force = brute_force};
}

bool writes_orientations(const Scene& scene) {
    return scene.output.orientation ||
           std::any_of(scene.stages.begin(), scene.stages.end(), [](const Stage& stage) {
               return stage.output && stage.output->orientation;
           });
}

std::vector<WallBody> build_walls(const Scene& scene, const Materials& materials) {
    std::vector<WallBody> walls;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        walls.emplace_back(scene.walls[w],
                           "/walls/" + std::to_string(w),
                           materials.index_of(scene.walls[w].material_name()));
    }
    return walls;
}

}  // namespace

Engine::Engine(const Scene& scene, std::uint64_t seed, const SimulationOptions& options)
    : kernels_(&kernels_for(options.reference ? "scalar" : options.isa)),
      materials_(scene),
      contact_(scene.contact),
      table_(scene.contact, materials_),
      scheme_(scene.timestep),
      detection_(scene.detection),
      scene_gravity_(scene.gravity.value_or(Vec3{})),
      keep_records_(scene.observables.energy.has_value()),
      walls_(build_walls(scene, materials_)),
      changes_population_(population_changes(scene)) {
    std::vector<Surface> surfaces;
    for (const WallBody& wall : walls_) {
        surfaces.push_back(wall.surface());
    }
    InsertionResult inserted = insert_particles(scene, surfaces, seed);
    insertion_reports_ = std::move(inserted.reports);
    particles_ = ParticleState(inserted.spheres, densities(scene), radii_of_sources(scene));
    if (Traffic::is_in(scene)) {
        traffic_.emplace(scene, seed);
    }
    SearchSettings settings = search_settings(scene, particles_, options.reference);
    pairs_ = PairContacts(settings, table_.history_size());
    if (scene.periodic) {
        make_periodic(*scene.periodic, options.reference);
    }
    settings.slack = wall_slack_per_radius * particles_.smallest_radius();
    settings.widest_slack = 0.0;
    wall_contacts_.assign(walls_.size(), WallContacts(settings, table_.history_size()));
    if (scene.local_damping) {
        body_.local_damping = scene.local_damping->coefficient;
    }
    driven_ = DrivenGroups(scene, particles_);
    for (const DrivenGroup& group : scene.driven) {
        driven_.drive(group, 0.0, particles_);
    }
    if (particles_.slab_count() > 1) {
        workers_ = Workers(options.threads);
    }
    if (writes_orientations(scene)) {
        orientations_.emplace(particles_.size());
    }
    if (scene.observables.energy) {
        ledger_ = std::make_unique<EnergyLedger>();
    }
    measure_bed();
}

/// Mean motion of the bed, and the largest speed relative to it, as they are now.
void Engine::measure_bed() {
    bed_velocity_ = {};
    fastest_ = 0.0;
    for (Index slot = 0; slot < particles_.size(); ++slot) {
        bed_velocity_ += particles_.velocity(slot);
    }
    bed_velocity_ = (1.0 / std::max<double>(particles_.size(), 1.0)) * bed_velocity_;
    for (Index slot = 0; slot < particles_.size(); ++slot) {
        fastest_ = std::max(fastest_, norm(particles_.velocity(slot) - bed_velocity_));
    }
}

void Engine::make_periodic(const Periodic& periodic, bool is_reference) {
    particles_.make_periodic(PeriodicBox(periodic));
    const double reach = pairs_.candidate_reach(particles_);
    image_margin_ = reach;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double period = particles_.box().period(axis);
        if (period > 0.0 && !(period > 2.0 * reach)) {
            throw_bad_input(
                {.what = "the scene repeats itself after " + text_of(period) +
                         " m, where contacts are looked for up to " + text_of(reach) + " m away",
                 .where = std::string("/periodic/") + "xyz"[axis],
                 .likely_cause = "the interval is not much wider than a particle",
                 .next_step = "widen the interval to more than " + text_of(2.0 * reach) + " m"});
        }
        // The reference engine looks at all images, near or not.
        image_margin_ = is_reference ? std::max(image_margin_, period) : image_margin_;
    }
}

bool Engine::renumbers() const {
    return changes_population_ || particles_.size() >= scattered_from;
}

void Engine::begin_stage(const Stage& stage) {
    for (const StageMotion& change : stage.motions) {
        for (WallBody& wall : walls_) {
            if (wall.name() == change.wall) {
                wall.set_motion(change.motion, time_);
            }
        }
    }
    if (stage.contact) {
        contact_ = *stage.contact;
        const ContactTable next(contact_, materials_);
        const std::vector<int> sources = history_sources(table_, next);
        torques_wait_ = torques_wait_ || (started_ && table_.exerts_torques());
        pairs_.change_history(sources);
        for (WallContacts& contacts : wall_contacts_) {
            contacts.change_history(sources);
        }
        table_ = next;
    }
    change_drives(stage);
    if (stage.local_damping) {
        body_.local_damping = stage.local_damping->coefficient;
    }
    if (stage.gravity) {
        change_gravity(*stage.gravity);
    }
    if (stage.timestep) {
        change_scheme(*stage.timestep);
    }
    // Where inertia is scaled, gravity must pull at the real mass: it joins the forces.
    body_.gravity = std::holds_alternative<ScaledTimestep>(scheme_) ? Vec3{} : scene_gravity_;
    table_.expect_impacts(1.0);
    single_contact_ = StableStep::single_contact_limit(particles_, table_, materials_.count());
    if (!started_) {
        started_ = true;
        for (WallBody& wall : walls_) {
            wall.begin_step(time_);
        }
        find_contacts();
        add_forces(0.0);
        if (ledger_) {
            ledger_->start(ledger_view(), 0.0);
        }
    } else if (looks_ahead()) {
        pairs_.look_ahead(particles_, table_.reach(), *kernels_, workers_);
        look_ahead_to_walls();
    } else {
        for (WallContacts& contacts : wall_contacts_) {
            contacts.end_look_ahead();
        }
    }
    update_stable_step();
}

void Engine::change_drives(const Stage& stage) {
    if (stage.driven.empty() && stage.released.empty()) {
        return;
    }
    if (started_ && ledger_) {
        ledger_->begin_exchange(ledger_view(), timestep_);
    }
    for (const std::string& name : stage.released) {
        driven_.release(name, body_.gravity, timestep_, particles_);
    }
    for (const DrivenGroup& group : stage.driven) {
        driven_.drive(group, time_, particles_);
    }
    if (!started_) {
        return;
    }
    pairs_.expire(particles_);
    for (WallContacts& contacts : wall_contacts_) {
        contacts.expire(particles_);
    }
    if (ledger_) {
        ledger_->end_exchange(ledger_view(), timestep_);
    }
}

GroupLoad Engine::driven_load(std::size_t n) const {
    const bool weight_included = std::holds_alternative<ScaledTimestep>(scheme_);
    return driven_.load(n, particles_, weight_included ? scene_gravity_ : Vec3{});
}

void Engine::change_gravity(const Vec3& next) {
    const Vec3 change = next - scene_gravity_;
    scene_gravity_ = next;
    if (started_ && std::holds_alternative<ScaledTimestep>(scheme_)) {
        particles_.add_weight(change);  // among the forces that wait for their second half kick
    } else if (started_ && ledger_) {
        ledger_->change_gravity(particles_, change);
    }
}

void Engine::change_scheme(const Timestep& next) {
    const bool was_scaled = std::holds_alternative<ScaledTimestep>(scheme_);
    const bool is_scaled = std::holds_alternative<ScaledTimestep>(next);
    scheme_ = next;
    if (!started_ || was_scaled == is_scaled) {
        return;
    }
    // The forces of the last step wait for their second half kick: weight is among them exactly
    // where inertia is scaled.
    particles_.add_weight(is_scaled ? scene_gravity_ : -scene_gravity_);
    if (was_scaled) {
        for (Index slot = 0; slot < particles_.size(); ++slot) {
            particles_.scale_inertia(slot, 1.0);
        }
    }
}

/// Square of the speed of a particle that has fallen its diameter [(m/s)^2].
double Engine::fall_square() const {
    return 4.0 * norm(scene_gravity_) * particles_.smallest_radius();
}

/// Twice the fastest particle, or a wall against it, and what falling its diameter adds.
double Engine::impact_speed() const {
    double speed = 2.0 * fastest_;
    for (const WallBody& wall : walls_) {
        speed = std::max(speed, wall.relative_speed_bound(fastest_, bed_velocity_));
    }
    return std::max(std::sqrt(speed * speed + fall_square()), 1e-6);
}

void Engine::step() {
    enter(Phase::timestep);
    const double timestep = choose_timestep();
    for (WallBody& wall : walls_) {
        wall.begin_step(time_);
    }
    if (driven_.is_active()) {
        driven_.begin_step(time_, timestep, particles_);
    }
    if (ledger_) {
        enter(Phase::output);
        ledger_->begin_step(ledger_view(), timestep_, timestep);
    }
    enter(Phase::integration);
    move(timestep);
    if (orientations_) {
        orientations_->advance(particles_, timestep);
    }
    find_contacts();
    add_forces(timestep);
    enter(Phase::output);
    if (ledger_) {
        ledger_->end_step(ledger_view(), timestep);
    }
    population_change_.reset();
    if (traffic_ && Traffic::is_due(cycle_)) {
        if (auto change = traffic_->next_change(particles_, walls_, time_)) {
            exchange(std::move(*change));
        }
    }
    if (wants_sorting_) {
        wants_sorting_ = false;
        if (!population_change_) {  // after which the next search will ask again
            sort_slots();
        }
    }
}

void Engine::remove(std::span<const Index> slots) {
    exchange(particles_.departure_of(slots));
}

/// Lets particles come and go. Contacts of those that stay last; what newcomers may touch is looked
/// for before the next forces.
void Engine::exchange(PopulationChange change) {
    population_change_ = std::move(change);
    if (ledger_) {
        ledger_->begin_exchange(ledger_view(), timestep_);
    }
    renumber(*population_change_);
    measure_bed();
    single_contact_ = StableStep::single_contact_limit(particles_, table_, materials_.count());
    if (ledger_) {
        ledger_->end_exchange(ledger_view(), timestep_);
    }
}

void Engine::sort_slots() {
    population_change_ = particles_.spatial_order();
    renumber(*population_change_);
    distance_when_sorted_ = 0.0;
}

void Engine::renumber(const PopulationChange& change) {
    pairs_.forget_images(particles_);
    particles_.change_population(change);
    driven_.change_population(change);
    if (orientations_) {
        orientations_->change_population(change);
    }
    pairs_.change_population(change, particles_, table_);
    for (WallContacts& contacts : wall_contacts_) {
        contacts.change_population(change, particles_);
    }
}

/// Whether particles that are near each other have come to lie so far apart in memory that sorting
/// pays. Small scenes stay in the cache anyway.
bool Engine::is_scattered() {
    if (particles_.size() < scattered_from) {
        return false;
    }
    const double distance = pairs_.mean_slot_distance();
    if (distance_when_sorted_ == 0.0) {
        distance_when_sorted_ = distance;
    }
    return distance > scattered_by * distance_when_sorted_;
}

double Engine::choose_timestep() const {
    if (const auto* fixed = std::get_if<FixedTimestep>(&scheme_)) {
        return fixed->value;
    }
    if (const auto* scaled = std::get_if<ScaledTimestep>(&scheme_)) {
        return scaled->value;
    }
    const auto& automatic = std::get<AutomaticTimestep>(scheme_);
    double timestep = automatic.safety_factor * stable_;
    if (timestep_ > 0.0) {
        timestep = std::min(timestep, automatic.growth * timestep_);
    }
    // A particle in free flight must meet its first contact at a step that this contact can bear.
    // Only contacts created on overlap come unannounced: there the step grows until something
    // touches.
    const double single_contact = single_contact_ * table_.step_of_impact();
    if (!detection_.create_on_overlap || timestep_ == 0.0) {
        timestep = std::min(timestep, automatic.safety_factor * single_contact);
    }
    timestep = std::min(timestep, automatic.maximum.value_or(timestep));
    // The kinematic limit can only bind where a particle nearly crosses its tolerance in a step.
    const double epsilon = detection_.tolerance * particles_.smallest_radius();
    const double fastest = fastest_ + norm(bed_velocity_);
    if (timestep_ == 0.0 || 2.0 * fastest * timestep > epsilon ||
        timestep > automatic.safety_factor * single_contact) {
        timestep = std::min(timestep, kinematic_limit(particles_, body_, detection_.tolerance));
    }
    return std::isfinite(timestep) ? timestep : unlimited_timestep;
}

/// Kicks and drifts all particles, slab by slab; sums over slabs are in their order.
MotionPass Engine::move_particles(double timestep) {
    const MotionPass all{.particles = particles_.view(),
                         .gravity = {body_.gravity.x, body_.gravity.y, body_.gravity.z, 0.0},
                         .frame = {bed_velocity_.x, bed_velocity_.y, bed_velocity_.z, 0.0},
                         .kick = 0.5 * (timestep_ + timestep),
                         .drift = timestep,
                         .local_damping = body_.local_damping,
                         .few_are_loaded = few_are_loaded(),
                         .first = 0,
                         .last = particles_.size(),
                         .fastest_square = 0.0,
                         .velocity_sum = {}};
    const std::size_t size = particles_.slab_size();
    const auto kernel = body_.local_damping > 0.0                  ? kernels_->move_damped
                        : table_.exerts_torques() || torques_wait_ ? kernels_->move
                                                                   : kernels_->move_straight;
    torques_wait_ = false;
    move_parts_.assign(particles_.slab_count(), all);
    workers_.for_each(move_parts_.size(), [&](std::size_t slab) {
        MotionPass& part = move_parts_[slab];
        part.first = slab * size;
        part.last = std::min<std::size_t>((slab + 1) * size, particles_.size());
        kernel(part);
    });
    MotionPass sum = all;
    for (const MotionPass& part : move_parts_) {
        sum.fastest_square = std::max(sum.fastest_square, part.fastest_square);
        for (int axis = 0; axis < 3; ++axis) {
            sum.velocity_sum[axis] += part.velocity_sum[axis];
        }
    }
    return sum;
}

void Engine::move(double timestep) {
    const MotionPass pass = move_particles(timestep);
    fastest_ = std::sqrt(pass.fastest_square);
    if (driven_.is_active()) {
        fastest_ = driven_.end_move(bed_velocity_, fastest_, particles_);
    }
    travel_ = fastest_ * timestep;
    const double fall = std::sqrt(fall_square()) * timestep;
    pairs_.add_travel(travel_, fall);
    bed_shift_ += timestep * bed_velocity_;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        const double travel = walls_[w].relative_speed_bound(fastest_, bed_velocity_) * timestep;
        wall_contacts_[w].add_travel(travel, fall);
        travel_ = std::isfinite(travel) ? std::max(travel_, travel) : travel_;
        walls_[w].move(timestep);
    }
    time_ += timestep;
    timestep_ = timestep;
    ++cycle_;
    const Vec3 sum{pass.velocity_sum[0], pass.velocity_sum[1], pass.velocity_sum[2]};
    if (!is_finite(sum) ||
        !(fastest_ * timestep <= hopeless_travel * particles_.largest_radius())) {
        throw_runaway(*this);
    }
    bed_velocity_ = (1.0 / std::max<double>(particles_.size(), 1.0)) * sum;
}

/// Whether most particles are in free flight: then their forces need not be looked at.
bool Engine::few_are_loaded() const {
    if (std::holds_alternative<ScaledTimestep>(scheme_)) {
        return false;
    }
    std::size_t most = 2 * pairs_.touching().size();
    for (const WallContacts& contacts : wall_contacts_) {
        most += contacts.touching_count();
    }
    return 2 * most < particles_.size();
}

void Engine::find_contacts() {
    enter(Phase::detection);
    const bool is_stale = table_.stiffens() && cycle_ % cycles_of_stiffening == 0;
    const bool may_renew = !looks_ahead() || is_stale || look_ahead_is_due();
    if (particles_.has_images()) {
        particles_.move_images();
    }
    if (has_left_its_period()) {
        pairs_.expire(particles_);
    }
    Renewal renewal = pairs_.due(cycle_, may_renew, particles_, bed_shift_, *kernels_);
    if (renewal == Renewal::candidates && particles_.box().is_periodic()) {
        renew_images();
    }
    pairs_.renew(renewal, cycle_, particles_, bed_shift_, *kernels_);
    wants_sorting_ = renewal == Renewal::candidates && is_scattered();
    enter(Phase::walls);
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        renewal = std::min(renewal,
                           wall_contacts_[w].update(
                               cycle_, may_renew, particles_, walls_[w], *kernels_, workers_));
    }
    enter(Phase::detection);
    const bool is_due = is_stale || renewal != Renewal::none;
    const bool is_look_ahead = is_due && looks_ahead();
    bool changed =
        pairs_.find_touching(particles_, table_.reach(), is_look_ahead, *kernels_, workers_);
    enter(Phase::walls);
    if (is_look_ahead) {
        look_ahead_to_walls();
    }
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        changed = wall_contacts_[w].find_touching(
                      particles_, walls_[w], table_.reach(), *kernels_, workers_) ||
                  changed;
    }
    if (detection_.create_on_overlap ? changed || is_stale : is_due) {
        update_stable_step();
    }
}

bool Engine::look_ahead_is_due() const {
    return pairs_.look_ahead_is_due() ||
           std::any_of(wall_contacts_.begin(),
                       wall_contacts_.end(),
                       [](const WallContacts& contacts) { return contacts.look_ahead_is_due(); });
}

void Engine::look_ahead_to_walls() {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        wall_contacts_[w].look_ahead(particles_, walls_[w], table_.reach(), *kernels_, workers_);
    }
}

/// Whether the bed as a whole has moved so far along a periodic direction that its particles should
/// be put back: lists go by motion relative to the bed and would never ask for it.
bool Engine::has_left_its_period() const {
    if (!particles_.box().is_periodic()) {
        return false;
    }
    const Vec3 way = bed_shift_ - image_shift_;
    const double along[3] = {way.x, way.y, way.z};
    const double most = slack_per_radius_of_images * particles_.smallest_radius();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double period = particles_.box().period(axis);
        const bool has_all_images = image_margin_ >= period;  // the reference engine's, made once
        if (!has_all_images && std::abs(along[axis]) > most) {
            return true;
        }
    }
    return false;
}

/// Particles that come back at the other end are elsewhere to walls, whose lists cannot know; and
/// rows are others than those whose travel was measured.
void Engine::renew_images() {
    pairs_.forget_images(particles_);
    particles_.renew_images(image_margin_);
    image_shift_ = bed_shift_;
    for (WallContacts& contacts : wall_contacts_) {
        contacts.expire(particles_);
    }
}

void Engine::update_stable_step() {
    if (!needs_stable_step()) {
        return;
    }
    enter(Phase::timestep);
    if (table_.stiffens()) {
        table_.expect_impacts(impact_speed());
    }
    stable_ = sum_steps(table_, detection_.create_on_overlap);
    if (const auto* scaled = std::get_if<ScaledTimestep>(&scheme_)) {
        scale_inertia(scaled->value, scaled->safety_factor);
    }
}

double Engine::compute_touching_limit() {
    ContactTable as_deep_as_now = table_;
    as_deep_as_now.expect_impacts(0.0);
    return sum_steps(as_deep_as_now, true);
}

/// Stable step of what the contacts that count add up to [s]; leaves the sums.
double Engine::sum_steps(const ContactTable& table, bool touching_only) {
    sums_.clear(particles_,
                table.rotation_rules(),
                table.rolling_ratio(),
                table.twisting_ratio(),
                workers_);
    const StepSums sums = sums_.sums();
    pairs_.add_steps(particles_, table, touching_only, sums, *kernels_, workers_);
    if (particles_.has_images()) {
        sums_.fold_images(particles_);
    }
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        wall_contacts_[w].add_steps(
            particles_, walls_[w], table, touching_only, sums, *kernels_, workers_);
    }
    return sums_.limit(
        particles_, std::holds_alternative<ScaledTimestep>(scheme_), *kernels_, workers_);
}

double Engine::compute_growth(double timestep) const {
    return SmallMotions(particles_, pairs_, walls_, wall_contacts_, table_).growth(timestep);
}

void Engine::scale_inertia(double step, double safety_factor) {
    for (Index slot = 0; slot < particles_.size(); ++slot) {
        const double limit = safety_factor * sums_.limit_of(particles_, slot);
        const double scale = particles_.mass(slot) * particles_.inverse_mass(slot);
        // limit grows with the root of the inertial mass, which is mass / scale at present.
        const double ratio = step / limit;
        if (std::isfinite(limit)) {
            particles_.scale_inertia(slot, ratio * ratio / scale);
        }
    }
}

void Engine::add_forces(double timestep) {
    enter(Phase::contacts);
    if (std::holds_alternative<ScaledTimestep>(scheme_)) {
        particles_.load_weight(scene_gravity_);
    }
    has_records_ = keep_records_ ? Records::all : want_records_;
    want_records_ = Records::none;
    pairs_.add_forces(particles_, table_, timestep, has_records_, *kernels_, workers_);
    if (particles_.has_images()) {
        particles_.fold_images();
    }
    enter(Phase::walls);
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        wall_contacts_[w].add_forces(
            particles_, walls_[w], table_, timestep, has_records_, *kernels_, workers_);
    }
}

}  // namespace grainbench
