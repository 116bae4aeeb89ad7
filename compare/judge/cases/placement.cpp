#include "compare/judge/cases/placement.hpp"

#include <array>

namespace ogc::compare::placement {

namespace {

/// Returns p rotated about the unit axis a (Rodrigues' formula).
Vec3 turned(const Vec3& p, const Vec3& a, double cosine, double sine) {
  const double along = (a.x * p.x + a.y * p.y + a.z * p.z) * (1 - cosine);
  return {p.x * cosine + (a.y * p.z - a.z * p.y) * sine + a.x * along,
          p.y * cosine + (a.z * p.x - a.x * p.z) * sine + a.y * along,
          p.z * cosine + (a.x * p.y - a.y * p.x) * sine + a.z * along};
}

}  // namespace

float beside(Random& random, float x) {
  switch (random.below(4)) {
    case 0: return x;
    case 1: return std::nextafter(x, 0.0f);
    case 2: return up(x);
    default: return static_cast<float>(x * (1 + random.rung()));
  }
}

Vec3 in_box(Random& random, double low, double high) {
  const double x = random.between(low, high), y = random.between(low, high), z = random.between(low, high);
  return {x, y, z};
}

Vec3 on_lattice(Random& random, int extent) {
  const int parts = 1 << random.below(3);
  const auto coordinate = [&] { return static_cast<double>(random.below(2 * extent * parts + 1)) / parts - extent; };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z};
}

std::array<Vec3, 4> points_in_box(Random& random) {
  std::array<Vec3, 4> points;
  for (Vec3& p : points) p = in_box(random, 0, 1);
  return points;
}

std::array<Vec3, 4> points_of_bits(Random& random) {
  std::array<Vec3, 4> points;
  for (Vec3& p : points)
    p = {random.sign() * random.pattern(), random.sign() * random.pattern(), random.sign() * random.pattern()};
  return points;
}

std::array<Vec3, 4> points_on_lattice(Random& random, int extent) {
  constexpr std::array<double, 6> scales{1, 1, 0x1p10, 0x1p-10, 0x1p18, 0x1p-18};
  const double scale = random.pick(std::span<const double>(scales));
  std::array<Vec3, 4> points;
  for (Vec3& p : points) p = scaled(on_lattice(random, extent), scale);
  return points;
}

void permute(Random& random, std::span<Vec3> points) {
  const int order = random.below(6);
  const double sx = random.sign(), sy = random.sign(), sz = random.sign();
  for (Vec3& p : points) {
    std::array<double, 3> c{p.x, p.y, p.z};
    if (order >= 3) std::swap(c[0], c[1]);
    const int first = order % 3;
    p = {sx * c[first], sy * c[(first + 1) % 3], sz * c[(first + 2) % 3]};
  }
}

void rotate(Random& random, std::span<Vec3> points) {
  const double angle = random.between(0, 6.283185307179586), height = random.between(-1, 1),
               turn = random.between(0, 6.283185307179586);
  const double ring = std::sqrt(1 - height * height);
  const Vec3 axis{ring * std::cos(turn), ring * std::sin(turn), height}, shift = in_box(random, -1, 1);
  const double cosine = std::cos(angle), sine = std::sin(angle);
  for (Vec3& p : points) p = sum(turned(p, axis, cosine, sine), shift);
}

void place(Random& random, std::span<Vec3> points) {
  constexpr std::array<double, 8> scales{1, 1, 1, 1, 1, 0x1p10, 0x1p-10, 1000};
  permute(random, points);
  if (random.is_fine() || random.one_in(2)) rotate(random, points);
  const double scale = random.pick(std::span<const double>(scales));
  for (Vec3& p : points) p = scaled(p, scale);
}

}  // namespace ogc::compare::placement
