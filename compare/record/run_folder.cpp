#include "compare/record/run_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <stdexcept>

#include "compare/files/bytes.hpp"
#include "compare/files/scene_files.hpp"
#include "compare/problem/error.hpp"
#include "compare/files/hdf5.hpp"
#include "compare/files/packing.hpp"
#include "compare/record/iterations_csv.hpp"
#include "compare/record/steps_csv.hpp"

namespace ogc::compare {
namespace {

namespace fs = std::filesystem;

fs::path frame_path(const fs::path& folder, std::int64_t step) { return folder / "frames" / (frame_name(step) + ".h5"); }

/// Step in the name of a frame's file; none for another file.
std::optional<std::int64_t> frame_step_of(const std::string& name) {
  constexpr std::string_view prefix = "frame_", suffix = ".h5";
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return std::nullopt;
  const char* const end = name.data() + name.size() - suffix.size();
  std::int64_t step = 0;
  const auto parsed = std::from_chars(name.data() + prefix.size(), end, step);
  return parsed.ec == std::errc{} && parsed.ptr == end ? std::optional(step) : std::nullopt;
}

/// Length of a table with its header and its whole rows of steps up to `step`. A row begins with the number of its step.
std::size_t length_until(const fs::path& table, std::int64_t step) {
  const std::string text = read_bytes(table);
  std::size_t kept = text.find('\n') + 1;
  for (std::size_t end; (end = text.find('\n', kept)) != std::string::npos; kept = end + 1) {
    std::int64_t row = 0;
    std::from_chars(text.data() + kept, text.data() + end, row);
    if (row > step) break;
  }
  return kept;
}

/// Finished frames by step.
std::vector<std::pair<std::int64_t, fs::path>> list_frames(const fs::path& folder) {
  if (!fs::is_directory(folder / "frames")) throw InputError((folder / "frames").string() + ": is missing: name a folder that `ogc run` has written");
  std::vector<std::pair<std::int64_t, fs::path>> frames;
  for (const auto& entry : fs::directory_iterator(folder / "frames"))
    if (const auto step = frame_step_of(entry.path().filename().string())) frames.emplace_back(*step, entry.path());
  std::sort(frames.begin(), frames.end());
  return frames;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse_path(folder, "make the folder", error);
}

void refuse_used_folder(const fs::path& folder) {
  std::error_code error;
  const auto status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status))
    throw InputError(folder.string() + ": is a file: name a new folder for the run");
  if (error && status.type() != fs::file_type::not_found) refuse_path(folder, "make the folder", error);
  for (const char* name : {"run.json", "scene", "steps.csv", "iterations.csv", "frames", "checkpoint.h5", "trajectory.vtkhdf"})
    if (fs::exists(folder / name))
      throw InputError(folder.string() + ": holds a run already (" + name + "): name another folder, or remove this one");
}

/// Of the bytes of positions, velocities, bounds, step and time, in this order.
std::int64_t checksum(const Frame& frame) {
  static_assert(std::endian::native == std::endian::little, "the low byte comes first");
  std::uint32_t sum = 0;
  const auto add = [&](const auto& values) {
    const std::size_t size = std::size(values) * sizeof(*std::data(values));
    sum = crc32({reinterpret_cast<const char*>(std::data(values)), size}, sum);
  };
  add(frame.positions), add(frame.velocities), add(frame.bounds);
  add(std::array{frame.step}), add(std::array{frame.time});
  return sum;
}

/// Writes the scene beside its place and moves it there as a whole. Returns its file relative to `folder`.
std::string store_scene(const fs::path& folder, const Scene& scene) {
  const fs::path target = folder / "scene", partial = partial_name(target);
  fs::remove_all(partial);
  make_folder(partial);
  const fs::path file = write_scene(partial, scene);
  for (const auto& entry : fs::directory_iterator(partial)) sync_to_disk(entry.path());
  commit_partial(target);
  return (fs::path("scene") / file.filename()).generic_string();
}

}  // namespace

std::vector<Vec3f> as_vectors(const std::vector<float>& floats) {
  std::vector<Vec3f> vectors(floats.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = {floats[3 * i], floats[3 * i + 1], floats[3 * i + 2]};
  return vectors;
}

std::span<const float> as_floats(std::span<const Vec3f> vectors) {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float), "coordinates are stored as rows of three");
  return {reinterpret_cast<const float*>(vectors.data()), 3 * vectors.size()};
}

std::string frame_name(std::int64_t step) {
  std::array<char, 40> name;
  std::snprintf(name.data(), name.size(), "frame_%06lld", static_cast<long long>(step));
  return name.data();
}

void expect_new_run_folder(const fs::path& folder) {
  refuse_used_folder(folder);
  fs::path there = fs::absolute(folder).lexically_normal();
  while (!fs::exists(there) && there.has_relative_path()) there = there.parent_path();
  if (!fs::is_directory(there))
    refuse_path(folder, "make the folder", std::make_error_code(std::errc::not_a_directory));
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    refuse_path(folder, "make the folder", {errno, std::generic_category()});
}

