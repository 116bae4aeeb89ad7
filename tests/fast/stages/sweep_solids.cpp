// Tests that the sums of a solid's vertices have the same bits in packs and item by item, alone and beside surfaces.
#include <cstring>
#include <random>

#include "fast/cpu/backend.hpp"
#include "fast/stages/sweep.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

/// Holds a crumpled block without contacts. Start positions differ a little, so that damping acts.
struct Fixture {
  compare::Scene scene = empty_scene();
  RestState rest;
  Colouring colouring;
  CpuBackend backend;
  std::vector<PaddedVec> padded, padded_start;
  std::vector<Vec> start;
  std::unique_ptr<Sweep<CpuBackend>> sweep;

  Fixture(double damping, compare::DampingForm form) {
    compare::Material material;
    material.solid_damping = damping;
    scene.settings.damping = form;
    append_body(scene, {.name = "block", .material = material}, tests::block_mesh(4, 0.1));
    compare::round_to_single(scene);
    const compare::Topology topology = compare::build_topology(scene);
    rest = build_rest_state(scene, topology);
    colouring = colour_vertices(rest);
    sweep = std::make_unique<Sweep<CpuBackend>>(backend, rest, colouring, topology, scene);
    std::mt19937 random(7);
    std::normal_distribution<float> normal(0, 0.02f);
    for (int copy = 0; copy < 2; ++copy)
      for (const compare::Vec3f& p : compare::to_single(scene.mesh.positions))
        padded.emplace_back(Vec{p.x + normal(random), p.y + normal(random), p.z + normal(random)});
    for (const compare::Vec3f& p : compare::to_single(scene.mesh.positions)) {
      start.push_back({p.x, p.y, p.z + normal(random)});
      padded_start.emplace_back(start.back());
    }
    sweep->begin(start.data());
  }

  SweepView view() {
    SweepView view;
    sweep->complete(view);
    view.start = {padded_start.data()};
    view.old = padded.data();
    view.to_fresh = static_cast<int>(start.size());
    return view;
  }
};

template <int W, class Gather>
ForceAndBlock sum_of(Fixture& f, int slot, const Gather& gather) {
  const SweepView view = f.view();
  const SweepVertex vertex = view.vertices[slot];
  return gather(view, slot, vertex, f.padded[static_cast<std::size_t>(vertex.vertex)], SerialTeam<W>{});
}

std::vector<const PackKernels*> all_kernels() {
#ifdef __x86_64__
  if (has_avx2()) return {&pack_kernels_baseline, &pack_kernels_avx2};
#endif
  return {&pack_kernels_baseline};
}

/// Counts the vertices for which the two sums differ.
template <int W, class A, class B>
int other_bits(Fixture& f, const A& a, const B& b) {
  int count = 0;
  for (int slot = 0; slot < static_cast<int>(f.colouring.order.size()); ++slot) {
    const ForceAndBlock first = sum_of<W>(f, slot, a), second = sum_of<W>(f, slot, b);
    count += std::memcmp(&first, &second, sizeof first) == 0 ? 0 : 1;
  }
  return count;
}

template <int W>
void check(Fixture& f, const PackKernels& kernels) {
  if (f.scene.settings.damping == compare::DampingForm::strain)
    CHECK((other_bits<W>(f, GatherAll{}, GatherSolids{})) == 0);
  CHECK((other_bits<W>(f, GatherPacked{kernels}, GatherAll{})) == 0);
}

}  // namespace

TEST_CASE("the sum of a solid's vertex has the same bits in packs, in turn, and beside surfaces, for every width",
          "[property]") {
  const double damping = GENERATE(0.0, 1e-3);
  const auto form = GENERATE(compare::DampingForm::strain, compare::DampingForm::per_vertex);
  Fixture f(damping, form);
  for (const PackKernels* kernels : all_kernels()) {
    check<2>(f, *kernels);
    check<4>(f, *kernels);
    check<8>(f, *kernels);
    check<16>(f, *kernels);
  }
}

TEST_CASE("a solid's damping is not zero and none of a rigid motion", "[property]") {
  Fixture damped(1e-3, compare::DampingForm::strain), plain(0, compare::DampingForm::strain);
  CHECK(other_bits<4>(damped, GatherSolids{}, GatherSolids{}) == 0);
  const ForceAndBlock with = sum_of<4>(damped, 20, GatherSolids{}), without = sum_of<4>(plain, 20, GatherSolids{});
  CHECK(std::memcmp(&with, &without, sizeof with) != 0);
  // The block has moved as a whole since the start of the step, so its strain has changed by rounding errors only. The
  // force of damping is then negligible compared with the elastic force.
  for (Fixture* f : {&damped, &plain}) {
    f->padded.resize(f->start.size());
    for (std::size_t v = 0; v < f->start.size(); ++v) f->padded[v] = PaddedVec(f->start[v] + Vec{0.5f, 0, 0});
    const std::vector<PaddedVec> once = f->padded;
    f->padded.insert(f->padded.end(), once.begin(), once.end());
  }
  const ForceAndBlock still = sum_of<4>(damped, 20, GatherSolids{}), elastic = sum_of<4>(plain, 20, GatherSolids{});
  CHECK(static_cast<double>(still.force.z) == Approx(static_cast<double>(elastic.force.z)).margin(0.05));
}
