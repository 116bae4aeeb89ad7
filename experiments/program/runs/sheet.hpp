// Writes what the viewer shows as a *sheet*, a folder that plots/sheets.py reads: sheet.json, triangles and edges
// (int32), and the positions of all frames (float32). The sheet of a run names the run's folder in place of positions,
// because the viewer reads frames by itself, also those of a run that still goes on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/program/audits/audit_source.hpp"

namespace ogc::experiments {

/// Selects what is shown.
struct SheetRequest {
  AuditRequest source;     ///< a run, a scene's name or file, or meshes and frames as `ogc audit` reads them
  std::string scale;       ///< of a built-in scene; empty: small
  double radius = 0;       ///< contact radius of meshes [m]; 0: a quarter of their median edge
  std::int64_t every = 1;  ///< of the frames of meshes each of this distance is written
};

/// Writes the sheet of a run that goes on or ended.
void write_run_sheet(const std::filesystem::path& sheet, const std::filesystem::path& folder,
                     const compare::Mesh& mesh);

/// Writes the sheet. Throws compare::InputError that names what can't be read, and if the faces of frames change.
void write_sheet(const std::filesystem::path& sheet, const SheetRequest& request);

}  // namespace ogc::experiments
