// A failing case made small enough to be looked at: primitives are dropped, then coordinates get fewer digits, as long
// as the case still fails.
#pragma once

#include <functional>
#include <string>

#include "compare/judge/cases.hpp"
#include "compare/problem/contestant.hpp"

namespace ogc::compare {

struct ShrinkOptions {
  std::size_t tries = 4000;  ///< cases asked at most
  double seconds = 3;        ///< no case is begun after so long
};

/// Number of triangles and edges without a triangle; 0 for cases that are no mesh.
std::size_t primitive_count(const CaseData& data);

/// The smaller case, under the same name. `fails` says whether a candidate fails as the given one does. Cases of
/// detect_vertex_facet, detect_edge_edge and bound lose triangles and loose edges, with the vertices that nothing holds
/// any more; then, as in closest_face and closest_points, coordinates and radii are set to 0 or to the fewest binary
/// digits that keep the failure. All others come back as they are.
TestCase shrink(const TestCase& test, const std::function<bool(const TestCase&)>& fails,
                const ShrinkOptions& options = {});

/// The same for a mismatch: a candidate fails where the judge finds one of the same kind, whatever its numbers.
TestCase shrink_failure(const TestCase& test, const std::string& message, const Contestant& contestant,
                        const Authority& authority, const ShrinkOptions& options = {});

}  // namespace ogc::compare
