#include "experiments/plugins/stages.hpp"

#include <algorithm>
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

// Braces evaluate the calls in order; parentheses would not.
ogc_rows rows(CallArrays& a) { return {a.in(), a.in()}; }
constexpr std::size_t topology_inputs = 13;
ogc_topology topology(CallArrays& a) {
  return {a.sizes.vertices, a.sizes.edges, a.sizes.triangles, a.in(),  a.in(), a.in(),
          rows(a),          rows(a),       rows(a),           rows(a), rows(a)};
}

constexpr std::array face_outputs{
    OutputInfo{"feature", Element::byte, 1, Per::item}, OutputInfo{"weights", Element::number, 3, Per::item},
    OutputInfo{"distance", Element::number, 1, Per::item}, OutputInfo{"distance_below", Element::number, 1, Per::item}};
int call_closest_face(void* function, CallArrays& a) {
  const ogc_closest_face_in in{a.sizes.cases, a.in(), a.in()};
  ogc_closest_face_out out{a.out(), a.out(), a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array points_outputs{OutputInfo{"first_feature", Element::byte, 1, Per::item},
                                    OutputInfo{"second_feature", Element::byte, 1, Per::item},
                                    OutputInfo{"nearly_parallel", Element::byte, 1, Per::item},
                                    OutputInfo{"parameters", Element::number, 2, Per::item},
                                    OutputInfo{"contact_distance", Element::number, 1, Per::item},
                                    OutputInfo{"distance_below", Element::number, 1, Per::item}};
int call_closest_points(void* function, CallArrays& a) {
  const ogc_closest_points_in in{a.sizes.cases, a.in(), a.in()};
  ogc_closest_points_out out{a.out(), a.out(), a.out(), a.out(), a.out(), a.out()};
  return call(function, in, out);
}

ogc_detect_in detect_in(CallArrays& a) {
  return {topology(a), a.in(), rows(a), a.in(), a.sizes.first, a.sizes.second, a.in()};
}

constexpr std::array facet_outputs{OutputInfo{"contacts", Element::index, 4, Per::one, List::vertex_facet},
                                   OutputInfo{"d_min_vertex", Element::number, 1, Per::vertex},
                                   OutputInfo{"d_min_triangle", Element::number, 1, Per::triangle}};
int call_detect_vertex_facet(void* function, CallArrays& a) {
  const ogc_detect_in in = detect_in(a);
  ogc_detect_vertex_facet_out out{a.out(), a.capacity(List::vertex_facet), -1, a.out(), a.out()};
  const int status = call(function, in, out);
  a.count(List::vertex_facet) = out.count;
  return status;
}

constexpr std::array edge_outputs{OutputInfo{"contacts", Element::index, 6, Per::one, List::edge_edge},
                                  OutputInfo{"d_min_edge", Element::number, 1, Per::edge}};
int call_detect_edge_edge(void* function, CallArrays& a) {
  const ogc_detect_in in = detect_in(a);
  ogc_detect_edge_edge_out out{a.out(), a.capacity(List::edge_edge), -1, a.out()};
  const int status = call(function, in, out);
  a.count(List::edge_edge) = out.count;
  return status;
}

constexpr std::array bound_outputs{OutputInfo{"bound", Element::number, 1, Per::vertex}};
int call_bound(void* function, CallArrays& a) {
  const ogc_bound_in in{topology(a), a.in(), a.in(), a.in(), a.sizes.first, a.in()};
  ogc_bound_out out{a.out()};
  return call(function, in, out);
}

constexpr std::array plane_outputs{OutputInfo{"planes", Element::index, 7, Per::one, List::planes},
                                   OutputInfo{"offset", Element::real, 1, Per::one, List::planes},
                                   OutputInfo{"bound", Element::number, 1, Per::vertex}};
int call_plane(void* function, CallArrays& a) {
  const ogc_plane_in in{topology(a), a.in(), rows(a), a.in(), a.in(), a.sizes.first, a.sizes.second, a.in()};
  ogc_plane_out out{a.out(), a.out(), a.capacity(List::planes), -1, a.out()};
  const int status = call(function, in, out);
  a.count(List::planes) = out.count;
  return status;
}

constexpr std::array activation_outputs{OutputInfo{"energy", Element::number, 1, Per::item},
                                        OutputInfo{"slope", Element::number, 1, Per::item},
                                        OutputInfo{"curvature", Element::number, 1, Per::item}};
int call_activation(void* function, CallArrays& a) {
  const ogc_activation_in in{a.sizes.cases, a.in(), a.in(), a.in(), a.in()};
  ogc_activation_out out{a.out(), a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array truncate_outputs{OutputInfo{"position", Element::number, 3, Per::item},
                                      OutputInfo{"cut", Element::byte, 1, Per::item}};
int call_truncate(void* function, CallArrays& a) {
  const ogc_truncate_in in{a.sizes.cases, a.in(), a.in(), a.in(), a.in(), a.in(), a.in(), a.in(), a.in()};
  ogc_truncate_out out{a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array ccd_outputs{OutputInfo{"time", Element::number, 1, Per::item}};
int call_ccd(void* function, CallArrays& a) {
  const ogc_ccd_in in{a.sizes.cases, a.in()};
  ogc_ccd_out out{a.out()};
  return call(function, in, out);
}

int call_barrier(void* function, CallArrays& a) {
  const ogc_barrier_in in{a.sizes.cases, a.in(), a.in(), a.in()};
  ogc_barrier_out out{a.out(), a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array depth_outputs{OutputInfo{"contacts", Element::index, 5, Per::one, List::volume_contacts},
                                   OutputInfo{"numbers", Element::number, 7, Per::one, List::volume_contacts}};
int call_volume_depth(void* function, CallArrays& a) {
  const ogc_volume_depth_in in{topology(a), a.in(), a.sizes.first, a.sizes.cases, a.in()};
  ogc_volume_depth_out out{a.out(), a.out(), a.capacity(List::volume_contacts), -1};
  const int status = call(function, in, out);
  a.count(List::volume_contacts) = out.count;
  return status;
}

constexpr std::array force_outputs{OutputInfo{"force", Element::number, 3, Per::item},
                                   OutputInfo{"block", Element::number, 6, Per::item}};
template <class In>
int call_force(void* function, CallArrays& a) {
  const In in{a.sizes.cases, a.in()};
  ogc_force_out out{a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array guess_outputs{OutputInfo{"target", Element::number, 3, Per::item},
                                   OutputInfo{"position", Element::number, 3, Per::item},
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

// Number of input arrays of a scene: the arrays of its topology, then these nine.
constexpr std::size_t scene_inputs = topology_inputs + 9;
ogc_scene scene(CallArrays& a) {
  return {topology(a), a.sizes.hinges, a.sizes.bodies, a.sizes.springs,  a.sizes.tetrahedra,
          a.in(),      a.in(),         a.in(),         a.in(),           a.in(),
          rows(a),     a.in(),         a.in(),         a.sizes.settings, a.sizes.gravity,
          {}};
}

constexpr std::array rest_outputs{
    OutputInfo{"mass", Element::number, 1, Per::vertex},
    OutputInfo{"corner", Element::index, 3, Per::one, List::triangles},
    OutputInfo{"triangle_body", Element::index, 1, Per::one, List::triangles},
    OutputInfo{"area", Element::number, 1, Per::one, List::triangles},
    OutputInfo{"gradient", Element::number, 4, Per::one, List::triangles},
    OutputInfo{"hinge_vertex", Element::index, 4, Per::one, List::hinges},
    OutputInfo{"hinge_body", Element::index, 1, Per::one, List::hinges},
    OutputInfo{"rest_angle", Element::number, 1, Per::one, List::hinges},
    OutputInfo{"hinge_stiffness", Element::number, 1, Per::one, List::hinges},
    OutputInfo{"weight", Element::number, 3, Per::one, List::hinges},
    OutputInfo{"edge_length_squared", Element::number, 1, Per::edge},
    OutputInfo{"meeting_stiffness", Element::number, 1, Per::two_bodies},
    OutputInfo{"meeting_friction", Element::number, 1, Per::two_bodies},
    OutputInfo{"solid_corner", Element::index, 4, Per::one, List::tetrahedra},
    OutputInfo{"solid_body", Element::index, 1, Per::one, List::tetrahedra},
    OutputInfo{"volume", Element::number, 1, Per::one, List::tetrahedra},
    OutputInfo{"inverse", Element::number, 1, Per::one, List::tetrahedra},
    OutputInfo{"solid_weight", Element::number, 6, Per::one, List::tetrahedra},
    OutputInfo{"solid_gradient", Element::number, 9, Per::one, List::tetrahedra},
};
ogc_rest_state_out rest_out(CallArrays& a) {
  return {a.out(), a.capacity(List::triangles),
          -1,      a.capacity(List::hinges),
          -1,      a.capacity(List::tetrahedra),
          -1,      a.out(),
          a.out(), a.out(),
          a.out(), a.out(),
          a.out(), a.out(),
          a.out(), a.out(),
          a.out(), a.out(),
          a.out(), a.out(),
          a.out(), a.out(),
          a.out(), a.out(),
          a.out(), {}};
}
void take_counts(CallArrays& a, const ogc_rest_state_out& out) {
  a.count(List::triangles) = out.triangle_count;
  a.count(List::hinges) = out.hinge_count;
  a.count(List::tetrahedra) = out.tetrahedron_count;
}
int call_rest_state(void* function, CallArrays& a) {
  const ogc_scene in = scene(a);
  ogc_rest_state_out out = rest_out(a);
  const int status = call(function, in, out);
  take_counts(a, out);
  return status;
}

constexpr std::size_t rest_inputs = rest_outputs.size();
ogc_rest rest(CallArrays& a) {
  return {a.in(),
          a.sizes.rest_triangles,
          a.sizes.rest_hinges,
          a.sizes.rest_tetrahedra,
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          a.in(),
          {}};
}

constexpr std::array sweep_outputs{OutputInfo{"position", Element::number, 3, Per::vertex},
                                   OutputInfo{"cut", Element::index, 1, Per::one}};
int call_sweep(void* function, CallArrays& a) {
  const ogc_sweep_in in{
      scene(a),          rest(a), a.in(), a.in(), a.in(), a.in(), a.in(), a.in(), a.sizes.vertex_facet,
      a.sizes.edge_edge, a.in(),  a.in()};
  ogc_sweep_out out{a.out(), a.out()};
  return call(function, in, out);
}

constexpr std::array trace_outputs{
    OutputInfo{"colour", Element::index, 1, Per::vertex},
    OutputInfo{"query_radius", Element::number, 1, Per::one},
    OutputInfo{"target", Element::number, 3, Per::vertex},
    OutputInfo{"position", Element::number, 3, Per::vertex},
    OutputInfo{"velocity", Element::number, 3, Per::vertex},
    OutputInfo{"kind", Element::index, 1, Per::one, List::events},
    OutputInfo{"cut", Element::index, 1, Per::one, List::events},
    OutputInfo{"event_position", Element::number, 3, Per::vertex, List::events},
    OutputInfo{"d_min_vertex", Element::number, 1, Per::vertex, List::detections},
    OutputInfo{"bound", Element::number, 1, Per::vertex, List::detections},
    OutputInfo{"d_min_triangle", Element::number, 1, Per::triangle, List::detections},
    OutputInfo{"d_min_edge", Element::number, 1, Per::edge, List::detections},
    OutputInfo{"vertex_facet_end", Element::index, 1, Per::one, List::detections},
    OutputInfo{"edge_edge_end", Element::index, 1, Per::one, List::detections},
    OutputInfo{"vertex_facet", Element::index, 4, Per::one, List::vertex_facet},
    OutputInfo{"edge_edge", Element::index, 6, Per::one, List::edge_edge},
};
template <std::size_t N, std::size_t M>
constexpr std::array<OutputInfo, N + M> joined(const std::array<OutputInfo, N>& first,
                                               const std::array<OutputInfo, M>& second) {
  std::array<OutputInfo, N + M> all{};
  for (std::size_t k = 0; k < N + M; ++k) all[k] = k < N ? first[k] : second[k - N];
  return all;
}
constexpr std::array step_outputs = joined(rest_outputs, trace_outputs);
int call_step(void* function, CallArrays& a) {
  const ogc_step_in in{scene(a), a.in(), a.in(), a.in()};
  ogc_step_out out{rest_out(a),
                   a.out(),
                   a.out(),
                   a.out(),
                   a.out(),
                   a.out(),
                   a.capacity(List::events),
                   -1,
                   a.out(),
                   a.out(),
                   a.out(),
                   a.capacity(List::detections),
                   -1,
                   a.out(),
                   a.out(),
                   a.out(),
                   a.out(),
                   a.out(),
                   a.out(),
                   a.capacity(List::vertex_facet),
                   -1,
                   a.capacity(List::edge_edge),
                   -1,
                   a.out(),
                   a.out()};
  const int status = call(function, in, out);
  take_counts(a, out.rest);
  a.count(List::events) = out.event_count;
  a.count(List::detections) = out.detection_count;
  a.count(List::vertex_facet) = out.vertex_facet_count;
  a.count(List::edge_edge) = out.edge_edge_count;
  return status;
}

constexpr std::array stage_table{
    PluginStage{"closest_face", 2, face_outputs, call_closest_face},
    PluginStage{"closest_points", 2, points_outputs, call_closest_points},
    PluginStage{"block", topology_inputs + 2, block_outputs, call_block},
    PluginStage{"detect_vertex_facet", topology_inputs + 5, facet_outputs, call_detect_vertex_facet},
    PluginStage{"detect_edge_edge", topology_inputs + 5, edge_outputs, call_detect_edge_edge},
    PluginStage{"bound", topology_inputs + 4, bound_outputs, call_bound},
    PluginStage{"plane", topology_inputs + 6, plane_outputs, call_plane},
    PluginStage{"ccd", 1, ccd_outputs, call_ccd},
    PluginStage{"volume_depth", topology_inputs + 2, depth_outputs, call_volume_depth},
    PluginStage{"initial_guess", 1, guess_outputs, call_initial_guess},
    PluginStage{"activation", 4, activation_outputs, call_activation},
    PluginStage{"barrier", 3, activation_outputs, call_barrier},
    PluginStage{"volume_force", 1, force_outputs, call_force<ogc_volume_force_in>},
    PluginStage{"contact_force", 1, force_outputs, call_force<ogc_contact_force_in>},
    PluginStage{"friction_force", 1, force_outputs, call_force<ogc_friction_force_in>},
    PluginStage{"membrane", 1, force_outputs, call_force<ogc_membrane_in>},
    PluginStage{"bending", 1, force_outputs, call_force<ogc_bending_in>},
    PluginStage{"spring", 1, force_outputs, call_force<ogc_spring_in>},
    PluginStage{"tetrahedron", 1, force_outputs, call_force<ogc_tetrahedron_in>},
    PluginStage{"truncate", 8, truncate_outputs, call_truncate},
    PluginStage{"rest_state", scene_inputs, rest_outputs, call_rest_state},
    PluginStage{"sweep", scene_inputs + rest_inputs + 8, sweep_outputs, call_sweep},
    PluginStage{"step", scene_inputs + 3, step_outputs, call_step},
};

}  // namespace

std::size_t groups(const OutputInfo& info, const QuestionSizes& sizes, const ListSizes& lists) {
  const auto of_each = [&]() -> std::int64_t {
    switch (info.per) {
      case Per::one: return 1;
      case Per::item: return sizes.cases;
      case Per::vertex: return sizes.vertices;
      case Per::edge: return sizes.edges;
      case Per::triangle: return sizes.triangles;
      case Per::two_bodies: return std::int64_t{sizes.bodies} * sizes.bodies;
    }
    return 0;
  };
  return static_cast<std::size_t>(of_each() * lists[static_cast<std::size_t>(info.list)]);
}

// Returns the capacities of the lists at the first call. Those of contacts and planes are estimates. Those of events
// and detections are the most that Algorithm 3 needs: a detection before each round and each iteration.
ListSizes first_capacities(const QuestionSizes& sizes) {
  const std::int64_t contacts = 64 + 4 * (std::int64_t{sizes.vertices} + sizes.edges),
                     rounds = sizes.settings.guess_rounds + sizes.settings.iterations;
  return {1,
          contacts,
          contacts,
          sizes.triangles,
          sizes.hinges,
          sizes.tetrahedra,
          2 * rounds + 1,
          rounds + 1,
          4 * contacts,
          64 + 4 * sizes.cases};
}

// Returns for each list its first capacity plus the largest number of entries of all detections, together at most 2^40.
// Largest numbers of entries of one detection:
//
// - contacts: all vertices with all triangles, and all ordered pairs of edges
// - contacts with a volume: all points with all faces
// - planes: one for each vertex of each pair
//
// The first capacities are added because a plug-in may list contacts of a small mesh twice. The judge then recognises
// this mistake. Products of two sizes fit into 64 bits, because each size fits into 31 bits.
ListSizes most_entries(const QuestionSizes& sizes) {
  constexpr std::int64_t most = std::int64_t{1} << 40;
  ListSizes entries = first_capacities(sizes);
  const auto detections = static_cast<double>(entries[static_cast<std::size_t>(List::detections)]);
  const auto add_pairs = [&](List list, double first, double second) {
    std::int64_t& count = entries[static_cast<std::size_t>(list)];
    count = std::min(
        most, count + static_cast<std::int64_t>(std::min(first * second * detections, static_cast<double>(most))));
  };
  add_pairs(List::vertex_facet, sizes.vertices, sizes.triangles);
  add_pairs(List::edge_edge, sizes.edges, sizes.edges);
  add_pairs(List::planes, 4.0 * sizes.vertices, sizes.triangles);
  add_pairs(List::planes, 4.0 * sizes.edges, sizes.edges);
  add_pairs(List::volume_contacts, static_cast<double>(sizes.cases),
            static_cast<double>(sizes.vertices) + sizes.edges + sizes.triangles);
  return entries;
}

std::string_view list_name(List list) {
  constexpr std::array<std::string_view, list_count> names{
      "", "contacts", "contacts", "triangles", "hinges", "tetrahedra", "events", "detections", "planes", "contacts"};
  return names[static_cast<std::size_t>(list)];
}

std::span<const PluginStage> plugin_stages() { return stage_table; }

std::optional<std::size_t> find_plugin_stage(std::string_view name) {
  for (std::size_t i = 0; i < stage_table.size(); ++i)
    if (stage_table[i].name == name) return i;
  return std::nullopt;
}

}  // namespace ogc::experiments
