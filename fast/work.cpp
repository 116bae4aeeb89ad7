// Counts the work of an iteration from the source. Operations: each +, −, ×, ÷ and root of fast/kernels on the path of
// the default models counts one. Comparisons, negations and the additions that join team lanes do not count. Of several
// branches, the longest one that generic input takes is counted. Bytes: each struct that is read counts once per
// iteration, even if a cache serves it, because no order of work can avoid this read. The searches' work depends on the
// state, so their nodes, candidates and distances are counted during a detection.
//
// The teams of a device cost more than that, and these costs are counted from the scene's streams:
//
// - Idle lanes. A warp instruction does the same for 32 lanes. The n items of a vertex in a part take ⌈n/W⌉ rounds of
//   its W team lanes, and all of them join their sums. The work after the sum occupies as many lanes for one vertex:
//   W, or W/4 in CompactTeams.
// - Sectors. Memory moves sectors of 32 B. Streams are read in their order. Other arrays are read where the numbers of
//   vertices and elements point: each sector that the launch of a colour touches counts once, and again for the next
//   colour, because the caches of the multiprocessors are empty when a launch begins.
// - Launches: one for each colour of vertices and segments, and one for prescribed vertices if there are any.
//
// Warp instructions are a lower bound: two operations count one instruction, as if each product were fused with a sum,
// and an item adds its loads of at most 16 B. Addresses, comparisons, branches, the pool of contacts, and the further
// instructions of a quotient or a root are not counted. Nor is what depends on where contacts are: lanes that they
// leave idle, few if blocks pool them, and sectors that they gather, most of which elements gather in the same launch.
#include "fast/contestant.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "compare/problem/bounds.hpp"
#include "fast/cpu/backend.hpp"
#include "fast/kernels/rods/segments.hpp"
#include "fast/kernels/sweep/update_vertex.hpp"
#include "fast/probes/contact_engine.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/rest_state.hpp"
#include "fast/stages/sweep.hpp"
#include "fast/stages/team_choice.hpp"

namespace ogc::fast {

namespace {

// Operations of small functions: difference or scaling of vectors 3, dot 5, cross 9, add_force 6, add_identity 3,
// add_outer 15.

/// Operations of a segment's update without damping (fast/kernels/models/orientation.hpp): difference 3, two neighbours
/// 2 · (28 + 7 + 4 + 4), lengths 12, σ 3, ‖b‖ 8, frame 8, parts of b 128 + 4, their lengths 16, one step to the root
/// 26, sum 16, unit 26.
constexpr double orientation_flop = 336;
/// Operations of the damping in a segment's update: two neighbours 2 · (28 + 1 + 43).
constexpr double orientation_damping_flop = 144;
/// Operations that all kinds of contacts share (fast/kernels/contact_force.hpp, friction_force.hpp): separation 24,
/// normal and distance 10, activation 3, force 7, block 17; friction: moves 12, their sum 21, slip 11, strength 11,
/// force 7, blocks 22.
constexpr double contact_flop = 145;
/// Operations of closest_on_triangle inside the triangle: differences 9, normal 9, its square 5, two weights 28, the
/// third weight 2, quotients 3.
constexpr double on_triangle_flop = 56;
/// Operations of closest_on_segments for segments that are not parallel: differences 9, three dots 15, cross 9, its
/// square 5, projection 5, limit 2, first parameter 15, second 8, weights 2.
constexpr double on_segments_flop = 70;
/// Other operations of a vertex's update: inertia 12, its inverse 1, solve 28, new position 3, truncation that changes
/// nothing 10.
constexpr double vertex_flop = 54;

/// Operations of a warp instruction: a product and a sum in each of 32 lanes.
constexpr double warp_flop = 2 * 32;
/// Bytes of a sector, in which memory is moved; bytes that an instruction loads in a lane.
constexpr double sector = 32, load = 16;
/// Warp instructions in which the lanes of a team exchange a sum once: a shuffle and an addition for each of its words.
constexpr double join_instructions = 2.0 * sizeof(ForceAndBlock) / sizeof(float) / 32;
/// Loads of a contact: its incidence (2), x and xᵗ of four vertices.
constexpr double contact_loads = sizeof(ContactIncidence) / load + 8;

/// Number of vertices of a contact between two edge interiors, or between a vertex and a triangle's interior. The
/// update of each vertex computes the contact.
constexpr double contact_vertices = 4;

/// Operations of squared_gaps for four children: six differences, three products and two sums for each child.
constexpr double node_flop = 44;
/// Operations of a candidate edge: separation of two edges in single precision 96; distance 161 (differences 9, normal
/// 9, squares 16, size 8, limits 3, dots 15, feet 6, distances from four ends 95); is_pair and meet 6.
constexpr double edge_distance_flop = 96 + 161 + 6;
/// Operations of a candidate facet: separation of point and triangle 158; distance 192 (differences 15, normal 9,
/// squares 21, size 8, limits 3, sides 69, distances from three edges 67); is_pair and meet 6.
constexpr double facet_distance_flop = 158 + 192 + 6;
/// Bytes of a candidate edge: its ends, and its two positions if the distance is computed. The next line has the bytes
/// of a candidate facet.
constexpr double edge_bytes = sizeof(EdgeEnds), edge_position_bytes = 2 * sizeof(PaddedVec);
constexpr double facet_bytes = sizeof(Facet::corner), facet_position_bytes = 3 * sizeof(PaddedVec);

struct SearchCount {
  std::int64_t nodes = 0, candidates = 0, distances = 0;
};

/// A tree that counts its opened nodes: for_each_near calls node() once for each.
struct CountedTree {
  const TreeView& tree;
  std::int64_t& opened;
  int levels = tree.levels;

