// The sum over the stencils of a vertex, four lanes of a team at a time. Lanes, their items and the order of every addition are those of SerialTeam, so the bits are, too
// (tests/fast/stages/sweep.cpp).
#pragma once

#include "fast/cpu/packed_contact.hpp"
#include "fast/cpu/packed_items.hpp"
#include "fast/kernels/sweep_models.hpp"

namespace ogc::fast {

namespace packed {

/// A part without items.
struct None {
  static constexpr int count = 0;
};
inline int load_item(None, int) { return 0; }
inline void add_item(None, int, ForceAndBlock&) {}

/// Four sums as one.
inline ForceAndBlockOf<Pack> together(const ForceAndBlock* a) {
  const auto each = [a](auto number) { return Pack{number(a[0]), number(a[1]), number(a[2]), number(a[3])}; };
  using Sum = const ForceAndBlock&;
  return {{each([](Sum s) { return s.force.x; }), each([](Sum s) { return s.force.y; }), each([](Sum s) { return s.force.z; })},
          {each([](Sum s) { return s.block.xx; }), each([](Sum s) { return s.block.xy; }), each([](Sum s) { return s.block.xz; }),
           each([](Sum s) { return s.block.yy; }), each([](Sum s) { return s.block.yz; }), each([](Sum s) { return s.block.zz; })}};
}

inline void add_triangles(const SweepView& view, const Items<MembraneIncidence>& items, const SurfaceMaterial& material, const Vector<Pack>& own,
                          ForceAndBlockOf<Pack>& sum) {
  using Incidence = MembraneIncidence;
  const MembraneStencilOf<Pack> stencil{
      {items.each([](const Incidence& i) { return i.stencil.gradient_b[0]; }), items.each([](const Incidence& i) { return i.stencil.gradient_b[1]; })},
      {items.each([](const Incidence& i) { return i.stencil.gradient_c[0]; }), items.each([](const Incidence& i) { return i.stencil.gradient_c[1]; })},
      items.each([](const Incidence& i) { return i.stencil.area; })};
  const Vector<Pack> b = items.each_place([&](const Incidence& i) -> const Place& { return view.old[view.number(i.index[0])]; });
  const Vector<Pack> c = items.each_place([&](const Incidence& i) -> const Place& { return view.old[view.number(i.index[1])]; });
  Symmetric2Of<Pack> start;
  if (material.membrane_damping > 0) {
    start = {items.each([&](const Incidence& i) { return view.strain_start[i.triangle].xx; }),
             items.each([&](const Incidence& i) { return view.strain_start[i.triangle].xy; }),
             items.each([&](const Incidence& i) { return view.strain_start[i.triangle].yy; })};
  }
  ForceAndBlockOf<Pack> with = sum;
  add_membrane(stencil, material, b - own, c - own, start, with);
  sum = select(items.counted, with, sum);
}

inline void add_hinges(const SweepView& view, const Items<HingeIncidence>& items, const SurfaceMaterial& material, const Vector<Pack>& own,
                       ForceAndBlockOf<Pack>& sum) {
  using Incidence = HingeIncidence;
  const PackMask opposite = items.each([](const Incidence& i) { return i.hinge < 0 ? 1.0F : 0.0F; }) > Pack{};
  Vector<Pack> p[3];
  for (int k = 0; k < 3; ++k) p[k] = items.each_place([&](const Incidence& i) -> const Place& { return view.old[view.number(i.index[k])]; });
  const HingeShapeOf<Pack> shape = hinge_shape_seen<Pack>(opposite, p, own);
  Pack start;
  if (material.bending_damping > 0) start = items.each([&](const Incidence& i) { return view.angle_start[decoded(i.hinge)]; });
  const HingeStencilOf<Pack> stencil{items.each([](const Incidence& i) { return i.stencil.stiffness; }),
                                     items.each([](const Incidence& i) { return i.stencil.rest_angle; })};
  ForceAndBlockOf<Pack> with = sum;
  add_hinge(stencil, material.bending_damping, shape.angle, start, hinge_gradient(shape, opposite), with);
  sum = select(items.counted && shape.defined, with, sum);
}

/// The lanes of a team of W, four in a pack.
template <int W>
struct Lanes {
  static_assert(W >= Pack::width);
  ForceAndBlockOf<Pack> packs[W / Pack::width];

