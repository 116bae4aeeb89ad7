// Describes the C structures of compare/plugin.h, member by member. One description serves all sides: the worker fills
// the structures by it, the judge takes the types and lengths of the outputs from it, and `ogc compare --list --json`
// prints it for the worker in Python. Names, types and offsets come from the compiler, so that they cannot differ from
// the header; tests/experiments/plugins/table.py checks that no member is missing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

#include "compare/plugin.h"

namespace ogc::experiments {

/// Holds the sizes and numbers of a question, always in host memory.
struct QuestionSizes {
  std::int64_t cases = 0;                               ///< cases of a stage with independent cases
  std::int32_t vertices = 0, edges = 0, triangles = 0;  ///< sizes of a mesh
  float first = 0, second = 0;  ///< two numbers of a stage beside its arrays; for a detection r and r_q
  /// sizes of a scene, and of its rest state
  std::int32_t hinges = 0, bodies = 0, springs = 0, tetrahedra = 0;
  std::int32_t rest_triangles = 0, rest_hinges = 0, rest_tetrahedra = 0;
  std::int64_t vertex_facet = 0, edge_edge = 0;  ///< contacts that the question contains
  ogc_settings settings{};
  ogc_vec3 gravity{};
};

/// The type of an array's elements; `structure` is one of those described here.
enum class Element : std::uint8_t { number, byte, index, real, wide, structure };
/// An output has one group of elements in all (`one`), or one for each case (`item`), each vertex, …, each pair of
/// bodies (`two_bodies`).
enum class Per : std::uint8_t { one, item, vertex, edge, triangle, two_bodies };
/// Lists of outputs whose length the plug-in determines.
enum class List : std::uint8_t {
  none,
  vertex_facet,
  edge_edge,
  triangles,
  hinges,
  tetrahedra,
  events,
  detections,
  planes,
  volume_contacts
};
inline constexpr std::size_t list_count = 10;  ///< with `none`

/// Returns the size of one element [bytes]; 0 for a structure.
constexpr std::size_t bytes_of(Element element) {
  switch (element) {
    case Element::byte: return 1;
    case Element::number:
    case Element::index: return 4;
    case Element::real:
    case Element::wide: return 8;
    case Element::structure: return 0;
  }
  return 0;
}

/// What the worker writes into a member before a call.
enum class Role : std::uint8_t {
  field,     ///< nothing: a member of an element of an array
  value,     ///< a number of the question
  input,     ///< the address of the next input array
  output,    ///< the address of the next output array
  capacity,  ///< the room in a list
  count,     ///< -1; the plug-in sets it to the length of a list
  nested,    ///< the members of a structure, one after another
  reserved,  ///< null
};

struct Structure;

/// Describes one member of a structure.
struct Member {
  std::string_view name{};               ///< as in the header
  std::size_t offset = 0;                ///< [bytes] from the beginning of the structure
  Role role = Role::field;               ///< what the worker writes into it
  Element element = Element::index;      ///< type of its elements, or of those to which it points
  const Structure* structure = nullptr;  ///< the structure, if `element` is one
  std::array<std::size_t, 2> fixed{};    ///< lengths of C arrays, {3, 2} for float[3][2]; a vector is float[3]
  std::string_view length{};             ///< of an input array, in the header's words
  Per per = Per::one;                    ///< of an output: what has a group of elements
  List list = List::none;                ///< of an output, a capacity or a count: the list
  std::size_t question = 0;              ///< of a value: its place in QuestionSizes [bytes]

  /// Returns the size of one group of elements [bytes].
  std::size_t group_bytes() const;
};

/// Describes one structure of compare/plugin.h.
struct Structure {
  std::string_view name;        ///< as in the header
  std::size_t bytes = 0;        ///< its size
  std::vector<Member> members;  ///< all members, in the header's order
};

/// Returns all structures, each after those that it contains.
std::vector<const Structure*> plugin_structures();

/// Returns the structure of this name, which must be one of plugin_structures().
const Structure& plugin_structure(std::string_view name);

/// Holds the description of one structure; for structures.cpp alone, which defines it for each S.
template <class S>
struct Described {
  static const Structure structure;  ///< the description
};

namespace detail {

/// Returns what follows `before` in the name that the compiler gives to a function, up to a delimiter.
constexpr std::string_view argument_in(std::string_view function, std::string_view before) {
  function.remove_prefix(function.find(before) + before.size());
  return function.substr(0, function.find_first_of(";]"));
}

/// Returns the name of a member.
template <auto MemberPointer>
constexpr std::string_view member_name() {
  const std::string_view qualified = argument_in(__PRETTY_FUNCTION__, "MemberPointer = &");
  return qualified.substr(qualified.rfind(':') + 1);
}

/// Returns the name of a structure.
template <class StructureType>
constexpr std::string_view structure_name() {
  return argument_in(__PRETTY_FUNCTION__, "StructureType = ");
}
static_assert(member_name<&ogc_truncate_in::previous>() == "previous");
static_assert(structure_name<ogc_truncate_in>() == "ogc_truncate_in");

/// Structure and type of a member, from a pointer to it.
template <class>
struct Pointer;
template <class S, class T>
struct Pointer<T S::*> {
  using Of = S;
  using To = T;
};
/// Type of a member.
template <auto M>
using TypeOf = typename Pointer<decltype(M)>::To;

/// Returns the place of a member in its structure [bytes].
template <auto M>
std::size_t offset() {
  static const typename Pointer<decltype(M)>::Of whole{};
  return static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&(whole.*M)) -
                                  reinterpret_cast<const std::byte*>(&whole));
}

