// The contact radii of the meshes are so large that blocks of neighbouring faces overlap. With smaller radii most test
// points would lie in one block or in none.
#include "tests/reference/mesh_zoo.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ogc::tests {
namespace {

constexpr double pi = std::numbers::pi;

Vec3f at(double x, double y, double z) { return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}; }

Surface scaled(const Surface& surface, double factor) {
  return mapped(surface, [&](Vec3f x) { return at(factor * x.x, factor * x.y, factor * x.z); });
}

/// Returns k triangles around the origin. Neighbour i lies at the angle 2πi/k on the unit circle, and heights
/// alternate.
Surface star_of(int k, double height_even, double height_odd) {
  Surface surface{{{0, 0, 0}}, {}, {}, {}};
  for (int i = 0; i < k; ++i) {
    const double angle = 2 * pi * i / k;
    surface.positions.push_back(at(std::cos(angle), std::sin(angle), i % 2 == 0 ? height_even : height_odd));
    surface.triangles.push_back({0, 1 + i, 1 + (i + 1) % k});
  }
  return surface;
}

/// Returns thin triangles side by side, with height `thickness` over a base of 1.
Surface needles(int count, double thickness) {
  Surface surface{{{0, 0, 0}}, {}, {}, {}};
  for (int i = 0; i <= count; ++i) surface.positions.push_back(at(1, thickness * i, 0.25 * thickness * (i % 2)));
  for (int i = 0; i < count; ++i) surface.triangles.push_back({0, 1 + i, 2 + i});
  return surface;
}

/// Returns a sphere of rings with vertices at both poles.
Surface ball(int rings, int sides) {
  Surface surface;
  surface.positions.push_back(at(0, 0, 1));
  for (int j = 1; j < rings; ++j) {
    for (int i = 0; i < sides; ++i) {
      const double theta = pi * j / rings, phi = 2 * pi * i / sides;
      surface.positions.push_back(
          at(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
    }
  }
  surface.positions.push_back(at(0, 0, -1));
  const auto vertex = [&](int j, int i) {
    return j == 0 ? 0 : j == rings ? 1 + (rings - 1) * sides : 1 + (j - 1) * sides + i % sides;
  };
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < sides; ++i) {
      if (j > 0) surface.triangles.push_back({vertex(j, i), vertex(j + 1, i), vertex(j, i + 1)});
      if (j + 1 < rings) surface.triangles.push_back({vertex(j, i + 1), vertex(j + 1, i), vertex(j + 1, i + 1)});
    }
  }
  return surface;
}

/// Returns a wavy sheet with all kinds of vertices.
Surface waves(int n, double amplitude) {
  return mapped(grid(n), [&](Vec3f x) { return at(x.x, x.y, amplitude * std::sin(2.1 * x.x) * std::cos(1.7 * x.y)); });
}

/// Adds a yarn that leaves the sheet, and an isolated vertex.
Surface with_yarn(Surface surface) {
  const auto free = static_cast<Index>(surface.positions.size());
  surface.positions.insert(surface.positions.end(), {{0.5f, 0.25f, 1}, {1.5f, 0.5f, 1.25f}, {-1, -1, 0.5f}});
  surface.loose_edges = {{0, free}, {free, free + 1}};
  return surface;
}

