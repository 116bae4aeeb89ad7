// Stage volume_depth: which parts of a volume hold a point, or are nearer than r to it: face, weights, direction and
// depth of each contact (§3.9; method.md §9). A part consists of triangles or of tetrahedra; a part of tetrahedra may
// hold a point several times, once in each *sheet*.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// One volume: its surface, its tetrahedra if it has any, and the points that it is tested with. Each edge of a part of
/// triangles has one triangle (a rim), or two that run through it in opposite senses; triangles have an area, and no
/// height is below 2⁻²⁰ of its triangle's longest side, where single precision does not know foot and normal. A *part*
/// is a connected component of triangles and tetrahedra, with its cavities; the triangles of a part with tetrahedra are
/// their boundary (compare/problem/tetrahedra.hpp) and no others. Views; the owner must outlive the call.
struct VolumeDepthIn {
  const Topology* topology = nullptr;            ///< of the volume's triangles
  std::span<const Vec3f> positions;              ///< by vertex of the volume [m]
  float contact_radius = 0;                      ///< r [m]
  std::span<const Vec3f> points;                 ///< points to test [m]
  std::span<const Tetrahedron> tetrahedra = {};  ///< those without positive volume are ignored
  std::span<const Index> own = {};               ///< by point: its vertex, or −1; empty: no point is a vertex
  /// for each component of triangles that is a cavity: one of its vertices, and one of the component around it
  std::span<const Edge> cavities = {};
};

/// One contact of a point x with a part; c is the point of `face` closest to x.
struct VolumeContact {
  Index point = -1;                ///< number of the tested point
  std::uint8_t inside = 0;         ///< whether x is inside the part
  Index triangle = -1;             ///< the lowest-numbered triangle that contains `face`
  Face face;                       ///< the face whose interior holds c
  std::array<float, 3> weights{};  ///< of c, by corner of `triangle` [1]
  /// n, a unit vector out of the part: (x − c)/‖x − c‖ outside, (c − x)/‖x − c‖ inside; on the interior of a triangle,
  /// and where ‖x − c‖ cannot be told from 0, the normal of `triangle`
  Vec3f direction;
  float depth = 0;  ///< ‖x − c‖ + r inside, r − ‖x − c‖ outside [m]
};

/// A part holds x if the way from its nearest face a (of equally near faces the lowest-dimensional, then the
/// lowest-numbered one) to x begins on the inner side of a's triangles; rims have no inner side, and x is outside on
/// the surface and beyond the closed box of the part's vertices. A part that holds x gives one contact, at a; any other
/// part gives one for each face in whose outward block (Eq. 8–10, the outer half) x lies nearer than r.
///
/// In a part of tetrahedra a sheet is a point of the complex of those with positive volume that lies at x, named by the
/// simplex whose interior holds it; closed tetrahedra hold it. Its contact is at the end of its shortest way. A way is
/// a segment from x to the closest point of a boundary triangle whose tetrahedron is positive, along which the complex
/// can be traversed, from one tetrahedron to another that shares the point of the segment with it; of equally short
/// ways the one to the lowest-dimensional, then the lowest-numbered face counts. Ways of two sheets to one face are one
/// contact. A sheet without any way has no contact. Without a sheet x is outside. If x is a vertex of the volume, the
/// sheets of tetrahedra that contain it and the faces that do are left out. Outside a face with a triangle of a
/// tetrahedron without positive volume either side is right: the surface is folded there.
struct VolumeDepthOut {
  std::vector<VolumeContact> contacts;  ///< ascending by point, inside, triangle, face
  std::vector<Index> unresolved = {};   ///< ascending: the point of each sheet without any way
};

