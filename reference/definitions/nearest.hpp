// Eq. 22, 24 and 26 without rounding: the pair that holds each smallest distance. So the square of the distance is
// known as a fraction, with which any bound can be compared.
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
  Margin gap;                   ///< distance to it
};

/// d_min,v with a triangle as partner (Eq. 22), d_min,e with an edge (Eq. 24), d_min,t with a vertex (Eq. 26), by
/// primitive.
struct NearestPrimitives {
  std::vector<Nearest> vertex, edge, triangle;  ///< by number of the primitive
};

/// Finds them exactly, among the pairs that the detections do not leave out.
NearestPrimitives nearest_primitives(const compare::DetectIn& in);

/// Returns for each vertex the smallest of d_min,v, of d_min,e of its edges and of d_min,t of its triangles (Eq. 21,
/// 23, 25 before γ_p).
std::vector<Margin> limiting_distances(const compare::Topology& topology, const NearestPrimitives& nearest);

/// Squares [m²] as fractions in lowest terms, "num/den".
struct ExactSquares {
  std::vector<std::string> vertex, edge, triangle;  ///< d_min²
  std::vector<std::string> bound;                   ///< b_v² of Eq. 21, γ_p² times the smallest of the above
};
/// Returns d_min² and b_v² of all primitives as fractions, b_v with this γ_p (Eq. 21 to 26).
ExactSquares exact_squares(const compare::DetectIn& in, float bounds_relaxation);

}  // namespace ogc::reference
