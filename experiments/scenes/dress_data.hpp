// Reads Codimensional IPC's dress, as published (github.com/ipc-sim/Codim-IPC, Projects/FEMShell/input; its data are
// not part of this repository).
#pragma once

#include <filesystem>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Stitches vertex `first` to the point (1 − ratio) x_second + ratio x_third.
struct Stitch {
  compare::Index first = -1, second = -1, third = -1;  ///< vertices of the garment
  double ratio = 0;                                    ///< from 0 to 1
};

/// Holds the counts that the files must have, so that a truncated file is refused; defaults: the published counts.
struct DressCounts {
  std::size_t vertices = 15656, triangles = 29456, panels = 14, stitches = 851;  ///< counts of the garment
  std::size_t body_vertices = 12811, body_triangles = 25472, frames = 121;  ///< counts of the body; number of frames
};

/// Holds the data set.
struct DressData {
  std::vector<std::array<double, 2>> pattern;     ///< rest shape by vertex [m]
  compare::Mesh garment;                          ///< at the start [m]
  std::vector<compare::Index> panel_of_triangle;  ///< panel of each triangle, from 0
  std::vector<Stitch> stitches;                   ///< stitches of the garment
  compare::Mesh body;                             ///< at the start [m]
  /// the body's vertices in each frame [m], translated so that frame 0 is at the positions of `body`
  std::vector<std::vector<compare::Vec3>> motion;
};

/// Reads the data set from `folder` or its subfolders dress_knife and Rumba_Dancing. stage.obj has the pattern (`vt`),
/// the panels and the stitches. drape.obj has the garment and the body at the start. The files shell0.obj, shell1.obj,
/// … have the body every 0.04 s. Throws compare::InputError that names a file that is missing or unreadable, differs
/// from `counts`, or stitches a vertex that does not exist. Also throws if the body of the first frame differs in shape
/// from the body at the start.
DressData read_dress_data(const std::filesystem::path& folder, const DressCounts& counts = {});

}  // namespace ogc::experiments
