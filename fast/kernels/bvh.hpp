// Builds a tree of boxes over primitives (facets or edges) in the order of a Hilbert curve, four children to a node.
// The children of level 0 are the primitives; the children of each level above are the nodes of the level below. Node j
// of level l has the children 4j … 4j + 3 of level l − 1, so only the start of each level is stored. A traversal keeps
// the children that it still has to visit in one integer, four bits a level. Boxes enclose primitives at their current
// positions and are not inflated: a query adds its own radius.
//
// Each child also has a `reach`, the distance up to which pairs of its primitives matter. A pair matters only if it is
// nearer than r or could lower the smallest distance of a primitive. For most primitives a neighbour in the mesh bounds
// this smallest distance far below r_q before any search.
#pragma once

#include <cstdint>

#include "fast/kernels/arithmetic/atomic.hpp"
#include "fast/kernels/segment.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// Larger than every distance: used for corners of empty boxes, and for distances to missing neighbours.
inline constexpr float infinity = __builtin_huge_valf();

/// A closed box; empty at first.
struct Box {
  Vec lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};  ///< corners [m]

  /// Grows the box to the smallest one that also holds a point or another box.
  OGC_HD void include(const Vec& p) { include(Box{p, p}); }
  OGC_HD void include(const Box& b) {
    lower = {smaller(lower.x, b.lower.x), smaller(lower.y, b.lower.y), smaller(lower.z, b.lower.z)};
    upper = {larger(upper.x, b.upper.x), larger(upper.y, b.upper.y), larger(upper.z, b.upper.z)};
  }
};

/// Returns the gap between two intervals; 0 if they meet.
OGC_HD inline float gap(float lower, float upper, float other_lower, float other_upper) {
#if defined(__CUDA_ARCH__)
  // On a device each call is one instruction. A zero may have the other sign, but only its square is used.
  return fmaxf(fmaxf(sub(lower, other_upper), sub(other_lower, upper)), 0.0F);
#else
  return larger(larger(sub(lower, other_upper), sub(other_lower, upper)), 0.0F);
#endif
}

/// Returns the squared distance between two boxes. It is at most (1 + u)⁵ times the exact one, u = 2⁻²⁴: rounding of
/// one difference (squared, so twice), one product and two sums. Boxes inside `a` and `b` never give less.
OGC_HD inline float squared_gap(const Box& a, const Box& b) {
  const float x = gap(a.lower.x, a.upper.x, b.lower.x, b.upper.x), y = gap(a.lower.y, a.upper.y, b.lower.y, b.upper.y);
  const float z = gap(a.lower.z, a.upper.z, b.lower.z, b.upper.z);
  return add(add(mul(x, x), mul(y, y)), mul(z, z));
}

/// Returns a lower bound of the exact distance between two boxes whose squared_gap is `squared`. The factor 1 − 8 u
/// covers the rounding errors of the gap (2.5 u), the root (u) and this product (u), u = 2⁻²⁴. Products that underflow
/// err by 2⁻¹⁵⁰ each; from 2⁻¹⁰⁰ on that is far less than u. Below, the bound is 0.
OGC_HD inline float gap_below(float squared) {
  return squared > 0x1p-100F ? mul(square_root(squared), 1 - 0x1p-21F) : 0.0F;
}

/// Returns the limit of squared gaps for a reach: boxes with a larger squared gap have gap_below ≥ reach. With u = 2⁻²⁴
/// the factor is 1 + 64 u; 20 u for gap_below and 2 u for the two products here would suffice.
OGC_HD inline float gap_limit(float reach) { return mul(mul(reach, reach), 1 + 0x1p-18F); }

/// Holds a box, the gap limit of its reach and, in level 0, its primitive. A device reads it in two loads of 16 B.
struct alignas(16) Child {
  Vec lower{infinity, infinity, infinity};     ///< lower corner of the box [m]
  float reach = 0;                             ///< gap limit of the largest reach of its primitives [m²]
  Vec upper{-infinity, -infinity, -infinity};  ///< upper corner of the box [m]
  int primitive = -1;  ///< number of the facet or edge; −1 above level 0 and in an empty child

  OGC_HD Box box() const { return {lower, upper}; }
};

/// Holds the four children of a node; missing children are empty. A node fills one cache line of a device.
struct alignas(128) Quad {
  /// child k of node j is node 4 j + k of the level below, or in level 0 the primitive at place 4 j + k
  Child child[4];

  OGC_HD Box whole() const {
    Box all = child[0].box();
    for (int k = 1; k < 4; ++k) all.include(child[k].box());
    return all;
  }
  OGC_HD float whole_reach() const {
    return larger(larger(child[0].reach, child[1].reach), larger(child[2].reach, child[3].reach));
  }
};

