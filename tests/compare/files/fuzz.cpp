// Damages files of states and scenes at random: point caches, scene files and cases in text. Each must be read, or
// rejected with an error that names it, within 100 MB beyond the program's memory (tests/compare/files/fuzzing.hpp).
// HDF5 files are left out, because the HDF5 library itself crashes on about one damaged file in ten thousand.
#include "tests/compare/files/fuzzing.hpp"

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/files/frames/mesh_sequence.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/judge/cases/generators.hpp"
#include "compare/judge/report/corpus.hpp"
#include "tests/compare/files/scratch.hpp"
#include "tests/seeds.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

const Mesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}}, {{0, 1, 2}, {0, 2, 3}}, {}};

/// Returns a path in memory if there is a file system in memory, since a disk is a hundred times slower.
std::filesystem::path place_for(const std::string& name) {
  static const Scratch folder(std::filesystem::exists("/dev/shm") ? "/dev/shm"
                                                                  : std::filesystem::temp_directory_path());
  return folder / name;
}

std::string point_cache() {
  std::string bytes = "POINTCACHE2";
  bytes += '\0';
  for (const std::int32_t number : {1, 4}) append_number(bytes, number);
  for (const float number : {0.f, 1.f}) append_number(bytes, number);
  append_number(bytes, std::int32_t{2});
  for (int frame = 0; frame < 2; ++frame)
    for (const Vec3& p : square.positions)
      for (const double x : {p.x, p.y + frame, p.z}) append_number(bytes, static_cast<float>(x));
  return bytes;
}

constexpr const char* small_scene =
    R"({"format_version": 2, "gravity": [0, -9.81, 0], "settings": {"contact_radius": 0.01, "steps": 3}, "bodies": )"
    R"([{"name": "cloth", "mesh": "square.obj", "material": {"density": 0.2, "membrane": "stable_neo_hookean"}}], )"
    R"("motions": [{"name": "hand", "body": "cloth", "vertices": [0, 1], "velocity": [0, 0.5, 0]}]})";

std::string fault_of(const std::string& bytes, const std::string& name) {
  const std::filesystem::path file = place_for(name);
  write_bytes(file, bytes);
  return fault_of_reading(name, [&] {
    if (name.ends_with(".pc2")) {
      const auto frames = pc2_sequence(file, &square);
      for (std::size_t i = 0; i < frames->size(); ++i) frames->next();
    } else if (name == "scene.json") {
      load_scene_file(file);
    } else {
      load_case(file);
    }
  });
}

std::vector<Sample> samples() {
  write_bytes(place_for("square.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3\nf 1 3 4\n");
  return {{"cache.pc2", point_cache()},
          {"scene.json", small_scene},
          {"case.json", case_to_json(generate({Stage::detect_vertex_facet, "few", 1, 1, "", {}}), "why").dump()}};
}

}  // namespace

TEST_CASE("damaged states and scenes are read or refused: a frozen seed", "[property]") {
  fuzz(samples(), fault_of, 51, 1000);
}

TEST_CASE("damaged states and scenes are read or refused: the seed of the day", "[property]") {
  fuzz(samples(), fault_of, 1000 * daily_seed("damaged states and scenes"), 10'000);
}
