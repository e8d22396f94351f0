#include "core/simulation.hpp"

#include "core/engine.hpp"
#include "core/guards/watch.hpp"
#include "core/measure/coarse_graining.hpp"
#include "core/measure/contact_loads.hpp"
#include "core/measure/coordination.hpp"
#include "core/measure/elevation.hpp"
#include "core/measure/memory_need.hpp"
#include "core/measure/selection.hpp"
#include "core/schedule.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace grainbench {

namespace {

/// Hash FNV-1a, 64 bits, over the bytes of columns.
class Fnv {
public:
    template <class T>
    void add(const std::vector<T>& column) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(column.data());
        for (std::size_t k = 0; k < column.size() * sizeof(T); ++k) {
            hash_ = (hash_ ^ bytes[k]) * 0x100000001b3ULL;
        }
    }

    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

Vec3 up_direction(const Scene& scene) {
    const Vec3 g = scene.gravity.value_or(Vec3{});
    return norm(g) > 0.0 ? normalized(-g) : Vec3{0.0, 0.0, 1.0};
}

std::vector<Index> required_group(const Scene& scene,
                                  const std::string& name,
                                  const ParticleState& particles) {
    std::vector<Index> slots;
    for (const Group& group : scene.groups) {
        if (group.name == name) {
            slots = slots_of_group(scene, group, particles);
        }
    }
    if (slots.empty()) {
        throw_bad_input({.what = "the group '" + name + "' holds no particle",
                         .where = "/observables/elevation",
                         .likely_cause = "an unknown group, or its species or box is empty",
                         .next_step = "check /groups and /particles/insertion"});
    }
    return slots;
}

}  // namespace

struct Simulation::Impl {
    Impl(const Scene& scene_in, int index_in, const SimulationOptions& options)
        : scene(scene_in),
          index(index_in),
          engine(scene, static_cast<std::uint64_t>(scene.realisations.seed + index), options),
          guards(scene, engine) {
        const ParticleState& particles = engine.particles();
        groups = group_numbers(scene, particles);
        layers = scene.layers ? layer_numbers(*scene.layers, particles)
                              : std::vector<std::int32_t>(particles.size(), 0);
        traced = traced_slots(scene, particles);
        if (const auto& wanted = scene.observables.elevation) {
            elevation.emplace(required_group(scene, wanted->upper, particles),
                              required_group(scene, wanted->lower, particles),
                              up_direction(scene));
        }
        measurements = build_measurements(scene, up_direction(scene));
        name_columns();
        if (writes_loads()) {
            engine.want_records();
        }
        enter_stage(0);
    }

    void name_columns();
    void enter_stage(std::size_t next);
    void begin_intervals();
    void follow(const PopulationChange& change);
    void delete_lost();
    void save_membership(Archive& archive) const;
    void load_membership(const Archive& archive);
    void observe();
    void report_all(Observer& observer, const Simulation& self);
    void report_due(Observer& observer, const Simulation& self);
    bool writes_loads() const;
    void want_records_for_output();

    MeasureView view() const {
        return {.particles = engine.particles(),
                .pairs = engine.pairs(),
                .walls = engine.walls(),
                .wall_contacts = engine.wall_contacts(),
                .groups = groups,
                .body = engine.body(),
                .timestep = engine.timestep(),
                .ledger = engine.ledger()};
    }

    const Stage& current_stage() const { return scene.stages[stage]; }

    const Output& output() const {
        return current_stage().output ? *current_stage().output : scene.output;
    }

    Scene scene;
    int index;
    Engine engine;
    GuardWatch guards;
    std::vector<std::int32_t> groups, layers;
    std::vector<Index> traced;
    std::optional<Elevation> elevation;
    std::vector<std::unique_ptr<Measurement>> measurements;
    std::vector<HistoryColumn> columns;
    Schedule schedule;
    std::size_t stage = 0;
    double stage_start = 0.0;
    double stage_end = 0.0;
    bool started = false;
    bool finished = false;
    double smallest_timestep = std::numeric_limits<double>::infinity();
    double largest_timestep = 0.0;
    double largest_overlap_ratio = 0.0;
};

