// How far the state in which Vertex Block Descent ends lies from the minimiser of the energy that it descends.
//
//   frame ── one step of the fast path ── contacts found at its end, exactly ── fixed
//     fast: sweeps from there, no bound in the way, until the force falls no further
//     reference: Newton in double from there, friction lagged to where the sweeps ended, until only rounding is left
//
// The sweep reads λ, n and w of friction at its own positions. Where it stands still these are the ones of its end, so
// the energy whose friction is lagged there is the one that it has come to a floor of.
#pragma once

#include <cstdint>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::experiments {

/// How far the sweeps of one step, contacts and friction fixed, end from the minimiser of their energy.
struct ToMinimiser {
  std::string scene, device;                                      ///< whose step, and where it was computed
  std::int64_t step = 0;                                          ///< whose state it is
  std::size_t vertices = 0, free_vertices = 0;                    ///< of the scene
  std::size_t vertex_facet_contacts = 0, edge_edge_contacts = 0;  ///< that are fixed
  std::int64_t sweeps = 0;                                        ///< until the floor or the limit
  bool reached_floor = false;                                     ///< else the sweeps came to their limit
  double residual_before = 0, residual = 0;  ///< Eq. 29 with these contacts: before the first sweep, after the last [1]
  double gradient = 0;                       ///< ‖∇E‖ after the last sweep, over all free coordinates [N]
  double energy_above = 0;                   ///< E there less E at the minimiser [J]
  std::int64_t newton_iterations = 0;        ///< of the reference
  double newton_residual = 0;                ///< at the minimiser [1]
  bool newton_converged = false;             ///< to its tolerance
  double largest_distance = 0, rms_distance = 0;  ///< of a vertex between the two states [m]
  /// To the minimiser whose friction is lagged to itself; not-a-number where lagging anew does not come to rest [m].
  double largest_distance_own_friction = 0;
  double rounding = 0;                     ///< half of the spacing of floats at the largest coordinate [m]
  double smallest_eigenvalue = 0;          ///< of the Hessian at the minimiser [N/m]
  double smallest_eigenvalue_between = 0;  ///< the smallest at both states and halfway; 0: not positive definite [N/m]
  /// Of the distance of the two states over all free coordinates, by ‖∇E‖/λ and by √(2 (E − E*)/λ), with the latter
  /// eigenvalue; infinite where it is 0 [m].
  double bound_by_gradient = 0, bound_by_energy = 0;
};

/// `scene`: rounded; `start`: the state before the step. Throws compare::InputError where that step can't be made.
ToMinimiser distance_to_minimiser(const compare::Contestant& contestant, const compare::Scene& scene,
                                  const compare::Snapshot& start, std::int64_t most_sweeps);

}  // namespace ogc::experiments
