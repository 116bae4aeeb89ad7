#include "compare/judge/stages/mesh_case.hpp"

#include <algorithm>

#include "compare/judge/engine/units.hpp"

namespace ogc::compare {

void judge_smallest(const char* what, std::size_t i, float value, float exact, double scale, std::size_t metric,
                    Tally& tally) {
  if (!(value <= exact)) {
    tally.mismatch(std::string(what) + " " + std::to_string(i) + text(": %.9g is above the exact %.9g", value, exact));
    return;
  }
  if (value < 0) {
    tally.mismatch(std::string(what) + " " + std::to_string(i) + text(": %.9g is negative, exact %.9g", value, exact));
    return;
  }
  const double error = double{exact} - value;
  tally.error(metric, in_units(error, scale),
              [&] { return std::string(what) + " " + std::to_string(i) + text(": %.9g, exact %.9g", value, exact); });
}

bool right_length(std::size_t length, std::size_t wanted, const char* what, Tally& tally) {
  if (length == wanted) return true;
  tally.mismatch(std::string(what) + " has " + std::to_string(length) + " entries instead of " +
                 std::to_string(wanted));
  return false;
}

DetectIn detect_question(const MeshCase& c) {
  return {c.topology.get(),
          {c.rigid_groups, c.partners.rows() > 0 ? &c.partners : nullptr},
          c.positions,
          c.contact_radius,
          c.query_radius};
}

MeshCase case_at_start(const Scene& scene) {
  const auto radius = static_cast<float>(scene.settings.contact_radius);
  return {std::make_shared<Topology>(build_topology(scene)),
          rigid_groups(scene),
          to_single(scene.mesh.positions),
          radius,
          static_cast<float>(scene.settings.detection_radius_cap) * radius,
          exclusions(scene).partners};
}

Json mesh_case_to_json(const MeshCase& c) {
  Json json{{"mesh", topology_to_json(*c.topology)},
            {"rigid_groups", c.rigid_groups},
            {"positions", points_to_json(c.positions)},
            {"contact_radius", hexadecimal(c.contact_radius)},
            {"query_radius", hexadecimal(c.query_radius)}};
  if (c.partners.rows() > 0) json["excluded_pairs"] = pairs_of(c.partners);
  return json;
}

namespace {

std::vector<std::array<Index, 2>> to_pairs(const Json& json, std::size_t count) {
  const auto pairs = json.get<std::vector<std::array<Index, 2>>>();
  for (const auto& [a, b] : pairs)
    if (std::min(a, b) < 0 || static_cast<std::size_t>(std::max(a, b)) >= count || a == b)
      throw InputError("excluded_pairs need two vertices each");
  return pairs;
}

}  // namespace

MeshCase to_mesh_case(const Json& data) {
  MeshCase c{to_topology(data.at("mesh"), data.at("positions").size()),
             data.at("rigid_groups").get<std::vector<Index>>(),
             {},
             number(data.at("contact_radius")),
             number(data.at("query_radius"))};
  for (const Json& p : data.at("positions")) c.positions.push_back(to_point(p));
  const auto count = static_cast<std::size_t>(c.topology->vertex_count);
  if (c.positions.size() != count || c.rigid_groups.size() != count)
    throw InputError("positions and rigid_groups need one entry a vertex");
  if (data.contains("excluded_pairs")) c.partners = partner_rows(count, to_pairs(data.at("excluded_pairs"), count));
  return c;
}

}  // namespace ogc::compare
