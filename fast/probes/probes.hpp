// Lets the judge test each stage. For each stage, a function takes its In, runs the kernels and launches of the
// simulation, and returns its Out.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/stages/activation.hpp"
#include "compare/stages/bound.hpp"
#include "fast/kernels/closest_points.hpp"
#include "fast/kernels/models/activation.hpp"
#include "fast/kernels/truncate.hpp"
#include "fast/probes/contact_engine.hpp"
#include "fast/probes/probe_block.hpp"
#include "fast/probes/probe_contacts.hpp"
#include "fast/probes/probe_forces.hpp"
#include "fast/probes/probe_guess.hpp"
#include "fast/probes/probe_memory.hpp"
#include "fast/probes/probe_planes.hpp"
#include "fast/probes/probe_rods.hpp"
#include "fast/probes/probe_step.hpp"
#include "fast/probes/probe_sweep.hpp"
#include "fast/probes/probe_volumes.hpp"
#include "fast/stages/rest_state.hpp"

namespace ogc::fast {

/// Computes for a point and a triangle the closest face, its weights, the distance and a lower bound of the distance.
/// Runs once for each case.
struct ProbeClosestFace {
  const Vec* points;                 ///< by case [m]
  const Corners* triangles;          ///< by case [m]
  TriangleFeature* feature;          ///< by case, written
  Vec* weights;                      ///< by case: barycentric, written
  float *distance, *distance_below;  ///< by case [m], written; the second is never above the exact distance

  OGC_HD void operator()(int i) const {
    const Distance d = point_triangle_distance(points[i], triangles[i]);
    feature[i] = closest_feature(points[i], triangles[i]);
    weights[i] = closest_weights(points[i], triangles[i], feature[i]);
    distance[i] = static_cast<float>(d.value);
    distance_below[i] = d.below();
  }
};

/// Answers the stage `closest_face`.
template <class Backend>
compare::ClosestFaceOut probe_closest_face(Backend& backend, const compare::ClosestFaceIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ClosestFaceOut out;
  const std::size_t n = in.point.size();
  backend.for_each(static_cast<int>(n),
                   ProbeClosestFace{.points = memory.template in<Vec>(in.point),
                                    .triangles = memory.template in<Corners>(in.triangle),
                                    .feature = memory.template out<TriangleFeature>(out.feature, n),
                                    .weights = memory.template out<Vec>(out.weights, n),
                                    .distance = memory.template out<float>(out.distance, n),
                                    .distance_below = memory.template out<float>(out.distance_below, n)});
  memory.fetch();
  return out;
}

/// Holds parameters with the layout of compare::ClosestPointsOut.
struct StoredParameters {
  float first, second;
};

/// Computes for two edges their closest features, the parameters of the contact points, the distance of these points,
/// and a lower bound of the edges' distance. Runs once for each case.
struct ProbeClosestPoints {
  const Ends *first, *second;                   ///< by case [m]
  EdgeFeature *first_feature, *second_feature;  ///< by case, written
  std::uint8_t* nearly_parallel;                ///< by case: 1 if the edges are nearly parallel and overlap, written
  StoredParameters* parameters;                 ///< by case, written
  float *contact_distance, *distance_below;     ///< by case [m], written; the second is never above the exact distance

