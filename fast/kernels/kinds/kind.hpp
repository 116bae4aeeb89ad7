// Defines what all kinds of elements have in common. Each kind is a struct in a file of this folder; kinds.hpp lists
// all kinds. A kind has these members:
//
//   Rest, Incidence     an element at rest; the element as one of its vertices sees it
//   Beside, Start, ByBody
//                     further data that StreamView describes; `NoData` if the kind has none
//   RestBeside        further data of an element at rest; `NoData` if the kind has none
//   stream(view)      its stream in a SweepView, and `View`, the part of SweepView that holds it
//   Whole             type that makes the kind's part of a vertex's sum, for all models of the kind
//   row_in_vertex     index of the kind's row in SweepVertex::rows; −1: its rows are a separate array
//   is_curve          whether vertices have few elements, so that a narrow team serves them
//   count, vertices   number of vertices of an element, and their indices
//   seen, beside      the incidence and its Beside data, by the role of the vertex (its index among the vertices)
//   begin             computes Start of an element from xᵗ
//   add_energy        adds an element's energy
//   flop, damping_flop  operations of an incidence, and operations that damping adds to them (fast/work.cpp)
#pragma once

#include "fast/kernels/models/damping.hpp"
#include "fast/kernels/sweep_view.hpp"
#include "fast/kernels/team.hpp"

namespace ogc::fast {

/// Holds the default members of a kind.
template <class RestOfKind, class IncidenceOfKind>
struct ElementKind {
  using Rest = RestOfKind;
  using Incidence = IncidenceOfKind;
  using Beside = NoData;
  using Start = NoData;
  using ByBody = NoData;
  using RestBeside = NoData;
  static constexpr int row_in_vertex = -1;
  static constexpr bool is_curve = false;
  /// whether `add_energy` runs in each step, and not only in steps that report energies
  static constexpr bool reports_state = false;
  static constexpr double damping_flop = 0;
};

/// Returns the row of a vertex in the stream of a kind. `is_there`: the scene is known to have elements of this kind.
template <class Kind, bool is_there, class View>
OGC_HD Row row_of(const View& view, int slot, const SweepVertex& vertex) {
  if constexpr (Kind::row_in_vertex >= 0)
    return vertex.rows[Kind::row_in_vertex];
  else if (is_there || Kind::stream(view).rows != nullptr)
    return Kind::stream(view).rows[slot];
  else
    return {};
}

/// Computes for an element the value at the start of the step that damping reads: θᵗ or Gᵗ. Runs once for each element.
template <class Kind>
struct BeginElement {
  const typename Kind::Rest* rest;       ///< by element
  const Vec* start;                      ///< xᵗ by vertex [m]
  typename Kind::Start* value_at_start;  ///< by element, written

  OGC_HD void operator()(int i) const { value_at_start[i] = Kind::begin(rest[i], start); }
};

/// Holds the elements of a kind and the data that their energy reads.
template <class Kind>
struct ElementsView {
  const typename Kind::Rest* rest = nullptr;          ///< by element
  const typename Kind::RestBeside* beside = nullptr;  ///< by element; null if no model of the scene reads it
  const typename Kind::ByBody* by_body = nullptr;     ///< by body
  const SurfaceMaterial* materials = nullptr;         ///< by body
  const SurfaceModels* models = nullptr;              ///< by body
  const Vec* position = nullptr;                      ///< x by vertex [m]
  int count = 0;                                      ///< elements
};

}  // namespace ogc::fast
