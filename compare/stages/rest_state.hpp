// Stage rest_state: what a simulation computes once from the rest shape: masses, membrane and hinge stencils, rest
// lengths, materials of bodies that meet (method.md §4.5 to §4.10). Its Out is part of sweep's In: both contestants
// then sweep with the same single-precision numbers.
#pragma once

#include <tuple>
#include <vector>

#include "compare/problem/scene.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// A triangle with a membrane energy.
struct RestTriangle {
  Triangle corner{};  ///< in the order of the mesh
  Index body = -1;    ///< gives the material
  float area = 0;     ///< A [m²]
  /// ∇N₁, ∇N₂ [1/m] in the frame whose first axis points from corner 0 to corner 1, corner 2 above it
  std::array<std::array<float, 2>, 2> gradient{};
};

/// A hinge with a bending energy.
struct RestHinge {
  std::array<Index, 4> vertex{};  ///< x0 < x1 of the edge, then Hinge::opposite
  Index body = -1;                ///< gives the material
  float rest_angle = 0;           ///< θ₀ [rad], defined as θ of compare/stages/bending.hpp
  float stiffness = 0;            ///< c = k_b · 3 ‖e‖²/(A₀ + A₁) [J]
  /// Weights w of x1, o0, o1 in the isometric quadratic model [1/m]; 0 in other models. They are K/‖e‖ with the sums K
  /// of cotangents. With a = o0 − x0 and b = o1 − x0:
  ///   w(x1) = (e·a/‖e × a‖ + e·b/‖e × b‖)/‖e‖,  w(o0) = −‖e‖/‖e × a‖,  w(o1) = −‖e‖/‖e × b‖
  std::array<float, 3> weight{};
};

/// A tetrahedron of a solid. The numbers of the elastic energy (`weight`, `inverse`) and those of F (`gradient`,
/// `volume`) are rounded independently.
struct RestTetrahedron {
  Tetrahedron corner{};                            ///< in the order of the mesh
  Index body = -1;                                 ///< gives the material
  float volume = 0;                                ///< V [m³]
  float inverse = 0;                               ///< 1/(6V) [1/m³]
  std::array<float, 6> weight{};                   ///< V ∇N_k·∇N_l for the pairs 01, 02, 03, 12, 13, 23 [m]
  std::array<std::array<float, 3>, 3> gradient{};  ///< ∇N₁, ∇N₂, ∇N₃ [1/m]
};

/// Material of two bodies that meet: harmonic mean of k_c [N/m] (0 where both are 0), arithmetic mean of μ [1].
struct MeetingMaterial {
  float stiffness = 0, friction = 0;  ///< k_c [N/m], μ_c
};

/// A segment of a rod, free, prescribed or fixed. If exactly two segments share a vertex, each is the other's neighbour
/// there.
///
/// Rest frames are defined along a walk over neighbours. A chain's walk begins at the lower-numbered of its two end
/// segments. A ring's walk begins at its lowest-numbered segment, from x₀ to x₁.
///
/// - The first frame is the smallest rotation from e₃ to x₁ − x₀. If x₁ − x₀ points along −e₃, it is a rotation by π
///   about the first axis.
/// - Each next frame is the frame before it, rotated by the smallest rotation between the two directions of the walk.
///   If exactly one of the two segments points against the walk, the next frame is then rotated by π about its own
///   first axis (q i).
struct RestSegment {
  Edge end{};                              ///< x₀, x₁ in the order of the scene's loose edge
  Index body = -1;                         ///< gives the material
  float length = 0;                        ///< l [m]
  std::array<Index, 2> neighbour{-1, -1};  ///< segments behind and ahead; −1: none
  std::array<float, 2> weight{};           ///< w = 4 k_b/l̄ [N m], l̄ = (l + l_f)/2; 0 without a neighbour
  /// relative rotations p°: q̄°_f q° for the neighbour behind, q̄° q°_f for the neighbour ahead, where q°_f is the
  /// neighbour's frame; 0 without a neighbour
  std::array<Quaternion, 2> relative{};
  Quaternion orientation{};  ///< q°; q° and p° may have either sign
};

