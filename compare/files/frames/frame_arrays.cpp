// Reads sequences whose frames are arrays: NumPy arrays, with all frames in one array or one array for each frame, and
// point caches.
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include "compare/files/frames/frame_array.hpp"
#include "compare/files/frames/input_file.hpp"
#include "compare/files/frames/natural_order.hpp"
#include "compare/files/frames/zip.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr auto most_vertices = static_cast<std::uint64_t>(std::numeric_limits<Index>::max());

/// Smallest and largest memory [bytes] for the frames that one pass over an array in Fortran order gathers. Between
/// these limits the memory is as large as the array's file.
constexpr std::uint64_t least_room = 1 << 26, most_room = 1 << 30;

std::uint64_t room_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  return std::clamp<std::uint64_t>(error ? 0 : size, least_room, most_room);
}

FrameLayout layout_of(const NpyHeader& header, std::uint64_t bytes, const std::string& where) {
  FrameLayout layout{1, 0, header.type, header.order, header.fortran_order};
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
  if (layout.vertices == 0)
    throw InputError(where + ": is an array " + shape_text(shape) + ", whose frames have no vertex");
  // Divides, because the product of the given extents may exceed 64 bits.
  if (layout.frames > bytes / layout.frame_bytes())
    throw InputError(where + ": is an array " + shape_text(shape) + ", but only " +
                     std::to_string(bytes / layout.frame_bytes()) + " frames fit into its " + std::to_string(bytes) +
                     " bytes; it is truncated");
  return layout;
}

/// Names of arrays of positions and of triangles; the first name that an archive has is used. `v_template` is the rest
/// shape of SMPL.
constexpr std::array<std::string_view, 8> position_names{"positions", "x", "vertices", "points",
                                                         "verts",     "v", "V",        "v_template"};
constexpr std::array<std::string_view, 4> triangle_names{"triangles", "faces", "f", "F"};
/// Texts before the number in the names of arrays that hold one frame each: numpy.savez calls them arr_0, arr_1, ….
constexpr std::array<std::string_view, 3> frame_names{"frame", "arr", ""};

/// Returns the first member NAME.npy whose NAME is in the list.
std::optional<std::string> member_named(const ZipFile& zip, std::span<const std::string_view> names) {
  for (const std::string_view name : names)
    for (const std::string& member : zip.members())
      if (member == std::string(name) + ".npy") return member;
  return std::nullopt;
}

/// Returns whether the member's name is the stem and a number: "STEM7.npy" or "STEM_7.npy".
bool is_numbered(std::string_view member, std::string_view stem) {
  if (!member.starts_with(stem) || !member.ends_with(".npy")) return false;
  member = member.substr(stem.size(), member.size() - stem.size() - 4);
  if (member.starts_with('_') && !stem.empty()) member.remove_prefix(1);
  return !member.empty() && std::ranges::all_of(member, [](char c) { return c >= '0' && c <= '9'; });
}

/// Returns the members whose names are a stem and a number, in natural order, for the first stem that has such members.
std::vector<std::string> numbered_members(const ZipFile& zip) {
  std::vector<std::string> found;
  const auto look = [&](std::span<const std::string_view> stems) {
    for (const std::string_view stem : stems)
      if (found.empty())
        std::ranges::copy_if(zip.members(), std::back_inserter(found),
                             [&](const std::string& member) { return is_numbered(member, stem); });
  };
  look(position_names);
  look(frame_names);
  std::ranges::sort(found, natural_less);
  return found;
}

/// An array, with its header and a function that opens it at its first number.
struct FoundArray {
  std::string where;  ///< begins messages
  NpyHeader header;
  std::uint64_t bytes = 0;  ///< upper limit of the size of its numbers
  ArrayOpener open;
  std::uint64_t room = least_room;  ///< memory for the frames of one pass [bytes]
};

FoundArray array_in(const std::shared_ptr<ZipFile>& zip, const std::string& member, const std::filesystem::path& file) {
  FoundArray array;
  array.where = file.string() + ": '" + member + "'";
  const ByteSource source = [zip](std::span<char> bytes, const std::string& what) { zip->read(bytes, what); };
  array.open = [zip, member, source, where = array.where]() {
    zip->open(member);
    read_npy_header(source, where);
    return source;
  };
  zip->open(member);
  array.header = read_npy_header(source, array.where);
  array.bytes = zip->size();
  array.room = room_of(file);
  return array;
}

