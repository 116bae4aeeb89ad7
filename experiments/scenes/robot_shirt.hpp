// Fig. 14: two parallel-jaw grippers lift a T-shirt off a table by its shoulders, shake it, fold it and let it go.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes in cells of the shirt's grid; defaults: the paper's number of vertices and triangles. The contact
/// radius follows the spacing, `across` cells on 0.45 m.
struct RobotShirtSizes {
  compare::Index across = 56, length = 105;              ///< of front and back; `across` even
  compare::Index sleeve_rows = 20, sleeve_columns = 26;  ///< of each sleeve: its width when laid flat, and its length
  compare::Index neck_columns = 10;                      ///< half of the neck's width
  compare::Index front_neck = 8, back_neck = 2;          ///< depth of the neck in the middle
  /// 6 s of 1/600 s; a coarser shirt has longer steps, because its radius is larger
  std::int64_t steps = 3600;
};

/// Returns the scene. The shirt lies flat on a fixed table at y = 0, shoulders along the x axis, hem towards −z: back
/// and front 1.05 r apart, at rest in its rest shape (an ironed crease where they meet). Front and back are two panels,
/// stitched along the shoulders and joined along sides and sleeves: the paper's counts, 2 · 13.8K − 27.4K = 200 ± 150,
/// are its boundary edges and twice the Euler characteristic, and even one open sheet of 27.4K triangles would have
/// 470.
///
/// The table ends 6 cm before the shoulders, under which the lower jaws are at y = 0. Jaws are closed boxes; each
/// gripper is one motion with keyframes 1/60 s apart: approach and pinch (0.5 s) to 2.2 r, which presses the two layers
/// between the jaws, because each is r from its neighbours at rest; lift; shake; back, lay down, fold over; open and
/// withdraw (6 s). While they hold the shirt, jaws move no faster than 0.35 m/s, 0.3 r a step. Jaws are volumes with
/// the paper's γ_e = 0.01, the table is a surface. As surfaces (`--set body_contact=surface`) jaws obey bounds, up to
/// γ_p r_q = 3.6 mm in one detection, but a jaw that carries cloth has it at a distance below r, and both move by less
/// than half of that: with a lift at 1 m/s and γ_e = 0.01 the few vertices between jaws and shirt trigger no detection,
/// distances fall below what single precision can move by, and the lower jaws stay behind for good (by 0.83 m at paper
/// scale). So one cut vertex then triggers a detection (γ_e = 0) [D], as in `dress`. The material is that of
/// `fifty_layers`, with Table 1's friction. Stitches of 100 N/m open by 0.2 mm, a tenth of r, where a seam carries 2.6
/// N/m, half of the shirt's weight on each shoulder's 0.3 m [D]. The whole trajectory is decided here.
compare::Scene robot_shirt(const RobotShirtSizes& sizes = {});

}  // namespace ogc::experiments
