#include "compare/record/run_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <utility>

#include "compare/files/bytes.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/volumes.hpp"
#include "compare/record/iterations_csv.hpp"
#include "compare/record/steps_csv.hpp"

namespace ogc::compare {
namespace {

namespace fs = std::filesystem;

fs::path frame_path(const fs::path& folder, std::int64_t step) {
  return folder / "frames" / (frame_name(step) + ".h5");
}

std::optional<std::int64_t> frame_step_of(const std::string& name) {
  constexpr std::string_view prefix = "frame_", suffix = ".h5";
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return std::nullopt;
  const char* const end = name.data() + name.size() - suffix.size();
  std::int64_t step = 0;
  const auto parsed = std::from_chars(name.data() + prefix.size(), end, step);
  return parsed.ec == std::errc{} && parsed.ptr == end ? std::optional(step) : std::nullopt;
}

/// Returns the number of bytes of a table up to the last whole row whose step is at most `step`, header included. A row
/// begins with the number of its step.
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

/// Returns finished frames in the order of their steps.
std::vector<std::pair<std::int64_t, fs::path>> list_frames(const fs::path& folder) {
  if (!fs::is_directory(folder / "frames"))
    throw InputError((folder / "frames").string() + ": is missing: name a folder that `ogc run` has written");
  std::vector<std::pair<std::int64_t, fs::path>> frames;
  for (const auto& entry : fs::directory_iterator(folder / "frames"))
    if (const auto step = frame_step_of(entry.path().filename().string())) frames.emplace_back(*step, entry.path());
  std::sort(frames.begin(), frames.end());
  return frames;
}

void remove_partial_frames(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / "frames"))
    if (entry.path().extension() == ".partial") files.push_back(entry.path());
  for (const fs::path& file : files) fs::remove(file);
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
  for (const char* name :
       {"run.json", "scene", "steps.csv", "iterations.csv", "frames", "checkpoint.h5", "trajectory.vtkhdf",
        "worlds.csv", "worlds_steps.csv", "ends"})
    if (fs::exists(folder / name))
      throw InputError(folder.string() + ": holds a run already (" + name +
                       "): name another folder, or remove this one");
}

bool has_ledger(const Manifest& manifest) {
  const auto entry = manifest.provenance.extra.find("ledger");
  return entry != manifest.provenance.extra.end() && entry->second == "yes";
}

}  // namespace

std::string store_scene(const fs::path& folder, const Scene& scene) {
  const fs::path target = folder / "scene", partial = partial_name(target);
  fs::remove_all(partial);
  make_folder(partial);
  const fs::path file = write_scene(partial, scene);
  for (const auto& entry : fs::directory_iterator(partial)) sync_to_disk(entry.path());
  commit_partial(target);
  return (fs::path("scene") / file.filename()).generic_string();
}

