// The groups of laws, one file each; laws() puts them together.
#pragma once

#include <vector>

#include "compare/laws/law.hpp"

namespace ogc::compare {

std::vector<Law> falls();        ///< free flight against the discrete law
std::vector<Law> free_bodies();  ///< momentum and angular momentum without outer forces
std::vector<Law> slopes();       ///< sliding, sticking, stopping
std::vector<Law> rests();        ///< what lies still
std::vector<Law> releases();     ///< lifting off and bouncing
std::vector<Law> drags();        ///< what friction holds or carries
std::vector<Law> strips();       ///< what hangs
std::vector<Law> beams();        ///< what is clamped, and what swings
std::vector<Law> cords();        ///< rods
std::vector<Law> invariances();  ///< what must not change a motion

}  // namespace ogc::compare
