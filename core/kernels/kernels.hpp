/// The hot passes as plain functions over raw columns, one table of them per instruction set.
/// Everything that a pass touches is in its view; the files that implement them know no containers.
#pragma once

#include "core/types.hpp"

#include <cstdint>
#include <string_view>

namespace grainbench {

/// Columns of packets, four doubles per particle (share/doc/decisions/0002-packets-of-four.md).
struct ParticleView {
    double* position;               ///< x, y, z [m], radius [m]
    double* velocity;               ///< v at the half step [m/s], inverse mass [1/kg]
    double* spin;                   ///< omega at the half step [rad/s], material
    double* force;                  ///< [N], 0
    double* torque;                 ///< [N m], 0
    const double* inverse_mass;     ///< [1/kg] three times, 0
    const double* inverse_inertia;  ///< [1/(kg m^2)] three times, 0
    std::size_t padded_size;        ///< doubles per column, a multiple of 8
};

/// Kick and drift of all particles.
struct MotionPass {
    ParticleView particles;
    double gravity[8];       ///< [m/s^2] packet, twice
    double frame[8];         ///< [m/s] packet, twice: velocity relative to which travel is measured
    double kick;             ///< [s] half the old plus half the new step
    double drift;            ///< [s] new step
    double fastest[4];       ///< out: largest |v - frame| per axis
    double velocity_sum[4];  ///< out: sum of v per axis; not finite if any v is not
};

/// Pairs whose distance is at most scale * (R_i + R_j) + extra.
struct ClosePairs {
    const double* position;
    const Index* i;
    const Index* j;
    Index count;  ///< the columns are readable up to the next multiple of 8
    double scale;
    double extra;  ///< [m]
    Index* found;  ///< out: ascending places in the list; room for count + 8
};

/// Entries of a wall list whose bounding plane is within scale * R + extra of the centre, in the
/// wall's frame: centre - shift, or turned by `rotation` first about `centre`.
struct ClosePatches {
    const double* position;
    const double* planes;  ///< packets {n, d}, one per patch
    const Index* particle;
    const Index* patch;
    Index count;
    double shift[3];     ///< [m] displacement of the wall
    double rotation[9];  ///< rows of the matrix from space to the wall's frame
    double centre[3];    ///< [m] fixed point of the rotation, at the start
    bool rotated;
    double scale;
    double extra;
    Index* found;
};

inline constexpr Index record_size = 14;

/// What a contact leaves for the ledger and for contact frames.
enum RecordField : Index {
    record_damping_x,  ///< [N] dashpot force on j, three components
    record_damping_y,
    record_damping_z,
    record_slip_work,  ///< [J]
    record_stored,     ///< [J]
    record_normal,     ///< [N] spring part
    record_shear_x,    ///< [N] spring part on j, three components
    record_shear_y,
    record_shear_z,
    record_lever_i,   ///< [m]
    record_lever_j,   ///< [m]
    record_normal_x,  ///< [1] unit vector from i to j, three components
    record_normal_y,
    record_normal_z
};

/// What the laws of a contact read besides its geometry.
struct LawView {
    const double* values;  ///< column per value, one row per pair of materials
    Index value_stride;    ///< rows of a column
    Index material_count;
    double timestep;  ///< [s]
};

/// Forces of the touching pairs.
struct PairPass {
    ParticleView particles;
    LawView laws;
    const Index* i;
    const Index* j;
    const Index* touching;  ///< ascending places in the list
    Index touching_count;   ///< the column is readable up to the next multiple of 8
    std::uint8_t*
        active;  ///< by place: 1 if the contact acted in the last step, or was born overlapping
    double* history;  ///< columns by place
    std::size_t history_stride;
    double* records;  ///< by touching contact; unread unless the pass records
};

/// Forces of the contacts with one wall; geometry is in columns of `stride`.
struct WallPass {
    ParticleView particles;
    LawView laws;
    Index count;
    std::size_t stride;
    const Index* particle;
    const double* normal;         ///< three columns: from the particle to the wall
    const double* distance;       ///< [m] from the centre to the wall
    const double* wall_velocity;  ///< three columns [m/s] of the wall at the contact
    const double* wall_spin;      ///< [rad/s] of the wall about the normal
    const double* entered;        ///< 1 if the contact acted in the last step, else 0
    double material;              ///< of the wall
    const double* history_in;     ///< columns
    double* history_out;          ///< columns
    double* force;                ///< three columns: force on the wall [N]
    double* records;              ///< by contact; unread unless the pass records
};

/// One instruction set's passes.
struct Kernels {
    std::string_view isa;
    void (*move)(MotionPass&);
    Index (*find_pairs)(const ClosePairs&);
    Index (*find_patches)(const ClosePatches&);

    /// By combination of laws (contact/law_table.hpp) and whether records are kept.
    void (*pair_pass)(std::size_t combination, bool records, const PairPass&);
    void (*wall_pass)(std::size_t combination, bool records, const WallPass&);
};

/// Passes of one instruction set: "scalar", "sse4", "avx2", "avx512", or "" for the best that this
/// processor has (or what GRAINBENCH_ISA says). Throws Error(bad_input) if it has not got it.
const Kernels& kernels_for(std::string_view isa);

/// Names of the sets that this processor has, slowest first.
std::string_view available_isa(std::size_t n);

}  // namespace grainbench
