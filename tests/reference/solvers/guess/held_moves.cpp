// Tests the moves that contacts leave, on cases derived by hand, and compares the judge's errors with moves in single
// precision.
#include "reference/solvers/guess/held_moves.hpp"

#include <cmath>
#include <random>

#include "reference/solvers/detection.hpp"
#include "reference/solvers/guess_contacts.hpp"
#include "reference/solvers/kinds/rest_state.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::Hold, reference::Triple, reference::held_by;
using reference::operator+, reference::operator-, reference::operator*;

namespace {

using Move = Triple<double>;

double norm(const Move& a) { return std::hypot(a[0], a[1], a[2]); }
double between(const Move& a, const Move& b) { return norm(a - b); }

/// Returns a contact of a vertex above its partner, n = +z.
Hold above(const Move& others, double friction = 0, double weight = 1) {
  return {.weight = weight, .normal = {0, 0, 1}, .others = others, .friction = friction};
}

/// A sheet above another sheet, with all contacts at the start.
struct Sheets {
  compare::Scene scene = two_sheets();
  compare::Topology topology;
  compare::RestStateOut rest;
  reference::Detected found;
  std::vector<reference::GuessContact> contacts;
  std::vector<compare::Vec3f> x;

  explicit Sheets(double friction = 0.3) {
    for (compare::Body& body : scene.bodies) body.material.friction = friction;
    round_to_single(scene);
    topology = build_topology(scene);
    rest = reference::rest_state({&scene, &topology}).exact;
    x = compare::to_single(scene.mesh.positions);
    found = reference::detect(scene, topology, rigid_groups(scene), x, 8e-3F);
    contacts = reference::guess_contacts(scene, topology, rest, found.active.vertex_facet, found.active.edge_edge);
  }
  reference::HeldMoves moves() const { return {rigid_groups(scene), scene.settings.contact_radius}; }
};

}  // namespace

TEST_CASE("what closes a contact is taken, and what opens it or goes along it is left", "[unit]") {
  CHECK(held_by(above({}), {1, 2, -3}) == Move{1, 2, 0});
  CHECK(held_by(above({}), {1, 2, 3}) == Move{1, 2, 3});
  // A vertex below its partner has a negative weight.
  CHECK(held_by(above({}, 0, -1), {1, 2, 3}) == Move{1, 2, 0});
  CHECK(held_by(above({}, 0, -0.5), {1, 2, -3}) == Move{1, 2, -3});
}

TEST_CASE("a partner that makes room is followed, and one that comes is not fled from", "[unit]") {
  // The first argument is minus the partner's move, because the weights of the partner's vertices are −1 in sum.
  CHECK(held_by(above({0, 0, 1}), {0, 0, -3}) == Move{0, 0, -1});
  CHECK(held_by(above({0, 0, 4}), {0, 0, -3}) == Move{0, 0, -3});
  CHECK(held_by(above({0, 0, -1}), {0, 0, -3}) == Move{0, 0, 0});
  CHECK(held_by(above({0, 0, -1}), {0, 0, 0}) == Move{0, 0, 0});
  // A vertex with the weight 1/2 may move twice as far as its partner.
  CHECK(held_by(above({0, 0, 1}, 0, 0.5), {0, 0, -3}) == Move{0, 0, -2});
}

TEST_CASE("friction takes slip up to mu times the approach that was taken", "[unit]") {
  CHECK(between(held_by(above({}, 0.5), {3, 4, -2}), {2.4, 3.2, 0}) < 1e-15);
  CHECK(held_by(above({}, 0.5), {0.3, 0.4, -2}) == Move{0, 0, 0});
  CHECK(held_by(above({}, 0.5), {3, 4, 2}) == Move{3, 4, 2});
  // Slip is measured relative to the partner, so friction moves the vertex with the partner.
  CHECK(held_by(above({-1, 0, 0}, 1), {0, 0, -2}) == Move{1, 0, 0});
  CHECK(between(held_by(above({-5, 0, 0}, 1), {0, 0, -2}), {2, 0, 0}) < 1e-15);
}