StepGroups groups_of(const Scene& scene, const Manifest& manifest) {
  return {.solids = !scene.mesh.tetrahedra.empty(),
          .volumes = has_volumes(scene),
          .sheets = std::ranges::any_of(scene.bodies, [](const Body& b) { return b.is_volume() && b.is_solid(); }),
          .rods = has_rods(scene),
          .meetings = manifest.provenance.extra.contains("meetings"),
          .convergence = true,
          .ledger = has_ledger(manifest)};
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

RunWriter::RunWriter(fs::path folder, const Scene& scene, const Provenance& provenance,
                     std::vector<std::string> stage_names)
    : folder_(std::move(folder)),
      scene_(scene),
      manifest_{provenance, scene.name, {}, std::move(stage_names)},
      queue_([this] { commit(); }) {
  refuse_used_folder(folder_);
  make_folder(folder_ / "frames");
  manifest_.scene_file = store_scene(folder_, scene_);
  steps_.emplace(folder_ / "steps.csv");
  steps_->append(step_header(manifest_.stage_names, groups_of(scene_, manifest_)));
  if (manifest_.provenance.started.empty()) manifest_.provenance.started = utc_now();
  manifest_.provenance.status = "running";
  write_manifest();
  scene_digest_ = scene_digest(folder_);
}

RunWriter::RunWriter(fs::path folder, const Scene& scene, std::int64_t step, const std::string& note)
    : folder_(std::move(folder)),
      scene_(scene),
      manifest_(read_manifest(folder_)),
      scene_digest_(scene_digest(folder_)),
      queue_([this] { commit(); }) {
  steps_.emplace(folder_ / "steps.csv", length_until(folder_ / "steps.csv", step));
  if (fs::exists(folder_ / "iterations.csv"))
    iterations_.emplace(folder_ / "iterations.csv", length_until(folder_ / "iterations.csv", step));
  remove_partial_frames(folder_);
  fs::remove(folder_ / "trajectory.vtkhdf");  // the old trajectory ends at the state at which the run was stopped
  for (const auto& [stored, path] : list_frames(folder_))
    if (stored <= step) written_step_ = stored;
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
  steps_->append(step_lines(rows, manifest_.stage_names.size(), groups_of(scene_, manifest_)));
  if (const std::string iterations = iteration_lines(rows); !iterations.empty()) {
    if (!iterations_) iterations_.emplace(folder_ / "iterations.csv").append(iteration_header());
    iterations_->append(iterations);
  }
  queue_.touch();
}

void RunWriter::add_frame(Frame frame) {
  const std::size_t count = scene_.mesh.positions.size();
  if (frame.positions.size() != count || frame.velocities.size() != count || frame.bounds.size() != count)
    throw std::invalid_argument("frame of step " + std::to_string(frame.step) +
                                ": its arrays have not one entry for each vertex of the scene");
  struct Work {
    Frame frame;
    PackedFrame packed;
  };
  const auto work = std::make_shared<Work>(Work{std::move(frame), {}});
  const std::size_t bytes = 2 * (count * (2 * sizeof(Vec3f) + sizeof(float)) +
                                 // frames need memory twice: plain and packed
                                 work->frame.orientations.size() * sizeof(Quaternion));
  queue_.add(
      bytes, [work] { work->packed = pack(std::exchange(work->frame, {})); },
      [this, work] { write_frame(work->packed); });
}

void RunWriter::write_frame(const PackedFrame& frame) {
  const fs::path path = frame_path(folder_, frame.step);
  write_partial(path, frame_bytes(frame));
  uncommitted_.push_back(path);
  uncommitted_step_ = frame.step;
  grow_trajectory(frame);
}

/// Appends the frame to the trajectory; a continued run first appends the frames that it already has.
void RunWriter::grow_trajectory(const PackedFrame& frame) {
  const fs::path path = folder_ / "trajectory.vtkhdf";
  if (!trajectory_) {
    trajectory_.emplace(path, path.string() + ".growing", scene_);
    for (const auto& [step, file] : list_frames(folder_))
      if (step < frame.step) trajectory_->append(read_packed_frame(file));
  }
  disordered_ |= frame.step <= trajectory_->last_step();
  if (!disordered_) trajectory_->append(frame);
}

void RunWriter::commit() {
  commit_group(folder_ / "frames", uncommitted_);
  if (uncommitted_.empty()) return;
  written_frames_ += static_cast<std::int64_t>(uncommitted_.size());
  written_step_ = uncommitted_step_;
  uncommitted_.clear();
}

void RunWriter::save(Checkpoint checkpoint) {
  const Snapshot& state = checkpoint.state;
  const std::size_t bytes = state.positions.size() * (3 * sizeof(Vec3f) + sizeof(float)) +
                            state.exact_positions.size() * 2 * sizeof(Vec3);
  const auto work = std::make_shared<const Checkpoint>(std::move(checkpoint));
  queue_.add(bytes, {}, [this, work] {
    commit();
    write_checkpoint(folder_, *work, scene_digest_);
  });
}

void RunWriter::complete_trajectory() {
  const auto frames = list_frames(folder_);
  if (frames.empty()) return;
  if (!trajectory_ || disordered_) {
    trajectory_.reset();
    return assemble_trajectory(folder_);
  }
  for (const auto& [step, file] : frames)
    if (step > trajectory_->last_step()) trajectory_->append(read_packed_frame(file));
  trajectory_->finish();
}

void RunWriter::close() {
  if (std::exchange(closed_, true)) return;
  queue_.drain();
  const auto begin = std::chrono::steady_clock::now();
  complete_trajectory();
  closing_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void RunWriter::finish(const std::string& status) {
  close();
  manifest_.provenance.status = status;
  manifest_.provenance.ended = utc_now();
  write_manifest();
}

void RunWriter::give_up(const std::string& status) {
  // The error that made the caller give up is reported, so later errors are ignored.
  try {
    queue_.drain();
  } catch (const std::exception&) {}
  try {
    if (!std::exchange(closed_, true)) complete_trajectory();
  } catch (const std::exception&) {}
  finish(status);
}

RunReader::RunReader(fs::path folder)
    : manifest_(read_manifest(folder)),
      scene_(read_scene(folder / manifest_.scene_file)),
      frames_(list_frames(folder)) {}

void RunReader::check_size(std::size_t i, std::size_t vertices) const {
  if (vertices == scene_.mesh.positions.size()) return;
  throw InputError(frames_.at(i).second.string() + ": has " + std::to_string(vertices) + " vertices, the run's scene " +
                   std::to_string(scene_.mesh.positions.size()) + ": the file is of another run; remove it");
}

Frame RunReader::frame(std::size_t i) const {
  Frame frame = read_frame(frames_.at(i).second);
  check_size(i, frame.positions.size());
  return frame;
}

PackedFrame RunReader::packed_frame(std::size_t i) const {
  PackedFrame frame = read_packed_frame(frames_.at(i).second);
  check_size(i, frame.positions.rows);
  return frame;
}

}  // namespace ogc::compare
