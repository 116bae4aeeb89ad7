// Eq. 22, 24 and 26 without rounding: which pair holds each smallest distance, so that its square is known as a
// fraction and any bound can be held against it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/stages/detect.hpp"
#include "reference/geometry/margin.hpp"

namespace ogc::reference {

/// The nearest non-adjacent candidate of a primitive; of several equally near ones the lowest-numbered. `gap` is the
/// distance between the two (Margin), or r_q where nothing is nearer; then `partner` is −1.
struct Nearest {
  compare::Index partner = -1;  ///< number of the candidate
  Margin gap;                   ///< the distance to it
};

/// d_min,v with a triangle as partner (Eq. 22), d_min,e with an edge (Eq. 24), d_min,t with a vertex (Eq. 26), by
/// primitive.
struct NearestPrimitives {
  std::vector<Nearest> vertex, edge, triangle;  ///< by number of the primitive
};

/// Decided exactly; what the detections leave out is left out.
NearestPrimitives nearest_primitives(const compare::DetectIn& in);

/// The smallest of d_min,v, of d_min,e of v's edges and of d_min,t of v's triangles, by vertex (Eq. 21, 23, 25 before
/// γ_p).
std::vector<Margin> limiting_distances(const compare::Topology& topology, const NearestPrimitives& nearest);

/// Squares [m²] as fractions in lowest terms, "num/den".
struct ExactSquares {
  std::vector<std::string> vertex, edge, triangle;  ///< d_min²
  std::vector<std::string> bound;                   ///< b_v² of Eq. 21, γ_p² times the smallest of the above
};
/// d_min² and b_v² of all primitives as fractions, b_v with this γ_p (Eq. 21 to 26).
ExactSquares exact_squares(const compare::DetectIn& in, float bound_relaxation);

}  // namespace ogc::reference
