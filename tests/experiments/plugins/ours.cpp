// Offers the fast path's kernels as a plug-in, for the stages about whole scenes and about planes. Right answers prove
// that the structures of the C interface contain all that is needed. The environment variable OGC_BROKEN makes the
// answers wrong. The step consists of detection, truncation and sweeps.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/stages/bound.hpp"
#include "compare/stages/initial_guess.hpp"
#include "compare/stages/step.hpp"
#include "compare/stages/tetrahedron.hpp"
#include "fast/kernels/touching_move.hpp"
#include "tests/experiments/plugins/ours.hpp"

OGC_PLUGIN("ours", OGC_HOST_MEMORY)

namespace {

using namespace ogc;
using namespace ogc::compare;
using namespace ogc::tests;

ogc_vec3 plain(const Vec3f& p) { return {p.x, p.y, p.z}; }
std::vector<Vec3f> points(const ogc_vec3* p, std::size_t n) {
  std::vector<Vec3f> all;
  for (std::size_t v = 0; v < n; ++v) all.push_back(point(p[v]));
  return all;
}

Tetrahedron tetrahedron(const int32_t (&t)[4]) { return {t[0], t[1], t[2], t[3]}; }

Body body_of(const ogc_body& b) {
  Body body{"", b.first_vertex, b.vertex_count, b.first_triangle, b.triangle_count, b.fixed != 0, {}};
  body.first_tetrahedron = b.first_tetrahedron, body.tetrahedron_count = b.tetrahedron_count;
  Material& m = body.material;
  m.density = b.density, m.lame_lambda = b.lame_lambda, m.lame_mu = b.lame_mu, m.membrane_damping = b.membrane_damping;
  m.bending_stiffness = b.bending_stiffness, m.bending_damping = b.bending_damping,
  m.contact_stiffness = b.contact_stiffness, m.friction = b.friction;
  m.solid_density = b.solid_density, m.solid_lambda = b.solid_lambda, m.solid_mu = b.solid_mu,
  m.solid_damping = b.solid_damping;
  m.membrane = static_cast<MembraneModel>(b.membrane), m.bending = static_cast<BendingModel>(b.bending);
  return body;
}

Settings settings_of(const ogc_settings& s) {
  Settings settings;
  settings.time_step = s.time_step, settings.contact_radius = s.contact_radius,
  settings.detection_radius_cap = s.detection_radius_cap;
  settings.bounds_relaxation = s.bounds_relaxation, settings.detection_fraction = s.detection_fraction,
  settings.friction_velocity = s.friction_velocity, settings.settled_move = s.settled_move;
  settings.iterations = s.iterations, settings.detection_every = s.detection_every,
  settings.detection_gap = s.detection_gap, settings.guess_rounds = s.guess_rounds, settings.lanes = s.lanes;
  settings.contact_activation = static_cast<ContactActivation>(s.contact_activation),
  settings.damping = static_cast<DampingForm>(s.damping_form);
  return settings;
}

void add_faces(const ogc_topology& t, Mesh& mesh) {
  for (Index k = 0; k < t.triangle_count; ++k)
    mesh.triangles.push_back({t.triangles[k][0], t.triangles[k][1], t.triangles[k][2]});
  for (Index e = 0; e < t.edge_count; ++e)
    if (t.edge_triangles.offsets[e] == t.edge_triangles.offsets[e + 1])
      mesh.loose_edges.push_back({t.edges[e][0], t.edges[e][1]});
}

std::vector<std::array<Index, 2>> pairs_of_rows(const ogc_rows& partners, Index vertices) {
  std::vector<std::array<Index, 2>> pairs;
  for (Index v = 0; v < vertices; ++v)
    for (Index i = partners.offsets[v]; i < partners.offsets[v + 1]; ++i)
      if (partners.items[i] > v) pairs.push_back({v, partners.items[i]});
  return pairs;
}

/// Returns the scene. Motions have vertices but no movement, because the input has target positions.
Scene scene_of(const ogc_scene& in) {
  Scene scene;
  const ogc_topology& t = in.topology;
  scene.rest_positions = to_double(points(in.rest_positions, static_cast<std::size_t>(t.vertex_count)));
  scene.mesh.positions = scene.rest_positions;
  scene.velocities.resize(scene.rest_positions.size());
  add_faces(t, scene.mesh);
  for (Index k = 0; k < in.tetrahedron_count; ++k) scene.mesh.tetrahedra.push_back(tetrahedron(in.tetrahedra[k]));
  for (Index k = 0; k < in.body_count; ++k) scene.bodies.push_back(body_of(in.bodies[k]));
  for (Index k = 0; k < in.spring_count; ++k) {
    const ogc_scene_spring& s = in.springs[k];
    scene.springs.push_back({s.vertex[0], s.vertex[1], s.stiffness, s.rest_length, s.damping, s.vertex[2], s.ratio});
  }
  for (Index v = 0; v < t.vertex_count; ++v) {
    const auto group = static_cast<std::size_t>(std::max(0, in.rigid_groups[v]));
    if (group > scene.motions.size()) scene.motions.resize(group);
    if (group > 0) scene.motions[group - 1].vertices.push_back(v);
  }
  scene.excluded_pairs = pairs_of_rows(in.excluded_partners, t.vertex_count);
  scene.gravity = {in.gravity.x, in.gravity.y, in.gravity.z};
  scene.settings = settings_of(in.settings);
  return scene;
}

void write_solids(const RestStateOut& rest, ogc_rest_state_out& out) {
  out.tetrahedron_count = static_cast<std::int64_t>(rest.tetrahedra.size());
  for (std::size_t k = 0; k < rest.tetrahedra.size(); ++k) {
    const RestTetrahedron& t = rest.tetrahedra[k];
    std::copy(t.corner.begin(), t.corner.end(), out.solid_corner[k]);
    out.solid_body[k] = t.body, out.volume[k] = t.volume, out.inverse[k] = t.inverse;
    std::copy(t.weight.begin(), t.weight.end(), out.solid_weight[k]);
    for (std::size_t i = 0; i < 3; ++i) std::copy(t.gradient[i].begin(), t.gradient[i].end(), out.solid_gradient[k][i]);
  }
}

void write(const RestStateOut& rest, ogc_rest_state_out& out) {
  std::copy(rest.mass.begin(), rest.mass.end(), out.mass);
  out.triangle_count = static_cast<std::int64_t>(rest.triangles.size());
  out.hinge_count = static_cast<std::int64_t>(rest.hinges.size());
  for (std::size_t k = 0; k < rest.triangles.size(); ++k) {
    const RestTriangle& t = rest.triangles[k];
    std::copy(t.corner.begin(), t.corner.end(), out.corner[k]);
    out.triangle_body[k] = t.body, out.area[k] = t.area;
    for (std::size_t i = 0; i < 2; ++i) std::copy(t.gradient[i].begin(), t.gradient[i].end(), out.gradient[k][i]);
  }
  for (std::size_t k = 0; k < rest.hinges.size(); ++k) {
    const RestHinge& h = rest.hinges[k];
    std::copy(h.vertex.begin(), h.vertex.end(), out.hinge_vertex[k]);
    out.hinge_body[k] = h.body, out.rest_angle[k] = h.rest_angle, out.hinge_stiffness[k] = h.stiffness;
    std::copy(h.weight.begin(), h.weight.end(), out.weight[k]);
  }
  std::copy(rest.edge_length_squared.begin(), rest.edge_length_squared.end(), out.edge_length_squared);
  for (std::size_t k = 0; k < rest.meetings.size(); ++k) {
    out.meeting_stiffness[k] = rest.meetings[k].stiffness;
    out.meeting_friction[k] = rest.meetings[k].friction;
  }
  write_solids(rest, out);
}

RestStateOut rest_of(const ogc_sweep_in& in) {
  const ogc_rest& r = in.rest;
  RestStateOut rest;
  rest.mass.assign(r.mass, r.mass + in.scene.topology.vertex_count);
  for (Index k = 0; k < r.triangle_count; ++k)
    rest.triangles.push_back(
        {{r.corner[k][0], r.corner[k][1], r.corner[k][2]},
         r.triangle_body[k],
         r.area[k],
         {{{r.gradient[k][0][0], r.gradient[k][0][1]}, {r.gradient[k][1][0], r.gradient[k][1][1]}}}});
  for (Index k = 0; k < r.hinge_count; ++k)
    rest.hinges.push_back({{r.hinge_vertex[k][0], r.hinge_vertex[k][1], r.hinge_vertex[k][2], r.hinge_vertex[k][3]},
                           r.hinge_body[k],
                           r.rest_angle[k],
                           r.hinge_stiffness[k],
                           {r.weight[k][0], r.weight[k][1], r.weight[k][2]}});
  rest.edge_length_squared.assign(r.edge_length_squared, r.edge_length_squared + in.scene.topology.edge_count);
  for (Index k = 0; k < in.scene.body_count * in.scene.body_count; ++k)
    rest.meetings.push_back({r.meeting_stiffness[k], r.meeting_friction[k]});
  for (Index k = 0; k < r.tetrahedron_count; ++k) {
    RestTetrahedron t{tetrahedron(r.solid_corner[k]), r.solid_body[k], r.volume[k], r.inverse[k]};
    std::copy(std::begin(r.solid_weight[k]), std::end(r.solid_weight[k]), t.weight.begin());
    for (std::size_t i = 0; i < 3; ++i)
      std::copy(std::begin(r.solid_gradient[k][i]), std::end(r.solid_gradient[k][i]), t.gradient[i].begin());
    rest.tetrahedra.push_back(t);
  }
  return rest;
}

/// Returns a colouring in which the vertices of each stencil have different colours.
std::vector<Index> colours(const RestStateOut& rest, const std::vector<Spring>& springs,
                           const std::vector<Index>& groups) {
  std::vector<std::vector<Index>> others(groups.size());
  const auto join = [&](const auto& stencil) {
    for (const Index v : stencil) others[v].insert(others[v].end(), stencil.begin(), stencil.end());
  };
  for (const RestTriangle& t : rest.triangles) join(t.corner);
  for (const RestHinge& h : rest.hinges) join(h.vertex);
  for (const RestTetrahedron& t : rest.tetrahedra)
    if (!breaks("tetrahedra without colours")) join(t.corner);
  for (const Spring& s : springs)
    s.third < 0 ? join(std::vector{s.first, s.second}) : join(std::vector{s.first, s.second, s.third});
  std::vector<Index> colour(groups.size(), -1);
  for (std::size_t v = 0; v < groups.size(); ++v) {
    if (groups[v] != -1) continue;
    const auto is_taken = [&](Index c) {
      return std::any_of(others[v].begin(), others[v].end(), [&](Index u) { return colour[u] == c; });
    };
    Index c = 0;
    while (is_taken(c)) ++c;
    colour[v] = c;
  }
  return colour;
}

std::vector<fast::Vec> vectors(const std::vector<Vec3f>& all) {
  std::vector<fast::Vec> result;
  for (const Vec3f& p : all) result.push_back({p.x, p.y, p.z});
  return result;
}

/// Computes a step by Algorithm 3 and records its events.
class Step {
 public:
  explicit Step(const ogc_step_in& in)
      : count_(static_cast<std::size_t>(in.scene.topology.vertex_count)),
        scene_(scene_of(in.scene)),
        topology_(build_topology(scene_)),
        groups_(rigid_groups(scene_)),
        left_out_(exclusions(scene_)),
        start_(points(in.start, count_)),
        velocity_(points(in.velocity, count_)),
        x_(start_),
        taken_(count_),
        touches_(count_) {
    rest = ours().rest_state({&scene_, &topology_});
    colour = colours(rest, scene_.springs, groups_);
    set_targets(in);
    run();
  }