void Simulation::Impl::name_columns() {
    columns = {{"time", "s", "simulated time"},
               {"cycle", "1", "cycles since the start"},
               {"timestep", "s", "step of the last cycle"},
               {"contacts_active", "1", "touching contacts, with walls"},
               {"contacts_all", "1", "contact objects, touching or near, with walls"},
               {"kinetic_energy", "J", "translation and rotation"},
               {"overlap_ratio", "1", "deepest overlap over the smaller radius"}};
    if (elevation) {
        elevation->name_columns(columns);
    }
    if (engine.changes_population()) {
        columns.push_back({"particles", "1", "in the scene"});
    }
    if (scene.guards.lost.action == LostAction::remove) {
        columns.push_back({"lost", "1", "particles that left and were deleted so far"});
    }
    if (const Traffic* traffic = engine.traffic()) {
        for (const auto* passages : {&traffic->came(), &traffic->went()}) {
            for (const Passage& passage : *passages) {
                columns.push_back({passage.name + ".count", "1", "spheres that passed so far"});
                columns.push_back({passage.name + ".mass", "kg", "their mass"});
            }
        }
    }
    for (const auto& measurement : measurements) {
        measurement->name_columns(columns);
    }
    if (scene.observables.wall_forces) {
        for (const std::string& name : engine.driven().names()) {
            for (const char* axis : {"x", "y", "z"}) {
                columns.push_back({name + ".force_" + axis, "N", "of the others on the group"});
            }
            for (const char* axis : {"x", "y", "z"}) {
                columns.push_back(
                    {name + ".torque_" + axis, "N m", "about the centre of its motion"});
            }
        }
    }
}

void Simulation::Impl::enter_stage(std::size_t next) {
    stage = next;
    stage_start = engine.time();
    stage_end = stage_start + current_stage().duration;
    engine.begin_stage(current_stage());
    guards.begin_stage();
    begin_intervals();
}

void Simulation::Impl::begin_intervals() {
    schedule.begin(output(), stage_start);
    if (elevation) {
        elevation->begin_interval(stage_start,
                                  current_stage().average_interval.value_or(
                                      scene.observables.elevation->average_interval));
    }
}

/// Newcomers belong to no layer, and to the first group of their species that has no box.
void Simulation::Impl::follow(const PopulationChange& change) {
    groups = renumbered(groups, change);
    layers = renumbered(layers, change);
    const ParticleState& particles = engine.particles();
    for (auto slot = static_cast<Index>(particles.size() - change.newcomers.size());
         slot < particles.size();
         ++slot) {
        groups[slot] = group_of_newcomer(scene, particles.species(slot));
    }
    for (Index& slot : traced) {
        slot = slot == PopulationChange::gone ? slot : change.slot_after[slot];
    }
    if (elevation) {
        elevation->renumber(change);
    }
    guards.change_population(engine, change);
}

void Simulation::Impl::delete_lost() {
    const std::vector<Index> lost = guards.take_lost();
    if (!lost.empty()) {
        engine.remove(lost);
        follow(*engine.population_change());
    }
}

/// Who belongs to what cannot be told from a scene whose particles come and go.
void Simulation::Impl::save_membership(Archive& archive) const {
    archive.put("membership/groups", std::vector<std::uint32_t>(groups.begin(), groups.end()));
    archive.put("membership/layers", std::vector<std::uint32_t>(layers.begin(), layers.end()));
    archive.put("membership/traced", traced);
    if (elevation) {
        elevation->save_members(archive);
    }
}

