// Does the plane of an answer hold a pair apart? n·x − o is computed in double first; where its rounding could hide the
// sign, in fractions.
#pragma once

#include <array>
#include <optional>

#include "compare/stages/plane.hpp"

namespace ogc::reference {

using compare::Index;
using compare::Vec3f;

/// n·x + o of numbers that are known without error.
struct Height {
  Vec3f normal, point;
  double offset = 0;  ///< [m] times the length of n
};

/// The sign of a − b, exactly. All must be finite.
int compared(const Height& a, const Height& b);

/// An answer, asked about pairs.
class AnsweredPlanes {
 public:
  AnsweredPlanes(const compare::PlaneIn& in, const compare::PlaneOut& out) : in_(in), out_(out) {}

  bool moves(Index v) const { return in_.is_fixed[static_cast<std::size_t>(v)] == 0; }

  /// The offset that v has of the pair's plane, which it bears.
  double offset(Index v, const compare::PrimitivePair& pair) const { return plane_of(v, pair)->offset; }

  /// The normal of the plane that holds the pair apart, as its first side has it; empty where no plane does: a vertex
  /// that can move bears none or one of other bits, or there is no room between the sides.
  template <class Pair>
  std::optional<Vec3f> separating_normal(const Pair& pair) const {
    const std::optional<Vec3f> normal = common_normal(pair);
    if (!normal) return std::nullopt;
    for (const Index v : pair.first)
      for (const Index w : pair.second)
        if (compared(limit(v, pair.name, *normal, false), limit(w, pair.name, *normal, true)) >= 0) return std::nullopt;
    return normal;
  }

 private:
  const compare::VertexPlane* plane_of(Index v, const compare::PrimitivePair& pair) const {
    for (const compare::VertexPlane& plane : out_.planes.of(v))
      if (plane.pair == pair) return &plane;
    return nullptr;
  }

  template <class Pair>
  std::optional<Vec3f> common_normal(const Pair& pair) const {
    std::optional<Vec3f> normal;
    const auto agrees = [&](Index v, bool is_second) {
      if (!moves(v)) return true;
      const compare::VertexPlane* plane = plane_of(v, pair.name);
      if (plane == nullptr) return false;
      const Vec3f& n = plane->normal;
      const Vec3f own = is_second ? Vec3f{-n.x, -n.y, -n.z} : n;
      if (!normal) normal = own;
      return own == *normal;
    };
    for (const Index v : pair.first)
      if (!agrees(v, false)) return std::nullopt;
    for (const Index v : pair.second)
      if (!agrees(v, true)) return std::nullopt;
    return normal;
  }

  /// How far along n a vertex may come: its offset, or where it is for good.
  Height limit(Index v, const compare::PrimitivePair& pair, const Vec3f& normal, bool is_second) const {
    if (!moves(v)) return {normal, in_.positions[static_cast<std::size_t>(v)], 0};
    return {{}, {}, is_second ? -offset(v, pair) : offset(v, pair)};
  }

  const compare::PlaneIn& in_;
  const compare::PlaneOut& out_;
};

}  // namespace ogc::reference
