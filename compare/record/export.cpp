#include "compare/record/export.hpp"

#include <array>
#include <string>

#include "compare/files/bytes.hpp"
#include "compare/files/meshes/mesh_files.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/local_origin.hpp"
#include "compare/problem/text.hpp"
#include "compare/record/vtp.hpp"
#include "compare/record/vtu.hpp"

namespace ogc::compare {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> names{"obj", "ply", "vtp", "vtu"};

void write_frame(const fs::path& path, ExportFormat format, const Scene& scene, std::span<const Index> bodies,
                 const Frame& frame, const Vec3& origin) {
  if (format == ExportFormat::vtp)
    write_durably(path, vtp_bytes(scene.mesh, bodies, frame, origin));
  else if (format == ExportFormat::vtu)
    write_durably(path, vtu_bytes(scene, bodies, frame, origin));
  else
    write_mesh(path, {in_file(origin, frame.positions), scene.mesh.triangles, scene.mesh.loose_edges});
}

}  // namespace

ExportFormat parse_export_format(std::string_view text) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == text) return static_cast<ExportFormat>(i);
  throw InputError(unknown_name("export format", text, names));
}

std::vector<fs::path> export_run(const fs::path& folder, ExportFormat format, const fs::path& out,
                                 const std::function<void(std::size_t, std::size_t)>& written) {
  const RunReader run(folder);
  if (run.frame_count() == 0)
    throw InputError(folder.string() + ": has no finished frame yet: let the run go on, or run it again");
  std::error_code error;
  fs::create_directories(out, error);
  if (error) refuse_path(out, "make the folder", error);
  const std::vector<Index> bodies = body_of_vertex(run.scene());
  const std::string extension = "." + std::string(names[static_cast<std::size_t>(format)]);
  std::vector<fs::path> files;
  std::vector<std::pair<double, std::string>> index;
  for (std::size_t i = 0; i < run.frame_count(); ++i) {
    const Frame frame = run.frame(i);
    const std::string name = frame_name(frame.step) + extension;
    write_frame(out / name, format, run.scene(), bodies, frame, run.provenance().origin);
    files.push_back(out / name);
    index.emplace_back(frame.time, name);
    if (written) written(i + 1, run.frame_count());
  }
  if (format == ExportFormat::vtp || format == ExportFormat::vtu) {
    files.push_back(out / (run.scene().name + ".pvd"));
    write_durably(files.back(), pvd_text(index));
  }
  return files;
}

}  // namespace ogc::compare
