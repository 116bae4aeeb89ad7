// The flag is the sign of a gap of two points; the scaled position cancels nothing, so long double rounds to the right
// double.
#include "reference/geometry/truncate.hpp"

#include <cmath>

#include "reference/geometry/margin.hpp"
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

}  // namespace ogc::reference
