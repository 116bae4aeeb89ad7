// Orientations of a rod's segments as files hold them: `orientations` [segments × 4] of an HDF5 file, x, y, z, w.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "compare/files/hdf5.hpp"
#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Of an open file, which messages call `path`; none where it has none. Any numbers. Throws InputError.
std::vector<Quaternion> read_orientations(const Hdf5File& file, const std::string& path);

/// Throws InputError that names the first entry that is no unit quaternion, if there is one.
void require_units(std::span<const Quaternion> orientations, const std::string& path);

/// Of a file that must have some, unit quaternions all of them. Throws InputError.
std::vector<Quaternion> read_orientations(const std::filesystem::path& file);

/// A file with nothing else. Throws ResourceError.
void write_orientations(const std::filesystem::path& file, std::span<const Quaternion> orientations);

/// The same memory as rows of four numbers.
std::span<const float> as_floats(std::span<const Quaternion> orientations);

}  // namespace ogc::compare
