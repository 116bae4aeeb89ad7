#include "experiments/plugins/stages.hpp"

#include <array>
#include <cstring>

namespace ogc::experiments {

namespace {

template <class In, class Out>
int call(void* function, const In& in, Out& out) {
  int (*callee)(const In*, Out*) = nullptr;
  std::memcpy(&callee, &function, sizeof callee);
  return callee(&in, &out);
}

// Braces take the arrays in order (that is what separates them from parentheses).
ogc_rows rows(CallArrays& a) { return {a.in(), a.in()}; }
constexpr std::size_t topology_inputs = 13;
ogc_topology topology(CallArrays& a) {
  return {a.sizes.vertices, a.sizes.edges, a.sizes.triangles, a.in(), a.in(), a.in(), rows(a), rows(a), rows(a), rows(a), rows(a)};
}

constexpr std::array face_outputs{OutputInfo{"feature", Element::byte, 1, Per::item}, OutputInfo{"weights", Element::number, 3, Per::item},
                                  OutputInfo{"distance", Element::number, 1, Per::item}, OutputInfo{"distance_below", Element::number, 1, Per::item}};
int call_closest_face(void* function, CallArrays& a) {
  const ogc_closest_face_in in{a.sizes.cases, a.in(), a.in()};
  ogc_closest_face_out out{a.out(), a.out(), a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array points_outputs{OutputInfo{"first_feature", Element::byte, 1, Per::item},      OutputInfo{"second_feature", Element::byte, 1, Per::item},
                                    OutputInfo{"nearly_parallel", Element::byte, 1, Per::item},    OutputInfo{"parameters", Element::number, 2, Per::item},
                                    OutputInfo{"contact_distance", Element::number, 1, Per::item}, OutputInfo{"distance_below", Element::number, 1, Per::item}};
int call_closest_points(void* function, CallArrays& a) {
  const ogc_closest_points_in in{a.sizes.cases, a.in(), a.in()};
  ogc_closest_points_out out{a.out(), a.out(), a.out(), a.out(), a.out(), a.out()};
  return call(function, in, out);
}

ogc_detect_in detect_in(CallArrays& a) { return {topology(a), a.in(), a.in(), a.sizes.first, a.sizes.second}; }

constexpr std::array facet_outputs{OutputInfo{"contacts", Element::index, 4, Per::contact}, OutputInfo{"d_min_vertex", Element::number, 1, Per::vertex},
                                   OutputInfo{"d_min_triangle", Element::number, 1, Per::triangle}};
int call_detect_vertex_facet(void* function, CallArrays& a) {
  const ogc_detect_in in = detect_in(a);
  ogc_detect_vertex_facet_out out{a.out(), a.capacity, -1, a.out(), a.out()};
  const int status = call(function, in, out);
  a.count = out.count;
  return status;
}

constexpr std::array edge_outputs{OutputInfo{"contacts", Element::index, 6, Per::contact}, OutputInfo{"d_min_edge", Element::number, 1, Per::edge}};
int call_detect_edge_edge(void* function, CallArrays& a) {
  const ogc_detect_in in = detect_in(a);
  ogc_detect_edge_edge_out out{a.out(), a.capacity, -1, a.out()};
  const int status = call(function, in, out);
  a.count = out.count;
  return status;
}

constexpr std::array bound_outputs{OutputInfo{"bound", Element::number, 1, Per::vertex}};
int call_bound(void* function, CallArrays& a) {
  const ogc_bound_in in{topology(a), a.in(), a.in(), a.in(), a.sizes.first};
  ogc_bound_out out{a.out()};
  return call(function, in, out);
}

constexpr std::array activation_outputs{OutputInfo{"energy", Element::number, 1, Per::item}, OutputInfo{"slope", Element::number, 1, Per::item},
                                        OutputInfo{"curvature", Element::number, 1, Per::item}};
int call_activation(void* function, CallArrays& a) {
  const ogc_activation_in in{a.sizes.cases, a.in(), a.in(), a.in(), a.in()};
  ogc_activation_out out{a.out(), a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array truncate_outputs{OutputInfo{"position", Element::number, 3, Per::item}, OutputInfo{"exceeded", Element::byte, 1, Per::item}};
int call_truncate(void* function, CallArrays& a) {
  const ogc_truncate_in in{a.sizes.cases, a.in(), a.in(), a.in()};
  ogc_truncate_out out{a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array force_outputs{OutputInfo{"force", Element::number, 3, Per::item}, OutputInfo{"block", Element::number, 6, Per::item}};
template <class In>
int call_force(void* function, CallArrays& a) {
  const In in{a.sizes.cases, a.in()};
  ogc_force_out out{a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array guess_outputs{OutputInfo{"target", Element::number, 3, Per::item}, OutputInfo{"position", Element::number, 3, Per::item},
                                   OutputInfo{"cut", Element::byte, 1, Per::item}};
int call_initial_guess(void* function, CallArrays& a) {
  const ogc_initial_guess_in in{a.sizes.cases, a.in()};
  ogc_initial_guess_out out{a.out(), a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array block_outputs{OutputInfo{"inside", Element::byte, 1, Per::item}};
int call_block(void* function, CallArrays& a) {
  const ogc_block_in in{topology(a), a.in(), a.sizes.cases, a.in()};
  ogc_block_out out{a.out()};
  return call(function, in, out);
}

constexpr std::array table{
    PluginStage{"closest_face", 2, face_outputs, call_closest_face},
    PluginStage{"closest_points", 2, points_outputs, call_closest_points},
    PluginStage{"block", topology_inputs + 2, block_outputs, call_block},
    PluginStage{"detect_vertex_facet", topology_inputs + 2, facet_outputs, call_detect_vertex_facet},
    PluginStage{"detect_edge_edge", topology_inputs + 2, edge_outputs, call_detect_edge_edge},
    PluginStage{"bound", topology_inputs + 3, bound_outputs, call_bound},
    PluginStage{"initial_guess", 1, guess_outputs, call_initial_guess},
    PluginStage{"activation", 4, activation_outputs, call_activation},
    PluginStage{"contact_force", 1, force_outputs, call_force<ogc_contact_force_in>},
    PluginStage{"friction_force", 1, force_outputs, call_force<ogc_friction_force_in>},
    PluginStage{"membrane", 1, force_outputs, call_force<ogc_membrane_in>},
    PluginStage{"bending", 1, force_outputs, call_force<ogc_bending_in>},
    PluginStage{"spring", 1, force_outputs, call_force<ogc_spring_in>},
    PluginStage{"truncate", 3, truncate_outputs, call_truncate},
};

}  // namespace

std::size_t groups(const OutputInfo& info, const QuestionSizes& sizes, std::int64_t contacts) {
  switch (info.per) {
    case Per::item: return static_cast<std::size_t>(sizes.cases);
    case Per::vertex: return static_cast<std::size_t>(sizes.vertices);
    case Per::edge: return static_cast<std::size_t>(sizes.edges);
    case Per::triangle: return static_cast<std::size_t>(sizes.triangles);
    default: return static_cast<std::size_t>(contacts);
  }
}

std::span<const PluginStage> plugin_stages() { return table; }

std::optional<std::size_t> find_plugin_stage(std::string_view name) {
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table[i].name == name) return i;
  return std::nullopt;
}

}  // namespace ogc::experiments
