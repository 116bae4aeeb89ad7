// Faults of rest_state, block and initial_guess.
#include <algorithm>

#include "compare/judge/stages/verdict.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

using SpoilRest = std::function<void(const Scene&, RestStateOut&)>;

Fault rest_fault(const std::string& name, const SpoilRest& spoil) {
  return {name, Stage::rest_state, [spoil](Contestant& contestant, const Authority&) {
            contestant.rest_state = [right = contestant.rest_state, spoil](const RestStateIn& in) {
              RestStateOut out = right(in);
              spoil(*in.scene, out);
              return out;
            };
          }};
}

/// The right answer about the start instead of the rest shape.
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

std::vector<Fault> solid_rest_faults() {
  const auto of_each = [](const char* name, void (*spoil)(RestTetrahedron&)) {
    return rest_fault(std::string("rest_state: ") + name, [spoil](const Scene&, RestStateOut& out) {
      for (RestTetrahedron& t : out.tetrahedra) spoil(t);
    });
  };
  return {
      rest_fault("rest_state: a third of a tetrahedron's mass to each corner",
                 [](const Scene& scene, RestStateOut& out) {
                   for (const Body& body : scene.bodies)
                     for (Index v = 0; body.is_solid() && v < body.vertex_count; ++v)
                       out.mass[static_cast<std::size_t>(body.first_vertex + v)] *= 4.0f / 3;
                 }),
      of_each("six times the volume of tetrahedra",
              [](RestTetrahedron& t) {
                t.volume *= 6, t.inverse /= 6;
                for (float& w : t.weight) w *= 6;
              }),
      of_each("gradients of tetrahedra transposed",
              [](RestTetrahedron& t) {
                for (std::size_t k = 0; k < 3; ++k)
                  for (std::size_t axis = 0; axis < k; ++axis) std::swap(t.gradient[k][axis], t.gradient[axis][k]);
              }),
      of_each("gradients of tetrahedra of the other sign",
              [](RestTetrahedron& t) {
                for (auto& gradient : t.gradient)
                  for (float& g : gradient) g = -g;
              }),
      of_each("1/V for 1/(6V)", [](RestTetrahedron& t) { t.inverse *= 6; }),
      of_each("weights of opposite edges exchanged", [](RestTetrahedron& t) { std::swap(t.weight[0], t.weight[5]); }),
      of_each("two corners of tetrahedra exchanged", [](RestTetrahedron& t) { std::swap(t.corner[2], t.corner[3]); }),
      rest_fault("rest_state: triangles of solids among those of cloth",
                 [](const Scene& scene, RestStateOut& out) {
                   for (const Body& body : scene.bodies)
                     if (body.is_solid() && !body.fixed)
                       out.triangles.push_back({scene.mesh.triangles[static_cast<std::size_t>(body.first_triangle)]});
                 }),
  };
}

std::vector<Fault> rest_state_faults() {
  return {
      rest_fault("rest_state: half of a triangle's mass to each corner",
                 [](const Scene&, RestStateOut& out) {
                   for (float& m : out.mass) m *= 1.5f;
                 }),
      rest_fault("rest_state: no mass without a membrane", weightless_without_membrane),
      rest_fault("rest_state: axes of the gradients exchanged",
                 [](const Scene&, RestStateOut& out) {
                   for (RestTriangle& t : out.triangles)
                     for (auto& g : t.gradient) std::swap(g[0], g[1]);
                 }),
      rest_fault("rest_state: the third corner below the first axis",
                 [](const Scene&, RestStateOut& out) {
                   for (RestTriangle& t : out.triangles)
                     for (auto& g : t.gradient) g[1] = -g[1];
                 }),
      rest_fault("rest_state: hinge without the factor 3",
                 [](const Scene&, RestStateOut& out) {
                   for (RestHinge& h : out.hinges) h.stiffness /= 3;
                 }),
      rest_fault("rest_state: rest angle of the other sign",
                 [](const Scene&, RestStateOut& out) {
                   for (RestHinge& h : out.hinges) h.rest_angle = -h.rest_angle;
                 }),
      rest_fault("rest_state: every hinge flat at rest",
                 [](const Scene&, RestStateOut& out) {
                   for (RestHinge& h : out.hinges) h.rest_angle = 0;
                 }),
      rest_fault("rest_state: arithmetic mean of contact stiffnesses", arithmetic_mean),
      start_taken_for_rest(),
  };
}

double along(const Vec3f& x, const Vec3f& a, const Vec3f& b) {
  return (double{x.x} - a.x) * (double{b.x} - a.x) + (double{x.y} - a.y) * (double{b.y} - a.y) +
         (double{x.z} - a.z) * (double{b.z} - a.z);
}

using SpoilBlock = std::function<void(const BlockIn&, const BlockQuestion&, std::uint8_t& inside)>;

