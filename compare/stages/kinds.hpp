// The one list of the kinds of elements. The judge's verdicts on rest states and colours, its forms and its colours of
// cases, and the reference's rest state and solvers fold over it. Each kind has these members:
//
//     name, plural     are for messages
//     rest             points to its elements in a rest state, if a rest state has them
//     elements         returns the elements of a scene with its rest state
//     vertices         returns the vertices that an element joins; −1 stands for one that it lacks
//     each_possible    visits the vertices of each stencil that some material would make an element
#pragma once

#include <tuple>
#include <utility>

#include "compare/stages/rest_state.hpp"

namespace ogc::compare {

/// Base of the kinds whose elements a rest state has, with the vertices in one member.
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

/// Base of those whose stencils the mesh lists.
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

/// All of them, in the order in which sums go through them.
using ElementKinds = std::tuple<TriangleKind, HingeKind, SpringKind, TetrahedronKind, SegmentKind>;

/// Holds for kinds whose elements a rest state has.
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

/// Calls `visit` with each kind of a list and its number as a constant: visit.operator()<Kind, number>().
template <class Kinds, class Visit>
void for_each_of(Visit visit) {
  [&]<std::size_t... number>(std::index_sequence<number...>) {
    (visit.template operator()<std::tuple_element_t<number, Kinds>, number>(), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<Kinds>>());
}

}  // namespace ogc::compare
