// Damages files of every format at random. Each must give a mesh, or an error that names it, within 100 MB beyond the
// program's memory. Cases run in separate processes under a limit on memory. A fixed seed shows what a change breaks. A
// second seed, new each day and printed, finds unexpected errors. OGC_FUZZ_CASES sets the number of cases of each file.
#include <zlib.h>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/files/meshes/msh.hpp"
#include "compare/files/meshes/obj.hpp"
#include "compare/files/meshes/ply.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"
#include "compare/record/vtp.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/fuzzing.hpp"
#include "tests/compare/files/meshes/samples.hpp"
#include "tests/seeds.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

const Mesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1.0 / 3}}, {{0, 1, 2}, {0, 2, 3}}, {{1, 3}}};

std::string base64(const std::string& bytes) {
  const std::string uri = base64_uri(bytes);
  return uri.substr(uri.find(',') + 1, uri.rfind('"') - uri.find(',') - 1);
}

/// Returns a VTP file whose points zlib has compressed in one block.
std::string packed_vtp() {
  std::string points;
  for (const Vec3& p : square.positions)
    for (const double x : {p.x, p.y, p.z}) append_number(points, x);
  std::string packed(compressBound(points.size()), '\0'), head;
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(points.data()),
           points.size());
  packed.resize(size);
  for (const std::size_t number : {std::size_t{1}, points.size(), std::size_t{0}, packed.size()})
    append_number(head, static_cast<std::uint32_t>(number));
  return "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" compressor=\"vtkZLibDataCompressor\"><PolyData><Piece>"
         "<Points><DataArray type=\"Float64\" format=\"binary\">" +
         base64(head) + base64(packed) +
         "</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 2 3"
         "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6</DataArray></Polys></Piece>"
         "</PolyData></VTKFile>";
}

std::vector<Sample> samples() {
  const Mesh cube = make_mesh(parse_polygon_mesh(cube_medit(), "m.mesh")).mesh;
  return {{"m.obj", "# made\n" + print_obj(square) + "f 1/1 2//1 -1 \\\n 4\n"},
          {"m.ply", print_ply(square, PlyEncoding::ascii)},
          {"m.ply", print_ply(square, PlyEncoding::binary)},
          {"m.off", square_off},
          {"m.stl", square_stl()},
          {"m.stl", binary_stl(2)},
          {"m.gltf", square_gltf()},
          {"m.glb", square_glb()},
          {"m.vtp", vtp_bytes({square, {4, 5, 6, 7}, {1, 2, 3}, {1, 0, 1}})},
          {"m.vtp", packed_vtp()},
          {"m.vtu", cube_vtu()},
          {"m.vtk", cube_vtk(false, false)},
          {"m.vtk", cube_vtk(false, true)},
          {"m.vtk", cube_vtk(true, false)},
          {"m.vtk", cube_vtk(true, true)},
          {"m.msh", print_msh(cube)},
          {"m.msh", binary_msh(false)},
          {"m.msh", binary_msh(true, std::endian::big)},
          {"m.mesh", cube_medit()}};
}

/// Makes a mesh of the file and validates it. Returns "" or a description of the program's fault.
std::string fault_of(const std::string& bytes, const std::string& name) {
  try {
    for (const MeshOptions& options : {MeshOptions{.rounded = true}, MeshOptions{.weld = true}}) {
      const LoadedMesh loaded = make_mesh(parse_polygon_mesh(bytes, name), options);
      if (describe(validate(loaded.mesh, 10, ElementNames(loaded.source))).size() > 100'000) return "tells too much";
    }
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (!text.starts_with(name + ": ")) return "is refused without its name: " + text;
    if (text.size() > 1000) return "is refused with " + std::to_string(text.size()) + " bytes of text";
  } catch (const std::exception& error) {
    return std::string("ends in ") + error.what();
  }
  return "";
}

void fuzz_meshes(std::uint64_t seed, std::size_t cases) { fuzz(samples(), fault_of, seed, cases); }

}  // namespace

TEST_CASE("a reader that takes too much memory, dies or complains about something else is found", "[unit]") {
  const Sample sample{"m.off", square_off};
  const auto greedy = [](const std::string&, const std::string& name) -> std::string {
    try {
      return std::string(most_memory + 50'000'000, 'x').substr(0, 0);
    } catch (const std::bad_alloc&) {
      return name + " takes too much";
    }
  };
  const auto dying = [](const std::string&, const std::string&) -> std::string { std::abort(); };
  if (limits_memory) CHECK(failure(sample, greedy, 7, 3) == "m.off, seed 7, case 0 m.off takes too much");
  CHECK_THAT(failure(sample, dying, 7, 3), ContainsSubstring("m.off, seed 7, case 0 signal"));
  CHECK(failure(sample, fault_of, 7, 3) == "");
  CHECK(fault_of("gone", "m.max") == "");  // rejected because of its name alone
}

TEST_CASE("damaged mesh files end in an answer or a named refusal, within 100 MB: a frozen seed", "[property]") {
  fuzz_meshes(51, 2000);
}

TEST_CASE("damaged mesh files end in an answer or a named refusal, within 100 MB: the seed of the day", "[property]") {
  fuzz_meshes(1000 * ogc::tests::daily_seed("damaged mesh files"), 10000);
}
