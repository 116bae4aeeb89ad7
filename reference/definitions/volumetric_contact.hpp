// Computes how deep a point is in the offset geometry of a volumetric body (§3.9), from outside and inside.
#pragma once

#include "reference/definitions/closed_surface.hpp"
#include "reference/definitions/tet_volume.hpp"

namespace ogc::reference {

/// Returns the surface of a body of tetrahedra as a separate mesh, with the vertex indices of the body. Triangles have
/// the order of `TetVolume::boundary`.
compare::Topology surface_topology(const TetVolume& body, Index vertex_count);

/// One contact of a point with a body.
struct VolumetricContact {
  /// whether `depth` comes from the shortest path to the boundary; otherwise from Eq. 13 in an outward block
  bool inside = false;
  Face face;         ///< inside: the boundary triangle at the end of the path; otherwise the face of the block
  double depth = 0;  ///< d_p + r inside, r − d outside [m], within 2 ulp; both are r on the surface
};

/// Returns the contacts of x. If sheets hold x, there is one contact for each sheet, in the order of sheets. Otherwise
/// there is one for each outward block that holds x nearer than r, in the order of faces. `surface` must be
/// surface_topology of `body`. If x is a vertex of the body, `own` is its index; the sheet and the faces of this vertex
/// are then left out.
std::vector<VolumetricContact> volumetric_contacts(const TetVolume& body, const ClosedSurface& surface, const Vec3f& x,
                                                   float contact_radius, Index own = -1);

}  // namespace ogc::reference