  RestStateOut rest;
  std::vector<Index> colour;
  std::vector<Vec3f> target;
  float query_radius = 0;
  std::vector<StepEvent> events;
  const std::vector<Vec3f>& end() const { return x_; }
  Vec3f velocity(std::size_t v) const {
    const float h = static_cast<float>(scene_.settings.time_step);
    return {(x_[v].x - start_[v].x) / h, (x_[v].y - start_[v].y) / h, (x_[v].z - start_[v].z) / h};
  }

 private:
  void set_targets(const ogc_step_in& in) {
    const Vec3f gravity = point(in.scene.gravity);
    const auto h = static_cast<float>(scene_.settings.time_step);
    InitialGuessIn guess;
    for (std::size_t v = 0; v < count_; ++v)
      guess.cases.push_back({start_[v], velocity_[v], gravity, h, start_[v], 0, 0});
    target = ours().initial_guess(guess).target;
    double farthest = 0;
    for (std::size_t v = 0; v < count_; ++v) {
      if (groups_[v] != -1) target[v] = groups_[v] == 0 ? start_[v] : point(in.prescribed[v]);
      farthest = std::max(farthest, std::hypot(double{target[v].x} - start_[v].x, double{target[v].y} - start_[v].y,
                                               double{target[v].z} - start_[v].z));
    }
    const double r = scene_.settings.contact_radius;
    query_radius = static_cast<float>(std::min(r + farthest, scene_.settings.detection_radius_cap * r));
  }

