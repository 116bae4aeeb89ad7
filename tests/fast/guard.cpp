#include "fast/guard.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "compare/problem/error.hpp"
#include "fast/contact_sets.hpp"
#include "tests/catch.hpp"
#include "tests/fast/guards.hpp"

using namespace ogc;
using tests::Positions;

namespace {

constexpr compare::Bounds both_bounds[] = {compare::Bounds::ball, compare::Bounds::planes};

fast::Guard guard_of(const tests::TestMesh& mesh, float query_radius, compare::Bounds bounds, double fraction = 0.01) {
  return fast::Guard(mesh.connectivity(), mesh.positions,
                     {.query_radius = query_radius, .bounds = bounds, .detection_fraction = fraction});
}

Positions every(std::size_t count, const compare::Vec3f& move) { return Positions(count, move); }

/// Returns the message of the error that a guard of a triangle throws with these options.
std::string refusal_of(const fast::GuardOptions& options) {
  const std::vector<compare::Triangle> triangle{{0, 1, 2}};
  const Positions positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  try {
    fast::Guard(fast::Mesh(3, triangle), positions, options);
  } catch (const compare::InputError& error) {
    return error.what();
  }
  return {};
}

/// Adds what a step should report, from the states alone. Sums are not divided.
struct Expected {
  compare::Index cut = 0, most_restricted = -1;
  double asked = 0, lost = 0;
  float most_lost = 0;

  Expected(const Positions& before, const Positions& wanted, const Positions& after) {
    for (std::size_t v = 0; v < before.size(); ++v) {
      const double taken = tests::length_of(tests::gap_of(wanted[v], after[v]));
      asked += tests::length_of(tests::gap_of(wanted[v], before[v]));
      lost += taken;
      if (wanted[v] == after[v]) continue;
      ++cut;
      if (static_cast<float>(taken) > most_lost) {
        most_lost = static_cast<float>(taken);
        most_restricted = static_cast<compare::Index>(v);
      }
    }
  }
};

/// Checks what holds for all bounds. The vertices are `count`.
void check_report(const fast::GuardReport& report, const Expected& expected, std::size_t count) {
  CHECK(report.cut == expected.cut);
  CHECK(report.not_finite == 0);
  CHECK(report.most_restricted == expected.most_restricted);
  CHECK(report.most_lost == expected.most_lost);
  // A sum of n positive numbers errs by 2⁻⁵³ n of itself, in any order; their roots and squares by less.
  const double slack = 0x1p-50 * static_cast<double>(count);
  CHECK(report.asked == Approx(expected.asked).epsilon(slack));
  CHECK(report.lost * report.asked == Approx(expected.lost).epsilon(slack));
  CHECK(report.lost_normal <= report.lost * (1 + slack));
  CHECK(report.lost_tangential <= report.lost * (1 + slack));
  CHECK(report.lost_normal + report.lost_tangential >= report.lost * (1 - slack));
}

/// Checks the parts of what balls about `centre` took.
void check_balls(const fast::GuardReport& report, const Positions& centre, const Positions& wanted,
                 const Positions& after) {
  double normal = 0, largest = 0;
  for (std::size_t v = 0; v < centre.size(); ++v) {
    if (wanted[v] == after[v]) continue;
    const compare::Vec3 n = tests::gap_of(wanted[v], centre[v]), lost = tests::gap_of(wanted[v], after[v]);
    normal += std::abs(n.x * lost.x + n.y * lost.y + n.z * lost.z) / tests::length_of(n);
    for (const float c : {after[v].x, after[v].y, after[v].z}) largest = std::max(largest, double{std::abs(c)});
  }
  // Products and roots of both sides err by a few 2⁻⁵³, sums by 2⁻⁵³ for each vertex.
  CHECK(report.lost_normal * report.asked == Approx(normal).epsilon(0x1p-50 * static_cast<double>(centre.size())));
  // A ball stores each coordinate within 2⁻²³ of itself, so it leaves the way by √3 times this at most. A vertex with
  // b_v < 2⁻²³ max|x| may go back to X_prev, which is on the way.
  CHECK(report.lost_tangential * report.asked <= 2 * 0x1p-23 * largest * report.cut);
}

/// Returns a large triangle in the plane y = 0 and a small one `gap` [m] above its middle.
tests::TestMesh small_above_large(float gap) {
  tests::TestMesh mesh;
  mesh.positions = {{-4, 0, -4}, {4, 0, -4}, {0, 0, 6}, {0, gap, 0}, {0.25F, gap, 0}, {0, gap, 0.25F}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  return mesh;
}

}  // namespace

TEST_CASE("guard: no state and no way has an intersection, whatever is proposed", "[property]") {
  for (const compare::Bounds bounds : both_bounds) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
      const tests::TestMesh faces = tests::random_faces(seed), layers = tests::crumpled_layers(seed);
      REQUIRE(tests::intersections(layers) == 0);
      REQUIRE(faces.triangles.size() > 20);
      REQUIRE(faces.loose_edges.size() > 5);
      for (const tests::TestMesh* mesh : {&faces, &layers}) {
        for (const tests::Proposals& proposals :
             {tests::Proposals{.size = 1}, tests::Proposals{.size = 0.1F, .pull = 0.5F, .foreign = true}}) {
          INFO("bounds " << static_cast<int>(bounds) << ", seed " << seed << ", pull " << proposals.pull);
          fast::Guard guard = guard_of(*mesh, 0.5F, bounds);
          const tests::GuardRun run = tests::run_guard(guard, seed, 16, proposals);
          CHECK(run.intersections == 0);
          CHECK(run.meetings == 0);
          CHECK(run.cut > 0);
          CHECK(run.detections > 0);
          CHECK(run.moved > 1);
        }
      }
    }
  }
}

