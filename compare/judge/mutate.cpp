#include "compare/judge/mutate.hpp"

#include <algorithm>
#include <cmath>

namespace ogc::compare {

namespace {

/// Coordinates between 0 and 2⁻²⁰ m are no legal input (method.md §2).
float legal(double x) { return std::abs(x) < 0x1p-20 ? 0.0f : static_cast<float>(x); }

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
      case 1: return shift(moved, point(0.5 * (double{a.x} + b.x), 0.5 * (double{a.y} + b.y), 0.5 * (double{a.z} + b.z)), apart(a, b));
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
    for (Vec3f& p : points_) p = point(step * std::nearbyint(p.x / step), step * std::nearbyint(p.y / step), step * std::nearbyint(p.z / step));
  }

  Random& random_;
  std::span<Vec3f> points_;
};

/// The points that may move, out of a case and back into it.
struct Points {
  Random& random;
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
    std::erase_if(c.questions, [](const BlockQuestion& q) { return q.kind == BlockQuestion::Kind::edge_in_edges && q.face.kind == FaceKind::edge; });
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
  void operator()(ContactForceCase& c) const { mutate_points(random, std::span(c.vertex).first(static_cast<std::size_t>(vertex_count(c.sides)))); }
  void operator()(FrictionForceCase& c) const { (*this)(c.contact); }
  template <class Other>
  void operator()(Other&) const {}
};

}  // namespace

bool can_mutate(Stage stage) {
  switch (stage) {
    case Stage::closest_face:
    case Stage::closest_points:
    case Stage::block:
    case Stage::detect_vertex_facet:
    case Stage::detect_edge_edge:
    case Stage::initial_guess:
    case Stage::contact_force:
    case Stage::friction_force:
    case Stage::truncate: return true;
    default: return false;
  }
}

void mutate(Random& random, CaseData& data) {
  std::visit([&](auto& c) { Points{random}(c); }, data);
}

void mutate_points(Random& random, std::span<Vec3f> points) {
  if (points.empty()) return;
  Mutation mutation(random, points);
  for (int count = 1 + random.below(4); count > 0; --count) mutation.one();
}

}  // namespace ogc::compare
