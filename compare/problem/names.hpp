// Names the choices of scene files, `--set` and messages. Each name comes from a `switch` without `default`, so that an
// enumerator without a name does not compile. All code that prints, lists or reads a choice takes its name from here.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Returns the name that users type, or "" if the value is no enumerator.
constexpr std::string_view name_of(MembraneModel model) {
  switch (model) {
    case MembraneModel::none: return "none";
    case MembraneModel::st_venant_kirchhoff: return "st_venant_kirchhoff";
    case MembraneModel::stable_neo_hookean: return "stable_neo_hookean";
  }
  return {};
}
constexpr std::string_view name_of(BendingModel model) {
  switch (model) {
    case BendingModel::none: return "none";
    case BendingModel::discrete_hinge: return "discrete_hinge";
    case BendingModel::isometric_quadratic: return "isometric_quadratic";
  }
  return {};
}
constexpr std::string_view name_of(BodyContact contact) {
  switch (contact) {
    case BodyContact::surface: return "surface";
    case BodyContact::volume: return "volume";
  }
  return {};
}
constexpr std::string_view name_of(ContactActivation activation) {
  switch (activation) {
    case ContactActivation::ogc: return "ogc";
    case ContactActivation::ogc_as_printed: return "ogc_as_printed";
    case ContactActivation::quadratic: return "quadratic";
    case ContactActivation::ipc_log: return "ipc_log";
    case ContactActivation::cubic: return "cubic";
  }
  return {};
}
constexpr std::string_view name_of(DampingForm form) {
  switch (form) {
    case DampingForm::strain: return "strain";
    case DampingForm::per_vertex: return "per_vertex";
  }
  return {};
}
constexpr std::string_view name_of(Bounds bounds) {
  switch (bounds) {
    case Bounds::ball: return "ball";
    case Bounds::planes: return "planes";
    case Bounds::off: return "off";
    case Bounds::dat: return "dat";
  }
  return {};
}
constexpr std::string_view name_of(RodOrientation update) {
  switch (update) {
    case RodOrientation::exact: return "exact";
    case RodOrientation::as_published: return "as_published";
  }
  return {};
}
constexpr std::string_view name_of(RodStart start) {
  switch (start) {
    case RodStart::turned: return "turned";
    case RodStart::kept: return "kept";
  }
  return {};
}

/// Number of enumerators of a choice.
template <class Choice>
inline constexpr std::size_t choice_count = [] {
  std::size_t count = 0;
  while (!name_of(static_cast<Choice>(count)).empty()) ++count;
  return count;
}();

/// All enumerators of a choice, in order.
template <class Choice>
inline constexpr std::array<Choice, choice_count<Choice>> choices = [] {
  std::array<Choice, choice_count<Choice>> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Choice>(i);
  return all;
}();

/// Names of all enumerators of a choice, in order.
template <class Choice>
inline constexpr std::array<std::string_view, choice_count<Choice>> choice_names = [] {
  std::array<std::string_view, choice_count<Choice>> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = name_of(static_cast<Choice>(i));
  return names;
}();

}  // namespace ogc::compare
