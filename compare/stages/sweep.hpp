// Stage sweep: one iteration of Algorithm 4 with all energies (method.md §5.2, §7). It updates prescribed vertices,
// then the orientations of rods' segments (compare/rods.md), then free vertices colour by colour. Each new position is
// truncated before it is written.
//
// Answers are judged vertex by vertex. The truth about a vertex is the update from the answer's own new positions at
// vertices of lower colour and the old positions elsewhere. If each update is right, the sweep is right, by induction
// over the colours. So no tolerance hides errors of other vertices, and the judge names the wrong vertex.
#pragma once

#include <span>

#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "compare/stages/orientation.hpp"
#include "compare/stages/plane.hpp"
#include "compare/stages/rest_state.hpp"
#include "compare/stages/volume_depth.hpp"

namespace ogc::compare {

/// Input of the stage. The sweep sets x ← truncated(x + H⁻¹ f) for free vertices. f and H sum up inertia, membrane,
/// bending, the scene's springs, tetrahedra, rods, contact, friction and volumes, as the stages of these names define
/// them. Prescribed vertices (`is_prescribed`) go to y, truncated. All others stay, also those of driven volumes, which
/// the step has already placed.
///
/// While colour c is solved, a vertex u is read at its new position if colour(u) < c, else at its old one; a vertex
/// reads itself at its old position. Order: prescribed vertices, then free segments, then free vertices. A segment is
/// updated as in stage `orientation`. It reads prescribed ends at their new positions, free ends at their old ones, and
/// neighbours of lower colour at their new quaternions. Vertices read new quaternions only. With damping by vertex,
/// orientations are not damped.
///
/// m/h², k_d/h and ε_v h are formed from the given numbers and rounded at most once. A listed contact that is beyond r
/// at the positions read has no force, but keeps its block.
struct SweepIn {
  const Scene* scene = nullptr;        ///< rounded; materials, settings (h, r, ε_v, lanes)
  const Topology* topology = nullptr;  ///< of the scene's mesh
  const RestStateOut* rest = nullptr;  ///< of the scene
  /// colour by vertex, from 0; −1: prescribed or fixed. The vertices of one membrane or hinge stencil, spring or
  /// tetrahedron have different colours
  std::span<const Index> colour;
  std::span<const Vec3f> old, start, target, previous;  ///< x, xᵗ, y, X_prev [m]; contacts were found at X_prev
  std::span<const float> bound;                         ///< b_v [m]
  std::span<const VertexFacetContact> vertex_facet;     ///< canonical order
  std::span<const EdgeEdgeContact> edge_edge;
  /// Half-spaces of the vertices from the detection at X_prev; null if bounds are balls
  const VertexPlanes* planes = nullptr;
  /// Contacts with volumes in canonical order: ascending by point, inside, triangle, face. `point` is the vertex;
  /// `triangle` and `face` are numbers of the scene. Forces act on the point and on free corners, with the frozen
  /// weights and direction. `inside`, `face` and `depth` are not read.
  std::span<const VolumeContact> volumes{};
  /// Colour by segment, in the order of RestStateOut::segments, from 0; −1: fixed or prescribed. Neighbours have
  /// different colours
  std::span<const Index> segment_colour{};
  std::span<const Quaternion> orientation{}, orientation_start{};  ///< q, qᵗ
};

/// The answer.
struct SweepOut {
  std::vector<Vec3f> position;  ///< [m]; each lies in its region exactly
  Index cut = 0;  ///< number of vertices, prescribed ones included, whose proposal lay outside of their region
  std::vector<Quaternion> orientation{};  ///< by segment; segments that are not free keep the old one
};

/// The exact update of each vertex, computed from the answer's new positions at vertices of lower colour, and the
/// largest accepted error [m] in the direction of the answer's error. The accepted error is the sum of several errors:
/// the errors of f and H (within the tolerances of their stages), transformed by H⁻¹, and those of the solve, of the
/// truncation and of storing. It is 0 if the answer must be `position` bit for bit.
///
/// A vertex is `grey` if a stencil has more than one accepted answer. `position` then comes from the combination of
/// accepted answers that is nearest to the contestant's answer. A vertex is also grey if it is *ill-conditioned*: the
/// errors of H alone could make H singular, ‖H⁻¹‖ ‖δH‖ ≥ 1/2. Then the error of a single-precision solve is unlimited,
/// and a solver may move the vertex along the force instead. So `accepted` is infinite. Exception: `accepted` is 0 if
/// the vertex was not cut and moved against its force by more than the errors of f and H allow.
///
/// `accepted` is also infinite if half-spaces cut a free vertex, or may cut it. The judge then only requires that the
/// vertex lies in its region. Stage truncate judges how it slides.
struct SweepTruth {
  std::vector<Vec3> position;      ///< computed from the answer's positions of the neighbours [m]
  std::vector<double> accepted;    ///< largest error [m]
  std::vector<std::uint8_t> grey;  ///< 1 where a decision may go either way
  /// number of certain cuts, and of doubtful ones (proposals within their error of the bound)
  Index cut = 0, cut_doubtful = 0;
  std::vector<Index> free_segments{};  ///< segments with an entry in `orientation`, ascending
  OrientationTruth orientation{};      ///< by free segment, computed from the answer's quaternions of the neighbours
};

/// Rounding errors that a sweep adds to those that the energies' stages count, in units of u · scale of each stage, u =
/// 2⁻²⁴. Answer and truth each round ∇N₀ of a triangle, w(x0) of a hinge, k_d/h and ε_v h once.
inline constexpr double sweep_input_tolerance = 2;
/// Rounding errors of adding up the terms of a stencil's block; each is at most u times a partial sum of moduli. There
/// are at most four terms (membrane), and the largest is at most √(3/2) times the whole block (friction: the identity,
/// from which n nᵀ is subtracted): 4 √(3/2) < 5. The force is added once.
inline constexpr double sweep_block_additions = 5;
/// Error of the inertia's force in units of u w ‖y − x‖, w = m/h²: a difference (1), w (1), a product (1). The
/// inertia's block errs by u w √3.
inline constexpr double sweep_inertia_tolerance = 3;
/// Backward error |E| ≤ γ |L||D||Lᵀ| of the 3×3 solve in units of u ‖H‖₂. The factors of Cholesky or LDLᵀ and both
/// substitutions give 3n + 1 rounding errors with n = 3, the divisions of LDLᵀ 2 more: γ = 12 u. The norm of |L||D||Lᵀ|
/// is at most n ‖H‖₂.
inline constexpr double sweep_solve_tolerance = 36;

}  // namespace ogc::compare