/// A scene, rounded (`round_to_single`) and valid (`validate`), except that k_c may be 0. Every vertex belongs to a
/// triangle, a tetrahedron or a segment, unless it is prescribed or fixed. Topology: `build_topology(scene)`.
struct RestStateIn {
  const Scene* scene = nullptr;        ///< rounded
  const Topology* topology = nullptr;  ///< of the scene's mesh
};

/// The answer. `triangles` and `hinges` omit elements of fixed bodies, of solids and of models `none`; `tetrahedra`
/// omits elements of fixed bodies.
struct RestStateOut {
  /// m_v [kg]: a third of ρ A of each triangle at v, on solids a quarter of ρ V of each tetrahedron, half of ρ l of
  /// each segment; 0 on fixed bodies
  std::vector<float> mass;
  std::vector<RestTriangle> triangles;     ///< in the order of the mesh
  std::vector<RestHinge> hinges;           ///< in the order of the topology
  std::vector<float> edge_length_squared;  ///< ‖ē‖² by edge [m²]
  std::vector<MeetingMaterial> meetings;   ///< for bodies a and b at a · bodies + b
  std::vector<RestTetrahedron> tetrahedra{};
  std::vector<RestSegment> segments{};  ///< of all rods, in the order of rod_segments (compare/problem/rods.hpp)
};

/// Values f in double precision with their error scales Σ ‖∂f/∂q‖ ‖q‖ over the inputs q, where coordinates are vectors
/// relative to one vertex. `gradient` has one scale for ∇N₁ and one for ∇N₂; `weight` has one scale for its three
/// numbers. The scale of a mass is the sum of the scales of its elements. The scale of a meeting material is its value.
struct RestStateTruth {
  RestStateOut exact;                    ///< correctly rounded
  std::vector<double> mass, mass_scale;  ///< by vertex [kg]
  /// areas by triangle and squared lengths by edge, with their error scales [m²]
  std::vector<double> area, area_scale, edge_length_squared, edge_length_squared_scale;
  std::vector<std::array<std::array<double, 2>, 2>> gradient;  ///< by triangle: ∇N₁, ∇N₂ [1/m]
  std::vector<std::array<double, 2>> gradient_scale;           ///< by triangle: error scales of ∇N₁ and ∇N₂
  /// either sign of θ₀ is accepted where |θ₀| differs from π by at most its error
  std::vector<double> rest_angle, rest_angle_scale, stiffness, stiffness_scale;
  std::vector<std::array<double, 3>> weight;
  std::vector<double> weight_scale;
  std::vector<double> meeting_stiffness, meeting_friction;
  std::vector<double> volume, volume_scale, inverse, inverse_scale;
  /// one error scale for all weights of a tetrahedron, and one for all its gradients
  std::vector<std::array<double, 6>> tetrahedron_weight;
  std::vector<std::array<std::array<double, 3>, 3>> tetrahedron_gradient;
  std::vector<double> tetrahedron_weight_scale, tetrahedron_gradient_scale;
  std::vector<double> segment_length, segment_length_scale;                 ///< by segment [m]
  std::vector<std::array<double, 2>> segment_weight, segment_weight_scale;  ///< behind, ahead [N m]
  std::vector<std::array<double, 4>> segment_orientation;                   ///< q°
  std::vector<std::array<std::array<double, 4>, 2>> segment_relative;       ///< p° behind, ahead; 0: none
  /// error scale of q° and p°: 1 + Σ 1/cos(θ/2) over the smallest rotations, by angles θ, from the first segment of the
  /// walk (RestSegment) to this segment. The scale is infinite if the sum exceeds 2²⁰; any unit quaternion is then
  /// accepted
  std::vector<double> segment_frame_scale;
};

/// Largest error in units of u · scale, u = 2⁻²⁴. Rounding to single precision errs by at most u times the value, and
/// the value does not exceed its scale, except for θ₀. The scale of θ₀ is at least 2, because each of the two opposite
/// vertices adds its distance from x0 over its height. |θ₀| ≤ π, so rounding θ₀ errs by up to π/2 in these units. Rest
/// data are computed in double or better: some thirty roundings of 2⁻⁵³, relative to the size of an input, add about
/// 2⁻²⁴.
inline constexpr double rest_state_tolerance = 1 + 0x1p-20;
inline constexpr double rest_state_angle_tolerance = 1.6;