/// Returns points near a mesh: its vertices and the middles of its edges and triangles, each moved along the axes,
/// along the diagonal and at random by fractions of r.
std::vector<Vec3f> points_near(const Surface& surface, float r, std::size_t count, std::mt19937& random) {
  std::vector<Vec3f> centres = surface.positions;
  for (const auto& t : surface.triangles) {
    const auto corner = [&](std::size_t k) { return surface.positions[static_cast<std::size_t>(t[k])]; };
    const Vec3f a = corner(0), b = corner(1), c = corner(2);
    centres.push_back({a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2, a.z + (b.z - a.z) / 2});
    centres.push_back({a.x / 4 + b.x / 4 + c.x / 2, a.y / 4 + b.y / 4 + c.y / 2, a.z / 4 + b.z / 4 + c.z / 2});
  }
  std::shuffle(centres.begin(), centres.end(), random);
  std::uniform_real_distribution<float> move(-1.2f * r, 1.2f * r);
  std::vector<Vec3f> points;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3f& c = centres[k % centres.size()];
    const float step = (k % 2 == 0 ? 1.0f : -1.0f) * r / static_cast<float>(1u << (k % 3));
    const Vec3f moves[] = {{0, 0, 0},
                           {0, 0, step},
                           {step, 0, 0},
                           {0, step, 0},
                           {move(random), move(random), move(random)},
                           {0, step / 2, step / 2}};
    const Vec3f& m = moves[(k / centres.size() + k) % 6];
    points.push_back({c.x + m.x, c.y + m.y, c.z + m.z});
  }
  return points;
}

class Zoo {
 public:
  void add(const std::string& name, Surface surface, double radius, bool collapsed = false) {
    Specimen specimen{name, std::move(surface), static_cast<float>(radius), collapsed, {}};
    specimen.points = points_near(specimen.surface, specimen.radius, 48, random_);
    all_.push_back(std::move(specimen));
  }

  /// Adds the mesh and its copies: rotated exactly, scaled by powers of ten and by powers of two down to denormal
  /// coordinates, and moved far away.
  void add_family(const std::string& name, const Surface& surface, double radius) {
    add(name, surface, radius);
    add(name + ", turned", mapped(surface, turned), turned_scale * radius);
    for (const double factor : {1e-6, 1e-3, 1e3, 1e6, 0x1p-20, 0x1p20, 0x1p-130, 0x1p120}) {
      add(name + " times " + std::to_string(std::log10(factor)), scaled(surface, factor), factor * radius);
    }
    add(name + ", moved by 2^10", mapped(surface, [](Vec3f x) { return at(x.x + 1024.0, x.y - 1024.0, x.z + 512.0); }),
        radius);
  }

  void add_shapes();
  void add_random();
  void add_stars();
  void add_coincidences();
  std::vector<Specimen> take() { return std::move(all_); }

 private:
  std::mt19937 random_{2025};
  std::vector<Specimen> all_;
};

void Zoo::add_shapes() {
  add_family("grid", grid(3), 0.75);
  add_family("tetrahedron", tetrahedron(), 1.5);
  add_family("octahedron", octahedron(), 1);
  add_family("cube", cube(), 1);
  add_family("saddle", saddle(), 1);
  add_family("open book", book(3, 0.75), 1);
  add_family("Moebius band", moebius(7), 0.5);
  add_family("waves", waves(5, 0.8), 0.6);
  add_family("two sheets",
             together(grid(3), mapped(grid(3),
                                      [](Vec3f x) {
                                        return Vec3f{x.x + 0.25f, x.y + 0.5f, 0.5f};
                                      })),
             0.75);
  add_family("needles", needles(4, 0x1p-8), 0.125);
  add_family("sheet with yarn", with_yarn(grid(3)), 1);
  add("one triangle", {{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}, {}, {}}, 1);
  for (const int pages : {1, 2, 3, 4, 5, 8}) add("book of " + std::to_string(pages), book(pages, 1), 0.5);
  for (const int n : {3, 4, 6, 8}) add("ball of " + std::to_string(n), ball(n, n + 1), 0.4);
  for (const double thickness : {1e-3, 1e-4, 1e-5, 1e-6})
    add("needles of " + std::to_string(thickness), needles(3, thickness), 0.1);
}

void Zoo::add_random() {
  for (int k = 0; k < 16; ++k)
    add("jittered sheet " + std::to_string(k), jittered(grid(4), random_, 0.1f + 0.05f * static_cast<float>(k)), 0.5);
  for (int k = 0; k < 16; ++k) add("folded sheet " + std::to_string(k), folded(5, 0.4f, random_, 0.3f), 0.7);
  for (int k = 0; k < 16; ++k) add("soup " + std::to_string(k), soup(10 + k, 14, random_), 0.25);
}

