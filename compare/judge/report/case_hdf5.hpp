// Stores a case as HDF5. Dataset `case` holds its JSON text, in which the name of a dataset beside it replaces every
// array of numbers ("@float:positions", "@integer:mesh.triangles", "@double:…"), so that other programs read
// coordinates and connectivity as arrays, and every bit comes back.
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace ogc::compare {

/// Writes the file at once. Throws ResourceError where the disk does not take it.
void write_case_hdf5(const std::filesystem::path& path, const nlohmann::ordered_json& json);

/// Reads the file back. Throws InputError that names the file and what is missing or wrong.
nlohmann::ordered_json read_case_hdf5(const std::filesystem::path& path);

}  // namespace ogc::compare
