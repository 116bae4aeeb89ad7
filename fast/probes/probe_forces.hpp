// The judge's way in to the energies: each case becomes one incidence of the sweep's streams, made and added by the
// functions that the sweep uses.
#pragma once

#include <algorithm>
#include <vector>

#include "compare/stages/bending.hpp"
#include "compare/stages/membrane.hpp"
#include "compare/stages/spring.hpp"
#include "compare/stages/tetrahedron.hpp"
#include "fast/kernels/initial_guess.hpp"
#include "fast/kernels/sweep/gather.hpp"
#include "fast/probes/probe_memory.hpp"
#include "fast/stages/sweep.hpp"

namespace ogc::fast {

/// The points of a batch of stencils in one array.
template <class Case, std::size_t count>
std::vector<compare::Vec3f> points_of(const std::vector<Case>& cases, std::array<compare::Vec3f, count> Case::*points) {
  std::vector<compare::Vec3f> all;
  for (const Case& c : cases) all.insert(all.end(), (c.*points).begin(), (c.*points).end());
  return all;
}

/// Where a probe leaves force and block of each case, on the backend.
struct ForceArrays {
  Vec* force;         ///< by case: −∂E/∂x [N]
  Symmetric3* block;  ///< by case [N/m]

  /// The sum of case i.
  OGC_HD void store(int i, const ForceAndBlock& sum) const {
    force[i] = sum.force;
    block[i] = sum.block;
  }
};

/// Room on the backend for n cases; ProbeMemory::fetch copies it to `out`.
template <class Backend>
ForceArrays force_arrays(ProbeMemory<Backend>& memory, compare::ForceOut& out, std::size_t n) {
  return {memory.template out<Vec>(out.force, n), memory.template out<Symmetric3>(out.block, n)};
}

/// Each triangle alone; case i has a body of its own. A usual model is added as UsualTriangles do, any other as
/// Triangles do.
struct ProbeMembrane {
  SweepView view;  ///< by case: incidences, materials and models; case i has the vertices 3 i … 3 i + 2
  ForceArrays out;

  OGC_HD void operator()(int i) const {
    ForceAndBlock sum;
    const SurfaceMaterial material = view.materials[i];
    const SurfaceModels models = view.models[i];
    const MembraneIncidence& incidence = view.membrane[i];
    const Vec own = view.old[3 * i];
    if (has_default_membrane(models))
      add_membrane_incidence(incidence, read_membrane(view, incidence, material), material, models.membrane, own, sum);
    else
      add_any_membrane(view, incidence, material, models, {own, own - view.start[3 * i]}, sum);
    out.store(i, sum);
  }
};

/// The stage `membrane`.
template <class Backend>
compare::ForceOut probe_membrane(Backend& backend, const compare::MembraneIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ForceOut out;
  const int n = static_cast<int>(in.cases.size());
  RestState rest;
  const std::vector<int> colours(3 * in.cases.size(), 0);
  std::vector<MembraneIncidence> incidences;
  for (int i = 0; i < n; ++i) {
    const compare::MembraneCase& c = in.cases[static_cast<std::size_t>(i)];
    const auto &b = c.gradient[0], &d = c.gradient[1];
    const int at = 3 * i;
    // The sweep does not read ∇N₀.
    rest.triangles.push_back({{at, at + 1, at + 2}, i, {{}, {b[0], b[1]}, {d[0], d[1]}}, c.area});
    rest.materials.push_back({c.lame_lambda, c.lame_mu, c.damping, 0});
    rest.models.push_back({c.model, compare::BendingModel::none, c.damping_form});
    incidences.push_back(detail::membrane_incidence(rest, i, 0, colours));
  }
  const std::vector<Symmetric2> no_strain(in.cases.size());
  typename Backend::template Buffer<Symmetric2> strain_start;
  strain_start.upload(no_strain.data(), no_strain.size());
  SweepView view;
  view.membrane = memory.template in<MembraneIncidence>(incidences);
  view.materials = memory.template in<SurfaceMaterial>(rest.materials);
  view.strain_start = strain_start.data();
  view.old = memory.padded(points_of(in.cases, &compare::MembraneCase::corner));
  view.models = memory.template in<SurfaceModels>(rest.models);
  view.start = {memory.padded(points_of(in.cases, &compare::MembraneCase::start))};
  const Vec* start = memory.template in<Vec>(points_of(in.cases, &compare::MembraneCase::start));
  backend.for_each(n, BeginTriangle{memory.template in<TriangleRest>(rest.triangles), start, strain_start.data()});
  backend.for_each(n, ProbeMembrane{view, force_arrays(memory, out, in.cases.size())});
  memory.fetch();
  return out;
}

/// Each hinge alone, likewise; `own`: the vertex that is solved.
struct ProbeBending {
  SweepView view;
  const int* own;  ///< by case
  ForceArrays out;

