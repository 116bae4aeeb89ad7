// Computes for one point and each triangle of a volume: the distance, whether it is grey, and the contact at each face.
// volume_depth.cpp and solid_depth.cpp use this.
#pragma once

#include <vector>

#include "compare/stages/closest_face.hpp"
#include "compare/stages/volume_depth.hpp"
#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// Relates the triangles of a volume to one point x. Holds views; their owners must outlive this.
class VolumeFaces {
 public:
  /// `own` is the index of x if x is a vertex of the volume, otherwise −1. A vertex has no contact with its own faces.
  VolumeFaces(const Complex& mesh, const Vec3f& x, float radius, Index own);
  VolumeFaces(const VolumeFaces&) = default;
  virtual ~VolumeFaces() = default;

  bool grey = false, near = false;  ///< whether some decision up to now is grey, or near a grey one

 protected:
  /// Returns the largest error of the distance to a triangle that still counts as rounding: 16 · 2⁻²⁴ times the larger
  /// of the distance and Σ|δ|. δ are the coordinates relative to the triangle's first corner.
  double doubt(Index t) const;
  /// The smallest distance to triangles, and all triangles that may be at this distance.
  struct Candidates {
    double least;
    std::vector<Index> triangles;
  };
  Candidates nearest_of(const std::vector<Index>& triangles) const;
  bool is_on_surface(const std::vector<Index>& candidates) const;
  Face exactly_nearest(const std::vector<Index>& triangles) const;
  Face face_of(Index t, int feature) const;
  /// Returns the faces that may be nearest, the exactly nearest first. A face of a candidate t may be nearest in two
  /// cases:
  ///  - Every triangle around the face accepts it. (A triangle that does not accept the face is nearer.)
  ///  - t accepts it, and t is farther than `least` by at most 4 · 16 · 2⁻²⁴ doubt(t).
  /// An error of 16 · 2⁻²⁴ of the closest point changes the distance by at most the square of this error. The limit is
  /// four times the square, because distances in double are known only to half of the limit.
  std::vector<Face> possible_faces(const std::vector<Index>& candidates, Face nearest, double least) const;
  std::vector<Index> around(Face face) const;
  bool is_rim(Face face) const;
  bool contains(Face face, Index vertex) const;
  /// Returns whether x is on the face's inner side. `nearest_inside` is the answer for the exactly nearest face
  /// `nearest`.
  bool is_inside(Face face, Face nearest, bool nearest_inside, const std::vector<Index>& candidates) const;
  /// Returns whether the answers inside and outside are both accepted at this face, because a tetrahedron at the face
  /// may not have a positive volume.
  virtual bool is_vague(Face) const { return false; }
  /// Adds the contacts that x may have if x is outside: one for each face whose outward block may hold x. `faces_in` is
  /// whether x is on the inner side of `nearest`, the nearest face.
  void touch(const std::vector<Index>& triangles, Face nearest, bool faces_in, compare::VolumePartTruth& truth);
  /// Adds a contact at a face, unless it is already listed or x is certainly farther than r.
  void add_touching(Face face, compare::VolumePartTruth& truth) const;
  compare::VolumeAnswer answer(Face face, bool inside) const;
  /// Returns an upper limit of the sensitivity Σ‖∂n̂/∂δ‖‖δ‖ of the unit normal n̂, at least 1. δ are two edges e₁ and
  /// e₂ of the triangle; each contributes ‖e₁‖‖e₂‖/‖e₁ × e₂‖.
  double normal_scale(Index t) const;

  const Complex& mesh_;
  const Vec3f& x_;
  float radius_;
  Index own_;
  compare::ClosestFaceTruth faces_;  ///< by triangle

 private:
  double spread(Index t) const;
  bool accepts(Index t, Face face) const;
  bool share_vertex(Face a, Face b) const;
};

}  // namespace ogc::reference
