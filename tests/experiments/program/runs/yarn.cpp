// Tests yarn with bounds and with a penalty method: curves that are hooked into each other, knotted, or shorter than
// their contact radius.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/oracle/meetings.hpp"
#include "compare/record/steps_csv.hpp"
#include "fast/contestant.hpp"
#include "reference/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/compare/oracle/rings.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;
using std::numbers::pi;

namespace {

/// Returns curves in free space. Each is a rod with the yarn material of yarn_stretch and the contact stiffness
/// `stiffness` [N/m].
compare::Scene yarn_of(const std::vector<Vec3>& positions, const std::vector<Edge>& loose, double stiffness) {
  compare::Scene scene;
  scene.name = "yarn";
  compare::Mesh mesh;
  mesh.positions = positions;
  mesh.loose_edges = loose;
  compare::Material yarn;
  yarn.rod = compare::RodMaterial{.density = 1e-3, .stretch = 0.1, .bend = 2e-7, .damping = 0, .diameter = 1e-3};
  yarn.contact_stiffness = stiffness;
  yarn.friction = 0.1;
  append_body(scene, {.name = "yarn", .material = yarn}, mesh);
  scene.gravity = {0, 0, 0};
  scene.settings.time_step = 4e-4;
  scene.settings.iterations = 4;
  scene.settings.friction_velocity = 1e-3;
  return scene;
}

constexpr Index ring_size = 24;

/// Returns two rings that are hooked into each other. A tension far above k_c r pulls them apart.
compare::Scene hooked_rings(compare::Bounds bounds) {
  std::vector<Vec3> positions;
  std::vector<Edge> loose;
  add_ring(positions, loose, ring_size, {0, 0, 0}, {0.01, 0, 1e-3}, {0, 0.01, 5e-4});
  add_ring(positions, loose, ring_size, {0.01, 3e-4, 0}, {0.01, 7e-4, 2e-3}, {5e-4, 1e-3, 0.01});
  compare::Scene scene = yarn_of(positions, loose, 2);
  for (const bool is_second : {false, true}) {
    compare::PrescribedMotion motion;
    motion.name = is_second ? "right" : "left";
    for (Index v = is_second ? ring_size : 0; v < (is_second ? 2 : 1) * ring_size; ++v) {
      const double x = positions[static_cast<std::size_t>(v)].x;
      if (is_second ? x > 0.0185 : x < -0.0085) motion.vertices.push_back(v);
    }
    motion.velocity = {is_second ? 0.25 : -0.25, 0, 0};
    scene.motions.push_back(motion);
  }
  scene.settings.contact_radius = 1e-3;
  scene.settings.bounds = bounds;
  if (bounds == compare::Bounds::off) scene.settings.contact_activation = compare::ContactActivation::quadratic;
  scene.settings.steps = 200;
  round_to_single(scene);
  return scene;
}

/// Returns how often the second ring passes through the first one during this motion; passes in opposite directions
/// count +1 and −1. `count` gets the number of meetings.
int signed_count(const compare::Topology& topology, const std::vector<Vec3>& from, const std::vector<Vec3>& to,
                 std::size_t& count) {
  const auto place = [&](double t) {
    std::vector<Vec3> x = from;
    for (std::size_t v = 0; v < x.size(); ++v)
      x[v] = {from[v].x + t * (to[v].x - from[v].x), from[v].y + t * (to[v].y - from[v].y),
              from[v].z + t * (to[v].z - from[v].z)};
    return x;
  };
  int sum = 0;
  for (const compare::Meeting& m : compare::meetings(topology, from, to).meetings) {
    ++count;
    const auto along = [&](Index e) {  // along the ring, because edges are sorted by vertex number
      const Edge& edge = topology.edges[static_cast<std::size_t>(e)];
      return edge[1] - edge[0] == 1 ? edge : Edge{edge[1], edge[0]};
    };
    const std::vector<Vec3> before = place(m.time - 1e-7), after = place(m.time + 1e-7);
    sum += (sense(after, along(m.first), along(m.second)) - sense(before, along(m.first), along(m.second))) / 2;
  }
  return sum;
}

nlohmann::json audited(const TemporaryFolder& folder, const std::string& name, const compare::Scene& scene) {
  const std::string file = write_scene(folder / (name + "_scene"), scene).string();
  const ProgramResult result = run_ogc("run " + file + " --audit every --json --out " + (folder / name).string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  return nlohmann::json::parse(result.out);
}

}  // namespace

TEST_CASE("yarn: hooked rings that are pulled apart stay hooked with bounds", "[property]") {
  const TemporaryFolder folder;
  const auto run = audited(folder, "run", hooked_rings(compare::Bounds::ball));
  CHECK(run.at("audit").at("meetings") == 0);
  CHECK(run.at("guarantee_kept") == true);
  // The tension must be far above k_c r, the largest force of a quadratic contact.
  CHECK(0.1 * compare::read_steps(folder / "run").rows.back().mean_stretch > 10 * 2 * 1e-3);
}

TEST_CASE(
    "yarn: without bounds hooked rings pass through each other, and their linking number changes by the signed count "
    "of "
    "meetings",
    "[property]") {
  const compare::Scene scene = hooked_rings(compare::Bounds::off);
  const compare::Topology topology = build_topology(scene);
  const auto simulation = fast::contestant(fast::Backend::cpu).start(scene, {});
  std::vector<Vec3> x = scene.mesh.positions;
  const int linked = linking_number(x, ring_size);
  CHECK(std::abs(linked) == 1);
  std::size_t count = 0;
  int sum = 0;
  for (std::int64_t step = 0; step < scene.settings.steps; ++step) {
    simulation->advance(1);
    const std::vector<Vec3> next = compare::to_double(simulation->snapshot().positions);
    sum += signed_count(topology, x, next, count);
    x = next;
  }
  CHECK(count > 0);
  CHECK(linking_number(x, ring_size) == 0);
  CHECK(std::abs(sum) == 1);
}

TEST_CASE("yarn: a figure-eight knot that is pulled tight has no meeting", "[property]") {
  constexpr Index n = 160;
  constexpr double size = 4e-3;
  std::vector<Vec3> positions;
  std::vector<Edge> loose;
  for (Index k = 0; k < n; ++k) {
    const double t = 2 * pi * (k + 0.25) / n, across = (2 + std::cos(2 * t)) * size;
    positions.push_back({across * std::cos(3 * t), across * std::sin(3 * t), 1.5 * size * std::sin(4 * t)});
    loose.push_back({std::min(k, (k + 1) % n), std::max(k, (k + 1) % n)});
  }
  compare::Scene scene = yarn_of(positions, loose, 2);
  for (Vec3& x : scene.rest_positions) x = {0.25 * x.x, 0.25 * x.y, 0.25 * x.z};
  scene.settings.contact_radius = 2e-3;
  scene.settings.steps = 200;
  round_to_single(scene);
  const TemporaryFolder folder;
  const auto run = audited(folder, "run", scene);
  CHECK(run.at("audit").at("meetings") == 0);
  CHECK(run.at("guarantee_kept") == true);
  // The knot must be tight: its mean stretch has fallen from 3 at the start to below 2, and it touches itself at its
  // four crossings. It oscillates, because these contacts are elastic. In the last 100 steps the smallest distance of a
  // contact falls below r/2.
  const std::vector<compare::StepMetrics> rows = compare::read_steps(folder / "run").rows;
  const compare::StepMetrics& last = rows.back();
  CHECK(last.mean_stretch < 2);
  double nearest = last.smallest_contact_distance;
  for (const compare::StepMetrics& row : std::span(rows).last(100))
    nearest = std::min(nearest, row.smallest_contact_distance);
  CHECK(nearest < 1e-3);
  CHECK(last.smallest_contact_distance < scene.settings.contact_radius * 2 / 3);
  CHECK(last.edge_edge_contacts >= 4);
}

TEST_CASE("yarn: of a smooth curve with segments of a tenth of r neighbours are no contact", "[property]") {
  constexpr double r = 3e-3, segment = r / 10;
  // Radii of curvature are at least 1.2 r, and no curve comes nearer to another part of itself than r.
  const auto helix = [](double t) { return Vec3{1.2 * r * std::cos(t), 1.2 * r * std::sin(t), 0.4 * r * t}; };
  const auto ring = [](double t) { return Vec3{1.2 * r * std::cos(t), 1.2 * r * std::sin(t), 0}; };
  const auto line = [](double t) { return Vec3{r * t, 0.3 * r * t, 0.2 * r * t}; };
  const auto count_of = [&](const auto& curve, double length, bool is_closed) {
    const auto n = static_cast<Index>(length / segment);
    std::vector<Vec3> positions;
    std::vector<Edge> loose;
    for (Index k = 0; k < n; ++k) {
      positions.push_back(curve(length / (1.2 * r) * k / n));
      if (k > 0) loose.push_back({k - 1, k});
    }
    if (is_closed) loose.push_back({0, n - 1});
    const compare::Topology topology = compare::build_topology(n, {}, loose);
    const std::vector<compare::Vec3f> x = compare::to_single(positions);
    const compare::DetectIn in{&topology, {}, x, static_cast<float>(r), static_cast<float>(2 * r)};
    const auto fast = fast::contestant(fast::Backend::cpu).detect_edge_edge(in).contacts;
    CHECK(fast == reference::authority().detect_edge_edge(in).exact.contacts);
    return fast.size();
  };
  CHECK(count_of(line, 10 * r, false) == 0);
  CHECK(count_of(ring, 2 * pi * 1.2 * r, true) == 0);
  CHECK(count_of(helix, 30 * r, false) == 0);
  // In this helix adjacent windings are closer than r, so they are in contact.
  const auto narrow = [](double t) { return Vec3{1.2 * r * std::cos(t), 1.2 * r * std::sin(t), 0.1 * r * t}; };
  CHECK(count_of(narrow, 30 * r, false) > 0);
}

// From the fifth step on, touching strands that are nearly parallel alternate between pairs of closest points. Newton's
// method ends a step before its 50 iterations if further detections do not improve the residual.
TEST_CASE("yarn: Newton's steps of a knit that is stretched end, and the run says that states were audited",
          "[property]") {
  const TemporaryFolder folder;
  const std::string eight = "run yarn_stretch --scale smoke --solver newton --steps 8 --audit every --out ";
  const ProgramResult result = run_ogc(eight + (folder / "run").string());
  INFO(result.err);
  CHECK(result.status == 0);
  CHECK(contains(result.out, {"yes (8 states audited exactly)"}));
  for (const compare::StepMetrics& row : compare::read_steps(folder / "run").rows) CHECK(row.iterations < 50);
}

TEST_CASE("penalty: the run says first and last that nothing is guaranteed, and refuses bounds", "[unit]") {
  const TemporaryFolder folder;
  const std::string out = " --out " + (folder / "run").string();
  const ProgramResult result = run_ogc("run yarn_twist --scale smoke --steps 3 --solver penalty" + out);
  INFO(result.out << result.err);
  REQUIRE(result.status == 0);
  CHECK(contains(result.err, {"this run guarantees nothing"}));
  CHECK(contains(result.out, {"no guarantee (bounds=off)"}));
  const auto settings = nlohmann::json::parse(compare::read_bytes(folder / "run/run.json")).at("settings");
  CHECK(settings.at("bounds").at("value") == "off");
  CHECK(settings.at("contact_activation").at("value") == "quadratic");
  const ProgramResult refused = run_ogc("run yarn_twist --scale smoke --solver penalty --set bounds=ball" + out);
  CHECK(refused.status == 2);
  CHECK(contains(refused.err, {"--set bounds=ball: --solver penalty has bounds=off; leave it out"}));
}
