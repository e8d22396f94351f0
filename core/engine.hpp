/// The stepping engine of one realisation: particles, walls, contacts, and the cycle of
/// share/doc/notation.md. It knows nothing of output or stages beyond their physics.
#pragma once

#include "core/body/body_forces.hpp"
#include "core/body/driven_groups.hpp"
#include "core/contact/contact_table.hpp"
#include "core/contact/pair_contacts.hpp"
#include "core/contact/wall_contacts.hpp"
#include "core/insertion/traffic.hpp"
#include "core/integrate/orientations.hpp"
#include "core/integrate/stable_step.hpp"
#include "core/measure/energy_ledger.hpp"
#include "core/phases.hpp"
#include "core/simulation.hpp"

#include <memory>
#include <vector>

namespace grainbench {

class Engine {
public:
    Engine(const Scene& scene, std::uint64_t seed, const SimulationOptions& options);

    /// Changes what a stage changes. The first call also finds the first contacts and forces.
    void begin_stage(const Stage& stage);

    /// Who is told from now on which part of a cycle begins; null = nobody.
    void watch_phases(PhaseWatch* watch) { phase_watch_ = watch; }

    /// One cycle. Throws Error(unstable) when the state is no longer finite.
    void step();

    double time() const { return time_; }

    double timestep() const { return timestep_; }

    /// That step() will take, if nothing changes before [s].
    double next_timestep() const { return choose_timestep(); }

    std::uint64_t cycle() const { return cycle_; }

    const ParticleState& particles() const { return particles_; }

    const PairContacts& pairs() const { return pairs_; }

    std::span<const WallBody> walls() const { return walls_; }

    std::span<const WallContacts> wall_contacts() const { return wall_contacts_; }

    const Materials& materials() const { return materials_; }

    const Timestep& scheme() const { return scheme_; }

    /// Stable step of one lone contact [s].
    double single_contact_limit() const { return single_contact_; }

    /// Stable step of the touching contacts alone, summed anew [s]; infinite without any.
    double compute_touching_limit();

    /// Factor by which small motions of what touches grow per cycle at a step [s].
    double compute_growth(double timestep) const;

    /// Bound on the way of the last cycle [m], of any particle relative to the bed or to a bounded
    /// wall.
    double travel() const { return travel_; }

    /// Mean velocity in the last cycle [m/s].
    const Vec3& bed_velocity() const { return bed_velocity_; }

    /// Lets the contacts of the next cycle leave records, which contact frames and fields read.
    /// With a ledger all cycles do.
    void want_records() { want_records_ = Records::all; }

    /// The same of the energies of their springs alone.
    void want_stored_energies() {
        want_records_ = want_records_ == Records::all ? Records::all : Records::stored_energy;
    }

    /// Whether the last cycle left records.
    bool has_records() const { return has_records_ == Records::all; }

    /// Whether it left the energies of springs, with or without the rest.
    bool has_stored_energies() const { return has_records_ != Records::none; }

    /// Acceleration that acts on velocities; zero where gravity is among the forces.
    const Vec3& gravity() const { return body_.gravity; }

    const BodyForces& body() const { return body_; }

    const DrivenGroups& driven() const { return driven_; }

    /// What contacts do to driven group n.
    GroupLoad driven_load(std::size_t n) const;

    const std::vector<InsertionReport>& insertion_reports() const { return insertion_reports_; }

    /// Whether particles may come or go.
    bool changes_population() const { return changes_population_; }

    /// Whether slots may come to mean other particles than at the start.
    bool renumbers() const;

    /// Deletes those in some slots, in ascending order; population_change() says who has which slot
    /// then.
    void remove(std::span<const Index> slots);

    /// Puts slots in spatial order. It happens by itself in large scenes whose particles mix.
    void sort_slots();

    /// Who came, went or got another slot in the last cycle, or after it; null if nobody did.
    const PopulationChange* population_change() const {
        return population_change_ ? &*population_change_ : nullptr;
    }

    /// Sinks and sources; null in a scene without.
    const Traffic* traffic() const { return traffic_ ? &*traffic_ : nullptr; }

    /// How particles have turned; null in a scene whose output does not ask.
    const Orientations* orientations() const { return orientations_ ? &*orientations_ : nullptr; }

