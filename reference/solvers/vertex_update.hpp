// Computes one vertex update in double precision, and the largest accepted error of a single-precision update.
#pragma once

#include <array>
#include <span>

#include "compare/problem/vector.hpp"
#include "compare/stages/plane.hpp"
#include "reference/solvers/vertex_terms.hpp"

namespace ogc::reference {

/// A free vertex: its positions and its bounds.
struct FreeVertex {
  compare::Vec3f old, target, previous;            ///< x, y, X_prev [m]
  float bound = 0;                                 ///< b_v [m]
  double inertia = 0;                              ///< m/h² [N/m]
  std::span<const compare::VertexPlane> planes{};  ///< half-spaces of the vertex
  bool is_scaled = false;  ///< whether a cut vertex stops on the path from X_prev to its proposal instead of sliding
};

/// Whether truncation changes an update; with `doubtful`, a contestant may count it as cut or not.
enum class Cut { no, yes, doubtful };

/// The truth about the update of one vertex; see SweepTruth.
struct VertexUpdate {
  compare::Vec3 position;
  double accepted = 0;
  bool grey = false;
  Cut cut = Cut::no;
};

/// Returns the truth about `answer`, the contestant's new position of the vertex.
VertexUpdate update_of(const VertexTerms& terms, const FreeVertex& vertex, const compare::Vec3f& answer);

}  // namespace ogc::reference
