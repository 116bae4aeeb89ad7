// Fig. 14: two grippers with parallel jaws lift a T-shirt off a table by its shoulders, shake it, fold it and let it
// go.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes in cells of the shirt's grid; the defaults give the paper's number of vertices and triangles. The
/// width of `across` cells is 0.45 m. The contact radius is proportional to the spacing.
struct RobotShirtSizes {
  compare::Index across = 56, length = 105;              ///< cells of front and back; `across` is even
  compare::Index sleeve_rows = 20, sleeve_columns = 26;  ///< width of a flat sleeve, and its length
  compare::Index neck_columns = 10;                      ///< half of the width of the neck
  compare::Index front_neck = 8, back_neck = 2;          ///< depth of the neck in its middle
  /// 6 s in steps of 1/600 s; a coarser shirt has longer steps, because its radius is larger
  std::int64_t steps = 3600;
};

/// Returns the scene. The shirt lies flat on a fixed table at y = 0, with the shoulders along the x axis and the hem
/// towards −z. Back and front are 1.05 r apart and start in their rest shape, with an ironed crease where they meet.
/// They are two panels, stitched along the shoulders and joined along sides and sleeves. The paper's counts show that
/// its shirt has this topology. The number of boundary edges plus twice the Euler characteristic is 2 · 13.8K − 27.4K =
/// 200 ± 150; a single open sheet of 27.4K triangles would have 470.
///
/// The table ends 6 cm before the shoulders; the lower jaws start under the shoulders at y = 0. Jaws are closed boxes.
/// Each gripper is one motion with keyframes 1/60 s apart: approach and pinch (0.5 s), lift, shake, move back, lay
/// down, fold over, open and withdraw (6 s). The pinch narrows the jaws to 2.2 r, which presses the two layers, because
/// at rest each layer is r away from its neighbours. While they hold the shirt, jaws move at most at 0.35 m/s, 0.3 r
/// per step. Jaws are volumes with the paper's γ_e = 0.01; the table is a surface.
/// As surfaces (`--set body_contact=surface`) jaws obey bounds: a jaw moves at most γ_p r_q = 3.6 mm per detection.
/// Cloth that a jaw lifts is closer than r, so jaw and cloth each move less than r/2. With a lift at 1 m/s and γ_e =
/// 0.01 the few vertices between jaws and shirt trigger no detection. Their distances then fall below the spacing of
/// single precision. The lower jaws never catch up; they lag by 0.83 m at paper scale. So one cut vertex triggers a
/// detection (γ_e = 0, our choice), as in `dress`.
///
/// The material is that of `fifty_layers`, with Table 1's friction. Stitches have 100 N/m: where a seam bears 2.6 N/m,
/// half of the weight on a shoulder of 0.3 m, they open by 0.2 mm, a tenth of r. This stiffness and the whole
/// trajectory are our choice.
compare::Scene robot_shirt(const RobotShirtSizes& sizes = {});

}  // namespace ogc::experiments
