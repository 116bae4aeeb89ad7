// Stage volume_depth for parts of tetrahedra: finds the sheets at a point and the shortest way from each to the
// boundary (§3.9, after Chen, Diaz and Yuksel 2023). Tetrahedra without volume are allowed. If all have volume and the
// map is locally injective, the answer equals that of TetVolume.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "reference/definitions/tet_walk.hpp"
#include "reference/definitions/volume_faces.hpp"

namespace ogc::reference {

/// Holds the data of a volume's tetrahedra that do not depend on the tested point. Holds views; their owners must
/// outlive this.
class Solid {
 public:
  /// `mesh` has the volume's triangles. Finds the boundary triangles of the tetrahedra among them, by their vertices.
  Solid(const Complex& mesh, std::span<const Tetrahedron> tetrahedra);

  /// Returns whether the triangle belongs to exactly one tetrahedron.
  bool is_boundary(Index triangle) const { return owner_[static_cast<std::size_t>(triangle)] >= 0; }
  /// Returns the tetrahedron of a boundary triangle, or −1.
  Index owner(Index triangle) const { return owner_[static_cast<std::size_t>(triangle)]; }
  std::span<const Tetrahedron> tetrahedra() const { return tetrahedra_; }
  const std::vector<Index>& tetrahedra_of(Index vertex) const {
    return tetrahedra_of_[static_cast<std::size_t>(vertex)];
  }
  /// Returns the index of the vertex's component in joined_components.
  Index component(Index vertex) const { return component_[static_cast<std::size_t>(vertex)]; }
  /// Returns whether the volume is positive, exactly.
  bool is_positive(Index t) const { return sign_[static_cast<std::size_t>(t)] > 0; }
  /// Returns whether rounding could change the sign of the volume.
  bool is_doubtful(Index t) const { return doubtful_[static_cast<std::size_t>(t)] != 0; }
  /// Returns false if the tetrahedron behind the triangle opposite to this corner certainly has a positive volume.
  /// Otherwise a way may end at this triangle.
  bool is_closed(Index t, std::size_t corner) const;
  /// Returns the triangle opposite to a corner; its normal is outward if the volume is positive.
  compare::Triangle side(Index t, std::size_t corner) const;

 private:
  std::span<const Tetrahedron> tetrahedra_;
  std::vector<Index> component_;                   ///< by vertex
  std::vector<std::vector<Index>> tetrahedra_of_;  ///< by vertex, ascending
  /// by tetrahedron and corner: the tetrahedron that shares the opposite triangle, or −1
  std::vector<std::array<Index, 4>> behind_;
  std::vector<Index> owner_;  ///< by triangle
  std::vector<int> sign_;
  std::vector<std::uint8_t> doubtful_;
};

/// Tests one point against one part of tetrahedra.
class SolidPart : public VolumeFaces {
 public:
  /// Copies the point and its distances to all triangles from `faces`.
  SolidPart(const VolumeFaces& faces, const Solid& solid) : VolumeFaces(faces), solid_(solid) {}

  /// Returns the accepted answers for the part with these boundary triangles.
  compare::VolumePartTruth part(const std::vector<Index>& triangles);

 private:
  /// A segment relative to a tetrahedron of volume V. Holds 6V times the barycentric weights of both ends, and for each
  /// weight the largest error that still counts as rounding.
  struct Passage;
  /// Sheets that rounding could merge into one.
  struct Group {
    std::vector<Index> tetrahedra;           ///< tetrahedra that hold x or may hold it
    std::vector<std::vector<Index>> sheets;  ///< exact sheets, each as a list of its tetrahedra
    bool is_certain = true;
  };
  /// Describes whether a group has a way to a face.
  struct Way {
    bool possible = false, certain = false;
    std::vector<Index> reached;  ///< tetrahedra through which the way may go
  };

  Passage passage(Index t, const compare::Vec3& offset, double condition) const;
  std::vector<Group> groups(Index component) const;
  Way way(const Group& group, Face face, double condition) const;
  bool is_exact_way(const std::vector<Index>& sheet, const Way& way, Face face, Index triangle) const;
  compare::VolumeSheetTruth sheets_of(const Group& group, const std::vector<Index>& triangles);
  compare::Vec3 foot(Face face) const;
  bool is_vague(Face face) const override;

  const Solid& solid_;
};

}  // namespace ogc::reference
