// The verdicts: given the question, the truth and an answer, what is wrong. One function a stage, each writing into a tally; `name(i)` names case i.
#pragma once

#include <functional>
#include <span>

#include "compare/judge/tally.hpp"
#include "compare/problem/contestant.hpp"

namespace ogc::compare {

/// Cases of one batch, by position; all of one stage.
using Cases = std::span<const TestCase>;

/// The feature must be accepted, weights and distances within their tolerances, distance_below never above the exact distance.
void judge_closest_face(Cases cases, const ClosestFaceIn& in, const ClosestFaceTruth& truth, const ClosestFaceOut& out, Tally& tally);
/// The triple of features and nearly-parallel flag must be accepted. Where it is not the exact one the contact points may lie elsewhere: then only
/// their ranges and the one-sided distance are judged.
void judge_closest_points(Cases cases, const ClosestPointsIn& in, const ClosestPointsTruth& truth, const ClosestPointsOut& out, Tally& tally);
void judge_activation(Cases cases, const ActivationTruth& truth, const ActivationOut& out, Tally& tally);
/// The stored position must obey the bound exactly, decided by the judge itself.
void judge_truncate(Cases cases, const TruncateIn& in, const TruncateTruth& truth, const TruncateOut& out, Tally& tally);

/// Force and block must lie within the tolerances of one and the same accepted answer.
void judge_force(Cases cases, const ForceTruth& truth, const ForceOut& out, Tally& tally);

/// Sets must be equal outside the grey decisions; smallest distances never above the exact ones.
void judge_detect_vertex_facet(const TestCase& test, const DetectVertexFacetTruth& truth, const DetectVertexFacetOut& out, Tally& tally);
void judge_detect_edge_edge(const TestCase& test, const DetectEdgeEdgeTruth& truth, const DetectEdgeEdgeOut& out, Tally& tally);
/// Never above γ_p · min(…).
void judge_bound(const TestCase& test, const BoundTruth& truth, const BoundOut& out, Tally& tally);

}  // namespace ogc::compare
