// Makes the traits of stage tetrahedron. Ladders approach the rest shape, where the force cancels; a flat tetrahedron;
// the mirror image of the rest shape; needles whose corners coincide; and rest shapes without thickness.
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/judge/cases/any_models.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/stages/force_forms.hpp"
#include "compare/judge/stages/force_stage.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

using Corners = std::array<Vec3, 4>;

Vec3 apart(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double inner(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 outer(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns the tetrahedron with the corners 0, e₁, e₂ and e₃, scaled by `size`, and along z also by `height`. Its
/// corners have jitter unless they are on a lattice.
Corners rest_corners(Random& random, double size, double height, bool lattice) {
  Corners x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (Vec3& p : x) {
    if (!lattice) p = sum(p, in_box(random, -0.2, 0.2));
    p = scaled({p.x, p.y, height * p.z}, size);
  }
  return x;
}

/// Sets the stage's inputs for a rest shape with positive volume.
void set_rest(TetrahedronCase& question, const Corners& rest) {
  const Vec3 a = apart(rest[1], rest[0]), b = apart(rest[2], rest[0]), c = apart(rest[3], rest[0]);
  const std::array<Vec3, 3> inward{outer(b, c), outer(c, a), outer(a, b)};
  const double six = inner(a, inward[0]);
  const Vec3 own = scaled(sum(sum(inward[0], inward[1]), inward[2]), -1);
  for (std::size_t k = 0; k < 3; ++k) {
    question.weight[k] = static_cast<float>(inner(own, inward[k]) / (6 * six));
    const Vec3f gradient = single(scaled(inward[k], 1 / six));
    question.gradient[k] = {gradient.x, gradient.y, gradient.z};
  }
  question.inverse = static_cast<float>(1 / six);
  question.volume = static_cast<float>(six / 6);
}

void set_material(Random& random, TetrahedronCase& question) {
  question.lame_lambda = random.one_in(8) ? 0 : static_cast<float>(random.magnitude(2, 9));
  question.lame_mu = static_cast<float>(random.magnitude(2, 9));
  question.damping = random.one_in(2) ? 0 : static_cast<float>(random.magnitude(-3, 1));
  if (random.one_in(4)) question.damping_form = another(random, DampingForm::strain);
}

/// Places the deformed corners `x` and the corners at the start of the time step by one rigid motion. In half of the
/// cases the corners at the start are near x, otherwise at rest.
CaseData placed(Random& random, TetrahedronCase question, const Corners& rest, const Corners& x, double size,
                bool lattice) {
  std::array<Vec3, 8> points;
  const bool near = random.one_in(2);
  const double step = size * random.magnitude(-5, -1);
  for (std::size_t k = 0; k < 4; ++k) {
    points[k] = x[k];
    points[4 + k] = near ? sum(x[k], scaled(in_box(random, -1, 1), step)) : rest[k];
  }
  if (!lattice) rotate(random, points);
  for (std::size_t k = 0; k < 4; ++k) {
    question.corner[k] = single(points[k]);
    question.start[k] = single(points[4 + k]);
  }
  return question;
}

/// Moves each corner of a rest shape by `deform(p)`. The size of the rest shape is 10⁻³ m … 1 m; on a lattice it is a
/// power of two, 2⁻⁸ m … 1 m.
template <class Deform>
CaseData deformed(Random& random, Deform deform, bool lattice = false) {
  const double size = lattice ? std::ldexp(1.0, random.below(9) - 8) : random.magnitude(-3, 0);
  const Corners rest = rest_corners(random, size, 1, lattice);
  TetrahedronCase question;
  set_rest(question, rest);
  set_material(random, question);
  Corners x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = deform(rest[k]);
  return placed(random, question, rest, x, size, lattice);
}

/// A matrix by rows.
using Rows = std::array<Vec3, 3>;
Vec3 times(const Rows& f, const Vec3& p) { return {inner(f[0], p), inner(f[1], p), inner(f[2], p)}; }

/// Stretches and shears a tetrahedron, with or without inversion.
CaseData uniform(Random& random) {
  const Rows f{in_box(random, -1.5, 1.5), in_box(random, -1.5, 1.5), in_box(random, -1.5, 1.5)};
  return deformed(random, [&](const Vec3& p) { return times(f, p); });
}

CaseData lattice(Random& random) {
  Rows f;
  for (Vec3& row : f) row = scaled(on_lattice(random, 3), 0.5);
  return deformed(
      random, [&](const Vec3& p) { return times(f, p); }, true);
}

/// Takes random bits for coordinates and material.
CaseData bits(Random& random) {
  TetrahedronCase question;
  const auto number = [&] { return static_cast<float>(random.sign()) * random.pattern(0x1p-20f, 1); };
  for (auto* points : {&question.corner, &question.start})
    for (Vec3f& p : *points) p = {number(), number(), number()};
  set_rest(question, rest_corners(random, random.magnitude(-1, 0), 1, false));
  set_material(random, question);
  question.lame_lambda = random.pattern();
  question.lame_mu = random.pattern();
  return question;
}

/// Makes tetrahedra of the largest and smallest sizes that scenes may have.
CaseData scales(Random& random) {
  TetrahedronCase question;
  const double size = std::ldexp(random.between(1, 2), random.one_in(2) ? 19 : -20);
  const Corners rest = rest_corners(random, size, 1, false);
  set_rest(question, rest);
  set_material(random, question);
  Corners x = rest;
  for (Vec3& p : x) p = sum(p, scaled(in_box(random, -0.5, 0.5), size));
  // The case is near the origin, because 2⁻²⁰ m has few bits beside a coordinate of 1 m.
  for (std::size_t k = 0; k < 4; ++k) question.corner[k] = single(x[k]), question.start[k] = single(rest[k]);
  return question;
}

/// Approaches F = I, where the two parts of the force cancel.
CaseData at_rest(Random& random) {
  const Rows f{Vec3{1 + random.rung(), random.rung(), random.rung()},
               Vec3{random.rung(), 1 + random.rung(), random.rung()},
               Vec3{random.rung(), random.rung(), 1 + random.rung()}};
  return deformed(random, [&](const Vec3& p) { return times(f, p); });
}

/// Returns a rung; on the grid, 0 instead of a rung below 2⁻²². On the grid, corners may lie straight above each other
/// at a distance of 2⁻⁸ m or more. The rung times this distance must be 0 or a legal length, at least 2⁻³⁰ m.
double rung_on(Random& random, bool on_grid) {
  const double rung = random.rung();
  return on_grid && std::abs(rung) < 0x1p-22 ? 0 : rung;
}

/// Approaches J = 0 from both sides.
CaseData flat(Random& random) {
  const bool on_grid = random.one_in(2);
  const double height = rung_on(random, on_grid);
  return deformed(
      random,
      [&](const Vec3& p) {
        return Vec3{p.x, p.y, height * p.z};
      },
      on_grid);
}

/// Approaches F = diag(1, 1, −1), the rest shape's mirror image.
CaseData mirrored(Random& random) {
  const double height = -1 + random.rung();
  return deformed(random, [&](const Vec3& p) { return Vec3{p.x, p.y, height * p.z}; });
}

/// Moves corners towards each other, down to one point.
CaseData needle(Random& random) {
  const bool on_grid = random.one_in(2);
  const double y = rung_on(random, on_grid), z = rung_on(random, on_grid),
               x = random.one_in(4) ? rung_on(random, on_grid) : 1;
  return deformed(
      random,
      [&](const Vec3& p) {
        return Vec3{x * p.x, y * p.y, z * p.z};
      },
      on_grid);
}

/// Makes rest shapes that are nearly flat, for which weights are large and J is a sum of small differences.
CaseData sliver(Random& random) {
  const double size = random.magnitude(-3, 0), height = std::abs(random.rung()), kept = height == 0 ? 1e-4 : height;
  const Corners rest = rest_corners(random, size, std::max(kept, 1e-6), true);
  TetrahedronCase question;
  set_rest(question, rest);
  set_material(random, question);
  Corners x = rest;
  for (Vec3& p : x) p = sum(p, scaled(in_box(random, -1, 1), size * random.magnitude(-7, -1)));
  question.damping = 0;  // F of a needle at rest would exceed the contract's strains
  return placed(random, question, rest, x, size, false);
}

constexpr std::array<Generator, 10> table{{{"uniform", 30, true, uniform},
                                           {"bits", 15, false, bits},
                                           {"dust", 8, false, uniform},
                                           {"scales", 10, true, scales},
                                           {"lattice", 15, false, lattice},
                                           {"ladder.rest", 20, false, at_rest},
                                           {"ladder.flat", 15, false, flat},
                                           {"ladder.mirror", 10, false, mirrored},
                                           {"ladder.needle", 15, false, needle},
                                           {"ladder.sliver", 10, false, sliver}}};

/// Limits of the contract: weights [m], i = 1/(6V) [1/m³], growth = i (longest side)³, and strain.
constexpr float most_weight = 0x1p60f, least_inverse = 0x1p-70f, most_inverse = 0x1p80f;
constexpr double most_growth = 0x1p30, most_strain = 0x1p20;

double longest(const std::array<Vec3f, 4>& x) {
  double length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      length = std::max(length, std::hypot(double{x[i].x} - x[j].x, double{x[i].y} - x[j].y, double{x[i].z} - x[j].z));
  return length;
}

std::vector<WrongForm> tetrahedron_forms() {
  constexpr auto stage = &Authority::tetrahedron;
  std::vector<WrongForm> forms = common_forms(stage);
  add_damping(forms, stage);
  const auto add = [&](const char* name, const char* meaning, auto change) {
    forms.push_back(case_asked(name, meaning, stage, change));
  };
  add("lambda_for_lambda_plus_mu", "λ in place of λ + μ",
      [](TetrahedronCase& c) { c.lame_lambda = std::max(0.0f, c.lame_lambda - c.lame_mu); });
  add("lame_exchanged", "λ and μ exchanged", [](TetrahedronCase& c) { std::swap(c.lame_lambda, c.lame_mu); });
  add("lambda_missing", "λ is 0", [](TetrahedronCase& c) { c.lame_lambda = 0; });
  add("volume_six_times", "6V in place of V", [](TetrahedronCase& c) {
    for (float& w : c.weight) w *= 6;
    c.inverse /= 6;
    c.volume *= 6;
  });
  add("inverse_missing", "J without the volume at rest", [](TetrahedronCase& c) { c.inverse = 1; });
  add("corners_exchanged", "two corners exchanged, so that the volume is negative",
      [](TetrahedronCase& c) { std::swap(c.corner[1], c.corner[2]); });
  add("weights_exchanged", "the weights of two corners exchanged",
      [](TetrahedronCase& c) { std::swap(c.weight[0], c.weight[1]); });
  add("gradients_transposed", "the matrix of ∇N transposed", [](TetrahedronCase& c) {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < k; ++axis) std::swap(c.gradient[k][axis], c.gradient[axis][k]);
  });
  return forms;
}

struct TetrahedronStage
    : ForceStage<TetrahedronStage, TetrahedronCase, &Contestant::tetrahedron, &Authority::tetrahedron> {
  static constexpr StageInfo info{.name = "tetrahedron",
                                  .question = "force and block of one corner of one tetrahedron",
                                  .unit = "stencil",
                                  .reference = "reference/energies/tetrahedron.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"force", "u cond", tetrahedron_force_tolerance},
                                      MetricInfo{"block", "u cond", tetrahedron_block_tolerance}};
  static constexpr std::array parameters{ParameterInfo{"lambda", "first Lamé constant [Pa]", 0, ranges::vast},
                                         ParameterInfo{"G", "second Lamé constant [Pa]", 0x1p-30f, ranges::vast},
                                         ranges::damping};
  static float* parameter(Case& c, std::string_view name) {
    return name == "lambda" ? &c.lame_lambda : name == "G" ? &c.lame_mu : &c.damping;
  }

  static std::span<const Generator> generators() { return table; }

  static void check(const Case& c, FirstProblem& problem) {
    for (const auto* points : {&c.corner, &c.start}) {
      problem.vectors(points == &c.corner ? "a coordinate" : "a coordinate at the start", *points);
      check_lengths(problem, *points, 0x1p-30f, 0x1p-30f);
      const double length = longest(*points);
      problem.require(c.inverse * length * length * length <= most_growth, "it has grown beyond the contract");
    }
    for (const float w : c.weight) problem.number("a weight", w, -most_weight, most_weight);
    problem.require(double{c.weight[0]} + c.weight[1] + c.weight[2] < 0, "its weights are those of no tetrahedron");
    problem.number("an inverse of 6 V", c.inverse, least_inverse, most_inverse);
    problem.number("a first Lamé constant", c.lame_lambda, 0, vast);
    problem.number("a second Lamé constant", c.lame_mu, 0x1p-30f, vast);
    problem.number("a damping", c.damping, 0, most_length);
    if (!damps_strain(c.damping_form) || c.damping == 0) return;
    problem.number("a volume", c.volume, 0x1p-80f, 0x1p64f);
    for (const auto& gradient : c.gradient)
      for (const float g : gradient)
        problem.require(std::abs(g) * std::max(longest(c.corner), longest(c.start)) <= most_strain,
                        "its strain is beyond the contract");
  }
  static void mutate(Random& random, Case& c) { mutate_together(random, c.corner, c.start); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.corner, c.start}); }
  static std::string missing_in(const States& states) {
    return states.rest().tetrahedra.empty() ? "no body that moves has tetrahedra" : "";
  }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.tetrahedron(states.frame(index), random);
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add_all(c.corner);
    shape.triangles = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    return shape;
  }
  static std::vector<std::string> roles(const Case&) {
    return {"corner 0, asked about", "corner 1", "corner 2", "corner 3"};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return tetrahedron_forms(); }
};

}  // namespace

constinit const StageTraits stages::tetrahedron = make_traits<TetrahedronStage>();

}  // namespace ogc::compare
