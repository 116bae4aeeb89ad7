// A picture of intersections: the whole mesh on the left, the first of them near by on the right. A small renderer of
// our own, since a picture must come wherever `ogc` runs, without a display, a GPU or Python: orthographic, a depth
// buffer, no perspective that would hide how things lie.
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/program/audits/offenders.hpp"
#include "experiments/program/audits/png.hpp"

namespace ogc::experiments {

/// Offending triangles are vermilion, edges that meet a triangle blue, both seen faintly through what is in front; the
/// rest is grey. The direction of view is the one of 26 (axes and diagonals) from which most of the offending triangles
/// is seen unhidden; the box of the close-up is drawn on the left.
Image picture_of(const Offenders& offenders, const compare::Topology& topology,
                 const std::vector<compare::Vec3>& positions);

}  // namespace ogc::experiments