inline constexpr int max_levels = 16;  ///< a traversal has 64 bits, 4 a level, so a tree may have 4¹⁶ primitives

/// Holds a tree on the backend.
struct TreeView {
  Quad* nodes = nullptr;       ///< level by level; level l begins at start[l]
  const int* order = nullptr;  ///< primitive at each place
  int count = 0;               ///< primitives
  int levels = 0;              ///< at least 2; the last has one node
  int start[max_levels] = {};  ///< number of each level's first node

  OGC_HD Quad& node(int level, int j) const { return nodes[start[level] + j]; }
};

/// Returns the number of the lowest bit that is set; n > 0.
OGC_HD inline int lowest_bit(std::uint64_t n) {
#if defined(__CUDA_ARCH__)
  return __ffsll(static_cast<long long>(n)) - 1;
#else
  return __builtin_ctzll(n);
#endif
}

/// Holds the squared gaps between a box and the four children of a node. `near` has a bit for each child whose gap is
/// within the limit or the child's own reach.
struct QuadGaps {
  float child[4];  ///< squared gaps [m²]
  unsigned near;   ///< bit k: child k

  OGC_HD float operator[](int i) const {
    return i < 2 ? (i == 0 ? child[0] : child[1]) : (i == 2 ? child[2] : child[3]);
  }
};

#if defined(__CUDACC__)

/// Computes the gaps; `limit` is a gap_limit [m²].
OGC_HD inline QuadGaps squared_gaps(const Quad& quad, const Box& box, float limit) {
  QuadGaps gaps{{}, 0};
  for (unsigned i = 0; i < 4; ++i) {
    gaps.child[i] = squared_gap(quad.child[i].box(), box);
    gaps.near |= static_cast<unsigned>(gaps.child[i] <= larger(limit, quad.child[i].reach)) << i;
  }
  return gaps;
}

#else

/// Computes all four gaps at once; defined in fast/cpu/packed_gaps.hpp.
inline QuadGaps squared_gaps(const Quad& quad, const Box& box, float limit);

#endif

/// A primitive that a traversal finds near the box of the query.
struct Offer {
  int primitive;     ///< number of the facet or edge
  float gap, reach;  ///< squared gap and gap limit [m²]
};

/// Calls visit(offer) for every primitive, at place `from` or later, whose squared gap to `box` is at most `limit` or
/// the gap limit of the primitive's own reach. The visitor may lower `limit` during the traversal. `Tree` is a
/// TreeView, or a type that counts opened nodes (fast/work.cpp).
template <class Tree, class Visit>
OGC_HD void for_each_near(const Tree& tree, const Box& box, int from, const float& limit, Visit visit) {
  QuadGaps gaps;
  const Quad* quad = nullptr;
  const auto near_children = [&](int level, int j) {
    quad = &tree.node(level, j);
    gaps = squared_gaps(*quad, box, limit);
    const int passed = (from >> (2 * level)) - 4 * j;  // number of children whose primitives all lie before `from`
    return passed > 0 ? gaps.near & 15U << (passed < 4 ? passed : 4) : gaps.near;
  };
  int level = tree.levels - 1, j = 0;
  std::uint64_t pending = near_children(level, j);
  while (true) {
    if ((pending & 15U) == 0) {
      if (++level == tree.levels) return;
      pending >>= 4, j >>= 2;
      continue;
    }
    const int child = 4 * j + lowest_bit(pending);
    pending &= pending - 1;
    unsigned near = near_children(level - 1, child);
    if (level > 1) {
      pending = pending << 4 | near;
      --level, j = child;
      continue;
    }
    for (; near != 0; near &= near - 1) {
      const int leaf = lowest_bit(near);
      visit(Offer{quad->child[leaf].primitive, gaps[leaf], quad->child[leaf].reach});
    }
  }
}

/// Computes the reach of primitives: the smaller of r_q and an upper bound of the primitive's smallest distance. The
/// bound is the distance between a vertex and an edge nearby in the mesh (SurfaceView's seeds). The query must find a
/// pair that contains this vertex and this edge, so the smallest distance is at most this bound.
struct Reach {
  SurfaceView surface;
  const Vec* positions;       ///< by vertex [m]
  const float* query_radius;  ///< r_q [m], on the backend
  /// With planes: by vertex, the distance up to which its pairs matter (LimitSearches) [m]. It takes the place of the
  /// bound above. Null without planes.
  const float* search_limit = nullptr;
  float least = 0;  ///< with planes: r with the contact margin, because contacts need all nearer pairs [m]

