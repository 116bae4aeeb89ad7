#include "compare/files/frames/natural_order.hpp"

#include <algorithm>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "compare/files/frames/mesh_sequence.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/scratch.hpp"

using namespace ogc::compare;

TEST_CASE("files are in the order in which people count them", "[unit]") {
  const std::vector<std::string> sorted{"a",
                                        "a.obj",
                                        "a1",
                                        "a01",
                                        "a1b",
                                        "a2",
                                        "a10",
                                        "a10.5",
                                        "a10.30",
                                        "a99999999999999999999998",
                                        "a99999999999999999999999",
                                        "b",
                                        "frame_2.ply",
                                        "frame_10.ply",
                                        "frame_x.ply"};
  std::vector<std::string> shuffled = sorted;
  std::ranges::shuffle(shuffled, std::mt19937(1));
  std::ranges::sort(shuffled, natural_less);
  CHECK(shuffled == sorted);
  for (const std::string& a : sorted)
    for (const std::string& b : sorted) CHECK(natural_less(a, b) == (&a < &b));
}

TEST_CASE("a folder gives its meshes of one kind in natural order, and is refused where it holds several kinds or none",
          "[unit]") {
  const ogc::tests::Scratch folder;
  const auto write = [&](const std::string& name) { std::ofstream(folder / name) << "\n"; };
  for (const char* name : {"f_10.obj", "f_9.OBJ", "f_100.obj", "notes.txt"}) write(name);
  const std::vector<std::filesystem::path> files = mesh_files_in(folder.folder(), {".obj", ".ply"});
  CHECK(files == std::vector{folder / "f_9.OBJ", folder / "f_10.obj", folder / "f_100.obj"});
  CHECK_THROWS_WITH(mesh_files_in(folder.folder(), {".ply"}), ContainsSubstring("holds no mesh"));
  write("f_1.ply");
  CHECK_THROWS_WITH(mesh_files_in(folder.folder(), {".obj", ".ply"}), ContainsSubstring("3 .obj, 1 .ply"));
}
