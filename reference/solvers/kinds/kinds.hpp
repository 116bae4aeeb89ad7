// The one list of the kinds of elements that the reference knows. Potential, vertex systems, the judged sweep and
// colours fold over it; what a kind is to each of them its header says:
//
//     List                    all elements in double, Elements<Kind> or what has its members
//     elements, vertices      of compare::Kind, its base; `pulled`, where an element does not move all of its vertices
//     add_at_rest             adds the rest data of a scene, where a rest state has elements of the kind
//     TermOf, term, begin,    of Elements: one element over any number type, how it is made of the rest state, its
//     corners                 start of a step, and the positions that it reads
//     add                     force and block of one vertex, in double
//     question, answers,      the same as a question of the kind's stage, with the stage's tolerances
//     force_tolerance, block_tolerance
#pragma once

#include <tuple>
#include <type_traits>

#include "reference/solvers/kinds/hinge.hpp"
#include "reference/solvers/kinds/segment.hpp"
#include "reference/solvers/kinds/spring.hpp"
#include "reference/solvers/kinds/tetrahedron.hpp"
#include "reference/solvers/kinds/triangle.hpp"

namespace ogc::reference {

/// In the order in which sums go through them.
using ElementKinds = std::tuple<TriangleKind, HingeKind, SpringKind, TetrahedronKind, SegmentKind>;
/// How many there are.
inline constexpr std::size_t kind_count = std::tuple_size_v<ElementKinds>;
static_assert(std::is_convertible_v<ElementKinds, compare::ElementKinds>, "the kinds of compare, in their order");

/// Calls `visit` with each kind and its number as a constant: visit.operator()<Kind, number>().
template <class Visit>
void for_each_kind(Visit visit) {
  compare::for_each_of<ElementKinds>(visit);
}

/// The elements of a scene, by kind.
template <class Kinds>
struct ListsOf;
template <class... Kinds>
struct ListsOf<std::tuple<Kinds...>> {
  /// A list for each kind.
  using type = std::tuple<typename Kinds::List...>;
  /// Returns the lists of a rounded scene and its rest state.
  static type made(const compare::Scene& scene, const compare::RestStateOut& rest) {
    return type(typename Kinds::List(scene, rest)...);
  }
};
/// The lists of all kinds.
using ElementLists = ListsOf<ElementKinds>::type;

}  // namespace ogc::reference
