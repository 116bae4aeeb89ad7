// Stage sweep: one iteration of Algorithm 4 with all energies, colour by colour, each new position truncated before it
// is written (method.md §5.2, §7), after the orientations of the segments of rods (compare/rods.md).
//
// Answers are judged vertex by vertex: the truth about a vertex is the update from the answer's own positions at
// vertices of lower colour and the old positions elsewhere. An answer with each update right is a right sweep, by
// induction over the colours; no error is carried on and hidden in a tolerance, and the judge names the vertex that is
// wrong.
#pragma once

#include <span>

#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "compare/stages/orientation.hpp"
#include "compare/stages/plane.hpp"
#include "compare/stages/rest_state.hpp"
#include "compare/stages/volume_depth.hpp"

namespace ogc::compare {

/// x ← truncated(x + H⁻¹ f) for free vertices, with f and H of inertia, membrane, bending, the scene's springs,
/// tetrahedra, rods, contact, friction and volumes as in the stages of these names. Prescribed vertices
/// (`is_prescribed`) go to y, truncated; all others stay, also those of driven volumes, which the step has already
/// placed. While colour c is solved, a vertex u is read at its new position if colour(u) < c, else at its old one; the
/// own position is the old one. Prescribed vertices come first, then segments that nothing holds, each as in the stage
/// `orientation`: prescribed ends are read at their new positions, free ends at their old ones, and neighbours of lower
/// colour at their new quaternions. Vertices read new quaternions only. With damping by vertex frames are not damped.
/// m/h², k_d/h and ε_v h are formed from the given numbers and rounded at most once. A listed contact that is beyond r
/// at the positions that are read has no force, and keeps its block.
struct SweepIn {
  const Scene* scene = nullptr;        ///< rounded; materials, settings (h, r, ε_v, lanes)
  const Topology* topology = nullptr;  ///< of the scene's mesh
  const RestStateOut* rest = nullptr;  ///< of the scene
  /// by vertex, from 0; −1: prescribed or fixed. No two vertices of a membrane or hinge stencil, of a spring or of a
  /// tetrahedron share a colour
  std::span<const Index> colour;
  std::span<const Vec3f> old, start, target, previous;  ///< x, xᵗ, y, X_prev [m]; contacts were found at X_prev
  std::span<const float> bound;                         ///< b_v [m]
  std::span<const VertexFacetContact> vertex_facet;     ///< canonical order
  std::span<const EdgeEdgeContact> edge_edge;
  /// Half-spaces that the vertices bear since that detection; null with balls alone
  const VertexPlanes* planes = nullptr;
  /// `point` is the vertex, `triangle` and `face` are numbers of the scene; canonical order. Forces act with the frozen
  /// weights and direction on the point and on the corners, if they are free; `inside`, `face` and `depth` are not
  /// read.
  std::span<const VolumeContact> volumes{};
  /// By segment, in the order of RestStateOut::segments. From 0; −1: held. No two neighbours share a colour
  std::span<const Index> segment_colour{};
  std::span<const Quaternion> orientation{}, orientation_start{};  ///< q, qᵗ
};

/// The answer.
struct SweepOut {
  std::vector<Vec3f> position;  ///< [m]; each lies in its region exactly
  Index cut = 0;                ///< vertices, prescribed ones included, whose proposal lay outside of its region
  std::vector<Quaternion> orientation{};  ///< by segment; held ones keep theirs
};

/// By vertex: the exact update from the answer's own lower colours, and the largest error of a right answer [m] in the
/// direction of this answer: the errors of f and H within the tolerances of their stages through H⁻¹, of the solve, of
/// the truncation, of storing. 0 where the answer must be `position` bit for bit. `grey`: a stencil of the vertex has
/// more than one accepted answer (`position` then comes from the combination nearest to the answer), or the vertex is
/// *ill-conditioned*: the errors of H alone could make it singular, ‖H⁻¹‖ ‖δH‖ ≥ 1/2. No single-precision solve can
/// then be held to a position, and a solver may fall back to a step down the gradient: `accepted` is infinite, except
/// that it is 0 if the vertex was not cut and moved against its force beyond all error. It is also infinite where
/// half-spaces cut a free vertex, or may: the judge then requires only that it lies in its region. Stage truncate
/// judges how it slides.
struct SweepTruth {
  std::vector<Vec3> position;          ///< computed from the answer's own neighbours [m]
  std::vector<double> accepted;        ///< largest error [m]
  std::vector<std::uint8_t> grey;      ///< 1 where a decision may go either way
  Index cut = 0, cut_doubtful = 0;     ///< certain cuts, and proposals within their error of the bound
  std::vector<Index> free_segments{};  ///< segments that `orientation` is about, ascending
  OrientationTruth orientation{};      ///< by free segment, computed from the answer's own neighbours
};

/// Roundings that the sweep adds to the tolerances of its stages, in their units u · scale: ∇N₀ of a triangle, w(x0) of
/// a hinge, k_d/h and ε_v h are rounded once by either side.
inline constexpr double sweep_input_tolerance = 2;
/// Additions of a stencil to the block, each rounded to u of a partial sum of moduli: at most four parts (membrane),
/// the largest of which (friction's identity before the normal is taken out of it) is √(3/2) of the whole: less than 5.
/// The force is added once.
inline constexpr double sweep_block_additions = 5;
/// Error of the inertia: u w ‖y − x‖ times difference (1), weight w = m/h² (1), product (1); and u w √3 in the block.
inline constexpr double sweep_inertia_tolerance = 3;
/// Backward error of the solve in units of u ‖H‖₂: |E| ≤ γ₁₀ |L||D||Lᵀ| for Cholesky's and LDLᵀ's factors and both
/// substitutions (3n + 1, n = 3; two more for the divisions of LDLᵀ), whose norm is at most n ‖H‖₂.
inline constexpr double sweep_solve_tolerance = 36;

}  // namespace ogc::compare
