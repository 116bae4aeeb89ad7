// Tests verdicts of volume_depth on contacts written by hand.
#include "compare/judge/stages/verdict.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

/// Returns the first mismatch of an answer with one contact, outside at vertex 0. The reference says that its point is
/// outside and has no contact. Vertex 0 has three triangles; each has two of the neighbours, 1 to 6.
std::string verdict_at(const std::array<Vec3f, 6>& neighbours, float depth = 0.5f, float height = 0.5f) {
  VolumeDepthCase asked;
  std::vector<Triangle> triangles;
  asked.positions = {{0, 0, 0}};
  for (Index k = 1; k < 6; k += 2) triangles.push_back({0, k, k + 1});
  asked.positions.insert(asked.positions.end(), neighbours.begin(), neighbours.end());
  asked.topology = std::make_shared<Topology>(build_topology(7, triangles));
  asked.contact_radius = 1;
  asked.points = {{0, 0, height}};
  VolumeDepthTruth truth;
  truth.parts.resize(1);
  truth.parts[0].resize(1);
  truth.parts[0][0].component = 0;
  truth.parts[0][0].may_be_outside = true;
  truth.grey = truth.near = {0};
  VolumeContact contact;
  contact.point = 0, contact.triangle = 0, contact.face = {FaceKind::vertex, 0};
  contact.weights = {1, 0, 0}, contact.direction = {0, 0, 1}, contact.depth = depth;
  Tally tally(Stage::volume_depth);
  judge_volume_depth({{Stage::volume_depth, "soup", 0, 0, "", {}}, asked}, truth, {{contact}, {}}, tally);
  return tally.mismatches.empty() ? "" : tally.mismatches[0].message;
}

}  // namespace

TEST_CASE("A contact at a vertex is accepted where its triangles pass through one another, and only there") {
  const std::array<Vec3f, 6> apart{{{1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {0, -1, 1}, {0, -1, 2}}};
  REQUIRE(verdict_at(apart) == "point 0: outside at vertex 0, triangle 0 is no contact");
  // The second arc runs from one side of the first to the other.
  const std::array<Vec3f, 6> crossing{{{1, 0, 0}, {1, 1, 0}, {2, 1, 1}, {2, 1, -1}, {0, -1, 1}, {0, -1, 2}}};
  REQUIRE(verdict_at(crossing).empty());
  REQUIRE_THAT(verdict_at(crossing, 0.25f), ContainsSubstring("depth 0.25, exact 0.5"));
  REQUIRE_THAT(verdict_at(crossing, 0, 1.5f), ContainsSubstring("is not nearer than r"));
  // The second arc crosses the plane of the first beside it, or on the other side of the vertex.
  const std::array<Vec3f, 6> beside{{{1, 0, 0}, {1, 1, 0}, {-1, 2, 1}, {-1, 2, -1}, {0, -1, 1}, {0, -1, 2}}};
  REQUIRE_FALSE(verdict_at(beside).empty());
  const std::array<Vec3f, 6> opposite{{{1, 0, 0}, {1, 1, 0}, {-2, -1, 1}, {-2, -1, -1}, {0, -1, 1}, {0, -1, 2}}};
  REQUIRE_FALSE(verdict_at(opposite).empty());
}
