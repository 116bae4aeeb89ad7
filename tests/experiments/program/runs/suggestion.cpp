// Tests suggested settings by inequalities between the suggested numbers and sizes of the mesh. Compared meshes differ
// in one property.
#include "experiments/program/runs/suggestion.hpp"

#include <algorithm>
#include <cmath>

#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"
#include "experiments/scenes/materials.hpp"
#include "experiments/scenes/shapes.hpp"
#include "fast/contestant.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::experiments;

namespace {

constexpr double gravity = 9.81;

double speed_after(double fall) { return std::sqrt(2 * gravity * fall); }

/// Returns a sheet with edges of 1/19 m and √2/19 m.
compare::Mesh sheet() { return grid(20, 1, 0.5); }

/// Returns two sheets, `gap` [m] apart.
compare::Mesh layers(double gap) {
  compare::Scene scene;
  append_body(scene, {.name = "lower", .material = {}}, grid(20, 1, 0.5));
  append_body(scene, {.name = "upper", .material = {}}, grid(20, 1, 0.5 + gap));
  return scene.mesh;
}

}  // namespace

TEST_CASE("a suggested radius is below a quarter of the median edge and not above gaps of a twentieth and more",
          "[unit]") {
  const double edge = 1.0 / 19;
  const auto radius = [](const compare::Mesh& mesh) { return suggest(mesh, layer_cloth(), 1).contact_radius; };
  CHECK(radius(sheet()).value == Approx(edge / 4).epsilon(0.1));
  CHECK(radius(sheet()).value <= edge / 4);
  CHECK(radius(layers(0.1 * edge)).value <= 0.1 * edge);
  CHECK(radius(layers(0.1 * edge)).value >= 0.09 * edge);
  CHECK_THAT(radius(layers(0.1 * edge)).reason, ContainsSubstring("gap"));
  CHECK(radius(layers(0.001 * edge)).value == Approx(edge / 20).epsilon(0.1));
  CHECK_THAT(radius(layers(0.001 * edge)).reason, ContainsSubstring("pushed apart"));
}

TEST_CASE("the suggested stiffness holds ten layers and stops a falling vertex within half of r", "[property]") {
  const compare::Material cloth = layer_cloth();
  for (const double fall : {0.0, 0.01, 1.0, 50.0}) {
    const Suggestion found = suggest(sheet(), cloth, fall);
    const double mass = cloth.density / 400, half = found.contact_radius.value / 2,
                 stiffness = found.contact_stiffness.value;
    INFO(fall << " m");
    CHECK(stiffness * half >= 10 * mass * gravity);
    CHECK(stiffness * half * half >= mass * std::pow(speed_after(fall), 2) * (1 - 1e-9));
    CHECK(found.contact_stiffness.reason.size() > 20);
  }
}

TEST_CASE("four detections are enough for a suggested step at the speed of the fall", "[property]") {
  for (const double fall : {0.0, 0.01, 1.0, 50.0}) {
    const Suggestion found = suggest(sheet(), layer_cloth(), fall);
    INFO(fall << " m");
    CHECK(found.time_step.value <= 0.01);
    CHECK(found.time_step.value * speed_after(fall) <=
          4 * compare::Settings{}.bounds_relaxation * found.query_radius.value * (1 + 1e-9));
    CHECK(found.iterations.value >= 10);
    CHECK(found.iterations.value <= 100);
  }
}

TEST_CASE("suggested numbers scale with the mesh, and are legal for the smallest and the largest one", "[property]") {
  for (const double scale : {0x1p-14, 1.0, 0x1p18}) {
    compare::Mesh mesh = sheet();
    for (compare::Vec3& p : mesh.positions) p = {scale * p.x, scale * p.y, scale * p.z};
    const Suggestion found = suggest(mesh, layer_cloth(), scale);
    compare::Scene scene;
    scene.name = "scaled";
    append_body(scene, {.name = "cloth", .material = layer_cloth()}, mesh);
    apply(found, scene);
    round_to_single(scene);
    INFO(scale);
    CHECK(compare::describe(compare::validate(scene)) == "");
    CHECK(found.contact_radius.value == Approx(std::max(0x1p-20, scale / 76)).epsilon(0.1));
    CHECK(scene.bodies[0].material.contact_stiffness == Approx(found.contact_stiffness.value));
  }
}