void Simulation::Impl::load_membership(const Archive& archive) {
    const std::size_t size = engine.particles().size();
    const auto read = [&](const std::string& name, std::vector<std::int32_t>& numbers) {
        const auto& from = archive.get<std::uint32_t>(name, size);
        numbers.assign(from.begin(), from.end());
    };
    read("membership/groups", groups);
    read("membership/layers", layers);
    traced = archive.get<Index>("membership/traced", traced.size());
    for (const Index slot : traced) {
        Archive::require(slot < size || slot == PopulationChange::gone, "membership/traced");
    }
    if (elevation) {
        elevation->load_members(archive, engine.particles().size());
    }
}

void Simulation::Impl::observe() {
    smallest_timestep = std::min(smallest_timestep, engine.timestep());
    largest_timestep = std::max(largest_timestep, engine.timestep());
    if (elevation &&
        engine.cycle() % static_cast<std::uint64_t>(scene.observables.elevation->sample_cycles) ==
            0) {
        elevation->sample(engine.particles(), engine.time());
    }
}

void Simulation::Impl::report_all(Observer& observer, const Simulation& self) {
    largest_overlap_ratio = std::max(largest_overlap_ratio, engine.largest_overlap_ratio());
    observer.on_history(self);
    observer.on_trace(self);
    observer.on_frame(self);
    if (scene.observables.coarse_graining) {
        observer.on_fields(self);
    }
    observer.on_checkpoint(self);
}

void Simulation::Impl::report_due(Observer& observer, const Simulation& self) {
    const double t = engine.time();
    if (schedule.history_is_due(t, engine.cycle())) {
        largest_overlap_ratio = std::max(largest_overlap_ratio, engine.largest_overlap_ratio());
        observer.on_history(self);
    }
    if (schedule.trace.is_due(t)) {
        observer.on_trace(self);
    }
    const bool fields_are_due = scene.observables.coarse_graining && schedule.fields_are_due(t);
    if (schedule.frame.is_due(t)) {
        observer.on_frame(self);
    }
    if (fields_are_due) {
        schedule.field.is_due(t);  // counts it
        observer.on_fields(self);
    }
    if (schedule.checkpoint.is_due(t)) {
        guards.look(engine);
        observer.on_checkpoint(self);
    }
}

/// Whether some output of this stage holds forces of single contacts.
bool Simulation::Impl::writes_loads() const {
    return scene.observables.coarse_graining || output().contacts;
}

/// Forces of single contacts are left by those steps alone whose end is looked at.
void Simulation::Impl::want_records_for_output() {
    const double next = engine.time() + engine.next_timestep();
    const bool fields_are_due = scene.observables.coarse_graining && schedule.fields_are_due(next);
    const bool contacts_are_due = output().contacts && schedule.frame.would_fire(next);
    if (next >= stage_end || fields_are_due || contacts_are_due) {
        engine.want_records();
    }
}

Simulation::Simulation(const Scene& scene, int index, const SimulationOptions& options)
    : impl_((require_memory(scene), std::make_unique<Impl>(scene, index, options))) {}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

bool Simulation::advance(std::uint64_t cycles, Observer& observer) {
    Impl& s = *impl_;
    if (!s.started) {
        s.started = true;
        if (s.elevation) {
            s.elevation->sample(s.engine.particles(), s.engine.time());
        }
        s.report_all(observer, *this);
    }
    if (s.engine.cycle() == 0) {
        s.guards.look(s.engine);  // again after a restart from the very first state
    }
    while (!s.finished) {
        if (s.engine.time() >= s.stage_end) {
            if (s.stage + 1 < s.scene.stages.size()) {
                s.enter_stage(s.stage + 1);
                continue;
            }
            s.guards.look(s.engine);
            s.finished = true;
            s.report_all(observer, *this);
            break;
        }
        if (cycles-- == 0) {
            return false;
        }
        s.guards.before_step(s.engine);
        if (s.writes_loads()) {
            s.want_records_for_output();
        }
        s.engine.step();
        if (const PopulationChange* change = s.engine.population_change()) {
            s.follow(*change);
        }
        s.observe();
        s.guards.after_step(s.engine);
        s.delete_lost();
        // The very last cycle is reported in full below, once.
        if (s.engine.time() < s.stage_end || s.stage + 1 < s.scene.stages.size()) {
            s.report_due(observer, *this);
        }
    }
    return true;
}

