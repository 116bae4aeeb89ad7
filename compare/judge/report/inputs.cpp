#include "compare/judge/report/inputs.hpp"

#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/report/quantities.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/names.hpp"

namespace ogc::compare {

std::vector<Quantity> inputs_of(const TestCase& test) { return traits_of(test.name.stage).inputs(test.data); }

std::vector<Quantity> mesh_quantities(const Topology& topology) {
  std::vector<Quantity> all;
  all.push_back(count("vertices", static_cast<std::size_t>(topology.vertex_count)));
  all.push_back(indices("triangles", topology.triangles));
  std::vector<Edge> loose;
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    if (topology.edge_triangles[e].empty()) loose.push_back(topology.edges[e]);
  if (!loose.empty()) all.push_back(indices("loose_edges", loose));
  return all;
}

std::vector<Quantity> state_quantities(const Topology& topology, const std::vector<Vec3f>& positions,
                                       const std::vector<Index>& rigid_groups, const CompressedRows& partners) {
  std::vector<Quantity> all = joined(mesh_quantities(topology), std::vector{points("positions", "m", positions),
                                                                            indices("rigid_groups", rigid_groups)});
  if (partners.rows() > 0) all.push_back(indices("excluded_pairs", pairs_of(partners)));
  return all;
}

std::vector<Quantity> scene_quantities(const Scene& scene) {
  std::vector<Quantity> all;
  for (const SettingInfo& info : setting_table()) {
    if (info.name.starts_with("newton") || info.name.starts_with("ipc")) continue;  // no stage reads these
    const bool is_choice = !info.choices.empty();
    all.push_back(is_choice
                      ? word(std::string(info.name), setting_text(scene.settings, info))
                      : scalar(std::string(info.name), std::string(info.unit), get_setting(scene.settings, info)));
  }
  all.push_back(points("gravity", "m/s²", std::array{scene.gravity}));
  for (const Body& body : scene.bodies) {
    const std::string of = body.name + ".";
    all.push_back(word(of + "vertices", std::to_string(body.first_vertex) + " to " +
                                            std::to_string(body.first_vertex + body.vertex_count - 1)));
    all.push_back(word(of + "membrane", std::string(name_of(body.material.membrane))));
    all.push_back(word(of + "bending", std::string(name_of(body.material.bending))));
    for (const MaterialInfo& info : material_table())
      all.push_back(scalar(of + std::string(info.name), std::string(info.unit), body.material.*info.field));
  }
  return all;
}

}  // namespace ogc::compare
