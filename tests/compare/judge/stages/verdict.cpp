// Tests verdicts on answers written by hand, with and without grey decisions.
#include "compare/judge/stages/verdict.hpp"

#include <cmath>
#include <limits>

#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

std::string first_message(const Tally& tally) { return tally.mismatches.empty() ? "" : tally.mismatches[0].message; }

/// A point at distance 1 above the corner (0, 0, 0) of a right triangle. It lies on the two planes that separate the
/// Voronoi region of this corner from those of its edges. The exact answer is the corner.
struct FaceFixture {
  std::vector<TestCase> cases{{{Stage::closest_face, "uniform", 0, 0, "", {}}, ClosestFaceCase{}}};
  ClosestFaceIn in{{{0, 0, 1}}, {{Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0}}}};
  ClosestFaceTruth truth{{{TriangleFeature::corner_0}, {{1, 0, 0}}, {1}, {1}}, {0b0001001}, {0}, {1}, {{1, 0, 0}}, {1}};
  ClosestFaceOut out = truth.exact;
  Tally tally() const {
    Tally tally(Stage::closest_face);
    judge_closest_face(cases, in, truth, out, tally);
    return tally;
  }
  std::string verdict() const { return first_message(tally()); }
};

/// Holds four vertices over a triangle; each test sets the contacts.
struct SetFixture {
  MeshCase mesh;
  DetectVertexFacetTruth truth;
  DetectVertexFacetOut out;
  VertexFacetContact face{3, {FaceKind::triangle, 0}, 0}, edge{3, {FaceKind::edge, 0}, 0},
      corner{3, {FaceKind::vertex, 0}, 0};

  SetFixture() {
    const std::vector<Triangle> triangles{{0, 1, 2}};
    mesh.topology = std::make_shared<Topology>(build_topology(4, triangles));
    mesh.rigid_groups.assign(4, -1);
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25f, 0.25f, 0.5f}};
    mesh.contact_radius = mesh.query_radius = 1;
    truth.exact.contacts = {face};
    truth.exact.d_min_vertex = {1, 1, 1, 0.5f};
    truth.exact.d_min_triangle = {0.5f};
    truth.pairs = 1;
    out = truth.exact;
  }
  Tally tally() const {
    Tally tally(Stage::detect_vertex_facet);
    judge_detect_vertex_facet({{Stage::detect_vertex_facet, "few", 0, 0, "", {}}, mesh}, truth, out, tally);
    return tally;
  }
  std::string verdict() const { return first_message(tally()); }
};

TruncateOut moved(const Vec3f& position, bool cut) { return {{position}, {static_cast<std::uint8_t>(cut)}}; }

std::string truncate_verdict(const TruncateIn& in, const TruncateTruth& truth, const TruncateOut& out) {
  const std::vector<TestCase> cases{{{Stage::truncate, "uniform", 0, 0, "", {}}, TruncateCase{}}};
  Tally tally(Stage::truncate);
  judge_truncate(cases, in, truth, out, tally);
  return first_message(tally);
}

}  // namespace

TEST_CASE("closest_face: features are accepted on both sides of a grey boundary and nowhere else", "[unit]") {
  FaceFixture test;
  REQUIRE(test.verdict().empty());
  test.out.feature[0] = TriangleFeature::edge_01;
  REQUIRE(test.verdict().empty());
  test.out.feature[0] = TriangleFeature::edge_20;
  REQUIRE(test.verdict() == "feature: edge (2,0) of the triangle, exact vertex 0 of the triangle");
}

TEST_CASE("closest_face: distances, bounds and weights", "[unit]") {
  FaceFixture test;
  // The error scale is 2⁻²⁴ Σ|δ|, where δ are the differences of the point and the corners: Σ|δ| = 1 + 2 + 2 = 5. The
  // tolerance is 12 times the error scale, 3.6e-6.
  test.out.distance[0] = 1 + 3.5e-6f;
  REQUIRE(test.verdict().empty());
  test.out.distance[0] = 1 + 3.8e-6f;
  REQUIRE(test.verdict().starts_with("distance:"));
  test.out.distance[0] = no_number;
  REQUIRE(test.verdict().starts_with("distance:"));
  test = {};
  test.out.distance_below[0] = std::nextafter(1.0f, 2.0f);
  REQUIRE(test.verdict().find("above the exact distance") != std::string::npos);
  test.out.distance_below[0] = no_number;
  REQUIRE_FALSE(test.verdict().empty());
  test.out.distance_below[0] = 0.9999f;
  REQUIRE(test.verdict().starts_with("distance_below"));
  test = {};
  test.out.weights[0] = {1, -1e-9f, 1e-9f};
  REQUIRE(test.verdict().find("negative") != std::string::npos);
  test.out.weights[0] = {0.99999f, 1e-5f, 0};
  REQUIRE(test.verdict().starts_with("weights"));
}

TEST_CASE("an answer of the wrong length is a mismatch", "[unit]") {
  FaceFixture test;
  test.out.weights.clear();
  REQUIRE_FALSE(test.verdict().empty());
  SetFixture set;
  set.out.d_min_triangle.clear();
  REQUIRE(set.verdict().starts_with("d_min_triangle"));
}

TEST_CASE("sets must be equal outside the grey zone", "[unit]") {
  SetFixture test;
  REQUIRE(test.verdict().empty());
  test.out.contacts = {};
  REQUIRE(test.verdict().find("is missing") != std::string::npos);
  test.out.contacts = {test.face, test.edge};
  REQUIRE(test.verdict().find("is no contact") != std::string::npos);
  test.out.contacts = {test.face, test.face};
  REQUIRE(test.verdict().find("twice") != std::string::npos);
}

