#include "compare/judge/cases/legal.hpp"

#include <algorithm>
#include <cstdio>

#include "compare/judge/cases/rest_cases.hpp"
#include "compare/judge/cases/stage_traits.hpp"

namespace ogc::compare {

std::string problem_of(const TestCase& test) {
  FirstProblem problem;
  traits_of(test.name.stage).check(test.data, problem);
  return problem.text();
}

void FirstProblem::say(const char* what, float value) {
  char buffer[128];
  std::snprintf(buffer, sizeof buffer, "%s of %.9g is out of range", what, value);
  require(false, buffer);
}

void check_lengths(FirstProblem& problem, std::span<const Vec3f> points, float least, float least_longest) {
  float longest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3f &p = points[i], &q = points[j];
      const auto length = static_cast<float>(std::hypot(double{p.x} - q.x, double{p.y} - q.y, double{p.z} - q.z));
      if (length > 0) problem.number("a length", length, least, 0x1p22f);
      longest = std::max(longest, length);
    }
  if (longest > 0) problem.number("the longest length", longest, least_longest, 0x1p22f);
}

void check_scene(FirstProblem& problem, const Scene& scene) {
  auto at_rest = std::make_shared<Scene>(scene);
  at_rest->mesh.positions = at_rest->rest_positions;
  auto topology = std::make_shared<const Topology>(build_topology(*at_rest));
  const std::string why = problems_of(RestStateCase{std::move(at_rest), std::move(topology)});
  problem.require(why.empty(), why.c_str());
}

}  // namespace ogc::compare
