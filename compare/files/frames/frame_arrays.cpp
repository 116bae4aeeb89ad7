// Sequences whose frames are rows of one array: NumPy's and point caches. Each frame is read where it is asked for, so
// that memory holds one.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "compare/files/frames/input_file.hpp"
#include "compare/files/frames/mesh_sequence.hpp"
#include "compare/files/frames/npy.hpp"
#include "compare/files/frames/zip.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr auto most_vertices = static_cast<std::uint64_t>(std::numeric_limits<Index>::max());

/// The extents of the frames in a file, and how their numbers are stored.
struct FrameLayout {
  std::uint64_t frames = 0, vertices = 0;
  ScalarType type = ScalarType::float32;
  std::endian order = std::endian::little;
  std::uint64_t frame_bytes() const { return vertices * 3 * size_of(type); }
};

/// `topology` with the array's number of vertices. Throws where a face names none of them.
Mesh checked_faces(Mesh topology, const FrameLayout& layout, const std::string& where) {
  const auto check = [&](const char* kind, const auto& faces) {
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (const Index v : faces[i])
        if (v < 0 || static_cast<std::uint64_t>(v) >= layout.vertices)
          throw InputError(where + ": " + kind + " " + std::to_string(i) + ": vertex " + std::to_string(v) +
                           " does not exist; a frame has " + std::to_string(layout.vertices) + ", numbered from 0");
  };
  check("triangle", topology.triangles);
  check("edge", topology.loose_edges);
  topology.positions.clear();
  return topology;
}

class FrameArray : public MeshSequence {
 public:
  /// `keep` holds what `source` reads from.
  FrameArray(std::string where, FrameLayout layout, Mesh topology, ByteSource source, std::shared_ptr<void> keep)
      : where_(std::move(where)),
        layout_(layout),
        topology_(checked_faces(std::move(topology), layout, where_)),
        source_(std::move(source)),
        keep_(std::move(keep)) {}

  std::size_t size() const override { return layout_.frames; }
  std::string name(std::size_t i) const override { return "frame " + std::to_string(i); }

  LoadedMesh next() override {
    const std::string frame = name(next_++);
    std::string bytes(layout_.frame_bytes(), '\0');
    source_(bytes, frame);
    Mesh mesh = topology_;
    mesh.positions.resize(layout_.vertices);
    const std::size_t width = size_of(layout_.type);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const auto coordinate = [&](std::size_t k) {
        return scalar_at(bytes.data() + (3 * v + k) * width, layout_.type, layout_.order);
      };
      mesh.positions[v] = {coordinate(0), coordinate(1), coordinate(2)};
      if (!std::isfinite(mesh.positions[v].x) || !std::isfinite(mesh.positions[v].y) ||
          !std::isfinite(mesh.positions[v].z))
        throw InputError(where_ + ": " + frame + ": vertex " + std::to_string(v) + ": a coordinate is not finite");
    }
    return {std::move(mesh), {}, {}};
  }

 private:
  std::string where_;
  FrameLayout layout_;
  Mesh topology_;
  ByteSource source_;
  std::shared_ptr<void> keep_;
  std::size_t next_ = 0;
};

FrameLayout layout_of(const NpyHeader& header, std::uint64_t bytes, const std::string& where) {
  FrameLayout layout{1, 0, header.type, header.order};
  const auto& shape = header.shape;
  if ((shape.size() != 2 && shape.size() != 3) || shape.back() != 3 || !is_floating(header.type))
    throw InputError(where + ": is an array " + shape_text(shape) +
                     (is_floating(header.type) ? "" : " of whole numbers") +
                     "; positions are [frames, vertices, 3] (or [vertices, 3] for one frame) of float32 or float64");
  if (shape.size() == 3) layout.frames = shape[0];
  layout.vertices = shape[shape.size() - 2];
  if (layout.vertices > most_vertices)
    throw InputError(where + ": has " + std::to_string(layout.vertices) + " vertices; " +
                     std::to_string(most_vertices) + " are the most");
  // Division, as the product of announced extents may be beyond 64 bits.
  if (layout.vertices > 0 && layout.frames > bytes / layout.frame_bytes())
    throw InputError(where + ": is an array " + shape_text(shape) + ", but only " +
                     std::to_string(bytes / layout.frame_bytes()) + " frames fit into its " + std::to_string(bytes) +
                     " bytes; it is truncated");
  return layout;
}

/// The first member that has one of the names; the names are the members' without ".npy".
std::optional<std::string> member_named(const ZipFile& zip, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    for (const std::string& member : zip.members())
      if (member == std::string(name) + ".npy") return member;
  return std::nullopt;
}

ByteSource source_of(const std::shared_ptr<ZipFile>& zip) {
  return [zip](std::span<char> bytes, const std::string& what) { zip->read(bytes, what); };
}

