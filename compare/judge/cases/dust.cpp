#include "compare/judge/cases/dust.hpp"

#include <cmath>
#include <vector>

#include "compare/judge/cases/legal.hpp"
#include "compare/judge/cases/stage_traits.hpp"

namespace ogc::compare {

void add_dust(Random& random, TestCase& test) {
  const CaseData before = test.data;
  const std::vector<float*> coordinates = traits_of(test.name.stage).coordinates(test.data);
  const int share = 8 << random.below(3);
  const float smallest = std::ldexp(1.0f, -30 - random.below(31));
  for (float* x : coordinates)
    if (random.one_in(share)) *x = std::copysign(random.one_in(4) ? 0.0f : random.pattern(smallest, 0x1p-20f), *x);
  if (!problem_of(test).empty()) test.data = before;
}

}  // namespace ogc::compare
