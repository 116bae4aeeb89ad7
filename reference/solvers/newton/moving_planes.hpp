// Limits Newton's step of the free vertices between two detections, pair by pair (method.md §7.6). A fixed ball or
// half-space stops two near vertices even if both move in the same direction; a plane that moves with the pair does
// not. At X_prev a pair (p, q) within r_q has a unit vector n, from closest point to closest point, and the gap
//
//   g = min over q of n·X_prev − max over p of n·X_prev.
//
// A state is inside if no vertex has moved by more than γ_p r_q, and if for every pair
//
//   min over q of n·x − max over p of n·x ≥ (1 − 2γ_p) g                                                          (*)
//
// The first condition keeps pairs apart that are farther than r_q at X_prev. The left side of (*) is a minimum of
// linear functions of all positions, so the set of inside states is convex. On the straight path from X_prev or an
// inside state to an inside state, a plane with the normal n always separates the hulls of p and q. (*) is weaker than
// Eq. 21. If all vertices stay in their balls of radius γ_p d, (*) holds, too; but (*) restricts only approach.
//
// Positions are doubles within a step, but X_prev and stored positions are rounded. So the right side of (*) is
// enlarged by the rounding error. If the gap is too small for that, the pair's vertices stay at X_prev.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/geometry/pair_planes.hpp"
#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// The planes of all pairs of one detection.
class MovingPlanes {
 public:
  MovingPlanes() = default;
  /// Takes all pairs within r_q [m] at X_prev, and the mobility of the vertices. `relaxation` is γ_p.
  MovingPlanes(const std::vector<NearPair>& pairs, const std::vector<compare::Vec3f>& previous,
               const std::vector<Mobility>& mobility, double query_radius, double relaxation);

  /// Moves the vertices that must stay at X_prev to X_prev. x must be X_prev up to rounding.
  void enter(State& x) const;
  /// Returns `step` [m], changed for the free vertices so that x + step is inside; x must be inside. First cuts the
  /// step to the balls. Then moves apart, in sweeps, the sides of pairs that would come too near. Finally scales the
  /// steps of vertices whose pairs are still too near.
  State truncated(const State& x, State step) const;
  /// Returns the largest share in [0, 1], up to rounding, for which x + share · step is certainly inside.
  double share_inside(const State& x, const State& step) const;
  /// Returns a share in [0, 1] of `step` by which `vertex` can move from x, if all others stay, so that x is certainly
  /// still inside.
  double share_inside(const State& x, std::size_t vertex, const Triple<double>& step) const;
  /// Checks exactly whether stored positions keep every pair apart.
  bool kept_by(const std::vector<compare::Vec3f>& stored) const;

 private:
  struct Pair {
    std::array<std::size_t, 4> vertices{};
    std::size_t second_from = 1;
    Triple<double> normal;
    double least = 0;  ///< least allowed separation [m]
    double gap = 0;    ///< g of the head of this file [m]
  };
  /// Returns the smallest n·x of the second side minus the largest n·x of the first side; `at` maps a vertex to x.
  template <class At>
  static double separation(const Pair& pair, At at);
  double share_in_ball(std::size_t vertex, const Triple<double>& x, const Triple<double>& step) const;
  std::vector<std::uint32_t> endangered(const State& x, const State& step) const;
  bool move_apart(const Pair& pair, const State& x, State& step) const;
  /// Computes for each vertex the largest share of its step that its ball and its pairs allow. Returns whether all
  /// shares are 1.
  bool shares(const State& x, const State& step, std::vector<double>& share) const;

  bool stays(std::size_t vertex) const { return mobility_[vertex] == Mobility::fixed || radius_[vertex] == 0; }
  bool yields(std::size_t vertex) const { return mobility_[vertex] == Mobility::free && radius_[vertex] > 0; }

  State centre_;
  double ball_ = 0;             ///< γ_p r_q [m]
  std::vector<double> radius_;  ///< radius of the ball about X_prev, reduced by rounding; 0 if the vertex stays [m]
  std::vector<Mobility> mobility_;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> first_of_, of_vertex_;  ///< pairs of each vertex
};

}  // namespace ogc::reference
