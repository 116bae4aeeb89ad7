// Drives guards with random proposals, and asks the exact oracle about each state and each way. The tests of both
// backends share it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "compare/oracle/audit.hpp"
#include "compare/oracle/meetings.hpp"
#include "fast/guard.hpp"
#include "tests/fast/meshes.hpp"

namespace ogc::tests {

using Positions = std::vector<compare::Vec3f>;

inline std::vector<compare::Vec3> widened(const Positions& positions) {
  std::vector<compare::Vec3> wide;
  for (const compare::Vec3f& x : positions) wide.push_back({x.x, x.y, x.z});
  return wide;
}

inline std::size_t intersections(const TestMesh& mesh) {
  return compare::audit(mesh.topology(), widened(mesh.positions)).count;
}

inline compare::Vec3f sum_of(const compare::Vec3f& a, const compare::Vec3f& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline compare::Vec3 gap_of(const compare::Vec3f& a, const compare::Vec3f& b) {
  return {static_cast<double>(a.x) - b.x, static_cast<double>(a.y) - b.y, static_cast<double>(a.z) - b.z};
}

inline double length_of(const compare::Vec3& a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

/// Returns random triangles of very different sizes and loose edges that do not meet. A third of them is crowded around
/// one point, so that some vertices have more pairs than planes.
inline TestMesh random_faces(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  TestMesh mesh;
  for (int face = 0; face < 45; ++face) {
    const bool is_crowded = face % 3 == 0;
    const float spread = is_crowded ? 0.05F : 1, size = is_crowded ? 0.03F : 0.4F * std::abs(unit(random));
    const compare::Vec3f centre{spread * unit(random), spread * unit(random), spread * unit(random)};
    const auto corner = [&] { return sum_of(centre, {size * unit(random), size * unit(random), size * unit(random)}); };
    TestMesh next;
    next.positions = {corner(), corner()};
    if (face % 5 == 1) {
      next.loose_edges = {{0, 1}};
    } else {
      next.positions.push_back(corner());
      next.triangles = {{0, 1, 2}};
    }
    TestMesh both = mesh;
    both.add(next);
    if (intersections(both) == 0) mesh = both;
  }
  return mesh;
}

/// Returns three crumpled layers that do not meet.
inline TestMesh crumpled_layers(std::uint32_t seed) {
  TestMesh mesh;
  for (int k = 0; k < 3; ++k)
    mesh.add(jittered(sheet(7, 1.0F, 0.4F * static_cast<float>(k)), 0.15F, seed + static_cast<std::uint32_t>(k)));
  return mesh;
}

/// Returns two triangles of a width of 1 m in parallel planes across y, `gap` [m] apart.
inline TestMesh parallel_triangles(float gap, std::mt19937& random) {
  std::uniform_real_distribution<float> turn(0, 6.2831853F), slip(-0.3F, 0.3F);
  TestMesh mesh;
  for (const float y : {0.0F, gap}) {
    const float angle = turn(random), x = slip(random), z = slip(random);
    TestMesh one;
    for (int k = 0; k < 3; ++k) {
      const float at = angle + 2.0943951F * static_cast<float>(k);
      one.positions.push_back({x + 0.577F * std::cos(at), y, z + 0.577F * std::sin(at)});
    }
    one.triangles = {{0, 1, 2}};
    mesh.add(one);
  }
  return mesh;
}

/// How random proposals are made.
struct Proposals {
  float size = 1;        ///< largest move along an axis [m]
  float pull = 0;        ///< moves lead to the centre of all vertices by this share of the way [1]
  bool foreign = false;  ///< every third step passes positions that are not the guard's state
};

/// What a run of a guard showed.
struct GuardRun {
  std::size_t intersections = 0, meetings = 0;  ///< in all states and on all ways
  std::int64_t cut = 0, detections = 0;         ///< sums over the reports
  double moved = 0;                             ///< Σ of the ways of all vertices [m]
};

/// Adds random moves to the guard's state `steps` times and asks the oracle about what the guard makes of them.
/// `observe` sees each step: the state before, proposals, the state after, and the report.
template <class Observe>
GuardRun run_guard(fast::Guard& guard, std::uint32_t seed, int steps, const Proposals& proposals, Observe observe) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  GuardRun run;
  Positions before = guard.positions();
  const std::size_t count = before.size();
  for (int step = 0; step < steps; ++step) {
    Positions from = before, moves(count), after(count), wanted(count);
    if (proposals.foreign && step % 3 == 1)
      for (compare::Vec3f& x : from) x = {-x.y, x.z + unit(random), 2 * x.x};
    // from moves that no region cuts to moves that all regions cut
    const float size = proposals.size * std::ldexp(1.0F, -3 * (step % 4));
    for (std::size_t v = 0; v < count; ++v) {
      moves[v] = {size * unit(random) - proposals.pull * from[v].x, size * unit(random) - proposals.pull * from[v].y,
                  size * unit(random) - proposals.pull * from[v].z};
      wanted[v] = sum_of(from[v], moves[v]);
    }
    const fast::GuardReport report = guard.step(from, moves, after);
    run.intersections += compare::audit(guard.mesh().topology(), widened(after), guard.mesh().exclusions()).count;
    run.meetings +=
        compare::meetings(guard.mesh().topology(), widened(before), widened(after), guard.mesh().exclusions()).count;
    run.cut += report.cut;
    run.detections += report.detected ? 1 : 0;
    for (std::size_t v = 0; v < count; ++v) run.moved += length_of(gap_of(after[v], before[v]));
    observe(before, wanted, after, report);
    before = after;
  }
  return run;
}

inline GuardRun run_guard(fast::Guard& guard, std::uint32_t seed, int steps, const Proposals& proposals) {
  return run_guard(guard, seed, steps, proposals,
                   [](const Positions&, const Positions&, const Positions&, const fast::GuardReport&) {});
}

}  // namespace ogc::tests