TEST_CASE("no contact takes more than friction and approach allow, and a move that is held is held no further",
          "[property]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto draw = [&] { return Move{any(random), any(random), any(random)}; };
  for (int i = 0; i < 20000; ++i) {
    const Move n = draw(), m = draw();
    const double mu = std::abs(any(random)), w = any(random);
    const Hold hold{w, (1 / norm(n)) * n, draw(), mu};
    const Move held = held_by(hold, m);
    const double taken = std::max(0.0, hold.taken(m));
    CHECK(between(held, m) <= std::sqrt(1 + mu * mu) * taken * (1 + 1e-12));
    CHECK(norm(hold.slide(held)) <= norm(hold.slide(m)) * (1 + 1e-12));
    CHECK(hold.taken(held) <= 1e-12);
    CHECK(between(held_by(hold, held), held) <= 1e-11);
  }
}

TEST_CASE(
    "a sheet that falls on a fixed one keeps its way along it, and what is not near goes to its target to the bit",
    "[unit]") {
  const Sheets sheets(0);
  const reference::State previous = reference::widened(sheets.x);
  reference::State target = previous;
  for (std::size_t v = 0; v < 36; ++v) target[v] = target[v] + Move{1e-3, -2e-3, 0};
  const reference::State guess = sheets.moves().round(sheets.contacts, previous, target);
  std::size_t held = 0;
  for (std::size_t v = 0; v < 36; ++v) {
    held += guess[v] != target[v];
    CHECK(guess[v][1] - previous[v][1] > -2.0000001e-3);
    if (guess[v] != target[v]) CHECK(guess[v][1] - previous[v][1] > -2e-4);
    CHECK(std::abs(guess[v][0] - previous[v][0] - 1e-3) < 2e-4);
  }
  CHECK(held > 10);
  for (std::size_t v = 36; v < guess.size(); ++v) CHECK(guess[v] == target[v]);
  CHECK(sheets.moves().round({}, previous, target) == target);
}

TEST_CASE("what contacts took in a round is not expected of the others in the next one", "[unit]") {
  Sheets sheets(0);
  sheets.scene.bodies[1].fixed = false;
  const reference::State previous = reference::widened(sheets.x);
  reference::State target = previous;
  for (std::size_t v = 0; v < 36; ++v) target[v][1] -= 2e-3;
  for (std::size_t v = 36; v < target.size(); ++v) target[v][1] += 2e-3;
  reference::HeldMoves twice = sheets.moves();
  const reference::State first = twice.round(sheets.contacts, previous, target),
                         second = twice.round(sheets.contacts, previous, target);
  // Both sheets stop in the first round. In the second round each sheet counts the other sheet's move without the part
  // that contacts removed in the first round, and both stop again.
  CHECK(first != target);
  for (std::size_t v = 0; v < first.size(); ++v) CHECK(between(first[v], second[v]) < 1e-3);
}

TEST_CASE("the judge's moves are those of whole runs, within what it accepts, round after round", "[property]") {
  Sheets sheets(0.4);
  const reference::State previous = reference::widened(sheets.x);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(-2e-3F, 2e-3F);
  for (int i = 0; i < 20; ++i) {
    std::vector<compare::Vec3f> target = sheets.x;
    for (std::size_t v = 0; v < 36; ++v)
      target[v] = {target[v].x + any(random), target[v].y + any(random) - 1e-3F, target[v].z + any(random)};
    reference::HeldMoves whole = sheets.moves(), judged = sheets.moves();
    for (int round = 0; round < 3; ++round) {
      const reference::State at = whole.round(sheets.contacts, previous, reference::widened(target));
      const auto truth = judged.judged_round(sheets.contacts, sheets.x, target);
      for (std::size_t v = 0; v < at.size(); ++v) {
        const Move move{truth[v].move.x, truth[v].move.y, truth[v].move.z};
        CHECK(between(at[v] - previous[v], move) <= truth[v].accepted + 1e-15);
        if (truth[v].touches == 0) CHECK(move == reference::widened(target)[v] - previous[v]);
      }
    }
  }
}

TEST_CASE("contacts of an answer that are not there hold nothing", "[unit]") {
  const Sheets sheets;
  using enum compare::FaceKind;
  const std::vector<compare::VertexFacetContact> facets{
      {-1, {vertex, 0}, 0}, {0, {triangle, 1 << 30}, 0}, {1 << 30, {edge, 0}, 0}};
  const std::vector<compare::EdgeEdgeContact> edges{{{edge, -3}, {edge, 0}, 0, 0}, {{edge, 0}, {edge, 1 << 30}, 0, 0}};
  CHECK(reference::guess_contacts(sheets.scene, sheets.topology, sheets.rest, facets, edges).empty());
}