    const Kernels& kernels() const { return *kernels_; }

    /// Contact objects, touching or near [1]; looks at those with walls one by one.
    std::size_t contact_count() const;
    std::size_t touching_count() const;
    std::uint64_t late_count() const;

    /// Velocity at the full step [m/s], spin [rad/s].
    Vec3 full_velocity(Index slot) const;
    Vec3 full_spin(Index slot) const;

    /// Of contacts alone [N].
    Vec3 contact_force(Index slot) const;

    bool has_ledger() const { return ledger_ != nullptr; }

    const EnergyLedger* ledger() const { return ledger_.get(); }

    Energies energies() const { return ledger_->energies(ledger_view(), timestep_); }

    /// Overlap over the smaller radius of the deepest contact [1].
    double largest_overlap_ratio() const;

    void save(Archive& archive) const;

    /// Call after begin_stage of the stage in which the state was saved.
    void load(const Archive& archive);

private:
    LedgerView ledger_view() const { return {particles_, pairs_, walls_, wall_contacts_, body_}; }

    void enter(Phase phase) const {
        if (phase_watch_ != nullptr) {
            phase_watch_->enter(phase);
        }
    }

    void make_periodic(const Periodic& periodic, bool is_reference);
    bool has_left_its_period() const;
    void renew_images();
    void measure_bed();
    void exchange(PopulationChange change);
    void renumber(const PopulationChange& change);
    bool is_scattered();
    void change_drives(const Stage& stage);
    void change_gravity(const Vec3& next);
    void change_scheme(const Timestep& next);
    double choose_timestep() const;
    double fall_square() const;
    double impact_speed() const;
    void move(double timestep);
    MotionPass move_particles(double timestep);
    bool few_are_loaded() const;
    void find_contacts();
    bool look_ahead_is_due() const;
    void look_ahead_to_walls();
    void add_forces(double timestep);
    void update_stable_step();
    double sum_steps(const ContactTable& table, bool touching_only);
    void scale_inertia(double step, double safety_factor);

    bool needs_stable_step() const { return !std::holds_alternative<FixedTimestep>(scheme_); }

    /// Whether contacts count for the stable step before they touch.
    bool looks_ahead() const { return needs_stable_step() && !detection_.create_on_overlap; }

    const Kernels* kernels_;
    Materials materials_;
    Contact contact_;
    ContactTable table_;
    Timestep scheme_;
    Detection detection_;
    Vec3 scene_gravity_{};
    BodyForces body_;
    DrivenGroups driven_;
    bool keep_records_ = false;
    Records want_records_ = Records::none;
    Records has_records_ = Records::none;
    std::vector<WallBody> walls_;
    std::vector<WallContacts> wall_contacts_;
    ParticleState particles_;
    double image_margin_ =
        0.0;  ///< [m] from periodic boundaries, within which particles have images
    PairContacts pairs_;
    StableStep sums_;
    Workers workers_;
    std::vector<MotionPass> move_parts_;  ///< by slab
    std::unique_ptr<EnergyLedger> ledger_;
    std::optional<Traffic> traffic_;
    std::optional<Orientations> orientations_;
    std::optional<PopulationChange> population_change_;
    std::vector<InsertionReport> insertion_reports_;
    PhaseWatch* phase_watch_ = nullptr;

    bool changes_population_ = false;
    bool torques_wait_ = false;  ///< those of laws that a stage has taken away, for half a kick
    bool started_ = false;
    bool wants_sorting_ = false;
    double distance_when_sorted_ =
        0.0;  ///< [1] mean slot distance after the last sorting; 0 = unknown
    std::uint64_t cycle_ = 0;
    double time_ = 0.0;
    double timestep_ = 0.0;        ///< of the last cycle; 0 before the first
    double stable_ = 0.0;          ///< limit of the present contact objects
    double single_contact_ = 0.0;  ///< limit of one lone contact
    Vec3 bed_velocity_{};          ///< mean velocity in the last cycle: the bed's frame
    Vec3 bed_shift_{};             ///< displacement of that frame
    Vec3 image_shift_{};           ///< the same when images were last made
    double fastest_ = 0.0;         ///< largest speed relative to it
    double travel_ = 0.0;
};

}  // namespace grainbench