  void run() {
    const Settings& s = scene_.settings;
    const auto moving = static_cast<double>(bounded_count(topology_, groups_));
    const auto threshold = [&](std::int64_t times) {
      const double share = static_cast<double>(times) * (s.detection_fraction * moving);
      return std::max(1.0, breaks("threshold") ? std::floor(share) : std::ceil(share));
    };
    for (std::int64_t round = 0;;) {
      detect();
      const Index cut = guess(round == 0);
      ++round;
      if (cut < threshold(breaks("rounds ask alike") ? 1 : round) || round >= s.guess_rounds) break;
    }
    bool found = true;
    std::int64_t since = 0;
    for (std::int64_t i = breaks("one iteration less") ? 1 : 0; i < s.iterations; ++i) {
      if (!found) detect(), since = 0;
      const std::vector<Vec3f> before = x_;
      const Index cut = sweep();
      ++since;
      found = (cut < threshold(1) || since < s.detection_gap) && (s.detection_every == 0 || since < s.detection_every);
      if (found && cut == 0 && s.settled_move > 0 && largest_move(before) <= s.settled_move) break;
    }
  }

  void detect() {
    const DetectIn in{&topology_, left_out_, x_, static_cast<float>(scene_.settings.contact_radius), query_radius};
    detected_ = {StepEventKind::detection, x_, 0, ours().detect_vertex_facet(in), ours().detect_edge_edge(in), {}};
    detected_.bound = ours()
                          .bound({&topology_, detected_.vertex_facet.d_min_vertex, detected_.edge_edge.d_min_edge,
                                  detected_.vertex_facet.d_min_triangle,
                                  static_cast<float>(scene_.settings.bounds_relaxation)})
                          .bound;
    events.push_back(detected_);
  }