/// Sets element type and fixed lengths of a member with elements of type T.
template <class T>
void set_type(Member& member) {
  std::size_t rank = 0;
  if constexpr (std::is_array_v<T>) member.fixed[rank++] = std::extent_v<T, 0>;
  if constexpr (std::rank_v < T >> 1) member.fixed[rank++] = std::extent_v<T, 1>;
  static_assert(std::rank_v<T> <= 2);
  using Item = std::remove_cv_t<std::remove_all_extents_t<T>>;
  if constexpr (std::is_same_v<Item, float>) {
    member.element = Element::number;
  } else if constexpr (std::is_same_v<Item, ogc_vec3>) {
    static_assert(std::rank_v<T> <= 1);
    member.element = Element::number;
    member.fixed[rank] = 3;
  } else if constexpr (std::is_same_v<Item, std::uint8_t>) {
    member.element = Element::byte;
  } else if constexpr (std::is_same_v<Item, std::int32_t>) {
    member.element = Element::index;
  } else if constexpr (std::is_same_v<Item, std::int64_t>) {
    member.element = Element::wide;
  } else if constexpr (std::is_same_v<Item, double>) {
    member.element = Element::real;
  } else {
    member.element = Element::structure;
    member.structure = &Described<Item>::structure;
  }
}

/// Returns name, place and type of a member.
template <auto M>
Member member(Role role) {
  Member described_member{.name = member_name<M>(), .offset = offset<M>(), .role = role};
  set_type<std::remove_pointer_t<TypeOf<M>>>(described_member);
  return described_member;
}

}  // namespace detail

// These functions describe a member; Role says what each means.

/// Describes a member of an element of an array.
template <auto M>
Member field() {
  static_assert(!std::is_pointer_v<detail::TypeOf<M>>);
  return detail::member<M>(Role::field);
}

/// Describes a number of the question, which stands in the member `Question` of QuestionSizes.
template <auto M, auto Question>
Member value() {
  static_assert(std::is_same_v<detail::TypeOf<M>, detail::TypeOf<Question>>);
  Member member = detail::member<M>(Role::value);
  member.question = detail::offset<Question>();
  return member;
}

/// Describes an input array. `length` names members of the structure that holds the array, as the header does.
template <auto M>
Member input(std::string_view length) {
  static_assert(std::is_const_v<std::remove_all_extents_t<std::remove_pointer_t<detail::TypeOf<M>>>>);
  Member member = detail::member<M>(Role::input);
  member.length = length;
  return member;
}

/// Describes an output array; with a list, the plug-in determines its length.
template <auto M>
Member output(Per per, List list = List::none) {
  static_assert(std::is_pointer_v<detail::TypeOf<M>>);
  static_assert(!std::is_const_v<std::remove_all_extents_t<std::remove_pointer_t<detail::TypeOf<M>>>>);
  Member member = detail::member<M>(Role::output);
  member.per = per;
  member.list = list;
  return member;
}

/// Describes the room in a list.
template <auto M>
Member capacity(List list) {
  static_assert(std::is_same_v<detail::TypeOf<M>, std::int64_t>);
  Member member = detail::member<M>(Role::capacity);
  member.list = list;
  return member;
}

/// Describes the length of a list.
template <auto M>
Member count(List list) {
  static_assert(std::is_same_v<detail::TypeOf<M>, std::int64_t>);
  Member member = detail::member<M>(Role::count);
  member.list = list;
  return member;
}

/// Describes a structure within the structure.
template <auto M>
Member nested() {
  return detail::member<M>(Role::nested);
}

/// Describes a member that is null.
template <auto M>
Member reserved() {
  return {.name = detail::member_name<M>(), .offset = detail::offset<M>(), .role = Role::reserved};
}

}  // namespace ogc::experiments
