// Converts the judge's questions into arrays, in the order of stages.cpp, and the returned arrays into answers.
#include "experiments/plugins/contestant.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <tuple>
#include <utility>

#include "compare/stages/all.hpp"
#include "experiments/plugins/arrays.hpp"
#include "experiments/plugins/scenes.hpp"

namespace ogc::experiments {

namespace {

using namespace ogc::compare;

// The judge's structures and the plug-in's have the same layout, so that questions are copied byte by byte.
static_assert(sizeof(Vec3f) == sizeof(ogc_vec3));
static_assert(sizeof(HalfSpace) == sizeof(ogc_half_space) &&
              offsetof(HalfSpace, offset) == offsetof(ogc_half_space, offset));
static_assert(sizeof(MembraneCase) == sizeof(ogc_membrane_case) &&
              offsetof(MembraneCase, damping_form) == offsetof(ogc_membrane_case, damping_form));
static_assert(sizeof(BendingCase) == sizeof(ogc_bending_case) &&
              offsetof(BendingCase, damping_form) == offsetof(ogc_bending_case, damping_form));
static_assert(sizeof(SpringCase) == sizeof(ogc_spring_case) &&
              offsetof(SpringCase, damping_form) == offsetof(ogc_spring_case, damping_form));
static_assert(sizeof(TetrahedronCase) == sizeof(ogc_tetrahedron_case) &&
              offsetof(TetrahedronCase, gradient) == offsetof(ogc_tetrahedron_case, gradient) &&
              offsetof(TetrahedronCase, damping_form) == offsetof(ogc_tetrahedron_case, damping_form));
static_assert(sizeof(ContactForceCase) == sizeof(ogc_contact_force_case) &&
              offsetof(ContactForceCase, together) == offsetof(ogc_contact_force_case, together));
static_assert(sizeof(FrictionForceCase) == sizeof(ogc_friction_force_case) &&
              offsetof(FrictionForceCase, slip_limit) == offsetof(ogc_friction_force_case, slip_limit));
static_assert(sizeof(InitialGuessCase) == sizeof(ogc_initial_guess_case) &&
              offsetof(InitialGuessCase, reserved) == offsetof(ogc_initial_guess_case, reserved));
static_assert(sizeof(CcdCase) == sizeof(ogc_ccd_case) && offsetof(CcdCase, to) == offsetof(ogc_ccd_case, to));
static_assert(sizeof(VolumeForceCase) == sizeof(ogc_volume_force_case) &&
              offsetof(VolumeForceCase, slip_limit) == offsetof(ogc_volume_force_case, slip_limit));
static_assert(sizeof(BlockQuestion) == sizeof(ogc_block_question) &&
              offsetof(BlockQuestion, face) == offsetof(ogc_block_question, face_kind));

using Plugin = std::shared_ptr<PluginProcess>;

ClosestFaceOut ask_closest_face(PluginProcess& plugin, const ClosestFaceIn& in) {
  const std::vector<Bytes> inputs{bytes_of(in.point), bytes_of(in.triangle)};
  const auto answer = plugin.ask("closest_face", sizes_of(in.point.size()), inputs);
  ClosestFaceOut out;
  Outputs(answer).to(out.feature, out.weights, out.distance, out.distance_below);
  return out;
}

ClosestPointsOut ask_closest_points(PluginProcess& plugin, const ClosestPointsIn& in) {
  const std::vector<Bytes> inputs{bytes_of(in.first), bytes_of(in.second)};
  const auto answer = plugin.ask("closest_points", sizes_of(in.first.size()), inputs);
  ClosestPointsOut out;
  Outputs(answer).to(out.first_feature, out.second_feature, out.nearly_parallel, out.parameters, out.contact_distance,
                     out.distance_below);
  return out;
}

PluginProcess::Answer ask_detection(PluginProcess& plugin, std::string_view stage, const DetectIn& in) {
  std::vector<Bytes> inputs = inputs_of(*in.topology);
  const CompressedRows partners = rows_by_vertex(in.exclusions.partners, in.positions.size());
  inputs.push_back(bytes_of(in.exclusions.groups));
  inputs.push_back(bytes_of(partners.offsets));
  inputs.push_back(bytes_of(partners.items));
  inputs.push_back(bytes_of(in.positions));
  const std::vector<std::uint8_t> inside = inside_solid(*in.topology);
  inputs.push_back(bytes_of(inside));
  QuestionSizes sizes = sizes_of(*in.topology);
  sizes.first = in.contact_radius;
  sizes.second = in.query_radius;
  return plugin.ask(stage, sizes, inputs);
}

DetectVertexFacetOut ask_detect_vertex_facet(PluginProcess& plugin, const DetectIn& in) {
  const auto answer = ask_detection(plugin, "detect_vertex_facet", in);
  DetectVertexFacetOut out;
  std::vector<ogc_vertex_facet_contact> contacts;
  Outputs(answer).to(contacts, out.d_min_vertex, out.d_min_triangle);
  for (const auto& c : contacts) out.contacts.push_back(contact_of(c));
  return out;
}

DetectEdgeEdgeOut ask_detect_edge_edge(PluginProcess& plugin, const DetectIn& in) {
  const auto answer = ask_detection(plugin, "detect_edge_edge", in);
  DetectEdgeEdgeOut out;
  std::vector<ogc_edge_edge_contact> contacts;
  Outputs(answer).to(contacts, out.d_min_edge);
  for (const auto& c : contacts) out.contacts.push_back(contact_of(c));
  return out;
}

BoundOut ask_bound(PluginProcess& plugin, const BoundIn& in) {
  std::vector<Bytes> inputs = inputs_of(*in.topology);
  for (const auto& distances : {in.d_min_vertex, in.d_min_edge, in.d_min_triangle})
    inputs.push_back(bytes_of(distances));
  const std::vector<std::uint8_t> inside = inside_solid(*in.topology);
  inputs.push_back(bytes_of(inside));
  QuestionSizes sizes = sizes_of(*in.topology);
  sizes.first = in.bounds_relaxation;
  const auto answer = plugin.ask("bound", sizes, inputs);
  BoundOut out;
  Outputs(answer).to(out.bound);
  return out;
}

/// Sorts planes by vertex; `all` has them in the plug-in's order.
VertexPlanes planes_of(const std::vector<ogc_vertex_plane>& all, const std::vector<double>& offsets, Index vertices) {
  std::vector<std::pair<Index, VertexPlane>> planes;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ogc_vertex_plane& p = all[i];
    if (p.vertex < 0 || p.vertex >= vertices || p.kind < OGC_VERTEX_TRIANGLE_PAIR || p.kind > OGC_EDGE_EDGE_PAIR)
      throw ContestantFailure("plane " + std::to_string(i) + " is of vertex " + std::to_string(p.vertex) +
                              " and of a pair of kind " + std::to_string(p.kind) + "; there are " +
                              std::to_string(vertices) + " vertices and kinds 0 and 1");
    const PrimitivePair pair{static_cast<PrimitivePair::Kind>(p.kind), p.first, p.second};
    planes.push_back({p.vertex, {pair, {p.normal.x, p.normal.y, p.normal.z}, offsets[i]}});
  }
  std::ranges::sort(planes, {}, [](const auto& plane) {
    const PrimitivePair& pair = plane.second.pair;
    return std::tuple(plane.first, pair.kind, pair.first, pair.second);
  });
  VertexPlanes rows;
  rows.offsets.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (const auto& [vertex, plane] : planes) {
    ++rows.offsets[static_cast<std::size_t>(vertex) + 1];
    rows.items.push_back(plane);
  }
  std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
  return rows;
}

PlaneOut ask_plane(PluginProcess& plugin, const PlaneIn& in) {
  std::vector<Bytes> inputs = inputs_of(*in.topology);
  const CompressedRows partners = rows_by_vertex(in.exclusions.partners, in.positions.size());
  for (const Bytes& array : {bytes_of(in.exclusions.groups), bytes_of(partners.offsets), bytes_of(partners.items),
                             bytes_of(in.positions), bytes_of(in.is_fixed)})
    inputs.push_back(array);
  const std::vector<std::uint8_t> inside = inside_solid(*in.topology);
  inputs.push_back(bytes_of(inside));
  QuestionSizes sizes = sizes_of(*in.topology);
  sizes.first = in.query_radius;
  sizes.second = in.bounds_relaxation;
  const auto answer = plugin.ask("plane", sizes, inputs);
  PlaneOut out;
  std::vector<ogc_vertex_plane> planes;
  std::vector<double> offsets;
  Outputs(answer).to(planes, offsets, out.bound);
  out.planes = planes_of(planes, offsets, in.topology->vertex_count);
  return out;
}

ActivationOut ask_activation(PluginProcess& plugin, const ActivationIn& in) {
  const std::vector<Bytes> inputs{bytes_of(in.distance), bytes_of(in.contact_radius), bytes_of(in.stiffness),
                                  bytes_of(in.activation)};
  const auto answer = plugin.ask("activation", sizes_of(in.distance.size()), inputs);
  ActivationOut out;
  Outputs(answer).to(out.energy, out.slope, out.curvature);
  return out;
}

/// Returns half-spaces with one row for each case, even if no case has half-spaces.
HalfSpacesIn half_spaces_by_case(const TruncateIn& in) {
  if (!in.half_spaces.offsets.empty()) return in.half_spaces;
  const std::size_t n = in.bound.size();
  return {.offsets = std::vector<Index>(n + 1, 0),
          .items = {},
          .current = in.previous,
          .block = std::vector(n, inertia_block),
          .is_prescribed = std::vector<std::uint8_t>(n, 0)};
}

TruncateOut ask_truncate(PluginProcess& plugin, const TruncateIn& in) {
  const HalfSpacesIn all = half_spaces_by_case(in);
  const std::vector<Bytes> inputs{bytes_of(in.previous), bytes_of(in.position),      bytes_of(in.bound),
                                  bytes_of(all.offsets), bytes_of(all.items),        bytes_of(all.current),
                                  bytes_of(all.block),   bytes_of(all.is_prescribed)};
  const auto answer = plugin.ask("truncate", sizes_of(in.bound.size()), inputs);
  TruncateOut out;
  Outputs(answer).to(out.position, out.cut);
  return out;
}

CcdOut ask_ccd(PluginProcess& plugin, const CcdIn& in) {
  const std::vector<Bytes> inputs{bytes_of(in.cases)};
  const auto answer = plugin.ask("ccd", sizes_of(in.cases.size()), inputs);
  CcdOut out;
  Outputs(answer).to(out.time);
  return out;
}

BarrierOut ask_barrier(PluginProcess& plugin, const BarrierIn& in) {
  std::vector<float> squared, activation, thickness;
  for (const BarrierCase& c : in.cases) {
    squared.push_back(c.squared_distance);
    activation.push_back(c.activation_distance);
    thickness.push_back(c.thickness);
  }
  const std::vector<Bytes> inputs{bytes_of(squared), bytes_of(activation), bytes_of(thickness)};
  const auto answer = plugin.ask("barrier", sizes_of(in.cases.size()), inputs);
  BarrierOut out;
  Outputs(answer).to(out.energy, out.slope, out.curvature);
  return out;
}

VolumeDepthOut ask_volume_depth(PluginProcess& plugin, const VolumeDepthIn& in) {
  std::vector<Bytes> inputs = inputs_of(*in.topology);
  inputs.push_back(bytes_of(in.positions));
  inputs.push_back(bytes_of(in.points));
  QuestionSizes sizes = sizes_of(*in.topology);
  sizes.first = in.contact_radius;
  sizes.cases = static_cast<std::int64_t>(in.points.size());
  const auto answer = plugin.ask("volume_depth", sizes, inputs);
  std::vector<ogc_volume_contact> contacts;
  std::vector<ogc_volume_numbers> numbers;
  Outputs(answer).to(contacts, numbers);
  VolumeDepthOut out;
  for (std::size_t i = 0; i < contacts.size(); ++i) out.contacts.push_back(contact_of(contacts[i], numbers[i]));
  std::ranges::sort(out.contacts, {},
                    [](const VolumeContact& c) { return std::tuple(c.point, c.inside, c.triangle, c.face); });
  return out;
}

template <class In>
ForceOut ask_force(PluginProcess& plugin, std::string_view stage, const In& in) {
  const std::vector<Bytes> inputs{bytes_of(in.cases)};
  const auto answer = plugin.ask(stage, sizes_of(in.cases.size()), inputs);
  ForceOut out;
  Outputs(answer).to(out.force, out.block);
  return out;
}

InitialGuessOut ask_initial_guess(PluginProcess& plugin, const InitialGuessIn& in) {
  const std::vector<Bytes> inputs{bytes_of(in.cases)};
  const auto answer = plugin.ask("initial_guess", sizes_of(in.cases.size()), inputs);
  InitialGuessOut out;
  Outputs(answer).to(out.target, out.position, out.cut);
  return out;
}

BlockOut ask_block(PluginProcess& plugin, const BlockIn& in) {
  std::vector<Bytes> inputs = inputs_of(*in.topology);
  inputs.push_back(bytes_of(in.positions));
  inputs.push_back(bytes_of(in.questions));
  QuestionSizes sizes = sizes_of(*in.topology);
  sizes.cases = static_cast<std::int64_t>(in.questions.size());
  const auto answer = plugin.ask("block", sizes, inputs);
  BlockOut out;
  Outputs(answer).to(out.inside);
  return out;
}

template <class Out, class In>
std::function<Out(const In&)> timed(std::function<Out(const In&)> plugin, const std::function<Out(const In&)>& ours,
                                    std::string name, std::shared_ptr<Times> times) {
  if (!plugin || !ours) return plugin;
  return [plugin, ours, name, times](const In& in) {
    Out answer = plugin(in);
    const auto start = std::chrono::steady_clock::now();
    ours(in);
    (*times)[name] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return answer;
  };
}

}  // namespace

