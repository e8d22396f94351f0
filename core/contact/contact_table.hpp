/// The scene's contact laws made ready for the passes: which combination of laws, and their values
/// for every pair of materials. Materials are the species, in order, then the wall materials.
#pragma once

#include "core/contact/law_table.hpp"
#include "core/kernels/kernels.hpp"
#include "core/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grainbench {

/// Names of the materials of a scene; a wall material that bears the name of a species is that
/// species.
class Materials {
public:
    Materials() = default;
    explicit Materials(const Scene& scene);

    Index count() const { return static_cast<Index>(names_.size()); }

    /// Index of a name. Throws Error(bad_input) if there is none.
    Index index_of(const std::string& name) const;

    const std::vector<std::string>& names() const { return names_; }

    /// What laws may know of two of them; radii are those of all species.
    MaterialPair pair_of(Index i, Index j) const;

private:
    std::vector<std::string> names_;
    std::vector<double> densities_;  ///< [kg/m^3] 0 for walls
    double smallest_radius_ = 0.0;   ///< [m]
    double largest_radius_ = 0.0;    ///< [m]
};

/// Stiffness of one contact [N/m].
struct ContactStiffness {
    double normal;
    double shear;
};

/// The same corrected for the dashpots, whose velocity lags half a step:
/// K = k / (sqrt(1 + beta^2) - beta)^2 (physics reference 2.2).
struct StepStiffness {
    double normal;
    double shear;
};

class ContactTable {
public:
    ContactTable() = default;
    ContactTable(const Contact& contact, const Materials& materials);

    const LawChoice& choice() const { return choice_; }

    int history_size() const { return layout_of(choice_).history_size; }

    /// Columns of the history that change sign where i and j change places.
    std::vector<std::size_t> turned_columns() const;

    bool has_friction() const { return choice_[friction_slot] != 0; }

    /// Whether contacts turn particles: by friction, which moments need too, or by dashpots.
    bool exerts_torques() const { return has_friction() || has_shear_damping_; }

    bool has_damping() const { return choice_[damping_slot] != 0; }

    /// True if contacts stiffen as they deepen: sums for the stable step go stale by themselves.
    bool stiffens() const {
        return choice_[stiffness_slot] == index_of<HertzStiffness, stiffness_slot>();
    }

    /// Sets the speed of impacts that the stiffnesses of the stable step foresee [m/s]; 1 m/s at
    /// first, 0 for contacts as deep as they are. It matters where contacts stiffen.
    void expect_impacts(double speed);

    /// Step of a lone contact at the expected speed over that at 1 m/s [1].
    double step_of_impact() const { return step_of_impact_; }

    /// Part of the overlap by which the lever of a contact is shorter than the radius [1].
    double lever_cut() const { return lever_cut_; }

    /// Gap over which cohesion acts [m].
    double reach() const { return reach_; }

    /// Stiffness against rolling and twisting over K_s R^2, the largest of all pairs [1].
    double rolling_ratio() const { return rolling_ratio_; }

    double twisting_ratio() const { return twisting_ratio_; }

    LawView view(double timestep) const;

    /// Of a contact between two materials with these radii; radius_j = 0 means a wall. Where
    /// contacts stiffen, at that overlap [m], or as expect_impacts() says if there is none.
    ContactStiffness stiffness(Index material_i,
                               Index material_j,
                               double radius_i,
                               double radius_j,
                               std::optional<double> overlap = std::nullopt) const;

    StepStiffness step_stiffness(Index material_i,
                                 Index material_j,
                                 double radius_i,
                                 double radius_j) const {
        const std::size_t pair = static_cast<std::size_t>(material_i) * materials_ + material_j;
        const ContactStiffness k = constant_.empty()
                                       ? stiffness(material_i, material_j, radius_i, radius_j)
                                       : constant_[pair];
        return {k.normal * step_factor_[2 * pair], k.shear * step_factor_[2 * pair + 1]};
    }

    /// True if the rotational limit of a particle is below its translational one whatever its
    /// contacts: sum K_s R^2 (1 - n^2) on the worst axis is at least 2/3 sum K_s R^2, and I = 2/5 m
    /// R^2.
    bool rotation_rules() const { return rotation_rules_; }

    /// Damping ratios of a pair of materials, normal and shear [1].
    std::pair<double, double> damping(Index material_i, Index material_j) const {
        const std::size_t pair = static_cast<std::size_t>(material_i) * materials_ + material_j;
        return {damping_[2 * pair], damping_[2 * pair + 1]};
    }

    /// Stiffness of unloading over that of loading [1]: above 1 where springs yield.
    double unloading_growth(Index material_i, Index material_j) const {
        return growth_[static_cast<std::size_t>(material_i) * materials_ + material_j];
    }

    /// For each column of the history of `next`, the column of `before` that holds the same
    /// quantity, or -1: laws that stay on keep their history when a stage changes the laws.
    friend std::vector<int> history_sources(const ContactTable& before, const ContactTable& next);

private:
    void resolve_pair(const Contact& contact,
                      const PairContact* changes,
                      const Materials& materials,
                      Index a,
                      Index b);
    void put(Index a, Index b, int value, double x);

    LawChoice choice_{};
    Index materials_ = 0;
    std::vector<double> values_;
    std::vector<double> damping_;      ///< [1] two per pair: beta_n, beta_s
    std::vector<double> growth_;       ///< [1] by pair: stiffness of unloading over that of loading
    std::vector<double> step_factor_;  ///< [1] two per pair: K / k
    bool has_shear_damping_ = false;
    bool rotation_rules_ = false;
    bool uniform_ = false;
    double reach_ = 0.0;                      ///< [m]
    double rolling_ratio_ = 0.0;              ///< [1]
    double twisting_ratio_ = 0.0;             ///< [1]
    double impact_ = 1.0;                     ///< [(m/s)^(4/5)]
    double lever_cut_ = 0.5;                  ///< [1] part of the overlap that levers leave out
    double step_of_impact_ = 1.0;             ///< [1]
    std::vector<ContactStiffness> constant_;  ///< by pair, where it does not depend on radii
};

std::vector<int> history_sources(const ContactTable& before, const ContactTable& next);

}  // namespace grainbench