  OGC_HD void operator()(int i) const {
    const Ends &p = first[i], &q = second[i];
    EdgePairFeatures on = closest_edge_features(p, q);
    if (is_overlapping_parallel(p, q)) on = {EdgeFeature::interior, EdgeFeature::interior, true};
    const EdgeParameters at = contact_parameters(p, q, on);
    first_feature[i] = on.first;
    second_feature[i] = on.second;
    nearly_parallel[i] = on.nearly_parallel;
    parameters[i] = {static_cast<float>(at.first), static_cast<float>(at.second)};
    contact_distance[i] = static_cast<float>(points_distance(p, q, at));
    distance_below[i] = edge_edge_distance(p, q).below();
  }
};

/// Answers the stage `closest_points`.
template <class Backend>
compare::ClosestPointsOut probe_closest_points(Backend& backend, const compare::ClosestPointsIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ClosestPointsOut out;
  const std::size_t n = in.first.size();
  backend.for_each(static_cast<int>(n),
                   ProbeClosestPoints{.first = memory.template in<Ends>(in.first),
                                      .second = memory.template in<Ends>(in.second),
                                      .first_feature = memory.template out<EdgeFeature>(out.first_feature, n),
                                      .second_feature = memory.template out<EdgeFeature>(out.second_feature, n),
                                      .nearly_parallel = memory.template out<std::uint8_t>(out.nearly_parallel, n),
                                      .parameters = memory.template out<StoredParameters>(out.parameters, n),
                                      .contact_distance = memory.template out<float>(out.contact_distance, n),
                                      .distance_below = memory.template out<float>(out.distance_below, n)});
  memory.fetch();
  return out;
}

/// Answers the stages `detect_vertex_facet` and `detect_edge_edge` at once.
template <class Backend>
ContactSets probe_detection(Backend& backend, const compare::DetectIn& in) {
  BackendContactEngine<Backend> engine(backend, *in.topology, in.exclusions);
  return engine.find(in.positions, {.contact_radius = in.contact_radius, .query_radius = in.query_radius});
}

/// Answers the stage `bound`.
template <class Backend>
compare::BoundOut probe_bound(Backend& backend, const compare::BoundIn& in) {
  const Surface<Backend> surface(*in.topology, {});
  const SurfaceView view = surface.view();
  ProbeMemory<Backend> memory(backend);
  compare::BoundOut out;
  const std::vector<int> no_overflow{0};
  const auto distances = [&memory](std::span<const float> d) {
    return memory.template in<float>(std::vector<float>(d.begin(), d.end()));
  };
  backend.for_each(view.vertex_count,
                   ConservativeBound{.surface = view,
                                     .d_min_vertex = distances(in.d_min_vertex),
                                     .d_min_edge = distances(in.d_min_edge),
                                     .d_min_triangle = distances(in.d_min_triangle),
                                     .bounds_relaxation = in.bounds_relaxation,
                                     .overflow = memory.template in<int>(no_overflow),
                                     .bound = memory.template out<float>(out.bound, in.d_min_vertex.size())});
  memory.fetch();
  return out;
}

/// Computes the energy of an activation and its derivatives. Runs once for each case.
struct ProbeActivation {
  const float *distance, *contact_radius, *stiffness;  ///< by case: d, r [m], k_c [N/m]
  const AnyActivation* activation;                     ///< by case
  float *energy, *slope, *curvature;                   ///< by case: g [J], g' [N], g'' [N/m], written

  OGC_HD void operator()(int i) const {
    const ActivationSlope at = activation[i].slope(distance[i], contact_radius[i], stiffness[i]);
    energy[i] = activation[i].energy(distance[i], contact_radius[i], stiffness[i]);
    slope[i] = at.slope;
    curvature[i] = at.curvature;
  }
};

/// Answers the stage `activation`.
template <class Backend>
compare::ActivationOut probe_activation(Backend& backend, const compare::ActivationIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ActivationOut out;
  const std::size_t n = in.distance.size();
  backend.for_each(static_cast<int>(n), ProbeActivation{.distance = memory.template in<float>(in.distance),
                                                        .contact_radius = memory.template in<float>(in.contact_radius),
                                                        .stiffness = memory.template in<float>(in.stiffness),
                                                        .activation = memory.template in<AnyActivation>(in.activation),
                                                        .energy = memory.template out<float>(out.energy, n),
                                                        .slope = memory.template out<float>(out.slope, n),
                                                        .curvature = memory.template out<float>(out.curvature, n)});
  memory.fetch();
  return out;
}

/// Truncates a proposal. Runs once for each case.
struct ProbeTruncate {
  FeasibleRegions regions;  ///< balls only, by case
  const Vec* position;      ///< proposals by case [m]
  Vec* result;              ///< by case [m], written
  std::uint8_t* cut;        ///< by case: 1 if the proposal was changed, written

