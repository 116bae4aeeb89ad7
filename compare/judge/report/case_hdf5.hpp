// A case as HDF5: dataset `case` holds its JSON text, in which every array of numbers is replaced by the name of a
// dataset beside it ("@float:positions", "@integer:mesh.triangles", "@double:…"), so that other programs read
// coordinates and connectivity as arrays, and every bit comes back.
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace ogc::compare {

/// Writes the file at once. Throws ResourceError where the disk does not take it.
void write_case_hdf5(const std::filesystem::path& path, const nlohmann::ordered_json& json);

/// Reads it back. Throws InputError that names the file and what is missing or wrong.
nlohmann::ordered_json read_case_hdf5(const std::filesystem::path& path);

}  // namespace ogc::compare
