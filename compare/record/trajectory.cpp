#include "compare/record/trajectory.hpp"

#include <algorithm>
#include <array>

#include "compare/files/durable_file.hpp"
#include "compare/problem/error.hpp"
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
  const auto write_integers = [&](const char* name, const Integers& values) {
    file.write(group + name, std::span(values));
  };
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
  file.write("VTKHDF/NumberOfPoints",
             std::span<const std::int64_t>(std::array{static_cast<std::int64_t>(scene.mesh.positions.size())}));
  write_cells(file, "Vertices", std::vector<std::array<Index, 1>>{});
  write_cells(file, "Lines", scene.mesh.loose_edges);
  write_cells(file, "Polygons", scene.mesh.triangles);
  write_cells(file, "Strips", std::vector<std::array<Index, 3>>{});
  const std::vector<Index> bodies = body_of_vertex(scene);
  file.create_group("VTKHDF/PointData");
  file.write("VTKHDF/PointData/body", std::span(bodies));
}

std::size_t at_once(std::size_t count, std::size_t bytes) { return Hdf5File::largest_size(count, bytes, count); }

/// Returns an upper limit of the disk space of the fixed data: bodies, two kinds of cells with connectivity and
/// offsets, and small datasets. A small dataset has at most one number and takes less space than HDF5's data about it.
std::size_t static_size(const Mesh& mesh) {
  constexpr std::size_t small_datasets = 16, groups = 1 << 16;
  const std::size_t cells = mesh.triangles.size() + mesh.loose_edges.size();
  return at_once(mesh.positions.size(), sizeof(Index)) +
         2 * (at_once(3 * cells + 1, sizeof(std::int64_t)) + at_once(cells + 2, sizeof(std::int64_t))) +
         small_datasets * Hdf5File::largest_size(0, 1, 1) + groups;
}

/// Returns an upper limit of the disk space of the offsets of this many steps: ten datasets of at most four numbers
/// each.
std::size_t steps_size(std::size_t count) {
  return 10 * at_once(std::max<std::size_t>(count, 1), 4 * sizeof(std::int64_t));
}

}  // namespace

TrajectoryWriter::TrajectoryWriter(std::filesystem::path path, std::filesystem::path growing, const Scene& scene)
    : path_(std::move(path)), growing_(std::move(growing)) {
  const std::size_t chunk_rows = even_chunk_rows(scene.mesh.positions.size());
  frame_rows_ = (scene.mesh.positions.size() + chunk_rows - 1) / chunk_rows * chunk_rows;
  used_ = static_size(scene.mesh);
  reserved_ = used_ + steps_size(1);
  file_ = Hdf5File::create(growing_, reserved_);
  write_static_part(*file_, scene);
  file_->create_growing("VTKHDF/Points", 3, chunk_rows);
  file_->create_growing("VTKHDF/PointData/velocity", 3, chunk_rows);
  file_->create_growing("VTKHDF/PointData/bound", 0, chunk_rows);
}

TrajectoryWriter::~TrajectoryWriter() {
  if (!file_) return;
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(growing_, ignored);
}

/// Reserves disk space for `more` bytes before HDF5 writes them, because HDF5 1.10 crashes on a full disk.
void TrajectoryWriter::reserve(std::size_t more) {
  used_ += more;
  const std::size_t needed = used_ + steps_size(times_.size() + 1);
  if (needed <= reserved_) return;
  file_->reserve(reserved_, needed);
  reserved_ = needed;
}

void TrajectoryWriter::append(const PackedFrame& frame) {
  reserve(Hdf5File::growth(frame.positions) + Hdf5File::growth(frame.velocities) + Hdf5File::growth(frame.bounds));
  file_->append_packed("VTKHDF/Points", frame.positions);
  file_->append_packed("VTKHDF/PointData/velocity", frame.velocities);
  file_->append_packed("VTKHDF/PointData/bound", frame.bounds);
  times_.push_back(frame.time);
  last_step_ = frame.step;
}

void TrajectoryWriter::write_steps() {
  const std::size_t count = times_.size();
  const Integers zeros(count, 0), zeros_by_kind(4 * count, 0), ones(count, 1);
  Integers rows(count);
  for (std::size_t i = 0; i < count; ++i) rows[i] = static_cast<std::int64_t>(i * frame_rows_);
  file_->create_group("VTKHDF/Steps");
  file_->set_attribute("VTKHDF/Steps", "NSteps", std::array{static_cast<std::int64_t>(count)});
  file_->write("VTKHDF/Steps/Values", std::span<const double>(times_));
  const auto write_integers = [&](const char* name, const Integers& integers, std::size_t columns) {
    file_->write(std::string("VTKHDF/Steps/") + name, std::span(integers), columns);
  };
  write_integers("PartOffsets", zeros, 0);
  write_integers("NumberOfParts", ones, 0);
  write_integers("PointOffsets", rows, 0);
  write_integers("CellOffsets", zeros_by_kind, 4);
  write_integers("ConnectivityIdOffsets", zeros_by_kind, 4);
  file_->create_group("VTKHDF/Steps/PointDataOffsets");
  write_integers("PointDataOffsets/velocity", rows, 0);
  write_integers("PointDataOffsets/bound", rows, 0);
  write_integers("PointDataOffsets/body", zeros, 0);
}

void TrajectoryWriter::finish() {
  write_steps();
  file_->close();
  commit_file(growing_, path_);
  file_.reset();
}

void assemble_trajectory(const std::filesystem::path& folder) {
  const RunReader run(folder);
  if (run.frame_count() == 0)
    throw InputError(folder.string() + ": has no finished frame yet: let the run go on, or run it again");
  const std::filesystem::path path = folder / "trajectory.vtkhdf";
  TrajectoryWriter trajectory(path, partial_name(path), run.scene());
  for (std::size_t i = 0; i < run.frame_count(); ++i) trajectory.append(run.packed_frame(i));
  trajectory.finish();
}

}  // namespace ogc::compare
