// What a legal question is (compare/stages), in one place: generators, states of runs and shrunk cases are held to it.
#pragma once

#include <string>

#include "compare/judge/cases.hpp"

namespace ogc::compare {

/// Of coordinates [m], velocities [m/s] and accelerations [m/s²]: the largest modulus. Scenes end at 2²⁰; generators go
/// beyond, so that no stage relies on it. There is no smallest one (method.md §2.4).
inline constexpr float most_coordinate = 0x1p30f;

/// What makes the question illegal, with the number at fault; empty where nothing does.
std::string problem_of(const CaseData& data);

}  // namespace ogc::compare
