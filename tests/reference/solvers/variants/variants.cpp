// Tests that each ablation has the effect of its name, and that its default changes nothing.
#include "reference/solvers/variants/settings.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "compare/problem/error.hpp"
#include "compare/problem/readers.hpp"
#include "reference/simulation.hpp"
#include "reference/solvers/colouring.hpp"
#include "reference/solvers/detection.hpp"
#include "reference/solvers/kinds/rest_state.hpp"
#include "reference/solvers/potential_batches.hpp"
#include "reference/solvers/variants/contact_sets.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/runs.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::operator-;

namespace {

/// Returns a level sheet 2 mm above a larger one; no vertex lies above another.
compare::Scene level_sheets() {
  compare::Scene scene;
  scene.name = "level_sheets";
  add_sheet(scene, 6, 0.05, 2e-3, false);
  add_sheet(scene, 9, 0.13, 0, true);
  for (std::size_t v = 0; v < 36; ++v) {
    const compare::Vec3 x = scene.mesh.positions[v];
    scene.mesh.positions[v] = {0.9 * x.x - 0.4 * x.z + 1e-3, x.y, 0.4 * x.x + 0.9 * x.z + 2e-3};
  }
  round_to_single(scene);
  return scene;
}

/// A scene at its start, and the data for contact sets.
struct Asked {
  compare::Scene scene;
  compare::Topology topology;
  compare::Exclusions exclusions;
  std::vector<compare::Vec3f> positions;
  std::vector<compare::Index> body;

  explicit Asked(compare::Scene asked)
      : scene(std::move(asked)),
        topology(build_topology(scene)),
        exclusions(compare::exclusions(scene)),
        positions(compare::to_single(scene.mesh.positions)),
        body(body_of_vertex(scene)) {}

  compare::DetectIn in() const {
    const auto radius = static_cast<float>(scene.settings.contact_radius);
    return {&topology, exclusions, positions, radius, radius};
  }
  reference::ContactSets contacts(reference::ContactSet set) const {
    if (set == reference::ContactSet::ogc)
      return reference::detect(scene, topology, exclusions, positions, in().query_radius).sets;
    const reference::ListedContacts listed = reference::contact_variant(set, in(), body);
    return {listed.vertex_facet, listed.edge_edge};
  }
};

Asked askew_sheets() {
  compare::Scene scene = two_sheets();
  scene.settings.contact_radius = 8e-3;
  round_to_single(scene);
  return Asked(std::move(scene));
}

/// Returns Σ‖f_t‖ / Σ‖f‖ of the contact forces on the inner vertices of the level sheet. Vertices at its rim are left
/// out, because contacts beside them push them outwards.
double tangential_share(const Asked& asked, reference::ContactSet set) {
  const reference::State x = reference::widened(asked.positions);
  reference::Potential potential(asked.scene, asked.topology);
  potential.begin_step(x, x);
  const auto forces = [&](const reference::ContactSets& sets) {
    potential.set_contacts(sets, x);
    return potential.derivatives(x, reference::HessianProjection::none).gradient;
  };
  const auto rest = forces({}), pushed = forces(asked.contacts(set));
  double along = 0, all = 0;
  for (const std::size_t v : {7, 8, 9, 10, 13, 14, 15, 16, 19, 20, 21, 22, 25, 26, 27, 28}) {
    const auto f = pushed[v] - rest[v];
    along += std::hypot(f[0], f[2]);
    all += std::hypot(f[0], f[1], f[2]);
  }
  REQUIRE(all > 0);
  return along / all;
}

}  // namespace

TEST_CASE(
    "reference_contact_set: a level sheet above a level one is pushed straight up by the method's contacts and by a "
    "distance "
    "field, and sideways by one contact of each pair of primitives",
    "[property]") {
  const Asked asked(level_sheets());
  // Directions of forces are differences of closest points, divided by the distance 2 mm. Coordinates below 0.1 m are
  // rounded in double.
  const double rounding = 64 * 0x1p-53 * 0.1 / 2e-3;
  CHECK(tangential_share(asked, reference::ContactSet::ogc) < rounding);
  CHECK(tangential_share(asked, reference::ContactSet::distance) < rounding);
  CHECK(tangential_share(asked, reference::ContactSet::pairs) > 0.01);
}

TEST_CASE(
    "reference_contact_set=pairs has every contact of the method but those that the rule for nearly parallel edges "
    "adds, and "
    "lists a face as often as pairs have it closest",
    "[property]") {
  const Asked asked = askew_sheets();
  const auto ours = asked.contacts(reference::ContactSet::ogc), all = asked.contacts(reference::ContactSet::pairs);
  std::multiset<std::pair<compare::Index, compare::Face>> facets;
  std::multiset<std::pair<compare::Face, compare::Face>> edges;
  for (const auto& c : all.vertex_facet) facets.insert({c.vertex, c.face});
  for (const auto& c : all.edge_edge) {
    CHECK(c.first < c.second);
    edges.insert({c.first, c.second});
  }
  CHECK(ours.vertex_facet.size() > 20);
  CHECK(ours.edge_edge.size() > 20);
  for (const auto& c : ours.vertex_facet) CHECK(facets.count(std::pair(c.vertex, c.face)) > 0);
  for (const auto& c : ours.edge_edge) CHECK(edges.count(std::pair(c.first, c.second)) > 0);
  CHECK(all.vertex_facet.size() > ours.vertex_facet.size());
  CHECK(std::ranges::any_of(facets, [&](const auto& c) { return facets.count(c) > 1; }));
}

