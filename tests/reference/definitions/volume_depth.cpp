// Tests the truth of stage volume_depth: its exact answer is that of part_contacts, and grey decisions accept both
// sides.
#include "reference/definitions/volume_depth.hpp"

#include <algorithm>
#include <tuple>

#include "reference/definitions/closed_surface.hpp"
#include "reference/definitions/part_contacts.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::VolumeDepthTruth;
using compare::VolumePartTruth;

namespace {

struct Body {
  Surface surface;
  compare::Topology topology;
  explicit Body(Surface from) : surface(std::move(from)), topology(surface.topology()) {}
  reference::Complex mesh() const { return {topology, surface.positions}; }
  VolumeDepthTruth ask(const std::vector<Vec3f>& x, float r) const {
    return reference::volume_depth({&topology, surface.positions, r, x});
  }
};

/// Returns a cube with a corner moved inward: a reentrant vertex, valleys, ridges.
Surface dented_cube() {
  Surface surface = cube();
  surface.positions[7] = {0.5f, 0.75f, 0.5f};
  return surface;
}

std::vector<Vec3f> points(std::mt19937& random) {
  std::vector<Vec3f> all;
  std::uniform_int_distribution<int> eighth(-4, 20);
  std::uniform_real_distribution<float> anywhere(-0.5f, 2.5f);
  for (int k = 0; k < 100; ++k) {
    const auto coordinate = [&] { return k % 2 == 0 ? static_cast<float>(eighth(random)) / 8 : anywhere(random); };
    const float x = coordinate(), y = coordinate();
    all.push_back({x, y, coordinate()});
  }
  return all;
}

using Named = std::tuple<bool, Index, reference::Face>;

/// Returns the exact contacts of one point.
std::vector<Named> exact_contacts(const std::vector<VolumePartTruth>& parts) {
  std::vector<Named> all;
  const auto add = [&](const compare::VolumeAnswer& a) {
    all.emplace_back(a.contact.inside != 0, a.contact.triangle, a.contact.face);
  };
  for (const VolumePartTruth& part : parts) {
    if (part.inside) add(part.held.front());
    for (std::size_t k = 0; k < part.touching.size(); ++k)
      if (part.is_exact[k] != 0) add(part.touching[k]);
  }
  std::ranges::sort(all);
  return all;
}

}  // namespace

TEST_CASE("the exact answer of volume_depth is that of part_contacts, and what is certain is part of it",
          "[property]") {
  std::mt19937 random(71);
  for (const Surface& surface : {tetrahedron(), octahedron(), cube(), dented_cube(), mapped(dented_cube(), turned)}) {
    const Body body(surface);
    for (const float r : {0.25f, 1.0f}) {
      const std::vector<Vec3f> asked = points(random);
      const VolumeDepthTruth truth = body.ask(asked, r);
      for (std::size_t i = 0; i < asked.size(); ++i) {
        std::vector<Named> wanted;
        for (const reference::PartContact& c : reference::part_contacts(body.mesh(), asked[i], r))
          wanted.emplace_back(c.inside, c.triangle, c.face);
        REQUIRE(exact_contacts(truth.parts[i]) == wanted);
        for (const VolumePartTruth& part : truth.parts[i]) {
          REQUIRE((part.inside ? part.may_be_inside : part.may_be_outside));
          for (std::size_t k = 0; k < part.touching.size(); ++k)
            REQUIRE((part.is_certain[k] == 0 || part.is_exact[k] != 0 || part.inside));
        }
      }
    }
  }
}

TEST_CASE("where a point lies is what winding numbers say, and only on the surface are both sides accepted",
          "[property]") {
  std::mt19937 random(72);
  const Body body(mapped(dented_cube(), turned));
  const reference::ClosedSurface closed(body.mesh());
  const std::vector<Vec3f> asked = points(random);
  const VolumeDepthTruth truth = body.ask(asked, 0.5f);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const VolumePartTruth& part = truth.parts[i].front();
    REQUIRE(part.inside == closed.locate(asked[i]).inside());
    // The limit is 16 · 2⁻²⁴ times the sum of the moduli of three differences of coordinates, each below 100 m.
    if (part.may_be_inside && part.may_be_outside) REQUIRE(part.held.front().depth - 0.5 <= 16 * 0x1p-24 * 300);
  }
  const std::vector<Vec3f> corner{body.surface.positions[0]};
  const VolumePartTruth at_corner = body.ask(corner, 0.5f).parts[0].front();
  CHECK(at_corner.may_be_inside);
  CHECK(at_corner.may_be_outside);
}

TEST_CASE("on the medial axis of a cube each of the nearest faces is accepted", "[unit]") {
  const Body body(cube());
  const std::vector<Vec3f> centre{{1, 1, 1}};
  const VolumePartTruth part = body.ask(centre, 0.5f).parts[0].front();
  CHECK(part.inside);
  CHECK_FALSE(part.may_be_outside);
  CHECK(part.held.size() >= 6);
  for (const compare::VolumeAnswer& answer : part.held) CHECK(answer.depth == 1.5);
}
