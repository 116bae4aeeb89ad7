// Makes cases of membrane and bending: a rest shape, its deformation, a material. Ladders approach the rest shape,
// where the terms of the strain cancel; collapsed triangles; tr G = 0 for the Green strain G, where the stress changes;
// and folds by ±π.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compare/judge/cases/any_models.hpp"
#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/placement.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

/// A triangle in the rest plane.
struct RestCorners {
  std::array<Vec3, 3> corner;
  double size;  ///< about the length of an edge
};

RestCorners rest_corners(Random& random, bool lattice) {
  const double size = lattice ? std::ldexp(1.0, random.below(9) - 8) : random.magnitude(-3, 0);
  if (lattice) return {{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}}, size};
  const Vec3 b{size * random.between(0.5, 1.5), 0, 0},
      c{size * random.between(-0.5, 1.5), size * random.between(0.3, 1.5), 0};
  return {{{{0, 0, 0}, b, c}}, size};
}

float single(double x) { return static_cast<float>(x); }

/// Sets ∇N₁, ∇N₂ and the area for corners (0, 0), (b, 0), (c, h).
void set_rest(MembraneCase& question, const RestCorners& rest) {
  const double b = rest.corner[1].x, c = rest.corner[2].x, h = rest.corner[2].y;
  question.gradient = {{{single(1 / b), single(-c / (b * h))}, {0, single(1 / h)}}};
  question.area = single(b * h / 2);
}

void set_material(Random& random, MembraneCase& question) {
  question.lame_lambda = random.one_in(8) ? 0 : single(random.magnitude(-1, 5));
  question.lame_mu = single(random.magnitude(-1, 5));
  question.damping = random.one_in(2) ? 0 : single(random.magnitude(-3, 1));
}

/// Moves the corners of the rest shape by `deform`. At the start of the step, the corners are near the deformed ones in
/// half of the cases, and at rest in the others. One rigid motion takes both triangles out of the canonical frame.
template <class Deform>
CaseData membrane_case(Random& random, Deform deform, bool lattice = false) {
  MembraneCase question;
  const RestCorners rest = rest_corners(random, lattice);
  set_rest(question, rest);
  set_material(random, question);
  std::array<Vec3, 6> points;
  for (std::size_t k = 0; k < 3; ++k) points[k] = deform(rest.corner[k]);
  const bool near = random.one_in(2);
  const double step = rest.size * random.magnitude(-5, -1);
  for (std::size_t k = 0; k < 3; ++k)
    points[3 + k] = near ? sum(points[k], scaled(in_box(random, -1, 1), step)) : rest.corner[k];
  permute(random, points);
  if (!lattice) rotate(random, points);
  for (std::size_t k = 0; k < 3; ++k) {
    question.corner[k] = placement::single(points[k]);
    question.start[k] = placement::single(points[3 + k]);
  }
  return question;
}

Vec3 stretched(const Vec3& p, double xx, double xy, double yy) { return {xx * p.x + xy * p.y, yy * p.y, 0}; }

CaseData membrane_uniform(Random& random) {
  const double xx = random.between(0.3, 3), xy = random.between(-1, 1), yy = random.between(0.3, 3);
  return membrane_case(random, [=](const Vec3& p) { return stretched(p, xx, xy, yy); });
}

CaseData membrane_lattice(Random& random) {
  const double xx = 0.25 * (1 + random.below(8)), xy = 0.25 * (random.below(5) - 2), yy = 0.25 * random.below(9);
  return membrane_case(
      random, [=](const Vec3& p) { return stretched(p, xx, xy, yy); }, true);
}

/// Sets `points` to random bits, and `start` to other random bits or to the same points.
template <std::size_t N>
void place_bits(Random& random, std::array<Vec3f, N>& points, std::array<Vec3f, N>& start) {
  const std::array<Vec3, 4> now = points_of_bits(random), before = points_of_bits(random);
  const bool moved = random.one_in(2);
  for (std::size_t k = 0; k < N; ++k) {
    points[k] = placement::single(now[k]);
    start[k] = moved ? placement::single(before[k]) : points[k];
  }
}

