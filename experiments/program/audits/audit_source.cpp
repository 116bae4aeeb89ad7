#include "experiments/program/audits/audit_source.hpp"

#include <glob.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "compare/files/bytes.hpp"
#include "compare/files/frames/mesh_sequence.hpp"
#include "compare/files/frames/natural_order.hpp"
#include "compare/files/meshes/mesh_files.hpp"
#include "compare/problem/error.hpp"
#include "compare/record/run_folder.hpp"
#include "experiments/program/audits/auditor.hpp"
#include "experiments/program/mesh_input.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/python_program.hpp"

namespace ogc::experiments {

namespace {

namespace fs = std::filesystem;
using compare::InputError;

class RunSource : public AuditSource {
 public:
  RunSource(const std::string& folder, std::size_t limit)
      : reader_(folder),
        judge_(reader_.scene()),
        limit_(limit),
        topology_(std::make_shared<compare::Topology>(build_topology(reader_.scene()))) {
    if (reader_.frame_count() == 0) throw InputError(folder + ": holds no frame yet; there is nothing to audit");
  }
  std::size_t size() const override { return reader_.frame_count(); }
  std::string name(std::size_t i) const override { return "step " + std::to_string(reader_.frame_step(i)); }
  AuditedState next() override {
    const compare::Frame frame = reader_.frame(next_);
    return {name(next_++), topology_, compare::to_double(frame.positions), {}, {}, judge_.names(), ""};
  }
  void judge(AuditedState& state) const override {
    // This conversion is exact, because frames are stored in single precision.
    const std::vector<compare::Vec3f> stored = compare::to_single(state.positions);
    state.result = judge_.audit(stored, limit_);
    state.distances = judge_.smallest_distances(stored);
    state.text = judge_.describe(state.result);
    if (!judge_.has_volumes()) return;
    state.volumes = judge_.penetration(stored);
    state.in_volumes = judge_.describe(*state.volumes);
  }
  const compare::Scene* scene() const override { return &reader_.scene(); }
  std::string proof_of_ways() const override { return "the run's own audit proves its motion (run.json); "; }
  compare::ExclusionView exclusions() const override { return judge_.exclusions(); }
  std::string left_out() const override { return left_out_of_audits(reader_.scene()); }

 private:
  compare::RunReader reader_;
  StateJudge judge_;
  std::size_t limit_, next_ = 0;
  std::shared_ptr<const compare::Topology> topology_;
};

/// Throws compare::InputError if a face names a vertex twice; such a mesh has no topology. Degenerate shapes are
/// allowed.
void check_corners(const compare::Mesh& mesh, const std::string& name) {
  const auto check = [&](const char* kind, const auto& faces) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      auto corners = faces[i];
      std::ranges::sort(corners);
      if (std::ranges::adjacent_find(corners) != corners.end())
        throw InputError(name + ": " + kind + " " + std::to_string(i) + " names vertex " +
                         std::to_string(*std::ranges::adjacent_find(corners)) + " twice; remove it");
    }
  };
  check("triangle", mesh.triangles);
  check("edge", mesh.loose_edges);
}

class SequenceSource : public AuditSource {
 public:
  /// `converted`: the folder that the frames are read from, if they were converted into it; else null.
  SequenceSource(std::unique_ptr<compare::MeshSequence> frames, std::size_t limit,
                 std::shared_ptr<const ScratchFolder> converted)
      : converted_(std::move(converted)), frames_(std::move(frames)), limit_(limit) {}
  std::size_t size() const override { return frames_->size(); }
  std::string name(std::size_t i) const override { return frames_->name(i); }
  AuditedState next() override {
    const std::string its_name = name(next_++);
    compare::LoadedMesh loaded = frames_->next();
    compare::Mesh& mesh = loaded.mesh;
    say(loaded);
    take_topology(mesh, its_name);
    AuditedState state{its_name, topology_, std::move(mesh.positions), {}, {}, {}, ""};
    state.is_solid = !mesh.tetrahedra.empty();
    state.file = loaded.source.file;
    if (!loaded.source.file.empty()) state.names = compare::ElementNames(std::move(loaded.source));
    return state;
  }
  void judge(AuditedState& state) const override {
    state.result = compare::audit(*state.topology, state.positions, {}, {.limit = limit_});
    state.distances = compare::smallest_distances(*state.topology, state.positions);
    state.text = compare::describe(state.result, *state.topology, state.names);
    if (!state.file.empty())
      state.doubt = rounding_doubt(compare::printed_digits(state.file), state.result, state.distances, *state.topology,
                                   state.positions);
  }

 private:
  /// Logs the remarks about the first frame that has any. Other frames most likely have the same remarks.
  void say(const compare::LoadedMesh& loaded) {
    if (has_spoken_) return;
    const std::vector<std::string> words = words_about(loaded, "judged as they stand");
    for (const std::string& word : words) log_line("ogc: " + word + (size() > 1 ? " (said of this frame alone)" : ""));
    has_spoken_ = !words.empty();
  }

  /// Builds the frame's topology, unless it equals the topology of the frame before, as in most sequences.
  void take_topology(const compare::Mesh& mesh, const std::string& its_name) {
    const bool is_known = topology_ && static_cast<std::size_t>(topology_->vertex_count) == mesh.positions.size() &&
                          topology_->triangles == mesh.triangles && loose_edges_ == mesh.loose_edges;
    if (is_known) return;
    check_corners(mesh, its_name);
    topology_ = std::make_shared<compare::Topology>(compare::build_topology(mesh));
    loose_edges_ = mesh.loose_edges;
  }