RunWriter::RunWriter(fs::path folder, const Scene& scene, const Provenance& provenance, std::vector<std::string> stage_names)
    : folder_(std::move(folder)), scene_(scene), manifest_{provenance, scene.name, {}, std::move(stage_names)} {
  refuse_used_folder(folder_);
  make_folder(folder_ / "frames");
  manifest_.scene_file = store_scene(folder_, scene_);
  steps_.emplace(folder_ / "steps.csv");
  steps_->append(step_header(manifest_.stage_names));
  if (manifest_.provenance.started.empty()) manifest_.provenance.started = utc_now();
  manifest_.provenance.status = "running";
  write_manifest();
  scene_digest_ = scene_digest(folder_);
}

RunWriter::RunWriter(fs::path folder, const Scene& scene, std::int64_t step, const std::string& note)
    : folder_(std::move(folder)), scene_(scene), manifest_(read_manifest(folder_)), scene_digest_(scene_digest(folder_)) {
  steps_.emplace(folder_ / "steps.csv", length_until(folder_ / "steps.csv", step));
  if (fs::exists(folder_ / "iterations.csv")) iterations_.emplace(folder_ / "iterations.csv", length_until(folder_ / "iterations.csv", step));
  Provenance& provenance = manifest_.provenance;
  std::string& resumed = provenance.extra["resumed"];
  resumed += (resumed.empty() ? "" : "; ") + utc_now() + " after step " + std::to_string(step) + note;
  provenance.ended.clear();
  provenance.status = "running";
  write_manifest();
}

void RunWriter::keep_frames(const std::function<bool(std::int64_t)>& keep) {
  for (const auto& [step, path] : list_frames(folder_))
    if (!keep(step)) fs::remove(path);
}

void RunWriter::write_manifest() const { write_durably(folder_ / "run.json", manifest_text(manifest_, scene_)); }

void RunWriter::add_steps(const std::vector<StepMetrics>& rows) {
  steps_->append(step_lines(rows, manifest_.stage_names.size()));
  const std::string iterations = iteration_lines(rows);
  if (iterations.empty()) return;
  if (!iterations_) iterations_.emplace(folder_ / "iterations.csv").append(iteration_header());
  iterations_->append(iterations);
}

void RunWriter::add_frame(const Frame& frame) {
  const std::size_t count = scene_.mesh.positions.size();
  if (frame.positions.size() != count || frame.velocities.size() != count || frame.bounds.size() != count)
    throw std::invalid_argument("frame of step " + std::to_string(frame.step) + ": its arrays have not one entry for each vertex of the scene");
  const fs::path path = frame_path(folder_, frame.step);
  Hdf5File file = Hdf5File::create_in_memory(path);
  file.set_attribute("/", "format_version", std::array{frame_format_version});
  file.set_attribute("/", "step", std::array{frame.step});
  file.set_attribute("/", "time", frame.time);
  file.write("positions", as_floats(frame.positions), 3);
  file.write("velocities", as_floats(frame.velocities), 3);
  file.write("bounds", std::span(frame.bounds));
  file.set_attribute("/", "crc32", std::array{checksum(frame)});
  write_durably(path, file.image());
}

void RunWriter::save(const Checkpoint& checkpoint) const { write_checkpoint(folder_, checkpoint, scene_digest_); }

void RunWriter::finish(const std::string& status) {
  manifest_.provenance.status = status;
  manifest_.provenance.ended = utc_now();
  write_manifest();
  if (!list_frames(folder_).empty()) assemble_trajectory(folder_);
}

RunReader::RunReader(fs::path folder)
    : manifest_(read_manifest(folder)), scene_(read_scene(folder / manifest_.scene_file)), frames_(list_frames(folder)) {}

Frame RunReader::frame(std::size_t i) const {
  const fs::path& path = frames_.at(i).second;
  Frame frame = read_frame(path);
  if (frame.positions.size() != scene_.mesh.positions.size())
    throw InputError(path.string() + ": has " + std::to_string(frame.positions.size()) + " vertices, the run's scene " +
                     std::to_string(scene_.mesh.positions.size()) + ": the file is of another run; remove it");
  return frame;
}

Frame read_frame(const fs::path& path) {
  const Hdf5File file = Hdf5File::open(path);
  const std::int64_t version =
      file.has_attribute("format_version") ? file.attribute<std::int64_t>("format_version") : 1;
  if (version > frame_format_version)
    throw InputError(path.string() + ": is of frame format " + std::to_string(version) + ", newer than format " +
                     std::to_string(frame_format_version) + ", the newest that this program reads: use a newer ogc");
  const std::vector<std::size_t> shape = file.shape("positions");
  if (shape.size() != 2 || shape[1] != 3 || file.shape("velocities") != shape || file.shape("bounds") != std::vector{shape[0]})
    throw InputError(path.string() + ": positions, velocities and bounds are not vertices × 3, vertices × 3 and vertices: " +
                     "not a frame of a run, or damaged; use another one");
  Frame frame{file.attribute<std::int64_t>("step"), file.attribute<double>("time"),
              as_vectors(file.read<float>("positions")), as_vectors(file.read<float>("velocities")),
              file.read<float>("bounds")};
  if (version > 1 && file.attribute<std::int64_t>("crc32") != checksum(frame))
    throw InputError(path.string() +
                     ": the frame is damaged, its content is not what its checksum says: restore the file, or remove "
                     "it and compute it again from the frame before it with --from-state");
  return frame;
}

}  // namespace ogc::compare