template <std::size_t Corners>
std::vector<std::array<Index, Corners>> read_faces(const std::shared_ptr<ZipFile>& zip, const std::string& member,
                                                   const std::string& name) {
  const std::string where = name + ": '" + member + "'";
  zip->open(member);
  const ByteSource source = source_of(zip);
  const NpyHeader header = read_npy_header(source, where);
  if (header.shape.size() != 2 || header.shape[1] != Corners || is_floating(header.type))
    throw InputError(where + ": is an array " + shape_text(header.shape) +
                     (is_floating(header.type) ? " of floating-point numbers" : "") + "; " +
                     (Corners == 3 ? "triangles are [n, 3]" : "edges are [n, 2]") + " of whole numbers");
  const std::size_t row = Corners * size_of(header.type);
  if (header.shape[0] > zip->size() / row)
    throw InputError(where + ": is an array " + shape_text(header.shape) + ", which its " +
                     std::to_string(zip->size()) + " bytes don't hold");
  std::string bytes(header.shape[0] * row, '\0');
  source(bytes, "the faces");
  std::vector<std::array<Index, Corners>> faces(header.shape[0]);
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t k = 0; k < Corners; ++k) {
      const double value = scalar_at(bytes.data() + i * row + k * size_of(header.type), header.type, header.order);
      if (!(value >= 0 && value <= static_cast<double>(most_vertices)))
        throw InputError(where + ": row " + std::to_string(i) + ": vertex " + shortest(value) +
                         " does not exist; vertices are numbered from 0");
      faces[i][k] = static_cast<Index>(value);
    }
  return faces;
}

Mesh faces_of(const std::shared_ptr<ZipFile>& zip, const Mesh* topology, const std::string& name) {
  const auto triangles = member_named(*zip, {"triangles", "faces"}), edges = member_named(*zip, {"edges"});
  Mesh mesh;
  if (triangles) mesh.triangles = read_faces<3>(zip, *triangles, name);
  if (edges) mesh.loose_edges = read_faces<2>(zip, *edges, name);
  for (Edge& edge : mesh.loose_edges) std::ranges::sort(edge);
  if (triangles || edges) return mesh;
  if (topology == nullptr)
    throw InputError(name +
                     ": holds neither 'triangles' [n, 3] nor 'edges' [n, 2]; add them to the archive, or name a mesh "
                     "that has them with --mesh");
  return *topology;
}

const Mesh& needed(const Mesh* topology, const std::string& name) {
  if (topology == nullptr)
    throw InputError(name + ": holds positions alone; name a mesh that has their triangles with --mesh");
  return *topology;
}

void check_count(const Mesh& topology, std::uint64_t vertices, const std::string& name) {
  if (topology.positions.size() != vertices)
    throw InputError(name + ": a frame has " + std::to_string(vertices) + " vertices, the mesh of --mesh " +
                     std::to_string(topology.positions.size()) + "; give the mesh that was simulated");
}

}  // namespace

std::unique_ptr<MeshSequence> npz_sequence(const std::filesystem::path& file, const Mesh* topology) {
  const auto zip = std::make_shared<ZipFile>(file);
  const std::string name = file.string();
  const auto member = member_named(*zip, {"positions", "x", "vertices", "points", "verts"});
  if (!member) {
    std::string held;
    for (const std::string& one : zip->members()) held += (held.empty() ? "" : ", ") + one;
    throw InputError(name + ": holds no 'positions' (nor x, vertices, points or verts); it holds " +
                     (held.empty() ? "nothing" : held));
  }
  Mesh faces = faces_of(zip, topology, name);
  const std::string where = name + ": '" + *member + "'";
  zip->open(*member);
  const NpyHeader header = read_npy_header(source_of(zip), where);
  const FrameLayout layout = layout_of(header, zip->size(), where);
  if (!faces.positions.empty()) check_count(faces, layout.vertices, name);
  return std::make_unique<FrameArray>(where, layout, std::move(faces), source_of(zip), zip);
}

std::unique_ptr<MeshSequence> npy_sequence(const std::filesystem::path& file, const Mesh* topology) {
  const auto input = std::make_shared<InputFile>(file);
  const ByteSource source = [input](std::span<char> bytes, const std::string& what) { input->read(bytes, what); };
  const NpyHeader header = read_npy_header(source, input->name());
  const FrameLayout layout = layout_of(header, input->size() - input->position(), input->name());
  check_count(needed(topology, input->name()), layout.vertices, input->name());
  return std::make_unique<FrameArray>(input->name(), layout, *topology, source, input);
}

std::unique_ptr<MeshSequence> pc2_sequence(const std::filesystem::path& file, const Mesh* topology) {
  const auto input = std::make_shared<InputFile>(file);
  const std::string& name = input->name();
  const ByteSource source = [input](std::span<char> bytes, const std::string& what) { input->read(bytes, what); };
  constexpr std::string_view magic("POINTCACHE2\0", 12);
  std::array<char, 32>
      header;  // magic, version, points, start [frames], rate, samples: the last five of four bytes each
  source(header, "the header");
  if (std::string_view(header.data(), magic.size()) != magic)
    throw InputError(name + ": does not begin with POINTCACHE2; it is no PC2 file");
  const auto word = [&](std::size_t k) { return number_at<std::int32_t>(header.data() + k, std::endian::little); };
  if (word(12) != 1) throw InputError(name + ": is of version " + std::to_string(word(12)) + "; only 1 is known");
  if (word(16) < 0 || word(28) < 0)
    throw InputError(name + ": announces " + std::to_string(word(16)) + " points and " + std::to_string(word(28)) +
                     " samples; it is damaged");
  const FrameLayout layout{static_cast<std::uint64_t>(word(28)), static_cast<std::uint64_t>(word(16)),
                           ScalarType::float32, std::endian::little};
  check_count(needed(topology, name), layout.vertices, name);
  return std::make_unique<FrameArray>(name, layout, *topology, source, input);
}

}  // namespace ogc::compare