  /// Returns the reach of an edge [m].
  OGC_HD float of_edge(int e) const {
    if (search_limit != nullptr)
      return within(larger(search_limit[surface.edges[e].a], search_limit[surface.edges[e].b]));
    Nearest nearest;
    for (const int v : surface.edge_seeds[e].vertex) consider(nearest, v, surface.edges[e].a, surface.edges[e].b);
    return above(nearest);
  }
  /// Returns the reach of a facet [m].
  OGC_HD float of_facet(int t) const {
    const Facet& facet = surface.facets[t];
    if (search_limit != nullptr)
      return within(
          larger(larger(search_limit[facet.corner[0]], search_limit[facet.corner[1]]), search_limit[facet.corner[2]]));
    Nearest nearest;
    for (int k = 0; k < 3; ++k)
      consider(nearest, surface.facet_seeds[t].vertex[k], facet.corner[k], facet.corner[(k + 1) % 3]);
    return above(nearest);
  }
  /// Returns the reach of a vertex [m].
  OGC_HD float of_vertex(int v) const {
    if (search_limit != nullptr) return within(search_limit[v]);
    Nearest nearest;
    for (const int e : surface.vertex_seeds[v].edge) {
      if (e >= 0) consider(nearest, v, surface.edges[e].a, surface.edges[e].b);
    }
    return above(nearest);
  }

 private:
  struct Nearest {
    double squared = infinity, size = 0;
  };
  /// Returns the smaller of r_q and a search limit d. The distances of a detection err by up to 6 · 2⁻²⁴ S, where S
  /// is the sum of the 1-norms of a pair's differences (separation.hpp). The factor covers this if S ≤ 2,700 d. For
  /// larger S rounding could choose another pair as a vertex's 17th nearest; its region would still be safe.
  OGC_HD float within(float distance) const {
    return smaller(*query_radius, larger(least, mul(distance, 1 + 0x1p-10F)));
  }
  OGC_HD void consider(Nearest& nearest, int v, int a, int b) const {
    if (v < 0) return;
    const Real u = difference<Rounded>(positions[v], positions[a]), e = difference<Rounded>(positions[b], positions[a]);
    nearest.squared = smaller(nearest.squared, squared_to_segment(u, e));
    nearest.size = larger(nearest.size, add(norm_1(u), norm_1(e)));
  }
  /// Returns the reach: the smaller of r_q and the nearest distance, rounded up. 2⁻⁴⁶ `size` is added to the distance;
  /// this is four times the error of the root of squared_to_segment.
  OGC_HD float above(const Nearest& nearest) const {
    return smaller(*query_radius, round_up(add(square_root(nearest.squared), mul(0x1p-46, nearest.size))));
  }
};

/// Returns the number of nodes of a level; for level −1 the number of primitives. A tree without primitives has one
/// node of empty children, so the result is at least 1.
OGC_HD inline int level_size(int count, int level) { return count > 0 ? ((count - 1) >> (2 * level + 2)) + 1 : 1; }

/// Computes the boxes and gap limits of all primitives and nodes, and the gap limits of vertices. Runs once for each
/// place of facets, then for each place of edges, then for each vertex; each of the three groups is padded to a
/// multiple of 32. A thread climbs from its primitive to the root. At each node only the last thread that completes one
/// of its 16 grandchildren continues, so one launch refits the whole tree. No bit depends on which thread continues.
/// The 32 threads of a warp must call this together, because they exchange the lowest two levels in registers.
struct RefitTrees {
  Reach reach;
  TreeView facets, edges;               ///< in the order of the last sort; boxes and gap limits are written
  int *facet_arrivals, *edge_arrivals;  ///< a counter for each node, 0 between two launches
  float* vertex_limit;                  ///< by vertex: gap limit of its reach [m²], written
  int vertex_count;

  /// `filled_up` returns `count` rounded up to whole warps, count() the number of items of the launch.
  OGC_HD static int filled_up(int count) { return (count + 31) / 32 * 32; }
  OGC_HD int count() const { return filled_up(facets.count) + filled_up(edges.count) + filled_up(vertex_count); }

  OGC_HD void operator()(int i) const {
    const int edge_place = i - filled_up(facets.count), v = edge_place - filled_up(edges.count);
    if (edge_place < 0) {
      place(facets, facet_arrivals, i, [this](int t) { return facet_child(t); });
    } else if (v < 0) {
      place(edges, edge_arrivals, edge_place, [this](int e) { return edge_child(e); });
    } else if (v < vertex_count) {
      vertex_limit[v] = gap_limit(reach.of_vertex(v));
    }
  }

