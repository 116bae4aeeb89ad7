// The part of a mesh that an audit complains about: written for ParaView and plots/offenders.py.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/oracle/audit.hpp"

namespace ogc::experiments {

/// What takes part in the listed intersections, ascending, by number in the topology.
struct Offenders {
  std::vector<compare::Index> vertices;   ///< that lie on a triangle
  std::vector<compare::Index> edges;      ///< that meet a triangle or, of no triangle, each other
  std::vector<compare::Index> triangles;  ///< that are met, or that contain such an edge or vertex
  compare::Intersection first;            ///< in the order of the audit
};

/// The offenders of an audit's listed intersections.
Offenders offenders_of(const compare::AuditResult& result, const compare::Topology& topology);

/// Where the offenders are, in words: "between (0.1, 0, 0.2) and (0.3, 0.1, 0.2) m". It holds all corners of the
/// triangles, edges and vertices.
std::string region_of(const Offenders& offenders, const compare::Topology& topology,
                      const std::vector<compare::Vec3>& positions);

/// A .vtp file of the offenders alone, with the corners' numbers (point data `vertex`), and of each cell its number as
/// edge or triangle (`number`) and how many of the listed intersections it is named in (`intersections`; 0: it is the
/// neighbour of an edge or vertex that is).
std::string offenders_vtp(const compare::AuditResult& result, const compare::Topology& topology,
                          const std::vector<compare::Vec3>& positions);

/// Writes NAME.vtp to the folder, which is made where it is missing; returns one line that names the file and says
/// where the intersections are. Throws compare::ResourceError.
std::string show_offenders(const std::filesystem::path& folder, const std::string& name,
                           const compare::AuditResult& result, const compare::Topology& topology,
                           const std::vector<compare::Vec3>& positions);

}  // namespace ogc::experiments
