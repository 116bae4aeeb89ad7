// Declares the groups of laws, one for each file; laws() joins them.
#pragma once

#include <vector>

#include "compare/laws/law.hpp"

namespace ogc::compare {

std::vector<Law> falls();        ///< free flight against the discrete law
std::vector<Law> free_bodies();  ///< momentum and angular momentum without outer forces
std::vector<Law> slopes();       ///< sliding, sticking, stopping
std::vector<Law> rests();        ///< bodies at rest
std::vector<Law> releases();     ///< lifting off and bouncing
std::vector<Law> drags();        ///< bodies that friction holds or drags
std::vector<Law> strips();       ///< hanging strips and bars
std::vector<Law> beams();        ///< clamped beams, and pendulums
std::vector<Law> cords();        ///< rods
std::vector<Law> invariances();  ///< changes that do not change a motion

}  // namespace ogc::compare
