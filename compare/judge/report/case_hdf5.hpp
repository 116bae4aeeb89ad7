// Stores a case as HDF5. Dataset `case` holds its JSON text. In this text every array of numbers is replaced by the
// name of another dataset ("@float:positions", "@integer:mesh.triangles", "@double:…"). So every bit is kept, and other
// programs can read coordinates and connectivity as arrays.
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace ogc::compare {

/// Writes the file in one operation. Throws ResourceError if the disk does not accept it.
void write_case_hdf5(const std::filesystem::path& path, const nlohmann::ordered_json& json);

/// Reads the file. Throws InputError that names the file and what is missing or wrong.
nlohmann::ordered_json read_case_hdf5(const std::filesystem::path& path);

}  // namespace ogc::compare
