// Cuts the intersecting part out of an audited mesh, for ParaView and plots/offenders.py.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/oracle/audit.hpp"

namespace ogc::experiments {

/// Holds the elements of the listed intersections, by number in the topology, ascending.
struct Offenders {
  std::vector<compare::Index> vertices;  ///< vertices that lie on a triangle
  std::vector<compare::Index> edges;     ///< edges that meet a triangle, and loose edges that meet each other
  /// triangles that an edge meets or a vertex lies on, and triangles that contain one of these edges or vertices
  std::vector<compare::Index> triangles;
  compare::Intersection first;  ///< first intersection in the audit's order
};

/// Returns the elements of the listed intersections.
Offenders offenders_of(const compare::AuditResult& result, const compare::Topology& topology);

/// Returns the box around all corners of the offenders in words: "between (0.1, 0, 0.2) and (0.3, 0.1, 0.2) m".
std::string region_of(const Offenders& offenders, const compare::Topology& topology,
                      const std::vector<compare::Vec3>& positions);

/// Returns a .vtp file with only the offenders. Point data: the numbers of the corners (`vertex`). Cell data: the
/// number of the edge or triangle (`number`), and how many listed intersections name it (`intersections`; 0 for
/// neighbours of a named edge or vertex).
std::string offenders_vtp(const compare::AuditResult& result, const compare::Topology& topology,
                          const std::vector<compare::Vec3>& positions);

/// Writes NAME.vtp to the folder, which is created if necessary. Returns one line with the file's name and the place of
/// the intersections. Throws compare::ResourceError.
std::string show_offenders(const std::filesystem::path& folder, const std::string& name,
                           const compare::AuditResult& result, const compare::Topology& topology,
                           const std::vector<compare::Vec3>& positions);

}  // namespace ogc::experiments