  /// Returns the last detection's contacts for each vertex, as the guess kernel reads them.
  std::vector<std::vector<fast::ContactIncidence>> incidences() const {
    std::vector<std::vector<fast::ContactIncidence>> rows(count_);
    const std::vector<Index> body = body_of_vertex(scene_);
    const auto add = [&](fast::ContactKind kind, const std::array<Index, 4>& vertex, std::size_t other) {
      fast::ContactIncidence contact;
      contact.kind = kind;
      std::copy(vertex.begin(), vertex.end(), contact.index);
      contact.friction = rest.meetings[body[vertex[0]] * scene_.bodies.size() + body[vertex[other]]].friction;
      for (std::uint8_t k = 0; k < 4; ++k) {
        // Unused places of a contact repeat its first vertex.
        if (groups_[vertex[k]] == 0 || (k > 0 && vertex[k] == vertex[0])) continue;
        contact.own = k;
        rows[vertex[k]].push_back(contact);
      }
    };
    for (const VertexFacetContact& c : detected_.vertex_facet.contacts) {
      const Index v = c.vertex;
      if (c.face.kind == FaceKind::vertex) add(fast::ContactKind::point_point, {v, v, c.face.index, v}, 2);
      if (c.face.kind == FaceKind::edge) {
        const Edge& e = topology_.edges[c.face.index];
        add(fast::ContactKind::point_segment, {v, v, e[0], e[1]}, 2);
      }
      if (c.face.kind == FaceKind::triangle) {
        const Triangle& t = topology_.triangles[c.face.index];
        add(fast::ContactKind::point_triangle, {v, t[0], t[1], t[2]}, 1);
      }
    }
    for (const EdgeEdgeContact& c : detected_.edge_edge.contacts) {
      const Index p = c.first.index, q = c.second.index;
      if (c.second.kind == FaceKind::vertex) {
        add(fast::ContactKind::point_point, {p, p, q, p}, 2);
        continue;
      }
      const Edge& f = topology_.edges[q];
      if (c.first.kind == FaceKind::vertex)
        add(fast::ContactKind::point_segment, {p, p, f[0], f[1]}, 2);
      else
        add(fast::ContactKind::segment_segment, {topology_.edges[p][0], topology_.edges[p][1], f[0], f[1]}, 2);
    }
    return rows;
  }

