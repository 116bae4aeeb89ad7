#include "fast/kernels/contact_force.hpp"

#include <algorithm>

#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"

using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

constexpr double u = 0x1p-24;
constexpr ContactKind kinds[] = {ContactKind::point_point, ContactKind::point_segment, ContactKind::segment_segment,
                                 ContactKind::point_triangle};

// by kind and slot: first side (1), second side (2), or neither (0)
constexpr int sides[4][4] = {{1, 0, 2, 0}, {1, 0, 2, 2}, {1, 1, 2, 2}, {1, 2, 2, 2}};

struct Placement {
  Vec x[4];
};

Placement random_placement(std::mt19937& random, ContactKind kind, double spread) {
  std::normal_distribution<double> normal;
  Placement p;
  const D3 far{normal(random), normal(random), normal(random)};
  for (int k = 0; k < 4; ++k) {
    const bool absent = sides[static_cast<int>(kind)][k] == 0;
    p.x[k] = absent ? p.x[0] : narrow(far + spread * D3{normal(random), normal(random), normal(random)});
  }
  return p;
}

}  // namespace

TEST_CASE(
    "where it is known what pair a contact is of its weights are the same, and a slot's weight is found by its number",
    "[property]") {
  std::mt19937 random(32);
  const auto same = [](const ContactWeights& a, const ContactWeights& b) {
    bool equal = true;
    for (int k = 0; k < 4; ++k) equal = equal && a.slot[k] == b.slot[k] && a.of(k) == a.slot[k];
    return equal;
  };
  for (const ContactKind kind : kinds) {
    for (int i = 0; i < 1000; ++i) {
      const Placement p = random_placement(random, kind, 0.01);
      const ContactWeights any = contact_weights(kind, p.x);
      if (kind != ContactKind::segment_segment) REQUIRE(same(contact_weights<PairKind::vertex_facet>(kind, p.x), any));
      if (kind != ContactKind::point_triangle) REQUIRE(same(contact_weights<PairKind::edge_edge>(kind, p.x), any));
    }
  }
}

TEST_CASE("a point far above a corner keeps its foot on the side where it is, though all distances agree", "[unit]") {
  const float d = 0.0127f;
  for (const float off : {1e-6f, 1e-5f, 1e-4f}) {
    // The point projects onto the edge from the third corner to the first, at the distance `off` from the third corner.
    const Vec x[4] = {{off, 0, d}, {0.01f, 0, 0}, {-0.005f, 0.01f, 0}, {0, 0, 0}};
    const ContactWeights w = contact_weights(ContactKind::point_triangle, x);
    CHECK(-w.slot[1] == Approx(off / 0.01).margin(2 * u));  // the complement of a parameter near 1
    CHECK(std::abs(w.slot[2]) <= 4 * u);
  }
}

TEST_CASE("almost collinear edges one behind the other meet at the end that is nearer, whichever it is", "[unit]") {
  // Projected on the first edge, the second edge begins beyond the first edge's end. In `tilted` the second edge slopes
  // towards the first one, so the first edge's end projects into the second edge's interior.
  const Vec x[4] = {{0, 0, 0}, {1, 0, 0}, {1.00002f, 0, 0.1f}, {2, 0, 0.1004f}};
  const ContactWeights forward = contact_weights(ContactKind::segment_segment, x);
  CHECK(forward.slot[1] == 1);
  const double t = std::clamp(((1 - 1.00002) * 0.99998 + (0 - 0.1) * 0.0004) / (0.99998 * 0.99998), 0.0, 1.0);
  CHECK(-forward.slot[3] == Approx(t).margin(1e-7));
  const Vec tilted[4] = {{0, 0, 0}, {1, 0, 0}, {1.00002f, 0, 0.1f}, {2, 0, 0.0996f}};
  const ContactWeights inside = contact_weights(ContactKind::segment_segment, tilted);
  CHECK(inside.slot[1] == 1);
  CHECK(-inside.slot[3] == Approx((-2e-5 * 0.99998 + 0.1 * 0.0004) / (0.99998 * 0.99998)).epsilon(0.01));
}
