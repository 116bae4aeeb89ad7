#include "compare/problem/local_origin.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "compare/problem/scene.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr std::array<double Vec3::*, 3> axes{&Vec3::x, &Vec3::y, &Vec3::z};
constexpr double far = 16;  ///< multiple of the box's length

struct Box {
  Vec3 low, high;
  double length = 0;  ///< the longest side [m]
};

Box box_of(const std::vector<Vec3>& positions) {
  if (positions.empty()) return {};
  Box box{positions.front(), positions.front()};
  for (const Vec3& p : positions) {
    for (const auto axis : axes) {
      box.low.*axis = std::min(box.low.*axis, p.*axis);
      box.high.*axis = std::max(box.high.*axis, p.*axis);
    }
  }
  for (const auto axis : axes) box.length = std::max(box.length, box.high.*axis - box.low.*axis);
  return box;
}

double distance(const Box& box) {
  double most = 0;
  for (const auto axis : axes) most = std::max({most, std::abs(box.low.*axis), std::abs(box.high.*axis)});
  return most;
}

std::string rounded(double value) {
  std::array<char, 32> buffer{};
  return {buffer.data(),
          std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 3).ptr};
}

}  // namespace

Vec3 local_origin(const std::vector<Vec3>& positions) {
  const Box box = box_of(positions);
  Vec3 origin;
  if (!(box.length > 0) || !std::isfinite(distance(box))) return origin;
  const double unit = std::exp2(std::floor(std::log2(box.length)));
  for (const auto axis : axes) {
    const double centre = box.low.*axis + (box.high.*axis - box.low.*axis) / 2;
    if (std::abs(centre) >= far * box.length) origin.*axis = std::round(centre / unit) * unit;
  }
  return origin;
}

std::vector<Vec3> relative_to(const Vec3& origin, std::vector<Vec3> positions) {
  for (Vec3& p : positions) p = {p.x - origin.x, p.y - origin.y, p.z - origin.z};
  return positions;
}

double typed_at(double origin, float local) {
  const double exact = origin + local;
  std::array<char, 32> buffer{};
  for (int digits = 1; digits < 17; ++digits) {
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), exact, std::chars_format::general, digits).ptr;
    double typed = 0;
    std::from_chars(buffer.data(), end, typed);
    if (static_cast<float>(typed - origin) == local) return typed;
  }
  return exact;
}

std::vector<Vec3> in_file(const Vec3& origin, const std::vector<Vec3f>& local) {
  if (origin == Vec3{}) return to_double(local);
  std::vector<Vec3> positions;
  positions.reserve(local.size());
  for (const Vec3f& p : local)
    positions.push_back({typed_at(origin.x, p.x), typed_at(origin.y, p.y), typed_at(origin.z, p.z)});
  return positions;
}

std::string describe_origin(const std::vector<Vec3>& positions, const Vec3& origin, const std::string& remedy) {
  if (origin == Vec3{}) return {};
  const Box box = box_of(positions);
  return "coordinates lie " + rounded(distance(box)) + " m from 0, " + rounded(distance(box) / box.length) +
         " times the mesh's size: " + remedy;
}

}  // namespace ogc::compare
