// Seeds of the nearest facets, one thread a search: what a device's warps share out is this very query.
#include "fast/kernels/volumes/seek.hpp"

#include <random>

#include "fast/cpu/backend.hpp"
#include "fast/kernels/volumes/contacts.hpp"
#include "fast/stages/surface.hpp"
#include "fast/stages/volumes.hpp"
#include "tests/catch.hpp"
#include "tests/fast/meshes.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::tests;

TEST_CASE("a seed names a facet that none is nearer than, wherever its search begins, and who does not ask has none",
          "[property]") {
  TestMesh mesh = jittered(sheet(8, 0.01F, 0), 2e-3F, 1);
  mesh.add(jittered(sheet(6, 0.012F, 0.03F), 2e-3F, 2));
  const compare::Topology topology = mesh.topology();
  CpuBackend backend;
  const Surface<CpuBackend> surface(topology, {});
  const VolumeParts parts = volume_parts(topology, {}, mesh.positions);
  REQUIRE(parts.size() == 2);
  VolumeTrees<CpuBackend> trees(parts, {});
  std::vector<Vec> positions;
  std::vector<PaddedVec> padded;
  for (const compare::Vec3f& p : mesh.positions) {
    positions.push_back({p.x, p.y, p.z});
    padded.emplace_back(positions.back());
  }
  trees.refit(backend, surface.view(), positions.data());
  // who asks stands behind the mesh's own vertices
  std::mt19937 random(3);
  std::uniform_real_distribution<float> at(-0.01F, 0.09F);
  constexpr int rows = 200;
  std::vector<int> askers;
  for (int row = 0; row < rows; ++row) {
    askers.push_back(row % 10 == 9 ? -1 : static_cast<int>(positions.size()));
    positions.push_back({at(random), at(random) * 0.5F, at(random)});
  }
  // all but some are nearer than this to some part's box
  const float contact_radius = 0.02F;
  const VolumeView volume{surface.view(), {padded.data()}, trees.parts(),
                          trees.count(),  contact_radius,  trees.solids()};
  StepControl control;
  control.active = 1;
  std::vector<int> answers;
  for (std::size_t part = 0; part < parts.size(); ++part)
    for (int row = 0; row < rows; ++row) {
      const std::vector<int>& facets = parts[part].facets;
      answers.push_back(answer_of({facets[random() % facets.size()], VolumeSide::far}));
    }
  std::vector<std::uint64_t> seeds(answers.size(), ~std::uint64_t{0});
  const SeekNearest seek{volume, askers.data(), rows, positions.data(), &control, answers.data(), seeds.data()};
  int sought = 0;
  for (int part = 0; part < trees.count(); ++part) {
    const Searches<SeekNearest> searches{volume.parts[part].facets.tree, rows, seek.in_part(part)};
    for (int row = 0; row < rows; ++row) {
      searches.run_alone(row);
      const auto item = static_cast<std::size_t>(part * rows + row);
      const int found = facet_of_seed(seeds[item]);
      const VolumeQuestion question(volume, positions[static_cast<std::size_t>(std::max(0, askers[row]))]);
      if (askers[static_cast<std::size_t>(row)] < 0 || question.is_beyond(part)) {
        CHECK(found == answers[item] >> 2);
        continue;
      }
      ++sought;
      // seeds round distances to single precision
      const double nearest = question.distance_to(found).value * (1 - 0x1p-23);
      for (const int facet : parts[static_cast<std::size_t>(part)].facets)
        CHECK(question.distance_to(facet).value >= nearest);
    }
  }
  CHECK(sought > rows / 2);
  CHECK(sought < 2 * rows * 9 / 10);
}