/// An accepted contact, and the units of its numbers.
struct VolumeAnswer {
  VolumeContact contact;            ///< point, inside, triangle and face
  std::array<double, 3> weights{};  ///< exact within 2⁻⁴⁰ of their unit
  Vec3 direction;                   ///< exact within 2⁻⁴⁰ of its unit
  double depth = 0;                 ///< exact within 2⁻⁴⁰ of its unit [m]
  double weight_scale = 0;          ///< Σ ‖∂w/∂δ‖ ‖δ‖, at least 1
  double direction_scale = 0;       ///< unit of the direction, at least 1; infinite where any direction is accepted
  double depth_scale = 0;           ///< max(‖x − c‖, Σ ‖δ‖) + r [m]
};

/// What is accepted for those sheets of a part of tetrahedra at one point that cannot be told apart for certain: mostly
/// for one sheet.
struct VolumeSheetTruth {
  int exact = 0;                       ///< number of sheets that hold the point exactly
  bool is_certain = false;             ///< exactly one does, and no grey decision changes it
  std::vector<VolumeAnswer> accepted;  ///< any one of them may be the contact; the exact ones come first
  int exact_contacts = 0;              ///< number of exact ones in `accepted`
  int exact_unresolved = 0;            ///< sheets without any way
  bool may_be_unresolved = false;      ///< no way is certain
};

/// What is accepted for one part. If x is grey between faces, the side and the contact that each grey face gives are
/// accepted, together.
struct VolumePartTruth {
  Index component = -1;                  ///< joined_components of the part's vertices
  bool inside = false;                   ///< the exact answer
  bool may_be_inside = false;            ///< a grey face gives inside; `held` is not empty
  bool may_be_outside = false;           ///< a grey face gives outside; `touching` alone
  std::vector<VolumeAnswer> held;        ///< any one of them may be the only contact, the exact one first
  std::vector<VolumeAnswer> touching;    ///< may all be there if the part does not hold x
  std::vector<std::uint8_t> is_certain;  ///< of `touching`: 1 where the contact must be there
  std::vector<std::uint8_t> is_exact;    ///< of `touching`: 1 where the contact is in the exact answer
  bool needs_contact = false;  ///< outside, and x is certainly nearer than r: at least one of `touching` (covering)
  bool is_solid = false;       ///< part of tetrahedra: `sheets` replaces `held`
  std::vector<VolumeSheetTruth> sheets;  ///< of a part of tetrahedra
};

/// Returns the contacts of the exact answer of one part; those of a part of tetrahedra once each.
inline std::vector<const VolumeAnswer*> exact_answers(const VolumePartTruth& part) {
  std::vector<const VolumeAnswer*> all;
  if (part.inside && !part.is_solid) all.push_back(&part.held.front());
  for (const VolumeSheetTruth& sheet : part.sheets) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(sheet.exact_contacts); ++k) {
      const VolumeAnswer& answer = sheet.accepted[k];
      const Face& face = answer.contact.face;
      // compared by members: nvcc drops a comparison that only a header uses
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

/// Returns the number of sheets without any way in the exact answer of one part.
inline std::size_t exact_unresolved(const VolumePartTruth& part) {
  std::size_t count = 0;
  for (const VolumeSheetTruth& sheet : part.sheets) count += static_cast<std::size_t>(sheet.exact_unresolved);
  return count;
}

/// The exact answer by point.
struct VolumeDepthTruth {
  std::vector<std::vector<VolumePartTruth>> parts;  ///< by point: all parts of the volume
  std::vector<std::uint8_t> grey, near;             ///< by point
};

/// Largest error in units of u · depth_scale: a difference (1), a foot and its difference (4 + 1), a length (4), the
/// sum with r (1): 11, and the rounding of the stored depth.
inline constexpr double volume_depth_tolerance = 12;
/// Largest error in units of u · weight_scale, counted as in closest_face.
inline constexpr double volume_weight_tolerance = 12;
/// Largest error in units of u · direction_scale: for a normal two differences (1), a cross product (3), a length and a
/// quotient (4 + 1); for a way to a foot the depth's count and a quotient: 12 at most.
inline constexpr double volume_direction_tolerance = 12;

}  // namespace ogc::compare