/// Takes random bits for corners, which gives needles and stretches of up to 10⁹.
CaseData membrane_bits(Random& random) {
  MembraneCase question;
  set_rest(question, rest_corners(random, false));
  set_material(random, question);
  place_bits(random, question.corner, question.start);
  return question;
}

/// Approaches F = I, where every term of the strain cancels.
CaseData membrane_rest(Random& random) {
  const double xx = 1 + random.rung(), xy = random.rung(), yy = 1 + random.rung();
  return membrane_case(random, [=](const Vec3& p) { return stretched(p, xx, xy, yy); });
}

/// Approaches a triangle whose deformed area is 0, down to a point.
CaseData membrane_collapse(Random& random) {
  const double xx = random.one_in(2) ? random.between(0.3, 2) : random.rung(),
               xy = random.one_in(4) ? 0.0 : random.between(-1, 1), yy = random.rung();
  const bool lattice = random.one_in(2);
  return membrane_case(
      random, [=](const Vec3& p) { return stretched(p, xx, xy, yy); }, lattice);
}

/// Makes the trace of the Green strain nearly 0, with stretch in one direction and compression in the other.
CaseData membrane_sign(Random& random) {
  const double xx = random.between(0.5, 1), along = 1 + random.rung();
  const double yy = std::sqrt(std::max(0.0, 2 - xx * xx)) * along;
  return membrane_case(random, [=](const Vec3& p) { return stretched(p, xx, 0, yy); });
}

/// Takes corner 1 or 2 of the rest triangle as the vertex, as a sweep does. Otherwise one component of a gradient would
/// always be 0.
CaseData membrane_corner(Random& random) {
  MembraneCase question = case_of<MembraneCase>(membrane_uniform(random));
  for (int shifts = 1 + random.below(2); shifts > 0; --shifts) {
    const auto [b, c] = question.gradient;
    question.gradient = {c, {-b[0] - c[0], -b[1] - c[1]}};
    std::rotate(question.corner.begin(), question.corner.begin() + 1, question.corner.end());
    std::rotate(question.start.begin(), question.start.begin() + 1, question.start.end());
  }
  return question;
}

/// Replaces the default model of a case by another one. Generators with other models have their own names, so that
/// problem strings of the default model keep their cases.
template <CaseData (*make)(Random&)>
CaseData other_membrane(Random& random) {
  MembraneCase question = case_of<MembraneCase>(make(random));
  question.model = another(random, question.model);
  return question;
}

/// Replaces DampingForm::strain by the other DampingForm, and the model by a random one.
template <CaseData (*make)(Random&)>
CaseData membrane_damped_otherwise(Random& random) {
  MembraneCase question = case_of<MembraneCase>(make(random));
  question.damping_form = another(random, DampingForm::strain);
  question.model = any_model<MembraneModel>(random);
  return question;
}

constexpr std::array<Generator, 15> membrane_table{
    {{"uniform", 40, true, membrane_uniform},
     {"corner", 20, true, membrane_corner},
     {"bits", 10, false, membrane_bits},
     {"dust", 8, false, membrane_corner},
     {"neo_hookean_bits", 10, false, other_membrane<membrane_bits>},
     {"lattice", 15, false, membrane_lattice},
     {"ladder.rest", 29, false, membrane_rest},
     {"ladder.collapse", 19, false, membrane_collapse},
     {"ladder.sign", 20, false, membrane_sign},
     {"neo_hookean", 30, true, other_membrane<membrane_corner>},
     {"lattice.neo_hookean", 10, false, other_membrane<membrane_lattice>},
     {"ladder.neo_hookean_rest", 25, false, other_membrane<membrane_rest>},
     {"ladder.neo_hookean_collapse", 20, false, other_membrane<membrane_collapse>},
     {"per_vertex", 15, true, membrane_damped_otherwise<membrane_corner>},
     {"ladder.per_vertex", 15, false, membrane_damped_otherwise<membrane_collapse>}}};

