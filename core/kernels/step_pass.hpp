/// Sums over contacts for the stable step (core/integrate/stable_step.hpp has the equations).
#pragma once

#include "core/contact/law_table.hpp"
#include "core/kernels/contact_pass.hpp"

namespace grainbench::GRAINBENCH_ISA {

/// The step factors and the values of a stiffness law, which fills the first slot.
template <class Law>
struct StepValues : BlockValues<step_factor_count + Law::value_count> {
    static constexpr int count = step_factor_count + Law::value_count;

    explicit StepValues(const LawView& view) : BlockValues<count>(view, 0, count) {}

    void look_up(const LawView& view, Pack material_i, Pack material_j) {
        BlockValues<count>::look_up(view, 0, count, material_i, material_j);
    }
};

/// Normal and shear stiffness of a block of contacts that count for the stable step [N/m]:
/// ContactTable::step_stiffness in lanes.
struct StiffnessPair {
    Pack normal, shear;

    /// \param impact see LawView
    template <class Law>
    static StiffnessPair of(const StepValues<Law>& values, double impact, Geometry<Pack>& g) {
        Load<Pack> load;
        const auto law_values =
            values_of<Law, Pack>([&](int k) { return values.value[step_factor_count + k]; });
        if constexpr (grows_with_overlap<Law>) {
            g.overlap = larger(g.overlap,
                               Law::expected_overlap(law_values, Pack(impact), g.effective_radius));
        }
        Law::apply(
            law_values, g, static_cast<const Pack*>(nullptr), static_cast<Pack*>(nullptr), load);
        return {load.stiffness_n * values.value[0], load.stiffness_s * values.value[1]};
    }
};

/// Contributions of a block of contacts to the sums of their particles.
class StepShares {
public:
    StepShares(const StiffnessPair& k, const Vec3Of<Pack>& normal_square, const StepSums& sums)
        : sums_(sums) {
        store_packets(k.shear * normal_square, k.shear, shear_);
        if (sums.normal != nullptr) {
            store_packets(k.normal * normal_square, Pack{}, normal_);
        }
    }