  OGC_HD void operator()(int i) const {
    ForceAndBlock sum;
    const SurfaceMaterial material = view.materials[i];
    const SurfaceModels models = view.models[i];
    const HingeIncidence& incidence = view.hinges[i];
    const Vec at = view.old[own[i]];
    if (has_default_bending(models) && models.bending != compare::BendingModel::none)
      DiscreteHinge::add(read_hinge(view, incidence, material, at), material.bending_damping, sum);
    else
      add_any_hinge(view, incidence, view.isometric[i], material, models, {at, at - view.start[own[i]]}, sum);
    out.store(i, sum);
  }
};

/// The stage `bending`.
template <class Backend>
compare::ForceOut probe_bending(Backend& backend, const compare::BendingIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ForceOut out;
  const int n = static_cast<int>(in.cases.size());
  RestState rest;
  const std::vector<int> colours(4 * in.cases.size(), 0);
  std::vector<HingeIncidence> incidences;
  std::vector<IsometricStencil> isometric;
  std::vector<int> own;
  for (int i = 0; i < n; ++i) {
    const compare::BendingCase& c = in.cases[static_cast<std::size_t>(i)];
    rest.hinges.push_back({{4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3}, i, c.rest_angle, c.stiffness});
    rest.materials.push_back({{}, {}, {}, c.damping});
    rest.models.push_back({compare::MembraneModel::none, c.model, c.damping_form});
    isometric.push_back(detail::isometric_stencil({{c.weight[0], c.weight[1], c.weight[2]}}, c.own));
    incidences.push_back(detail::hinge_incidence(rest, i, c.own, colours));
    own.push_back(4 * i + c.own);
  }
  const std::vector<float> no_angle(in.cases.size());
  typename Backend::template Buffer<float> angle_start;
  angle_start.upload(no_angle.data(), no_angle.size());
  SweepView view;
  view.hinges = memory.template in<HingeIncidence>(incidences);
  view.materials = memory.template in<SurfaceMaterial>(rest.materials);
  view.angle_start = angle_start.data();
  view.old = memory.padded(points_of(in.cases, &compare::BendingCase::vertex));
  view.models = memory.template in<SurfaceModels>(rest.models);
  view.isometric = memory.template in<IsometricStencil>(isometric);
  view.start = {memory.padded(points_of(in.cases, &compare::BendingCase::start))};
  const Vec* start = memory.template in<Vec>(points_of(in.cases, &compare::BendingCase::start));
  backend.for_each(n, BeginHinge{memory.template in<HingeRest>(rest.hinges), start, angle_start.data()});
  backend.for_each(n, ProbeBending{view, memory.template in<int>(own), force_arrays(memory, out, in.cases.size())});
  memory.fetch();
  return out;
}

/// Each spring alone.
struct ProbeSpring {
  SweepView view;
  ForceArrays out;

