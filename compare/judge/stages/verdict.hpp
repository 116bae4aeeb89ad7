// Declares the verdicts: given the question, the truth and an answer, a verdict writes what is wrong into a tally. Each
// stage has one function; cases[i].name names case i.
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

/// Checks that the feature is accepted, that weights and distances lie within their tolerances, and that distance_below
/// is never above the exact distance.
void judge_closest_face(Cases cases, const ClosestFaceIn& in, const ClosestFaceTruth& truth, const ClosestFaceOut& out,
                        Tally& tally);
/// Checks that the triple of features and nearly-parallel flag is accepted. Where it is not the exact one, the contact
/// points may lie elsewhere: the verdict then looks at their ranges and the one-sided distance alone.
void judge_closest_points(Cases cases, const ClosestPointsIn& in, const ClosestPointsTruth& truth,
                          const ClosestPointsOut& out, Tally& tally);
void judge_activation(Cases cases, const ActivationIn& in, const ActivationTruth& truth, const ActivationOut& out,
                      Tally& tally);
/// Judges one vertex that was truncated; `metric` is the number of the position's error.
void judge_position(const Vec3f& previous, const Vec3f& asked, float bound, const Vec3& exact, const Vec3f& stored,
                    bool cut, std::size_t metric, Tally& tally);
/// Checks that the stored position obeys the bound exactly; the judge decides this itself.
void judge_truncate(Cases cases, const TruncateIn& in, const TruncateTruth& truth, const TruncateOut& out,
                    Tally& tally);

/// Returns the question of stage truncate about an answer: X_prev, the stored y (X_prev where y is not finite) and the
/// bound.
TruncateIn cut_question(const InitialGuessIn& in, const InitialGuessOut& out);
/// Checks that the frames of the question's segments lie within their tolerances.
void judge_turns(Cases cases, const InitialGuessIn& in, const InitialGuessTruth& truth, const InitialGuessOut& out,
                 Tally& tally);
/// Judges y, and position and cut by `cut`, the truth about cut_question, as in truncate.
void judge_initial_guess(Cases cases, const InitialGuessIn& in, const InitialGuessTruth& truth,
                         const TruncateTruth& cut, const InitialGuessOut& out, Tally& tally);

/// Checks that force and block lie within the tolerances of one and the same accepted answer.
void judge_force(Cases cases, const ForceTruth& truth, const ForceOut& out, Tally& tally);

/// Checks that stencils and bodies are equal and numbers lie within their tolerances; an angle that cannot be told from
/// ±π may have either sign.
void judge_rest_state(const TestCase& test, const RestStateTruth& truth, const RestStateOut& out, Tally& tally);
/// Checks that answers are equal outside the grey questions.
void judge_block(const TestCase& test, const BlockTruth& truth, const BlockOut& out, Tally& tally);

/// Check that sets are equal outside the grey decisions, and that smallest distances are never above the exact ones.
void judge_detect_vertex_facet(const TestCase& test, const DetectVertexFacetTruth& truth,
                               const DetectVertexFacetOut& out, Tally& tally);
void judge_detect_edge_edge(const TestCase& test, const DetectEdgeEdgeTruth& truth, const DetectEdgeEdgeOut& out,
                            Tally& tally);
/// Checks whether the truth can follow the answer: it has one finite position for each vertex. Reports a mismatch where
/// not.
bool can_judge_sweep(const TestCase& test, const SweepIn& in, const SweepOut& out, Tally& tally);
/// Checks that each stored position obeys its bound exactly, which the judge decides itself, and that it lies within
/// what is accepted of the truth about this answer.
void judge_sweep(const TestCase& test, const SweepIn& in, const SweepTruth& truth, const SweepOut& out, Tally& tally);

/// Checks that events follow one another as Algorithm 3 prescribes. Each event is judged by its own stage (the
/// authority is asked about it), from the answer's own state before it.
void judge_step(const TestCase& test, const StepIn& in, const StepTruth& truth, const StepOut& out,
                const Authority& authority, Tally& tally);
/// Checks whether each array by vertex has one entry a vertex. Reports a mismatch where not.
bool can_judge_step(const TestCase& test, const StepIn& in, const StepOut& out, Tally& tally);
/// Checks whether the truth can follow the answer: one row and one ball for each vertex, finite numbers, and planes of
/// pairs that their vertex is part of. Reports a mismatch where not.
bool can_judge_plane(const TestCase& test, const PlaneIn& in, const PlaneOut& out, Tally& tally);
/// Checks that every pair is held apart, and no vertex held back by more than that needs.
void judge_plane(const TestCase& test, const PlaneIn& in, const PlaneTruth& truth, const PlaneOut& out, Tally& tally);
/// Judges each part by itself. A point inside a part of triangles has one accepted contact. A point outside has all
/// contacts that are certain, and no others than possible ones. In a part of tetrahedra each certain sheet with a path
/// to the boundary has its contact. Numbers must lie within their tolerances.
void judge_volume_depth(const TestCase& test, const VolumeDepthTruth& truth, const VolumeDepthOut& out, Tally& tally);
/// Checks that bounds are never above γ_p · min(…).
void judge_bound(const TestCase& test, const BoundTruth& truth, const BoundOut& out, Tally& tally);

}  // namespace ogc::compare
