// Lists the figures; other files compute them.
#include "reference/illustrations/illustrations.hpp"

#include <algorithm>
#include <iterator>

#include "compare/problem/error.hpp"
#include "reference/illustrations/illustration_parts.hpp"

namespace ogc::reference {
namespace {

std::vector<DrawingPanel> limitations() {
  std::vector<DrawingPanel> panels = force_along_a_path(), falling = falling_triangles();
  std::move(falling.begin(), falling.end(), std::back_inserter(panels));
  return panels;
}

constexpr std::array<std::string_view, 9> names{"fig02_models", "fig03", "fig04", "fig05", "fig06",
                                                "fig07",        "fig08", "fig09", "fig22"};
constexpr std::array<std::vector<DrawingPanel> (*)(), names.size()> makers{
    contact_models, contact_face_sets, offset_geometries, vertex_kinds, face_normals,
    surface_blocks, edge_only_blocks,  one_iteration,     limitations};

}  // namespace

std::span<const std::string_view> illustration_names() { return names; }

std::vector<DrawingPanel> illustration(std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return makers[static_cast<std::size_t>(found - names.begin())]();
  std::string known;
  for (const std::string_view one : names) known += " " + std::string(one);
  throw compare::InputError("there is no illustration '" + std::string(name) + "'; there are:" + known);
}

}  // namespace ogc::reference
