// Reads and writes keyframes of a prescribed motion as one HDF5 file: `time` [frames] in s, `position` [frames ·
// vertices][3] in m, single precision.
#pragma once

#include <filesystem>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Reads a file. Throws InputError that names the file and the dataset.
Keyframes read_keyframes(const std::filesystem::path& file);

/// Writes a file. Throws ResourceError if the disk fails.
void write_keyframes(const std::filesystem::path& file, const Keyframes& frames);

}  // namespace ogc::compare
