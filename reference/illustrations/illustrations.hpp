// Computes the data of the paper's drawings (Fig. 2c to e, 3 to 9, 22) with the functions that also decide contacts;
// the plots only draw them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ogc::reference {

/// Points with triangles, lines or values. Lengths are in metres in Fig. 9 and 22b; other drawings have no scale.
struct DrawingLayer {
  std::string name;                           ///< subject: "surface", "block", "gauss_map", "arrows of OGC", …
  std::vector<std::array<double, 3>> points;  ///< coordinates
  std::vector<std::array<int, 3>> triangles;  ///< as indices of points
  std::vector<std::vector<int>> lines;        ///< polylines, as indices of points
  std::vector<double> values;                 ///< one for each point of a field or curve; otherwise empty
  bool closed = true;  ///< whether its boundaries belong to the block; open ones are drawn dashed
};

/// One panel of a figure; panels are in the order of the figure's caption.
struct DrawingPanel {
  std::string name, caption;         ///< name, such as "a"; the text below the panel
  std::vector<DrawingLayer> layers;  ///< drawn one over the other
};

/// Returns "fig02_models", "fig03", "fig04", "fig05", "fig06", "fig07", "fig08", "fig09", "fig22".
std::span<const std::string_view> illustration_names();

/// Returns the panels of one figure. Throws InputError for an unknown name.
std::vector<DrawingPanel> illustration(std::string_view name);

}  // namespace ogc::reference
