// Stage volume_depth: which parts of a volume hold a point, or are nearer than r to it: face, weights, direction and
// depth of each contact (§3.9; method.md §9). A part is of triangles, or of tetrahedra: then it may hold a point
// several times over, once in each *sheet*.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// One volume: its surface and its tetrahedra, if it has any, and points that ask it. Each edge of a part of triangles
/// has one triangle (a rim), or two that run through it in opposite senses; triangles have an area, none is lower than
/// 2⁻²⁰ of its longest side, whose foot and normal single precision does not know. A *part* is a connected component of
/// triangles and tetrahedra, with its cavities; the triangles of one with tetrahedra are their boundary
/// (compare/problem/tetrahedra.hpp) and no others. Views; the owner must outlive the call.
struct VolumeDepthIn {
  const Topology* topology = nullptr;            ///< of the volume's triangles
  std::span<const Vec3f> positions;              ///< by vertex of the volume [m]
  float contact_radius = 0;                      ///< r [m]
  std::span<const Vec3f> points;                 ///< that ask [m]
  std::span<const Tetrahedron> tetrahedra = {};  ///< those without positive volume are as if they were not there
  std::span<const Index> own = {};               ///< by point: the vertex that it is, or −1; empty: none is any
  /// of components of triangles that are cavities of others, and of one part with them: a vertex of each of both
  std::span<const Edge> cavities = {};
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
///
/// A part of tetrahedra: a sheet is a point of the complex of those with positive volume that lies at x, named by the
/// simplex whose interior holds it; closed tetrahedra hold it. Its contact is at the end of its shortest way: of all
/// segments from x to the closest point of a boundary triangle whose tetrahedron is positive, along which the complex
/// can be traversed, from one tetrahedron to another that shares the point of the segment with it, the shortest one; of
/// equals that to the lowest-dimensional, then the lowest-numbered face. Ways of two sheets to a face are one contact.
/// A sheet without any way has no contact. Where there is no sheet, x is outside. Sheets of tetrahedra that contain the
/// vertex that asks, and faces that do, do not count. Outside a face around which some triangle is of a tetrahedron
/// without positive volume either side is right: the surface is folded there.
struct VolumeDepthOut {
  std::vector<VolumeContact> contacts;  ///< ascending by point, inside, triangle, face
  std::vector<Index> unresolved = {};   ///< ascending: the point of each sheet without any way
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

/// What is accepted of the sheets of a part of tetrahedra at one point that cannot be told apart for certain: mostly of
/// one sheet.
struct VolumeSheetTruth {
  int exact = 0;                       ///< how many hold the point exactly
  bool is_certain = false;             ///< exactly one does, and whatever is grey does not change it
  std::vector<VolumeAnswer> accepted;  ///< any one of them may be its contact; the exact ones are first
  int exact_contacts = 0;              ///< how many of those there are
  int exact_unresolved = 0;            ///< sheets without any way
  bool may_be_unresolved = false;      ///< no way is certain
};

/// What is accepted of one part. Where x is grey between faces, each grey face has its say: which side it says, and
/// what it says of it, together.
struct VolumePartTruth {
  Index component = -1;                  ///< joined_components of the part's vertices
  bool inside = false;                   ///< the exact answer
  bool may_be_inside = false;            ///< some grey face says so; `held` is not empty
  bool may_be_outside = false;           ///< likewise, `touching` alone
  std::vector<VolumeAnswer> held;        ///< any one of them may stand alone, the exact one first
  std::vector<VolumeAnswer> touching;    ///< may stand side by side, where the part does not hold x
  std::vector<std::uint8_t> is_certain;  ///< of `touching`: 1 where it must be there
  std::vector<std::uint8_t> is_exact;    ///< of `touching`: 1 where it stands in the exact answer
  bool needs_contact = false;  ///< outside, and x is certainly nearer than r: at least one of `touching` (covering)
  bool is_solid = false;       ///< of tetrahedra: `sheets` in place of `held`
  std::vector<VolumeSheetTruth> sheets;  ///< of a part of tetrahedra
};

/// The contacts of the exact answer of one part; those of a part of tetrahedra each once.
inline std::vector<const VolumeAnswer*> exact_answers(const VolumePartTruth& part) {
  std::vector<const VolumeAnswer*> all;
  if (part.inside && !part.is_solid) all.push_back(&part.held.front());
  for (const VolumeSheetTruth& sheet : part.sheets) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(sheet.exact_contacts); ++k) {
      const VolumeAnswer& answer = sheet.accepted[k];
      const Face& face = answer.contact.face;
      // by its members: nvcc leaves out a comparison that a header alone uses
      const auto is_there = [&](const VolumeAnswer* other) {
        return other->contact.face.kind == face.kind && other->contact.face.index == face.index;
      };
      if (std::none_of(all.begin(), all.end(), is_there)) all.push_back(&answer);
    }
  }
  for (std::size_t k = 0; k < part.touching.size(); ++k)
    if (part.is_exact[k] != 0) all.push_back(&part.touching[k]);
  return all;
}

/// Sheets without any way in the exact answer of one part.
inline std::size_t exact_unresolved(const VolumePartTruth& part) {
  std::size_t count = 0;
  for (const VolumeSheetTruth& sheet : part.sheets) count += static_cast<std::size_t>(sheet.exact_unresolved);
  return count;
}

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
