// The flag is the sign of a gap of two points; the scaled position cancels nothing, so long double rounds to the right
// double.
#include "reference/geometry/truncate.hpp"

#include <algorithm>
#include <cmath>

#include "reference/geometry/margin.hpp"
#include "reference/geometry/plane.hpp"
#include "reference/geometry/truncate_region.hpp"

namespace ogc::reference {
namespace {

compare::Vec3 scaled_back(const Vec3f& from, const Vec3f& to, float length) {
  const long double dx = static_cast<long double>(to.x) - from.x, dy = static_cast<long double>(to.y) - from.y,
                    dz = static_cast<long double>(to.z) - from.z;
  const long double scale = length / std::sqrt(dx * dx + dy * dy + dz * dz);
  return {static_cast<double>(from.x + scale * dx), static_cast<double>(from.y + scale * dy),
          static_cast<double>(from.z + scale * dz)};
}

}  // namespace

compare::TruncateTruth truncate(const compare::TruncateIn& in) {
  compare::TruncateTruth truth;
  for (std::size_t i = 0; i < in.position.size(); ++i) {
    const Vec3f &from = in.previous[i], &to = in.position[i];
    const Margin gap = gap_points(from, to, in.bound[i]);
    const MarginAnswer margin = examine(gap);
    if (!in.half_spaces.offsets.empty()) truth.accepted.push_back(0);
    if (!in.half_spaces.of(i).empty()) {
      const RegionTruth region = truncate_region(in, i, margin);
      truth.cut.push_back(region.cut);
      truth.grey.push_back(region.grey);
      truth.near.push_back(region.near);
      truth.position.push_back(region.position);
      truth.accepted.back() = region.accepted;
      continue;
    }
    const bool cut = margin.sign > 0;
    truth.cut.push_back(cut);
    truth.grey.push_back(margin.grey);
    truth.near.push_back(margin.near);
    truth.position.push_back(cut ? scaled_back(from, to, in.bound[i]) : compare::Vec3{to.x, to.y, to.z});
  }
  return truth;
}

compare::HalfSpacesIn half_spaces_of(std::span<const compare::VertexPlane> planes, const Vec3f& current,
                                     const std::array<float, 6>& block, bool is_prescribed) {
  compare::HalfSpacesIn all;
  if (planes.empty()) return all;
  for (const compare::VertexPlane& plane : planes) all.items.push_back({plane.normal, plane.offset});
  all.offsets = {0, static_cast<compare::Index>(planes.size())};
  all.current = {current};
  all.block = {block};
  all.is_prescribed = {static_cast<std::uint8_t>(is_prescribed)};
  return all;
}

compare::Vec3f stored_within(const compare::Vec3& position, const compare::Vec3f& previous, float bound) {
  compare::Vec3f x{static_cast<float>(position.x), static_cast<float>(position.y), static_cast<float>(position.z)};
  while (sign(gap_points(previous, x, bound)) > 0)
    x = {std::nextafter(x.x, previous.x), std::nextafter(x.y, previous.y), std::nextafter(x.z, previous.z)};
  return x;
}

compare::Vec3f stored_in_region(const compare::Vec3& position, const compare::TruncateIn& in, std::size_t i) {
  constexpr int attempts = 4;  // each leaves the half-spaces by as much as storing may move the point
  const auto half_spaces = in.half_spaces.of(i);
  const auto is_kept = [](const compare::HalfSpace& h, const Vec3f& x) { return keeps({{}, h.normal, h.offset}, x); };
  compare::Vec3 y = position;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const Vec3f x = stored_within(y, in.previous[i], in.bound[i]);
    if (std::ranges::all_of(half_spaces, [&](const compare::HalfSpace& h) { return is_kept(h, x); })) return x;
    for (const compare::HalfSpace& h : half_spaces) {
      if (is_kept(h, x)) continue;
      const double nx = h.normal.x, ny = h.normal.y, nz = h.normal.z;
      const double back = compare::unit_roundoff * (std::abs(nx * x.x) + std::abs(ny * x.y) + std::abs(nz * x.z)) /
                          (nx * nx + ny * ny + nz * nz);
      y = {y.x - back * nx, y.y - back * ny, y.z - back * nz};
    }
  }
  return in.half_spaces.current[i];
}

}  // namespace ogc::reference