Fault block_fault(const std::string& name, const SpoilBlock& spoil) {
  return {name, Stage::block, [spoil](Contestant& contestant, const Authority&) {
            contestant.block = [right = contestant.block, spoil](const BlockIn& in) {
              BlockOut out = right(in);
              for (std::size_t i = 0; i < in.questions.size(); ++i) spoil(in, in.questions[i], out.inside[i]);
              return out;
            };
          }};
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

/// The right answer about a complex that lacks the last neighbour of each row.
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

/// The first end of the edge stands for its closest point.
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
      block_fault("block: closed planes of a vertex opened", open_vertex_planes),
      block_fault("block: open ends of an edge closed", close_edge_ends),
      forgotten("block: one neighbour of each vertex forgotten", &Topology::vertex_edges),
      forgotten("block: edge without its far triangle", &Topology::edge_triangles),
      end_for_closest_point(),
  };
}

/// The right answer to a question that is changed first.
Fault guessed_wrongly(const std::string& name, const std::function<void(InitialGuessCase&)>& change) {
  return {name, Stage::initial_guess, [change](Contestant& contestant, const Authority&) {
            contestant.initial_guess = [right = contestant.initial_guess, change](const InitialGuessIn& in) {
              InitialGuessIn other = in;
              for (InitialGuessCase& c : other.cases) change(c);
              return right(other);
            };
          }};
}

using SpoilGuess = std::function<void(const InitialGuessCase&, std::size_t, InitialGuessOut&)>;

Fault guess_fault(const std::string& name, const SpoilGuess& spoil) {
  return {name, Stage::initial_guess, [spoil](Contestant& contestant, const Authority&) {
            contestant.initial_guess = [right = contestant.initial_guess, spoil](const InitialGuessIn& in) {
              InitialGuessOut out = right(in);
              for (std::size_t i = 0; i < in.cases.size(); ++i) spoil(in.cases[i], i, out);
              return out;
            };
          }};
}

void ignore_bound_of_fast_movers(const InitialGuessCase& c, std::size_t i, InitialGuessOut& out) {
  const Vec3f &y = out.target[i], &p = c.previous;
  const double x = double{y.x} - p.x, z = double{y.z} - p.z, height = double{y.y} - p.y;
  if (out.cut[i] && x * x + height * height + z * z > 1e4 * c.bound * c.bound) out.position[i] = y;
}

std::vector<Fault> initial_guess_faults() {
  return {
      guessed_wrongly("initial_guess: no acceleration", [](InitialGuessCase& c) { c.acceleration = {}; }),
      guessed_wrongly("initial_guess: acceleration times h instead of its square",
                      [](InitialGuessCase& c) {
                        const float h = c.time_step;
                        c.acceleration = {c.acceleration.x / h, c.acceleration.y / h, c.acceleration.z / h};
                      }),
      guessed_wrongly("initial_guess: truncated about the start of the step",
                      [](InitialGuessCase& c) { c.previous = c.start; }),
      guess_fault("initial_guess: bound ignored by fast movers", ignore_bound_of_fast_movers),
      guess_fault("initial_guess: what moves far counted as cut",
                  [](const InitialGuessCase& c, std::size_t i, InitialGuessOut& out) {
                    const Vec3f &y = out.target[i], &p = c.previous;
                    const double moved = std::hypot(double{y.x} - p.x, double{y.y} - p.y, double{y.z} - p.z);
                    if (moved > 0.9 * c.bound) out.cut[i] = 1;
                  }),
  };
}

}  // namespace

namespace {

/// The exact targets rounded; position and cut are those of the rounded ones.
InitialGuessOut exact_guess(const InitialGuessIn& in, const InitialGuessTruth& truth,
                            const std::function<TruncateOut(const TruncateIn&)>& truncate) {
  InitialGuessOut out;
  for (const Vec3& y : truth.target)
    out.target.push_back({static_cast<float>(y.x), static_cast<float>(y.y), static_cast<float>(y.z)});
  TruncateOut cut = truncate(cut_question(in, out));
  out.position = std::move(cut.position);
  out.cut = std::move(cut.cut);
  for (const auto& q : truth.orientation)
    out.orientation.push_back(
        {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]), static_cast<float>(q[3])});
  return out;
}

}  // namespace

void add_right_rest(Contestant& exact, const Authority& authority) {
  exact.rest_state = [authority](const RestStateIn& in) { return authority.rest_state(in).exact; };
  exact.block = [authority](const BlockIn& in) { return BlockOut{authority.block(in).inside}; };
  exact.initial_guess = [authority, truncate = exact.truncate](const InitialGuessIn& in) {
    return exact_guess(in, authority.initial_guess(in), truncate);
  };
}

std::vector<Fault> rest_faults() {
  std::vector<Fault> all = rest_state_faults();
  for (const auto& more : {block_faults(), initial_guess_faults(), solid_rest_faults()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace ogc::tests
