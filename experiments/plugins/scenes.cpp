// Converts scenes and rest states into arrays in the order of stages.cpp, and traces into events. Arrays are in single
// precision; this loses nothing, because a judged scene is rounded.
#include "experiments/plugins/scenes.hpp"

#include <algorithm>

#include "experiments/plugins/arrays.hpp"

namespace ogc::experiments {

using namespace ogc::compare;

namespace {

static_assert(sizeof(Hinge) == sizeof(ogc_hinge) && offsetof(Hinge, opposite) == offsetof(ogc_hinge, opposite));

float single(double x) { return static_cast<float>(x); }

ogc_settings settings_of(const Settings& s) {
  return {single(s.time_step),
          single(s.contact_radius),
          single(s.detection_radius_cap),
          single(s.bounds_relaxation),
          single(s.detection_fraction),
          single(s.friction_velocity),
          single(s.settled_move),
          s.iterations,
          s.detection_every,
          s.detection_gap,
          s.guess_rounds,
          s.lanes,
          static_cast<std::int64_t>(s.contact_activation),
          static_cast<std::int64_t>(s.damping)};
}

ogc_body body_of(const Body& b) {
  const Material& m = b.material;
  return {b.first_vertex,
          b.vertex_count,
          b.first_triangle,
          b.triangle_count,
          b.first_tetrahedron,
          b.tetrahedron_count,
          b.fixed,
          static_cast<std::int32_t>(m.membrane),
          static_cast<std::int32_t>(m.bending),
          single(m.density),
          single(m.lame_lambda),
          single(m.lame_mu),
          single(m.membrane_damping),
          single(m.bending_stiffness),
          single(m.bending_damping),
          single(m.contact_stiffness),
          single(m.friction),
          single(m.solid_density),
          single(m.solid_lambda),
          single(m.solid_mu),
          single(m.solid_damping)};
}

/// Holds the arrays of ogc_scene.
class SceneArrays {
 public:
  SceneArrays(const Scene& scene, const Topology& topology)
      : topology_(topology),
        settings_(scene.settings),
        gravity_(to_single({scene.gravity})[0]),
        rest_(to_single(scene.rest_positions)),
        groups_(rigid_groups(scene)),
        partners_(partner_rows(rest_.size(), scene.excluded_pairs)),
        tetrahedra_(scene.mesh.tetrahedra),
        inside_solid_(inside_solid(topology)) {
    for (const Body& body : scene.bodies) bodies_.push_back(body_of(body));
    if (partners_.rows() == 0) partners_ = rows_by_vertex(nullptr, rest_.size());
    for (const Spring& s : scene.springs)
      springs_.push_back({{s.first, s.second, s.third},
                          single(s.stiffness),
                          single(s.rest_length),
                          single(s.damping),
                          single(s.ratio)});
  }

  QuestionSizes sizes() const {
    QuestionSizes sizes = sizes_of(topology_);
    sizes.hinges = static_cast<std::int32_t>(topology_.hinges.size());
    sizes.bodies = static_cast<std::int32_t>(bodies_.size());
    sizes.springs = static_cast<std::int32_t>(springs_.size());
    sizes.tetrahedra = static_cast<std::int32_t>(tetrahedra_.size());
    sizes.settings = settings_of(settings_);
    sizes.gravity = {gravity_.x, gravity_.y, gravity_.z};
    return sizes;
  }

  std::vector<Bytes> inputs() const {
    std::vector<Bytes> inputs = inputs_of(topology_);
    for (const Bytes& array :
         {bytes_of(topology_.hinges), bytes_of(bodies_), bytes_of(springs_), bytes_of(rest_), bytes_of(groups_),
          bytes_of(partners_.offsets), bytes_of(partners_.items), bytes_of(tetrahedra_), bytes_of(inside_solid_)})
      inputs.push_back(array);
    return inputs;
  }

 private:
  const Topology& topology_;
  const Settings& settings_;
  Vec3f gravity_;
  std::vector<Vec3f> rest_;
  std::vector<Index> groups_;
  CompressedRows partners_;
  const std::vector<Tetrahedron>& tetrahedra_;
  std::vector<std::uint8_t> inside_solid_;
  std::vector<ogc_body> bodies_;
  std::vector<ogc_scene_spring> springs_;
};

/// Holds the arrays of ogc_rest, and converts a rest state into them and back.
struct RestArrays {
  std::vector<float> mass;
  std::vector<Triangle> corner;
  std::vector<Index> triangle_body;
  std::vector<float> area;
  std::vector<std::array<std::array<float, 2>, 2>> gradient;
  std::vector<std::array<Index, 4>> hinge_vertex;
  std::vector<Index> hinge_body;
  std::vector<float> rest_angle, hinge_stiffness;
  std::vector<std::array<float, 3>> weight;
  std::vector<float> edge_length_squared, meeting_stiffness, meeting_friction;
  std::vector<Tetrahedron> solid_corner;
  std::vector<Index> solid_body;
  std::vector<float> volume, inverse;
  std::vector<std::array<float, 6>> solid_weight;
  std::vector<std::array<std::array<float, 3>, 3>> solid_gradient;

