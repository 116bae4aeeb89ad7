// Finds, without rounding, the pair at each smallest distance (Eq. 22, 24 and 26). The squared distance of a pair is an
// exact fraction, so any bound can be compared with it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/stages/detect.hpp"
#include "reference/geometry/margin.hpp"

namespace ogc::reference {

/// The nearest non-adjacent candidate of a primitive; of equally near candidates, the candidate with the lowest index.
/// If none is nearer than r_q, `gap` is r_q and `partner` is −1.
struct Nearest {
  compare::Index partner = -1;  ///< index of the partner, or −1
  Margin gap;                   ///< the distance to the partner, as a margin
};

/// Holds the nearest partners: a triangle for each vertex (Eq. 22), an edge for each edge (Eq. 24), a vertex for each
/// triangle (Eq. 26).
struct NearestPrimitives {
  std::vector<Nearest> vertex, edge, triangle;  ///< by index of the primitive
};

/// Finds the nearest candidates exactly, among the pairs that detections consider (method.md §2.3).
NearestPrimitives nearest_primitives(const compare::DetectIn& in);

/// Returns for each vertex the smallest of d_min,v, d_min,e of its edges and d_min,t of its triangles (Eq. 21, 23, 25
/// without γ_p).
std::vector<Margin> limiting_distances(const compare::Topology& topology, const NearestPrimitives& nearest);

/// Squared distances [m²] as fractions in lowest terms, "num/den".
struct ExactSquares {
  std::vector<std::string> vertex, edge, triangle;  ///< d_min²
  std::vector<std::string> bound;                   ///< b_v² of Eq. 21
};
/// Returns d_min² of all primitives and b_v² of all vertices as fractions (Eq. 21 to 26); γ_p is `bounds_relaxation`.
ExactSquares exact_squares(const compare::DetectIn& in, float bounds_relaxation);

}  // namespace ogc::reference
