/// Coarse-grained fields on a regular grid: what the particles of a moment are as a continuum.
///
/// Model    density             rho = sum_i m_i phi(r - x_i)                                   (1)
///          velocity            V = sum_i m_i v_i phi(r - x_i) / rho                           (2)
///          kinetic stress      S_k = sum_i m_i v'_i v'_i phi(r - x_i),  v'_i = v_i - V(r)     (3)
///          granular temperature T = trace(S_k) / (3 rho)                                      (4)
///          contact stress      S_c = sum_c F_c b_c integral_0^1 phi(r - x_i - s b_c) ds       (5)
///          pressure            p = trace(S_c + S_k) / 3                                       (6)
/// Source   Goldhirsch, Granul. Matter 12 (2010) 239-252; contacts with walls, whose branch ends at
///          the contact point, Weinhart et al., Granul. Matter 14 (2012) 289-294.
/// Symbols  r centre of a cell [m]; m mass [kg], x centre [m], v full-step velocity [m/s] of
///          particle i; phi smoothing kernel [1/m^3] (core/measure/smoothing_kernel.hpp); F_c force
///          of a contact on j [N], dashpots included; b_c from the centre of i to that of j [m].
/// Signs    compression is positive, as for the forces of contacts; rows of S_c go with the force,
///          columns with the branch.
/// Derived  the line integral of (5) is in closed form, not by its midpoint. (3) is summed with
///          velocities against the mean of all, so that a bed that moves as one is cold.
/// Limits   one moment: no mean over time. Fields of a point in space, not means over the cell:
///          sums over cells conserve mass, momentum and F b where the kernel is wider than a cell
///          and ends within the grid. Next to a wall the kernel reaches into it, and density falls
///          off. Across a periodic boundary it sees the other end; its reach must be shorter than
///          the period. Moments of rolling and twisting carry no stress here.
#pragma once

#include "core/frame.hpp"
#include "core/measure/measurement.hpp"
#include "core/scene/observables.hpp"

namespace grainbench {

/// Needs the records of all contacts.
FieldFrame coarse_grain(const CoarseGrainingObservable& wanted, const MeasureView& view);

}  // namespace grainbench
