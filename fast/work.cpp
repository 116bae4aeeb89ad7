// Counts the work of an iteration from the source. Operations: each +, −, ×, ÷ and root of fast/kernels on the path of
// the default models counts one. Comparisons, negations and the additions that join team lanes do not count. Of several
// branches, the longest one that generic input takes is counted. Bytes: each struct that is read counts once per
// iteration, even if a cache serves it, because no order of work can avoid this read. The searches' work depends on the
// state, so their nodes, candidates and distances are counted during a detection.
#include "fast/contestant.hpp"

#include <algorithm>
#include <stdexcept>

#include "fast/cpu/backend.hpp"
#include "fast/kernels/rods/segments.hpp"
#include "fast/kernels/sweep/update_vertex.hpp"
#include "fast/probes/contact_engine.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/rest_state.hpp"

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
    Search search = searches.query.begin(i);
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

/// Adds the work of a kind's elements: each element counts for each of its free vertices.
template <class Kind>
void add_elements(const RestState& rest, SweepWork& work) {
  const AtRest<Kind>& all = at_rest<Kind>(rest);
  double incidences = 0, damped = 0;
  bool has_start = false;
  for (int i = 0; i < static_cast<int>(all.elements().size()); ++i) {
    const auto& element = all.elements()[as_index(i)];
    double free = 0;
    for (int k = 0; k < Kind::count(element); ++k)
      free += rest.mobility[as_index(Kind::vertices(element)[k])] == Mobility::free ? 1 : 0;
    incidences += free;
    if (!all.damps(rest, i)) continue;
    damped += free;
    has_start = true;
  }
  if (incidences == 0) return;
  work.flop += incidences * Kind::flop + damped * Kind::damping_flop;
  work.bytes += incidences * sizeof(typename Kind::Incidence);
  if (Kind::row_in_vertex < 0) work.bytes += static_cast<double>(work.vertices) * sizeof(Row);
  if constexpr (!std::is_same_v<typename Kind::Beside, NoData>) {
    if (all.reads_beside(rest)) work.bytes += damped * sizeof(typename Kind::Beside);
  }
  if constexpr (!std::is_same_v<typename Kind::Start, NoData>) {
    if (has_start) work.bytes += static_cast<double>(all.elements().size() * sizeof(typename Kind::Start));
  }
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
  work.colours += colouring.count;
  work.flop += segments * orientation_flop + damped * orientation_damping_flop;
  // q is read and written; damping also reads qᵗ and the vector c of rod_rest_direction
  work.bytes += segments * (sizeof(SegmentSlot) + 2 * sizeof(Quat)) + damped * (sizeof(Quat) + sizeof(Vec));
}

}  // namespace

SweepWork sweep_work(const compare::Scene& scene) {
  const compare::Topology topology = compare::build_topology(scene);
  const RestState rest = build_rest_state(scene, topology);
  SweepWork work;
  work.vertices = static_cast<int>(std::ranges::count(rest.mobility, Mobility::free));
  work.colours = colour_vertices(rest).count;
  const double vertices = work.vertices;
  work.flop = vertices * vertex_flop;
  // Reads x (padded), y, X_prev and b_v; writes x padded and unpadded.
  work.bytes = vertices *
               (sizeof(SweepVertex) + sizeof(ContactRow) + 2 * sizeof(PaddedVec) + 3 * sizeof(Vec) + sizeof(float));
  Kinds::for_each([&]<class Kind>(Kind) { add_elements<Kind>(rest, work); });
  add_quaternions(rest, work);
  work.flop_vertex_facet = contact_vertices * (contact_flop + on_triangle_flop);
  work.flop_edge_edge = contact_vertices * (contact_flop + on_segments_flop);
  work.bytes_contact = contact_vertices * sizeof(ContactIncidence);
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
