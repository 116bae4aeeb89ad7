// Finds the exactly nearest face, and all faces that could be nearest within rounding. The distance to a triangle may
// be wrong by doubt(t) (volume_faces.hpp). For each triangle, the stage closest_face gives the faces that may hold the
// triangle's closest point.
//
// If a face F is nearest only because of rounding, F itself does not decide whether x is inside. The exactly nearest
// face decides if it shares a vertex with F and is not a rim. Otherwise the nearest triangle around F decides, because
// the edge of a valley alone would put every point inside. At a rim x is always outside.
#include "reference/definitions/volume_depth.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <tbb/parallel_for.h>

#include "compare/problem/tetrahedra.hpp"
#include "reference/definitions/closed_surface.hpp"
#include "reference/definitions/part_contacts.hpp"
#include "reference/definitions/solid_depth.hpp"
#include "reference/definitions/volume_faces.hpp"

namespace ogc::reference {
namespace {

using compare::at;

using compare::VolumeAnswer;
using compare::VolumePartTruth;

/// Tests one point against one part of triangles.
class TrianglePart : public VolumeFaces {
 public:
  using VolumeFaces::VolumeFaces;

  VolumePartTruth part(const std::vector<Index>& triangles) {
    VolumePartTruth truth;
    const auto [least, candidates] = nearest_of(triangles);
    const Face nearest = exactly_nearest(candidates);
    const bool on_surface = is_on_surface(candidates);
    const bool in_box = in_box_of(mesh_, triangles, x_), faces_in = !begins_outside(mesh_, nearest, x_);
    truth.inside = in_box && faces_in;
    const std::vector<Face> possible = possible_faces(candidates, nearest, least);
    std::vector<Face> outside;  // faces with x on their outer side, each a possible contact
    for (const Face face : possible) {
      const bool holds = in_box && (face == nearest ? faces_in : is_inside(face, nearest, faces_in, candidates));
      // A rim has no inner side. If the nearest face is a rim, another possible face that is no rim may put x inside.
      const bool is_open = in_box && (on_surface || (face != nearest && is_rim(nearest) && !is_rim(face)));
      truth.may_be_inside = truth.may_be_inside || holds || is_open;
      truth.may_be_outside = truth.may_be_outside || !holds || is_open;
      if (holds || is_open) truth.held.push_back(answer(face, true));
      if (!holds || is_open) outside.push_back(face);
    }
    if (truth.may_be_outside) touch(triangles, nearest, faces_in, truth);
    for (const Face face : outside) add_touching(face, truth);
    const MarginAnswer reach = examine(face_gap(mesh_, nearest, x_, radius_));
    truth.needs_contact = reach.sign < 0 && !reach.grey && (in_box || !(faces_in || on_surface));
    near = near || possible.size() > 1 || on_surface || reach.near;
    grey = grey || possible.size() > 1 || on_surface;
    return truth;
  }
};

void set_point(VolumePartTruth& part, Index point) {
  const auto set = [point](std::vector<VolumeAnswer>& answers) {
    for (VolumeAnswer& answer : answers) answer.contact.point = point;
  };
  set(part.held), set(part.touching);
  for (compare::VolumeSheetTruth& sheet : part.sheets) set(sheet.accepted);
}

}  // namespace

compare::VolumeDepthTruth volume_depth(const compare::VolumeDepthIn& in) {
  const Complex mesh{*in.topology, in.positions};
  const std::vector<Index> component = compare::joined_components(*in.topology, in.tetrahedra, in.cavities);
  std::map<Index, std::vector<Index>> parts;  // by number of the part; no edge joins two parts
  for (std::size_t t = 0; t < mesh.topology.triangles.size(); ++t)
    parts[component[at(mesh.topology.triangles[t][0])]].push_back(static_cast<Index>(t));
  const Solid solid(mesh, in.tetrahedra);
  const std::size_t n = in.points.size();
  compare::VolumeDepthTruth truth{std::vector<std::vector<VolumePartTruth>>(n), std::vector<std::uint8_t>(n),
                                  std::vector<std::uint8_t>(n)};
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
    const Index own = in.own.empty() ? -1 : in.own[i];
    TrianglePart of_triangles(mesh, in.points[i], in.contact_radius, own);
    SolidPart of_tetrahedra(of_triangles, solid);
    for (const auto& [component_of_part, triangles] : parts) {
      const bool is_solid = solid.is_boundary(triangles.front());
      VolumePartTruth part = is_solid ? of_tetrahedra.part(triangles) : of_triangles.part(triangles);
      part.component = component_of_part;
      truth.parts[i].push_back(std::move(part));
    }
    for (VolumePartTruth& part : truth.parts[i]) set_point(part, static_cast<Index>(i));
    truth.grey[i] = of_triangles.grey || of_tetrahedra.grey;
    truth.near[i] = of_triangles.near || of_tetrahedra.near;
  });
  return truth;
}

}  // namespace ogc::reference
