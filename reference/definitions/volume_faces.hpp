// A point before the triangles of a volume: how far it is from each, what of that is grey, and what the contact at a
// face of theirs would be. For volume_depth.cpp and solid_depth.cpp.
#pragma once

#include <vector>

#include "compare/stages/closest_face.hpp"
#include "compare/stages/volume_depth.hpp"
#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// Views; what it looks at must outlive it.
class VolumeFaces {
 public:
  /// `own`: the vertex that x is, whose faces it does not touch, or −1.
  VolumeFaces(const Complex& mesh, const Vec3f& x, float radius, Index own);
  VolumeFaces(const VolumeFaces&) = default;
  virtual ~VolumeFaces() = default;

  bool grey = false, near = false;  ///< of anything asked so far

 protected:
  /// What a distance is off at most where it is grey: 16 u of the coordinates relative to the triangle's first corner.
  double doubt(Index t) const;
  /// The smallest distance to triangles, and those that may have it.
  struct Candidates {
    double least;
    std::vector<Index> triangles;
  };
  Candidates nearest_of(const std::vector<Index>& triangles) const;
  bool is_on_surface(const std::vector<Index>& candidates) const;
  Face exactly_nearest(const std::vector<Index>& triangles) const;
  Face face_of(Index t, int feature) const;
  /// The exact one first. A face is possible if every triangle around it says so: where the foot on one of them lies
  /// off the face for certain, that triangle is nearer, by however little. But a foot that is off by 16 u moves a
  /// distance that it is the smallest of by (16 u)² at most, and by less nobody need tell them apart: four times that,
  /// as the distances here are known to half of it.
  std::vector<Face> possible_faces(const std::vector<Index>& candidates, Face nearest, double least) const;
  std::vector<Index> around(Face face) const;
  bool is_rim(Face face) const;
  bool contains(Face face, Index vertex) const;
  /// `nearest_inside`: what the exactly nearest face says.
  bool is_inside(Face face, Face nearest, bool nearest_inside, const std::vector<Index>& candidates) const;
  /// Whether a face has no side that must be told.
  virtual bool is_vague(Face) const { return false; }
  /// Outside: faces in whose outward block x lies nearer than r, for certain or perhaps. `faces_in`: what the nearest
  /// face says.
  void touch(const std::vector<Index>& triangles, Face nearest, bool faces_in, compare::VolumePartTruth& truth);
  /// Unless it is there already, or x lies farther than r for certain.
  void add_touching(Face face, compare::VolumePartTruth& truth) const;
  /// The contact at a face.
  compare::VolumeAnswer answer(Face face, bool inside) const;
  /// Of a normal: Σ‖∂n̂/∂δ‖‖δ‖, δ two sides: ‖e₁‖‖e₂‖/‖e₁ × e₂‖ for each.
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
