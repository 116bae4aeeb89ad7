// The sum over the stencils of a vertex, a pack of team lanes at a time. Team lanes, their items and the order of every
// addition are those of SerialTeam, so the bits are, too (tests/fast/stages/sweep.cpp).
#pragma once

#include "fast/cpu/pack_kernels.hpp"
#include "fast/cpu/packed_contact.hpp"
#include "fast/cpu/packed_items.hpp"

namespace ogc::fast {
inline namespace OGC_PACKS {
namespace packed {

/// P::width sums as one of packs, sum k in lane k.
template <class P>
ForceAndBlockOf<P> together(const ForceAndBlock* a) {
  const auto each = [a](auto number) { return P::of_each([&](int k) { return number(a[k]); }); };
  using Sum = const ForceAndBlock&;
  return {{each([](Sum s) { return s.force.x; }), each([](Sum s) { return s.force.y; }),
           each([](Sum s) { return s.force.z; })},
          {each([](Sum s) { return s.block.xx; }), each([](Sum s) { return s.block.xy; }),
           each([](Sum s) { return s.block.xz; }), each([](Sum s) { return s.block.yy; }),
           each([](Sum s) { return s.block.yz; }), each([](Sum s) { return s.block.zz; })}};
}

/// A membrane's triangles, added where they are counted.
template <class Model, class P>
void add_triangles(const SweepView& view, const Items<MembraneIncidence, P>& items, const SurfaceMaterial& material,
                   const Vector<P>& own, ForceAndBlockOf<P>& sum) {
  using Incidence = MembraneIncidence;
  const MembraneStencilOf<P> stencil{{items.each([](const Incidence& i) { return i.stencil.gradient_b[0]; }),
                                      items.each([](const Incidence& i) { return i.stencil.gradient_b[1]; })},
                                     {items.each([](const Incidence& i) { return i.stencil.gradient_c[0]; }),
                                      items.each([](const Incidence& i) { return i.stencil.gradient_c[1]; })},
                                     items.each([](const Incidence& i) { return i.stencil.area; })};
  const Vector<P> b = items.each_position(
      [&](const Incidence& i) -> const PaddedVec& { return view.old[view.number(i.index[0])]; });
  const Vector<P> c = items.each_position(
      [&](const Incidence& i) -> const PaddedVec& { return view.old[view.number(i.index[1])]; });
  Symmetric2Of<P> start;
  if (material.membrane_damping > 0) {
    start = {items.each([&](const Incidence& i) { return view.strain_start[i.triangle].xx; }),
             items.each([&](const Incidence& i) { return view.strain_start[i.triangle].xy; }),
             items.each([&](const Incidence& i) { return view.strain_start[i.triangle].yy; })};
  }
  ForceAndBlockOf<P> with = sum;
  Model::add(stencil, material, b - own, c - own, start, with);
  sum = selected<P>(items.counted, with, sum);
}

/// DiscreteHinge of each, likewise.
template <class P>
void add_hinges(const SweepView& view, const Items<HingeIncidence, P>& items, const SurfaceMaterial& material,
                const Vector<P>& own, ForceAndBlockOf<P>& sum) {
  using Incidence = HingeIncidence;
  const typename P::Mask opposite = items.each([](const Incidence& i) { return i.hinge < 0 ? 1.0F : 0.0F; }) > P{};
  const auto position = [&](int k) {
    return items.each_position(
        [&](const Incidence& i) -> const PaddedVec& { return view.old[view.number(i.index[k])]; });
  };
  const Vector<P> p[3] = {position(0), position(1), position(2)};
  const HingeShapeOf<P> shape = hinge_shape_seen<P>(opposite, p, own);
  P start;
  if (material.bending_damping > 0)
    start = items.each([&](const Incidence& i) { return view.angle_start[decoded(i.hinge)]; });
  const HingeStencilOf<P> stencil{items.each([](const Incidence& i) { return i.stencil.stiffness; }),
                                  items.each([](const Incidence& i) { return i.stencil.rest_angle; })};
  ForceAndBlockOf<P> with = sum;
  DiscreteHinge::add(stencil, material.bending_damping, shape.angle, start, hinge_gradient(shape, opposite), with);
  sum = selected<P>(items.counted && shape.defined, with, sum);
}

/// add_tetrahedron of each, likewise; without damping.
template <class P>
void add_tetrahedra(const SweepView& view, const Items<TetrahedronIncidence, P>& items, const SolidMaterial& material,
                    const Vector<P>& own, ForceAndBlockOf<P>& sum) {
  using Incidence = TetrahedronIncidence;
  const auto weight = [&](int k) { return items.each([k](const Incidence& i) { return i.stencil.weight[k]; }); };
  const TetrahedronStencilOf<P> stencil{{weight(0), weight(1), weight(2)},
                                        items.each([](const Incidence& i) { return i.stencil.inverse; })};
  const auto corner = [&](int k) {
    return items.each_position(
        [&](const Incidence& i) -> const PaddedVec& { return view.old[view.number(i.index[k])]; });
  };
  ForceAndBlockOf<P> with = sum;
  add_tetrahedron(stencil, material, corner(0) - own, corner(1) - own, corner(2) - own, with);
  sum = selected<P>(items.counted, with, sum);
}

/// The W lanes of a team, P::width in a pack.
template <int W, class P>
struct TeamLanes {
  static_assert(W >= P::width);
  ForceAndBlockOf<P> packs[W / P::width];  ///< team lane l in lane l mod P::width of pack l / P::width

  /// Adds a part of `count` items; add(items, sum) adds P::width of them at a time.
  template <class Item, class Add>
  void add_part(const Item* items, int count, Add add) {
    for (int first = 0; first < W && first < count; first += P::width) {
      ForceAndBlockOf<P> own;
      for (int k = first; k < count; k += W) add(Items<Item, P>{items + k, count - k}, own);
      packs[first / P::width] += own;
    }
  }

  /// Adds a part that was computed one by one.
  void add_part(const TeamLaneSums& part) {
    for (int first = 0; first < W && first < part.count; first += P::width)
      packs[first / P::width] += together<P>(part.sums + first);
  }

  /// The sum of all team lanes, by the tree of SerialTeam.
  ForceAndBlock total() {
    for (int s = W / P::width / 2; s > 0; s /= 2) {
      for (int l = 0; l < s; ++l) packs[l] += packs[l + s];
    }
    const Vector<P>& f = packs[0].force;
    const Symmetric3Of<P>& b = packs[0].block;
    return {{whole(f.x), whole(f.y), whole(f.z)},
            {whole(b.xx), whole(b.xy), whole(b.xz), whole(b.yy), whole(b.yz), whole(b.zz)}};
  }

 private:
  static float whole(const P& a) {
    if constexpr (P::width == 4)
      return (a[0] + a[2]) + (a[1] + a[3]);
    else
      return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
  }
};

/// Adds the contacts of a slot, vertex–facet ones first.
template <int W, class P>
void add_contact_parts(const SweepView& view, int slot, TeamLanes<W, P>& lanes) {
  const ContactRow row = view.contact_rows[slot];
  const ContactIncidence* contacts = view.contacts + row.begin;
  const auto add = [&](const Items<ContactIncidence, P>& items, ForceAndBlockOf<P>& sum) {
    add_contacts(view, items, sum);
  };
  lanes.add_part(contacts, row.vertex_facet, add);
  lanes.add_part(contacts + row.vertex_facet, row.count - row.vertex_facet, add);
}

/// A GatherInPacks.
template <int W>
[[gnu::flatten]] ForceAndBlock gather(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                      const OtherParts& other) {
  using P = std::conditional_t<(W >= WidePack::width), WidePack, Pack>;
  const SurfaceMaterial material = view.materials[vertex.body];
  const Vector<P> here = everywhere<P>(own);
  TeamLanes<W, P> lanes;
  if (other.triangles.sums != nullptr) {
    lanes.add_part(other.triangles);
  } else if (vertex.membrane_count > 0) {
    with_membrane(view.models[vertex.body].membrane, [&]<class Model>(Model) {
      lanes.add_part(view.membrane + vertex.membrane_begin, vertex.membrane_count,
                     [&](const Items<MembraneIncidence, P>& items, ForceAndBlockOf<P>& sum) {
                       add_triangles<Model>(view, items, material, here, sum);
                     });
    });
  }
  if (other.hinges.sums != nullptr) {
    lanes.add_part(other.hinges);
  } else {
    lanes.add_part(view.hinges + vertex.hinge_begin, vertex.hinge_count,
                   [&](const Items<HingeIncidence, P>& items, ForceAndBlockOf<P>& sum) {
                     add_hinges(view, items, material, here, sum);
                   });
  }
  lanes.add_part(other.springs);
  if (other.tetrahedra.sums != nullptr) {
    lanes.add_part(other.tetrahedra);
  } else if (view.tetrahedron_rows != nullptr) {
    const SolidMaterial solid = view.solids[vertex.body];
    const TetrahedronRow row = view.tetrahedron_rows[slot];
    lanes.add_part(view.tetrahedra + row.begin, row.count,
                   [&](const Items<TetrahedronIncidence, P>& items, ForceAndBlockOf<P>& sum) {
                     add_tetrahedra(view, items, solid, here, sum);
                   });
  }
  lanes.add_part(other.volumes);
  lanes.add_part(other.segments);
  add_contact_parts(view, slot, lanes);
  return lanes.total();
}

}  // namespace packed
}  // namespace OGC_PACKS
}  // namespace ogc::fast
