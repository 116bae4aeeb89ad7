// Holds parameters that several stages have, with the ranges of their contracts.
#pragma once

#include "compare/judge/cases/parameters.hpp"

namespace ogc::compare::ranges {

/// `least` and `most` limit lengths and times, `vast` limits stiffnesses and bounds.
inline constexpr float least = 0x1p-20f, most = 0x1p20f, vast = 0x1p40f;

/// The parameters with their names in problem strings.
inline constexpr ParameterInfo contact_radius{"r", "contact radius [m]", least, most},
    query_radius{"r_q", "query radius [m], at least r", least, most},
    contact_stiffness{"k_c", "contact stiffness [N/m]", 0x1p-30f, vast}, time_step{"h", "time step [s]", least, 1},
    bound{"b", "bound [m]", 0, vast},
    bounds_relaxation{"gamma_p", "bound relaxation, Eq. 21", 0x1p-10f, 0.5f - 0x1p-10f},
    friction{"mu", "friction coefficient", 0, 0x1p10f}, damping{"k", "damping k_d/h", 0, most};

/// Returns why these radii are illegal together; empty if they are legal.
inline std::string check_radii(float r, float r_q) {
  return r > r_q ? "the contact radius is above the query radius; give r_q too, at least as large as r" : "";
}

/// Returns the scene with these parameters; material parameters change in each body. Names that a scene lacks change
/// nothing.
std::shared_ptr<const Scene> with_parameters(const Scene& scene, std::span<const Override> values);

}  // namespace ogc::compare::ranges