TEST_CASE("a grey decision accepts either side, but neither nothing nor both", "[unit]") {
  SetFixture test;
  test.truth.grey = {{{test.face, test.edge}, false}};
  test.out.contacts = {test.edge};
  REQUIRE(test.verdict().empty());
  test.out.contacts = {};
  REQUIRE(test.verdict().find("covering") != std::string::npos);
  test.out.contacts = {test.corner};
  REQUIRE_FALSE(test.verdict().empty());
  test.out.contacts = {test.edge, test.face};
  REQUIRE(test.verdict().find("side by side") != std::string::npos);
  test.truth.grey = {{{test.face, test.edge}, true}};
  test.out.contacts = {};
  REQUIRE(test.verdict().empty());
}

TEST_CASE("grey decisions that are answered otherwise than exactly are counted, wrong answers are not", "[unit]") {
  FaceFixture face;
  CHECK(face.tally().total().not_exact == 0);
  face.out.feature[0] = TriangleFeature::edge_01;
  CHECK(face.tally().total().not_exact == 1);
  face.out.feature[0] = TriangleFeature::edge_20;
  CHECK(face.tally().total().not_exact == 0);
  SetFixture set;
  set.truth.grey = {{{set.face, set.edge}, true}};
  CHECK(set.tally().total().not_exact == 0);
  set.out.contacts = {};
  CHECK(set.tally().total().not_exact == 1);
  set.out.contacts = {set.edge};  // one contact is missing, another is added
  CHECK(set.tally().total().not_exact == 2);
}

TEST_CASE("of forces next to a jump those of the other side are counted, unless they fit the exact side as well",
          "[unit]") {
  const std::vector<TestCase> cases{{{Stage::contact_force, "ladder.radius", 0, 0, "", {}}, ContactForceCase{}}};
  const auto answer = [](double force) { return ForceAnswer{{force, 0, 0}, {force, 0, 0, 0, 0, 0}, 1, 1}; };
  const auto tally_of = [&](double exact, double other, float given) {
    Tally tally(Stage::contact_force);
    judge_force(cases, {{{answer(exact), answer(other)}}, {1}}, {{{given, 0, 0}}, {{given, 0, 0, 0, 0, 0}}}, tally);
    return tally;
  };
  CHECK(tally_of(1, 0, 1).total().not_exact == 0);
  CHECK(tally_of(1, 0, 0).total().not_exact == 1);
  CHECK(tally_of(1, 1 + 0x1p-24, 1 + 0x1p-23F).total().not_exact == 0);  // a jump of one rounding
  const Tally wrong = tally_of(1, 0, 0.1F);
  CHECK(wrong.total().not_exact == 0);
  CHECK(wrong.mismatched > 0);
}

TEST_CASE("contacts are compared in canonical order", "[unit]") {
  SetFixture test;
  test.truth.exact.contacts = {test.corner, test.face};
  test.out.contacts = {test.face, test.corner};
  REQUIRE(test.verdict().empty());
}

TEST_CASE("a smallest distance may be too small by rounding, never too large", "[unit]") {
  SetFixture test;
  test.out.d_min_vertex[3] = std::nextafter(0.5f, 1.0f);
  REQUIRE(test.verdict().starts_with("vertex 3"));
  test.out.d_min_vertex[3] = 0.5f - 4e-6f;
  REQUIRE(test.verdict().empty());
  test.out.d_min_vertex[3] = 0.49f;
  REQUIRE(test.verdict().starts_with("d_min_vertex"));
  test.out.d_min_vertex[3] = -0.0001f;
  REQUIRE_FALSE(test.verdict().empty());
  test.out.d_min_vertex[3] = no_number;
  REQUIRE_FALSE(test.verdict().empty());
}

TEST_CASE("truncate: the stored position must obey its bound exactly", "[unit]") {
  // The motion is (3, 4, 0) from (1, 0, 0) with bound 2.5, so truncation halves it.
  const TruncateIn in{{{1, 0, 0}}, {{4, 4, 0}}, {2.5f}};
  const TruncateTruth truth{{1}, {0}, {0}, {{2.5, 2, 0}}};
  REQUIRE(truncate_verdict(in, truth, moved({2.5f, 2, 0}, true)).empty());
  REQUIRE(truncate_verdict(in, truth, moved({2.5f, 2, 0}, false)).starts_with("cut"));
  REQUIRE(truncate_verdict(in, truth, moved({2.5f, std::nextafter(2.0f, 3.0f), 0}, true)).starts_with("position"));
  REQUIRE(truncate_verdict(in, truth, moved({2.5f, std::nextafter(2.0f, 0.0f), 0}, true)).empty());
  REQUIRE(truncate_verdict(in, truth, moved({2, 1.5f, 0}, true)).starts_with("position"));
  REQUIRE(truncate_verdict(in, truth, moved({no_number, 2, 0}, true)).starts_with("position"));
}

TEST_CASE("truncate: what does not exceed its bound comes back bit for bit", "[unit]") {
  const TruncateIn in{{{1, 0, 0}}, {{4, 4, 0}}, {5}};
  const TruncateTruth truth{{0}, {1}, {1}, {{4, 4, 0}}};
  REQUIRE(truncate_verdict(in, truth, moved({4, 4, 0}, false)).empty());
  REQUIRE(truncate_verdict(in, truth, moved({4, std::nextafter(4.0f, 0.0f), 0}, false)).starts_with("position"));
  // ‖x − x_prev‖ = b is grey: the answer may call it cut, and then the last bit may differ.
  REQUIRE(truncate_verdict(in, truth, moved({4, std::nextafter(4.0f, 0.0f), 0}, true)).empty());
}
