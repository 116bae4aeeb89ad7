// Stage volume_depth for parts of tetrahedra: sheets and their shortest ways to the boundary (§3.9, after Chen, Diaz
// and Yuksel 2023), in a body some of whose tetrahedra may have no volume. Where all have, and the map is locally
// injective, the answer is that of TetVolume.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "reference/definitions/tet_walk.hpp"
#include "reference/definitions/volume_faces.hpp"

namespace ogc::reference {

/// The tetrahedra of a volume, seen from no point yet. Views; they must outlive it.
class Solid {
 public:
  /// `mesh`: the volume's triangles; those that are the boundary of tetrahedra are told by their vertices.
  Solid(const Complex& mesh, std::span<const Tetrahedron> tetrahedra);

  /// Whether the triangle is one of a tetrahedron.
  bool is_boundary(Index triangle) const { return owner_[static_cast<std::size_t>(triangle)] >= 0; }
  /// Whose boundary triangle it is.
  Index owner(Index triangle) const { return owner_[static_cast<std::size_t>(triangle)]; }
  std::span<const Tetrahedron> tetrahedra() const { return tetrahedra_; }
  const std::vector<Index>& tetrahedra_of(Index vertex) const {
    return tetrahedra_of_[static_cast<std::size_t>(vertex)];
  }
  /// joined_components of a vertex.
  Index component(Index vertex) const { return component_[static_cast<std::size_t>(vertex)]; }
  /// Exactly.
  bool is_positive(Index t) const { return sign_[static_cast<std::size_t>(t)] > 0; }
  /// The volume could have the other sign, or none.
  bool is_doubtful(Index t) const { return doubtful_[static_cast<std::size_t>(t)] != 0; }
  /// A way through this triangle of a tetrahedron ends for certain or perhaps: no positive one lies behind it.
  bool is_closed(Index t, std::size_t corner) const;
  /// The triangle opposite to a corner, outward where the volume is positive.
  compare::Triangle side(Index t, std::size_t corner) const;

 private:
  std::span<const Tetrahedron> tetrahedra_;
  std::vector<Index> component_;                   ///< by vertex
  std::vector<std::vector<Index>> tetrahedra_of_;  ///< by vertex, ascending
  std::vector<std::array<Index, 4>> behind_;  ///< by tetrahedron and corner: who shares the opposite triangle, or −1
  std::vector<Index> owner_;                  ///< by triangle
  std::vector<int> sign_;
  std::vector<std::uint8_t> doubtful_;
};

/// One point before a part of tetrahedra.
class SolidPart : public VolumeFaces {
 public:
  /// `faces`: of the same point.
  SolidPart(const VolumeFaces& faces, const Solid& solid) : VolumeFaces(faces), solid_(solid) {}

  compare::VolumePartTruth part(const std::vector<Index>& triangles);

 private:
  /// A tetrahedron on a segment: six times the weights of both ends, and what each is off at most where it is grey.
  struct Passage;
  /// Sheets that cannot be told apart, by their tetrahedra.
  struct Group {
    std::vector<Index> tetrahedra;           ///< that hold x, or perhaps
    std::vector<std::vector<Index>> sheets;  ///< the exact ones
    bool is_certain = true;
  };
  /// Whether a group has a way to a face.
  struct Way {
    bool possible = false, certain = false;
    std::vector<Index> reached;  ///< tetrahedra that it may pass
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