  RestArrays() = default;
  explicit RestArrays(const RestStateOut& rest) : mass(rest.mass), edge_length_squared(rest.edge_length_squared) {
    for (const RestTriangle& t : rest.triangles) {
      corner.push_back(t.corner);
      triangle_body.push_back(t.body);
      area.push_back(t.area);
      gradient.push_back(t.gradient);
    }
    for (const RestHinge& h : rest.hinges) {
      hinge_vertex.push_back(h.vertex);
      hinge_body.push_back(h.body);
      rest_angle.push_back(h.rest_angle);
      hinge_stiffness.push_back(h.stiffness);
      weight.push_back(h.weight);
    }
    for (const MeetingMaterial& m : rest.meetings) {
      meeting_stiffness.push_back(m.stiffness);
      meeting_friction.push_back(m.friction);
    }
    for (const RestTetrahedron& t : rest.tetrahedra) {
      solid_corner.push_back(t.corner);
      solid_body.push_back(t.body);
      volume.push_back(t.volume);
      inverse.push_back(t.inverse);
      solid_weight.push_back(t.weight);
      solid_gradient.push_back(t.gradient);
    }
  }

  template <class Visit>
  void visit(Visit visit) {
    visit(mass, corner, triangle_body, area, gradient, hinge_vertex, hinge_body, rest_angle, hinge_stiffness, weight,
          edge_length_squared, meeting_stiffness, meeting_friction, solid_corner, solid_body, volume, inverse,
          solid_weight, solid_gradient);
  }

