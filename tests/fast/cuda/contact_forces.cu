// Tests forces of contacts on the device: the reference's answers, the same bits again, and results in device memory.
#include <cstring>
#include <vector>

#include <cuda_runtime.h>

#include "tests/catch.hpp"

#include "fast/cuda/buffer.cuh"
#include "fast/cuda/cuda.hpp"
#include "tests/fast/contact_force_cases.hpp"

using namespace ogc;
using tests::ContactWorld;

namespace {

/// Finds the contacts of a world on the device.
struct OnDevice {
  fast::ContactFinder finder;
  fast::CudaBuffer<compare::Vec3f> previous;
  fast::FoundContacts contacts;
  fast::ContactForces forces;

  explicit OnDevice(const ContactWorld& world)
      : finder(world.mesh.connectivity(), fast::Backend::cuda), forces(world.forces(fast::Backend::cuda)) {
    previous.upload(world.previous.data(), world.previous.size());
    contacts = {finder.find_resident(previous.data(), world.query()), previous.data()};
  }
};

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

template <class T>
std::vector<T> downloaded(const fast::CudaBuffer<T>& from) {
  std::vector<T> to(from.size());
  from.download(to.data(), to.size());
  return to;
}

}  // namespace

TEST_CASE("contact_forces: on the device each vertex has the sum of the reference's answers", "[gpu]") {
  for (ContactWorld& world : tests::contact_worlds()) {
    OnDevice at(world);
    CHECK(tests::count_wrong(world, at.forces.evaluate(at.contacts, world.x, world.sliding()), true) == 0);
    CHECK(tests::count_wrong(world, at.forces.evaluate(at.contacts, world.x), false) == 0);
    world.colours.assign(world.x.size(), 0);
    OnDevice together(world);
    const fast::ContactForceSums sums = together.forces.evaluate(together.contacts, world.x, world.sliding());
    CHECK(tests::count_wrong(world, sums, true) == 0);
    // Energies are summed in double in the same order as on the host; each is a float.
    fast::ContactFinder finder(world.mesh.connectivity());
    const fast::FoundContacts found{finder.find_resident(world.previous.data(), world.query()), world.previous.data()};
    const double host = world.forces().evaluate(found, world.x).energy.total();
    CHECK(sums.energy.total() == Approx(host).epsilon(1e-4));
  }
}

TEST_CASE("contact_forces: on the device the same bits again, and in device memory", "[gpu]") {
  // The second mesh is large enough for teams whose lanes compute one part after the other.
  tests::TestMesh large = tests::jittered(tests::sheet(160, 1.0F, 0), 0.1F, 1);
  large.add(tests::jittered(tests::sheet(160, 1.0F, 0.5F), 0.1F, 2));
  for (const ContactWorld& world : {tests::contact_worlds()[1], tests::moved_world(large, 0.6F, 0.03F, 0.01F, 1, 3)}) {
    OnDevice at(world);
    const std::size_t count = world.x.size();
    const fast::ContactForceSums sums = at.forces.evaluate(at.contacts, world.x, world.sliding());
    fast::CudaBuffer<compare::Vec3f> x, start, force, friction;
    fast::CudaBuffer<fast::ContactBlock> block;
    x.upload(world.x.data(), count);
    start.upload(world.start.data(), count);
    for (auto* by_vertex : {&force, &friction}) by_vertex->resize(count);
    block.resize(count);
    for (int again = 0; again < 2; ++again) {
      const fast::ContactEnergy energy = at.forces.evaluate_resident(
          at.contacts, x.data(), {start.data(), world.time_step}, {force.data(), friction.data(), block.data()});
      CHECK(energy.vertex_facet == sums.energy.vertex_facet);
      CHECK(energy.edge_edge == sums.energy.edge_edge);
      CHECK(same_bits(downloaded(force), sums.force));
      CHECK(same_bits(downloaded(friction), sums.friction));
      CHECK(same_bits(downloaded(block), sums.block));
    }
    fast::CudaBuffer<compare::Vec3f> alone;
    alone.resize(count);
    at.forces.evaluate_resident(at.contacts, x.data(), {start.data(), world.time_step}, {.force = alone.data()});
    CHECK(same_bits(downloaded(alone), sums.force));
    CHECK(sums.energy.total() > 0);
  }
}

TEST_CASE("contact_forces: a guard's contacts on the device give the same bits as a finder's", "[gpu]") {
  const ContactWorld world = tests::contact_worlds()[2];
  OnDevice at(world);
  fast::Guard guard(world.mesh.connectivity(), world.previous,
                    {.contact_radius = world.options.contact_radius, .query_radius = 0.1F}, fast::Backend::cuda);
  const fast::ContactForceSums sums = at.forces.evaluate(at.contacts, world.x, world.sliding()),
                               guarded = at.forces.evaluate({guard.contacts(), guard.detected_at_resident()}, world.x,
                                                            world.sliding());
  CHECK(same_bits(guarded.force, sums.force));
  CHECK(same_bits(guarded.block, sums.block));
  CHECK(guarded.energy.total() == sums.energy.total());
}