  /// Returns the positions before truncation: each vertex moves by the part of its move that contacts leave.
  std::vector<Vec3f> proposals() {
    const std::vector<std::vector<fast::ContactIncidence>> rows = incidences();
    const std::vector<fast::Vec> position = vectors(x_), wanted = vectors(target), before = taken_;
    fast::GuessContacts here;
    here.position = position.data(), here.target = wanted.data(), here.taken = before.data();
    here.radius = static_cast<float>(scene_.settings.contact_radius);
    std::vector<Vec3f> all = target;
    for (std::size_t v = 0; v < count_; ++v) {
      const fast::Vec move = wanted[v] - position[v];
      fast::Vec held = move;
      touches_[v] = !rows[v].empty();
      if (groups_[v] != -1) continue;
      for (const fast::ContactIncidence& contact : rows[v]) held = fast::held_by(here, contact, held);
      taken_[v] = held - move;
      const fast::Vec end = position[v] + held;
      if (held.x != move.x || held.y != move.y || held.z != move.z) all[v] = {end.x, end.y, end.z};
    }
    return all;
  }

  Index guess(bool is_first) {
    const bool stay = breaks("touching vertices stay");
    const std::vector<Vec3f> held = proposals();
    const TruncateOut kept = ours().truncate({x_, stay ? target : held, detected_.bound});
    Index cut = 0;
    for (std::size_t v = 0; v < count_; ++v) {
      if (!is_first && touches_[v] && (stay || groups_[v] > 0)) continue;
      x_[v] = kept.position[v];
      cut += kept.cut[v];
    }
    events.push_back({StepEventKind::guess, x_, cut, {}, {}, {}});
    return cut;
  }

  double largest_move(const std::vector<Vec3f>& before) const {
    double largest = 0;
    for (std::size_t v = 0; v < count_; ++v)
      for (float Vec3f::*axis : {&Vec3f::x, &Vec3f::y, &Vec3f::z})
        largest = std::max(largest, std::abs(double{x_[v].*axis} - before[v].*axis));
    return largest;
  }