Contestant plugin_contestant(Plugin plugin) {
  Contestant c;
  c.name = plugin->name();
  c.has_steps_with_planes = false;
  c.divides_by_approach = false;
  c.has_cavities = false;
  c.has_volumes = false;
  c.has_rods = false;
  c.closest_face = [plugin](const ClosestFaceIn& in) { return ask_closest_face(*plugin, in); };
  c.closest_points = [plugin](const ClosestPointsIn& in) { return ask_closest_points(*plugin, in); };
  c.block = [plugin](const BlockIn& in) { return ask_block(*plugin, in); };
  c.detect_vertex_facet = [plugin](const DetectIn& in) { return ask_detect_vertex_facet(*plugin, in); };
  c.detect_edge_edge = [plugin](const DetectIn& in) { return ask_detect_edge_edge(*plugin, in); };
  c.bound = [plugin](const BoundIn& in) { return ask_bound(*plugin, in); };
  c.plane = [plugin](const PlaneIn& in) { return ask_plane(*plugin, in); };
  c.initial_guess = [plugin](const InitialGuessIn& in) { return ask_initial_guess(*plugin, in); };
  c.activation = [plugin](const ActivationIn& in) { return ask_activation(*plugin, in); };
  c.contact_force = [plugin](const ContactForceIn& in) { return ask_force(*plugin, "contact_force", in); };
  c.friction_force = [plugin](const FrictionForceIn& in) { return ask_force(*plugin, "friction_force", in); };
  c.membrane = [plugin](const MembraneIn& in) { return ask_force(*plugin, "membrane", in); };
  c.bending = [plugin](const BendingIn& in) { return ask_force(*plugin, "bending", in); };
  c.spring = [plugin](const SpringIn& in) { return ask_force(*plugin, "spring", in); };
  c.tetrahedron = [plugin](const TetrahedronIn& in) { return ask_force(*plugin, "tetrahedron", in); };
  c.ccd = [plugin](const CcdIn& in) { return ask_ccd(*plugin, in); };
  c.barrier = [plugin](const BarrierIn& in) { return ask_barrier(*plugin, in); };
  c.volume_depth = [plugin](const VolumeDepthIn& in) { return ask_volume_depth(*plugin, in); };
  c.volume_force = [plugin](const VolumeForceIn& in) { return ask_force(*plugin, "volume_force", in); };
  c.truncate = [plugin](const TruncateIn& in) { return ask_truncate(*plugin, in); };
  c.rest_state = [plugin](const RestStateIn& in) { return ask_rest_state(*plugin, in); };
  c.sweep = [plugin](const SweepIn& in) { return ask_sweep(*plugin, in); };
  c.step = [plugin](const StepIn& in) { return ask_step(*plugin, in); };
  visit_stages([&](const char* name, auto member) {
    if (!plugin->has(name)) c.*member = nullptr;
  });
  return c;
}

Contestant timed_beside(Contestant plugin, const Contestant& ours, std::shared_ptr<Times> times) {
  visit_stages(
      [&](const char* name, auto member) { plugin.*member = timed(plugin.*member, ours.*member, name, times); });
  return plugin;
}

}  // namespace ogc::experiments