void Simulation::watch_phases(PhaseWatch* watch) {
    impl_->engine.watch_phases(watch);
}

int Simulation::index() const {
    return impl_->index;
}

double Simulation::time() const {
    return impl_->engine.time();
}

double Simulation::end_time() const {
    double end = impl_->stage_end;
    for (std::size_t next = impl_->stage + 1; next < impl_->scene.stages.size(); ++next) {
        end += impl_->scene.stages[next].duration;
    }
    return end;
}

double Simulation::timestep() const {
    return impl_->engine.timestep();
}

std::uint64_t Simulation::cycle() const {
    return impl_->engine.cycle();
}

std::size_t Simulation::stage() const {
    return impl_->stage;
}

bool Simulation::finished() const {
    return impl_->finished;
}

std::size_t Simulation::particle_count() const {
    return impl_->engine.particles().size();
}

std::size_t Simulation::candidate_count() const {
    return impl_->engine.pairs().candidate_count();
}

std::size_t Simulation::contact_count() const {
    return impl_->engine.contact_count();
}

std::size_t Simulation::touching_count() const {
    return impl_->engine.touching_count();
}

std::span<const InsertionReport> Simulation::insertion_reports() const {
    return impl_->engine.insertion_reports();
}

std::string Simulation::isa() const {
    return std::string(impl_->engine.kernels().isa);
}

ParticleFrame Simulation::particle_frame() const {
    const Impl& s = *impl_;
    const ParticleState& p = s.engine.particles();
    const std::vector<std::int32_t> current_layers = s.scene.layers
                                                         ? current_layer_numbers(*s.scene.layers, p)
                                                         : std::vector<std::int32_t>(p.size(), 0);
    const std::vector<std::int32_t> contacts = contacts_by_slot(s.view(), true);
    ParticleFrame frame;
    frame.time = time();
    frame.cycle = cycle();
    for (const Index slot : p.slots_by_id()) {
        frame.id.push_back(p.id(slot));
        frame.position.push_back(p.box().wrapped(p.position(slot)));
        frame.radius.push_back(p.radius(slot));
        frame.species.push_back(static_cast<std::int32_t>(p.species(slot)));
        frame.group.push_back(s.groups[slot]);
        frame.layer.push_back(s.layers[slot]);
        frame.current_layer.push_back(current_layers[slot]);
        frame.velocity.push_back(s.engine.full_velocity(slot));
        frame.angular_velocity.push_back(s.engine.full_spin(slot));
        frame.force.push_back(s.engine.contact_force(slot));
        frame.contacts.push_back(contacts[slot]);
        if (const Orientations* orientations = s.engine.orientations()) {
            frame.orientation.push_back(orientations->of(slot));
        }
    }
    return frame;
}

WallFrame Simulation::wall_frame() const {
    WallFrame frame;
    frame.time = time();
    frame.cycle = cycle();
    const auto walls = impl_->engine.walls();
    const auto contacts = impl_->engine.wall_contacts();
    for (std::size_t w = 0; w < walls.size(); ++w) {
        WallSurface surface = walls[w].surface().outline();
        surface.name = walls[w].name();
        for (Vec3& point : surface.points) {
            point = walls[w].to_space(point);
        }
        surface.velocity = walls[w].velocity().linear;
        for (Index t = 0; t < contacts[w].touching_count(); ++t) {
            surface.force += contacts[w].force(t);
        }
        frame.walls.push_back(std::move(surface));
    }
    return frame;
}

