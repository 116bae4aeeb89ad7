// Saves cases as files, with a mesh and a picture. Files keep every bit even if generators change.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// Version of saved cases. A file of another version is refused with its version named.
inline constexpr int case_format_version = 3;

/// Returns the case with its problem string and message. Numbers of single precision are hexadecimal text.
nlohmann::ordered_json case_to_json(const TestCase& test, const std::string& message);

/// Writes folder/STAGE.GENERATOR.SEED.INDEX.h5 (compare/judge/report/case_hdf5.hpp). If the case has coordinates, also
/// writes a mesh (.obj, by print_shape_obj) and a picture (.svg). Returns the path of the HDF5 file. Throws
/// ResourceError if the disk does not accept it.
std::filesystem::path save_case(const std::filesystem::path& folder, const TestCase& test, const std::string& message);

/// Reads a saved case, or a case written by hand as JSON (.json, in the format of case_to_json). Throws InputError that
/// names the file and the key that is missing or wrong.
TestCase load_case(const std::filesystem::path& file);

/// Reads a batch file with one problem string per line. Empty lines and lines that begin with # are skipped. Throws
/// InputError that names file and line.
std::vector<CaseName> load_batch(const std::filesystem::path& file);

}  // namespace ogc::compare