FoundArray array_in(const std::filesystem::path& file) {
  FoundArray array;
  array.where = file.string();
  array.open = [file]() -> ByteSource {
    const auto input = std::make_shared<InputFile>(file);
    const ByteSource source = [input](std::span<char> bytes, const std::string& what) { input->read(bytes, what); };
    read_npy_header(source, input->name());
    return source;
  };
  InputFile input(file);
  array.header = read_npy_header([&](std::span<char> bytes, const std::string& what) { input.read(bytes, what); },
                                 array.where);
  array.bytes = input.size() - input.position();
  array.room = room_of(file);
  return array;
}

template <std::size_t Corners>
std::vector<std::array<Index, Corners>> read_faces(const FoundArray& array) {
  const auto& [where, header, size, open, room] = array;
  if (header.shape.size() != 2 || header.shape[1] != Corners || is_floating(header.type))
    throw InputError(where + ": is an array " + shape_text(header.shape) +
                     (is_floating(header.type) ? " of floating-point numbers" : "") + "; " +
                     (Corners == 3 ? "triangles are [n, 3]" : "edges are [n, 2]") + " of whole numbers");
  const std::size_t width = size_of(header.type), row = Corners * width, count = header.shape[0];
  if (count > size / row)
    throw InputError(where + ": is an array " + shape_text(header.shape) + ", which its " + std::to_string(size) +
                     " bytes don't hold");
  std::string bytes(count * row, '\0');
  open()(bytes, "the faces");
  std::vector<std::array<Index, Corners>> faces(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < Corners; ++k) {
      const std::size_t place = header.fortran_order ? k * count + i : i * Corners + k;
      const double value = scalar_at(bytes.data() + place * width, header.type, header.order);
      if (!(value >= 0 && value <= static_cast<double>(most_vertices)))
        throw InputError(where + ": row " + std::to_string(i) + ": vertex " + shortest(value) +
                         " does not exist; vertices are numbered from 0");
      faces[i][k] = static_cast<Index>(value);
    }
  return faces;
}

/// Returns triangles and edges of an archive; nothing if it has neither.
std::optional<Mesh> faces_of(const std::shared_ptr<ZipFile>& zip, const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 1> edge_names{"edges"};
  const auto triangles = member_named(*zip, triangle_names), edges = member_named(*zip, edge_names);
  if (!triangles && !edges) return std::nullopt;
  Mesh mesh;
  if (triangles) mesh.triangles = read_faces<3>(array_in(zip, *triangles, file));
  if (edges) mesh.loose_edges = read_faces<2>(array_in(zip, *edges, file));
  for (Edge& edge : mesh.loose_edges) std::ranges::sort(edge);
  return mesh;
}

const Mesh& needed(const Mesh* topology, const std::string& name) {
  if (topology == nullptr)
    throw InputError(name + ": holds positions alone; name a mesh that has their triangles with --mesh");
  return *topology;
}

/// Checks the number of vertices. A mesh without positions, from an array of faces, fits any number.
void check_count(const Mesh& topology, std::uint64_t vertices, const std::string& name) {
  if (!topology.positions.empty() && topology.positions.size() != vertices)
    throw InputError(name + ": a frame has " + std::to_string(vertices) + " vertices, the mesh of --mesh " +
                     std::to_string(topology.positions.size()) + "; give the mesh that was simulated");
}

/// Returns the frames of all arrays, one array after another. If there are several arrays, a frame's name begins with
/// the name of its array.
std::unique_ptr<MeshSequence> frames_of(const std::vector<FoundArray>& arrays, const std::vector<std::string>& names,
                                        const Mesh& faces) {
  const auto kept = std::make_shared<const Mesh>(faces);
  std::vector<FramePart> parts;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const FoundArray& array = arrays[i];
    const FrameLayout layout = layout_of(array.header, array.bytes, array.where);
    check_count(faces, layout.vertices, array.where);
    if (arrays.size() == 1) return frame_array(array.where, layout, faces, array.open, array.room);
    parts.push_back({names[i], layout.frames, [array, layout, kept] {
                       return frame_array(array.where, layout, *kept, array.open, array.room);
                     }});
  }
  return chained(std::move(parts));
}

/// Returns whether the array may contain triangles. In an archive of numpy.savez(file, vertices, triangles) names do
/// not tell this, since both are numbered.
bool are_faces(const FoundArray& array) {
  const NpyHeader& header = array.header;
  return !is_floating(header.type) && header.shape.size() == 2 && header.shape[1] == 3;
}