/// A hinge x0, x1, o0, o1 whose edge lies along x. o0 lies in the upper half of the xy plane. o1 lies in the lower
/// half, rotated by `angle` about the edge.
struct HingeShape {
  double size = 1, foot_a = 0.5, foot_b = 0.5, height_a = 1, height_b = 1, angle = 0;
  std::array<Vec3, 4> points() const {
    const double y = -std::cos(angle) * height_b * size, z = std::sin(angle) * height_b * size;
    return {{{0, 0, 0}, {size, 0, 0}, {foot_a * size, height_a * size, 0}, {foot_b * size, y, z}}};
  }
};

HingeShape hinge_shape(Random& random) {
  HingeShape shape;
  shape.size = random.magnitude(-3, 0);
  shape.foot_a = random.between(-0.5, 1.5);
  shape.foot_b = random.between(-0.5, 1.5);
  shape.height_a = random.between(0.3, 1.5);
  shape.height_b = random.between(0.3, 1.5);
  return shape;
}

/// Returns a case with the hinge now and at the start of the time step, both placed by one rigid motion.
CaseData bending_case(Random& random, const HingeShape& now, const HingeShape& start, bool turned = true) {
  BendingCase question;
  question.stiffness = single(random.magnitude(-8, -2));
  question.rest_angle = random.one_in(2) ? 0 : single(random.between(-2.5, 2.5));
  question.damping = random.one_in(2) ? 0 : single(random.magnitude(-3, 1));
  question.own = random.below(4);
  std::array<Vec3, 8> points;
  for (std::size_t k = 0; k < 4; ++k) {
    points[k] = now.points()[k];
    points[4 + k] = start.points()[k];
  }
  permute(random, points);
  if (turned) rotate(random, points);
  for (std::size_t k = 0; k < 4; ++k) {
    question.vertex[k] = placement::single(points[k]);
    question.start[k] = placement::single(points[4 + k]);
  }
  return question;
}

HingeShape with_angle(HingeShape shape, double angle) {
  shape.angle = angle;
  return shape;
}

CaseData bending_uniform(Random& random) {
  const HingeShape shape = hinge_shape(random);
  const double angle = random.between(-3, 3);
  return bending_case(random, with_angle(shape, angle),
                      with_angle(shape, std::clamp(angle + random.between(-0.3, 0.3), -3.0, 3.0)));
}

/// Takes random bits for vertices, which gives hinges of every angle and triangles whose edges differ by up to 10¹².
CaseData bending_bits(Random& random) {
  BendingCase question = case_of<BendingCase>(bending_uniform(random));
  place_bits(random, question.vertex, question.start);
  return question;
}

/// Makes right angles and flat hinges exactly, without rounding.
CaseData bending_lattice(Random& random) {
  HingeShape shape;
  shape.size = std::ldexp(1.0, random.below(9) - 8);
  shape.foot_a = 0.25 * (random.below(9) - 2);
  shape.foot_b = 0.25 * (random.below(9) - 2);
  shape.height_a = 0.25 * (1 + random.below(6));
  shape.height_b = 0.25 * (1 + random.below(6));
  BendingCase question = case_of<BendingCase>(bending_case(random, shape, shape, false));
  const int quarter = random.below(4);
  const float h = single(shape.height_b * shape.size);
  constexpr std::array<std::array<float, 2>, 4> turns{{{-1, 0}, {0, 1}, {0, -1}, {1, 0}}};
  question.vertex = {{{0, 0, 0},
                      {single(shape.size), 0, 0},
                      {single(shape.foot_a * shape.size), single(shape.height_a * shape.size), 0},
                      {single(shape.foot_b * shape.size), turns[quarter][0] * h, turns[quarter][1] * h}}};
  return question;
}

/// Approaches θ = 0.
CaseData bending_flat(Random& random) {
  const HingeShape shape = hinge_shape(random);
  return bending_case(random, with_angle(shape, random.rung()), with_angle(shape, random.rung()), random.one_in(2));
}

/// Approaches θ = ±π, where the angle jumps.
CaseData bending_fold(Random& random) {
  const HingeShape shape = hinge_shape(random);
  const double angle = std::numbers::pi + random.rung(), before = random.one_in(2) ? angle : random.between(-3, 3);
  return bending_case(random, with_angle(shape, angle), with_angle(shape, before), random.one_in(2));
}

