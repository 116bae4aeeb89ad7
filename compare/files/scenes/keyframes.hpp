// Keyframes of a prescribed motion as one HDF5 file: `time` [frames] in s, `position` [frames · vertices][3] in m,
// single precision.
#pragma once

#include <filesystem>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Throws InputError that names the file and the dataset.
Keyframes read_keyframes(const std::filesystem::path& file);

/// Throws ResourceError where the disk does not take it.
void write_keyframes(const std::filesystem::path& file, const Keyframes& frames);

}  // namespace ogc::compare
