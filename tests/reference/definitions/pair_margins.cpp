#include "reference/definitions/pair_margins.hpp"

#include <algorithm>

#include "reference/definitions/contact_sets.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::BlockMargin;

namespace {

bool all_hold(const std::vector<BlockMargin>& margins) { return std::ranges::all_of(margins, &BlockMargin::holds); }
bool signs_fit(const std::vector<BlockMargin>& margins) {
  return std::ranges::all_of(margins, [](const BlockMargin& m) { return m.sign == (m.length > 0) - (m.length < 0); });
}

}  // namespace

TEST_CASE("pair margins: two crossing edges, and a vertex beside an edge, by hand", "[unit]") {
  const Surface cross{{{-1, 0, 0}, {3, 0, 0}, {0, -1, 0.5f}, {0, 3, 0.5f}}, {}, {{0, 1}, {2, 3}}, {}};
  const auto topology = cross.topology();
  const auto margins = reference::pair_margins({topology, cross.positions},
                                               {reference::edge_face(0), reference::edge_face(1), 0, 1}, 1);
  const auto lengths = [](const std::vector<BlockMargin>& all) {
    std::vector<double> result;
    for (const BlockMargin& m : all) result.push_back(m.length);
    return result;
  };
  CHECK(lengths(margins.first) == std::vector<double>{0.5, 1, 3});
  CHECK(lengths(margins.second) == std::vector<double>{0.5, 1, 3});
  // Vertex 2, an end of the chain 2–3, lies next to the middle of edge 0–1. Its block ends at the plane perpendicular
  // to edge 2–3.
  const Surface beside{{{-1, 0, 0}, {3, 0, 0}, {0, 0.5f, 0}, {0, 2, 0}}, {}, {{0, 1}, {2, 3}}, {}};
  const auto near = beside.topology();
  const auto end = reference::pair_margins({near, beside.positions},
                                           {reference::vertex_face(2), reference::edge_face(0), 1, 0}, 1);
  CHECK(lengths(end.first) == std::vector<double>{0.5, 0.5});
  CHECK(end.first[1].closed);
  CHECK(lengths(end.second) == std::vector<double>{0.5, 1, 3});
}

TEST_CASE("pair margins: those of every contact of the zoo hold, and lengths have the exact signs", "[property]") {
  std::size_t contacts = 0, parallel = 0;
  for (const Specimen& specimen : mesh_zoo()) {
    if (specimen.collapsed || specimen.name.find("times") != std::string::npos) continue;
    const auto topology = specimen.surface.topology();
    const reference::Complex mesh{topology, specimen.surface.positions};
    const auto in = question(specimen.surface, topology, specimen.radius, specimen.radius);
    for (const auto& contact : reference::edge_edge_over_all_pairs(in)) {
      const auto margins = reference::pair_margins(mesh, contact, specimen.radius);
      ++contacts;
      parallel += margins.first.empty();
      CHECK((all_hold(margins.first) && all_hold(margins.second)));
      CHECK((signs_fit(margins.first) && signs_fit(margins.second)));
    }
  }
  CHECK(contacts > 500);
  CHECK(parallel > 10);
  CHECK(parallel < contacts / 2);
}