  OGC_HD void operator()(int i) const {
    ForceAndBlock sum;
    const int v = 3 * i + view.springs[i].own;
    const Vec own = view.old[v];
    add_any_spring(view, view.springs[i], view.models[i], {own, own - view.start[v]}, sum);
    out.store(i, sum);
  }
};

/// The stage `spring`.
template <class Backend>
compare::ForceOut probe_spring(Backend& backend, const compare::SpringIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ForceOut out;
  const int n = static_cast<int>(in.cases.size());
  const std::vector<int> colours(3 * in.cases.size(), 0);
  std::vector<SpringIncidence> incidences;
  std::vector<SurfaceModels> models;
  for (int i = 0; i < n; ++i) {
    const compare::SpringCase& c = in.cases[static_cast<std::size_t>(i)];
    incidences.push_back(detail::spring_incidence(
        {{3 * i, 3 * i + 1, 3 * i + 2}, c.stiffness, c.rest_length, c.damping, c.ratio}, c.own, colours));
    models.push_back({compare::MembraneModel::none, compare::BendingModel::none, c.damping_form});
  }
  SweepView view;
  view.springs = memory.template in<SpringIncidence>(incidences);
  view.models = memory.template in<SurfaceModels>(models);
  view.old = memory.padded(points_of(in.cases, &compare::SpringCase::vertex));
  view.start = {memory.padded(points_of(in.cases, &compare::SpringCase::start))};
  backend.for_each(n, ProbeSpring{view, force_arrays(memory, out, in.cases.size())});
  memory.fetch();
  return out;
}

/// Each tetrahedron alone, added as Tetrahedra do.
struct ProbeTetrahedron {
  SweepView view;
  ForceArrays out;

  OGC_HD void operator()(int i) const {
    ForceAndBlock sum;
    const Vec own = view.old[4 * i];
    add_any_tetrahedron(view, {view.tetrahedra[i], i}, view.solids[i], view.models[i], {own, own - view.start[4 * i]},
                        sum);
    out.store(i, sum);
  }
};

/// A tetrahedron at rest with the numbers of a case. Weights that corner 0 does not read stay 0.
inline TetrahedronRest tetrahedron_rest(const compare::TetrahedronCase& c, int number) {
  TetrahedronRest rest{
      {4 * number, 4 * number + 1, 4 * number + 2, 4 * number + 3}, number, {}, c.inverse, {}, c.volume};
  std::copy_n(c.weight.begin(), 3, rest.weight);
  for (std::size_t k = 0; k < 3; ++k) std::copy_n(c.gradient[k].begin(), 3, rest.gradient[k]);
  return rest;
}

/// The stage `tetrahedron`.
template <class Backend>
compare::ForceOut probe_tetrahedron(Backend& backend, const compare::TetrahedronIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ForceOut out;
  const int n = static_cast<int>(in.cases.size());
  RestState rest;
  const std::vector<int> colours(4 * in.cases.size(), 0);
  std::vector<TetrahedronIncidence> incidences;
  std::vector<TetrahedronGradients> gradients;
  for (int i = 0; i < n; ++i) {
    const compare::TetrahedronCase& c = in.cases[static_cast<std::size_t>(i)];
    rest.tetrahedra.push_back(tetrahedron_rest(c, i));
    rest.solids.push_back({c.lame_lambda, c.lame_mu, c.damping});
    rest.models.push_back({compare::MembraneModel::none, compare::BendingModel::none, c.damping_form});
    incidences.push_back(detail::tetrahedron_incidence(rest, i, 0, colours));
    gradients.push_back(detail::tetrahedron_gradients(rest.tetrahedra.back(), 0));
  }
  const std::vector<SolidStrain> no_strain(in.cases.size());
  typename Backend::template Buffer<SolidStrain> strain_start;
  strain_start.upload(no_strain.data(), no_strain.size());
  SweepView view;
  view.tetrahedra = memory.template in<TetrahedronIncidence>(incidences);
  view.gradients = memory.template in<TetrahedronGradients>(gradients);
  view.solids = memory.template in<SolidMaterial>(rest.solids);
  view.models = memory.template in<SurfaceModels>(rest.models);
  view.solid_start = strain_start.data();
  view.old = memory.padded(points_of(in.cases, &compare::TetrahedronCase::corner));
  view.start = {memory.padded(points_of(in.cases, &compare::TetrahedronCase::start))};
  const Vec* start = memory.template in<Vec>(points_of(in.cases, &compare::TetrahedronCase::start));
  backend.for_each(n,
                   BeginTetrahedron{memory.template in<TetrahedronRest>(rest.tetrahedra), start, strain_start.data()});
  backend.for_each(n, ProbeTetrahedron{view, force_arrays(memory, out, in.cases.size())});
  memory.fetch();
  return out;
}

}  // namespace ogc::fast
