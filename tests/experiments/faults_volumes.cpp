// Plants faults of volume_depth and volume_force.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

template <class Change>
Fault asked(const std::string& name, Change change) {
  return cases_asked_wrongly("volume_force: " + name, &Contestant::volume_force, change);
}

/// Returns n·Σ wᵢ (x₀ − xᵢ).
double height(const VolumeForceCase& c) {
  const auto along = [&](std::size_t k) {
    const Vec3f &x = c.vertex[0], &y = c.vertex[k];
    return c.direction[0] * (double{x.x} - y.x) + c.direction[1] * (double{x.y} - y.y) +
           c.direction[2] * (double{x.z} - y.z);
  };
  return c.weights[0] * along(1) + c.weights[1] * along(2) + c.weights[2] * along(3);
}

/// Returns the weight of the case's vertex `own`: 1 for the point, else the weight of this corner of the triangle.
float weight(const VolumeForceCase& c) { return c.own == 0 ? 1 : c.weights[static_cast<std::size_t>(c.own) - 1]; }

/// Moves the point x₀ deeper along the normal by `step`, both now and at the start of the time step. Its motion is
/// unchanged.
void lower(VolumeForceCase& c, double step) {
  for (auto* points : {&c.vertex, &c.start}) {
    Vec3f& x = (*points)[0];
    x = {static_cast<float>(x.x - step * c.direction[0]), static_cast<float>(x.y - step * c.direction[1]),
         static_cast<float>(x.z - step * c.direction[2])};
  }
}

void sort(VolumeDepthOut& out) {
  std::ranges::sort(out.contacts, {},
                    [](const VolumeContact& c) { return std::tuple(c.point, c.inside, c.triangle, c.face); });
}

/// Returns a fault that changes the right contacts by `change(in, out)` and sorts them again.
template <class Change>
Fault depth_spoiled(const std::string& name, Change change) {
  return spoiled("volume_depth: " + name, &Contestant::volume_depth,
                 [change](const VolumeDepthIn& in, VolumeDepthOut& out) {
                   change(in, out);
                   sort(out);
                 });
}

/// Returns a fault that changes each contact by `change(contact, in)`.
template <class Change>
Fault each_spoiled(const std::string& name, Change change) {
  return depth_spoiled(name, [change](const VolumeDepthIn& in, VolumeDepthOut& out) {
    for (VolumeContact& c : out.contacts) change(c, in);
  });
}

/// Returns a fault that omits the contacts for which `is_lost(contact, in)` holds.
template <class Lost>
Fault lost(const std::string& name, Lost is_lost) {
  return depth_spoiled(name, [is_lost](const VolumeDepthIn& in, VolumeDepthOut& out) {
    std::erase_if(out.contacts, [&](const VolumeContact& c) { return is_lost(c, in); });
  });
}

