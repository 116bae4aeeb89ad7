// One vertex update in double, and how far a right single-precision update may be from it.
#pragma once

#include <array>
#include <span>

#include "compare/problem/vector.hpp"
#include "compare/stages/plane.hpp"
#include "reference/solvers/vertex_terms.hpp"

namespace ogc::reference {

/// Where a free vertex is and what holds it.
struct FreeVertex {
  compare::Vec3f old, target, previous;            ///< x, y, X_prev [m]
  float bound = 0;                                 ///< b_v [m]
  double inertia = 0;                              ///< m/h² [N/m]
  std::span<const compare::VertexPlane> planes{};  ///< that the vertex bears
  bool is_scaled = false;                          ///< it stops on the way from X_prev, in place of sliding
};

/// Whether truncation changes an update; doubtful where both are right.
enum class Cut { no, yes, doubtful };

/// As SweepTruth of one vertex.
struct VertexUpdate {
  compare::Vec3 position;
  double accepted = 0;
  bool grey = false;
  Cut cut = Cut::no;
};

/// The truth about `answer`, the position that an answer holds for the vertex.
VertexUpdate update_of(const VertexTerms& terms, const FreeVertex& vertex, const compare::Vec3f& answer);

}  // namespace ogc::reference
