// Lists the kinds of elements of the reference. Potential, vertex systems, the judged sweep and colours fold over this
// list. Each kind has these members:
//
//     List                    all elements in double: Elements<Kind>, or a class with its members
//     elements, vertices      inherited from the kind of the same name in compare
//     pulled                  the vertices on which an element exerts forces, if these are not all of its vertices
//     add_at_rest             adds the rest data of a scene, if a rest state has elements of the kind
//     TermOf, term, begin, corners
//                             for Elements: the type of one element over any number type; functions that make an
//                             element from the rest state, begin a step, and return the positions that it reads
//     add                     adds force and block of one vertex, in double
//     question, answers, force_tolerance, block_tolerance
//                             the question of the kind's stage about one vertex, its answers and tolerances
#pragma once

#include <tuple>
#include <type_traits>

#include "reference/solvers/kinds/hinge.hpp"
#include "reference/solvers/kinds/segment.hpp"
#include "reference/solvers/kinds/spring.hpp"
#include "reference/solvers/kinds/tetrahedron.hpp"
#include "reference/solvers/kinds/triangle.hpp"

namespace ogc::reference {

/// All kinds, in the order in which sums add them.
using ElementKinds = std::tuple<TriangleKind, HingeKind, SpringKind, TetrahedronKind, SegmentKind>;
/// Number of kinds.
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
