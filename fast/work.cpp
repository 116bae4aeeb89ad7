// The work of an iteration, counted from the source. Operations: each +, −, ×, ÷ and root of fast/kernels on the path
// of default models counts one, comparisons, negations and the additions that join team lanes count none; of branches
// the longest that generic input takes. Bytes: the sizes of the very structs that are read, each once an iteration,
// however often a cache serves them: what no order of work can avoid. Searches of the trees depend on the state: there
// nodes, candidates and distances are counted while a detection runs.
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

// Parts that recur: a difference or scaling of vectors 3, dot 5, cross 9, add_force 6, add_identity 3, add_outer 15.

/// fast/kernels/models/st_venant_kirchhoff.hpp: differences 6, F 18, ∇N_a 2, G 20, S 10, its rate 3 + 10, pulls 14,
/// force 9 + 6, F∇N_a 9, weights 7, blocks 17 + 30, geometric 9 + 4.
constexpr double membrane_flop = 174;
/// fast/kernels/models/discrete_hinge.hpp: differences 9, normals 18, squares 25, their limits 4, length 1, projections
/// 12, angle's arguments 11, arctangent2 13, feet 7, divisors 2, gradient 11, moment 5, force 6, block 17.
constexpr double hinge_flop = 141;
/// fast/kernels/models/tetrahedron.hpp, elastic: differences 9 + 6, normal 9, J − 1 7, pull 3, weighted sum 15, forces
/// 6 + 1 + 6, sum of weights 3, identity 3, block 2 + 15.
constexpr double tetrahedron_flop = 85;
/// Its damping: F 45, G 39, own gradient 6, trace 6, stresses 21, pull 15, weights 1 + 7, force 15 + 6, F∇N 15, blocks
/// 2 + 15 + 45.
constexpr double solid_damping_flop = 238;
/// fast/kernels/models/rod.hpp, at one end: difference 3, over its length 5, turned director 30, strain 3, force 6,
/// block 4.
constexpr double rod_flop = 51;
/// fast/kernels/models/orientation.hpp: difference 3, two neighbours 2 · (28 + 7 + 4 + 4), lengths 12, σ 3, ‖b‖ 8,
/// frame 8, parts of b 128 + 4, their lengths 16, one step to the root 26, sum 16, unit 26.
constexpr double orientation_flop = 336;
/// Its damping: two neighbours 2 · (28 + 1 + 43).
constexpr double orientation_damping_flop = 144;
/// fast/kernels/contact_force.hpp and friction_force.hpp, what every kind does: separation 24, normal and distance 10,
/// activation 3, force 7, block 17; friction: moves 12, their sum 21, slip 11, strength 11, force 7, blocks 22.
constexpr double contact_flop = 145;
/// closest_on_triangle, inside: differences 9, normal 9, its square 5, two weights 28, the third 2, quotients 3.
constexpr double on_triangle_flop = 56;
/// closest_on_segments, not parallel: differences 9, three dots 15, cross 9, its square 5, projection 5, limit 2, first
/// parameter 15, second 8, weights 2.
constexpr double on_segments_flop = 70;
/// inertia 12, its inverse 1, solve 28, new position 3, truncation that is not needed 10.
constexpr double vertex_flop = 54;

/// Vertices of a contact of each kind, where its points lie inside: each updates itself from it.
constexpr double contact_vertices = 4;

/// squared_gaps of four children: six differences, three products and two sums each.
constexpr double node_flop = 44;
/// separation of two edges 96 in single precision; their distance: differences 9, normal 9, squares 16, size 8, limits
/// 3, dots 15, feet 6, from four ends 95; what is_pair and meet add 6.
constexpr double edge_distance_flop = 96 + 161 + 6;
/// separation of point and triangle 158; their distance: differences 15, normal 9, squares 21, size 8, limits 3, sides
/// 69, from three edges 67; 6 more.
constexpr double facet_distance_flop = 158 + 192 + 6;
/// Ends of a candidate edge, and its two positions where the distance is taken; likewise of a facet.
constexpr double edge_bytes = sizeof(EdgeEnds), edge_position_bytes = 2 * sizeof(PaddedVec);
constexpr double facet_bytes = sizeof(Facet::corner), facet_position_bytes = 3 * sizeof(PaddedVec);

struct SearchCount {
  std::int64_t nodes = 0, candidates = 0, distances = 0;
};

/// A tree for for_each_near, which asks for a node once, when it opens it.
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

/// The CPU's backend, whose searches are counted; of a detection that is repeated because a list grew the last one
/// counts.
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