  const Quad& node(int level, int j) const {
    ++opened;
    return tree.node(level, j);
  }
};

template <class Query>
SearchCount count_searches(const Searches<Query>& searches) {
  SearchCount count;
  for (int i = 0; i < searches.count && !searches.query.is_off(); ++i) {
    Search search = searches.begin(i);
    for_each_near(CountedTree{searches.tree, count.nodes}, search.box, search.from, search.limit,
                  [&](const Offer& offer) {
                    ++count.candidates;
                    if (!searches.query.is_pair(search, offer)) return;
                    ++count.distances;
                    search.limit = smaller(search.limit, searches.query.meet(search, offer.primitive, offer.gap));
                  });
  }
  return count;
}

/// The CPU's backend, which also counts the work of searches. If a detection is repeated because a list grew, only its
/// last run is counted.
class CountingBackend : public CpuBackend {
 public:
  SearchCount edges, facets;

  template <class EdgeEdge, class VertexFacet>
  void search(const Searches<EdgeEdge>& edge_edge, const Searches<VertexFacet>& vertex_facet) {
    edges = count_searches(edge_edge);
    facets = count_searches(vertex_facet);
  }
};

SearchWork work_of(const SearchCount& count, double distance_flop, double candidate_bytes, double position_bytes) {
  SearchWork work{static_cast<double>(count.nodes), static_cast<double>(count.candidates),
                  static_cast<double>(count.distances)};
  work.flop = work.nodes * node_flop + work.distances * distance_flop;
  work.bytes = work.nodes * sizeof(Quad) + work.candidates * candidate_bytes + work.distances * position_bytes;
  return work;
}

/// The sectors of an array that the launches of an iteration touch. A launch that touches a sector several times moves
/// it once.
class Sectors {
 public:
  explicit Sectors(std::size_t item_bytes) : item_bytes_(item_bytes) {}

  /// Notes that the launch of a colour touches an item. (Beyond 64 colours two launches count as one.)
  void touch(int item, int colour) {
    const std::size_t begin = as_index(item) * item_bytes_;
    for (std::size_t at = begin / width; at <= (begin + item_bytes_ - 1) / width; ++at) {
      if (at >= colours_.size()) colours_.resize(at + 1, 0);
      colours_[at] |= std::uint64_t{1} << (colour % 64);
    }
  }
  /// Returns the bytes that all launches move.
  double bytes() const {
    double count = 0;
    for (const std::uint64_t colours : colours_) count += std::popcount(colours);
    return count * sector;
  }

 private:
  static constexpr auto width = static_cast<std::size_t>(sector);

  std::size_t item_bytes_;
  std::vector<std::uint64_t> colours_;  // by sector, one bit for each colour
};

/// The sectors of positions that elements gather: a neighbour of lower colour is read from the fresh buffer, any other
/// from the old one (sweep_view.hpp).
struct GatheredPositions {
  const std::vector<int>& colour;  ///< by vertex; −1: not free
  Sectors old{sizeof(PaddedVec)}, fresh{sizeof(PaddedVec)};

