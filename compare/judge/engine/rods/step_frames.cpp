#include "compare/judge/engine/rods/step_frames.hpp"

#include <cmath>

#include "compare/judge/cases/rods/quaternions.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/problem/rods.hpp"

namespace ogc::compare {

namespace {

std::string segment(std::size_t e) { return "segment " + std::to_string(e); }

/// Return a − b in single precision, as every contestant computes it.
Vec3f difference(const Vec3f& a, const Vec3f& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3f rounded_difference(const Vec3& a, const Vec3& b) {
  return {static_cast<float>(a.x - b.x), static_cast<float>(a.y - b.y), static_cast<float>(a.z - b.z)};
}

/// Largest error in units of 2⁻²⁴: 8 units for a quaternion product and 4 for its normalisation.
constexpr double product_tolerance = 12;

bool is_product(const Quaternion& q, const Quaternion& turn, const Quaternion& before) {
  using namespace rod_cases;
  const Four exact = unit(product(wide(turn), wide(before)));
  double off = 0;
  for (std::size_t k = 0; k < 4; ++k) off += (q[k] - exact[k]) * (q[k] - exact[k]);
  return std::sqrt(off) <= product_tolerance * unit_roundoff;
}

}  // namespace

std::string wrong_segment_colour(const Scene& scene, const StepOut& out) {
  const std::vector<Index> held = segment_groups(scene, rod_segments(scene));
  if (out.segment_colour.size() != held.size()) return "segment_colour has not one entry for each segment";
  for (std::size_t e = 0; e < held.size(); ++e) {
    const Index own = out.segment_colour[e];
    if ((held[e] < 0) != (own >= 0)) return "colour: " + segment(e) + " has " + std::to_string(own);
    for (const Index f : out.rest.segments[e].neighbour)
      if (f >= 0 && own >= 0 && out.segment_colour[at(f)] == own)
        return "colour: " + segment(e) + " shares that of its neighbour " + std::to_string(f);
  }
  return {};
}

std::string wrong_orientation_count(const Scene& scene, const StepOut& out) {
  const std::size_t wanted = rod_segments(scene).size();
  const auto is_wrong = [&](const std::vector<Quaternion>& all) { return all.size() != wanted; };
  if (is_wrong(out.orientation_start) || is_wrong(out.turned) || is_wrong(out.orientation))
    return "orientations: there is not one for each segment at the start, after the guess, at the end";
  for (const StepEvent& event : out.events)
    if (event.kind == StepEventKind::sweep && is_wrong(event.orientation))
      return "orientations: a sweep has not one for each segment";
  return {};
}

TurnedFrames start_frames(const StepIn& in, const StepOut& out, std::string& wrong) {
  const Scene& scene = *in.scene;
  TurnedFrames asked;
  for (std::size_t e = 0; e < out.orientation_start.size(); ++e) {
    const Edge& ends = out.rest.segments[e].end;
    const auto a = at(ends[0]), b = at(ends[1]);
    const Vec3f rest = rounded_difference(scene.rest_positions[b], scene.rest_positions[a]),
                now = rounded_difference(scene.mesh.positions[b], scene.mesh.positions[a]);
    const bool is_given = !scene.orientations.empty() || rest == now;
    const Quaternion& given = scene.orientations.empty() ? out.rest.segments[e].orientation : scene.orientations[e];
    if (is_given && out.orientation_start[e] != given)
      wrong = segment(e) + " does not start with the frame that it has";
    if (is_given) continue;
    asked.in.turns.push_back({rest, now, given});
    asked.out.orientation.push_back(out.orientation_start[e]);
  }
  return asked;
}

TurnedFrames turned_frames(const StepIn& in, const StepOut& out, const std::vector<Vec3f>& x, std::string& wrong) {
  const Scene& scene = *in.scene;
  const std::vector<Vec3f> start = to_single(scene.mesh.positions);
  const std::vector<Index> held = segment_groups(scene, rod_segments(scene));
  TurnedFrames asked;
  for (std::size_t e = 0; e < held.size(); ++e) {
    const Quaternion &before = out.orientation_start[e], &now = out.turned[e];
    const bool is_kept = held[e] == 0 || (held[e] < 0 && !turns(scene.settings.rod_start));
    if (is_kept && now != before) wrong = segment(e) + " has turned before the first sweep";
    if (is_kept) continue;
    if (held[e] > 0 && says_turn(scene.motions[at(held[e]) - 1])) {
      const Quaternion turn = prescribed_turn(scene.motions[at(held[e]) - 1], 0, scene.settings.time_step);
      if (!is_product(now, turn, before)) wrong = segment(e) + " has not turned as its motion has";
      continue;
    }
    const Edge& ends = out.rest.segments[e].end;
    const auto a = at(ends[0]), b = at(ends[1]);
    asked.in.turns.push_back({difference(start[b], start[a]), difference(x[b], x[a]), before});
    asked.out.orientation.push_back(now);
  }
  return asked;
}

}  // namespace ogc::compare
