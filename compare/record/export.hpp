// Exports frames as mesh files, for programs that do not read VTKHDF (ParaView before 5.13, modelling tools).
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace ogc::compare {

enum class ExportFormat { obj, ply, vtp, vtu };  ///< formats of a sequence of meshes

/// Returns the format called "obj", "ply", "vtp" or "vtu". Throws InputError that lists these names.
ExportFormat parse_export_format(std::string_view text);

/// Writes each frame as a mesh `out`/frame_000025.EXT, where the number is that of the frame's step. Creates `out` if
/// it is missing. OBJ and PLY contain positions, triangles and loose edges. VTP (XML PolyData) also contains velocity
/// [m/s], bound [m] and body; VTU (XML UnstructuredGrid) also tetrahedra and their J (compare/record/vtu.hpp). VTP and
/// VTU get an index of the frames' times, `out`/NAME.pvd, where NAME is the scene's. Positions are in the coordinates
/// of the mesh's file (Provenance::origin). Returns all files, the index last. Throws InputError if the run has no
/// frame, ResourceError if the disk fails. `written` is called after each frame with the numbers of frames written and
/// of all.
std::vector<std::filesystem::path> export_run(const std::filesystem::path& folder, ExportFormat format,
                                              const std::filesystem::path& out,
                                              const std::function<void(std::size_t, std::size_t)>& written = {});

}  // namespace ogc::compare