  std::shared_ptr<const ScratchFolder> converted_;
  std::unique_ptr<compare::MeshSequence> frames_;
  std::size_t limit_, next_ = 0;
  std::shared_ptr<const compare::Topology> topology_;
  std::vector<compare::Edge> loose_edges_;
  bool has_spoken_ = false;
};

/// Returns the type of a file. Does not throw for loops of links or for names that are too long; the code that opens
/// the path reports these.
fs::file_type type_of(const fs::path& path) {
  std::error_code error;
  return fs::status(path, error).type();
}

std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Adds the path if it exists. Otherwise adds the files that match it as a pattern, because a shell may not expand
/// patterns or may limit the number of words.
void add_matching(const std::string& path, std::vector<fs::path>& files) {
  if (type_of(path) != fs::file_type::not_found || path.find_first_of("*?[") == std::string::npos) {
    files.emplace_back(path);
    return;
  }
  glob_t found{};
  const int status = ::glob(path.c_str(), GLOB_NOSORT, nullptr, &found);
  for (std::size_t i = 0; status == 0 && i < found.gl_pathc; ++i) files.emplace_back(found.gl_pathv[i]);
  ::globfree(&found);
  if (status != 0) throw InputError(path + ": no file matches this pattern; check the path");
}

using FrameReader = std::unique_ptr<compare::MeshSequence> (*)(const fs::path&, const compare::Mesh*);

std::unique_ptr<compare::MeshSequence> npy_alone(const fs::path& file, const compare::Mesh* topology) {
  return compare::npy_sequence({file}, topology);
}

/// Returns the reader of a format with several frames; null for other formats.
FrameReader reader_of(const std::string& path) {
  static const std::map<std::string, FrameReader> readers{
      {".npz", compare::npz_sequence}, {".npy", npy_alone}, {".pc2", compare::pc2_sequence}};
  const auto found = readers.find(extension_of(path));
  return found == readers.end() ? nullptr : found->second;
}

/// Returns the options for the mesh that provides the faces of files with positions alone. The mesh keeps every vertex,
/// because those files have a position for every vertex.
compare::MeshOptions of_frames(compare::MeshOptions options) {
  options.keep_unused = true;
  options.weld = false;
  return options;
}

std::unique_ptr<compare::MeshSequence> open_frames(const AuditRequest& request) {
  std::optional<compare::Mesh> topology;
  if (!request.topology.empty())
    topology = extension_of(request.topology) == ".npy" || extension_of(request.topology) == ".npz"
                   ? compare::faces_in_arrays(request.topology)
                   : compare::load_mesh(request.topology, of_frames(request.meshes)).mesh;
  const compare::Mesh* faces = topology ? &*topology : nullptr;
  const std::string& first = request.paths.front();
  if (const FrameReader reader = request.paths.size() == 1 ? reader_of(first) : nullptr) return reader(first, faces);
  std::vector<fs::path> files;
  if (request.paths.size() == 1 && type_of(first) == fs::file_type::directory) {
    std::vector<std::string> extensions = compare::mesh_extensions();
    extensions.push_back(".npy");
    files = compare::mesh_files_in(first, extensions);
  } else {
    for (const std::string& path : request.paths) add_matching(path, files);
  }
  std::ranges::sort(files,
                    [](const fs::path& a, const fs::path& b) { return compare::natural_less(a.native(), b.native()); });
  if (std::ranges::all_of(files, [](const fs::path& file) { return extension_of(file.string()) == ".npy"; }))
    return compare::npy_sequence(files, faces);
  if (topology)
    throw InputError("--mesh " + request.topology +
                     " belongs to .npy files, or to one .npz or .pc2; meshes bring triangles of their own");
  for (const fs::path& file : files)
    if (files.size() > 1 && reader_of(file.string()) != nullptr)
      throw InputError(file.string() + ": holds many frames; name it alone, or with other .npy files");
  return compare::mesh_files_sequence(
      std::move(files), [options = request.meshes](const fs::path& file) { return compare::load_mesh(file, options); });
}

/// If the only path is a USD file, converts its frames to arrays in a new folder and makes the request name them. Else
/// returns null.
std::shared_ptr<const ScratchFolder> convert_usd(AuditRequest& request) {
  const std::string first = request.paths.front(), extension = extension_of(first);
  const bool is_usd = extension == ".usd" || extension == ".usda" || extension == ".usdc" || extension == ".usdz";
  if (request.paths.size() != 1 || !is_usd) return nullptr;
  compare::expect_regular_file(first);
  auto folder = std::make_shared<const ScratchFolder>();
  const std::string arrays = (folder->path() / "frames.npz").string();
  if (run_python("plots.usd", {first, "--out", arrays}) != 0)
    throw InputError(first + ": could not be converted; the reason stands above");
  request.paths = {arrays};
  return folder;
}

}  // namespace

std::unique_ptr<AuditSource> open_audit(const AuditRequest& given) {
  AuditRequest request = given;
  const std::shared_ptr<const ScratchFolder> converted = convert_usd(request);
  const bool is_run = request.paths.size() == 1 &&
                      type_of(fs::path(request.paths.front()) / "run.json") == fs::file_type::regular;
  if (is_run && request.topology.empty()) return std::make_unique<RunSource>(request.paths.front(), request.limit);
  auto source = std::make_unique<SequenceSource>(open_frames(request), request.limit, converted);
  if (source->size() == 0) throw InputError(request.paths.front() + ": holds no frame; there is nothing to audit");
  return source;
}

}  // namespace ogc::experiments
