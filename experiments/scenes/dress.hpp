// Fig. 13: a dress of 14 panels, stitched together, on a moving body. With Codimensional IPC's data set it is theirs;
// otherwise a generated stand-in.
#pragma once

#include "compare/problem/scene.hpp"
#include "experiments/scenes/dress_data.hpp"

namespace ogc::experiments {

/// Holds the numbers of cells of the stand-in's panels, [along the body, around a panel]; defaults: about the data
/// set's size. The contact radius follows the spacing.
struct DressSizes {
  std::array<compare::Index, 2> bodice{40, 30}, hips{28, 37}, hem{26, 48};  ///< cells
  compare::Index strap = 50;                                                ///< cells along a strap
  double body_spacing = 0.01487;                                            ///< edge length of the body [m]
  std::int64_t steps = 968;                                                 ///< 4.84 s
};

/// Returns the stand-in: bodice (cylinder), hips and hem (cones), four panels each, and two straps over the shoulders
/// (half cones), on a mannequin of capsules that walks (experiments/scenes/mannequin.hpp). At the start only stitched
/// primitives intersect, and the dress is 1.5 r away from torso and pelvis. The pelvis carries it: a skirt without such
/// hips hangs from its straps, stretches to the knees, and their hollows pinch it. All panels start at rest in their
/// rest shape except the straps, which lie on a ball instead of a cone (2.2 %). y is up; bodies: the panels, then the
/// body.
///
/// Material: wool with 5 % lycra, 543.29 kg/m³ and 0.328 mm, ν 0.071, of Penava et al. (2014) as in Codimensional IPC's
/// scripts. These give E = 76 kPa, and use 0.01 of that, 760 Pa, for garments, because there strain limiting (at 1.134)
/// carries the load. We have no strain limiting. With 760 Pa, E·t = 0.25 N/m: the 0.08 kg below a waist of 0.7 m pull
/// with 1.1 N/m and stretch it to five times its length. With the fabric's own 76 kPa, which the scripts note as right
/// without strain limiting, E·t = 24.9 N/m and the same place stretches by 4.5 %: so E is 100 times the garment
/// script's [D]. Bending as in that script, 0.1 of 76 kPa: k_b = 0.1 · 76 kPa t³/(12 (1 − ν²)) = 2.25e-8 J. Damping as
/// in `fifty_layers` [D].
///
/// The body is a volume with the paper's γ_e = 0.01: it stands where its animation places it, and pushes out the
/// vertices inside it. As a surface (`--set body_contact=surface`) it obeys bounds, and one cut vertex triggers a
/// detection (γ_e = 0) [D]: with 0.01 the few vertices between it and the cloth are too few to trigger one; distances
/// fall to 10 nm, nothing moves there any more, and the body lags: by 0.21 m after 200 steps at scale small. With γ_e =
/// 0 nothing lags there in all 968 steps, and distances stay above 0.45 r.
///
/// Stitches have 1000 N/m, the scripts' `k_stitch`: a seam that carries 3 N/m (12 % of strain, more than all but the
/// worst percent of the published start), with a stitch every 7.5 mm, opens by 22 µm, a hundredth of r.
compare::Scene dress(const DressSizes& sizes = {});

/// Returns the scene of the data set: each panel becomes a body with its own numbering, the character is the last body,
/// and keyframes 0.04 s apart prescribe all of it; it is at rest from 4.80 s on.
compare::Scene dress(const DressData& data, std::int64_t steps = 968);

}  // namespace ogc::experiments
