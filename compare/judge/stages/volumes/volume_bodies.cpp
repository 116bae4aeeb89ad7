#include "compare/judge/stages/volumes/volume_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "compare/judge/cases/legal.hpp"
#include "compare/judge/cases/placement.hpp"

namespace ogc::compare::volume_bodies {

using namespace placement;

Vec3 outer(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double inner(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double norm(const Vec3& a) { return std::sqrt(inner(a, a)); }
Vec3 unit(const Vec3& a) { return norm(a) > 0 ? scaled(a, 1 / norm(a)) : Vec3{0, 0, 1}; }

void VolumeBody::append(const VolumeBody& other, double scale, const Vec3& shift) {
  const auto base = static_cast<Index>(x.size());
  for (const Vec3& p : other.x) x.push_back(sum(scaled(p, scale), shift));
  for (const auto& [a, b, c] : other.triangles) triangles.push_back({a + base, b + base, c + base});
  for (const auto& [a, b, c, d] : other.tetrahedra) tetrahedra.push_back({a + base, b + base, c + base, d + base});
  for (const auto& [v, w] : other.cavities) cavities.push_back({v + base, w + base});
}

void VolumeBody::append_void(VolumeBody other, double scale, Index owner) {
  for (Triangle& t : other.triangles) std::swap(t[1], t[2]);
  const auto base = static_cast<Index>(x.size());
  append(other, scale, {});
  cavities.push_back({base, owner});
}

Vec3 VolumeBody::normal(Index t) const {
  const auto [a, b, c] = triangles[at(t)];
  return unit(outer(minus(x[at(b)], x[at(a)]), minus(x[at(c)], x[at(a)])));
}

std::vector<Index> VolumeBody::around(Index vertex) const {
  std::vector<Index> all;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (std::ranges::find(triangles[t], vertex) != triangles[t].end()) all.push_back(static_cast<Index>(t));
  return all;
}

Index VolumeBody::across(Index t, std::size_t k) const {
  const Index a = triangles[at(t)][k], b = triangles[at(t)][(k + 1) % 3];
  for (const Index other : around(a))
    if (other != t && std::ranges::find(triangles[at(other)], b) != triangles[at(other)].end()) return other;
  return t;
}

Place over_triangle(Random& random, const VolumeBody& body) {
  const Index t = random.below(static_cast<int>(body.triangles.size()));
  const auto [a, b, c] = body.triangles[at(t)];
  const double s = random.unit(), u = random.unit();
  const Vec3 foot = sum(sum(scaled(body.x[at(a)], 1 - s), scaled(body.x[at(b)], s * (1 - u))),
                        scaled(body.x[at(c)], s * u));
  return {foot, body.normal(t), norm(minus(body.x[at(b)], body.x[at(a)]))};
}

Place over_edge(Random& random, const VolumeBody& body) {
  const Index t = random.below(static_cast<int>(body.triangles.size()));
  const auto k = at(random.below(3));
  const Vec3 &a = body.x[at(body.triangles[at(t)][k])], &b = body.x[at(body.triangles[at(t)][(k + 1) % 3])];
  const double s = random.one_in(4) ? 0.5 : random.one_in(2) ? random.rung() : random.unit();
  const double share = random.one_in(2) ? random.rung() : random.unit();
  const Vec3 outward = sum(scaled(body.normal(t), 1 - share), scaled(body.normal(body.across(t, k)), share));
  return {sum(scaled(a, 1 - s), scaled(b, s)), unit(outward), norm(minus(b, a))};
}

Place over_vertex(Random& random, const VolumeBody& body) {
  const Index t = random.below(static_cast<int>(body.triangles.size()));
  const Index v = body.triangles[at(t)][at(random.below(3))];
  Vec3 outward = body.normal(t);
  const bool beside = random.one_in(2);
  for (const Index other : body.around(v))
    outward = sum(outward, scaled(body.normal(other), beside ? std::abs(random.rung()) : random.unit()));
  return {body.x[at(v)], unit(outward), norm(minus(body.x[at(v)], body.x[at(body.triangles[at(t)][0])])) + 0.1};
}

Place any_place(Random& random, const VolumeBody& body) {
  switch (random.below(3)) {
    case 0: return over_triangle(random, body);
    case 1: return over_edge(random, body);
    default: return over_vertex(random, body);
  }
}

VolumeDepthCase placed(Random& random, VolumeBody body, Points points, double radius, bool may_turn, double scale,
                       std::vector<Index> own) {
  std::vector<Vec3> all = body.x;
  all.insert(all.end(), points.begin(), points.end());
  const std::size_t frame = all.size();
  all.insert(all.end(), {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
  permute(random, all);
  if (may_turn && random.one_in(2)) rotate(random, all);
  const Vec3 x = minus(all[frame + 1], all[frame]), y = minus(all[frame + 2], all[frame]),
             z = minus(all[frame + 3], all[frame]);
  const bool mirrored = inner(outer(x, y), z) < 0;
  for (std::size_t i = body.triangles.size(); i > 1; --i)
    std::swap(body.triangles[i - 1], body.triangles[at(random.below(static_cast<int>(i)))]);
  for (Triangle& t : body.triangles) {
    if (mirrored) std::swap(t[1], t[2]);
    std::rotate(t.begin(), t.begin() + random.below(3), t.end());
  }
  for (Tetrahedron& t : body.tetrahedra)
    if (mirrored) std::swap(t[2], t[3]);
  VolumeDepthCase c;
  c.tetrahedra = std::move(body.tetrahedra);
  c.own = std::move(own);
  c.cavities = std::move(body.cavities);
  c.topology = std::make_shared<const Topology>(build_topology(static_cast<Index>(body.x.size()), body.triangles));
  for (std::size_t i = 0; i < frame; ++i)
    (i < body.x.size() ? c.positions : c.points).push_back(single(scaled(all[i], scale)));
  c.contact_radius = std::clamp(static_cast<float>(radius * scale), least_length, most_length);
  return c;
}

double some_scale(Random& random) {
  constexpr std::array<double, 8> scales{1, 1, 1, 1, 0x1p10, 0x1p-10, 0x1p14, 1000};
  return random.pick(std::span<const double>(scales));
}

double some_radius(Random& random) { return random.magnitude(-1.5, 0.2); }

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({norm(minus(b, a)), norm(minus(c, a)), norm(minus(c, b))});
  return norm(outer(minus(b, a), minus(c, a))) >= 0x1p-20 * longest * longest && longest > 0;
}

}  // namespace ogc::compare::volume_bodies