  /// A part of so many items; add(items, sum).
  template <class Item, class Add>
  void add_part(const Item* items, int count, Add add) {
    for (int first = 0; first < W && first < count; first += Pack::width) {
      ForceAndBlockOf<Pack> own;
      for (int k = first; k < count; k += W) add(Items<Item>{items + k, count - k}, own);
      packs[first / Pack::width] += own;
    }
  }

  /// A part whose items are computed one by one.
  template <class Part>
  void add_part(const Part& part) {
    for (int first = 0; first < W && first < part.count; first += Pack::width) {
      ForceAndBlock own[Pack::width];
      for (int l = 0; l < Pack::width; ++l) {
        for (int k = first + l; k < part.count; k += W) add_item(part, load_item(part, k), own[l]);
      }
      packs[first / Pack::width] += together(own);
    }
  }

  /// All lanes, by the tree of SerialTeam.
  ForceAndBlock total() {
    for (int s = W / Pack::width / 2; s > 0; s /= 2) {
      for (int l = 0; l < s; ++l) packs[l] += packs[l + s];
    }
    const auto whole = [](Pack a) { return (a[0] + a[2]) + (a[1] + a[3]); };
    const Vector<Pack>& f = packs[0].force;
    const Symmetric3Of<Pack>& b = packs[0].block;
    return {{whole(f.x), whole(f.y), whole(f.z)}, {whole(b.xx), whole(b.xy), whole(b.xz), whole(b.yy), whole(b.yz), whole(b.zz)}};
  }
};

}  // namespace packed

/// As GatherDefault.
struct GatherPacked {
  static constexpr int parts = GatherDefault::parts;

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own, const SerialTeam<W>& team) const {
    if constexpr (W < Pack::width) return GatherDefault{}(view, slot, vertex, own, team);
    else return with<W>(view, slot, vertex, own, packed::None{});
  }

  /// With `springs` between the hinges and the contacts.
  template <int W, class Springs>
  ForceAndBlock with(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own, const Springs& springs) const {
    const SurfaceMaterial material = view.materials[vertex.body];
    const Vector<Pack> here = packed::everywhere(own);
    packed::Lanes<W> lanes;
    lanes.add_part(view.membrane + vertex.membrane_begin, vertex.membrane_count, [&](const packed::Items<MembraneIncidence>& items, ForceAndBlockOf<Pack>& sum) {
      packed::add_triangles(view, items, material, here, sum);
    });
    lanes.add_part(view.hinges + vertex.hinge_begin, vertex.hinge_count, [&](const packed::Items<HingeIncidence>& items, ForceAndBlockOf<Pack>& sum) {
      packed::add_hinges(view, items, material, here, sum);
    });
    lanes.add_part(springs);
    const ContactRow row = view.contact_rows[slot];
    const ContactIncidence* contacts = view.contacts + row.begin;
    const auto add = [&](const packed::Items<ContactIncidence>& items, ForceAndBlockOf<Pack>& sum) { packed::add_contacts(view, items, sum); };
    lanes.add_part(contacts, row.vertex_facet, add);
    lanes.add_part(contacts + row.vertex_facet, row.count - row.vertex_facet, add);
    return lanes.total();
  }
};

/// As GatherEveryModel: in packs for vertices of bodies with default models, springs one by one; as there for all others.
struct GatherPackedEveryModel {
  static constexpr int parts = GatherEveryModel::parts;

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own, const SerialTeam<W>& team) const {
    const SurfaceModels models = view.models[vertex.body];
    if constexpr (W >= Pack::width) {
      if (are_default(models) && view.activation == ContactActivation::ogc) return GatherPacked{}.with<W>(view, slot, vertex, own, spring_part(view, slot, models, {own, own - view.start[vertex.vertex]}));
    }
    return GatherEveryModel{}(view, slot, vertex, own, team);
  }
};

}  // namespace ogc::fast