  RestStateOut rest() const {
    RestStateOut rest;
    rest.mass = mass;
    for (std::size_t t = 0; t < corner.size(); ++t)
      rest.triangles.push_back({corner[t], triangle_body[t], area[t], gradient[t]});
    for (std::size_t h = 0; h < hinge_vertex.size(); ++h)
      rest.hinges.push_back({hinge_vertex[h], hinge_body[h], rest_angle[h], hinge_stiffness[h], weight[h]});
    rest.edge_length_squared = edge_length_squared;
    for (std::size_t i = 0; i < meeting_stiffness.size(); ++i)
      rest.meetings.push_back({meeting_stiffness[i], meeting_friction[i]});
    for (std::size_t t = 0; t < solid_corner.size(); ++t)
      rest.tetrahedra.push_back(
          {solid_corner[t], solid_body[t], volume[t], inverse[t], solid_weight[t], solid_gradient[t]});
    return rest;
  }
};

ogc_vertex_facet_contact plain(const VertexFacetContact& c) {
  return {c.vertex, static_cast<std::int32_t>(c.face.kind), c.face.index, c.owner};
}

ogc_edge_edge_contact plain(const EdgeEdgeContact& c) {
  return {static_cast<std::int32_t>(c.first.kind),
          c.first.index,
          static_cast<std::int32_t>(c.second.kind),
          c.second.index,
          c.first_edge,
          c.second_edge};
}

/// Returns the targets of prescribed vertices after the step, and for all other vertices their positions.
std::vector<Vec3f> prescribed_of(const Scene& scene) {
  std::vector<Vec3f> target = to_single(scene.mesh.positions);
  for (const PrescribedMotion& motion : scene.motions) {
    const std::vector<Vec3f> to = prescribed_targets(scene, motion, scene.settings.time_step);
    for (std::size_t k = 0; k < to.size(); ++k) target[static_cast<std::size_t>(motion.vertices[k])] = to[k];
  }
  return target;
}

/// Holds the outputs of the stage `step` that follow its rest state: events and detections.
struct Trace {
  std::vector<float> query_radius;
  std::vector<Index> kind, cut;
  std::vector<Vec3f> position;  ///< positions after each event, one event after another
  /// results of each detection, one detection after another
  std::vector<float> d_min_vertex, bound, d_min_triangle, d_min_edge;
  std::vector<Index> vertex_facet_end, edge_edge_end;
  std::vector<ogc_vertex_facet_contact> vertex_facet;
  std::vector<ogc_edge_edge_contact> edge_edge;
};

/// Returns the k-th group of `length` consecutive elements.
template <class T>
std::vector<T> part(const std::vector<T>& all, std::size_t k, std::size_t length) {
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(k * length);
  return {first, first + static_cast<std::ptrdiff_t>(length)};
}

/// Returns the contacts of detection k in the canonical order that sweeps require. `ends` has the end of each
/// detection's contacts in `all`.
template <class Contact, class Plain>
std::vector<Contact> contacts_of(const std::vector<Plain>& all, const std::vector<Index>& ends, std::size_t k) {
  const std::int64_t begin = k == 0 ? 0 : ends[k - 1], end = ends[k];
  if (begin > end || begin < 0 || end > static_cast<std::int64_t>(all.size()))
    throw ContestantFailure("the contacts of detection " + std::to_string(k) + " are said to end at " +
                            std::to_string(end) + ", those before it at " + std::to_string(begin) + ", of " +
                            std::to_string(all.size()));
  std::vector<Contact> contacts;
  for (std::int64_t i = begin; i < end; ++i) contacts.push_back(contact_of(all[static_cast<std::size_t>(i)]));
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

std::vector<StepEvent> events_of(const Trace& trace, const Topology& topology) {
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  std::vector<StepEvent> events;
  std::size_t detections = 0;
  for (std::size_t i = 0; i < trace.kind.size(); ++i) {
    if (trace.kind[i] < OGC_DETECTION || trace.kind[i] > OGC_SWEEP)
      throw ContestantFailure("event " + std::to_string(i) + " is of kind " + std::to_string(trace.kind[i]) +
                              "; known: 0 detection, 1 guess, 2 sweep");
    StepEvent event{
        static_cast<StepEventKind>(trace.kind[i]), part(trace.position, i, vertices), trace.cut[i], {}, {}, {}};
    if (event.kind == StepEventKind::detection) {
      const std::size_t k = detections++;
      if (k >= trace.vertex_facet_end.size())
        throw ContestantFailure("it has more events of detection than it counts detections");
      event.vertex_facet = {contacts_of<VertexFacetContact>(trace.vertex_facet, trace.vertex_facet_end, k),
                            part(trace.d_min_vertex, k, vertices),
                            part(trace.d_min_triangle, k, topology.triangles.size())};
      event.edge_edge = {contacts_of<EdgeEdgeContact>(trace.edge_edge, trace.edge_edge_end, k),
                         part(trace.d_min_edge, k, topology.edges.size())};
      event.bound = part(trace.bound, k, vertices);
    }
    events.push_back(std::move(event));
  }
  if (detections != trace.vertex_facet_end.size())
    throw ContestantFailure("it counts more detections than it has events of detection");
  return events;
}

}  // namespace

RestStateOut ask_rest_state(PluginProcess& plugin, const RestStateIn& in) {
  const SceneArrays scene(*in.scene, *in.topology);
  const auto answer = plugin.ask("rest_state", scene.sizes(), scene.inputs());
  RestArrays arrays;
  Outputs outputs(answer);
  arrays.visit([&](auto&... items) { outputs.to(items...); });
  return arrays.rest();
}

SweepOut ask_sweep(PluginProcess& plugin, const SweepIn& in) {
  const SceneArrays scene(*in.scene, *in.topology);
  RestArrays rest(*in.rest);
  std::vector<ogc_vertex_facet_contact> vertex_facet;
  std::vector<ogc_edge_edge_contact> edge_edge;
  for (const auto& c : in.vertex_facet) vertex_facet.push_back(plain(c));
  for (const auto& c : in.edge_edge) edge_edge.push_back(plain(c));
  QuestionSizes sizes = scene.sizes();
  sizes.rest_triangles = static_cast<std::int32_t>(rest.corner.size());
  sizes.rest_hinges = static_cast<std::int32_t>(rest.hinge_vertex.size());
  sizes.rest_tetrahedra = static_cast<std::int32_t>(rest.solid_corner.size());
  sizes.vertex_facet = static_cast<std::int64_t>(vertex_facet.size());
  sizes.edge_edge = static_cast<std::int64_t>(edge_edge.size());
  std::vector<Bytes> inputs = scene.inputs();
  rest.visit([&](const auto&... items) { (inputs.push_back(bytes_of(items)), ...); });
  for (const Bytes& array : {bytes_of(in.colour), bytes_of(in.old), bytes_of(in.start), bytes_of(in.target),
                             bytes_of(in.previous), bytes_of(in.bound), bytes_of(vertex_facet), bytes_of(edge_edge)})
    inputs.push_back(array);
  const auto answer = plugin.ask("sweep", sizes, inputs);
  SweepOut out;
  std::vector<Index> cut;
  Outputs(answer).to(out.position, cut);
  out.cut = cut.at(0);
  return out;
}

StepOut ask_step(PluginProcess& plugin, const StepIn& in) {
  const SceneArrays scene(*in.scene, *in.topology);
  const std::vector<Vec3f> start = to_single(in.scene->mesh.positions), velocity = to_single(in.scene->velocities),
                           prescribed = prescribed_of(*in.scene);
  std::vector<Bytes> inputs = scene.inputs();
  for (const auto* array : {&start, &velocity, &prescribed}) inputs.push_back(bytes_of(*array));
  const auto answer = plugin.ask("step", scene.sizes(), inputs);
  StepOut out;
  RestArrays rest;
  Trace t;
  Outputs outputs(answer);
  rest.visit([&](auto&... items) { outputs.to(items...); });
  outputs.to(out.colour, t.query_radius, out.target, out.position, out.velocity, t.kind, t.cut, t.position,
             t.d_min_vertex, t.bound, t.d_min_triangle, t.d_min_edge, t.vertex_facet_end, t.edge_edge_end,
             t.vertex_facet, t.edge_edge);
  out.rest = rest.rest();
  out.query_radius = t.query_radius.at(0);
  out.events = events_of(t, *in.topology);
  return out;
}

}  // namespace ogc::experiments