TEST_CASE("guard: lists that are too small at first grow", "[property]") {
  tests::TestMesh mesh;
  for (int k = 0; k < 12; ++k) mesh.add(tests::sheet(4, 1.0F, 0.01F * static_cast<float>(k)));
  for (const compare::Bounds bounds : both_bounds) {
    fast::Guard guard(mesh.connectivity(), mesh.positions,
                      {.contact_radius = 0.5F, .query_radius = 0.5F, .bounds = bounds});
    CHECK(*guard.contacts().vertex_facet_count == 12 * 11 * 16);  // each vertex touches its twin in each other layer
    const tests::GuardRun run = tests::run_guard(guard, 12, 8, {.size = 0.05F});
    CHECK(run.intersections == 0);
    CHECK(run.meetings == 0);
    CHECK(run.cut > 0);
    CHECK(run.moved > 0.1);
  }
}

TEST_CASE("guard: parallel triangles with gaps from 1e-12 m to 0.1 m stay apart", "[property]") {
  std::mt19937 random(4000);
  std::uniform_real_distribution<float> exponent(-12, -1);
  double moved = 0;
  for (int pair = 0; pair < 4000; ++pair) {
    const float gap = std::pow(10.0F, exponent(random));
    const tests::TestMesh mesh = tests::parallel_triangles(gap, random);
    const compare::Bounds bounds = both_bounds[pair % 2];
    INFO("pair " << pair << ", gap " << gap);
    fast::Guard guard = guard_of(mesh, 0.2F, bounds);
    // Moves of a metre, and moves of the size of the gap.
    for (const float size : {1.0F, 4 * gap}) {
      const tests::GuardRun run = tests::run_guard(guard, static_cast<std::uint32_t>(pair), 6, {.size = size});
      CHECK(run.intersections == 0);
      CHECK(run.meetings == 0);
      moved += run.moved;
    }
  }
  CHECK(moved > 10);
}

TEST_CASE("guard: a step reports what it did", "[property]") {
  std::mt19937 random(5);
  // With a gap of 1e-9 m most losses are far smaller than a coordinate's spacing of floats.
  const tests::TestMesh faces = tests::random_faces(5), near_pair = tests::parallel_triangles(1e-9F, random);
  for (const compare::Bounds bounds : both_bounds) {
    for (const auto& [mesh, size] : {std::pair(&faces, 0.3F), std::pair(&near_pair, 4e-9F)}) {
      INFO("bounds " << static_cast<int>(bounds) << ", moves up to " << size);
      fast::Guard guard = guard_of(*mesh, 0.5F, bounds);
      Positions centre = mesh->positions;  // X_prev
      std::int64_t cut = 0;
      tests::run_guard(guard, 5, 16, {.size = size, .foreign = true},
                       [&](const Positions& before, const Positions& wanted, const Positions& after,
                           const fast::GuardReport& report) {
                         if (report.detected) centre = before;
                         check_report(report, Expected(before, wanted, after), before.size());
                         if (bounds == compare::Bounds::ball) check_balls(report, centre, wanted, after);
                         cut += report.cut;
                       });
      CHECK(cut > 16);
    }
  }
}