/// Returns the unit normal of a triangle, and the height of x over it [m].
std::pair<Vec3, double> plane_of(const VolumeDepthIn& in, Index triangle, const Vec3f& x) {
  const auto& t = in.topology->triangles[static_cast<std::size_t>(triangle)];
  const auto from = [&](std::size_t k, const Vec3f& to) {
    const Vec3f& p = in.positions[static_cast<std::size_t>(t[k])];
    return Vec3{double{to.x} - p.x, double{to.y} - p.y, double{to.z} - p.z};
  };
  const Vec3 a = from(0, in.positions[static_cast<std::size_t>(t[1])]),
             b = from(0, in.positions[static_cast<std::size_t>(t[2])]), w = from(0, x);
  const Vec3 n{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
  return {{n.x / length, n.y / length, n.z / length}, (n.x * w.x + n.y * w.y + n.z * w.z) / length};
}

/// Changes a contact outside the surface into a contact inside it, or the reverse.
void turn_over(VolumeContact& c, float radius) {
  c.depth = 2 * radius - c.depth;
  c.direction = {-c.direction.x, -c.direction.y, -c.direction.z};
  c.inside = c.inside == 0;
}

template <class Change>
Fault depth_asked(const std::string& name, Change change) {
  return asked_wrongly("volume_depth: " + name, &Contestant::volume_depth, change);
}

Vec3 from_to(const Vec3f& a, const Vec3f& b) { return {double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z}; }
double inner(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 minus(const Vec3& a, const Vec3& b, double factor) {
  return {a.x - factor * b.x, a.y - factor * b.y, a.z - factor * b.z};
}

/// Returns whether the path from the point to its contact point passes an edge of a tetrahedron at a distance below
/// 10⁻⁶ of the path's length. Ends of the path do not count.
bool meets_edge(const VolumeContact& c, const VolumeDepthIn& in) {
  const Vec3f& x = in.points[static_cast<std::size_t>(c.point)];
  const Triangle& corners = in.topology->triangles[static_cast<std::size_t>(c.triangle)];
  Vec3 way;
  for (std::size_t k = 0; k < 3; ++k)
    way = minus(way, from_to(x, in.positions[static_cast<std::size_t>(corners[k])]), -double{c.weights[k]});
  const double length = std::sqrt(inner(way, way));
  for (const Tetrahedron& t : in.tetrahedra) {
    for (std::size_t k = 0; k < 6; ++k) {
      constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
      const Vec3f& a = in.positions[static_cast<std::size_t>(t[edges[k][0]])];
      const Vec3 e = from_to(a, in.positions[static_cast<std::size_t>(t[edges[k][1]])]), u = from_to(a, x);
      // The points of the path and of the edge's line that are closest to each other are x + s way and a + r e.
      const double ee = inner(e, e), ew = inner(e, way), ww = inner(way, way), det = ee * ww - ew * ew;
      if (!(det > 1e-6 * ee * ww)) continue;
      const double s = (ew * inner(u, e) - ee * inner(u, way)) / det, r = (inner(u, e) + s * ew) / ee;
      if (s < 0.01 || s > 0.99 || r < 0 || r > 1) continue;
      const Vec3 apart = minus(minus(u, way, -s), e, r);
      if (std::sqrt(inner(apart, apart)) < 1e-6 * length) return true;
    }
  }
  return false;
}

std::vector<Fault> solid_faults() {
  return {
      depth_asked("own sheet kept", [](VolumeDepthIn& in) { in.own = {}; }),
      {"volume_depth: tetrahedra that are turned inside out hold points, and are a way", Stage::volume_depth,
       [](Contestant& contestant, const Authority&) {
         contestant.volume_depth = [right = contestant.volume_depth](const VolumeDepthIn& in) {
           std::vector<Tetrahedron> turned(in.tetrahedra.begin(), in.tetrahedra.end());
           for (Tetrahedron& t : turned) {
             const auto at = [&](std::size_t k) { return in.positions[static_cast<std::size_t>(t[k])]; };
             const Vec3 a = from_to(at(0), at(1)), b = from_to(at(0), at(2)), c = from_to(at(0), at(3));
             const Vec3 n{b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x};
             if (inner(a, n) < 0) std::swap(t[2], t[3]);
           }
           VolumeDepthIn other = in;
           other.tetrahedra = turned;
           return right(other);
         };
       }},
      depth_spoiled("a ray lost at an edge",
                    [](const VolumeDepthIn& in, VolumeDepthOut& out) {
                      const auto is_lost = [&](const VolumeContact& c) { return c.inside != 0 && meets_edge(c, in); };
                      for (const VolumeContact& c : out.contacts)
                        if (is_lost(c)) out.unresolved.push_back(c.point);
                      std::ranges::sort(out.unresolved);
                      std::erase_if(out.contacts, is_lost);
                    }),
      depth_asked("the nearest boundary, through whatever sheet", [](VolumeDepthIn& in) { in.tetrahedra = {}; }),
      depth_spoiled("one sheet for all",
                    [](const VolumeDepthIn& in, VolumeDepthOut& out) {
                      if (in.tetrahedra.empty()) return;
                      const auto repeated = [](const VolumeContact& a, const VolumeContact& b) {
                        return a.point == b.point && a.inside != 0 && b.inside != 0;
                      };
                      out.contacts.erase(std::unique(out.contacts.begin(), out.contacts.end(), repeated),
                                         out.contacts.end());
                    }),
      depth_spoiled("sheets without a way not told",
                    [](const VolumeDepthIn&, VolumeDepthOut& out) { out.unresolved.clear(); }),
      depth_spoiled("sheets without a way at the nearest triangle",
                    [](const VolumeDepthIn& in, VolumeDepthOut& out) {
                      for (const Index point : out.unresolved) {
                        VolumeContact c;
                        c.point = point, c.inside = 1, c.triangle = 0, c.face = {FaceKind::triangle, 0};
                        c.weights = {1, 0, 0}, c.direction = {0, 0, 1}, c.depth = in.contact_radius;
                        out.contacts.push_back(c);
                      }
                      out.unresolved.clear();
                    }),
  };
}

std::vector<Fault> depth_faults() {
  return {
      each_spoiled(
          "side of one triangle's normal at ridges and vertices",
          [](VolumeContact& c, const VolumeDepthIn& in) {
            const double height = plane_of(in, c.triangle, in.points[static_cast<std::size_t>(c.point)]).second;
            if (c.face.kind != FaceKind::triangle && (height < 0) != (c.inside != 0)) turn_over(c, in.contact_radius);
          }),
      depth_spoiled("inside and outside entered together",
                    [](const VolumeDepthIn& in, VolumeDepthOut& out) {
                      const std::size_t count = out.contacts.size();
                      for (std::size_t i = 0; i < count; ++i) {
                        VolumeContact c = out.contacts[i];
                        if (c.inside == 0) continue;
                        turn_over(c, in.contact_radius);
                        out.contacts.push_back(c);
                      }
                    }),
      depth_spoiled("all parts asked as one: the nearest part that holds the point alone",
                    [](const VolumeDepthIn&, VolumeDepthOut& out) {
                      std::vector<VolumeContact> kept;
                      for (const VolumeContact& c : out.contacts) {
                        if (!kept.empty() && kept.back().point == c.point && c.inside != 0) {
                          if (kept.back().inside != 0 && kept.back().depth <= c.depth) continue;
                          while (!kept.empty() && kept.back().point == c.point) kept.pop_back();
                        }
                        kept.push_back(c);
                      }
                      out.contacts = kept;
                    }),
      depth_asked("a cavity's surface asked as a part of its own", [](VolumeDepthIn& in) { in.cavities = {}; }),
      lost("a search radius that misses deep points",
           [](const VolumeContact& c, const VolumeDepthIn& in) { return c.depth > 3 * in.contact_radius; }),
      lost("no contact with a vertex",
           [](const VolumeContact& c, const VolumeDepthIn&) {
             return c.inside == 0 && c.face.kind == FaceKind::vertex;
           }),
      each_spoiled("direction of the triangle's normal for edges and vertices, too",
                   [](VolumeContact& c, const VolumeDepthIn& in) {
                     const Vec3 n = plane_of(in, c.triangle, in.points[static_cast<std::size_t>(c.point)]).first;
                     c.direction = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
                   }),
      each_spoiled("weights of two corners exchanged",
                   [](VolumeContact& c, const VolumeDepthIn&) { std::swap(c.weights[0], c.weights[1]); }),
      each_spoiled("the last triangle around a face in place of the first",
                   [](VolumeContact& c, const VolumeDepthIn& in) {
                     if (c.face.kind == FaceKind::edge)
                       c.triangle = in.topology->edge_triangles[static_cast<std::size_t>(c.face.index)].back();
                   }),
      each_spoiled("depth 0.01 % too large", [](VolumeContact& c, const VolumeDepthIn&) { c.depth *= 1.0001f; }),
      depth_asked("radius 0.01 % too large", [](VolumeDepthIn& in) { in.contact_radius *= 1.0001f; }),
      depth_spoiled("rims with an inner side",
                    [](const VolumeDepthIn& in, VolumeDepthOut& out) {
                      for (VolumeContact& c : out.contacts) {
                        if (c.inside != 0 || c.face.kind != FaceKind::edge ||
                            in.topology->edge_triangles[static_cast<std::size_t>(c.face.index)].size() != 1)
                          continue;
                        if (plane_of(in, c.triangle, in.points[static_cast<std::size_t>(c.point)]).second < 0)
                          turn_over(c, in.contact_radius);
                      }
                    }),
  };
}

std::vector<Fault> force_faults_of_volumes() {
  const auto told = [](const std::string& name, auto spoil) {
    return forces_spoiled("volume_force: " + name, &Contestant::volume_force, spoil);
  };
  using Block = std::array<float, 6>;
  return {
      asked("depth r at the surface from inside, as from outside: ‖φ‖ for φ",
            [](VolumeForceCase& c) {
              const double h = height(c);
              if (h < 0) lower(c, 2 * h);
            }),
      asked("friction with the wrong sign of the slip",
            [](VolumeForceCase& c) {
              // The fault uses x + (x − xᵗ) in place of xᵗ.
              for (std::size_t k = 0; k < 4; ++k) {
                const Vec3f x = c.vertex[k], s = c.start[k];
                c.start[k] = {2 * x.x - s.x, 2 * x.y - s.y, 2 * x.z - s.z};
              }
            }),
      asked("radius 0.01 % too large", [](VolumeForceCase& c) { c.contact_radius *= 1.0001f; }),
      told("weight not squared in the block",
           [](const VolumeForceCase& c, Vec3f&, Block& block) {
             const float w = weight(c);
             if (w > 0)
               for (float& b : block) b /= w;
           }),
      told("no force deeper than r",
           [](const VolumeForceCase& c, Vec3f& force, Block& block) {
             if (height(c) < -c.contact_radius) force = {}, block = {};
           }),
      forces_short_of(0.001f, "volume_force: force 0.1 % too small", &Contestant::volume_force),
  };
}

}  // namespace

std::vector<Fault> volume_faults() {
  std::vector<Fault> all = depth_faults();
  for (const std::vector<Fault>& more : {solid_faults(), force_faults_of_volumes()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace ogc::tests
