// Stage volume_depth: which parts of a volume of triangles hold a point, or are nearer than r to it: face, weights,
// direction and depth of each contact (§3.9; method.md §9).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// One volume: its surface alone, and points that ask it. Each edge has one triangle (a rim), or two that run through
/// it in opposite senses; triangles have an area, none is lower than 2⁻²⁰ of its longest side, whose foot and normal
/// single precision does not know. A *part* is a connected component. Views; the owner must outlive the call.
struct VolumeDepthIn {
  const Topology* topology = nullptr;  ///< of the volume
  std::span<const Vec3f> positions;    ///< by vertex of the volume [m]
  float contact_radius = 0;            ///< r [m]
  std::span<const Vec3f> points;       ///< that ask [m]
};

/// One contact of a point x with a part; c is the point of `face` closest to x.
struct VolumeContact {
  Index point = -1;                ///< who asked
  std::uint8_t inside = 0;         ///< whether x is inside the part
  Index triangle = -1;             ///< the lowest-numbered one that contains `face`
  Face face;                       ///< whose interior holds c
  std::array<float, 3> weights{};  ///< of c, by corner of `triangle` [1]
  /// n, a unit vector out of the part: (x − c)/‖x − c‖ outside, (c − x)/‖x − c‖ inside; on the interior of a triangle,
  /// and where ‖x − c‖ cannot be told from 0, the normal of `triangle`
  Vec3f direction;
  float depth = 0;  ///< ‖x − c‖ + r inside, r − ‖x − c‖ outside [m]
};

/// A part holds x if the way from its nearest face a (of equals the lowest-dimensional, then the lowest-numbered one)
/// to x begins on the inner side of a's triangles; rims have no inner side, and x is outside on the surface and beyond
/// the closed box of the part's vertices. Such a part gives one contact, at a; any other one for each face in whose
/// outward block (Eq. 8–10, the outer half) x lies nearer than r.
struct VolumeDepthOut {
  std::vector<VolumeContact> contacts;  ///< ascending by point, inside, triangle, face
};

/// A contact that may be answered, and the units of its numbers.
struct VolumeAnswer {
  VolumeContact contact;            ///< point, inside, triangle and face
  std::array<double, 3> weights{};  ///< exact within 2⁻⁴⁰ of their unit
  Vec3 direction;                   ///< likewise
  double depth = 0;                 ///< likewise [m]
  double weight_scale = 0;          ///< Σ ‖∂w/∂δ‖ ‖δ‖, at least 1
  double direction_scale = 0;       ///< of the direction, at least 1; infinite where any direction is accepted
  double depth_scale = 0;           ///< max(‖x − c‖, Σ ‖δ‖) + r [m]
};

/// What is accepted of one part. Where x is grey between faces, each grey face has its say: which side it says, and
/// what it says of it, together.
struct VolumePartTruth {
  Index component = -1;                  ///< Topology::component of the part's vertices
  bool inside = false;                   ///< the exact answer
  bool may_be_inside = false;            ///< some grey face says so; `held` is not empty
  bool may_be_outside = false;           ///< likewise, `touching` alone
  std::vector<VolumeAnswer> held;        ///< any one of them may stand alone, the exact one first
  std::vector<VolumeAnswer> touching;    ///< may stand side by side, where the part does not hold x
  std::vector<std::uint8_t> is_certain;  ///< of `touching`: 1 where it must be there
  std::vector<std::uint8_t> is_exact;    ///< of `touching`: 1 where it stands in the exact answer
  bool needs_contact = false;  ///< outside, and x is certainly nearer than r: at least one of `touching` (covering)
};

/// By point.
struct VolumeDepthTruth {
  std::vector<std::vector<VolumePartTruth>> parts;  ///< by point: all parts of the volume
  std::vector<std::uint8_t> grey, near;             ///< by point
};

/// In units of u · depth_scale: a difference (1), a foot and its difference (4 + 1), a length (4), the sum with r (1):
/// 11, and the rounding of the stored depth.
inline constexpr double volume_depth_tolerance = 12;
/// In units of u · weight_scale: as closest_face.
inline constexpr double volume_weight_tolerance = 12;
/// In units of u · direction_scale: of a normal two differences (1), a cross product (3), a length and a quotient (4 +
/// 1); of a way to a foot as the depth, and a quotient: 12 at most.
inline constexpr double volume_direction_tolerance = 12;

}  // namespace ogc::compare
