/// The passes of one instruction set as a table; included by one small file per set, which sets
/// GRAINBENCH_ISA.
#pragma once

#include "core/kernels/contact_pass.hpp"
#include "core/kernels/motion_pass.hpp"
#include "core/kernels/search_pass.hpp"
#include "core/kernels/step_pass.hpp"

#include <utility>

namespace grainbench::GRAINBENCH_ISA {

/// Calls the instance of a pass for one of all combinations of laws; `instance` gives it as
/// instance.template operator()<Laws>().
template <class Instance, std::size_t... C>
auto instance_for(std::size_t combination, const Instance& instance, std::index_sequence<C...>) {
    using Function = decltype(instance.template operator()<LawSetOf<0>>());
    static constexpr Function table[] = {Instance().template operator()<LawSetOf<C>>()...};
    return table[combination];
}

template <class Instance>
auto instance_for(std::size_t combination, const Instance& instance) {
    return instance_for(combination, instance, std::make_index_sequence<combination_count()>{});
}

inline void choose_pair_pass(std::size_t combination, const PairPass& pass) {
    instance_for(combination, []<class Laws>() { return &pair_pass<Laws>; })(pass);
}

inline void choose_wall_pass(std::size_t combination, const WallPass& pass) {
    instance_for(combination, []<class Laws>() { return &wall_pass<Laws>; })(pass);
}

/// Calls act.template operator()<Law>() with the stiffness law of a combination.
template <class Act>
void with_stiffness_law(std::size_t combination, const Act& act) {
    using Laws = std::tuple_element_t<0, LawSlots>;
    const std::size_t choice = choice_of(combination)[0];
    [&]<std::size_t... L>(std::index_sequence<L...>) {
        ((choice == L ? act.template operator()<std::tuple_element_t<L, Laws>>() : void()), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<Laws>>{});
}

inline void choose_pair_steps(std::size_t combination, const PairStepPass& pass) {
    with_stiffness_law(combination, [&]<class Law>() { add_pair_steps<Law>(pass); });
}

inline void choose_wall_steps(std::size_t combination, const WallStepPass& pass) {
    with_stiffness_law(combination, [&]<class Law>() { add_wall_steps<Law>(pass); });
}

constexpr Kernels make_kernels(std::string_view isa) {
    return {.isa = isa,
            .move = &move,
            .measure_travel = &measure_travel,
            .search_cells = &search_cells,
            .find_pairs = &find_pairs,
            .test_pairs = &test_pairs,
            .test_patches = &test_patches,
            .pair_pass = &choose_pair_pass,
            .wall_pass = &choose_wall_pass,
            .add_pair_steps = &choose_pair_steps,
            .add_wall_steps = &choose_wall_steps,
            .largest_step_ratio = &largest_step_ratio};
}

}  // namespace grainbench::GRAINBENCH_ISA