ContactFrame Simulation::contact_frame() const {
    const Engine& engine = impl_->engine;
    if (!engine.has_records()) {
        throw_bad_input(
            {.what = "the last cycle left no forces of single contacts",
             .where = "/output/contacts",
             .likely_cause = "contacts are asked for at a time when no frame of them is due",
             .next_step = "set /output/contacts and ask when on_frame() is called, or set "
                          "/observables/energy"});
    }
    const ParticleState& p = engine.particles();
    ContactFrame frame;
    frame.time = time();
    frame.cycle = cycle();
    for_each_contact(impl_->view(), [&](const ContactLoad& contact) {
        const bool is_pair = contact.wall == ContactLoad::no_wall;
        frame.i_id.push_back(p.id(contact.i));
        frame.j_id.push_back(is_pair ? p.id(contact.j) : 0);
        frame.wall.push_back(is_pair ? 0 : static_cast<std::int32_t>(contact.wall + 1));
        frame.i_position.push_back(p.position(contact.i));
        frame.j_position.push_back(contact.end);
        frame.overlap.push_back(contact.overlap);
        frame.force_normal.push_back(contact.pressing);
        frame.force_tangential.push_back(norm(contact.shear));
        frame.point.push_back(contact.point);
        frame.branch.push_back(contact.branch);
        frame.force.push_back(contact.force);
        frame.i_species.push_back(static_cast<std::int32_t>(p.species(contact.i)));
        frame.j_species.push_back(is_pair ? static_cast<std::int32_t>(p.species(contact.j)) : -1);
    });
    return frame;
}

FieldFrame Simulation::field_frame() const {
    const Impl& s = *impl_;
    if (!s.scene.observables.coarse_graining) {
        throw_bad_input({.what = "the scene asks for no fields",
                         .where = "/observables",
                         .likely_cause = "fields are asked of a scene that describes no grid",
                         .next_step = "add /observables/coarse_graining"});
    }
    if (!s.engine.has_records()) {
        throw_bad_input({.what = "the last cycle left no forces of single contacts",
                         .where = "/observables/coarse_graining",
                         .likely_cause = "fields are asked for at a time when none are due",
                         .next_step = "ask when on_fields() is called"});
    }
    FieldFrame frame = coarse_grain(*s.scene.observables.coarse_graining, s.view());
    frame.time = time();
    frame.cycle = cycle();
    return frame;
}

std::vector<TracePoint> Simulation::trace_points() const {
    std::vector<TracePoint> points;
    for (const Index slot : impl_->traced) {
        if (slot == PopulationChange::gone) {
            continue;
        }
        points.push_back({impl_->engine.particles().id(slot),
                          impl_->engine.particles().unwrapped(slot),
                          impl_->engine.full_velocity(slot)});
    }
    return points;
}

const std::vector<HistoryColumn>& Simulation::history_columns() const {
    return impl_->columns;
}

std::vector<double> Simulation::history_row() const {
    const Impl& s = *impl_;
    const auto [translation, rotation] =
        kinetic_energies(s.engine.particles(), s.engine.body(), s.engine.timestep());
    std::vector<double> row{time(),
                            static_cast<double>(cycle()),
                            timestep(),
                            static_cast<double>(touching_count()),
                            static_cast<double>(contact_count()),
                            translation + rotation,
                            s.engine.largest_overlap_ratio()};
    const MeasureView view = s.view();
    if (s.elevation) {
        s.elevation->append_row(view, row);
    }
    if (s.engine.changes_population()) {
        row.push_back(static_cast<double>(particle_count()));
    }
    if (s.scene.guards.lost.action == LostAction::remove) {
        row.push_back(static_cast<double>(s.guards.lost_count()));
    }
    if (const Traffic* traffic = s.engine.traffic()) {
        for (const auto* passages : {&traffic->came(), &traffic->went()}) {
            for (const Passage& passage : *passages) {
                row.push_back(static_cast<double>(passage.count));
                row.push_back(passage.mass);
            }
        }
    }
    for (const auto& measurement : s.measurements) {
        measurement->append_row(view, row);
    }
    if (s.scene.observables.wall_forces) {
        for (std::size_t n = 0; n < s.engine.driven().size(); ++n) {
            const GroupLoad load = s.engine.driven_load(n);
            row.insert(row.end(),
                       {load.force.x,
                        load.force.y,
                        load.force.z,
                        load.torque.x,
                        load.torque.y,
                        load.torque.z});
        }
    }
    return row;
}

