// The data of the paper's drawings (Fig. 2c to e, 3 to 9, 22), computed by the same functions that decide; the plots
// only draw them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ogc::reference {

/// Points with triangles, lines or values. Lengths are in units of the drawing, which has no scale, except metres in
/// Fig. 9 and 22b.
struct DrawingLayer {
  std::string name;                           ///< its subject: "surface", "block", "gauss_map", "arrows of OGC", …
  std::vector<std::array<double, 3>> points;  ///< coordinates
  std::vector<std::array<int, 3>> triangles;  ///< by numbers of points
  std::vector<std::vector<int>> lines;        ///< polylines, by numbers of points
  std::vector<double> values;                 ///< one for each point of a field or curve; otherwise empty
  bool closed = true;                         ///< whether its boundaries belong to a block; open ones are drawn dashed
};

/// One part of a figure, in the order of its caption.
struct DrawingPanel {
  std::string name, caption;         ///< name, such as "a"; the text below the panel
  std::vector<DrawingLayer> layers;  ///< drawn one over the other
};

/// Returns "fig02_models", "fig03", "fig04", "fig05", "fig06", "fig07", "fig08", "fig09", "fig22".
std::span<const std::string_view> illustration_names();

/// Returns the panels of one figure. Throws InputError for a name that is not in the list.
std::vector<DrawingPanel> illustration(std::string_view name);

}  // namespace ogc::reference
