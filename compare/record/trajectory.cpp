// VTKHDF 2.0, temporal PolyData. What moves (points, velocities, bounds) stands one frame behind the other and each step says where its rows begin;
// what does not (cells, bodies) stands once, and each step's offset into it is 0. Frames are copied one at a time, so memory holds one.
#include <array>

#include "compare/problem/error.hpp"
#include "compare/files/hdf5.hpp"
#include "compare/record/run_folder.hpp"

namespace ogc::compare {
namespace {

using Integers = std::vector<std::int64_t>;

template <std::size_t Corners>
void write_cells(Hdf5File& file, const std::string& kind, const std::vector<std::array<Index, Corners>>& cells) {
  Integers connectivity, offsets{0};
  for (const auto& cell : cells) {
    connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  const std::string group = "VTKHDF/" + kind;
  const auto write_integers = [&](const char* name, const Integers& values) { file.write(group + name, std::span(values)); };
  file.create_group(group);
  write_integers("/NumberOfConnectivityIds", {static_cast<std::int64_t>(connectivity.size())});
  write_integers("/NumberOfCells", {static_cast<std::int64_t>(cells.size())});
  write_integers("/Connectivity", connectivity);
  write_integers("/Offsets", offsets);
}

void write_static_part(Hdf5File& file, const Scene& scene) {
  file.create_group("VTKHDF");
  file.set_attribute("VTKHDF", "Version", std::array<std::int64_t, 2>{2, 0});
  file.set_attribute("VTKHDF", "Type", std::string_view("PolyData"));
  file.write("VTKHDF/NumberOfPoints", std::span<const std::int64_t>(std::array{static_cast<std::int64_t>(scene.mesh.positions.size())}));
  write_cells(file, "Vertices", std::vector<std::array<Index, 1>>{});
  write_cells(file, "Lines", scene.mesh.loose_edges);
  write_cells(file, "Polygons", scene.mesh.triangles);
  write_cells(file, "Strips", std::vector<std::array<Index, 3>>{});
  const std::vector<Index> bodies = body_of_vertex(scene);
  file.create_group("VTKHDF/PointData");
  file.write("VTKHDF/PointData/body", std::span(bodies));
}

/// Offsets of each step; `values`: its times.
void write_steps(Hdf5File& file, const std::vector<double>& values, std::size_t vertex_count) {
  const std::size_t count = values.size();
  const Integers zeros(count, 0), zeros_by_kind(4 * count, 0), ones(count, 1);
  Integers rows(count);
  for (std::size_t i = 0; i < count; ++i) rows[i] = static_cast<std::int64_t>(i * vertex_count);
  file.create_group("VTKHDF/Steps");
  file.set_attribute("VTKHDF/Steps", "NSteps", std::array{static_cast<std::int64_t>(count)});
  file.write("VTKHDF/Steps/Values", std::span(values));
  const auto write_integers = [&](const char* name, const Integers& integers, std::size_t columns) {
    file.write(std::string("VTKHDF/Steps/") + name, std::span(integers), columns);
  };
  write_integers("PartOffsets", zeros, 0);
  write_integers("NumberOfParts", ones, 0);
  write_integers("PointOffsets", rows, 0);
  write_integers("CellOffsets", zeros_by_kind, 4);
  write_integers("ConnectivityIdOffsets", zeros_by_kind, 4);
  file.create_group("VTKHDF/Steps/PointDataOffsets");
  write_integers("PointDataOffsets/velocity", rows, 0);
  write_integers("PointDataOffsets/bound", rows, 0);
  write_integers("PointDataOffsets/body", zeros, 0);
}

/// Copies the frames; returns their times.
std::vector<double> write_moving_part(Hdf5File& file, const RunReader& run, std::size_t vertex_count) {
  const std::size_t rows = run.frame_count() * vertex_count;
  file.create_dataset<float>("VTKHDF/Points", rows, 3, vertex_count);
  file.create_dataset<float>("VTKHDF/PointData/velocity", rows, 3, vertex_count);
  file.create_dataset<float>("VTKHDF/PointData/bound", rows, 0, vertex_count);
  std::vector<double> times;
  for (std::size_t i = 0; i < run.frame_count(); ++i) {
    const Frame frame = run.frame(i);
    file.write_rows("VTKHDF/Points", i * vertex_count, as_floats(frame.positions));
    file.write_rows("VTKHDF/PointData/velocity", i * vertex_count, as_floats(frame.velocities));
    file.write_rows("VTKHDF/PointData/bound", i * vertex_count, std::span(frame.bounds));
    times.push_back(frame.time);
  }
  return times;
}

/// Disk that the file takes at most: each group of cells has four datasets, the steps have ten.
std::size_t largest_size(const RunReader& run) {
  const Mesh& mesh = run.scene().mesh;
  const std::size_t rows = run.frame_count() * mesh.positions.size(), cell_count = mesh.triangles.size() + mesh.loose_edges.size();
  const auto at_once = [](std::size_t count, std::size_t bytes) { return Hdf5File::largest_size(count, bytes, count); };
  const std::size_t part = mesh.positions.size();
  const std::size_t moving = 2 * Hdf5File::largest_size(rows, sizeof(Vec3f), part) + Hdf5File::largest_size(rows, sizeof(float), part);
  const std::size_t fixed = at_once(part, sizeof(Index)) + 16 * at_once(3 * cell_count + 1, sizeof(std::int64_t));
  return moving + fixed + 10 * at_once(run.frame_count(), 4 * sizeof(std::int64_t)) + (1 << 16);
}

void write_trajectory(const std::filesystem::path& path, const RunReader& run) {
  const std::size_t vertex_count = run.scene().mesh.positions.size();
  Hdf5File file = Hdf5File::create(path, largest_size(run));
  write_static_part(file, run.scene());
  write_steps(file, write_moving_part(file, run, vertex_count), vertex_count);
  file.close();
}

}  // namespace

void assemble_trajectory(const std::filesystem::path& folder) {
  const RunReader run(folder);
  if (run.frame_count() == 0) throw InputError(folder.string() + ": has no finished frame yet: let the run go on, or run it again");
  const std::filesystem::path path = folder / "trajectory.vtkhdf", partial = partial_name(path);
  try {
    write_trajectory(partial, run);
  } catch (const std::exception&) {
    std::filesystem::remove(partial);
    throw;
  }
  commit_partial(path);
}

}  // namespace ogc::compare