std::string held_by(const ZipFile& zip) {
  std::string held;
  for (const std::string& one : zip.members()) held += (held.empty() ? "" : ", ") + one;
  const bool is_body = std::ranges::count(zip.members(), "poses.npy") > 0;
  return (held.empty() ? "nothing" : shown(held, 400)) +
         (is_body ? "; poses are parameters of a body model: let it compute the vertices, and store those" : "");
}

/// Moves the first array of faces from `arrays` to `faces`, unless `faces` is set.
void take_faces(std::vector<FoundArray>& arrays, std::vector<std::string>& names, std::optional<Mesh>& faces) {
  for (std::size_t i = 0; i < arrays.size() && !faces; ++i) {
    if (!are_faces(arrays[i])) continue;
    faces.emplace();
    faces->triangles = read_faces<3>(arrays[i]);
    arrays.erase(arrays.begin() + static_cast<std::ptrdiff_t>(i));
    names.erase(names.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

std::unique_ptr<MeshSequence> npz_sequence(const std::filesystem::path& file, const Mesh* topology) {
  const auto zip = std::make_shared<ZipFile>(file);
  const std::string name = file.string();
  std::vector<std::string> members;
  if (const auto member = member_named(*zip, position_names))
    members = {*member};
  else
    members = numbered_members(*zip);
  std::optional<Mesh> faces = faces_of(zip, file);
  std::vector<FoundArray> arrays;
  for (const std::string& member : members) arrays.push_back(array_in(zip, member, file));
  take_faces(arrays, members, faces);
  if (arrays.empty())
    throw InputError(name + ": holds no 'positions' (nor " + joined(std::span(position_names).subspan(1)) +
                     ", nor frames of one array each: frame_0, frame_1); it holds " + held_by(*zip));
  if (!faces && topology == nullptr)
    throw InputError(name + ": holds neither 'triangles' [n, 3] (nor " + joined(std::span(triangle_names).subspan(1)) +
                     ") nor 'edges' [n, 2]; add them to the archive, or name a mesh that has them with --mesh");
  return frames_of(arrays, members, faces ? *faces : *topology);
}

std::unique_ptr<MeshSequence> npy_sequence(const std::vector<std::filesystem::path>& files, const Mesh* topology) {
  std::vector<FoundArray> arrays;
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) {
    arrays.push_back(array_in(file));
    names.push_back(file.string());
  }
  std::optional<Mesh> faces;
  if (topology == nullptr && files.size() > 1) take_faces(arrays, names, faces);
  return frames_of(arrays, names, faces ? *faces : needed(topology, files.front().string()));
}

Mesh faces_in_arrays(const std::filesystem::path& file) {
  Mesh mesh;
  if (file.extension() != ".npz" && file.extension() != ".NPZ") {
    mesh.triangles = read_faces<3>(array_in(file));
    return mesh;
  }
  const auto zip = std::make_shared<ZipFile>(file);
  if (auto faces = faces_of(zip, file)) return std::move(*faces);
  throw InputError(file.string() + ": holds neither " + joined(triangle_names) + " nor edges; it holds " +
                   held_by(*zip));
}

std::unique_ptr<MeshSequence> pc2_sequence(const std::filesystem::path& file, const Mesh* topology) {
  const auto input = std::make_shared<InputFile>(file);
  const std::string& name = input->name();
  const ByteSource source = [input](std::span<char> bytes, const std::string& what) { input->read(bytes, what); };
  constexpr std::string_view magic("POINTCACHE2\0", 12);
  std::array<char, 32>
      header;  // magic, version, points, start [frames], rate, samples; the last five have four bytes each
  source(header, "the header");
  if (std::string_view(header.data(), magic.size()) != magic)
    throw InputError(name + ": does not begin with POINTCACHE2; it is no PC2 file");
  const auto word = [&](std::size_t k) { return number_at<std::int32_t>(header.data() + k, std::endian::little); };
  if (word(12) != 1) throw InputError(name + ": is of version " + std::to_string(word(12)) + "; only 1 is known");
  if (word(16) <= 0 || word(28) < 0)
    throw InputError(name + ": announces " + std::to_string(word(16)) + " points and " + std::to_string(word(28)) +
                     " samples; it is damaged");
  const FrameLayout layout{static_cast<std::uint64_t>(word(28)), static_cast<std::uint64_t>(word(16)),
                           ScalarType::float32, std::endian::little};
  check_count(needed(topology, name), layout.vertices, name);
  return frame_array(
      name, layout, *topology, [source] { return source; }, least_room);
}

}  // namespace ogc::compare
