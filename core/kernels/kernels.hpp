/// The hot passes as plain functions over raw columns, one table of them per instruction set.
/// Everything that a pass touches is in its view; the files that implement them know no containers.
#pragma once

#include "core/contact/law_table.hpp"
#include "core/types.hpp"

#include <cstdint>
#include <string_view>

namespace grainbench {

/// Packets of four doubles in a row of the column of loads, by their first element
/// (share/doc/decisions/0002-packets-of-four.md).
enum LoadPacket : std::size_t {
    force_packet = 0,   ///< [N], 0
    torque_packet = 4,  ///< [N m], inverse moment of inertia [1/(kg m^2)]
    load_row = 8        ///< doubles per row
};

/// Columns, one row per particle.
struct ParticleView {
    double* position;          ///< packets: x, y, z [m], radius [m]
    double* velocity;          ///< packets: v at the half step [m/s], inverse mass [1/kg]
    double* spin;              ///< packets: omega at the half step [rad/s], material
    double* loads;             ///< rows of packets, see LoadPacket
    std::uint8_t* loaded;      ///< 0 or 1 by particle: where 0, force and torque are zero
    std::size_t count;         ///< of particles
    std::size_t padded_count;  ///< rows of each column, a multiple of 8
};

/// Kick and drift of a part of the particles; takes their forces and torques away.
struct MotionPass {
    ParticleView particles;
    double gravity[4];       ///< [m/s^2]
    double frame[4];         ///< [m/s] velocity relative to which travel is measured
    double kick;             ///< [s] half the old plus half the new step
    double drift;            ///< [s] new step
    double local_damping;    ///< [1] coefficient; read by move_damped alone
    bool few_are_loaded;     ///< worth looking at `loaded` before touching forces
    std::size_t first;       ///< row of this part, a multiple of 8
    std::size_t last;        ///< row after it, a multiple of 8 or the count of particles
    double fastest_square;   ///< out: largest |v - frame|^2
    double velocity_sum[4];  ///< out: sum of v per axis; not finite if any v is not
};

/// How far particles have come from where they were, relative to a frame.
struct TravelPass {
    const double* position;   ///< packets
    const double* reference;  ///< packets: positions then
    std::size_t padded_count;
    double frame[3];         ///< [m] displacement of the frame meanwhile
    double smallest_radius;  ///< [m]; travel counts in units of R / smallest_radius, or
    bool by_radius;          ///< if false, as it is
    double largest_square;   ///< out: of the travel [m^2]
};

/// A list of pairs whose distance is compared with scale * (R_i + R_j) + extra.
struct PairQuery {
    const double* position;
    const Index* i;
    const Index* j;
    Index count;  ///< the columns are readable up to the next multiple of 64
    double scale;
    double extra;  ///< [m]
};

/// The pairs of a list whose bits are set, side by side.
struct PairChoice {
    const std::uint64_t* bits;  ///< from the word of place `first` on
    std::size_t words;
    Index first;     ///< a multiple of 64
    const Index* i;  ///< by place, readable up to the end of the words
    const Index* j;
    Index* place;  ///< out: place of each of them; null where not asked for
    Index* chosen_i;
    Index* chosen_j;
};

/// A grid of cells over particles.
struct CellGrid {
    double low[3];        ///< [m]
    double inverse_edge;  ///< [1/m]
    std::int64_t cells[3];

