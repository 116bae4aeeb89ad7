// Times calls of the public C++ interface, for costs.py, which times Python's calls of the same work.
//
//   python_costs BACKEND MESH: reads MESH (int32 V, int32 T, float32 (V, 3), int32 (T, 3)), then lines "CALL PLACE
//   COUNT" from the standard input. CALL: find, step or advance; PLACE: host or device, where arrays lie. Prints the
//   shortest time of COUNT calls [µs].
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "compare/problem/error.hpp"
#include "compare/problem/scene.hpp"
#include "fast/contact_sets.hpp"
#include "fast/guard.hpp"
#ifdef OGC_HAS_CUDA
#include <cuda_runtime.h>
#endif

using namespace ogc;
using compare::Vec3f;

namespace {

struct TestMesh {
  std::vector<Vec3f> positions;
  std::vector<compare::Triangle> triangles;
};

TestMesh read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  file.exceptions(std::ios::failbit | std::ios::badbit);
  std::int32_t counts[2];
  const auto fill = [&file](auto* to, std::size_t bytes) {
    file.read(static_cast<char*>(static_cast<void*>(to)), static_cast<std::streamsize>(bytes));
  };
  fill(counts, sizeof counts);
  TestMesh mesh{std::vector<Vec3f>(compare::at(counts[0])), std::vector<compare::Triangle>(compare::at(counts[1]))};
  fill(mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f));
  fill(mesh.triangles.data(), mesh.triangles.size() * sizeof(compare::Triangle));
  return mesh;
}

/// Returns a copy of vectors on the device.
std::shared_ptr<Vec3f> on_device([[maybe_unused]] const std::vector<Vec3f>& vectors) {
#ifdef OGC_HAS_CUDA
  void* memory = nullptr;
  const std::size_t bytes = vectors.size() * sizeof(Vec3f);
  if (cudaMalloc(&memory, bytes) == cudaSuccess &&
      cudaMemcpy(memory, vectors.data(), bytes, cudaMemcpyHostToDevice) == cudaSuccess)
    return {static_cast<Vec3f*>(memory), [](Vec3f* gone) { cudaFree(gone); }};
#endif
  throw compare::ResourceError("device: there is none");
}

/// Returns the scene of costs.py: a cloth that nothing moves.
compare::Scene scene_of(const TestMesh& mesh) {
  compare::Scene scene;
  scene.gravity = {};
  scene.settings.time_step = 1.0 / 300;
  scene.settings.iterations = 1;
  scene.settings.contact_radius = 1e-4;
  compare::Mesh cloth;
  cloth.positions = compare::to_double(mesh.positions);
  cloth.triangles = mesh.triangles;
  append_body(scene, {.name = "cloth", .material = {}}, cloth);
  compare::round_to_single(scene);
  return scene;
}

/// Returns the shortest time of `count` calls [µs].
double shortest(int count, const std::function<void()>& call) {
  using Clock = std::chrono::steady_clock;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < count; ++k) {
    const Clock::time_point begun = Clock::now();
    call();
    least = std::min(least, std::chrono::duration<double, std::micro>(Clock::now() - begun).count());
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const fast::Backend backend = std::string(argv[1]) == "cuda" ? fast::Backend::cuda : fast::Backend::cpu;
  const TestMesh mesh = read(argv[2]);
  const fast::Mesh connectivity(static_cast<compare::Index>(mesh.positions.size()), mesh.triangles);
  const fast::ContactQuery query{.contact_radius = 5e-3F, .query_radius = 1e-2F};
  fast::ContactFinder finder(connectivity, backend);
  fast::Guard guard(connectivity, mesh.positions, {.query_radius = 1e-2F, .bounds = compare::Bounds::planes}, backend);
  const auto simulation = fast::contestant(backend).start(scene_of(mesh), {});
  std::vector<Vec3f> x = mesh.positions;
  const std::vector<Vec3f> rest(x.size());
  std::string what, place;
  for (int count = 0; std::cin >> what >> place >> count;) {
    std::shared_ptr<Vec3f> x_there, rest_there;
    if (place == "device") x_there = on_device(x), rest_there = on_device(rest);
    std::function<void()> call;
    if (what == "advance")
      call = [&] { simulation->advance(1); };
    else if (what == "find" && x_there)
      call = [&] { finder.find_columns_resident(x_there.get(), query); };
    else if (what == "find")
      call = [&] { (void)finder.find_columns(x, query).copied_to_host(); };
    else if (what == "step" && x_there)
      call = [&] { guard.step_resident(x_there.get(), rest_there.get(), x_there.get()); };
    else if (what == "step")
      call = [&] { guard.step(x, rest, x); };
    else
      return 2;
    std::cout << shortest(count, call) << std::endl;
  }
}