void Zoo::add_stars() {
  for (const int k : {3, 4, 5, 6, 7, 12, 50}) {
    const std::string valence = " of valence " + std::to_string(k);
    add("flat star" + valence, star_of(k, 0, 0), 0.5);
    add("cone" + valence, star_of(k, -0.5, -0.5), 0.5);
    if (k % 2 == 0) add("saddle star" + valence, star_of(k, 0.5, -0.5), 0.5);
    add("crown" + valence, star_of(k, -0.25, -1), 0.5);
    add("half crease" + valence, star_of(k, 0, 0.5), 0.5);
  }
}

void Zoo::add_coincidences() {
  add("two equal sheets", together(grid(3), grid(3)), 0.75);
  add("sheet on a sheet's edges",
      together(grid(3), mapped(grid(2),
                               [](Vec3f x) {
                                 return Vec3f{x.x + 0.5f, x.y, 0};
                               })),
      0.75);
  add("vertex on a vertex", with_vertex(grid(3), {1, 1, 0}), 0.5);
  add("vertex on an edge", with_vertex(grid(3), {1, 0.5f, 0}), 0.5);
  add("vertex on a triangle", with_vertex(grid(3), {0.25f, 0.25f, 0}), 0.5);
  add("sheets that cross", together(grid(3), mapped(grid(3), [](Vec3f x) { return Vec3f{x.x, 1, x.y - 1}; })), 0.5);
  add("folded flat", {{{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 1, 0}}, {{0, 1, 2}, {0, 1, 3}}, {}, {}}, 0.5);
  add("collapsed to an edge", {{{0, 0, 0}, {4, 0, 0}, {1, 0, 0}, {2, 2, 0}}, {{0, 1, 2}, {0, 1, 3}}, {}, {}}, 1, true);
  add("collapsed to a point", {{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 2, 0}}, {{0, 1, 2}, {1, 2, 3}}, {}, {}}, 1, true);
  add("edge without length", {{{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {0, 2, 1}}, {{0, 1, 2}, {1, 2, 3}}, {}, {}}, 1, true);
}

}  // namespace

Surface tetrahedron() {
  return {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}, {}, {}};
}

Surface octahedron() {
  return {{{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
          {},
          {}};
}

Surface cube() {
  Surface surface;
  for (int i = 0; i < 8; ++i) surface.positions.push_back(at(2 * (i & 1), 2 * (i >> 1 & 1), 2 * (i >> 2 & 1)));
  surface.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return surface;
}

Surface saddle() {
  return {{{0, 0, 0}, {2, 0, 1}, {0, 2, -1}, {-2, 0, 1}, {0, -2, -1}},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}},
          {},
          {}};
}

Surface book(int pages, double turn) {
  Surface surface{{{0, 0, 0}, {2, 0, 0}}, {}, {}, {}};
  for (int i = 0; i < pages; ++i) {
    const double angle = 2 * pi * turn * i / pages;
    surface.positions.push_back(at(1, std::cos(angle), std::sin(angle)));
    surface.triangles.push_back({0, 1, 2 + i});
  }
  return surface;
}

Surface moebius(int n) {
  Surface surface;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * i / n;
    for (const double side : {-0.4, 0.4}) {
      const double radius = 1 + side * std::cos(angle / 2);
      surface.positions.push_back(at(radius * std::cos(angle), radius * std::sin(angle), side * std::sin(angle / 2)));
    }
  }
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = 2 * i + 1, c = i + 1 < n ? 2 * i + 2 : 1, d = i + 1 < n ? 2 * i + 3 : 0;
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({b, d, c});
  }
  return surface;
}

const std::vector<Specimen>& mesh_zoo() {
  static const std::vector<Specimen> zoo = [] {
    Zoo all;
    all.add_shapes();
    all.add_random();
    all.add_stars();
    all.add_coincidences();
    return all.take();
  }();
  return zoo;
}

}  // namespace ogc::tests