TEST_CASE("guard: along a half-space a vertex slides, and the report tells the normal from the tangential part",
          "[unit]") {
  const float gap = 0x1p-4F;
  const tests::TestMesh mesh = small_above_large(gap);
  fast::Guard guard = guard_of(mesh, 1, compare::Bounds::planes);
  Positions after(6), moves = every(6, {});
  for (std::size_t v = 3; v < 6; ++v) moves[v] = {0.125F, -1, 0};
  const fast::GuardReport within = guard.step(mesh.positions, moves, after);
  CHECK(within.cut == 3);
  // All three go to the offset, 0.45 of the gap below, and keep their 0.125 m along it; their ball has 0.45 m.
  for (std::size_t v = 3; v < 6; ++v) {
    CHECK(after[v].x == mesh.positions[v].x + 0.125F);
    CHECK(after[v].y == Approx(0.55F * gap).epsilon(1e-5));
    CHECK(after[v].z == mesh.positions[v].z);
  }
  CHECK(within.most_restricted == 3);
  CHECK(within.lost_normal == Approx(within.lost));
  CHECK(within.lost_tangential == 0);
  // Beyond the ball the tangential part is lost, too.
  guard.detect();
  const Positions before = guard.positions();
  for (std::size_t v = 3; v < 6; ++v) moves[v] = {-2, -1, 0};
  const fast::GuardReport beyond = guard.step(before, moves, after);
  double normal = 0, tangential = 0;
  for (std::size_t v = 3; v < 6; ++v) {
    const compare::Vec3 lost = tests::gap_of(tests::sum_of(before[v], moves[v]), after[v]);
    normal += std::abs(lost.y);
    tangential += std::hypot(lost.x, lost.z);
  }
  CHECK(tangential > 3);
  CHECK(beyond.lost_normal * beyond.asked == Approx(normal));
  CHECK(beyond.lost_tangential * beyond.asked == Approx(tangential));
}

