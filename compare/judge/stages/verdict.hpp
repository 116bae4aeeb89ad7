// Declares the verdicts. A verdict gets the question, the truth and an answer, and writes what is wrong into a tally.
// Each stage has one function; cases[i].name names case i.
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

/// Checks that the feature is accepted, that weights and distances are within their tolerances, and that distance_below
/// is never above the exact distance.
void judge_closest_face(Cases cases, const ClosestFaceIn& in, const ClosestFaceTruth& truth, const ClosestFaceOut& out,
                        Tally& tally);
/// Checks that the combination of features and nearly-parallel flag is accepted. If the flag differs from the exact
/// one, the contact points differ, too. Then only the ranges of the parameters, `distance_below`, and
/// `contact_distance` ≥ `distance_below` are checked.
void judge_closest_points(Cases cases, const ClosestPointsIn& in, const ClosestPointsTruth& truth,
                          const ClosestPointsOut& out, Tally& tally);
void judge_activation(Cases cases, const ActivationIn& in, const ActivationTruth& truth, const ActivationOut& out,
                      Tally& tally);
/// Judges the position of one truncated vertex; `metric` is the index of the error's metric.
void judge_position(const Vec3f& previous, const Vec3f& asked, float bound, const Vec3& exact, const Vec3f& stored,
                    bool cut, std::size_t metric, Tally& tally);
/// Checks exactly, by the judge's own arithmetic, that the stored position obeys the bound. Also checks `cut` and the
/// position's error.
void judge_truncate(Cases cases, const TruncateIn& in, const TruncateTruth& truth, const TruncateOut& out,
                    Tally& tally);

/// Returns the question of stage truncate about an answer: X_prev, the stored y (X_prev if y is not finite) and the
/// bound.
TruncateIn cut_question(const InitialGuessIn& in, const InitialGuessOut& out);
/// Checks that the frames of the question's segments are within their tolerances.
void judge_turns(Cases cases, const InitialGuessIn& in, const InitialGuessTruth& truth, const InitialGuessOut& out,
                 Tally& tally);
/// Judges y, position and cut. `cut` is the truth of cut_question.
void judge_initial_guess(Cases cases, const InitialGuessIn& in, const InitialGuessTruth& truth,
                         const TruncateTruth& cut, const InitialGuessOut& out, Tally& tally);

/// Checks that force and block are within the tolerances of the same accepted answer.
void judge_force(Cases cases, const ForceTruth& truth, const ForceOut& out, Tally& tally);

/// Checks that stencils and bodies are equal and numbers within their tolerances. An angle that cannot be distinguished
/// from ±π may have either sign.
void judge_rest_state(const TestCase& test, const RestStateTruth& truth, const RestStateOut& out, Tally& tally);
/// Checks that all answers equal the exact ones, except for grey questions.
void judge_block(const TestCase& test, const BlockTruth& truth, const BlockOut& out, Tally& tally);

/// Check that sets are equal except for grey decisions, and that smallest distances are never above the exact ones.
void judge_detect_vertex_facet(const TestCase& test, const DetectVertexFacetTruth& truth,
                               const DetectVertexFacetOut& out, Tally& tally);
void judge_detect_edge_edge(const TestCase& test, const DetectEdgeEdgeTruth& truth, const DetectEdgeEdgeOut& out,
                            Tally& tally);
/// Checks whether the answer has one finite position for each vertex and one finite orientation for each segment, so
/// that the truth about it can be computed. Reports a mismatch if not.
bool can_judge_sweep(const TestCase& test, const SweepIn& in, const SweepOut& out, Tally& tally);
/// Checks exactly, by the judge's own arithmetic, that each stored position obeys its bound. Also checks that each
/// position is accepted by the truth about this answer.
void judge_sweep(const TestCase& test, const SweepIn& in, const SweepTruth& truth, const SweepOut& out, Tally& tally);

/// Checks that the events (detections, guess rounds, sweeps) follow each other as Algorithm 3 prescribes. Each event is
/// judged by its own stage. Its question starts from the answer's state before the event, and the authority answers it.
void judge_step(const TestCase& test, const StepIn& in, const StepTruth& truth, const StepOut& out,
                const Authority& authority, Tally& tally);
/// Checks whether each array by vertex has one entry for each vertex. Reports a mismatch if not.
bool can_judge_step(const TestCase& test, const StepIn& in, const StepOut& out, Tally& tally);
/// Checks whether the answer is complete and valid enough to compute the truth about it; reports a mismatch if not. The
/// answer needs one bound and one row of planes per vertex. A row lists finite planes of pairs that contain the vertex,
/// in ascending order of pairs. The row of a fixed vertex is empty.
bool can_judge_plane(const TestCase& test, const PlaneIn& in, const PlaneOut& out, Tally& tally);
/// Checks that every pair is separated, and that no vertex is restricted more than the separation requires.
void judge_plane(const TestCase& test, const PlaneIn& in, const PlaneTruth& truth, const PlaneOut& out, Tally& tally);
/// Judges each part separately. A point inside a part of triangles must have exactly one contact, an accepted one. A
/// point outside must have all certain contacts, and may have possible ones. In a part of tetrahedra each sheet that
/// certainly exists and has a path to the boundary must have a contact. Numbers must be within their tolerances.
void judge_volume_depth(const TestCase& test, const VolumeDepthTruth& truth, const VolumeDepthOut& out, Tally& tally);
/// Checks that bounds are never above γ_p · min(…).
void judge_bound(const TestCase& test, const BoundTruth& truth, const BoundOut& out, Tally& tally);

}  // namespace ogc::compare
