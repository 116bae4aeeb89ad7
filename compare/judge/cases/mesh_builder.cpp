#include "compare/judge/cases/mesh_builder.hpp"

#include <algorithm>
#include <array>

namespace ogc::compare {

using namespace placement;

Index MeshBuilder::add(const Vec3& point) {
  points.push_back(point);
  return static_cast<Index>(points.size() - 1);
}

void MeshBuilder::grid(int nx, int ny, const Vec3& origin, const Vec3& u, const Vec3& v) {
  const Index base = static_cast<Index>(points.size());
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) add(sum(origin, sum(scaled(u, i), scaled(v, j))));
  const auto at = [&](int i, int j) { return base + i + j * (nx + 1); };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
}

void MeshBuilder::fan(int count, const Vec3& centre, bool closed, double rise) {
  const Index hub = add(centre);
  const int rim = closed ? count : count + 1;
  const double turn = closed ? 6.283185307179586 / count : 3.0 / count;
  for (int k = 0; k < rim; ++k) add(sum(centre, {std::cos(k * turn), std::sin(k * turn), -rise}));
  for (int k = 0; k < count; ++k) triangles.push_back({hub, hub + 1 + k, hub + 1 + (k + 1) % rim});
}

void MeshBuilder::strand(int count, const Vec3& start, const Vec3& step) {
  const Index first = add(start);
  for (int k = 0; k < count; ++k) {
    add(sum(start, scaled(step, k + 1)));
    loose_edges.push_back({first + k, first + k + 1});
  }
}

void MeshBuilder::append(const MeshBuilder& part, const Vec3& shift) {
  const Index base = static_cast<Index>(points.size());
  for (const Vec3& p : part.points) add(sum(p, shift));
  for (const Triangle& t : part.triangles) triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  for (const Edge& e : part.loose_edges) loose_edges.push_back({e[0] + base, e[1] + base});
}

void MeshBuilder::group(Index first, Index number) {
  groups.resize(points.size(), -1);
  std::fill(groups.begin() + first, groups.end(), number);
}

namespace {

/// Renumbers vertices and triangles at random; contacts must stay the same.
void relabel(Random& random, MeshBuilder& builder) {
  const std::size_t count = builder.points.size();
  std::vector<Index> to(count);
  for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<Index>(i);
  for (std::size_t i = count; i > 1; --i)
    std::swap(to[i - 1], to[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  std::vector<Vec3> points(count);
  std::vector<Index> groups(count);
  for (std::size_t i = 0; i < count; ++i) {
    points[to[i]] = builder.points[i];
    groups[to[i]] = builder.groups[i];
  }
  for (Triangle& t : builder.triangles) {
    const int first = random.below(3);
    t = {to[t[first]], to[t[(first + 1) % 3]], to[t[(first + 2) % 3]]};
  }
  for (std::size_t i = builder.triangles.size(); i > 1; --i)
    std::swap(builder.triangles[i - 1], builder.triangles[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  for (Edge& e : builder.loose_edges) e = {std::min(to[e[0]], to[e[1]]), std::max(to[e[0]], to[e[1]])};
  for (auto& [a, b] : builder.excluded) a = to[a], b = to[b];
  builder.points = std::move(points);
  builder.groups = std::move(groups);
}

/// Returns a scale for which coordinates stay within 2²⁰ and edges above 2⁻²⁰.
double scale_of(Random& random) {
  constexpr std::array<double, 10> scales{1, 1, 1, 1, 1, 0x1p10, 0x1p-10, 0x1p14, 0x1p-18, 1000};
  return random.pick(std::span<const double>(scales));
}

}  // namespace

MeshCase finish(Random& random, MeshBuilder builder, const MeshPlan& plan) {
  builder.groups.resize(builder.points.size(), -1);
  relabel(random, builder);
  if (plan.jitter > 0)
    for (Vec3& p : builder.points) p = sum(p, in_box(random, -plan.jitter, plan.jitter));
  permute(random, builder.points);
  if (plan.jitter > 0 && (random.is_fine() || random.one_in(2))) rotate(random, builder.points);
  const double scale = scale_of(random);
  const double radius = plan.contact_radius > 0 ? plan.contact_radius : random.magnitude(-2, 0.4);
  MeshCase mesh;
  mesh.topology = std::make_shared<Topology>(
      build_topology(static_cast<Index>(builder.points.size()), builder.triangles, builder.loose_edges));
  mesh.rigid_groups = std::move(builder.groups);
  mesh.partners = partner_rows(builder.points.size(), builder.excluded);
  for (const Vec3& p : builder.points) mesh.positions.push_back(single(scaled(p, scale)));
  mesh.contact_radius = static_cast<float>(radius * scale);
  mesh.query_radius = std::max(mesh.contact_radius,
                               static_cast<float>(radius * scale * (random.one_in(4) ? 1 : random.between(1, 4))));
  return mesh;
}

Mesh triangle_strip(int count) {
  Mesh mesh;
  for (int i = 0; i < count + 2; ++i) mesh.positions.push_back({0.5 * i, static_cast<double>(i % 2), 0});
  for (Index i = 0; i < count; ++i)
    mesh.triangles.push_back(i % 2 == 0 ? Triangle{i, i + 2, i + 1} : Triangle{i, i + 1, i + 2});
  return mesh;
}

}  // namespace ogc::compare