  OGC_HD void operator()(int i) const {
    const Truncated kept = truncate(regions.ball(i), position[i]);
    result[i] = kept.position;
    cut[i] = kept.cut;
  }
};

/// Answers the stage `truncate`.
template <class Backend>
compare::TruncateOut probe_truncate(Backend& backend, const compare::TruncateIn& in) {
  if (!in.half_spaces.offsets.empty()) return probe_regions(backend, in);
  ProbeMemory<Backend> memory(backend);
  compare::TruncateOut out;
  const std::size_t n = in.position.size();
  const FeasibleRegions regions{memory.template in<Vec>(in.previous), memory.template in<float>(in.bound)};
  backend.for_each(static_cast<int>(n), ProbeTruncate{regions, memory.template in<Vec>(in.position),
                                                      memory.template out<Vec>(out.position, n),
                                                      memory.template out<std::uint8_t>(out.cut, n)});
  memory.fetch();
  return out;
}

/// Returns a contestant with the stages of this header. The backend's own source sets Contestant::start. Each step gets
/// a new backend from `fresh`.
template <class Backend, class Fresh = Backend (*)()>
compare::Contestant probe_contestant(
    std::string name, std::shared_ptr<Backend> backend, Fresh fresh = [] { return Backend{}; }) {
  compare::Contestant contestant;
  contestant.name = std::move(name);
  contestant.closest_face = [backend](const compare::ClosestFaceIn& in) { return probe_closest_face(*backend, in); };
  contestant.closest_points = [backend](const compare::ClosestPointsIn& in) {
    return probe_closest_points(*backend, in);
  };
  contestant.detect_vertex_facet = [backend](const compare::DetectIn& in) {
    ContactSets sets = probe_detection(*backend, in);
    return compare::DetectVertexFacetOut{std::move(sets.vertex_facet), std::move(sets.d_min_vertex),
                                         std::move(sets.d_min_triangle)};
  };
  contestant.detect_edge_edge = [backend](const compare::DetectIn& in) {
    ContactSets sets = probe_detection(*backend, in);
    return compare::DetectEdgeEdgeOut{std::move(sets.edge_edge), std::move(sets.d_min_edge)};
  };
  contestant.bound = [backend](const compare::BoundIn& in) { return probe_bound(*backend, in); };
  contestant.plane = [backend](const compare::PlaneIn& in) { return probe_plane(*backend, in); };
  contestant.activation = [backend](const compare::ActivationIn& in) { return probe_activation(*backend, in); };
  contestant.truncate = [backend](const compare::TruncateIn& in) { return probe_truncate(*backend, in); };
  contestant.membrane = [backend](const compare::MembraneIn& in) { return probe_membrane(*backend, in); };
  contestant.bending = [backend](const compare::BendingIn& in) { return probe_bending(*backend, in); };
  contestant.spring = [backend](const compare::SpringIn& in) { return probe_spring(*backend, in); };
  contestant.tetrahedron = [backend](const compare::TetrahedronIn& in) { return probe_tetrahedron(*backend, in); };
  contestant.rod = [backend](const compare::RodIn& in) { return probe_rod(*backend, in); };
  contestant.orientation = [backend](const compare::OrientationIn& in) { return probe_orientation(*backend, in); };
  contestant.contact_force = [backend](const compare::ContactForceIn& in) { return probe_contact_force(*backend, in); };
  contestant.friction_force = [backend](const compare::FrictionForceIn& in) {
    return probe_friction_force(*backend, in);
  };
  contestant.volume_depth = [backend](const compare::VolumeDepthIn& in) { return probe_volume_depth(*backend, in); };
  contestant.volume_force = [backend](const compare::VolumeForceIn& in) { return probe_volume_force(*backend, in); };
  contestant.block = [backend](const compare::BlockIn& in) { return probe_block(*backend, in); };
  contestant.initial_guess = [backend](const compare::InitialGuessIn& in) { return probe_initial_guess(*backend, in); };
  contestant.rest_state = [](const compare::RestStateIn& in) { return rest_state_out(in); };
  contestant.sweep = [backend](const compare::SweepIn& in) { return probe_sweep(*backend, in); };
  contestant.step = [fresh](const compare::StepIn& in) { return probe_step<Backend>(in, 0, fresh()); };
  return contestant;
}

}  // namespace ogc::fast
