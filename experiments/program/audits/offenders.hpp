// Cuts out the part of a mesh that an audit reports, for ParaView and plots/offenders.py.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/oracle/audit.hpp"

namespace ogc::experiments {

/// Holds the elements of the listed intersections, ascending, by number in the topology.
struct Offenders {
  std::vector<compare::Index> vertices;   ///< that lie on a triangle
  std::vector<compare::Index> edges;      ///< that meet a triangle, or each other where they belong to none
  std::vector<compare::Index> triangles;  ///< that are met, or that contain one of these edges or vertices
  compare::Intersection first;            ///< the first one in the order of the audit
};

/// Returns the offenders of an audit's listed intersections.
Offenders offenders_of(const compare::AuditResult& result, const compare::Topology& topology);

/// Returns the box of the offenders in words: "between (0.1, 0, 0.2) and (0.3, 0.1, 0.2) m". It contains all corners of
/// the triangles, edges and vertices.
std::string region_of(const Offenders& offenders, const compare::Topology& topology,
                      const std::vector<compare::Vec3>& positions);

/// Returns a .vtp file of the offenders alone. Its point data are the numbers of the corners (`vertex`); its cell data
/// are the number of the edge or triangle (`number`) and the number of listed intersections that name the cell
/// (`intersections`; 0 for the neighbour of a named edge or vertex).
std::string offenders_vtp(const compare::AuditResult& result, const compare::Topology& topology,
                          const std::vector<compare::Vec3>& positions);

/// Writes NAME.vtp to the folder, which it creates if necessary. Returns one line that names the file and the place of
/// the intersections. Throws compare::ResourceError.
std::string show_offenders(const std::filesystem::path& folder, const std::string& name,
                           const compare::AuditResult& result, const compare::Topology& topology,
                           const std::vector<compare::Vec3>& positions);

}  // namespace ogc::experiments
