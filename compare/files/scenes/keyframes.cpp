#include "compare/files/scenes/keyframes.hpp"

#include "compare/files/hdf5.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {

namespace {

static_assert(sizeof(Vec3f) == 3 * sizeof(float), "positions are read and written as rows of three floats");

}  // namespace

Keyframes read_keyframes(const std::filesystem::path& file) {
  const Hdf5File from = Hdf5File::open(file);
  for (const char* name : {"time", "position"})
    if (!from.has(name))
      throw InputError(file.string() + ": has no '" + name +
                       "': keyframes are time [frames] and position [frames · vertices][3]");
  const std::vector<std::size_t> shape = from.shape("position");
  if (shape.size() != 2 || shape[1] != 3)
    throw InputError(file.string() + ": 'position' has not three columns: give [frames · vertices][3]");
  Keyframes frames;
  frames.times = from.read<double>("time");
  const std::vector<float> numbers = from.read<float>("position");
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    frames.positions.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return frames;
}

void write_keyframes(const std::filesystem::path& file, const Keyframes& frames) {
  const std::size_t rows = frames.positions.size(), part = rows / frames.times.size();
  Hdf5File to = Hdf5File::create(file, Hdf5File::largest_size(rows, sizeof(Vec3f), part) +
                                           Hdf5File::largest_size(frames.times.size(), sizeof(double), 1));
  to.write<double>("time", frames.times);
  to.create_dataset<float>("position", rows, 3, part);
  to.write_rows<float>("position", 0, {&frames.positions.front().x, 3 * rows});
  to.close();
}

}  // namespace ogc::compare