// The structs below are the kinds of elements; ElementKinds lists them. The judge (verdicts on rest states and colours,
// wrong forms, colours of cases) and the reference (rest state, solvers) fold over this list. Each kind has these
// members:
//
//     name, plural     are for messages
//     rest             points to its elements in a rest state, if a rest state has them
//     elements         returns the elements of a scene with its rest state
//     vertices         returns the vertices that an element joins; −1 stands for one that it lacks
//     each_possible    visits the vertices of each stencil that is an element if its material has the energy

/// Base of the element kinds that a rest state lists. `list` is the member of RestStateOut with the elements; `joined`
/// is the member of an element with its vertices.
template <auto list, auto joined>
struct OfRestState {
  static constexpr auto rest = list;  ///< points to the elements
  /// Returns the elements.
  template <class AnyScene, class Rest>
  static auto& elements(AnyScene&, Rest& from) {
    return from.*list;
  }
  /// Returns the vertices.
  template <class Element>
  static const auto& vertices(const Element& element) {
    return element.*joined;
  }
};

/// Base of the element kinds whose possible stencils are the member `stencils` of the mesh.
template <auto list, auto joined, auto stencils>
struct OfMesh : OfRestState<list, joined> {
  /// Visits each stencil of the mesh.
  template <class Visit>
  static void each_possible(const Scene& scene, const Topology&, Visit visit) {
    for (const auto& vertices : scene.mesh.*stencils) visit(vertices);
  }
};

/// Triangles with a membrane.
struct TriangleKind : OfMesh<&RestStateOut::triangles, &RestTriangle::corner, &Mesh::triangles> {
  static constexpr const char *name = "triangle", *plural = "triangles";  ///< for messages
};

/// Hinges with a bending energy.
struct HingeKind : OfRestState<&RestStateOut::hinges, &RestHinge::vertex> {
  static constexpr const char *name = "hinge", *plural = "hinges";  ///< for messages
  /// Visits each hinge of the topology.
  template <class Visit>
  static void each_possible(const Scene&, const Topology& topology, Visit visit) {
    for (const Hinge& hinge : topology.hinges) {
      const Edge& edge = topology.edges[static_cast<std::size_t>(hinge.edge)];
      visit(std::array{edge[0], edge[1], hinge.opposite[0], hinge.opposite[1]});
    }
  }
};

/// Springs, which the scene itself lists.
struct SpringKind {
  static constexpr const char *name = "spring", *plural = "springs";  ///< for messages
  /// Returns the elements.
  template <class AnyScene, class Rest>
  static auto& elements(AnyScene& scene, Rest&) {
    return scene.springs;
  }
  /// Returns the vertices.
  static std::array<Index, 3> vertices(const Spring& element) { return {element.first, element.second, element.third}; }
  /// Visits each spring of the scene.
  template <class Visit>
  static void each_possible(const Scene& scene, const Topology&, Visit visit) {
    for (const Spring& spring : scene.springs) visit(vertices(spring));
  }
};

/// Tetrahedra of solids.
struct TetrahedronKind : OfMesh<&RestStateOut::tetrahedra, &RestTetrahedron::corner, &Mesh::tetrahedra> {
  static constexpr const char *name = "tetrahedron", *plural = "tetrahedra";  ///< for messages
};

/// Segments of rods.
struct SegmentKind : OfMesh<&RestStateOut::segments, &RestSegment::end, &Mesh::loose_edges> {
  static constexpr const char *name = "segment", *plural = "segments";  ///< for messages
};

/// All kinds, in the order in which sums add them.
using ElementKinds = std::tuple<TriangleKind, HingeKind, SpringKind, TetrahedronKind, SegmentKind>;

/// Is true for kinds whose elements a rest state has.
template <class Kind>
concept InRestState = requires {
  Kind::rest;
};

/// Selects the kinds whose elements a rest state has.
template <class... Kinds>
auto in_rest_state(std::tuple<Kinds...>)
    -> decltype(std::tuple_cat(std::conditional_t<InRestState<Kinds>, std::tuple<Kinds>, std::tuple<>>()...));
/// The kinds whose elements a rest state has.
using RestKinds = decltype(in_rest_state(ElementKinds()));

}  // namespace ogc::compare
