// The verdicts: given the question, the truth and an answer, what is wrong. One function a stage, each writing into a
// tally; `name(i)` names case i.
#pragma once

#include <functional>
#include <span>

#include "compare/contestant.hpp"
#include "compare/judge/engine/ask.hpp"
#include "compare/stages/activation.hpp"
#include "compare/stages/bound.hpp"
#include "compare/stages/closest_face.hpp"
#include "compare/stages/closest_points.hpp"
#include "compare/stages/step.hpp"

namespace ogc::compare {

/// The feature must be accepted, weights and distances within their tolerances, distance_below never above the exact
/// distance.
void judge_closest_face(Cases cases, const ClosestFaceIn& in, const ClosestFaceTruth& truth, const ClosestFaceOut& out,
                        Tally& tally);
/// The triple of features and nearly-parallel flag must be accepted. Where it is not the exact one the contact points
/// may lie elsewhere: then the verdict looks at their ranges and the one-sided distance alone.
void judge_closest_points(Cases cases, const ClosestPointsIn& in, const ClosestPointsTruth& truth,
                          const ClosestPointsOut& out, Tally& tally);
void judge_activation(Cases cases, const ActivationIn& in, const ActivationTruth& truth, const ActivationOut& out,
                      Tally& tally);
/// One vertex that truncation has answered about; `metric`: the number of the position's error.
void judge_position(const Vec3f& previous, const Vec3f& asked, float bound, const Vec3& exact, const Vec3f& stored,
                    bool cut, std::size_t metric, Tally& tally);
/// The stored position must obey the bound exactly, decided by the judge itself.
void judge_truncate(Cases cases, const TruncateIn& in, const TruncateTruth& truth, const TruncateOut& out,
                    Tally& tally);

/// The question that stage truncate is asked about an answer: X_prev, the y that is stored (X_prev where that is no
/// point) and the bound.
TruncateIn cut_question(const InitialGuessIn& in, const InitialGuessOut& out);
/// Frames of the question's segments, each within its tolerance.
void judge_turns(Cases cases, const InitialGuessIn& in, const InitialGuessTruth& truth, const InitialGuessOut& out,
                 Tally& tally);
/// `cut`: the truth about cut_question, by which position and cut are judged as in truncate.
void judge_initial_guess(Cases cases, const InitialGuessIn& in, const InitialGuessTruth& truth,
                         const TruncateTruth& cut, const InitialGuessOut& out, Tally& tally);

/// Force and block must lie within the tolerances of one and the same accepted answer.
void judge_force(Cases cases, const ForceTruth& truth, const ForceOut& out, Tally& tally);

/// Stencils and bodies must be equal, numbers within their tolerances; an angle that cannot be told from ±π may have
/// either sign.
void judge_rest_state(const TestCase& test, const RestStateTruth& truth, const RestStateOut& out, Tally& tally);
/// Equal outside the grey questions.
void judge_block(const TestCase& test, const BlockTruth& truth, const BlockOut& out, Tally& tally);

/// Sets must be equal outside the grey decisions; smallest distances never above the exact ones.
void judge_detect_vertex_facet(const TestCase& test, const DetectVertexFacetTruth& truth,
                               const DetectVertexFacetOut& out, Tally& tally);
void judge_detect_edge_edge(const TestCase& test, const DetectEdgeEdgeTruth& truth, const DetectEdgeEdgeOut& out,
                            Tally& tally);
/// Whether the truth can follow the answer: one finite position for each vertex. Where not, a mismatch.
bool can_judge_sweep(const TestCase& test, const SweepIn& in, const SweepOut& out, Tally& tally);
/// Each stored position must obey its bound exactly, decided by the judge itself, and lie within what is accepted of
/// the truth about this answer.
void judge_sweep(const TestCase& test, const SweepIn& in, const SweepTruth& truth, const SweepOut& out, Tally& tally);

/// Events must follow one another as Algorithm 3 says; each is judged by its own stage (the authority is asked about
/// it), from the answer's own state before it.
void judge_step(const TestCase& test, const StepIn& in, const StepTruth& truth, const StepOut& out,
                const Authority& authority, Tally& tally);
/// Whether each array by vertex has one entry a vertex. Where not, a mismatch.
bool can_judge_step(const TestCase& test, const StepIn& in, const StepOut& out, Tally& tally);
/// Whether the truth can follow the answer: one row and one ball for each vertex, finite numbers, planes of pairs that
/// their vertex is part of. Where not, a mismatch.
bool can_judge_plane(const TestCase& test, const PlaneIn& in, const PlaneOut& out, Tally& tally);
/// Every pair must be held apart, and no vertex by more than that.
void judge_plane(const TestCase& test, const PlaneIn& in, const PlaneTruth& truth, const PlaneOut& out, Tally& tally);
/// By part: one contact that is accepted inside, or outside all that are certain and none but those that are possible;
/// numbers within their tolerances.
void judge_volume_depth(const TestCase& test, const VolumeDepthTruth& truth, const VolumeDepthOut& out, Tally& tally);
/// Never above γ_p · min(…).
void judge_bound(const TestCase& test, const BoundTruth& truth, const BoundOut& out, Tally& tally);

}  // namespace ogc::compare
