// Tests clear balls (fast/kernels/volume_depth.hpp). A vertex in a clear ball is not tested against a driven volume
// again. So every point in a clear ball must be far from the part, whatever the shape of the part.
#include <cmath>
#include <random>
#include <vector>

#include "fast/cpu/backend.hpp"
#include "fast/stages/surface.hpp"
#include "fast/stages/volumes.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::fast;

namespace {

constexpr double turn = 6.283185307179586;

struct Shape {
  std::vector<compare::Vec3f> x;
  std::vector<compare::Triangle> triangles;
};

/// Returns a closed surface about the origin, about 2 m wide, made of rings and two poles. Vertices are displaced by up
/// to `rough`.
Shape ball(std::mt19937& random, int rings, int columns, float rough) {
  Shape shape;
  std::uniform_real_distribution<float> off(-rough, rough);
  const auto add = [&](double x, double y, double z) {
    const float dx = off(random), dy = off(random);
    shape.x.push_back({static_cast<float>(x) + dx, static_cast<float>(y) + dy, static_cast<float>(z) + off(random)});
  };
  add(0, 0, 1);
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < columns; ++j) {
      const double a = turn * i / (2 * rings), b = turn * j / columns;
      add(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    }
  add(0, 0, -1);
  const auto number = [&](int i, int j) { return 1 + (i - 1) * columns + j % columns; };
  const auto last = static_cast<compare::Index>(shape.x.size()) - 1;
  for (int j = 0; j < columns; ++j) {
    shape.triangles.push_back({0, number(1, j), number(1, j + 1)});
    shape.triangles.push_back({last, number(rings - 1, j + 1), number(rings - 1, j)});
    for (int i = 1; i + 1 < rings; ++i) {
      shape.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      shape.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  return shape;
}

/// A part of a volume on the CPU against which points are tested.
class Asked {
 public:
  Asked(const Shape& shape, float radius)
      : topology_(compare::build_topology(static_cast<compare::Index>(shape.x.size()), shape.triangles)),
        surface_(topology_, {}),
        parts_(volume_parts(topology_, {}, {}, shape.x)),
        trees_(parts_, solid_tables(topology_, {})),
        radius_(radius) {
    for (const compare::Vec3f& x : shape.x) {
      x_.push_back({x.x, x.y, x.z});
      padded_.push_back(PaddedVec(x_.back()));
    }
    trees_.refit(backend_, surface_.view(), x_.data());
  }

  VolumeSide side(const Vec& x, ClearBall* clear = nullptr) const {
    const VolumeView view{surface_.view(), {padded_.data()}, trees_.parts(), trees_.count(), radius_};
    return VolumeQuestion(view, x).nearest_of(0, parts_[0].facets.front(), clear).side;
  }

 private:
  CpuBackend backend_;
  compare::Topology topology_;
  Surface<CpuBackend> surface_;
  VolumeParts parts_;
  VolumeTrees<CpuBackend> trees_;
  float radius_;
  std::vector<Vec> x_;
  std::vector<PaddedVec> padded_;
};

struct Counts {
  int far = 0, balls = 0, inside = 0;
};

/// Tests points in the box of `shape`. If a point has a clear ball, checks that all points in the ball are far from the
/// part.
Counts check(std::mt19937& random, const Shape& shape, float radius) {
  const Asked part(shape, radius);
  std::uniform_real_distribution<float> anywhere(-1.2f, 1.2f), share(0.5f, 1);
  std::normal_distribution<float> normal;
  Counts counts;
  for (int i = 0; i < 400; ++i) {
    const float px = anywhere(random), py = anywhere(random);
    const Vec p{px, py, anywhere(random)};
    ClearBall clear;
    const VolumeSide side = part.side(p, &clear);
    counts.inside += side == VolumeSide::inside;
    counts.far += side == VolumeSide::far;
    if (side != VolumeSide::far) CHECK(clear.radius < 0);
    if (clear.radius < 0) continue;
    ++counts.balls;
    CHECK(clear.holds(p));
    for (int k = 0; k < 40; ++k) {
      const float nx = normal(random), ny = normal(random);
      const Vec to{nx, ny, normal(random)};
      const float size = clear.radius * share(random) / std::sqrt(to.x * to.x + to.y * to.y + to.z * to.z);
      const Vec x = p + size * to;
      if (!clear.holds(x)) continue;
      INFO(p.x << " " << p.y << " " << p.z << " to " << x.x << " " << x.y << " " << x.z);
      REQUIRE(part.side(x) == VolumeSide::far);
    }
  }
  return counts;
}

}  // namespace

TEST_CASE("whoever is in the clear ball of a point that is far is far, too", "[property]") {
  std::mt19937 random(41);
  Counts all;
  for (const float rough : {0.0f, 0.05f, 0.2f, 0.6f}) {
    for (const int rings : {3, 6, 12}) {
      Shape shape = ball(random, rings, 2 * rings, rough);
      const Counts closed = check(random, shape, 0.02f);
      // Without three triangles the surface has rims. Only the nearest face decides whether a point near a rim is
      // inside.
      shape.triangles.erase(shape.triangles.begin() + 1, shape.triangles.begin() + 4);
      const Counts open = check(random, shape, 0.02f);
      if (rough == 0.0f) {
        CHECK(closed.balls > closed.far / 6);
        CHECK(closed.inside > 50);
      }
      for (const Counts& c : {closed, open}) all.far += c.far, all.balls += c.balls, all.inside += c.inside;
    }
  }
  CHECK(all.balls > all.far / 8);
}

TEST_CASE("nobody near a part or inside of it has a clear ball, and it ends before r", "[unit]") {
  std::mt19937 random(42);
  const Asked part(ball(random, 12, 24, 0), 0.125f);
  ClearBall clear;
  CHECK(part.side({0, 0, 0.5f}, &clear) == VolumeSide::inside);
  CHECK(clear.radius < 0);
  CHECK(part.side({0.75f, 0.75f, 0}, &clear) == VolumeSide::near);
  CHECK(clear.radius < 0);
  CHECK(part.side({0.9f, 0.9f, 0}, &clear) == VolumeSide::far);
  const double distance = std::hypot(0.9, 0.9) - 1;
  CHECK(clear.radius > 0);
  CHECK(clear.radius <= clear_share * (distance + 0.02 - 0.125));
  CHECK_FALSE(clear.holds({0.75f, 0.75f, 0}));
}