namespace {

/// Returns a strip of 17 × 5 vertices along x and z.
compare::Mesh strip(double edge) {
  compare::Mesh mesh;
  for (compare::Index i = 0; i < 17; ++i)
    for (compare::Index j = 0; j < 5; ++j) mesh.positions.push_back({edge * i, 0, edge * j});
  for (compare::Index i = 0; i < 16; ++i)
    for (compare::Index j = 0; j < 4; ++j) {
      const compare::Index a = 5 * i + j, b = a + 1, c = a + 5, d = a + 6;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  return mesh;
}

/// Hangs the mesh by its vertices of least x and returns how far it sinks along x on average until it rests [m]. The
/// settings are the suggested ones except the number of iterations.
double sunk(const compare::Mesh& mesh, const compare::Material& material, const Suggestion& found,
            std::int64_t iterations) {
  compare::Scene scene;
  scene.name = "hung";
  append_body(scene, {.name = "hung", .material = material}, mesh);
  apply(found, scene);
  scene.settings.iterations = iterations;
  scene.gravity = {gravity, 0, 0};
  compare::PrescribedMotion pin;
  const auto by_x = [](const compare::Vec3& p) { return p.x; };
  const double least = std::ranges::min(mesh.positions, {}, by_x).x;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (mesh.positions[v].x < least + 1e-9) pin.vertices.push_back(static_cast<compare::Index>(v));
  scene.motions = {pin};
  round_to_single(scene);
  const auto simulation = fast::contestant(fast::Backend::cpu).start(scene, {});
  simulation->advance(250);
  double sum = 0;
  const compare::Snapshot end = simulation->snapshot();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) sum += double{end.positions[v].x} - mesh.positions[v].x;
  return sum / static_cast<double>(mesh.positions.size());
}

/// Returns the relative excess of the sinking with the suggested sweeps over the sinking with ten times as many. The
/// error of the latter is negligible: it is the tenth power of the measured error.
double measured_excess(const compare::Mesh& mesh, const compare::Material& material, const Suggestion& found) {
  const auto iterations = static_cast<std::int64_t>(found.iterations.value);
  return sunk(mesh, material, found, iterations) / sunk(mesh, material, found, 10 * iterations) - 1;
}

}  // namespace

// Strips of 4 × 16 cells hang by a short side. For an error of 1 %, edges of 6 cm need fewer sweeps than the limit of
// 100, edges of 2 cm need more. By method.md §7.7, ln(1 + 1/e) of the error e is nearly proportional to the number of
// sweeps. So the test compares these logarithms of the measured and the predicted error.
TEST_CASE("suggested iterations leave what hangs at most 1 % longer, or as much longer as is said", "[property]") {
  const auto hung = [](double edge) {
    const compare::Mesh mesh = strip(edge);
    const Suggestion found = suggest(mesh, layer_cloth(), 0);
    INFO(edge << " m: " << found.iterations.reason);
    const double measured = measured_excess(mesh, layer_cloth(), found);
    const double exponent = std::log1p(1 / measured) / std::log1p(1 / found.excess_extension);
    CHECK(exponent > 0.9);
    CHECK(exponent < 1.2);
    if (found.iterations.value < 100) CHECK(measured <= 0.01);
    return found;
  };
  const Suggestion coarse = hung(0.06), fine = hung(0.02);
  CHECK(coarse.excess_extension <= 0.01);
  CHECK(coarse.iterations.value < 100);
  CHECK(fine.iterations.value == 100);
  CHECK(fine.excess_extension > 0.02);
  CHECK_THAT(fine.iterations.reason, ContainsSubstring("at most 100") && ContainsSubstring("1 % takes iterations=") &&
                                         ContainsSubstring("time_step="));
}

TEST_CASE("where a tenth of the edges is far shorter than most, they decide", "[unit]") {
  const Suggestion found = suggest(cylinder({.around = 100, .along = 2, .cap = 0}, 0.5, 1, {}), layer_cloth(), 1);
  CHECK(found.edge_length == Approx(2 * std::sin(std::acos(-1.0) / 100)).epsilon(0.01));
  CHECK_THAT(found.contact_radius.reason, ContainsSubstring("a tenth of the edges"));
}

TEST_CASE("a mesh without a triangle gets no suggestion", "[unit]") {
  CHECK_THROWS_AS(suggest({{{0, 0, 0}, {1, 0, 0}}, {}, {{0, 1}}}, layer_cloth(), 1), compare::InputError);
}
