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
  double size = 0;  // longest difference to slot 0
};

Placement random_placement(std::mt19937& random, ContactKind kind, double spread) {
  std::normal_distribution<double> normal;
  Placement p;
  const D3 far{normal(random), normal(random), normal(random)};
  for (int k = 0; k < 4; ++k) {
    const bool absent = sides[static_cast<int>(kind)][k] == 0;
    p.x[k] = absent ? p.x[0] : narrow(far + spread * D3{normal(random), normal(random), normal(random)});
    p.size = std::max(p.size, length(p.x[k] - p.x[0]));
  }
  return p;
}

// Computes the points of both sides in double from the weights.
void closest(ContactKind kind, const Placement& p, const ContactWeights& w, D3& first, D3& second) {
  first = second = {};
  for (int k = 0; k < 4; ++k) {
    const double weight = w.slot[k];
    const int side = sides[static_cast<int>(kind)][k];
    if (side == 1) first += weight * (wide(p.x[k]) - wide(p.x[0]));
    if (side == 2) second += -weight * (wide(p.x[k]) - wide(p.x[0]));
  }
}

}  // namespace

TEST_CASE("closest points of the closed faces satisfy the conditions of a minimum, for every kind", "[property]") {
  std::mt19937 random(31);
  for (const ContactKind kind : kinds) {
    for (int i = 0; i < 20000; ++i) {
      const Placement p = random_placement(random, kind, 0.01);
      if (kind == ContactKind::segment_segment &&
          length(cross(p.x[1] - p.x[0], p.x[3] - p.x[2])) < 0.05 * p.size * p.size)
        continue;
      const ContactWeights w = contact_weights(kind, p.x);
      D3 first, second;
      closest(kind, p, w, first, second);
      const D3 gap = first - second;
      double total[3] = {};
      for (int k = 0; k < 4; ++k) {
        const int side = sides[static_cast<int>(kind)][k];
        total[side] += w.slot[k];
        REQUIRE((side == 0 ? w.slot[k] == 0 : side == 1 ? w.slot[k] >= 0 : w.slot[k] <= 0));
        // A side is convex. So, measured along the gap, no vertex of a side is nearer to the other side than the side's
        // own closest point.
        const double nearer = dot(gap, (wide(p.x[k]) - wide(p.x[0])) - (side == 1 ? first : second)) *
                              (side == 1 ? -1 : 1);
        if (side != 0) REQUIRE(nearer <= 4e4 * u * p.size * p.size);
      }
      REQUIRE(std::abs(total[1] - 1) <= 4 * u);
      REQUIRE(std::abs(total[2] + 1) <= 4 * u);
    }
  }
}

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

TEST_CASE("normal and distance are those of the gap between the weighted points", "[property]") {
  std::mt19937 random(32);
  for (const ContactKind kind : kinds) {
    for (int i = 0; i < 5000; ++i) {
      const Placement p = random_placement(random, kind, 0.01);
      const ContactWeights w = contact_weights(kind, p.x);
      D3 first, second;
      closest(kind, p, w, first, second);
      const ContactShape shape = contact_shape(weighted_sum(w, p.x), 0.02f);
      // The weight of slot 0 is minus the sum of the other weights, which errs by 4 u (u = 2⁻²⁴). The gap errs by this
      // times the size.
      const double error = 16 * u * p.size;
      REQUIRE(std::abs(shape.distance - length(first - second)) <= error);
      REQUIRE(length(static_cast<double>(shape.distance) * wide(shape.normal) - (first - second)) <= 2 * error);
      REQUIRE(shape.acts == (shape.distance < 0.02f));
    }
  }
}

