// Keeps cases as files: every bit comes back whatever becomes of the generators, and there is a mesh and a picture to
// look at.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// Version of saved cases; a file of another version is refused, with its version named.
inline constexpr int case_format_version = 3;

/// Writes the case with its problem string and message, numbers of single precision as hexadecimal text.
nlohmann::ordered_json case_to_json(const TestCase& test, const std::string& message);

/// Writes folder/STAGE.GENERATOR.SEED.INDEX.h5 (compare/judge/report/case_hdf5.hpp) and, where the case has
/// coordinates, beside it a mesh (.obj, as print_shape_obj makes it) and a picture (.svg). Returns the path of the HDF5
/// file. Throws ResourceError where the disk does not take it.
std::filesystem::path save_case(const std::filesystem::path& folder, const TestCase& test, const std::string& message);

/// Reads a saved case, or one written by hand as JSON (.json, as case_to_json gives it). Throws InputError that names
/// the file and the key that is missing or wrong.
TestCase load_case(const std::filesystem::path& file);

/// Reads a batch file: one problem string a line; empty lines and lines that begin with # are skipped. Throws
/// InputError that names file and line.
std::vector<CaseName> load_batch(const std::filesystem::path& file);

}  // namespace ogc::compare
