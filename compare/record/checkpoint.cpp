#include "compare/record/checkpoint.hpp"

#include <algorithm>
#include <array>

#include "compare/files/bytes.hpp"
#include "compare/files/durable_file.hpp"
#include "compare/files/hdf5.hpp"
#include "compare/files/scenes/orientations.hpp"
#include "compare/problem/error.hpp"
#include "compare/record/run_folder.hpp"

namespace ogc::compare {
namespace {

namespace fs = std::filesystem;

fs::path path_in(const fs::path& folder) { return folder / "checkpoint.h5"; }

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string state_digest(const Checkpoint& checkpoint) {
  const Snapshot& state = checkpoint.state;
  std::string all;
  for (const std::string_view part :
       {bytes_of(state.positions), bytes_of(state.velocities), bytes_of(state.bounds), bytes_of(state.capacities),
        bytes_of(state.exact_positions), bytes_of(state.exact_velocities), bytes_of(state.orientations),
        bytes_of(state.search_limits)})
    all += part;
  return digest(all + std::to_string(state.step) + "," + std::to_string(checkpoint.audited_states));
}

void write_vectors(Hdf5File& file, const std::string& name, std::span<const Vec3> vectors) {
  if (vectors.empty()) return;
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
  file.write(name, std::span<const double>(values), 3);
}

std::vector<Vec3> read_vectors(const Hdf5File& file, const std::string& name) {
  if (!file.has(name)) return {};
  const std::vector<double> values = file.read<double>(name);
  std::vector<Vec3> vectors;
  vectors.reserve(values.size() / 3);
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) vectors.push_back({values[i], values[i + 1], values[i + 2]});
  return vectors;
}

struct Stored {
  Checkpoint checkpoint;
  std::string digest, scene_digest;
};

/// Throws InputError if a newer program wrote the file.
void check_version(const Hdf5File& file, const std::string& path) {
  const auto version = file.attribute<std::int64_t>("format_version");
  if (version > checkpoint_format_version)
    throw InputError(path + ": is of checkpoint format " + std::to_string(version) + ", newer than format " +
                     std::to_string(checkpoint_format_version) +
                     ", the newest that this program reads: use a newer ogc");
}

Stored content(const Hdf5File& file, const std::string& path) {
  Stored stored;
  Snapshot& state = stored.checkpoint.state;
  state.step = file.attribute<std::int64_t>("step");
  state.positions = as_vectors(file.read<float>("positions"));
  state.velocities = as_vectors(file.read<float>("velocities"));
  state.bounds = file.read<float>("bounds");
  state.capacities = file.read<std::int64_t>("capacities");
  state.exact_positions = read_vectors(file, "exact_positions");
  state.exact_velocities = read_vectors(file, "exact_velocities");
  state.orientations = read_orientations(file, path);
  if (file.has("search_limits")) state.search_limits = file.read<float>("search_limits");
  stored.checkpoint.audited_states = file.attribute<std::int64_t>("audited_states");
  stored.digest = file.read_text("digest");
  stored.scene_digest = file.read_text("scene");
  return stored;
}

}  // namespace

void write_checkpoint(const fs::path& folder, const Checkpoint& checkpoint, const std::string& scene_digest) {
  const Snapshot& state = checkpoint.state;
  Hdf5File file = Hdf5File::create_in_memory(path_in(folder));
  file.set_attribute("/", "format_version", std::array{checkpoint_format_version});
  file.set_attribute("/", "step", std::array{state.step});
  file.set_attribute("/", "audited_states", std::array{checkpoint.audited_states});
  file.write("positions", as_floats(state.positions), 3);
  file.write("velocities", as_floats(state.velocities), 3);
  file.write("bounds", std::span(state.bounds));
  file.write("capacities", std::span(state.capacities));
  write_vectors(file, "exact_positions", state.exact_positions);
  write_vectors(file, "exact_velocities", state.exact_velocities);
  if (!state.orientations.empty()) file.write("orientations", as_floats(state.orientations), 4);
  if (!state.search_limits.empty()) file.write("search_limits", std::span(state.search_limits));
  file.write_text("scene", scene_digest);
  file.write_text("digest", state_digest(checkpoint));
  write_durably(path_in(folder), file.image());
}

Checkpoint read_checkpoint(const fs::path& folder, const std::string& scene_digest) {
  const std::string path = path_in(folder).string();
  if (!fs::exists(path))
    throw InputError(path +
                     ": is missing: the run ended before its first state was stored, or a version of the program "
                     "without checkpoints wrote it; remove " +
                     "the folder and run it again");
  const std::string remedy = ": begin a new run from its last frame, ogc run … --from-state " +
                             (folder / "frames").string() + "/…";
  Stored stored;
  try {
    const Hdf5File file = Hdf5File::open(path);
    check_version(file, path);
    stored = content(file, path);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "; this is the run's checkpoint, without which it can't be resumed" +
                     remedy);
  }
  if (stored.digest != state_digest(stored.checkpoint)) throw InputError(path + ": the checkpoint is damaged" + remedy);
  require_units(stored.checkpoint.state.orientations, path);
  if (stored.scene_digest != scene_digest)
    throw InputError(
        (folder / "scene").string() +
        ": is not the scene that this run was begun with, its files were changed since: restore them, or begin a " +
        "new run of the changed scene, ogc run " + (folder / "scene").string() + "/NAME.json");
  return stored.checkpoint;
}

std::string scene_digest(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / "scene")) files.push_back(entry.path());
  std::ranges::sort(files);
  std::string all;
  for (const fs::path& file : files) all.append(file.filename().string()).append(digest(read_bytes(file)));
  return digest(all);
}

}  // namespace ogc::compare
