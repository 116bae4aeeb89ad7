#include "compare/problem/dust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr double dust_share = 0x1p-40;
constexpr std::array<double Vec3::*, 3> axes{&Vec3::x, &Vec3::y, &Vec3::z};

double largest_coordinate(std::span<const Vec3> positions) {
  double largest = 0;
  for (const Vec3& p : positions) {
    for (const auto axis : axes) {
      if (std::isfinite(p.*axis)) largest = std::max(largest, std::abs(p.*axis));
    }
  }
  return largest;
}

/// Sets coordinates whose modulus is below `limit` to 0 and counts them. A coordinate is not counted again if
/// `counted_elsewhere` has the same value for the vertex.
void clear(std::vector<Vec3>& positions, double limit, std::span<const Vec3> counted_elsewhere, Dust& dust) {
  for (std::size_t v = 0; v < positions.size(); ++v) {
    for (const auto axis : axes) {
      double& x = positions[v].*axis;
      if (x == 0 || !(std::abs(x) < limit)) continue;
      if (v >= counted_elsewhere.size() || counted_elsewhere[v].*axis != x) ++dust.count;
      dust.largest = std::max(dust.largest, std::abs(x));
      x = 0;
    }
  }
}

}  // namespace

Dust clear_dust(Mesh& mesh) {
  Dust dust;
  clear(mesh.positions, dust_share * largest_coordinate(mesh.positions), {}, dust);
  return dust;
}

Dust clear_dust(Scene& scene) {
  const double limit = dust_share *
                       std::max(largest_coordinate(scene.mesh.positions), largest_coordinate(scene.rest_positions));
  Dust dust;
  clear(scene.rest_positions, limit, scene.mesh.positions, dust);
  clear(scene.mesh.positions, limit, {}, dust);
  return dust;
}

std::string describe(const Dust& dust, const std::string& treatment) {
  if (dust.count == 0) return {};
  return std::to_string(dust.count) + (dust.count == 1 ? " coordinate is" : " coordinates are") +
         " dust (below 2⁻⁴⁰ of the largest coordinate; at most " + shortest(dust.largest) + " m): " + treatment;
}

}  // namespace ogc::compare
