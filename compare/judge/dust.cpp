#include "compare/judge/dust.hpp"

#include <cmath>
#include <span>
#include <vector>

#include "compare/judge/legal.hpp"

namespace ogc::compare {

namespace {

/// The coordinates that become small, of all points that a case has.
class Coordinates {
 public:
  void points(std::span<Vec3f> all) {
    for (Vec3f& p : all)
      for (float* x : {&p.x, &p.y, &p.z}) all_.push_back(x);
  }
  std::span<float* const> all() const { return all_; }

  void operator()(ClosestFaceCase& c) {
    points({&c.point, 1});
    points(c.triangle);
  }
  void operator()(ClosestPointsCase& c) {
    points(c.first);
    points(c.second);
  }
  void operator()(MeshCase& c) { points(c.positions); }
  void operator()(BlockCase& c) { points(c.positions); }
  void operator()(TruncateCase& c) {
    points({&c.previous, 1});
    points({&c.position, 1});
    all_.push_back(&c.bound);
  }
  void operator()(InitialGuessCase& c) {
    for (Vec3f* p : {&c.start, &c.velocity, &c.acceleration, &c.previous}) points({p, 1});
    all_.push_back(&c.bound);
  }
  void operator()(ContactForceCase& c) {
    points(std::span(c.vertex).first(static_cast<std::size_t>(vertex_count(c.sides))));
  }
  void operator()(FrictionForceCase& c) {
    (*this)(c.contact);
    points(std::span(c.start).first(static_cast<std::size_t>(vertex_count(c.contact.sides))));
  }
  void operator()(MembraneCase& c) {
    points(c.corner);
    points(c.start);
  }
  void operator()(BendingCase& c) {
    points(c.vertex);
    points(c.start);
  }
  void operator()(SpringCase& c) {
    points(c.vertex);
    points(c.start);
  }
  void operator()(SweepCase& c) {
    for (auto* positions : {&c.old, &c.start, &c.target, &c.previous}) points(*positions);
  }
  template <class Other>
  void operator()(Other&) {}

 private:
  std::vector<float*> all_;
};

}  // namespace

void add_dust(Random& random, CaseData& data) {
  const CaseData before = data;
  Coordinates coordinates;
  std::visit([&](auto& c) { coordinates(c); }, data);
  const int share = 8 << random.below(3);
  const float smallest = std::ldexp(1.0f, -30 - random.below(31));
  for (float* x : coordinates.all())
    if (random.one_in(share)) *x = std::copysign(random.one_in(4) ? 0.0f : random.pattern(smallest, 0x1p-20f), *x);
  if (!problem_of(data).empty()) data = before;
}

}  // namespace ogc::compare
