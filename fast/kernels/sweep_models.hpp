// The sum over the stencils of a vertex in scenes with any model: stable Neo-Hookean membranes, isometric bending,
// springs, damping by vertex, all activations. It stands apart from GatherDefault, which has neither the branches nor
// the registers of what most scenes lack.
#pragma once

#include "fast/kernels/isometric.hpp"
#include "fast/kernels/neo_hookean.hpp"
#include "fast/kernels/spring.hpp"
#include "fast/kernels/sweep.hpp"

namespace ogc::fast {

/// Whether GatherDefault has the models of a body.
OGC_HD inline bool are_default(const SurfaceModels& models) {
  return models.membrane != compare::MembraneModel::stable_neo_hookean &&
         models.bending != compare::BendingModel::isometric_quadratic && models.damping == compare::DampingForm::strain;
}

/// A spring seen from the end `place`; `index`: all ends, encoded as in sweep.hpp.
struct SpringIncidence {
  int index[3] = {0, 0, 0};
  int place = 0;
  SpringRest spring{};
};

/// The springs of a vertex in their stream.
struct SpringRow {
  int begin = 0, count = 0;
};

/// A vertex that is solved: where it is, and how far it has moved since the start of the step, for damping by vertex.
struct OwnVertex {
  Vec position, moved;
};

/// Adds an elastic stencil with damping by vertex: its force less k B moved, and its block B (1 + k) times.
OGC_HD inline void add_damped_by_vertex(const ForceAndBlock& elastic, float damping, const Vec& moved,
                                        ForceAndBlock& sum) {
  const Symmetric3& b = elastic.block;
  const Vec resisted{b.xx * moved.x + b.xy * moved.y + b.xz * moved.z, b.xy * moved.x + b.yy * moved.y + b.yz * moved.z,
                     b.xz * moved.x + b.yz * moved.y + b.zz * moved.z};
  const float grown = 1.0f + damping;
  sum += ForceAndBlock{elastic.force - damping * resisted,
                       {grown * b.xx, grown * b.xy, grown * b.xz, grown * b.yy, grown * b.yz, grown * b.zz}};
}

/// The elastic part of a triangle of any model.
OGC_HD inline void add_elastic_membrane(const SurfaceModels& models, const MembraneStencil& stencil,
                                        SurfaceMaterial material, const Vec& to_b, const Vec& to_c,
                                        ForceAndBlock& sum) {
  material.membrane_damping = 0;
  if (models.membrane == compare::MembraneModel::stable_neo_hookean)
    add_neo_hookean(stencil, material, to_b, to_c, sum);
  else
    add_membrane(stencil, material, to_b, to_c, {}, sum);
}

OGC_HD inline void add_any_membrane(const SweepView& view, const MembraneIncidence& incidence,
                                    const SurfaceMaterial& material, const SurfaceModels& models, const OwnVertex& own,
                                    ForceAndBlock& sum) {
  const MembraneReads reads = read_membrane(view, incidence, material);
  const Vec to_b = reads.b - own.position, to_c = reads.c - own.position;
  if (models.damping == compare::DampingForm::per_vertex) {
    ForceAndBlock elastic;
    add_elastic_membrane(models, incidence.stencil, material, to_b, to_c, elastic);
    add_damped_by_vertex(elastic, material.membrane_damping, own.moved, sum);
  } else if (models.membrane == compare::MembraneModel::stable_neo_hookean) {
    add_neo_hookean(incidence.stencil, material, to_b, to_c, sum);
    if (material.membrane_damping > 0)
      add_strain_damping(incidence.stencil, material, to_b, to_c, reads.strain_start, sum);
  } else {
    add_membrane_incidence(incidence, reads, material, own.position, sum);
  }
}

/// `isometric` is read where the body bends so.
OGC_HD inline void add_any_hinge(const SweepView& view, const HingeIncidence& incidence,
                                 const IsometricStencil& isometric, const SurfaceMaterial& material,
                                 const SurfaceModels& models, const OwnVertex& own, ForceAndBlock& sum) {
  const HingeReads reads = read_hinge(view, incidence, material);
  const bool by_vertex = models.damping == compare::DampingForm::per_vertex,
             bends_isometrically = models.bending == compare::BendingModel::isometric_quadratic;
  SurfaceMaterial undamped = material;
  undamped.bending_damping = 0;
  ForceAndBlock elastic;
  if (bends_isometrically) {
    const Vec to[3] = {reads.p[0] - own.position, reads.p[1] - own.position, reads.p[2] - own.position};
    add_isometric(isometric, incidence.stencil.stiffness, to, elastic);
  } else {
    add_hinge_incidence(incidence, reads, by_vertex ? undamped : material, own.position, elastic);
  }
  if (by_vertex) {
    add_damped_by_vertex(elastic, material.bending_damping, own.moved, sum);
    return;
  }
  sum += elastic;
  if (!bends_isometrically || !(material.bending_damping > 0)) return;
  HingeIncidence damper = incidence;
  damper.stencil = {material.bending_damping * incidence.stencil.stiffness, reads.angle_start};
  add_hinge_incidence(damper, reads, undamped, own.position, sum);
}

OGC_HD inline void add_any_spring(const SweepView& view, const SpringIncidence& incidence, const SurfaceModels& models,
                                  const OwnVertex& own, ForceAndBlock& sum) {
  const SpringRest& spring = incidence.spring;
  Vec end[3];
  for (int k = 0; k < 3; ++k) end[k] = k == incidence.place ? own.position : view.read(incidence.index[k]);
  const Vec apart = spring_apart(spring, end);
  const float weight = spring_weight(spring, incidence.place);
  if (models.damping == compare::DampingForm::per_vertex) {
    ForceAndBlock elastic;
    add_spring(spring, weight, 0.0f, apart, 0.0f, elastic);
    add_damped_by_vertex(elastic, spring.damping, own.moved, sum);
    return;
  }
  float length_start = 0;
  if (spring.damping > 0) {
    for (int k = 0; k < 3; ++k) end[k] = view.start[decoded(incidence.index[k])];
    length_start = spring_length(spring_apart(spring, end));
  }
  add_spring(spring, weight, spring.damping, apart, length_start, sum);
}

/// A hinge with its weights, where it has any.
struct AnyHinge {
  HingeIncidence hinge;
  IsometricStencil isometric;
};

/// The springs of a vertex as a part of its sum. No lambdas: g++ and nvcc need not lay their captures out alike
/// (fast/stages/colouring.cpp), and this part is handed on.
struct LoadSpring {
  const SpringIncidence* first;

  OGC_HD SpringIncidence operator()(int k) const { return first[k]; }
};
struct AddSpring {
  const SweepView& view;
  SurfaceModels models;
  OwnVertex own;

  OGC_HD void operator()(const SpringIncidence& spring, ForceAndBlock& sum) const {
    add_any_spring(view, spring, models, own, sum);
  }
};
OGC_HD inline Part<LoadSpring, AddSpring> spring_part(const SweepView& view, int slot, const SurfaceModels& models,
                                                      const OwnVertex& own) {
  SpringRow row;
  if (view.spring_rows != nullptr) row = view.spring_rows[slot];
  return part(row.count, LoadSpring{view.springs + row.begin}, AddSpring{view, models, own});
}

/// The sum of GatherEveryModel with parts of others between springs and contacts.
template <class Team, class... Others>
OGC_HD ForceAndBlock every_model_sum(const SweepView& view, int slot, const SweepVertex& vertex, const OwnVertex& at,
                                     const Team& team, const Others&... others) {
  const ContactParts contacts{view, view.contact_rows[slot], view.activation};
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
  static constexpr int parts = 5;

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    return every_model_sum(view, slot, vertex, {own, own - view.start[vertex.vertex]}, team);
  }
};

}  // namespace ogc::fast