  /// Writes the child at a place of a tree and refits the nodes above it. A place beyond the primitives gets an empty
  /// child.
  template <class Of>
  OGC_HD static void place(const TreeView& tree, int* arrivals, int j, Of child_of) {
    Child own;
    if (j < tree.count) own = child_of(tree.order[j]);
    climb(tree, arrivals, j, own);
  }

 private:
  OGC_HD Child facet_child(int t) const {
    Box box;
    for (const int corner : reach.surface.facets[t].corner) box.include(reach.positions[corner]);
    return {box.lower, gap_limit(reach.of_facet(t)), box.upper, t};
  }
  OGC_HD Child edge_child(int e) const {
    Box box;
    box.include(reach.positions[reach.surface.edges[e].a]);
    box.include(reach.positions[reach.surface.edges[e].b]);
    return {box.lower, gap_limit(reach.of_edge(e)), box.upper, e};
  }

#if defined(__CUDA_ARCH__)

  static constexpr unsigned everyone = 0xffffffffU;

  /// Returns the union of four threads' children to all four threads. The lane numbers of these threads differ by
  /// `apart`, 2 `apart` and 3 `apart`.
  OGC_HD static Child of_four(Child child, int apart) {
    for (int step = apart; step <= 2 * apart; step *= 2) {
      const auto other = [step](float number) { return __shfl_xor_sync(everyone, number, step); };
      Box box = child.box();
      box.include(Box{{other(child.lower.x), other(child.lower.y), other(child.lower.z)},
                      {other(child.upper.x), other(child.upper.y), other(child.upper.z)}});
      child = {box.lower, larger(child.reach, other(child.reach)), box.upper, -1};
    }
    return child;
  }

  /// Writes the child at a place and refits the nodes above it. 16 neighbouring threads continue together as long as
  /// they are the last to complete a node's grandchildren; then each reads one grandchild.
  OGC_HD static void climb(const TreeView& tree, int* arrivals, int j, Child own) {
    const int lane = static_cast<int>(threadIdx.x % 16);
    int node = j / 16;  // node of `level`
    bool goes_on = j - lane < tree.count;
    if (j < tree.count) tree.node(0, j / 4).child[j % 4] = own;
    for (int level = 1;; level += 2) {
      const Child four = of_four(own, 1), sixteen = of_four(four, 4);
      if (goes_on && lane % 4 == 0 && 4 * node + lane / 4 < level_size(tree.count, level - 1))
        tree.node(level, node).child[lane / 4] = four;
      if (goes_on && lane == 0 && level + 1 < tree.levels) tree.node(level + 1, node / 4).child[node % 4] = sixteen;
      if (level + 2 >= tree.levels) return;
      const int above = node / 16, children = level_size(tree.count, level) - 16 * above;
      if (goes_on && lane == 0)
        goes_on = arrives_last(&arrivals[tree.start[level + 2] + above], children < 16 ? children : 16);
      goes_on = __shfl_sync(everyone, goes_on ? 1 : 0, static_cast<int>(threadIdx.x % 32 - threadIdx.x % 16)) != 0;
      if (!__any_sync(everyone, goes_on)) return;
      __syncwarp();
      node = above;
      const int below = 4 * node + lane / 4;
      own = goes_on && below < level_size(tree.count, level + 1) ? tree.node(level + 1, below).child[lane % 4]
                                                                 : Child{};
    }
  }

#else

  /// Writes the child at a place and refits the nodes above it, up to the first node that waits for another thread.
  OGC_HD static void climb(const TreeView& tree, int* arrivals, int j, const Child& own) {
    if (j >= tree.count) return;
    tree.node(0, j / 4).child[j % 4] = own;
    for (int level = 1; level < tree.levels; level += 2) {
      j /= 16;
      const int children = level_size(tree.count, level - 2) - 16 * j;
      if (!arrives_last(&arrivals[tree.start[level] + j], children < 16 ? children : 16)) return;
      refit_node(tree, level, j);
    }
  }

  /// Returns the box and the reach of a node as a child of the node above it.
  OGC_HD static Child whole(const Quad& quad) {
    const Box box = quad.whole();
    return {box.lower, quad.whole_reach(), box.upper, -1};
  }

  /// Writes the children of node j of `level` from the level below, and enters node j as a child in the level above.
  OGC_HD static void refit_node(const TreeView& tree, int level, int j) {
    Quad& quad = tree.node(level, j);
    const int below = level_size(tree.count, level - 1);
    for (int k = 0; k < 4 && 4 * j + k < below; ++k) {
      quad.child[k] = whole(tree.node(level - 1, 4 * j + k));
    }
    if (level + 1 < tree.levels) tree.node(level + 1, j / 4).child[j % 4] = whole(quad);
  }

#endif
};

