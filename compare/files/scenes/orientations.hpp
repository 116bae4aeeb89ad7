// Reads and writes orientations of a rod's segments: `orientations` [segments × 4] of an HDF5 file, x, y, z, w.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "compare/files/hdf5.hpp"
#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Returns the orientations of an open file; empty if it has none. Does not check that they have length 1. Throws
/// InputError, which calls the file `path`.
std::vector<Quaternion> read_orientations(const Hdf5File& file, const std::string& path);

/// Throws InputError that names the first entry that is no unit quaternion, if there is one.
void require_units(std::span<const Quaternion> orientations, const std::string& path);

/// Reads a file that must have orientations, all unit quaternions. Throws InputError.
std::vector<Quaternion> read_orientations(const std::filesystem::path& file);

/// Writes a file that holds only the orientations. Throws ResourceError.
void write_orientations(const std::filesystem::path& file, std::span<const Quaternion> orientations);

/// Returns the same memory as rows of four numbers.
std::span<const float> as_floats(std::span<const Quaternion> orientations);

}  // namespace ogc::compare
