// Stage spring: the energy of one spring (method.md §4.8, §4.9).
#pragma once

#include "compare/stages/spring.hpp"
#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// k_s/2 (l − l₀)² over any number type.
template <class T, class Number>
T spring_energy(const T& length, const Number& stiffness, const T& rest_length) {
  return Number(0.5) * stiffness * (length - rest_length) * (length - rest_length);
}

compare::ForceAnswer spring(const compare::SpringCase& question);

/// All cases, in parallel over them.
compare::ForceTruth spring(const compare::SpringIn& in);

}  // namespace ogc::reference
