// Tests the ledger on steps written by hand, whose energy and momentum have closed forms: a triangle without elasticity
// moves rigidly above a wall.
#include "reference/solvers/ledger.hpp"

#include <cmath>
#include <vector>

#include "tests/catch.hpp"

using namespace ogc;
using compare::StepEventKind;
using compare::StepLedger;
using compare::Vec3f;

namespace {

constexpr double radius = 0x1p-10,
                 distance = 0.75 * radius;  // r, and the triangle's distance from the wall, in the quadratic stage
constexpr float far = 0x1p-7f;              // a query radius that reaches the wall

/// Returns three free vertices `distance` above a fixed triangle. All numbers are exact in single precision.
compare::Scene above_a_wall() {
  compare::Scene scene;
  scene.name = "above_a_wall";
  compare::Material material;
  material.membrane = compare::MembraneModel::none;
  material.bending = compare::BendingModel::none;
  append_body(scene, {.name = "sheet", .material = material},
              {{{0, distance, 0}, {0, distance, 0x1p-5}, {0x1p-5, distance, 0}}, {{0, 1, 2}}, {}});
  append_body(scene, {.name = "wall", .fixed = true, .material = material},
              {{{-1, 0, -1}, {-1, 0, 2}, {2, 0, -1}}, {{0, 1, 2}}, {}});
  scene.gravity = {};
  scene.settings.contact_radius = radius;
  scene.settings.time_step = 0x1p-7;
  return scene;
}

double mass(const compare::Scene& scene) { return scene.bodies[0].material.density * 0x1p-11; }  // of the triangle [kg]

/// Builds the answer of a step (StepOut), event by event.
class Told {
 public:
  Told(const compare::Scene& scene, const Vec3f& velocity)
      : scene_(scene), start_(compare::to_single(scene.mesh.positions)), velocity_(6, Vec3f{0, 0, 0}) {
    const auto h = static_cast<float>(scene.settings.time_step);
    step_.target = start_;
    for (std::size_t v = 0; v < 3; ++v) {
      velocity_[v] = velocity;
      step_.target[v].x += h * velocity.x;
      step_.target[v].y += h * (velocity.y + h * static_cast<float>(scene.gravity.y));
      step_.target[v].z += h * velocity.z;
    }
    step_.colour = {0, 1, 2, -1, -1, -1};
    step_.query_radius = far;
    now_ = start_;
    detection();
  }

  Told& detection(std::vector<compare::VertexFacetContact> contacts = {}) {
    happens(StepEventKind::detection, 0).vertex_facet.contacts = std::move(contacts);
    return *this;
  }
  /// Adds a round of the guess loop or a sweep, which moves the first `count` vertices to their targets. The others
  /// stay and count as cut.
  Told& moves(StepEventKind kind, std::size_t count) {
    for (std::size_t v = 0; v < count; ++v) now_[v] = step_.target[v];
    happens(kind, 3 - count);
    return *this;
  }
  Told& reaches(float query_radius) { return step_.query_radius = query_radius, *this; }

  StepLedger ledger(const reference::ContactSets& at_end = {}) {
    const auto h = static_cast<float>(scene_.settings.time_step);
    step_.position = now_;
    step_.velocity.clear();
    for (std::size_t v = 0; v < now_.size(); ++v)
      step_.velocity.push_back(
          {(now_[v].x - start_[v].x) / h, (now_[v].y - start_[v].y) / h, (now_[v].z - start_[v].z) / h});
    return reference::LedgerWriter(scene_).of(start_, velocity_, step_, at_end);
  }

 private:
  compare::StepEvent& happens(StepEventKind kind, std::size_t cut) {
    compare::StepEvent& event = step_.events.emplace_back();
    event.kind = kind;
    event.position = now_;
    event.cut = static_cast<compare::Index>(cut);
    return event;
  }

  const compare::Scene& scene_;
  std::vector<Vec3f> start_, velocity_, now_;
  compare::StepOut step_;
};

void check_vector(const compare::Vec3& found, double x, double y, double z) {
  CHECK(found.x == Approx(x).margin(1e-18));
  CHECK(found.y == Approx(y).margin(1e-18));
  CHECK(found.z == Approx(z).margin(1e-18));
}

}  // namespace