  Index sweep() {
    const SweepOut out = ours().sweep({&scene_, &topology_, &rest, colour, x_, start_, target, detected_.position,
                                       detected_.bound, detected_.vertex_facet.contacts, detected_.edge_edge.contacts});
    x_ = out.position;
    events.push_back({StepEventKind::sweep, x_, out.cut, {}, {}, {}});
    return out.cut;
  }

  std::size_t count_;
  Scene scene_;
  Topology topology_;
  std::vector<Index> groups_;
  Exclusions left_out_;
  std::vector<Vec3f> start_, velocity_, x_;
  std::vector<fast::Vec> taken_;  // what contacts removed in the previous round
  std::vector<bool> touches_;
  StepEvent detected_;
};

/// Writes the step's events. If a list of the caller is too short, writes only the counts.
class Trace {
 public:
  explicit Trace(ogc_step_out& out) : out_(out) {}

  void write(const std::vector<StepEvent>& events) {
    count(events);
    if (out_.event_count > out_.event_capacity || out_.detection_count > out_.detection_capacity ||
        out_.vertex_facet_count > out_.vertex_facet_capacity || out_.edge_edge_count > out_.edge_edge_capacity)
      return;
    for (std::size_t i = 0; i < events.size(); ++i) {
      out_.kind[i] = static_cast<std::int32_t>(events[i].kind);
      out_.cut[i] = events[i].cut;
      std::transform(events[i].position.begin(), events[i].position.end(),
                     out_.event_position + i * events[i].position.size(), plain);
      if (events[i].kind == StepEventKind::detection) add(events[i]);
    }
  }

 private:
  void count(const std::vector<StepEvent>& events) {
    out_.event_count = static_cast<std::int64_t>(events.size());
    out_.detection_count = out_.vertex_facet_count = out_.edge_edge_count = 0;
    for (const StepEvent& event : events) {
      out_.detection_count += event.kind == StepEventKind::detection;
      out_.vertex_facet_count += static_cast<std::int64_t>(event.vertex_facet.contacts.size());
      out_.edge_edge_count += static_cast<std::int64_t>(event.edge_edge.contacts.size());
    }
    if (breaks("one detection too many") && out_.detection_count < out_.detection_capacity) ++out_.detection_count;
  }

  void add(const StepEvent& event) {
    const auto copy = [&](const std::vector<float>& from, float* to) {
      std::copy(from.begin(), from.end(), to + detections_ * from.size());
    };
    copy(event.vertex_facet.d_min_vertex, out_.d_min_vertex);
    copy(event.vertex_facet.d_min_triangle, out_.d_min_triangle);
    copy(event.edge_edge.d_min_edge, out_.d_min_edge);
    copy(event.bound, out_.bound);
    for (const VertexFacetContact& c : event.vertex_facet.contacts)
      out_.vertex_facet[facets_++] = {c.vertex, static_cast<std::int32_t>(c.face.kind), c.face.index, c.owner};
    for (const EdgeEdgeContact& c : event.edge_edge.contacts)
      out_.edge_edge[edges_++] = {static_cast<std::int32_t>(c.first.kind),
                                  c.first.index,
                                  static_cast<std::int32_t>(c.second.kind),
                                  c.second.index,
                                  c.first_edge,
                                  c.second_edge};
    out_.vertex_facet_end[detections_] = static_cast<std::int32_t>(facets_);
    out_.edge_edge_end[detections_] = breaks("no end") ? -1 : static_cast<std::int32_t>(edges_);
    ++detections_;
  }

  ogc_step_out& out_;
  std::size_t detections_ = 0, facets_ = 0, edges_ = 0;
};

}  // namespace