/// Returns the 20 low bits of n, with two zero bits between neighbouring bits.
OGC_HD inline std::uint64_t spread_bits(std::uint64_t n) {
  n = (n | n << 32) & 0x001f00000000ffffULL;
  n = (n | n << 16) & 0x001f0000ff0000ffULL;
  n = (n | n << 8) & 0x100f00f00f00f00fULL;
  n = (n | n << 4) & 0x10c30c30c30c30c3ULL;
  return (n | n << 2) & 0x1249249249249249ULL;
}

/// A cell of a grid that has 2²⁰ cells along each axis.
struct Cell {
  std::uint32_t axis[3];  ///< along x, y and z, below 2²⁰
};

/// Returns the place of a cell on the Hilbert curve (Skilling 2004, "Programming the Hilbert curve"). Consecutive cells
/// on the curve touch, so four consecutive primitives lie close together. In Morton's order they may be far apart, and
/// nodes overlap more (fast/PERFORMANCE.md).
OGC_HD inline std::uint64_t hilbert_key(Cell cell) {
  constexpr std::uint32_t top = 1U << 19;
  std::uint32_t* x = cell.axis;
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t exchanged = (x[k] & bit) != 0 ? 0 : (x[0] ^ x[k]) & below;
      x[0] ^= (x[k] & bit) != 0 ? below : exchanged;
      x[k] ^= exchanged;
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flips = 0;
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) flips ^= (x[2] & bit) != 0 ? bit - 1 : 0;
  return spread_bits(x[0] ^ flips) << 2 | spread_bits(x[1] ^ flips) << 1 | spread_bits(x[2] ^ flips);
}

/// Writes the Hilbert keys of all vertices, edges and facets that take part in searches. The two bits above each key
/// tell vertices, edges and facets apart, so that one sort orders all of them.
struct HilbertKeys {
  static constexpr int kind_bit = 60;
  /// Lowest bit that the sort compares. The bits above it distinguish cells of a 1024th of the extent. Few primitives
  /// share such a cell; these remain in the order of their numbers.
  static constexpr int lowest_sorted_bit = 30;

  SurfaceView surface;
  const Vec* positions;    ///< by vertex [m]
  TreeView facets, edges;  ///< refitted; their roots give the extent
  /// the upper bits, from kind_bit on: 0 vertex, 1 edge, 2 facet; the lower bits: place on the curve
  std::uint64_t* keys;
  int* values;  ///< number of the vertex, edge or facet; the sort moves it with its key

  OGC_HD void operator()(int i) const {
    const int e = i - surface.searched_vertices, t = e - surface.searched_edges, place = e < 0 ? i : (t < 0 ? e : t);
    const int number = surface.searched != nullptr ? surface.searched[i] : place;
    Box box;
    if (e < 0) {
      box.include(positions[number]);
    } else if (t < 0) {
      box.include(positions[surface.edges[number].a]);
      box.include(positions[surface.edges[number].b]);
    } else {
      for (const int corner : surface.facets[number].corner) box.include(positions[corner]);
    }
    values[i] = number;
    keys[i] = static_cast<std::uint64_t>(e < 0 ? 0 : (t < 0 ? 1 : 2)) << kind_bit | hilbert_key(cell(box));
  }

 private:
  OGC_HD Cell cell(const Box& box) const {
    Box root = edges.node(edges.levels - 1, 0).whole();
    root.include(facets.node(facets.levels - 1, 0).whole());
    const auto length = [](float low, float high) { return sub(static_cast<double>(high), static_cast<double>(low)); };
    const double extent = larger(larger(length(root.lower.x, root.upper.x), length(root.lower.y, root.upper.y)),
                                 length(root.lower.z, root.upper.z));
    const double scale = extent > 0 ? divide(0x1p20 - 1, extent) : 0;
    const auto along = [scale](float low, float high, float origin) {
      const double middle = mul(0.5, add(static_cast<double>(low), static_cast<double>(high)));
      const double place = mul(sub(middle, static_cast<double>(origin)), scale);
      return place > 0 ? static_cast<std::uint32_t>(smaller(place, 0x1p20 - 1)) : 0U;
    };
    return {{along(box.lower.x, box.upper.x, root.lower.x), along(box.lower.y, box.upper.y, root.lower.y),
             along(box.lower.z, box.upper.z, root.lower.z)}};
  }
};

}  // namespace ogc::fast