/// Adds what tetrahedra cost, each for every free corner of it.
void add_tetrahedra(const RestState& rest, SweepWork& work) {
  const auto is_free = [&](int v) { return rest.mobility[static_cast<std::size_t>(v)] == Mobility::free; };
  double all = 0, damped = 0;
  for (const TetrahedronRest& tetrahedron : rest.tetrahedra) {
    const auto corners = static_cast<double>(std::ranges::count_if(tetrahedron.corner, is_free));
    all += corners;
    if (rest.solids[static_cast<std::size_t>(tetrahedron.body)].damping > 0) damped += corners;
  }
  if (all == 0) return;
  work.flop += all * tetrahedron_flop + damped * solid_damping_flop;
  work.bytes += all * sizeof(TetrahedronIncidence) + damped * sizeof(TetrahedronGradients) +
                static_cast<double>(work.vertices) * sizeof(TetrahedronRow);
  if (damped > 0) work.bytes += static_cast<double>(rest.tetrahedra.size() * sizeof(SolidStrain));
}

/// Adds what rods cost: each segment once and for each of its free ends, and a launch for each colour of segments.
void add_rods(const RestState& rest, SweepWork& work) {
  const Colouring colouring = colour_segments(rest.rods);
  double ends = 0, damped = 0;
  for (const SegmentRest& segment : rest.rods.segments)
    ends += static_cast<double>(std::ranges::count_if(
        segment.end, [&](int v) { return rest.mobility[static_cast<std::size_t>(v)] == Mobility::free; }));
  for (const int e : colouring.order)
    if (rest.rods.segments[static_cast<std::size_t>(e)].damping > 0) ++damped;
  const auto segments = static_cast<double>(colouring.order.size());
  if (ends + segments == 0) return;
  work.colours += colouring.count;
  work.flop += ends * rod_flop + segments * orientation_flop + damped * orientation_damping_flop;
  // q read and written; qᵗ and c where damped
  work.bytes += ends * sizeof(RodIncidence) + static_cast<double>(work.vertices) * sizeof(RodRow) +
                segments * (sizeof(SegmentSlot) + 2 * sizeof(Quat)) + damped * (sizeof(Quat) + sizeof(Vec));
}

}  // namespace

SweepWork sweep_work(const compare::Scene& scene) {
  const compare::Topology topology = compare::build_topology(scene);
  const RestState rest = build_rest_state(scene, topology);
  const auto is_free = [&](int v) { return rest.mobility[static_cast<std::size_t>(v)] == Mobility::free; };
  double triangles = 0, hinges = 0;
  for (const TriangleRest& triangle : rest.triangles)
    triangles += static_cast<double>(std::ranges::count_if(triangle.corner, is_free));
  for (const HingeRest& hinge : rest.hinges)
    hinges += static_cast<double>(std::ranges::count_if(hinge.vertex, is_free));
  const bool damped = std::ranges::any_of(
      rest.materials, [](const SurfaceMaterial& m) { return m.membrane_damping > 0 || m.bending_damping > 0; });
  SweepWork work;
  work.vertices = static_cast<int>(std::ranges::count(rest.mobility, Mobility::free));
  work.colours = colour_vertices(rest).count;
  const double vertices = work.vertices;
  work.flop = vertices * vertex_flop + triangles * membrane_flop + hinges * hinge_flop;
  // x padded, y, X_prev, b_v read; x written padded, and tight.
  work.bytes = vertices * (sizeof(SweepVertex) + sizeof(ContactRow) + 2 * sizeof(PaddedVec) + 3 * sizeof(Vec) +
                           sizeof(float)) +
               triangles * sizeof(MembraneIncidence) + hinges * sizeof(HingeIncidence);
  if (damped)
    work.bytes += static_cast<double>(rest.triangles.size() * sizeof(Symmetric2) + rest.hinges.size() * sizeof(float));
  add_tetrahedra(rest, work);
  add_rods(rest, work);
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
                          static_cast<float>(scene.settings.bound_relaxation)});
  const SearchWork edges = work_of(backend.edges, edge_distance_flop, edge_bytes, edge_position_bytes);
  const SearchWork facets = work_of(backend.facets, facet_distance_flop, facet_bytes, facet_position_bytes);
  return {edges.nodes + facets.nodes, edges.candidates + facets.candidates, edges.distances + facets.distances,
          edges.flop + facets.flop, edges.bytes + facets.bytes};
}

}  // namespace ogc::fast
