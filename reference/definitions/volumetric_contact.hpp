// §3.9's scheme for volumetric bodies: how deep a point is in the offset geometry of a body, from outside and inside.
#pragma once

#include "reference/definitions/closed_surface.hpp"
#include "reference/definitions/tet_volume.hpp"

namespace ogc::reference {

/// Returns the surface of a body of tetrahedra as a separate mesh, with the body's vertex numbers; triangles are
/// numbered as in `TetVolume::boundary`.
compare::Topology surface_topology(const TetVolume& body, Index vertex_count);

/// One contact of a point with a body.
struct VolumetricContact {
  /// whether depth is by the shortest path to the boundary; otherwise by Eq. 13 in an outward block
  bool inside = false;
  Face face;            ///< boundary triangle at the end of that path, or the face of the block
  double depth = 0;     ///< d_p + r inside, r − d outside [m], within 2 ulp; both are r on the surface
};

/// Returns the contacts of x. Inside: one for each sheet that holds x, by sheet. Only where there is none: one for each
/// outward block that holds x nearer than r, by face. `surface` must be that of `body` (surface_topology). If x is a
/// vertex of the body, `own` is its number: the sheet in which it is itself a vertex, and its own faces, are left out.
std::vector<VolumetricContact> volumetric_contacts(const TetVolume& body, const ClosedSurface& surface, const Vec3f& x,
                                                   float contact_radius, Index own = -1);

}  // namespace ogc::reference
