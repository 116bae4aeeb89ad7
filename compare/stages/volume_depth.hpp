// Stage volume_depth: which parts of a volume contain a point or are nearer to it than r, with face, weights, direction
// and depth of each contact (§3.9; method.md §9). A part consists of triangles or of tetrahedra. A part of tetrahedra
// may contain a point several times, once in each *sheet*.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// Input of the stage: one volume (its surface, and its tetrahedra if it has any) and the points to test. A *part* is a
/// connected component of triangles and tetrahedra, with its cavities. In a part with tetrahedra the triangles are
/// exactly their boundary (compare/problem/tetrahedra.hpp). In a part of triangles each edge has one triangle (a rim),
/// or two that run through it in opposite directions. Each triangle has a positive area. Its heights are at least 2⁻²⁰
/// of its longest side; below that single precision determines neither closest point nor normal. The views' owner must
/// outlive the call.
struct VolumeDepthIn {
  const Topology* topology = nullptr;            ///< of the volume's triangles
  std::span<const Vec3f> positions;              ///< by vertex of the volume [m]
  float contact_radius = 0;                      ///< r [m]
  std::span<const Vec3f> points;                 ///< points to test [m]
  std::span<const Tetrahedron> tetrahedra = {};  ///< those without positive volume are ignored
  std::span<const Index> own = {};               ///< by point: its vertex, or −1; empty: no point is a vertex
  /// for each component of triangles that is a cavity: one vertex of the cavity, and one of the component around it
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

/// The answer. Part of triangles: let a be the face nearest to x (of equally near faces the lowest-dimensional, then
/// the lowest-numbered). The part contains x if the segment from a to x begins on the inner side of a's triangles. Rims
/// have no inner side. x is outside if it lies on the surface or beyond the closed box of the part's vertices. A part
/// that contains x gives one contact, at a. Any other part gives one contact for each face nearer than r whose outward
/// block (Eq. 8–10, the outer half) contains x.
///
/// Part of tetrahedra: the tetrahedra with positive volume, closed, form a complex. A sheet is a point of this complex
/// that lies at x. It is named by the simplex whose interior contains it. A way leads straight from x to the closest
/// point of a boundary triangle whose tetrahedron has positive volume. The way must stay in the complex: it passes from
/// one tetrahedron to another only at a point of the way that both share. The contact of a sheet is at the boundary
/// point where its shortest way ends. Among equally short ways the way to the lowest-dimensional, then the
/// lowest-numbered face counts. If the ways of two sheets lead to one face, there is one contact. A sheet without a way
/// has no contact. If there is no sheet, x is outside.
///
/// If x is a vertex of the volume, sheets of tetrahedra and faces that contain this vertex are left out. At a triangle
/// of a tetrahedron without positive volume the surface is folded. There an answer may list or omit the contact of an
/// outside point with a face of this triangle.
struct VolumeDepthOut {
  std::vector<VolumeContact> contacts;  ///< ascending by point, inside, triangle, face
  std::vector<Index> unresolved = {};   ///< ascending: the point of each sheet without a way
};

/// An accepted contact, and the error scales of its numbers.
struct VolumeAnswer {
  VolumeContact contact;            ///< point, inside, triangle and face
  std::array<double, 3> weights{};  ///< exact within 2⁻⁴⁰ weight_scale
  Vec3 direction;                   ///< exact within 2⁻⁴⁰ direction_scale
  double depth = 0;                 ///< exact within 2⁻⁴⁰ depth_scale [m]
  double weight_scale = 0;          ///< Σ ‖∂w/∂δ‖ ‖δ‖, at least 1
  double direction_scale = 0;       ///< at least 1; infinite where any direction is accepted
  double depth_scale = 0;           ///< max(‖x − c‖, Σ ‖δ‖) + r [m]
};

/// A group of sheets of one part at one tested point, and the group's accepted contacts. Sheets that cannot be told
/// apart with certainty form one group; most groups have one sheet.
struct VolumeSheetTruth {
  int exact = 0;            ///< number of the group's sheets in the exact answer
  bool is_certain = false;  ///< whether the group has exactly one sheet for every outcome of the grey decisions
  std::vector<VolumeAnswer> accepted;  ///< each is accepted as the group's contact; the exact ones come first
  int exact_contacts = 0;              ///< number of exact contacts at the front of `accepted`
  int exact_unresolved = 0;            ///< number of the exact answer's sheets that have no way
  bool may_be_unresolved = false;      ///< true if it is not certain that a way exists
};

/// The accepted answers for one part. In a grey case several faces may be the nearest to x. Each of these faces puts x
/// inside or outside and gives contacts; all these answers are accepted.
struct VolumePartTruth {
  Index component = -1;         ///< number of the component (joined_components of the part's vertices)
  bool inside = false;          ///< whether x is inside in the exact answer
  bool may_be_inside = false;   ///< whether one of these faces puts x inside
  bool may_be_outside = false;  ///< whether one of these faces puts x outside; only then `touching` is read
  /// contacts if x is inside, the exact one first; the answer then has exactly one of them
  std::vector<VolumeAnswer> held;
  std::vector<VolumeAnswer> touching;    ///< contacts if x is outside; the answer may have any of them
  std::vector<std::uint8_t> is_certain;  ///< by contact of `touching`: 1 if the answer must have it
  std::vector<std::uint8_t> is_exact;    ///< by contact of `touching`: 1 if the exact answer has it
  /// whether x is certainly outside and nearer than r; then the answer must have at least one contact of `touching`
  bool needs_contact = false;
  bool is_solid = false;                 ///< part of tetrahedra: `sheets` replaces `held`
  std::vector<VolumeSheetTruth> sheets;  ///< of a part of tetrahedra
};

/// Returns the contacts of the exact answer of one part, without repetition.
inline std::vector<const VolumeAnswer*> exact_answers(const VolumePartTruth& part) {
  std::vector<const VolumeAnswer*> all;
  if (part.inside && !part.is_solid) all.push_back(&part.held.front());
  for (const VolumeSheetTruth& sheet : part.sheets) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(sheet.exact_contacts); ++k) {
      const VolumeAnswer& answer = sheet.accepted[k];
      const Face& face = answer.contact.face;
      // Compares members because nvcc drops a comparison operator that only a header uses.
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

/// Returns the number of sheets of one part that have no way in the exact answer.
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

/// Largest error of `depth` in units of u · depth_scale, u = 2⁻²⁴. Rounding errors: a difference (1), a closest point
/// and its difference (4 + 1), a length (4), the sum with r (1), storing (1).
inline constexpr double volume_depth_tolerance = 12;
/// Largest error of a weight in units of u · weight_scale, counted as in closest_face.
inline constexpr double volume_weight_tolerance = 12;
/// Largest error of `direction` in units of u · direction_scale. Rounding errors of a normal: two differences (1), a
/// cross product (3), a length and a quotient (4 + 1). A vector to a closest point has the rounding errors of the depth
/// and a quotient, 12 at most.
inline constexpr double volume_direction_tolerance = 12;

}  // namespace ogc::compare