// Velocities are powers of two, so targets and velocities are exact, and only rounding in double remains.
TEST_CASE("where truncation takes a whole step, the ledger has what and which way it was", "[property]") {
  const auto [vx, vy] = GENERATE(
      table<float, float>({{0.25f, 0.0f}, {0.0f, 0.0625f}, {0.0f, -0.0625f}, {0.25f, 0.0625f}, {-0.25f, -0.0625f}}));
  const compare::Scene scene = above_a_wall();
  const double m = mass(scene), speed = std::hypot(vx, vy), whole = 0.5 * m * speed * speed;
  const StepLedger l = Told(scene, {vx, vy, 0}).moves(StepEventKind::guess, 0).moves(StepEventKind::sweep, 0).ledger();
  CHECK(l.energy_start == Approx(whole));
  CHECK(l.energy_guess == Approx(-whole));
  CHECK(l.energy_detection == 0);
  CHECK(l.energy_sweep == Approx(whole));
  CHECK(l.energy_truncation == Approx(-whole));
  CHECK(l.energy_commit == 0);
  check_vector(l.momentum_start, m * vx, m * vy, 0);
  check_vector(l.momentum_guess, -m * vx, -m * vy, 0);
  check_vector(l.momentum_sweep, m * vx, m * vy, 0);
  check_vector(l.momentum_truncation, -m * vx, -m * vy, 0);
  CHECK(l.motion_proposed == Approx(m * speed));
  CHECK(l.motion_taken == Approx(m * speed));
  CHECK(l.motion_taken_tangential == Approx(m * std::abs(vx)).margin(1e-18));
  CHECK(l.motion_taken_leaving == Approx(vy > 0 ? m * vy : 0).margin(1e-18));
  CHECK(l.motion_taken_unpaired == 0);
  CHECK(l.vertices_still == 3);
  CHECK(l.vertices_held == 3);
}

TEST_CASE("without a pair within the query radius there is no direction", "[unit]") {
  const compare::Scene scene = above_a_wall();
  const StepLedger l = Told(scene, {0.25f, 0, 0})
                           .reaches(static_cast<float>(distance) / 2)
                           .moves(StepEventKind::guess, 0)
                           .moves(StepEventKind::sweep, 0)
                           .ledger();
  CHECK(l.motion_taken == Approx(0.25 * mass(scene)));
  CHECK(l.motion_taken_unpaired == l.motion_taken);
  CHECK(l.motion_taken_tangential + l.motion_taken_leaving == 0);
}

TEST_CASE("the vertices that were cut are those that are not where they were to go", "[unit]") {
  const compare::Scene scene = above_a_wall();
  const double m = mass(scene), whole = 0.5 * m * 0.25 * 0.25;
  const StepLedger l =
      Told(scene, {0.25f, 0, 0}).moves(StepEventKind::guess, 0).moves(StepEventKind::sweep, 2).ledger();
  CHECK(l.motion_proposed == Approx(0.25 * m));
  CHECK(l.motion_taken == Approx(0.25 * m / 3));
  CHECK(l.energy_sweep == Approx(whole));
  CHECK(l.energy_truncation == Approx(-whole / 3));
  CHECK(l.vertices_still == 1);
  CHECK(l.vertices_held == 1);
}

TEST_CASE("a step that nothing holds takes nothing: gravity's impulse is the guess's", "[property]") {
  compare::Scene scene = above_a_wall();
  scene.gravity = {0, 8, 0};  // h a is exact
  const double m = mass(scene), h = scene.settings.time_step;
  const StepLedger l =
      Told(scene, {0.25f, 0, 0}).moves(StepEventKind::guess, 3).moves(StepEventKind::sweep, 3).ledger();
  check_vector(l.momentum_guess, 0, m * h * 8, 0);
  check_vector(l.momentum_sweep, 0, 0, 0);
  CHECK(l.energy_start == Approx(0.5 * m * 0.25 * 0.25 - m * 8 * distance));
  CHECK(l.energy_guess == Approx(0.5 * m * h * h * 64 - m * 8 * h * h * 8));
  CHECK(std::abs(l.energy_sweep) <= 0x1p-50 * std::abs(l.energy_start));
  CHECK(std::abs(l.energy_commit) <= 0x1p-50 * std::abs(l.energy_start));
  CHECK(l.energy_truncation == 0);
  CHECK(l.motion_taken == 0);
  CHECK(l.vertices_still + l.vertices_held == 0);
}

TEST_CASE("contacts that are found or lost enter where they are found or lost", "[property]") {
  const compare::Scene scene = above_a_wall();
  const compare::VertexFacetContact contact{1, {compare::FaceKind::triangle, 1}, 1};
  const double energy = 0.5 * scene.bodies[0].material.contact_stiffness * (radius - distance) * (radius - distance);
  const StepLedger l = Told(scene, {0, 0, 0}).moves(StepEventKind::guess, 3).detection({contact}).ledger();
  CHECK(l.energy_start == 0);
  CHECK(l.energy_detection == Approx(energy));
  CHECK(l.energy_commit == Approx(-energy));
  const StepLedger kept =
      Told(scene, {0, 0, 0}).moves(StepEventKind::guess, 3).detection({contact}).ledger({{contact}, {}});
  CHECK(kept.energy_detection == Approx(energy));
  CHECK(std::abs(kept.energy_commit) <= 0x1p-50 * energy);
}

TEST_CASE("a trace that does not begin with a detection is refused", "[unit]") {
  const compare::Scene scene = above_a_wall();
  reference::LedgerWriter writer(scene);
  const std::vector<Vec3f> zero(6, Vec3f{0, 0, 0});
  CHECK_THROWS_AS(writer.of(zero, zero, {}, {}), std::invalid_argument);
}
