// Lets the judge test the energies. Each case becomes one incidence of the sweep's streams. The sweep's functions make
// the incidence and compute its force and block.
#pragma once

#include <algorithm>
#include <vector>

#include "compare/stages/bending.hpp"
#include "compare/stages/membrane.hpp"
#include "compare/stages/spring.hpp"
#include "compare/stages/tetrahedron.hpp"
#include "fast/kernels/sweep/gather.hpp"
#include "fast/probes/probe_memory.hpp"
#include "fast/stages/sweep.hpp"

namespace ogc::fast {

/// Returns the points of a batch of stencils in one array.
template <class Case, std::size_t count>
std::vector<compare::Vec3f> points_of(const std::vector<Case>& cases, std::array<compare::Vec3f, count> Case::*points) {
  std::vector<compare::Vec3f> all;
  for (const Case& c : cases) all.insert(all.end(), (c.*points).begin(), (c.*points).end());
  return all;
}

/// Receives the force and the block of each case, on the backend.
struct ForceArrays {
  Vec* force;         ///< by case: −∂E/∂x [N]
  Symmetric3* block;  ///< by case [N/m]

  /// Stores the sum of case i.
  OGC_HD void store(int i, const ForceAndBlock& sum) const {
    force[i] = sum.force;
    block[i] = sum.block;
  }
};

/// Makes room on the backend for the forces and blocks of n cases. ProbeMemory::fetch copies them to `out`.
template <class Backend>
ForceArrays force_arrays(ProbeMemory<Backend>& memory, compare::ForceOut& out, std::size_t n) {
  return {memory.template out<Vec>(out.force, n), memory.template out<Symmetric3>(out.block, n)};
}

/// Computes force and block of each element alone, as the sweep does: by the part `Usual` if the element has the
/// default models, else by `Any`.
template <class Usual, class Any>
struct ProbeElement {
  SweepView view;                ///< by case: a vertex with one incidence, and a body
  const std::uint8_t* is_usual;  ///< by case
  ForceArrays out;               ///< by case, written

  OGC_HD void operator()(int i) const {
    const SweepVertex vertex = view.vertices[i];
    const Vec own = view.old[vertex.vertex];
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    ForceAndBlock sum;
    if (is_usual[i] != 0)
      add_first(Usual::part_of(view, i, vertex, at), sum);
    else
      add_first(Any::part_of(view, i, vertex, at), sum);
    out.store(i, sum);
  }

 private:
  template <class AnyPart>
  OGC_HD static void add_first(const AnyPart& part, ForceAndBlock& sum) {
    add_item(part, load_item(part, 0), sum);
  }
};

/// Holds a batch of cases of one kind of element. Case i is element i, with its own body and vertices.
template <class Kind>
struct ElementBatch {
  std::vector<typename Kind::Rest> rest;
  std::vector<typename Kind::Incidence> incidences;
  std::vector<typename Kind::Beside> beside;
  std::vector<typename Kind::ByBody> by_body;
  std::vector<SurfaceMaterial> materials;
  std::vector<SurfaceModels> models;
  std::vector<std::uint8_t> is_usual;
  std::vector<SweepVertex> vertices;
  std::vector<Row> rows;
  std::vector<compare::Vec3f> positions, start;  ///< by vertex: x, xᵗ [m]

  /// Adds a case: the force of `element` on its vertex with this role. The caller also adds the entries of `materials`,
  /// `by_body` and `beside` that the kind reads.
  void add(const typename Kind::Rest& element, int role, const SurfaceModels& of_body, bool usual = false) {
    const int i = static_cast<int>(rest.size()), v = Kind::vertices(element)[role];
    const std::vector<int> colour(static_cast<std::size_t>(v) + 32, 0);
    incidences.push_back(Kind::seen(element, i, role, {colour.data(), 0}));
    rest.push_back(element);
    models.push_back(of_body);
    is_usual.push_back(usual ? 1 : 0);
    rows.push_back({i, 1});
    SweepVertex vertex;
    vertex.vertex = v;
    vertex.body = i;
    if constexpr (Kind::row_in_vertex >= 0) vertex.rows[Kind::row_in_vertex] = {i, 1};
    vertices.push_back(vertex);
  }