/// Makes one triangle or both nearly or exactly a line. Half of the cases are not rotated, so that the line stays
/// exact.
CaseData bending_needle(Random& random) {
  const auto height = [&] { return random.one_in(4) ? 0.0 : random.rung(); };
  HingeShape shape = hinge_shape(random);
  shape.height_a = height();
  if (random.one_in(4)) shape.height_b = height();
  const double angle = random.between(-3, 3);
  return bending_case(random, with_angle(shape, angle), with_angle(shape, angle), random.one_in(2));
}

/// Makes a case of the isometric model. Its rest shape is `now` without the fold, or a random hinge.
CaseData isometric_case(Random& random, const HingeShape& now, const HingeShape& start) {
  BendingCase question = case_of<BendingCase>(bending_case(random, now, start, random.one_in(2)));
  HingeShape rest = random.one_in(2) && now.height_a > 0.1 && now.height_b > 0.1 ? now : hinge_shape(random);
  rest.size = now.size;
  question.model = another(random, BendingModel::discrete_hinge);
  question.weight = {single((rest.foot_a / rest.height_a + rest.foot_b / rest.height_b) / rest.size),
                     single(-1 / (rest.height_a * rest.size)), single(-1 / (rest.height_b * rest.size))};
  return question;
}

CaseData bending_isometric(Random& random) {
  const HingeShape shape = hinge_shape(random);
  const double angle = random.between(-3, 3);
  return isometric_case(random, with_angle(shape, angle),
                        with_angle(shape, std::clamp(angle + random.between(-0.3, 0.3), -3.0, 3.0)));
}

/// Approaches a flat hinge, for which ℓ = Σ w_i x_i is 0 (compare/stages/bending.hpp).
CaseData isometric_flat(Random& random) {
  const HingeShape shape = hinge_shape(random);
  return isometric_case(random, with_angle(shape, random.rung()), with_angle(shape, random.rung()));
}

/// Adds damping to hinges near θ = ±π, where the angle jumps. In half of the cases a triangle is nearly or exactly
/// collapsed, so that the angle is undefined.
CaseData isometric_damping(Random& random) {
  HingeShape shape = hinge_shape(random);
  if (random.one_in(2)) shape.height_a = random.one_in(4) ? 0.0 : random.rung();
  const double angle = std::numbers::pi + random.rung();
  BendingCase question = case_of<BendingCase>(isometric_case(
      random, with_angle(shape, angle), with_angle(shape, random.one_in(2) ? angle : random.between(-3, 3))));
  question.damping = single(random.magnitude(-3, 1));
  return question;
}

/// Replaces DampingForm::strain by the other DampingForm.
template <CaseData (*make)(Random&)>
CaseData bending_damped_otherwise(Random& random) {
  BendingCase question = case_of<BendingCase>(make(random));
  question.damping_form = another(random, DampingForm::strain);
  return question;
}

constexpr std::array<Generator, 13> bending_table{
    {{"uniform", 40, true, bending_uniform},
     {"bits", 10, false, bending_bits},
     {"dust", 8, false, bending_uniform},
     {"lattice", 15, false, bending_lattice},
     {"ladder.flat", 20, false, bending_flat},
     {"ladder.fold", 15, false, bending_fold},
     {"ladder.needle", 10, false, bending_needle},
     {"isometric", 25, true, bending_isometric},
     {"ladder.isometric_flat", 20, false, isometric_flat},
     {"ladder.isometric_damping", 15, false, isometric_damping},
     {"per_vertex", 10, true, bending_damped_otherwise<bending_uniform>},
     {"isometric.per_vertex", 5, true, bending_damped_otherwise<bending_isometric>},
     {"ladder.per_vertex", 10, false, bending_damped_otherwise<bending_needle>}}};

}  // namespace

std::span<const Generator> membrane_generators() { return membrane_table; }
std::span<const Generator> bending_generators() { return bending_table; }

}  // namespace ogc::compare
