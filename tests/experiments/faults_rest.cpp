// Plants faults of rest_state, block and initial_guess that are not wrong forms of the truth: they change the
// contestant's input or its answer.
#include <algorithm>
#include <cmath>

#include "compare/stages/rest_state.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

template <class Spoil>
Fault rest_fault(const std::string& name, Spoil spoil) {
  return spoiled("rest_state: " + name, &Contestant::rest_state,
                 [spoil](const RestStateIn& in, RestStateOut& out) { spoil(*in.scene, out); });
}

/// Returns a fault that computes rest data from the positions at the start instead of the rest positions.
Fault start_taken_for_rest() {
  return {"rest_state: rest shape taken from the start", Stage::rest_state,
          [](Contestant& contestant, const Authority&) {
            contestant.rest_state = [right = contestant.rest_state](const RestStateIn& in) {
              Scene scene = *in.scene;
              scene.rest_positions = scene.mesh.positions;
              return right({&scene, in.topology});
            };
          }};
}

void weightless_without_membrane(const Scene& scene, RestStateOut& out) {
  for (const Body& body : scene.bodies)
    if (body.material.membrane == MembraneModel::none)
      std::fill_n(out.mass.begin() + body.first_vertex, body.vertex_count, 0.0f);
}

void arithmetic_mean(const Scene& scene, RestStateOut& out) {
  std::size_t i = 0;
  for (const Body& a : scene.bodies)
    for (const Body& b : scene.bodies)
      out.meetings[i++].stiffness = static_cast<float>((a.material.contact_stiffness + b.material.contact_stiffness) /
                                                       2);
}

std::vector<Fault> rest_state_faults() {
  return {rest_fault("no mass without a membrane", weightless_without_membrane),
          rest_fault("arithmetic mean of contact stiffnesses", arithmetic_mean), start_taken_for_rest(),
          rest_fault("two corners of tetrahedra exchanged",
                     [](const Scene&, RestStateOut& out) {
                       for (RestTetrahedron& t : out.tetrahedra) std::swap(t.corner[2], t.corner[3]);
                     }),
          rest_fault("triangles of solids among those of cloth", [](const Scene& scene, RestStateOut& out) {
            for (const Body& body : scene.bodies)
              if (body.is_solid() && !body.fixed)
                out.triangles.push_back({scene.mesh.triangles[static_cast<std::size_t>(body.first_triangle)]});
          })};
}

double along(const Vec3f& x, const Vec3f& a, const Vec3f& b) {
  return (double{x.x} - a.x) * (double{b.x} - a.x) + (double{x.y} - a.y) * (double{b.y} - a.y) +
         (double{x.z} - a.z) * (double{b.z} - a.z);
}

template <class Spoil>
Fault block_fault(const std::string& name, Spoil spoil) {
  return spoiled("block: " + name, &Contestant::block, [spoil](const BlockIn& in, BlockOut& out) {
    for (std::size_t i = 0; i < in.questions.size(); ++i) spoil(in, in.questions[i], out.inside[i]);
  });
}

CompressedRows without_last(const CompressedRows& rows) {
  CompressedRows shorter;
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    const auto row = rows[i];
    shorter.items.insert(shorter.items.end(), row.begin(),
                         row.begin() + std::max<std::ptrdiff_t>(0, std::ssize(row) - 1));
    shorter.offsets.push_back(static_cast<Index>(shorter.items.size()));
  }
  return shorter;
}

/// Returns a fault that answers for a mesh whose lists `rows` (for example each vertex's edges) lack their last entry.
Fault forgotten(const std::string& name, CompressedRows Topology::*rows) {
  return {name, Stage::block, [rows](Contestant& contestant, const Authority&) {
            contestant.block = [right = contestant.block, rows](const BlockIn& in) {
              Topology topology = *in.topology;
              topology.*rows = without_last(topology.*rows);
              return right({&topology, in.positions, in.questions});
            };
          }};
}

void open_vertex_planes(const BlockIn& in, const BlockQuestion& question, std::uint8_t& inside) {
  if (question.kind != BlockQuestion::Kind::vertex_in_surface || question.face.kind != FaceKind::vertex) return;
  const Index a = question.face.index;
  for (const Index b : in.topology->vertex_neighbours[static_cast<std::size_t>(a)])
    if (along(in.positions[question.of], in.positions[a], in.positions[b]) == 0) inside = 0;
}

void close_edge_ends(const BlockIn& in, const BlockQuestion& question, std::uint8_t& inside) {
  if (question.kind != BlockQuestion::Kind::vertex_in_surface || question.face.kind != FaceKind::edge) return;
  const Edge& e = in.topology->edges[question.face.index];
  const Vec3f &x = in.positions[question.of], &a = in.positions[e[0]], &b = in.positions[e[1]];
  if (along(x, a, b) == 0 || along(x, b, a) == 0) inside = 1;
}

/// Returns a fault that uses the first end of an edge in place of the edge's point that is closest to the vertex.
Fault end_for_closest_point() {
  return {"block: first end taken for an edge's closest point", Stage::block,
          [](Contestant& contestant, const Authority&) {
            contestant.block = [right = contestant.block](const BlockIn& in) {
              std::vector<BlockQuestion> questions(in.questions.begin(), in.questions.end());
              for (BlockQuestion& q : questions)
                if (q.kind == BlockQuestion::Kind::edge_in_edges && q.face.kind == FaceKind::vertex)
                  q = {BlockQuestion::Kind::vertex_in_surface, in.topology->edges[q.of][0], q.face};
              return right({in.topology, in.positions, questions});
            };
          }};
}

std::vector<Fault> block_faults() {
  return {
      block_fault("closed planes of a vertex opened", open_vertex_planes),
      block_fault("open ends of an edge closed", close_edge_ends),
      forgotten("block: one neighbour of each vertex forgotten", &Topology::vertex_edges),
      forgotten("block: edge without its far triangle", &Topology::edge_triangles),
      end_for_closest_point(),
  };
}

template <class Spoil>
Fault guess_fault(const std::string& name, Spoil spoil) {
  return spoiled("initial_guess: " + name, &Contestant::initial_guess,
                 [spoil](const InitialGuessIn& in, InitialGuessOut& out) {
                   for (std::size_t i = 0; i < in.cases.size(); ++i) spoil(in.cases[i], i, out);
                 });
}

std::vector<Fault> initial_guess_faults() {
  return {
      cases_asked_wrongly("initial_guess: truncated about the start of the step", &Contestant::initial_guess,
                          [](InitialGuessCase& c) { c.previous = c.start; }),
      guess_fault("what moves far counted as cut", [](const InitialGuessCase& c, std::size_t i, InitialGuessOut& out) {
        const Vec3f &y = out.target[i], &p = c.previous;
        const double moved = std::hypot(double{y.x} - p.x, double{y.y} - p.y, double{y.z} - p.z);
        if (moved > 0.9 * c.bound) out.cut[i] = 1;
      })};
}

}  // namespace

std::vector<Fault> rest_faults() {
  std::vector<Fault> all = rest_state_faults();
  for (const auto& more : {block_faults(), initial_guess_faults()}) all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace ogc::tests
