#include "compare/record/frame_file.hpp"

#include <array>
#include <bit>
#include <cstdio>

#include "compare/files/hdf5.hpp"
#include "compare/files/scenes/orientations.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

namespace fs = std::filesystem;

std::int64_t checksum(const Frame& frame) {
  static_assert(std::endian::native == std::endian::little, "the low byte comes first");
  std::uint32_t sum = 0;
  const auto add = [&](const auto& values) {
    if (std::size(values) == 0) return;  // zlib's crc32 restarts the sum if it gets a null pointer
    const std::size_t size = std::size(values) * sizeof(*std::data(values));
    sum = crc32({reinterpret_cast<const char*>(std::data(values)), size}, sum);
  };
  add(frame.positions), add(frame.velocities), add(frame.bounds);
  add(std::array{frame.step}), add(std::array{frame.time});
  add(as_floats(frame.orientations)), add(frame.residual), add(frame.cut);
  return sum;
}

/// Returns the version of the frame's format. Throws InputError if a newer program wrote it.
std::int64_t version_of(const Hdf5File& file, const fs::path& path) {
  if (!file.has_attribute("format_version")) return 1;
  const auto version = file.attribute<std::int64_t>("format_version");
  if (version > frame_format_version)
    throw InputError(path.string() + ": is of frame format " + std::to_string(version) + ", newer than format " +
                     std::to_string(frame_format_version) + ", the newest that this program reads: use a newer ogc");
  return version;
}

/// Returns a measured value of each vertex; empty if the frame does not have it.
std::vector<float> measure(const Hdf5File& file, const std::string& name, std::size_t vertices, const fs::path& path) {
  if (!file.has(name)) return {};
  if (file.shape(name) != std::vector{vertices})
    throw InputError(path.string() + ": '" + name + "' is not one number for each of the " + std::to_string(vertices) +
                     " vertices: the frame is damaged; use another one");
  return file.read<float>(name);
}

PackedArray packed(std::span<const float> values) { return values.empty() ? PackedArray{} : pack(values); }

Frame content(const Hdf5File& file, const fs::path& path) {
  const std::int64_t version = version_of(file, path);
  const std::vector<std::size_t> shape = file.shape("positions");
  if (shape.size() != 2 || shape[1] != 3 || file.shape("velocities") != shape ||
      file.shape("bounds") != std::vector{shape[0]})
    throw InputError(path.string() +
                     ": positions, velocities and bounds are not vertices × 3, vertices × 3 and vertices: "
                     "not a frame of a run, or damaged; use another one");
  Frame frame{file.attribute<std::int64_t>("step"),
              file.attribute<double>("time"),
              as_vectors(file.read<float>("positions")),
              as_vectors(file.read<float>("velocities")),
              file.read<float>("bounds"),
              read_orientations(file, path.string()),
              measure(file, "residual", shape[0], path),
              measure(file, "cut", shape[0], path)};
  if (version > 1 && file.attribute<std::int64_t>("crc32") != checksum(frame))
    throw InputError(path.string() +
                     ": the frame is damaged, its content is not what its checksum says: restore the file, or remove "
                     "it and compute it again from the frame before it with --from-state");
  require_units(frame.orientations, path.string());
  return frame;
}

}  // namespace

std::string frame_name(std::int64_t step) {
  std::array<char, 40> name;
  std::snprintf(name.data(), name.size(), "frame_%06lld", static_cast<long long>(step));
  return name.data();
}

std::vector<Vec3f> as_vectors(const std::vector<float>& floats) {
  std::vector<Vec3f> vectors(floats.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = {floats[3 * i], floats[3 * i + 1], floats[3 * i + 2]};
  return vectors;
}

std::span<const float> as_floats(std::span<const Vec3f> vectors) {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float), "coordinates are stored as rows of three");
  return {reinterpret_cast<const float*>(vectors.data()), 3 * vectors.size()};
}

PackedFrame pack(const Frame& frame) {
  return {frame.step,
          frame.time,
          checksum(frame),
          pack(as_floats(frame.positions), 3),
          pack(as_floats(frame.velocities), 3),
          pack(std::span(frame.bounds)),
          frame.orientations.empty() ? PackedArray{} : pack(as_floats(frame.orientations), 4),
          packed(frame.residual),
          packed(frame.cut)};
}

std::string frame_bytes(const PackedFrame& frame) {
  Hdf5File file = Hdf5File::create_in_memory(frame_name(frame.step));
  file.set_attribute("/", "format_version", std::array{frame_format_version});
  file.set_attribute("/", "step", std::array{frame.step});
  file.set_attribute("/", "time", frame.time);
  file.set_attribute("/", "crc32", std::array{frame.checksum});
  file.write_packed("positions", frame.positions);
  file.write_packed("velocities", frame.velocities);
  file.write_packed("bounds", frame.bounds);
  if (frame.orientations.rows > 0) file.write_packed("orientations", frame.orientations);
  if (frame.residual.rows > 0) file.write_packed("residual", frame.residual);
  if (frame.cut.rows > 0) file.write_packed("cut", frame.cut);
  return file.image();
}

Frame read_frame(const fs::path& path) { return content(Hdf5File::open(path), path); }

PackedFrame read_packed_frame(const fs::path& path) {
  const Hdf5File file = Hdf5File::open(path);
  const Frame frame = content(file, path);
  return {frame.step,
          frame.time,
          checksum(frame),
          file.read_packed("positions"),
          file.read_packed("velocities"),
          file.read_packed("bounds"),
          frame.orientations.empty() ? PackedArray{} : file.read_packed("orientations"),
          frame.residual.empty() ? PackedArray{} : file.read_packed("residual"),
          frame.cut.empty() ? PackedArray{} : file.read_packed("cut")};
}

}  // namespace ogc::compare