  /// Returns the forces of all cases, each computed alone.
  template <class Usual, class Any, class Backend>
  compare::ForceOut ask(Backend& backend) const {
    ProbeMemory<Backend> memory(backend);
    compare::ForceOut out;
    const auto n = static_cast<int>(rest.size());
    SweepView view;
    auto& stream = Kind::stream(view);
    if constexpr (requires { stream.rows; }) stream.rows = memory.template in<Row>(rows);
    stream.incidences = memory.template in<typename Kind::Incidence>(incidences);
    if constexpr (requires { stream.beside; }) stream.beside = memory.template in<typename Kind::Beside>(beside);
    if constexpr (requires { stream.by_body; }) stream.by_body = memory.template in<typename Kind::ByBody>(by_body);
    view.vertices = memory.template in<SweepVertex>(vertices);
    view.materials = memory.template in<SurfaceMaterial>(materials);
    view.models = memory.template in<SurfaceModels>(models);
    view.old = memory.padded(positions);
    view.start = {memory.padded(start)};
    typename Backend::template Buffer<typename Kind::Start> at_start;
    if constexpr (requires(const typename Kind::Rest& element, const Vec* x) { Kind::begin(element, x); }) {
      at_start.resize(rest.size());
      stream.start = at_start.data();
      backend.for_each(n, BeginElement<Kind>{memory.template in<typename Kind::Rest>(rest),
                                             memory.template in<Vec>(start), at_start.data()});
    }
    backend.for_each(n, ProbeElement<Usual, Any>{view, memory.template in<std::uint8_t>(is_usual),
                                                 force_arrays(memory, out, rest.size())});
    memory.fetch();
    return out;
  }
};

/// Answers the stage `membrane`.
template <class Backend>
compare::ForceOut probe_membrane(Backend& backend, const compare::MembraneIn& in) {
  ElementBatch<TriangleKind> batch;
  batch.positions = points_of(in.cases, &compare::MembraneCase::corner);
  batch.start = points_of(in.cases, &compare::MembraneCase::start);
  for (int i = 0; i < static_cast<int>(in.cases.size()); ++i) {
    const compare::MembraneCase& c = in.cases[static_cast<std::size_t>(i)];
    const auto &b = c.gradient[0], &d = c.gradient[1];
    const SurfaceModels models{c.model, compare::BendingModel::none, c.damping_form};
    batch.materials.push_back({c.lame_lambda, c.lame_mu, c.damping, 0});
    // The sweep does not read ∇N₀.
    batch.add({{3 * i, 3 * i + 1, 3 * i + 2}, i, {{}, {b[0], b[1]}, {d[0], d[1]}}, c.area}, 0, models,
              has_default_membrane(models));
  }
  return batch.ask<UsualTriangles, Triangles>(backend);
}

/// Answers the stage `bending`.
template <class Backend>
compare::ForceOut probe_bending(Backend& backend, const compare::BendingIn& in) {
  ElementBatch<HingeKind> batch;
  batch.positions = points_of(in.cases, &compare::BendingCase::vertex);
  batch.start = points_of(in.cases, &compare::BendingCase::start);
  for (int i = 0; i < static_cast<int>(in.cases.size()); ++i) {
    const compare::BendingCase& c = in.cases[static_cast<std::size_t>(i)];
    const SurfaceModels models{compare::MembraneModel::none, c.model, c.damping_form};
    batch.materials.push_back({{}, {}, {}, c.damping});
    batch.add({{4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3}, i, c.rest_angle, c.stiffness}, c.own, models,
              has_default_bending(models) && c.model != compare::BendingModel::none);
    batch.beside.push_back(HingeKind::beside({}, {{c.weight[0], c.weight[1], c.weight[2]}}, c.own));
  }
  return batch.ask<UsualHinges, Hinges>(backend);
}

/// Answers the stage `spring`.
template <class Backend>
compare::ForceOut probe_spring(Backend& backend, const compare::SpringIn& in) {
  ElementBatch<SpringKind> batch;
  batch.positions = points_of(in.cases, &compare::SpringCase::vertex);
  batch.start = points_of(in.cases, &compare::SpringCase::start);
  for (int i = 0; i < static_cast<int>(in.cases.size()); ++i) {
    const compare::SpringCase& c = in.cases[static_cast<std::size_t>(i)];
    batch.add({{3 * i, 3 * i + 1, 3 * i + 2}, c.stiffness, c.rest_length, c.damping, c.ratio}, c.own,
              {compare::MembraneModel::none, compare::BendingModel::none, c.damping_form});
  }
  return batch.ask<Springs, Springs>(backend);
}

/// Returns a tetrahedron at rest with the values of a case. Weights that corner 0 does not read stay 0.
inline TetrahedronRest tetrahedron_rest(const compare::TetrahedronCase& c, int number) {
  TetrahedronRest rest{
      {4 * number, 4 * number + 1, 4 * number + 2, 4 * number + 3}, number, {}, c.inverse, {}, c.volume};
  std::copy_n(c.weight.begin(), 3, rest.weight);
  for (std::size_t k = 0; k < 3; ++k) std::copy_n(c.gradient[k].begin(), 3, rest.gradient[k]);
  return rest;
}

/// Answers the stage `tetrahedron`.
template <class Backend>
compare::ForceOut probe_tetrahedron(Backend& backend, const compare::TetrahedronIn& in) {
  ElementBatch<TetrahedronKind> batch;
  batch.positions = points_of(in.cases, &compare::TetrahedronCase::corner);
  batch.start = points_of(in.cases, &compare::TetrahedronCase::start);
  for (int i = 0; i < static_cast<int>(in.cases.size()); ++i) {
    const compare::TetrahedronCase& c = in.cases[static_cast<std::size_t>(i)];
    batch.by_body.push_back({c.lame_lambda, c.lame_mu, c.damping});
    batch.add(tetrahedron_rest(c, i), 0, {compare::MembraneModel::none, compare::BendingModel::none, c.damping_form});
    batch.beside.push_back(TetrahedronKind::beside(batch.rest.back(), {}, 0));
  }
  return batch.ask<Tetrahedra, Tetrahedra>(backend);
}

}  // namespace ogc::fast