  void touch(int vertex, int own) { (colour[as_index(vertex)] < own ? fresh : old).touch(vertex, own); }
};

/// Returns how many lanes n items of a vertex occupy: whole rounds of all its team lanes.
double lanes_in_rounds(int items, int width) { return (items + width - 1) / width * width; }

/// The items of a kind at each vertex.
struct ItemCounts {
  std::vector<int> all, damped;  ///< by vertex; damped ones are among all
};

/// Adds the warp instructions of a kind's elements at free vertices.
template <class Kind>
void add_rounds(const ItemCounts& items, int vertices_of_element, int width, SweepWork& work) {
  const double loads = std::ceil(sizeof(typename Kind::Incidence) / load) + vertices_of_element - 1;
  double lanes = 0, damped = 0;
  for (const int count : items.all) lanes += lanes_in_rounds(count, width);
  for (const int count : items.damped) damped += lanes_in_rounds(count, width);
  work.warp_instructions += (lanes * Kind::flop + damped * Kind::damping_flop) / warp_flop + lanes * loads / 32;
}

/// Adds the work of a kind's elements: each element counts for each of its free vertices.
template <class Kind>
void add_elements(const RestState& rest, int width, GatheredPositions& positions, SweepWork& work) {
  const AtRest<Kind>& all = at_rest<Kind>(rest);
  ItemCounts items{std::vector<int>(rest.mass.size()), std::vector<int>(rest.mass.size())};
  Sectors starts(sizeof(typename Kind::Start));
  double incidences = 0, damped = 0, begun = 0;  // begun: elements of which some update reads Start
  int least = std::numeric_limits<int>::max();
  for (int i = 0; i < static_cast<int>(all.elements().size()); ++i) {
    const auto& element = all.elements()[as_index(i)];
    const int count = Kind::count(element);
    const int* vertices = Kind::vertices(element);
    const bool is_damped = all.damps(rest, i);
    const double before = incidences;
    least = std::min(least, count);
    for (int k = 0; k < count; ++k) {
      const int own = positions.colour[as_index(vertices[k])];
      if (own < 0) continue;
      incidences += 1;
      damped += is_damped ? 1 : 0;
      ++items.all[as_index(vertices[k])];
      items.damped[as_index(vertices[k])] += is_damped ? 1 : 0;
      for (int other = 0; other < count; ++other)
        if (other != k) positions.touch(vertices[other], own);
      if (is_damped) starts.touch(i, own);
    }
    begun += is_damped && incidences > before ? 1 : 0;
  }
  if (incidences == 0) return;
  work.flop += incidences * Kind::flop + damped * Kind::damping_flop;
  add_rounds<Kind>(items, least, width, work);
  double streams = incidences * sizeof(typename Kind::Incidence);
  if (Kind::row_in_vertex < 0) streams += static_cast<double>(work.vertices) * sizeof(Row);
  if constexpr (!std::is_same_v<typename Kind::Beside, NoData>) {
    if (all.reads_beside(rest)) streams += damped * sizeof(typename Kind::Beside);
  }
  work.bytes += streams;
  work.sector_bytes += streams;
  if constexpr (!std::is_same_v<typename Kind::Start, NoData>) {
    work.bytes += begun * sizeof(typename Kind::Start);
    work.sector_bytes += starts.bytes();
  }
}

/// Adds the work of the vertices themselves. `width`: W; `may_be_compact`: whether the teams of large colours may be
/// CompactTeams.
void add_vertices(const Colouring& colouring, int width, bool may_be_compact, int multiprocessors,
                  GatheredPositions& positions, SweepWork& work) {
  const double vertices = work.vertices;
  work.flop += vertices * vertex_flop;
  const double streams = vertices * (sizeof(SweepVertex) + sizeof(ContactRow));
  // Reads x (padded), y, X_prev and b_v; writes x padded and unpadded.
  work.bytes += streams + vertices * (2 * sizeof(PaddedVec) + 3 * sizeof(Vec) + sizeof(float));
  Sectors written(sizeof(PaddedVec)), vectors(sizeof(Vec)), bounds(sizeof(float));
  const double joins = std::bit_width(static_cast<unsigned>(width)) - 1;  // log₂ W
  for (int c = 0; c < colouring.count; ++c) {
    const auto k = static_cast<std::size_t>(c);
    const int first = colouring.begin[k], count = colouring.begin[k + 1] - first;
    const int teams = serial_block_size / width, blocks = (count + teams - 1) / teams;
    // The first warp of a block of CompactTeams has the totals of the whole block.
    const bool is_compact = may_be_compact && has_waves_of_compact(blocks, multiprocessors);
    const double warps = is_compact ? 1.0 / teams : width / 32.0;
    work.warp_instructions += count * (joins * width * join_instructions + warps * vertex_flop / 2);
    for (int slot = first; slot < first + count; ++slot) {
      const int v = colouring.order[as_index(slot)];
      positions.touch(v, c);
      written.touch(v, c), vectors.touch(v, c), bounds.touch(v, c);
    }
  }
  work.sector_bytes += streams + written.bytes() + 3 * vectors.bytes() + bounds.bytes();
}

/// Adds the work of segments' quaternions. Each quaternion is updated once, and each colour of the segments costs a
/// launch.
void add_quaternions(const RestState& rest, SweepWork& work) {
  const Colouring colouring = colour_segments(rest.rods);
  double damped = 0;
  for (const int e : colouring.order)
    if (rest.rods.segments[static_cast<std::size_t>(e)].damping > 0) ++damped;
  const auto segments = static_cast<double>(colouring.order.size());
  if (segments == 0) return;
  work.launches += colouring.count;
  const double flop = segments * orientation_flop + damped * orientation_damping_flop;
  work.flop += flop;
  work.warp_instructions += flop / warp_flop;  // one thread for each segment
  // q is read and written; damping also reads qᵗ and the vector c of rod_rest_direction
  const double bytes = segments * (sizeof(SegmentSlot) + 2 * sizeof(Quat)) + damped * (sizeof(Quat) + sizeof(Vec));
  work.bytes += bytes;
  work.sector_bytes += bytes;
}

}  // namespace

SweepWork sweep_work(const compare::Scene& scene, int multiprocessors) {
  const compare::Topology topology = compare::build_topology(scene);
  const RestState rest = build_rest_state(scene, topology);
  const Colouring colouring = colour_vertices(rest);
  const int width = lanes_of(rest, scene);
  SweepWork work;
  work.vertices = static_cast<int>(colouring.order.size());
  work.launches = colouring.count;
  for (std::size_t v = 0; v < rest.mobility.size(); ++v) {
    if (!is_moved_to_target(rest, scene, v)) continue;
    ++work.launches;
    break;
  }
  int parts = 0;
  DeviceSums::with(DeviceSums::first_that_gives(asked_of_sum(rest, scene)),
                   [&parts](auto sum) { parts = decltype(sum)::parts; });
  const bool has_planes = traits_of(scene.settings.bounds).has_planes;
  GatheredPositions positions{colouring.colour};
  add_vertices(colouring, width, can_be_compact(width, parts) && !has_planes, multiprocessors, positions, work);
  Kinds::for_each([&]<class Kind>(Kind) { add_elements<Kind>(rest, width, positions, work); });
  work.sector_bytes += positions.old.bytes() + positions.fresh.bytes();
  add_quaternions(rest, work);
  work.flop_vertex_facet = contact_vertices * (contact_flop + on_triangle_flop);
  work.flop_edge_edge = contact_vertices * (contact_flop + on_segments_flop);
  work.bytes_contact = contact_vertices * sizeof(ContactIncidence);
  const double loads = contact_vertices * contact_loads / 32;
  work.warp_instructions_vertex_facet = work.flop_vertex_facet / warp_flop + loads;
  work.warp_instructions_edge_edge = work.flop_edge_edge / warp_flop + loads;
  return work;
}

SearchWork search_work(const compare::Scene& scene, std::span<const compare::Vec3f> positions, float query_radius) {
  if (positions.size() != scene.mesh.positions.size())
    throw std::invalid_argument("search_work: positions of another mesh");
  const compare::Topology topology = compare::build_topology(scene);
  CountingBackend backend;
  BackendContactEngine<CountingBackend> engine(backend, topology, compare::exclusions(scene));
  engine.find(positions, {static_cast<float>(scene.settings.contact_radius), query_radius,
                          static_cast<float>(scene.settings.bounds_relaxation)});
  const SearchWork edges = work_of(backend.edges, edge_distance_flop, edge_bytes, edge_position_bytes);
  const SearchWork facets = work_of(backend.facets, facet_distance_flop, facet_bytes, facet_position_bytes);
  return {edges.nodes + facets.nodes, edges.candidates + facets.candidates, edges.distances + facets.distances,
          edges.flop + facets.flop, edges.bytes + facets.bytes};
}

}  // namespace ogc::fast
