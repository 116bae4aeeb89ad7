// The judge's way in: each stage as a function from its In to its Out that runs the very kernels and launches of the
// simulation.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compare/contestant.hpp"
#include "fast/kernels/activation.hpp"
#include "fast/kernels/closest_points.hpp"
#include "fast/kernels/truncate.hpp"
#include "fast/stages/contact_engine.hpp"
#include "fast/stages/probe_block.hpp"
#include "fast/stages/probe_contacts.hpp"
#include "fast/stages/probe_forces.hpp"
#include "fast/stages/probe_guess.hpp"
#include "fast/stages/probe_memory.hpp"
#include "fast/stages/probe_step.hpp"
#include "fast/stages/probe_sweep.hpp"
#include "fast/stages/rest_state.hpp"

namespace ogc::fast {

struct ProbeClosestFace {
  const Vec* points;
  const Corners* triangles;
  TriangleFeature* feature;
  Vec* weights;
  float *distance, *distance_below;

  OGC_HD void operator()(int i) const {
    const Distance d = point_triangle_distance(points[i], triangles[i]);
    feature[i] = closest_feature(points[i], triangles[i]);
    weights[i] = closest_weights(points[i], triangles[i], feature[i]);
    distance[i] = static_cast<float>(d.value);
    distance_below[i] = d.below();
  }
};

template <class Backend>
compare::ClosestFaceOut probe_closest_face(Backend& backend, const compare::ClosestFaceIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ClosestFaceOut out;
  const std::size_t n = in.point.size();
  backend.for_each(
      static_cast<int>(n),
      ProbeClosestFace{memory.template in<Vec>(in.point), memory.template in<Corners>(in.triangle),
                       memory.template out<TriangleFeature>(out.feature, n), memory.template out<Vec>(out.weights, n),
                       memory.template out<float>(out.distance, n), memory.template out<float>(out.distance_below, n)});
  memory.fetch();
  return out;
}

struct StoredParameters {
  float first, second;
};

struct ProbeClosestPoints {
  const Ends *first, *second;
  EdgeFeature *first_feature, *second_feature;
  std::uint8_t* nearly_parallel;
  StoredParameters* parameters;
  float *contact_distance, *distance_below;

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

template <class Backend>
compare::ClosestPointsOut probe_closest_points(Backend& backend, const compare::ClosestPointsIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ClosestPointsOut out;
  const std::size_t n = in.first.size();
  backend.for_each(static_cast<int>(n),
                   ProbeClosestPoints{memory.template in<Ends>(in.first), memory.template in<Ends>(in.second),
                                      memory.template out<EdgeFeature>(out.first_feature, n),
                                      memory.template out<EdgeFeature>(out.second_feature, n),
                                      memory.template out<std::uint8_t>(out.nearly_parallel, n),
                                      memory.template out<StoredParameters>(out.parameters, n),
                                      memory.template out<float>(out.contact_distance, n),
                                      memory.template out<float>(out.distance_below, n)});
  memory.fetch();
  return out;
}

template <class Backend>
ContactSets probe_detection(Backend& backend, const compare::DetectIn& in) {
  BackendContactEngine<Backend> engine(backend, *in.topology, in.exclusions);
  return engine.find(in.positions, {.contact_radius = in.contact_radius, .query_radius = in.query_radius});
}

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
  backend.for_each(view.vertex_count, ConservativeBound{view, distances(in.d_min_vertex), distances(in.d_min_edge),
                                                        distances(in.d_min_triangle), in.bound_relaxation,
                                                        memory.template in<int>(no_overflow),
                                                        memory.template out<float>(out.bound, in.d_min_vertex.size())});
  memory.fetch();
  return out;
}

struct ProbeActivation {
  const float *distance, *contact_radius, *stiffness;
  const ContactActivation* activation;
  float *energy, *slope, *curvature;

  OGC_HD void operator()(int i) const {
    const ActivationSlope at = activation_slope(activation[i], distance[i], contact_radius[i], stiffness[i]);
    energy[i] = activation_energy(activation[i], distance[i], contact_radius[i], stiffness[i]);
    slope[i] = at.slope;
    curvature[i] = at.curvature;
  }
};

template <class Backend>
compare::ActivationOut probe_activation(Backend& backend, const compare::ActivationIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ActivationOut out;
  const std::size_t n = in.distance.size();
  backend.for_each(
      static_cast<int>(n),
      ProbeActivation{memory.template in<float>(in.distance), memory.template in<float>(in.contact_radius),
                      memory.template in<float>(in.stiffness), memory.template in<ContactActivation>(in.activation),
                      memory.template out<float>(out.energy, n), memory.template out<float>(out.slope, n),
                      memory.template out<float>(out.curvature, n)});
  memory.fetch();
  return out;
}

struct ProbeTruncate {
  const Vec *previous, *position;
  const float* bound;
  Vec* result;
  std::uint8_t* exceeded;

  OGC_HD void operator()(int i) const {
    const Truncated cut = truncate(previous[i], position[i], bound[i]);
    result[i] = cut.position;
    exceeded[i] = cut.exceeded;
  }
};

template <class Backend>
compare::TruncateOut probe_truncate(Backend& backend, const compare::TruncateIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::TruncateOut out;
  const std::size_t n = in.position.size();
  backend.for_each(static_cast<int>(n),
                   ProbeTruncate{memory.template in<Vec>(in.previous), memory.template in<Vec>(in.position),
                                 memory.template in<float>(in.bound), memory.template out<Vec>(out.position, n),
                                 memory.template out<std::uint8_t>(out.cut, n)});
  memory.fetch();
  return out;
}

/// A contestant with the stages of this header; `start` is left to the backend's own file. A step takes a backend of
/// its own.
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
  contestant.activation = [backend](const compare::ActivationIn& in) { return probe_activation(*backend, in); };
  contestant.truncate = [backend](const compare::TruncateIn& in) { return probe_truncate(*backend, in); };
  contestant.membrane = [backend](const compare::MembraneIn& in) { return probe_membrane(*backend, in); };
  contestant.bending = [backend](const compare::BendingIn& in) { return probe_bending(*backend, in); };
  contestant.spring = [backend](const compare::SpringIn& in) { return probe_spring(*backend, in); };
  contestant.tetrahedron = [backend](const compare::TetrahedronIn& in) { return probe_tetrahedron(*backend, in); };
  contestant.contact_force = [backend](const compare::ContactForceIn& in) { return probe_contact_force(*backend, in); };
  contestant.friction_force = [backend](const compare::FrictionForceIn& in) {
    return probe_friction_force(*backend, in);
  };
  contestant.block = [backend](const compare::BlockIn& in) { return probe_block(*backend, in); };
  contestant.initial_guess = [backend](const compare::InitialGuessIn& in) { return probe_initial_guess(*backend, in); };
  contestant.rest_state = [](const compare::RestStateIn& in) { return rest_state_out(in); };
  contestant.sweep = [backend](const compare::SweepIn& in) { return probe_sweep(*backend, in); };
  contestant.step = [fresh](const compare::StepIn& in) { return probe_step<Backend>(in, 0, fresh()); };
  return contestant;
}

}  // namespace ogc::fast