int ogc_plane(const ogc_plane_in* in, ogc_plane_out* out) {
  const auto n = static_cast<std::size_t>(in->topology.vertex_count);
  const std::vector<Vec3f> positions = points(in->positions, n);
  Mesh mesh;
  mesh.positions = to_double(positions);
  add_faces(in->topology, mesh);
  Topology topology = build_topology(mesh);
  topology.off_surface.assign(in->inside_solid, in->inside_solid + n);
  const auto pairs = pairs_of_rows(in->excluded_partners, in->topology.vertex_count);
  const CompressedRows partners = partner_rows(n, pairs);
  const PlaneOut answer = ours().plane({&topology,
                                        {{in->rigid_groups, n}, pairs.empty() ? nullptr : &partners},
                                        positions,
                                        {in->is_fixed, n},
                                        in->query_radius,
                                        in->bounds_relaxation});
  std::copy(answer.bound.begin(), answer.bound.end(), out->bound);
  out->count = static_cast<std::int64_t>(answer.planes.items.size());
  if (out->count > out->capacity) return 0;
  std::size_t i = 0;
  for (Index v = in->topology.vertex_count - 1; v >= 0; --v)  // any order is legal
    for (const VertexPlane& plane : answer.planes.of(v)) {
      const bool is_turned = breaks("normals turned") && i == 0;
      const Vec3f n_of_first = is_turned ? Vec3f{-plane.normal.x, -plane.normal.y, -plane.normal.z} : plane.normal;
      out->planes[i] = {v, static_cast<std::int32_t>(plane.pair.kind), plane.pair.first, plane.pair.second,
                        plain(n_of_first)};
      out->offset[i++] = plane.offset;
    }
  if (breaks("plane of nobody") && i > 0) out->planes[0].vertex = in->topology.vertex_count;
  if (breaks("plane of no pair") && i > 0) out->planes[0].kind = 7;
  return 0;
}

int ogc_truncate(const ogc_truncate_in* in, ogc_truncate_out* out) {
  const auto n = static_cast<std::size_t>(in->n);
  TruncateIn question{points(in->previous, n), points(in->position, n), {in->bound, in->bound + n}};
  HalfSpacesIn& all = question.half_spaces;
  all.offsets.assign(in->half_space_offsets, in->half_space_offsets + n + 1);
  for (Index k = 0; k < all.offsets.back(); ++k)
    all.items.push_back({point(in->half_spaces[k].normal), in->half_spaces[k].offset});
  all.current = points(in->current, n);
  for (std::size_t i = 0; i < n; ++i)
    std::copy(std::begin(in->block[i]), std::end(in->block[i]), all.block.emplace_back().begin());
  all.is_prescribed.assign(in->is_prescribed, in->is_prescribed + n);
  if (breaks("all slide")) all.is_prescribed.assign(n, 0);
  const TruncateOut answer = ours().truncate(question);
  std::transform(answer.position.begin(), answer.position.end(), out->position, plain);
  std::copy(answer.cut.begin(), answer.cut.end(), out->cut);
  return 0;
}

int ogc_tetrahedron(const ogc_tetrahedron_in* in, ogc_force_out* out) {
  TetrahedronIn question;
  for (const ogc_tetrahedron_case* c = in->cases; c != in->cases + in->n; ++c) {
    TetrahedronCase own;
    std::transform(std::begin(c->corner), std::end(c->corner), own.corner.begin(), point);
    std::transform(std::begin(c->start), std::end(c->start), own.start.begin(), point);
    std::copy(std::begin(c->weight), std::end(c->weight), own.weight.begin());
    for (std::size_t i = 0; i < 3; ++i)
      std::copy(std::begin(c->gradient[i]), std::end(c->gradient[i]), own.gradient[i].begin());
    own.inverse = c->inverse, own.volume = c->volume, own.lame_lambda = c->lame_lambda, own.lame_mu = c->lame_mu;
    own.damping = c->damping, own.damping_form = static_cast<DampingForm>(c->damping_form);
    if (breaks("corner order")) std::swap(own.corner[2], own.corner[3]);
    question.cases.push_back(own);
  }
  const ForceOut answer = ours().tetrahedron(question);
  std::transform(answer.force.begin(), answer.force.end(), out->force, plain);
  for (std::size_t i = 0; i < answer.block.size(); ++i)
    std::copy(answer.block[i].begin(), answer.block[i].end(), out->block[i]);
  return 0;
}

