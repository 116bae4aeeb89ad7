#include "compare/judge/mutate.hpp"

#include <algorithm>
#include <cmath>

#include "compare/judge/legal.hpp"
#include "compare/judge/placement.hpp"
#include "compare/judge/rest_cases.hpp"

namespace ogc::compare {

namespace {

/// Within what is legal (compare/judge/legal.hpp).
float legal(double x) { return std::clamp(static_cast<float>(x), -most_coordinate, most_coordinate); }

Vec3f point(double x, double y, double z) { return {legal(x), legal(y), legal(z)}; }

double apart(const Vec3f& a, const Vec3f& b) {
  return std::max({std::abs(double{a.x} - b.x), std::abs(double{a.y} - b.y), std::abs(double{a.z} - b.z)});
}

class Mutation {
 public:
  Mutation(Random& random, std::span<Vec3f> points) : random_(random), points_(points) {}

  void one() {
    const Vec3f &a = any(), &b = any();
    Vec3f& moved = any();
    switch (random_.below(6)) {
      case 0: return shift(moved, a, apart(a, b));
      case 1:
        return shift(moved, point(0.5 * (double{a.x} + b.x), 0.5 * (double{a.y} + b.y), 0.5 * (double{a.z} + b.z)),
                     apart(a, b));
      case 2: moved = a; return;
      case 3: return shift(moved, moved, apart(a, b));
      case 4: return take_coordinate(moved, a);
      default: return coarsen(apart(a, b));
    }
  }

 private:
  Vec3f& any() { return points_[random_.bits() % points_.size()]; }

  void shift(Vec3f& moved, const Vec3f& to, double size) {
    moved = point(to.x + size * random_.rung(), to.y + size * random_.rung(), to.z + size * random_.rung());
  }

  void take_coordinate(Vec3f& moved, const Vec3f& from) {
    const int k = random_.below(3);
    (k == 0 ? moved.x : k == 1 ? moved.y : moved.z) = k == 0 ? from.x : k == 1 ? from.y : from.z;
  }

  /// To multiples of a power of two of 2⁻³ … 2⁻¹⁰ of the size.
  void coarsen(double size) {
    if (!(size > 0)) return;
    const double step = std::ldexp(1.0, std::ilogb(size) - 3 - random_.below(8));
    for (Vec3f& p : points_)
      p = point(step * std::nearbyint(p.x / step), step * std::nearbyint(p.y / step),
                step * std::nearbyint(p.z / step));
  }

  Random& random_;
  std::span<Vec3f> points_;
};

/// The points that may move, out of a case and back into it.
class Points {
 public:
  Random& random;
  explicit Points(Random& source) : random(source) {}
  void operator()(ClosestFaceCase& c) const {
    std::array<Vec3f, 4> points{c.point, c.triangle[0], c.triangle[1], c.triangle[2]};
    mutate_points(random, points);
    c.point = points[0];
    std::copy(points.begin() + 1, points.end(), c.triangle.begin());
  }
  void operator()(ClosestPointsCase& c) const {
    std::array<Vec3f, 4> points{c.first[0], c.first[1], c.second[0], c.second[1]};
    mutate_points(random, points);
    c.first = {points[0], points[1]};
    c.second = {points[2], points[3]};
  }
  void operator()(MeshCase& c) const { mutate_points(random, c.positions); }
  void operator()(BlockCase& c) const {
    // Edges that become parallel would make their questions illegal.
    std::erase_if(c.questions, [](const BlockQuestion& q) {
      return q.kind == BlockQuestion::Kind::edge_in_edges && q.face.kind == FaceKind::edge;
    });
    mutate_points(random, c.positions);
  }
  void operator()(TruncateCase& c) const {
    std::array<Vec3f, 2> points{c.previous, c.position};
    mutate_points(random, points);
    c.previous = points[0];
    c.position = points[1];
  }
  void operator()(InitialGuessCase& c) const {
    std::array<Vec3f, 2> points{c.previous, c.start};
    mutate_points(random, points);
    c.previous = points[0];
    c.start = points[1];
  }
  void operator()(ContactForceCase& c) const {
    mutate_points(random, std::span(c.vertex).first(static_cast<std::size_t>(vertex_count(c.sides))));
  }
  void operator()(FrictionForceCase& c) const { (*this)(c.contact); }
  void operator()(MembraneCase& c) const { both(c.corner, c.start); }
  void operator()(BendingCase& c) const { both(c.vertex, c.start); }
  void operator()(SpringCase& c) const { both(c.vertex, c.start); }
  void operator()(ActivationCase& c) const {
    const std::array<float, 3> distances{c.distance, c.contact_radius, c.contact_radius / 2};
    c.distance = std::max(0x1p-20f, placement::beside(random, random.pick(std::span<const float>(distances))));
  }
  void operator()(BoundCase& c) const {
    for (std::vector<float>* distances : {&c.d_min_vertex, &c.d_min_edge, &c.d_min_triangle}) {
      if (distances->empty()) continue;
      const auto any = [&]() -> float& { return (*distances)[random.bits() % distances->size()]; };
      for (int count = 1 + random.below(4); count > 0; --count)
        any() = random.one_in(8) ? 0 : std::abs(placement::beside(random, any()));
    }
  }
  void operator()(SweepCase& c) const {
    mutate_points(random, c.target);
    mutate_points(random, c.start);
  }
  void operator()(StepCase& c) const {
    auto scene = std::make_shared<Scene>(*c.scene);
    scene->velocities = mutated(c.scene->velocities);
    c.scene = std::move(scene);
  }
  void operator()(RestStateCase& c) const {
    RestStateCase other = c;
    for (int attempt = 0; attempt < 8; ++attempt) {
      auto scene = std::make_shared<Scene>(*c.scene);
      scene->rest_positions = mutated(c.scene->rest_positions);
      other.scene = std::move(scene);
      if (!problems_of(other).empty()) continue;
      c = std::move(other);
      return;
    }
  }

 private:
  template <std::size_t N>
  void both(std::array<Vec3f, N>& now, std::array<Vec3f, N>& start) const {
    std::array<Vec3f, 2 * N> points;
    std::copy(start.begin(), start.end(), std::copy(now.begin(), now.end(), points.begin()));
    mutate_points(random, points);
    std::copy_n(points.begin(), N, now.begin());
    std::copy_n(points.begin() + N, N, start.begin());
  }
  std::vector<Vec3> mutated(const std::vector<Vec3>& vectors) const {
    std::vector<Vec3f> points = to_single(vectors);
    mutate_points(random, points);
    return to_double(points);
  }
};

}  // namespace

void mutate(Random& random, CaseData& data) {
  std::visit([&](auto& c) { Points{random}(c); }, data);
}

void mutate_points(Random& random, std::span<Vec3f> points) {
  if (points.empty()) return;
  Mutation mutation(random, points);
  for (int count = 1 + random.below(4); count > 0; --count) mutation.one();
}

}  // namespace ogc::compare
