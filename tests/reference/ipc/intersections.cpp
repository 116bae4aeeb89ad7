#include "reference/ipc/intersections.hpp"

#include "compare/oracle/audit.hpp"
#include "tests/catch.hpp"
#include "tests/reference/energies/stencils.hpp"

using namespace ogc;
using namespace ogc::reference;
using compare::Index;

namespace {

/// Two soups of triangles that cross each other. Vertices lie on a coarse lattice, so there are many edges in planes of
/// triangles, ends on edges, and equal corners.
struct Soup {
  State x;
  std::vector<compare::Triangle> triangles;
};

Soup lattice_soup(unsigned seed, int triangles, int lattice) {
  tests::Draw draw(seed);
  Soup soup;
  for (Index t = 0; t < triangles; ++t) {
    for (int k = 0; k < 3; ++k) {
      Triple<double>& corner = soup.x.emplace_back();
      for (double& c : corner) c = std::floor(draw.between(0, lattice));
    }
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return soup;
}

}  // namespace

TEST_CASE("intersections: the guard finds what the audit finds, on lattices where nearly everything is degenerate",
          "[agreement]") {
  for (const int lattice : {3, 4, 8}) {
    const Soup soup = lattice_soup(static_cast<unsigned>(lattice), 60, lattice);
    const compare::Topology topology = compare::build_topology(static_cast<Index>(soup.x.size()), soup.triangles);
    std::vector<compare::Vec3> positions;
    for (const auto& p : soup.x) positions.push_back({p[0], p[1], p[2]});
    std::vector<EdgeThroughTriangle> expected;
    for (const compare::Intersection& i : compare::audit(topology, positions, {}, {.limit = 100000}).intersections)
      if (i.kind == compare::IntersectionKind::edge_triangle) expected.push_back({i.first, i.second});
    const compare::Exclusions none;
    const std::vector<float> rest(topology.edges.size(), 1);
    CHECK(!expected.empty());
    CHECK(intersections({topology, none, rest}, soup.x) == expected);
  }
}
