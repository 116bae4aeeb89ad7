// Scratch: bits and times of worlds on the device.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include "fast/contestant.hpp"
#include "fast/worlds.hpp"
#include "experiments/scenes/registry.hpp"
#include "tests/fast/scenes.hpp"
namespace ogc::fast { struct CudaPlace { static int threads; }; }
using namespace ogc; using namespace ogc::fast; using namespace ogc::fast::test;
using Clock = std::chrono::steady_clock;
double ms(Clock::time_point a) { return std::chrono::duration<double, std::milli>(Clock::now() - a).count(); }
compare::Scene falling_sheet(compare::Index n, double speed, int copies = 1, std::int64_t lanes = 0) {
  compare::Scene scene = empty_scene();
  scene.settings.lanes = lanes;
  compare::Material material;
  material.bending_damping = 2e-6, material.membrane_damping = 2e-6;
  for (int c = 0; c < copies; ++c) {
    const std::size_t begin = scene.mesh.positions.size();
    add_sheet(scene, n, 0.10, 0.012, false, material);
    const std::size_t middle = scene.mesh.positions.size();
    add_sheet(scene, 5, 0.12, 0, true, material);
    for (std::size_t v = begin; v < scene.mesh.positions.size(); ++v) {
      compare::Vec3& x = scene.mesh.positions[v];
      if (v < middle) { x.y += 0.1 * x.x + 0.05 * x.z; scene.velocities[v] = {0.1, -speed, 0.05}; }
      x.x += 0.2 * (c % 32); x.z += 0.2 * (c / 32);
    }
  }
  scene.rest_positions = scene.mesh.positions;
  return scene;
}
bool same(const compare::Snapshot& a, const compare::Snapshot& b) {
  return a.step == b.step && a.positions.size() == b.positions.size() &&
         std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * 12) == 0 &&
         std::memcmp(a.velocities.data(), b.velocities.data(), a.positions.size() * 12) == 0;
}
double median(std::vector<double> v) { std::sort(v.begin(), v.end()); return v.empty() ? 0 : v[v.size() / 2]; }
void bits(int count) {
  std::vector<compare::Scene> scenes;
  for (int w = 0; w < count; ++w) {
    compare::Scene& s = scenes.emplace_back(falling_sheet(8 + w % 3, 0.3 + 0.01 * w));
    s.settings.iterations = 6 + w % 4;
    if (w % 4 == 2) s.settings.bounds = compare::Bounds::planes;
  }
  if (count > 1) scenes[1].bodies[0].material.lame_mu = 20;
  auto worlds = start_worlds(Backend::cuda, scenes);
  worlds->advance(7);
  const auto rows = worlds->advance(33);
  const auto cuda = contestant(Backend::cuda);
  int differ = 0, alone_differ = 0;
  std::int64_t contacts = 0, detections = 0;
  for (int w = 0; w < count; ++w) {
    const auto snap = worlds->snapshot(w);
    contacts += rows[w].back().vertex_facet_contacts + rows[w].back().edge_edge_contacts;
    for (const auto& r : rows[w]) detections += r.discrete_detections;
    auto alone = cuda.start(scenes[w], {});
    alone->advance(40);
    differ += same(snap, alone->snapshot()) ? 0 : 1;
    auto one = start_worlds(Backend::cuda, std::span(scenes).subspan(w, 1));
    one->advance(40);
    alone_differ += same(snap, one->snapshot(0)) ? 0 : 1;
  }
  std::printf("bits: %d worlds: %d differ from the CUDA backend alone, %d from one world; %lld contacts, %lld detections in 33 steps\n", count,
              differ, alone_differ, (long long)contacts, (long long)detections);
  std::fflush(stdout);
}
void time_worlds(const char* name, const std::vector<compare::Scene>& scenes, int warm, int steps) {
  auto t = Clock::now();
  auto worlds = start_worlds(Backend::cuda, scenes);
  const double start = ms(t);
  t = Clock::now();
  auto w0 = worlds->advance(warm);
  const double warm_ms = ms(t);
  for (int k = 0; k < 3; ++k) {
    t = Clock::now();
    const auto rows = worlds->advance(steps);
    const double wall = ms(t) / steps;
    double device = 0; std::int64_t contacts = 0, detections = 0, iterations = 0; std::size_t bad = 0;
    for (const auto& r : rows[0]) device += r.wall_ms / steps;
    for (const auto& row : rows) { if (row.size() != (std::size_t)steps) ++bad;
      for (const auto& r : row) detections += r.discrete_detections, iterations += r.iterations;
      if (!row.empty()) contacts += row.back().vertex_facet_contacts + row.back().edge_edge_contacts; }
    std::printf("%s: %zu worlds, %d threads: %.4f ms a step of all (device %.4f), %.1f contacts a world, %.2f detections and %.2f iterations a step, start %.0f ms, first %d steps %.0f ms, short %zu\n",
                name, scenes.size(), CudaPlace::threads, wall, device, (double)contacts / scenes.size(), (double)detections / scenes.size() / steps,
                (double)iterations / scenes.size() / steps, start, warm, warm_ms, bad);
    std::fflush(stdout);
  }
}
void time_one(const char* name, const compare::Scene& scene, int warm, int steps) {
  const auto cuda = contestant(Backend::cuda);
  auto sim = cuda.start(scene, {});
  sim->advance(warm);
  for (int k = 0; k < 3; ++k) {
    auto t = Clock::now();
    const auto rows = sim->advance(steps);
    const double wall = ms(t) / steps;
    std::vector<double> each; std::int64_t detections = 0;
    for (const auto& r : rows) each.push_back(r.wall_ms), detections += r.discrete_detections;
    std::printf("%s: %zu vertices: %.4f ms a step (median device %.4f), %lld contacts, %.2f detections a step\n", name, scene.mesh.positions.size(), wall, median(each),
                (long long)(rows.back().vertex_facet_contacts + rows.back().edge_edge_contacts), (double)detections / steps);
    std::fflush(stdout);
  }
}
int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "bits";
  if (what == "smoke") { bits(1); return 0; }
  if (what == "bits") { for (int n : {1, 3, 64}) bits(n); return 0; }
  if (argc > 3) CudaPlace::threads = std::atoi(argv[3]);
  const int count = argc > 2 ? std::atoi(argv[2]) : 1024;
  const std::int64_t lanes = argc > 4 ? std::atoi(argv[4]) : 0;
  if (what == "cloth") {
    std::vector<compare::Scene> scenes;
    for (int w = 0; w < count; ++w) scenes.push_back(falling_sheet(9, 0.3 + 1e-5 * w, 1, lanes));
    time_worlds("cloth", scenes, 30, 64);
  } else if (what == "cloth_one") {
    time_one("cloth_one", falling_sheet(9, 0.3, count, lanes), 30, 64);
  } else if (what == "sphere" || what == "sphere_one") {
    std::vector<compare::Scene> scenes;
    for (int w = 0; w < count; ++w) { scenes.push_back(experiments::make_scene("cloth_on_sphere", experiments::Scale::smoke)); scenes.back().settings.lanes = lanes; }
    if (what == "sphere") time_worlds("sphere", scenes, 64, 64); else time_one("sphere_one", scenes[0], 64, 64);
  }
  return 0;
}