    void add_to(Index row, Index lane) const {
        add_packet(sums_.shear + 4 * std::size_t{row}, shear_ + 4 * lane);
        if (sums_.normal != nullptr) {
            add_packet(sums_.normal + 4 * std::size_t{row}, normal_ + 4 * lane);
        }
    }

private:
    StepSums sums_;
    alignas(64) double shear_[4 * width];
    alignas(64) double normal_[4 * width];
};

template <class Law>
GRAINBENCH_FLATTEN void add_pair_steps(const PairStepPass& given) {
    const PairStepPass pass = given;  // that no store of sums could change
    const ParticleView& p = pass.particles;
    StepValues<Law> values(pass.laws);
    /// \param valid contacts of a block; known to the compiler where it is full
    const auto add_block = [&](Index first, auto valid) __attribute__((always_inline)) {
        const auto lane = [&](Index l) { return first + (l < valid ? l : valid - 1); };
        const auto of_i = [&](Index l) { return pass.i[lane(l)]; };
        const auto of_j = [&](Index l) { return pass.j[lane(l)]; };
        const PacketRows row_i = load_rows(p.position, of_i);
        const PacketRows row_j = load_rows(p.position, of_j);
        const Packets both = span(row_i, row_j);
        Geometry<Pack> g{};
        if constexpr (contains(Law::needs, Needs::radii)) {
            g.area_radius = smaller(row_i.components().w, row_j.components().w);
            g.length = both.w;
        }
        const Vec3Of<Pack>& apart = both.xyz;
        const Pack square = dot(apart, apart);
        if constexpr (grows_with_overlap<Law>) {
            g.effective_radius = row_i.components().w * row_j.components().w / both.w;
            g.overlap = both.w - square_root(square);
        }
        const Mask is_apart = Pack{} < square;
        const Pack inverse =
            select(is_apart, Pack(1.0) / select(is_apart, square, Pack(1.0)), Pack{});
        if (!pass.laws.uniform) {
            values.look_up(pass.laws, load_packets(p.spin, of_i).w, load_packets(p.spin, of_j).w);
        }
        const StepShares shares(
            StiffnessPair::of<Law>(values, pass.laws.impact, g),
            {apart.x * apart.x * inverse, apart.y * apart.y * inverse, apart.z * apart.z * inverse},
            pass.sums);
        for (Index l = 0; l < valid; ++l) {
            shares.add_to(of_i(l), l);
            shares.add_to(of_j(l), l);
        }
    };
    Index first = 0;
    for (; pass.count - first >= width; first += width) {
        add_block(first, std::integral_constant<Index, width>{});
    }
    if (first < pass.count) {
        add_block(first, pass.count - first);
    }
}

template <class Law>
GRAINBENCH_FLATTEN void add_wall_steps(const WallStepPass& pass) {
    StepValues<Law> values(pass.laws);
    for (Index first = 0; first < pass.count; first += width) {
        const Index valid = pass.count - first < width ? pass.count - first : width;
        const auto place = [&](Index l) { return first + (l < valid ? l : valid - 1); };
        const auto row = [&](Index l) { return pass.particle[place(l)]; };
        const Packets wall = load_packets(pass.geometry, place);
        const Vec3Of<Pack>& n = wall.xyz;
        Geometry<Pack> g{};
        if constexpr (contains(Law::needs, Needs::radii)) {
            g.area_radius = load_packets(pass.particles.position, row).w;
            g.length = g.area_radius;
        }
        if constexpr (grows_with_overlap<Law>) {
            g.effective_radius = load_packets(pass.particles.position, row).w;
            g.overlap = g.effective_radius - wall.w;
        }
        if (!pass.laws.uniform) {
            values.look_up(
                pass.laws, load_packets(pass.particles.spin, row).w, Pack(pass.material));
        }
        const StepShares shares(StiffnessPair::of<Law>(values, pass.laws.impact, g),
                                {n.x * n.x, n.y * n.y, n.z * n.z},
                                pass.sums);
        for (Index l = 0; l < valid; ++l) {
            shares.add_to(row(l), l);
        }
    }
}

GRAINBENCH_FLATTEN inline double largest_step_ratio(const ParticleView& given,
                                                    const StepSums& given_sums,
                                                    bool takes_away) {
    const ParticleView p = given;  // that no store could change
    const StepSums sums = given_sums;
    const auto clear = [&](double* rows, std::size_t first) {
        for (Index k = 0; k < 4; ++k) {
            store(Pack{}, rows + 4 * first + k * width);
        }
    };
    Pack largest;
    for (std::size_t first = 0; first < p.padded_count; first += width) {
        const auto row = [&](Index l) { return first + l; };
        const Packets shear = load_packets(sums.shear, row);
        const Pack inverse_mass = load_packets(p.velocity, row).w;
        const Pack least = smaller(shear.xyz.x, smaller(shear.xyz.y, shear.xyz.z));
        // kappa / I with I = 2/5 m R^2 and lever R (2). Moments raise it: what is stiff against
        // rolling about an axis is the part of the normals across it, against twisting the rest.
        Pack turning = shear.w - least;
        if (sums.rolling > 0.0 || sums.twisting > 0.0) {
            const auto about = [&](Pack along) {
                return Pack(1.0 + sums.rolling) * (shear.w - along) + Pack(sums.twisting) * along;
            };
            turning = larger(about(shear.xyz.x), larger(about(shear.xyz.y), about(shear.xyz.z)));
        }
        largest = larger(largest, Pack(2.5) * inverse_mass * turning);
        if (sums.normal != nullptr) {
            const Packets normal = load_packets(sums.normal, row);
            const Vec3Of<Pack> k{normal.xyz.x + (shear.w - shear.xyz.x),
                                 normal.xyz.y + (shear.w - shear.xyz.y),
                                 normal.xyz.z + (shear.w - shear.xyz.z)};
            largest = larger(largest, inverse_mass * larger(k.x, larger(k.y, k.z)));
        }
        if (takes_away) {
            clear(sums.shear, first);
            if (sums.normal != nullptr) {
                clear(sums.normal, first);
            }
        }
    }
    double lanes[width];
    store(largest, lanes);
    double result = 0.0;
    for (const double lane : lanes) {
        result = result < lane ? lane : result;
    }
    return result;
}

}  // namespace grainbench::GRAINBENCH_ISA
