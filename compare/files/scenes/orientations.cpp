#include "compare/files/scenes/orientations.hpp"

#include "compare/problem/error.hpp"
#include "compare/problem/rods.hpp"

namespace ogc::compare {

std::vector<Quaternion> read_orientations(const Hdf5File& file, const std::string& path) {
  if (!file.has("orientations")) return {};
  const std::vector<std::size_t> shape = file.shape("orientations");
  if (shape.size() != 2 || shape[1] != 4)
    throw InputError(path + ": 'orientations' has not four columns: give [segments][4]");
  const std::vector<float> numbers = file.read<float>("orientations");
  std::vector<Quaternion> orientations(shape[0]);
  for (std::size_t i = 0; i < orientations.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) orientations[i][k] = numbers[4 * i + k];
  return orientations;
}

void require_units(std::span<const Quaternion> orientations, const std::string& path) {
  if (const std::ptrdiff_t wrong = find_no_unit(orientations); wrong >= 0)
    throw InputError(path + ": orientation " + std::to_string(wrong) +
                     " is no unit quaternion: give x, y, z, w whose squares add up to 1");
}

std::vector<Quaternion> read_orientations(const std::filesystem::path& file) {
  const Hdf5File from = Hdf5File::open(file);
  if (!from.has("orientations"))
    throw InputError(file.string() + ": has no 'orientations': give those of each edge, [segments][4]");
  std::vector<Quaternion> orientations = read_orientations(from, file.string());
  require_units(orientations, file.string());
  return orientations;
}

void write_orientations(const std::filesystem::path& file, std::span<const Quaternion> orientations) {
  const std::size_t rows = orientations.size();
  Hdf5File to = Hdf5File::create(file, Hdf5File::largest_size(rows, sizeof(Quaternion), rows));
  to.write("orientations", as_floats(orientations), 4);
  to.close();
}

std::span<const float> as_floats(std::span<const Quaternion> orientations) {
  static_assert(sizeof(Quaternion) == 4 * sizeof(float), "orientations are stored as rows of four");
  return {orientations.empty() ? nullptr : orientations.front().data(), 4 * orientations.size()};
}

}  // namespace ogc::compare