TEST_CASE("contact forces leave no net force and no net torque, and blocks are g'' w^2 n n^T", "[property]") {
  std::mt19937 random(33);
  for (const ContactKind kind : kinds) {
    for (int i = 0; i < 3000; ++i) {
      const Placement p = random_placement(random, kind, 0.01);
      const ContactWeights w = contact_weights(kind, p.x);
      const ContactShape shape = contact_shape(weighted_sum(w, p.x), 0.05f);
      if (!shape.acts) continue;
      D3 force, torque;
      double strength = 0;
      for (int k = 0; k < 4; ++k) {
        ForceAndBlock sum;
        strength = add_contact<OgcActivation, float>({}, shape, w.slot[k], w.slot[k] * w.slot[k], 0.05f, 100, sum);
        force += wide(sum.force);
        torque += cross(wide(p.x[k]) - wide(p.x[0]), wide(sum.force));
        const double curvature = OgcActivation::slope(shape.distance, 0.05f, 100).curvature *
                                 static_cast<double>(w.slot[k]) * w.slot[k];
        const D3 n = wide(shape.normal);
        REQUIRE(largest_difference(dense(sum.block),
                                   {curvature * n.x * n.x, curvature * n.x * n.y, curvature * n.x * n.z,
                                    curvature * n.x * n.y, curvature * n.y * n.y, curvature * n.y * n.z,
                                    curvature * n.x * n.z, curvature * n.y * n.z, curvature * n.z * n.z}) <=
                8 * u * curvature);
      }
      REQUIRE(strength > 0);
      REQUIRE(length(force) <= 16 * u * strength);
      // The two forces' arm is along n, except for the error of the weights' sum. The normal has the error of the gap.
      REQUIRE(length(torque) <= 64 * u * strength * p.size * std::max(1.0, p.size / shape.distance));
    }
  }
}

