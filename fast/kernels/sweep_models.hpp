// The sum over the stencils of a vertex in scenes with any model: every membrane, bending, damping and activation, and
// springs. It stands apart from GatherDefault, which has neither the branches nor the registers of what most scenes
// lack.
#pragma once

#include "fast/kernels/models/bending_models.hpp"
#include "fast/kernels/models/damping.hpp"
#include "fast/kernels/models/membrane_models.hpp"
#include "fast/kernels/models/spring.hpp"
#include "fast/kernels/sweep.hpp"

namespace ogc::fast {

/// Whether GatherDefault has the models of a body.
OGC_HD inline bool are_default(const SurfaceModels& models) {
  return has_default_membrane(models) && has_default_bending(models);
}

/// A spring seen from its end `own`; `index`: all ends, encoded as in sweep.hpp.
struct SpringIncidence {
  int index[3] = {0, 0, 0};
  int own = 0;          ///< number of the end, 0 … 2
  SpringRest spring{};  ///< rest data, the same at each end
};

/// The springs of a vertex in their stream.
struct SpringRow {
  int begin = 0, count = 0;  ///< first place in SweepView::springs, and how many
};

/// A vertex that is solved: where it is, and how far it has moved since the start of the step, for damping by vertex.
struct OwnVertex {
  Vec position, moved;  ///< x, and x − xᵗ [m]
};

// The functors below are named, not lambdas: g++ and nvcc need not lay captures out alike (fast/stages/colouring.cpp).

// Models are chosen inside of the form of damping, and what a model shares with others stands outside of its choice:
// a device contracts products and sums within a branch, so where a branch ends decides a bit.

/// Adds a triangle with damping of strains, given the functor of its model.
struct AddMembrane {
  /// Arguments of a membrane model's `add` (models/membrane_models.hpp): edges to the other corners [m], Gᵗ; `sum`
  /// takes force and block.
  const MembraneStencil& stencil;
  const SurfaceMaterial& material;
  Vec to_b, to_c;
  const Symmetric2& strain_start;
  ForceAndBlock& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add(stencil, material, to_b, to_c, strain_start, sum);
  }
};
/// Adds a triangle without damping, likewise.
struct AddElasticMembrane {
  const MembraneStencil& stencil;
  const SurfaceMaterial& material;
  Vec to_b, to_c;
  ForceAndBlock& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add_elastic(stencil, material, to_b, to_c, sum);
  }
};

/// A triangle of whatever model.
OGC_HD inline void add_any_membrane(const SweepView& view, const MembraneIncidence& incidence,
                                    const SurfaceMaterial& material, const SurfaceModels& models, const OwnVertex& own,
                                    ForceAndBlock& sum) {
  const MembraneReads reads = read_membrane(view, incidence, material);
  const Vec to_b = reads.b - own.position, to_c = reads.c - own.position;
  switch (models.damping) {
    case compare::DampingForm::per_vertex: {
      ForceAndBlock elastic;
      with_membrane(models.membrane, AddElasticMembrane{incidence.stencil, material, to_b, to_c, elastic});
      return add_damped_by_vertex(elastic, material.membrane_damping, own.moved, sum);
    }
    case compare::DampingForm::strain:
      return with_membrane(models.membrane,
                           AddMembrane{incidence.stencil, material, to_b, to_c, reads.strain_start, sum});
  }
}

/// Adds a hinge, given the functor of its model; `damping` is k_d/h.
struct AddHinge {
  /// Arguments of a bending model's `add` (models/bending_models.hpp): k_d/h [1], 0 for damping by vertex; `sum` takes
  /// force and block.
  const HingeSeen& hinge;
  float damping;
  ForceAndBlock& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add(hinge, damping, sum);
  }
};
/// Adds what `add` of the model leaves out of the damping, likewise.
struct AddHingeDamper {
  const HingeSeen& hinge;
  float damping;
  ForceAndBlock& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add_damper(hinge, damping, sum);
  }
};

/// A hinge of whatever model. `isometric` is read where the body bends so.
OGC_HD inline void add_any_hinge(const SweepView& view, const HingeIncidence& incidence,
                                 const IsometricStencil& isometric, const SurfaceMaterial& material,
                                 const SurfaceModels& models, const OwnVertex& own, ForceAndBlock& sum) {
  HingeSeen hinge = read_hinge(view, incidence, material, own.position);
  hinge.isometric = isometric;
  const float damping = material.bending_damping;
  const bool of_strain = damps_strain(models.damping);
  ForceAndBlock whole;
  with_bending(models.bending, AddHinge{hinge, of_strain ? damping : 0.0f, whole});
  switch (models.damping) {
    case compare::DampingForm::per_vertex: return add_damped_by_vertex(whole, damping, own.moved, sum);
    case compare::DampingForm::strain:
      sum += whole;
      return with_bending(models.bending, AddHingeDamper{hinge, damping, sum});
  }
}

