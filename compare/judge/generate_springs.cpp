// Cases of spring. Ladders lead to the rest length, to length 0, to a rest length of 0, and to a motion across the
// spring, which damping does not see; seams, to those between a vertex and a point of an edge, with the point at its
// ends too, and closed.
#include <array>
#include <cmath>

#include "compare/judge/generators.hpp"
#include "compare/judge/placement.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

CaseData with_material(Random& random, SpringCase question, double rest_length) {
  question.stiffness = static_cast<float>(random.magnitude(-2, 5));
  question.rest_length = static_cast<float>(rest_length);
  question.damping = random.one_in(2) ? 0 : static_cast<float>(random.magnitude(-3, 1));
  if (random.one_in(4)) question.damping_form = DampingForm::per_vertex;
  return question;
}

/// Along x, of that length, after it was `before` long.
CaseData spring_case(Random& random, double length, double before, double rest_length, bool turned = true) {
  std::array<Vec3, 4> points{Vec3{}, Vec3{length, 0, 0}, Vec3{}, Vec3{before, 0, 0}};
  if (random.one_in(2)) points[3] = sum(points[3], scaled(in_box(random, -1, 1), 0.1 * before));
  const Vec3 common = random.one_in(2) ? Vec3{} : scaled(in_box(random, -1, 1), random.magnitude(-4, 0));
  for (std::size_t k = 2; k < 4; ++k) points[k] = sum(points[k], common);
  permute(random, points);
  if (turned) rotate(random, points);
  SpringCase question;
  for (std::size_t k = 0; k < 2; ++k) {
    question.vertex[k] = single(points[k]);
    question.start[k] = single(points[2 + k]);
  }
  return with_material(random, question, rest_length);
}

/// An edge along y whose point at `ratio` is the origin, and a vertex at `length` from there.
CaseData seam_case(Random& random, double edge, double ratio, double length, double before, double rest_length,
                   bool turned) {
  std::array<Vec3, 6> points{Vec3{length, 0, 0}, Vec3{0, -ratio * edge, 0}, Vec3{0, (1 - ratio) * edge, 0}, {}, {}, {}};
  for (std::size_t k = 0; k < 3; ++k) points[3 + k] = points[k];
  points[3].x = before;
  if (random.one_in(2)) points[4] = sum(points[4], scaled(in_box(random, -1, 1), 0.1 * edge));
  permute(random, points);
  if (turned) rotate(random, points);
  SpringCase question;
  for (std::size_t k = 0; k < 3; ++k) {
    question.vertex[k] = single(points[k]);
    question.start[k] = single(points[3 + k]);
  }
  question.ratio = static_cast<float>(ratio);
  question.own = random.below(question.ratio > 0 ? 3 : 2);
  return with_material(random, question, rest_length);
}

double some_length(Random& random) { return random.magnitude(-3, 0); }

/// Stretched or pressed.
CaseData uniform(Random& random) {
  const double length = some_length(random);
  return spring_case(random, length, length * random.between(0.5, 2), length * random.magnitude(-0.7, 0.7));
}

/// Lengths without a rounding.
CaseData lattice(Random& random) {
  const double size = std::ldexp(1.0, random.below(9) - 8);
  return spring_case(random, size * random.below(5), size * random.below(5), size * random.below(5), false);
}

/// Coordinates and material of any bits.
CaseData bits(Random& random) {
  const std::array<Vec3, 4> points = points_of_bits(random);
  SpringCase question;
  question.vertex = {single(points[0]), single(points[1])};
  question.start = {single(points[2]), single(points[3])};
  question.stiffness = random.pattern();
  question.rest_length = random.pattern();
  question.damping = random.one_in(2) ? 0 : static_cast<float>(random.magnitude(-3, 1));
  return question;
}

/// l → l₀, where the force vanishes and the block's part across the spring sets in; lᵗ → l.
CaseData at_rest(Random& random) {
  const double length = some_length(random);
  return spring_case(random, length, length * (1 + random.rung()), length * (1 + random.rung()));
}

/// l → 0.
CaseData at_zero(Random& random) {
  const double size = some_length(random);
  return spring_case(random, size * random.rung(), random.one_in(2) ? size : size * random.rung(), size,
                     random.one_in(2));
}

/// Stitches: l₀ = 0.
CaseData stitch(Random& random) {
  const double size = some_length(random);
  return spring_case(random, size * random.rung(), size * random.rung(), 0);
}

/// Of any shape, open or nearly closed.
CaseData seam(Random& random) {
  const double edge = some_length(random),
               length = edge * (random.one_in(2) ? random.magnitude(-1, 0.5) : std::abs(random.rung()));
  return seam_case(random, edge, random.unit(), length, length * random.between(0.5, 2),
                   random.one_in(2) ? 0 : length * random.magnitude(-0.5, 0.5), true);
}

/// The point at an end of the edge or in its middle, without a rounding, closed or not.
CaseData seam_lattice(Random& random) {
  const double edge = std::ldexp(1.0, random.below(9) - 8);
  const double ratio = 0.25 * random.below(5);
  return seam_case(random, edge, ratio, edge * random.below(3), edge * random.below(3), edge * random.below(2), false);
}

/// s → 0 and s → 1.
CaseData seam_end(Random& random) {
  const double edge = some_length(random), rung = std::abs(random.rung());
  return seam_case(random, edge, std::min(1.0, random.one_in(2) ? rung : 1 - rung), edge * random.magnitude(-2, 0),
                   edge, 0, random.one_in(2));
}

/// Stitches closed down to the roundings of their point and beyond, beside rest lengths of any size: l and l₀ → 0, each
/// by itself.
CaseData closed(Random& random) {
  const double edge = some_length(random), ratio = random.unit(), length = edge * std::abs(random.rung()),
               before = edge * std::abs(random.rung());
  const double rest_length = edge * random.magnitude(-10, 0);
  return seam_case(random, edge, ratio, length, before, rest_length, true);
}

constexpr std::array<Generator, 11> table{{{"uniform", 40, true, uniform},
                                           {"bits", 15, false, bits},
                                           {"dust", 8, false, uniform},
                                           {"lattice", 15, false, lattice},
                                           {"ladder.rest", 20, false, at_rest},
                                           {"ladder.zero", 15, false, at_zero},
                                           {"ladder.stitch", 10, false, stitch},
                                           {"seam", 20, true, seam},
                                           {"ladder.seam_lattice", 10, false, seam_lattice},
                                           {"ladder.seam", 15, false, seam_end},
                                           {"ladder.closed", 10, false, closed}}};

}  // namespace

std::span<const Generator> spring_generators() { return table; }

}  // namespace ogc::compare