TEST_CASE("a force pushes the two sides apart by the slope of the activation", "[unit]") {
  const Vec x[4] = {{0.25f, 0.003f, 0.25f}, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
  const ContactWeights w = contact_weights(ContactKind::point_triangle, x);
  CHECK(w.slot[1] == Approx(-0.5));
  CHECK(w.slot[2] == Approx(-0.25));
  CHECK(w.slot[3] == Approx(-0.25));
  ForceAndBlock sum;
  // k_c (r − d)
  CHECK(add_contact<OgcActivation, float>({}, contact_shape(weighted_sum(w, x), 0.005f), 1, 1, 0.005f, 10, sum) ==
        Approx(10 * 0.002).epsilon(1e-5));
  CHECK(sum.force.y == Approx(0.02).epsilon(1e-5));
  CHECK(sum.block.yy == Approx(10));
}

TEST_CASE("from r on there is no force, and the curvature that waits at r", "[unit]") {
  const auto at = [](auto activation, float d) {
    ForceAndBlock sum;
    const float force = add_contact<decltype(activation), float>(activation, contact_shape(Vec{d, 0, 0}, 0.005f), 1, 1,
                                                                 0.005f, 10, sum);
    CHECK(force == 0);
    CHECK(sum.force.x == 0);
    return sum.block.xx;
  };
  for (const float d : {0.005f, std::nextafter(0.005f, 1.0f), 0.006f, 5.0f}) {
    CHECK(at(OgcActivation{}, d) == 10);
    CHECK(at(OgcAsPrinted{}, d) == 10);
    CHECK(at(QuadraticActivation{}, d) == 10);
    CHECK(at(CubicActivation{}, d) == 0);
    CHECK(at(IpcLogActivation{}, d) == 0);
    CHECK(at(AnyActivation{ContactActivation::ogc}, d) == 10);
  }
}

TEST_CASE("nothing is NaN at zero distance, for collapsed edges and triangles, and at the smallest distances",
          "[unit]") {
  std::mt19937 random(34);
  for (const ContactKind kind : kinds) {
    for (int equal = 0; equal < 64; ++equal) {
      Placement p = random_placement(random, kind, 0.01);
      for (int k = 1; k < 4; ++k) {
        if ((equal >> k & 1) != 0) p.x[k] = p.x[equal % k];
      }
      const ContactWeights w = contact_weights(kind, p.x);
      const ContactShape shape = contact_shape(weighted_sum(w, p.x), 0.05f);
      ForceAndBlock sum;
      if (shape.acts) add_contact<OgcActivation, float>({}, shape, w.slot[0], w.slot[0] * w.slot[0], 0.05f, 100, sum);
      REQUIRE(std::isfinite(length(sum.force)));
      REQUIRE(std::isfinite(sum.block.xx + sum.block.xy + sum.block.xz + sum.block.yy + sum.block.yz + sum.block.zz));
    }
  }
  CHECK_FALSE(contact_shape(Vec{0, 0, 0}, 1).acts);
  CHECK_FALSE(contact_shape(Vec{1e-30f, 0, 0}, 1).acts);
  for (const float d : {1e-18f, 1e-12f, 1e-7f}) {
    ForceAndBlock sum;
    CHECK(add_contact<OgcActivation, float>({}, contact_shape(Vec{d, 0, 0}, 0.005f), 1, 1, 0.005f, 100, sum) > 0);
    CHECK(std::isfinite(sum.block.xx));
  }
}

TEST_CASE("nearly parallel edges touch in the middle of their overlap", "[unit]") {
  const Vec x[4] = {{0, 0, 0}, {1, 0, 0}, {0.5f, 0.01f, 0}, {2.5f, 0.01f, 0}};
  const ContactWeights w = contact_weights(ContactKind::segment_segment, x);
  CHECK(w.slot[1] == Approx(0.75));
  CHECK(-w.slot[3] == Approx(0.125));
  const Vec apart[4] = {{0, 0, 0}, {1, 0, 0}, {1.5f, 0.01f, 0}, {2.5f, 0.01f, 0}};  // no overlap: the nearest ends
  const ContactWeights ends = contact_weights(ContactKind::segment_segment, apart);
  CHECK(ends.slot[1] == 1);
  CHECK(ends.slot[3] == 0);
}

TEST_CASE("the share of an overlap is that of the shorter edge, whichever way it points", "[unit]") {
  const auto share = [](float begin, float end) {
    return overlap_share({4, 0, 0}, {end - begin, 0, 0}, {begin, 0, 1}, {end, 0, 1});
  };
  CHECK(share(3, 5) == 0.5F);
  CHECK(share(5, 3) == 0.5F);
  CHECK(share(1, 2) == 1);
  CHECK(share(-2, 6) == 1);
  CHECK(share(-2, 3) == 0.75F);
}

TEST_CASE("the mollifier is 0 for parallel edges, 1 from its limit on, and C1 there", "[unit]") {
  CHECK(mollifier({1, 0, 0}, {2, 0, 0}, 1, 4) == 0);
  CHECK(mollifier({1, 0, 0}, {0, 2, 0}, 1, 4) == 1);
  const auto at = [](double sine) {
    return static_cast<double>(
        mollifier({1, 0, 0}, {static_cast<float>(std::sqrt(1 - sine * sine)), static_cast<float>(sine), 0}, 1, 1));
  };
  const double limit = std::sqrt(1e-3);
  CHECK(at(limit * std::sqrt(0.5)) == Approx(0.75));
  CHECK(at(0.999 * limit) == Approx(1).margin(1e-5));
}

TEST_CASE("a point far above a corner keeps its foot on the side where it is, though all distances agree", "[unit]") {
  const float d = 0.0127f;
  for (const float off : {1e-6f, 1e-5f, 1e-4f}) {
    // The foot is on the side from the third corner to the first, `off` from the third.
    const Vec x[4] = {{off, 0, d}, {0.01f, 0, 0}, {-0.005f, 0.01f, 0}, {0, 0, 0}};
    const ContactWeights w = contact_weights(ContactKind::point_triangle, x);
    CHECK(-w.slot[1] == Approx(off / 0.01).margin(2 * u));  // the complement of a parameter near 1
    CHECK(std::abs(w.slot[2]) <= 4 * u);
  }
}

TEST_CASE("almost collinear edges one behind the other meet at the end that is nearer, whichever it is", "[unit]") {
  // Along the first edge the second one begins after the first. Along the second, tilted edge, it begins before the
  // first ends.
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
