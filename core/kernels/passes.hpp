/// The passes of one instruction set as a table; included by one small file per set, which sets
/// GRAINBENCH_ISA.
#pragma once

#include "core/kernels/contact_pass.hpp"
#include "core/kernels/motion_pass.hpp"
#include "core/kernels/search_pass.hpp"
#include "core/kernels/step_pass.hpp"

#include <utility>

namespace grainbench::GRAINBENCH_ISA {

/// Calls act.template operator()<Laws, keeps_records>() with the laws of a pass.
template <class Act>
void with_laws(std::size_t pass, bool keeps_records, const Act& act) {
    [&]<std::size_t... P>(std::index_sequence<P...>) {
        using Call = void (*)(const Act&);
        static constexpr Call table[][2] = {
            {[](const Act& one) { one.template operator()<OwnLaws<P>, false>(); },
             [](const Act& one) { one.template operator()<OwnLaws<P>, true>(); }}...,
            {[](const Act& one) { one.template operator()<AnyLaws, false>(); },
             [](const Act& one) { one.template operator()<AnyLaws, true>(); }}};
        table[pass][keeps_records ? 1 : 0](act);
    }
    (std::make_index_sequence<general_pass>{});
}

template <class Pass>
bool keeps_records(const Pass& pass) {
    return pass.records != nullptr || pass.stored != nullptr;
}

inline void choose_pair_pass(const PairPass& pass) {
    with_laws(pass.laws.pass, keeps_records(pass), [&]<class Laws, bool keeps_records>() {
        pair_pass<Laws, keeps_records>(pass);
    });
}

inline void choose_wall_pass(const WallPass& pass) {
    with_laws(pass.laws.pass, keeps_records(pass), [&]<class Laws, bool keeps_records>() {
        wall_pass<Laws, keeps_records>(pass);
    });
}

/// Calls act.template operator()<Law>() with the stiffness law, which fills the first slot.
template <class Act>
void with_stiffness_law(const LawChoice& choice, const Act& act) {
    [&]<std::size_t... L>(std::index_sequence<L...>) {
        ((choice[0] == L ? act.template operator()<LawAt<0, L>>() : void()), ...);
    }
    (std::make_index_sequence<slot_sizes[0]>{});
}

inline void choose_pair_steps(const PairStepPass& pass) {
    with_stiffness_law(pass.laws.choice, [&]<class Law>() { add_pair_steps<Law>(pass); });
}

inline void choose_wall_steps(const WallStepPass& pass) {
    with_stiffness_law(pass.laws.choice, [&]<class Law>() { add_wall_steps<Law>(pass); });
}

constexpr Kernels make_kernels(std::string_view isa) {
    return {.isa = isa,
            .move = &move<true>,
            .move_straight = &move<false>,
            .move_damped = &move_damped,
            .measure_travel = &measure_travel,
            .search_cells = &search_cells,
            .test_pairs = &test_pairs,
            .test_pairs_and_doubt = &test_pairs_and_doubt,
            .list_touching = &list_touching,
            .count_bits = &count_bits,
            .select_pairs = &select_pairs,
            .test_patches = &test_patches,
            .pair_pass = &choose_pair_pass,
            .wall_pass = &choose_wall_pass,
            .add_pair_steps = &choose_pair_steps,
            .add_wall_steps = &choose_wall_steps,
            .largest_step_ratio = &largest_step_ratio};
}

}  // namespace grainbench::GRAINBENCH_ISA