    std::int64_t coordinate(double x, int axis) const {
        // Compared as it is, for what lies far outside fits no integer.
        const double cell = (x - low[axis]) * inverse_edge;
        return cell < 1.0                                ? 0
               : cell < static_cast<double>(cells[axis]) ? static_cast<std::int64_t>(cell)
                                                         : cells[axis] - 1;
    }
};

/// Pairs whose distance is at most scale * (R_i + R_j) + extra, from a grid. A pair is found by its
/// larger particle, or by the first of equals.
struct CellSearch {
    CellGrid grid;
    const double* centre[3];  ///< [m] by place in the order of cells, readable for 8 more
    const double* radius;     ///< [m] the same
    const Index* slot;        ///< the same
    const Index* cell_start;  ///< by cell: first place; one more at the end
    Index count;              ///< of places
    double smallest_radius;
    double scale;
    double extra;  ///< [m]
    Index* i;      ///< out: lower slot
    Index* j;      ///< out: higher slot
    std::size_t capacity;
    Index next = 0;         ///< place to go on from: count when done, less when out of room
    std::size_t found = 0;  ///< pairs
};

/// Entries of a wall list, whose patches are compared with spheres of radius scale * R + extra, in
/// the wall's frame: centre - shift, turned by `rotation` if `rotated`.
struct PatchQuery {
    const double* position;
    const double* planes;  ///< four packets per patch, see Surface::planes
    const double*
        shells;  ///< two packets per patch, see Surface::shells; null where there are none
    const Index* particle;
    const Index* patch;
    Index count;         ///< the columns are readable up to the next multiple of 64
    double shift[3];     ///< [m] displacement of the wall
    double rotation[9];  ///< rows of the matrix from space to the wall's frame
    bool rotated;
    double scale;
    double extra;
};

/// What the planes of a patch alone can tell of an entry, as one bit per entry.
struct PatchAnswers {
    std::uint64_t* face;   ///< the closest point lies inside the face, within reach
    std::uint64_t* doubt;  ///< it may be within reach, on an edge or a vertex
    double* height;        ///< [m] by entry: of the centre over the plane
};

inline constexpr Index record_size = 17;

/// What a contact leaves for the ledger and for contact frames.
enum RecordField : Index {
    record_damping_x,  ///< [N] dashpot force on j, three components
    record_damping_y,
    record_damping_z,
    record_slip_work,  ///< [J]
    record_stored,     ///< [J]
    record_normal,     ///< [N] spring part, less the attraction
    record_shear_x,    ///< [N] spring part on j, three components
    record_shear_y,
    record_shear_z,
    record_lever_i,   ///< [m]
    record_lever_j,   ///< [m]
    record_normal_x,  ///< [1] unit vector from i to j, three components
    record_normal_y,
    record_normal_z,
    record_moment_x,  ///< [N m] on j, three components
    record_moment_y,
    record_moment_z
};

/// What the laws of a contact read besides its geometry.
struct LawView {
    const double* values;  ///< column per value, one row per pair of materials
    Index value_stride;    ///< rows of a column
    Index material_count;
    bool uniform;      ///< all rows are alike
    double timestep;   ///< [s]
    LawChoice choice;  ///< the laws
    std::size_t pass;  ///< the pass for them; the general one will do for all
    double impact;     ///< [(m/s)^(4/5)] speed of impacts to expect for the stable step, to the 4/5
    double lever_cut;  ///< [1] part of the overlap by which a lever is shorter than its radius
};

/// A touching contact by its place in a list, and whether this is its first step.
class TouchingContact {
public:
    TouchingContact() = default;

    constexpr TouchingContact(Index place, bool is_new)
        : bits_(place | (is_new ? new_bit : Index{0})) {}

    constexpr Index place() const { return bits_ & ~new_bit; }

    constexpr bool is_new() const { return (bits_ & new_bit) != 0; }