/// A spring with whatever damping.
OGC_HD inline void add_any_spring(const SweepView& view, const SpringIncidence& incidence, const SurfaceModels& models,
                                  const OwnVertex& own, ForceAndBlock& sum) {
  const SpringRest& spring = incidence.spring;
  Vec end[3];
  for (int k = 0; k < 3; ++k) end[k] = k == incidence.own ? own.position : view.read(incidence.index[k]);
  const Vec apart = spring_apart(spring, end);
  const float weight = spring_weight(spring, incidence.own);
  switch (models.damping) {
    case compare::DampingForm::per_vertex: {
      ForceAndBlock elastic;
      add_spring(spring, weight, 0.0f, apart, 0.0f, elastic);
      return add_damped_by_vertex(elastic, spring.damping, own.moved, sum);
    }
    case compare::DampingForm::strain: {
      float length_start = 0;
      if (spring.damping > 0) {
        for (int k = 0; k < 3; ++k) end[k] = view.start[decoded(incidence.index[k])];
        length_start = spring_length(spring_apart(spring, end));
      }
      return add_spring(spring, weight, spring.damping, apart, length_start, sum);
    }
  }
}

/// A hinge with its weights, where it has any.
struct AnyHinge {
  HingeIncidence hinge;
  IsometricStencil isometric;  ///< 0 where no body bends isometrically
};

/// Spring k of a vertex.
struct LoadSpring {
  const SpringIncidence* first;  ///< of the vertex's row

  OGC_HD SpringIncidence operator()(int k) const { return first[k]; }
};
/// Adds a spring of a vertex.
struct AddSpring {
  const SweepView& view;
  SurfaceModels models;
  OwnVertex own;

  OGC_HD void operator()(const SpringIncidence& spring, ForceAndBlock& sum) const {
    add_any_spring(view, spring, models, own, sum);
  }
};
/// The springs of a vertex as a part of its sum.
OGC_HD inline Part<LoadSpring, AddSpring> spring_part(const SweepView& view, int slot, const SurfaceModels& models,
                                                      const OwnVertex& own) {
  SpringRow row;
  if (view.spring_rows != nullptr) row = view.spring_rows[slot];
  return part(row.count, LoadSpring{view.springs + row.begin}, AddSpring{view, models, own});
}

/// The sum of GatherEveryModel with parts of others between springs and contacts. `Weights`: of contacts, as
/// ContactParts has them.
template <class Weights = WeightsOfUpdate, class Team, class... Others>
OGC_HD ForceAndBlock every_model_sum(const SweepView& view, int slot, const SweepVertex& vertex, const OwnVertex& at,
                                     const Team& team, const Others&... others) {
  const ContactParts<AnyActivation, Weights> contacts{view, view.contact_rows[slot], {view.activation}};
  const SurfaceMaterial material = view.materials[vertex.body];
  const SurfaceModels models = view.models[vertex.body];
  prefetch_rows(view, vertex, contacts.row, team);
  const auto load_hinge = [&](int k) {
    const int i = vertex.hinge_begin + k;
    AnyHinge any{view.hinges[i], {}};
    if (view.isometric != nullptr) any.isometric = view.isometric[i];
    return any;
  };
  return team.template sum<ForceAndBlock>(
      part(
          vertex.membrane_count, [&](int k) { return view.membrane[vertex.membrane_begin + k]; },
          [&](const MembraneIncidence& membrane, ForceAndBlock& sum) {
            add_any_membrane(view, membrane, material, models, at, sum);
          }),
      part(vertex.hinge_count, load_hinge,
           [&](const AnyHinge& any, ForceAndBlock& sum) {
             add_any_hinge(view, any.hinge, any.isometric, material, models, at, sum);
           }),
      spring_part(view, slot, models, at), others..., contacts.vertex_facet(), contacts.edge_edge());
}

/// As GatherDefault, with springs as a fifth part.
struct GatherEveryModel {
  static constexpr int parts = 5;  ///< of the sum, in the order of every_model_sum

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    return every_model_sum(view, slot, vertex, {own, own - view.start[vertex.vertex]}, team);
  }
};

}  // namespace ogc::fast