TEST_CASE(
    "reference_contact_set=distance has for each vertex one contact with each other body, no farther than any pair",
    "[property]") {
  const Asked asked = askew_sheets();
  const auto found = asked.contacts(reference::ContactSet::distance),
             pairs = asked.contacts(reference::ContactSet::pairs);
  CHECK(found.edge_edge.empty());
  const reference::State x = reference::widened(asked.positions);
  const auto distance = [&](const compare::VertexFacetContact& c) {
    const auto stencil = reference::stencil_of(asked.topology, c);
    const auto corners = reference::contact_corners(stencil.sides, stencil.vertex, x);
    const auto apart = reference::separation(reference::closest_form(stencil.sides, corners).weight, corners);
    return std::hypot(apart[0], apart[1], apart[2]);
  };
  std::set<compare::Index> seen;
  for (const auto& c : found.vertex_facet) {
    CHECK(seen.insert(c.vertex).second);
    for (const auto& other : pairs.vertex_facet)
      if (other.vertex == c.vertex) CHECK(distance(c) <= distance(other) * (1 + 0x1p-22));
  }
  for (const auto& c : pairs.vertex_facet) CHECK(seen.count(c.vertex) == 1);
}

TEST_CASE(
    "reference_vbd_colours: greedy and random ones separate stencils, a vertex alone has its own, all together one",
    "[property]") {
  compare::Scene scene = two_sheets();
  scene.bodies[1].fixed = false;
  round_to_single(scene);
  const compare::Topology topology = build_topology(scene);
  const compare::RestStateOut rest = reference::rest_state({&scene, &topology}).exact;
  const std::vector<compare::Index> groups = rigid_groups(scene);
  const auto colours = [&](reference::Colouring rule) { return colours_of(scene, rest, groups, rule); };
  using reference::Colouring;
  for (const auto rule : {Colouring::greedy, Colouring::random, Colouring::vertex, Colouring::turned}) {
    const auto colour = colours(rule);
    const auto at = [&](compare::Index v) { return colour[static_cast<std::size_t>(v)]; };
    for (const compare::Triangle& t : topology.triangles) CHECK(std::set{at(t[0]), at(t[1]), at(t[2])}.size() == 3);
  }
  const auto alone = colours(Colouring::vertex), together = colours(Colouring::together);
  CHECK(std::set(alone.begin(), alone.end()).size() == alone.size());
  CHECK(std::ranges::all_of(together, [](compare::Index c) { return c == 0; }));
  const auto once = colours(Colouring::random);
  CHECK(once == colours(Colouring::random));
  scene.settings.seed = 1;
  CHECK(once != colours(Colouring::random));
}

TEST_CASE("reference_vbd_cut_after=iteration and other contact sets keep vertices in their bounds, and change the step",
          "[property]") {
  compare::Scene scene = drop_scene();
  scene.settings.time_step = 1.0 / 200;
  const auto end_of = [&](const std::string& name, const std::string& value) {
    compare::Scene changed = scene;
    if (!name.empty()) set_setting(changed.settings, name, value);
    const auto simulation = reference::start_vbd(changed, {});
    for (int step = 0; step < 12; ++step) {
      REQUIRE(simulation->advance(1).at(0).status == compare::step_clean);
      const compare::Snapshot now = simulation->snapshot();
      for (std::size_t v = 0; v < now.positions.size(); ++v) {
        const auto &p = now.positions[v], &q = now.previous[v];
        CHECK(std::hypot(double{p.x} - q.x, double{p.y} - q.y, double{p.z} - q.z) <= double{now.bounds[v]});
      }
    }
    return simulation->snapshot().positions;
  };
  const auto plain = end_of("", "");
  CHECK(end_of("reference_vbd_cut_after", "iteration") != plain);
  CHECK(end_of("reference_contact_set", "pairs") != plain);
  CHECK(end_of("reference_contact_set", "distance") != plain);
  CHECK(end_of("reference_vbd_contact_blocks", "majorised") == plain);
}

TEST_CASE("a setting that a solver does not read is refused by name, with its value and who reads it", "[unit]") {
  const auto refused = [](const char* name, const char* value, const char* solver) {
    compare::Settings settings;
    if (std::string_view(solver) == "penalty") {
      set_setting(settings, "bounds", "off");
      set_setting(settings, "contact_activation", "quadratic");
    }
    set_setting(settings, name, value);
    try {
      compare::refuse_unread(settings, solver);
    } catch (const compare::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(refused("reference_contact_set", "pairs", "vbd"),
             ContainsSubstring("'reference_contact_set' can't be 'pairs'"));
  CHECK(refused("reference_contact_set", "pairs", "newton").empty());
  CHECK_THAT(refused("reference_vbd_colours", "random", "newton"), ContainsSubstring("take --solver reference_vbd"));
  CHECK(refused("reference_vbd_colours", "random", "reference_vbd").empty());
  CHECK_THAT(refused("bounds", "dat", "newton"), ContainsSubstring("line search scales all vertices at once"));
  CHECK(refused("bounds", "planes", "newton").empty());
  CHECK(refused("bounds", "dat", "vbd").empty());
  CHECK_THAT(refused("bounds", "ball", "penalty"), ContainsSubstring("has bounds=off"));
  CHECK(refused("bounds", "off", "penalty").empty());
  CHECK_THAT(refused("newton_truncation", "pair", "penalty"), ContainsSubstring("take --solver newton"));
  compare::Scene scene = two_sheets();
  set_setting(scene.settings, "reference_vbd_colours", "random");
  CHECK_THROWS_AS(reference::start_newton(scene, {}), compare::InputError);
}

TEST_CASE("no solver refuses the defaults, and what one requires can be set", "[unit]") {
  for (const compare::RequiredSetting& own : compare::required_settings()) {
    compare::Settings settings;
    set_setting(settings, own.setting, own.value);
  }
  for (const char* solver : {"vbd", "newton", "reference_vbd", "ipc"}) compare::refuse_unread({}, solver);
}