    static constexpr Index new_bit = Index{1} << 31;

private:
    Index bits_ = 0;
};

/// Forces of the touching pairs.
struct PairPass {
    ParticleView particles;
    LawView laws;
    const Index* i;                   ///< by place
    const Index* j;                   ///< by place
    const TouchingContact* touching;  ///< ascending
    Index touching_count;
    bool marks_loaded;  ///< false where all particles are marked already
    double* rows;       ///< by place: history_packets(size) packets
    double* records;    ///< by touching contact; null where none are kept
    double* stored;     ///< [J] elastic energy by touching contact; null where not asked for
};

/// Packets that hold the history of one contact.
constexpr Index history_packets(int history_size) {
    return static_cast<Index>((history_size + 3) / 4);
}

/// Forces of the contacts with one wall.
struct WallPass {
    ParticleView particles;
    LawView laws;
    const Index* particle;            ///< by place
    const TouchingContact* touching;  ///< ascending
    Index touching_count;
    double velocity[3];  ///< [m/s] of the wall at `centre`
    double spin[3];      ///< [rad/s] of the wall
    double centre[3];    ///< [m] that the wall turns about
    double material;     ///< of the wall
    double* rows;     ///< by place: history, then a packet {normal to the wall [1], distance [m]}
    double* force;    ///< packet by touching contact: force on the wall [N]
    double* records;  ///< by touching contact; null where none are kept
    double* stored;   ///< [J] see PairPass
};

/// Sums over contacts for the stable step (core/integrate/stable_step.hpp).
struct StepSums {
    double* shear;   ///< packet by particle: sum of K_s n^2 per axis, sum of K_s [N/m]
    double* normal;  ///< packet by particle: sum of K_n n^2 per axis; null where rotation rules
    double rolling = 0.0;   ///< [1] rolling stiffness over K_s R^2, the largest of all contacts
    double twisting = 0.0;  ///< [1] the same of twisting
};

/// Adds contacts between particles.
struct PairStepPass {
    ParticleView particles;
    LawView laws;
    const Index* i;  ///< by contact
    const Index* j;  ///< by contact
    Index count;
    StepSums sums;
};

/// Adds contacts with a wall.
struct WallStepPass {
    ParticleView particles;
    LawView laws;
    const Index* particle;   ///< by contact
    const double* geometry;  ///< packet by contact: normal to the wall, distance [m]
    Index count;
    double material;  ///< of the wall
    StepSums sums;
};

/// One instruction set's passes.
struct Kernels {
    std::string_view isa;
    void (*move)(MotionPass&);
    void (*move_straight)(MotionPass&);  ///< where torques are zero: spins stay as they are
    void (*move_damped)(MotionPass&);
    void (*measure_travel)(TravelPass&);

    void (*search_cells)(CellSearch&);

    /// One bit per pair: within reach. Bits past the end are zero.
    void (*test_pairs)(const PairQuery&, std::uint64_t* within);

    /// The same, and in `doubtful` the pairs that are less than `margin` [m] within reach or beyond
    /// it.
    void (*test_pairs_and_doubt)(const PairQuery&,
                                 double margin,
                                 std::uint64_t* within,
                                 std::uint64_t* doubtful);

    /// The contacts whose bits are set in `words` words, the first of which is that of place
    /// `first`, new where `before` has no bit.
    void (*list_touching)(const std::uint64_t* now,
                          const std::uint64_t* before,
                          std::size_t words,
                          Index first,
                          TouchingContact* touching);

    /// Bits that are set in `count` words.
    std::size_t (*count_bits)(const std::uint64_t* words, std::size_t count);

    /// Writes nothing past the last of them.
    void (*select_pairs)(const PairChoice&);

    void (*test_patches)(const PatchQuery&, const PatchAnswers&);

    void (*pair_pass)(const PairPass&);
    void (*wall_pass)(const WallPass&);
    void (*add_pair_steps)(const PairStepPass&);
    void (*add_wall_steps)(const WallStepPass&);

    /// Largest of k/m and kappa/I over all particles and axes [1/s^2]; 0 without contacts.
    /// \param takes_away whether sums are zero afterwards
    double (*largest_step_ratio)(const ParticleView&, const StepSums&, bool takes_away);
};

/// Passes of one instruction set: "scalar", "sse4", "avx2", "avx512", or "" for the best that this
/// processor has (or what GRAINBENCH_ISA says). Throws Error(bad_input) if it has not got it.
const Kernels& kernels_for(std::string_view isa);

/// Names of the sets that this processor has, slowest first.
std::string_view available_isa(std::size_t n);

}  // namespace grainbench