Summary Simulation::summary() const {
    const Impl& s = *impl_;
    Summary summary;
    summary.cycles = cycle();
    summary.time = time();
    summary.mean_timestep = cycle() > 0 ? time() / static_cast<double>(cycle()) : 0.0;
    summary.smallest_timestep = cycle() > 0 ? s.smallest_timestep : 0.0;
    summary.largest_timestep = s.largest_timestep;
    if (s.elevation) {
        summary.entrainment_time = s.elevation->entrainment_time();
        summary.average_elevation = s.elevation->average();
    }
    summary.late_contacts = s.engine.late_count();
    summary.largest_overlap_ratio = s.largest_overlap_ratio;
    summary.warnings = s.guards.warnings(s.engine);
    summary.searches = s.engine.pairs().renewals();
    summary.candidate_builds = s.engine.pairs().candidate_builds();
    return summary;
}

std::uint64_t Simulation::state_hash() const {
    Fnv hash;
    Archive archive([&](const std::string&, const Archive::Column& column) {
        std::visit([&](const auto& values) { hash.add(values); }, column);
    });
    save(archive);
    return hash.value();
}

void Simulation::save(Archive& archive) const {
    const Impl& s = *impl_;
    s.engine.save(archive);
    s.guards.save(archive);
    s.schedule.save(archive);
    if (s.elevation) {
        s.elevation->save(archive);
    }
    if (s.engine.renumbers()) {
        s.save_membership(archive);
    }
    archive.put("time", time());
    archive.put("cycle", cycle());
    archive.put("stage", static_cast<std::uint64_t>(s.stage));
    archive.put("flags", std::vector<std::uint8_t>{s.started, s.finished});
    archive.put("numbers",
                std::vector<double>{s.stage_start,
                                    s.stage_end,
                                    s.smallest_timestep,
                                    s.largest_timestep,
                                    s.largest_overlap_ratio});
}

void Simulation::load(const Archive& archive) {
    Impl& s = *impl_;
    const auto& numbers = archive.get<double>("numbers", 5);
    const auto& flags = archive.get<std::uint8_t>("flags", 2);
    const auto stage = static_cast<std::size_t>(archive.count("stage"));
    Archive::require(stage < s.scene.stages.size(), "stage");
    for (std::size_t next = 1; next <= stage && next < s.scene.stages.size(); ++next) {
        s.engine.begin_stage(s.scene.stages[next]);
    }
    s.stage = stage;
    s.engine.load(archive);
    Archive::require(archive.number("time") == time() && archive.count("cycle") == cycle(),
                     "cycle");
    if (s.engine.renumbers()) {
        s.load_membership(archive);
    }
    s.guards.load(archive);
    s.stage_start = numbers[0];
    s.stage_end = numbers[1];
    Archive::require(s.stage_end == s.stage_start + s.current_stage().duration &&
                         s.engine.time() >= s.stage_start &&
                         s.engine.time() <= s.stage_end + s.engine.timestep(),
                     "numbers");
    s.begin_intervals();
    s.schedule.load(archive);
    if (s.elevation) {
        s.elevation->load(archive);
    }
    s.smallest_timestep = numbers[2];
    s.largest_timestep = numbers[3];
    s.largest_overlap_ratio = numbers[4];
    s.started = flags[0] != 0;
    s.finished = flags[1] != 0;
}

}  // namespace grainbench