int ogc_rest_state(const ogc_scene* in, ogc_rest_state_out* out) {
  const Scene scene = scene_of(*in);
  const Topology topology = build_topology(scene);
  RestStateOut rest = ours().rest_state({&scene, &topology});
  if (breaks("rest angle"))
    for (RestHinge& h : rest.hinges) h.rest_angle = -h.rest_angle;
  write(rest, *out);
  if (breaks("area not a number") && !rest.triangles.empty()) out->area[0] = std::numeric_limits<float>::quiet_NaN();
  if (breaks("mass of a third"))
    for (const Body& body : scene.bodies)
      for (Index v = 0; body.is_solid() && v < body.vertex_count; ++v) out->mass[body.first_vertex + v] *= 4.0f / 3;
  if (breaks("behind the solids")) out->solid_body[in->tetrahedron_count] = 0;
  if (breaks("behind the list")) out->corner[in->topology.triangle_count][0] = 0;
  if (breaks("short list")) ++out->hinge_count;
  return 0;
}

int ogc_sweep(const ogc_sweep_in* in, ogc_sweep_out* out) {
  const Scene scene = scene_of(in->scene);
  const Topology topology = build_topology(scene);
  const RestStateOut rest = rest_of(*in);
  const auto n = static_cast<std::size_t>(topology.vertex_count);
  const std::vector<Vec3f> old = points(in->old, n), start = points(in->start, n), target = points(in->target, n),
                           previous = points(in->previous, n);
  std::vector<VertexFacetContact> facets;
  std::vector<EdgeEdgeContact> edges;
  for (const ogc_vertex_facet_contact* c = in->vertex_facet; c != in->vertex_facet + in->vertex_facet_count; ++c)
    facets.push_back({c->vertex, {static_cast<FaceKind>(c->kind), c->face}, c->owner});
  for (const ogc_edge_edge_contact* c = in->edge_edge; c != in->edge_edge + in->edge_edge_count; ++c)
    edges.push_back({{static_cast<FaceKind>(c->first_kind), c->first_face},
                     {static_cast<FaceKind>(c->second_kind), c->second_face},
                     c->first_edge,
                     c->second_edge});
  if (breaks("one contact dropped") && !facets.empty()) facets.pop_back();
  const SweepOut sweep = ours().sweep(
      {&scene, &topology, &rest, {in->colour, n}, old, start, target, previous, {in->bound, n}, facets, edges});
  std::transform(sweep.position.begin(), sweep.position.end(), out->position, plain);
  *out->cut = sweep.cut + breaks("cut");
  if (breaks("crash")) std::abort();
  if (breaks("hang"))
    for (;;) pause();
  return 0;
}

int ogc_step(const ogc_step_in* in, ogc_step_out* out) {
  const Step step(*in);
  write(step.rest, out->rest);
  std::copy(step.colour.begin(), step.colour.end(), out->colour);
  *out->query_radius = step.query_radius;
  std::transform(step.target.begin(), step.target.end(), out->target, plain);
  std::transform(step.end().begin(), step.end().end(), out->position, plain);
  for (std::size_t v = 0; v < step.end().size(); ++v) out->velocity[v] = plain(step.velocity(v));
  Trace(*out).write(step.events);
  if (breaks("odd event")) out->kind[0] = 9;
  const Index wild = 1000000000;
  if (breaks("wild colour")) std::fill_n(out->colour, in->scene.topology.vertex_count, wild);
  if (breaks("negative colour")) std::fill_n(out->colour, in->scene.topology.vertex_count, -7);
  if (breaks("wild contact") && out->vertex_facet_count > 0) out->vertex_facet[0] = {wild, 2, -wild, -5};
  if (breaks("wild edges") && out->edge_edge_count > 0) out->edge_edge[0] = {1, wild, 0, -wild, wild, -3};
  return 0;
}
