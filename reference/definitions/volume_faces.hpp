// A point and the triangles of a volume: how far it is from each, which of that is grey, and the contact at each of
// their faces. For volume_depth.cpp and solid_depth.cpp.
#pragma once

#include <vector>

#include "compare/stages/closest_face.hpp"
#include "compare/stages/volume_depth.hpp"
#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// Holds views; their owners must outlive this.
class VolumeFaces {
 public:
  /// `own`: the vertex that x is, whose faces it does not touch, or −1.
  VolumeFaces(const Complex& mesh, const Vec3f& x, float radius, Index own);
  VolumeFaces(const VolumeFaces&) = default;
  virtual ~VolumeFaces() = default;

  bool grey = false, near = false;  ///< whether any decision so far is grey, or near one

 protected:
  /// Returns the largest error of a distance where it is grey: 16 u of the coordinates relative to the triangle's first
  /// corner.
  double doubt(Index t) const;
  /// The smallest distance to triangles, and the triangles that may have it.
  struct Candidates {
    double least;
    std::vector<Index> triangles;
  };
  Candidates nearest_of(const std::vector<Index>& triangles) const;
  bool is_on_surface(const std::vector<Index>& candidates) const;
  Face exactly_nearest(const std::vector<Index>& triangles) const;
  Face face_of(Index t, int feature) const;
  /// Returns the faces that may be nearest, the exact one first. A face is possible if every triangle around it accepts
  /// it: where the foot on one of them certainly lies off the face, that triangle is nearer, if only slightly. But a
  /// foot that is off by 16 u changes a distance that is smallest there by at most (16 u)², and smaller differences
  /// need not be told apart. The limit is four times that, since distances are known here only to half of it.
  std::vector<Face> possible_faces(const std::vector<Index>& candidates, Face nearest, double least) const;
  std::vector<Index> around(Face face) const;
  bool is_rim(Face face) const;
  bool contains(Face face, Index vertex) const;
  /// `nearest_inside`: whether x is on the inner side of the exactly nearest face.
  bool is_inside(Face face, Face nearest, bool nearest_inside, const std::vector<Index>& candidates) const;
  /// Returns whether either side of a face is accepted.
  virtual bool is_vague(Face) const { return false; }
  /// Adds contacts outside: faces in whose outward block x lies nearer than r, certainly or possibly. `faces_in`:
  /// whether x is on the inner side of the nearest face.
  void touch(const std::vector<Index>& triangles, Face nearest, bool faces_in, compare::VolumePartTruth& truth);
  /// Adds a contact at a face, unless it is listed already or x is certainly farther than r.
  void add_touching(Face face, compare::VolumePartTruth& truth) const;
  /// Returns the contact at a face.
  compare::VolumeAnswer answer(Face face, bool inside) const;
  /// Returns the scale of a normal: Σ‖∂n̂/∂δ‖‖δ‖, δ two sides: ‖e₁‖‖e₂‖/‖e₁ × e₂‖ for each.
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