TEST_CASE("guard: of two half-spaces that a proposal violates the report takes the deeper one", "[unit]") {
  // A floor and a wall, each 1 m from vertex 6. The next nearest faces are the edges of both, 1.25 m from it.
  tests::TestMesh mesh;
  mesh.positions = {{0.25F, 0, -8}, {0.25F, 0, 8}, {16, 0, 0},        {0, 0.25F, -8},   {0, 0.25F, 8},
                    {0, 16, 0},     {1, 1, 0},     {1.01F, 1.01F, 0}, {1.01F, 1, 0.01F}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  for (const bool is_wall : {false, true}) {
    fast::Guard guard = guard_of(mesh, 1.2F, compare::Bounds::planes);
    Positions moves = every(9, {}), after(9);
    moves[6] = is_wall ? compare::Vec3f{-0.9F, -0.6F, 0} : compare::Vec3f{-0.6F, -0.9F, 0};
    const fast::GuardReport report = guard.step(mesh.positions, moves, after);
    CHECK(report.cut == 1);
    const compare::Vec3 lost = tests::gap_of(tests::sum_of(mesh.positions[6], moves[6]), after[6]);
    CHECK(report.lost_normal * report.asked == Approx(std::abs(is_wall ? lost.x : lost.y)));
    CHECK(report.lost_tangential * report.asked == Approx(std::abs(is_wall ? lost.y : lost.x)));
  }
}

TEST_CASE("guard: a proposal within the region comes back bit for bit, also after steps within the same region",
          "[property]") {
  for (const compare::Bounds bounds : both_bounds) {
    const tests::TestMesh mesh = tests::random_faces(8);
    fast::Guard guard = guard_of(mesh, 0.5F, bounds);
    std::mt19937 random(8);
    std::uniform_real_distribution<float> unit(-1, 1);
    // Each half-space and the ball are at least γ_p times the distance of the vertex's nearest pair from X_prev. With
    // balls b_v also covers the pairs of edges and triangles at v.
    const fast::ContactView view = guard.contacts();
    const std::size_t count = mesh.positions.size();
    std::vector<float> room(count);
    for (std::size_t v = 0; v < count; ++v)
      room[v] = bounds == compare::Bounds::ball ? view.bound[v] : 0.45F * view.d_min_vertex[v];
    Positions state = mesh.positions;
    for (int step = 0; step < 8; ++step) {
      Positions moves(count), wanted(count), after(count);
      for (std::size_t v = 0; v < count; ++v) {
        const float size = 0.55F * room[v];  // √3 · 0.55 < 1
        const compare::Vec3f x = mesh.positions[v],
                             target{x.x + size * unit(random), x.y + size * unit(random), x.z + size * unit(random)};
        moves[v] = {target.x - state[v].x, target.y - state[v].y, target.z - state[v].z};
        wanted[v] = tests::sum_of(state[v], moves[v]);
      }
      const fast::GuardReport report = guard.step(state, moves, after);
      CHECK(report.cut == 0);
      CHECK(report.lost == 0);
      CHECK(report.most_restricted == -1);
      CHECK(report.asked > 0);
      CHECK_FALSE(report.detected);
      CHECK((after == wanted));
      CHECK((guard.positions() == after));
      state = after;
    }
  }
}

TEST_CASE("guard: a step detects exactly if the steps since the last detection cut enough vertices", "[property]") {
  const tests::TestMesh mesh = tests::random_faces(6);
  const auto count = static_cast<double>(mesh.positions.size());
  for (const compare::Bounds bounds : both_bounds) {
    for (const double fraction : {0.0, 0.01, 0.3, 1.0}) {
      fast::Guard guard = guard_of(mesh, 0.5F, bounds, fraction);
      std::int64_t cut = 0;
      int detections = 0, without = 0;
      const auto follow = [&](const Positions&, const Positions&, const Positions&, const fast::GuardReport& report) {
        const bool is_due = static_cast<double>(cut) >= std::max(1.0, fraction * count);
        CHECK(report.detected == is_due);
        cut = report.detected ? report.cut : cut + report.cut;
        ++(report.detected ? detections : without);
      };
      tests::run_guard(guard, 6, 24, {.size = 0.05F}, follow);
      guard.detect();
      cut = 0;
      tests::run_guard(guard, 7, 1, {.size = 0.05F}, follow);
      CHECK(detections > 0);
      CHECK(without > 0);
    }
  }
}

TEST_CASE("guard: a vertex that its bound holds goes on after a detection", "[unit]") {
  const tests::TestMesh mesh = small_above_large(1);
  for (const compare::Bounds bounds : both_bounds) {
    fast::Guard eager = guard_of(mesh, 2, bounds, 0), lazy = guard_of(mesh, 2, bounds, 1);
    Positions moves = every(6, {}), first(6), second(6);
    for (std::size_t v = 3; v < 6; ++v) moves[v] = {0, -4, 0};
    eager.step(mesh.positions, moves, first);
    CHECK(first[3].y == Approx(0.55F).epsilon(1e-5));
    CHECK(eager.step(first, moves, second).detected);
    CHECK(second[3].y == Approx(0.55F * 0.55F).epsilon(1e-5));
    lazy.step(mesh.positions, moves, first);
    CHECK_FALSE(lazy.step(first, moves, second).detected);
    CHECK(second[3].y == Approx(0.55F).epsilon(1e-5));
    lazy.detect();
    CHECK_FALSE(lazy.step(second, moves, second).detected);
    CHECK(second[3].y == Approx(0.55F * 0.55F).epsilon(1e-5));
  }
}

TEST_CASE("guard: memory of the backend, the caller's own arrays as results, and a moved guard give the same bits",
          "[unit]") {
  for (const compare::Bounds bounds : both_bounds) {
    const tests::TestMesh mesh = tests::crumpled_layers(4);
    const std::size_t count = mesh.positions.size();
    const Positions moves = every(count, {0.25F, -0.5F, 0.125F});
    fast::Guard plain = guard_of(mesh, 0.5F, bounds), resident = guard_of(mesh, 0.5F, bounds),
                first = guard_of(mesh, 0.5F, bounds);
    fast::Guard moved = std::move(first);
    Positions x = mesh.positions, in_place = x, out(count);
    for (int step = 0; step < 4; ++step) {
      const fast::GuardReport report = plain.step(x, moves, out);
      CHECK(resident.step_resident(x.data(), moves.data(), x.data()).lost == report.lost);
      CHECK(moved.step(in_place, moves, in_place).cut == report.cut);
      CHECK((x == out));
      CHECK((in_place == out));
      CHECK((Positions(resident.positions_resident(), resident.positions_resident() + count) == out));
    }
    resident.reset_resident(mesh.positions.data());
    plain.reset(mesh.positions);
    CHECK((plain.positions() == mesh.positions));
    plain.step(mesh.positions, moves, out);
    resident.step_resident(mesh.positions.data(), moves.data(), x.data());
    CHECK((x == out));
  }
}

TEST_CASE("guard: in the backend's memory a proposal that is not finite leaves its vertex where it is", "[unit]") {
  for (const compare::Bounds bounds : both_bounds) {
    const tests::TestMesh mesh = small_above_large(1);
    fast::Guard guard = guard_of(mesh, 2, bounds);
    Positions moves = every(6, {0, 0.125F, 0}), out(6);
    guard.step(mesh.positions, moves, out);
    const Positions before = out;
    moves[3].x = std::numeric_limits<float>::quiet_NaN();
    moves[4].y = std::numeric_limits<float>::infinity();
    const fast::GuardReport report = guard.step_resident(before.data(), moves.data(), out.data());
    CHECK(report.not_finite == 2);
    CHECK(report.cut == 2);
    CHECK(report.lost == 0);
    CHECK(report.asked == Approx(4 * 0.125));
    CHECK(report.most_restricted == -1);
    CHECK(out[3] == before[3]);
    CHECK(out[4] == before[4]);
    CHECK(out[5].y == before[5].y + 0.125F);
  }
}

TEST_CASE("guard: finders and guards share a mesh; contacts are those of a finder; excluded pairs are not kept apart",
          "[unit]") {
  const tests::TestMesh mesh = small_above_large(0.25F);
  const std::vector<compare::Index> one_group(6, 0);
  const fast::Mesh apart = mesh.connectivity(), together(6, mesh.triangles, {}, one_group);
  const fast::GuardOptions options{.contact_radius = 0.5F, .query_radius = 1};
  fast::Guard guard(apart, mesh.positions, options), other(apart, mesh.positions, options),
      free(together, mesh.positions, options);
  fast::ContactFinder finder(apart);
  const fast::ContactSets sets = finder.find(mesh.positions, {.contact_radius = 0.5F, .query_radius = 1});
  const fast::ContactView view = guard.contacts();
  REQUIRE(sets.vertex_facet.size() == 3);
  CHECK(*view.vertex_facet_count == 3);
  CHECK(*view.edge_edge_count == static_cast<int>(sets.edge_edge.size()));
  CHECK((std::vector<float>(view.bound, view.bound + 6) == sets.bound));
  CHECK(*free.contacts().vertex_facet_count == 0);
  Positions moves = every(6, {}), out(6);
  for (std::size_t v = 3; v < 6; ++v) moves[v] = {0, -0.375F, 0};
  CHECK(guard.step(mesh.positions, moves, out).cut == 3);
  CHECK((other.positions() == mesh.positions));
  CHECK(free.step(mesh.positions, moves, out).cut == 0);
  CHECK(out[3].y == -0.125F);
}

TEST_CASE("guard: wrong input is refused by argument, vertex and value", "[unit]") {
  CHECK_THAT(refusal_of({.query_radius = 0}), ContainsSubstring("query_radius is 0,"));
  CHECK_THAT(refusal_of({.query_radius = 2 * fast::most_query_radius}), ContainsSubstring("to 1048576 m"));
  CHECK_THAT(refusal_of({.query_radius = fast::least_radius / 2}), ContainsSubstring("a length from 9.094947e-13 to"));
  CHECK_THAT(refusal_of({.contact_radius = fast::least_radius / 2, .query_radius = 1}),
             ContainsSubstring("0 or a length of at least 9.094947e-13 m"));
  CHECK_THAT(refusal_of({.contact_radius = 0.2F, .query_radius = 0.1F}),
             ContainsSubstring("query_radius is 0.1, but at least contact_radius, 0.2"));
  CHECK_THAT(refusal_of({.contact_radius = -1, .query_radius = 1}), ContainsSubstring("contact_radius is -1"));
  CHECK_THAT(refusal_of({.query_radius = 1, .bounds = compare::Bounds::off}), ContainsSubstring("'off'"));
  CHECK_THAT(refusal_of({.query_radius = 1, .bounds = compare::Bounds::dat}), ContainsSubstring("'dat'"));
  for (const float share : {0.0F, 0.5F, -1.0F, std::numeric_limits<float>::quiet_NaN()})
    CHECK_THAT(refusal_of({.query_radius = 1, .bounds_relaxation = share}), ContainsSubstring("bounds_relaxation is "));
  for (const double fraction : {-0.5, 1.5, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THAT(refusal_of({.query_radius = 1, .detection_fraction = fraction}),
               ContainsSubstring("detection_fraction is "));
  CHECK(refusal_of({.query_radius = 1}).empty());

  const tests::TestMesh mesh = small_above_large(1);
  fast::Guard guard = guard_of(mesh, 1, compare::Bounds::ball);
  const Positions moves = every(6, {0, 1, 0});
  Positions out(6), broken = moves, few(5);
  broken[4].y = std::numeric_limits<float>::quiet_NaN();
  const auto refused = [](auto action, const std::string& part) {
    CHECK_THROWS_WITH(action(), ContainsSubstring(part));
    CHECK_THROWS_AS(action(), compare::InputError);
  };
  refused([&] { guard.step(broken, moves, out); }, "positions: vertex 4 has (0, nan, 0)");
  refused([&] { guard.step(mesh.positions, broken, out); }, "moves: vertex 4 has (0, nan, 0)");
  refused([&] { guard.step(few, moves, out); }, "positions: 5 vectors for 6 vertices");
  refused([&] { guard.step(mesh.positions, few, out); }, "moves: 5 vectors for 6 vertices");
  refused([&] { guard.step(mesh.positions, moves, few); }, "out: room for 5 vectors");
  refused([&] { guard.reset(few); }, "positions: 5 vectors for 6 vertices");
  broken[4] = {0, std::numeric_limits<float>::max(), 0};
  refused([&] { guard.step(broken, broken, out); }, "moves: vertex 4 has ");
  CHECK((guard.positions() == mesh.positions));

  refused([&] { fast::Mesh(-1, {}); }, "number of vertices is -1");
  const compare::CompressedRows partners{{0, 1, 1, 1, 1, 1, 1}, {6}};
  refused(
      [&] {
        fast::Mesh(6, mesh.triangles, {}, {std::span<const compare::Index>{}, &partners});
      },
      "partners names vertex 6");
}

// Multiplication by a power of two is exact, so states must be the same multiples.
TEST_CASE("guard: at the limits of lengths, and far below, the steps are those of ordinary size", "[property]") {
  for (const compare::Bounds bounds : both_bounds) {
    const tests::TestMesh mesh = tests::crumpled_layers(3);
    const std::size_t count = mesh.positions.size();
    const auto run = [&](float factor, float query_radius) {
      fast::Guard guard(mesh.connectivity(), tests::scaled(mesh.positions, factor),
                        {.query_radius = query_radius, .bounds = bounds});
      std::mt19937 random(7);
      std::uniform_real_distribution<float> amount(-0.25F, 0.25F);
      Positions x = guard.positions();
      compare::Index cut = 0;
      for (int step = 0; step < 6; ++step) {
        Positions moves(count);
        for (compare::Vec3f& move : moves) move = {amount(random), amount(random), amount(random)};
        cut += guard.step(x, tests::scaled(moves, factor), x).cut;
      }
      CHECK(cut > 0);
      const fast::ContactView view = guard.contacts();
      std::vector<float> found(view.bound, view.bound + count);
      for (float& length : found) length /= factor;
      return std::pair(tests::scaled(x, 1 / factor), found);
    };
    INFO("bounds " << static_cast<int>(bounds));
    const auto expected = run(1, 1);
    CHECK((run(fast::least_radius, fast::least_radius) == expected));
    CHECK((run(fast::most_query_radius, fast::most_query_radius) == expected));
    // far below: no distance is beyond r_q in either run
    const auto vast = run(1, 64);
    for (const float factor : {0x1p-50F, 0x1p-72F, 0x1p-75F}) CHECK((run(factor, fast::least_radius) == vast));
  }
}

TEST_CASE("guard: a mesh without vertices, and without CUDA the backend says so", "[unit]") {
  fast::Guard nothing(fast::Mesh(0, {}), {}, {.query_radius = 1});
  CHECK(nothing.step({}, {}, {}).cut == 0);
  nothing.detect();
  if (fast::backend_info(fast::Backend::cuda).usable) return;
  CHECK_THROWS_AS(fast::Guard(fast::Mesh(0, {}), {}, {.query_radius = 1}, fast::Backend::cuda), compare::ResourceError);
}
