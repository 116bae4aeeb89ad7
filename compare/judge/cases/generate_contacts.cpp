// Makes cases of contact_force and friction_force. In the canonical frame the contact point of the second side is near
// the origin, and the normal points along z. So the distance is one coordinate, and so is the motion along the normal.
// Ladders approach
//
// - the boundaries between closest features, and collapsed triangles and edges as far as they are legal,
// - parallel edges and the limit of nearly parallel ones,
// - d = r, d ≫ r, d = τ = r/2 (where the activation changes) and d = 0,
// - for friction also a slip of 0, a slip of ε_v h, and motion along the normal.
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/problem/names.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

constexpr std::array<ContactSides, 4> all_sides{ContactSides::point_point, ContactSides::point_edge,
                                                ContactSides::edge_edge, ContactSides::point_triangle};

/// A contact in its canonical frame: its points now and at the last detection.
struct Shape {
  ContactSides sides = ContactSides::point_point;
  double size = 1, contact_radius = 1, distance = 0;  ///< about the length of an edge; r; d, nearly
  std::array<Vec3, 4> x{}, previous{};
  bool turned = true;  ///< true if it may be rotated
};

/// Returns a shape with d = `share` r, whose r is between a fifth of an edge length and three edge lengths.
Shape sized(Random& random, ContactSides sides, double share) {
  Shape shape;
  shape.sides = sides;
  shape.size = random.magnitude(-3, 0);
  shape.contact_radius = shape.size * random.magnitude(-0.7, 0.5);
  shape.distance = shape.contact_radius * share;
  return shape;
}

ContactSides any_sides(Random& random) { return random.pick(std::span<const ContactSides>(all_sides)); }

/// Puts a point above an edge of this length on the x axis, at the edge's parameter t.
void put_edge(Shape& shape, double t, double length) {
  shape.x = {Vec3{0, 0, shape.distance}, Vec3{-t * length, 0, 0}, Vec3{(1 - t) * length, 0, 0}, Vec3{}};
}

/// Puts a point at `shape.distance` above a triangle's point. b and c are this point's weights of the second and third
/// corner.
void put_triangle(Shape& shape, const Vec3& second, const Vec3& third, double b, double c) {
  const Vec3 foot = sum(scaled(second, b), scaled(third, c));
  shape.x = {Vec3{0, 0, shape.distance}, scaled(foot, -1), sum(second, scaled(foot, -1)), sum(third, scaled(foot, -1))};
}

/// Returns two edges of the lengths `shape.size` and `length`. Seen from above, they cross at their parameters s and t,
/// at an angle of this sine.
std::array<Vec3, 4> crossing(const Shape& shape, double length, double sine, double s, double t) {
  const double x = length * std::sqrt(std::max(0.0, 1 - sine * sine)), y = length * sine, a = shape.size;
  return {Vec3{-s * a, 0, shape.distance}, Vec3{(1 - s) * a, 0, shape.distance}, Vec3{-t * x, -t * y, 0},
          Vec3{(1 - t) * x, (1 - t) * y, 0}};
}

double other_length(Random& random, const Shape& shape) { return shape.size * random.magnitude(-0.5, 0.5); }

struct Base {
  Vec3 second, third;
};

/// Returns the second and third corner of a random triangle whose first corner is the origin.
Base any_base(Random& random, double size) {
  const double x = random.between(-0.5, 1.5), y = random.between(0.3, 1.5);
  return {{size * random.between(0.5, 1.5), 0, 0}, {size * x, size * y, 0}};
}

/// Places both sides so that the closest points have the parameters s and t.
void put(Random& random, Shape& shape, double s, double t) {
  switch (shape.sides) {
    case ContactSides::point_edge: return put_edge(shape, s, other_length(random, shape));
    case ContactSides::edge_edge:
      shape.x = crossing(shape, other_length(random, shape), random.between(0.1, 1), s, t);
      return;
    case ContactSides::point_triangle: {
      const Base base = any_base(random, shape.size);
      return put_triangle(shape, base.second, base.third, s, t);
    }
    case ContactSides::point_point: shape.x = {Vec3{0, 0, shape.distance}, Vec3{}, Vec3{}, Vec3{}};
  }
}

/// Returns a contact between interior points of both sides.
Shape inside(Random& random, ContactSides sides, double share) {
  Shape shape = sized(random, sides, share);
  const bool triangle = sides == ContactSides::point_triangle;
  const double s = random.between(0.05, 0.95), t = random.between(0.05, 0.95);
  put(random, shape, triangle ? s * (1 - t) : s, triangle ? t * (1 - s) : t);
  return shape;
}

/// Returns a parameter near an end of an edge, or beyond it.
double near_end(Random& random) {
  const double off = !random.is_fine() && random.one_in(3) ? random.between(-0.5, 0) : random.rung();
  return random.one_in(2) ? off : 1 - off;
}

Shape near_feature(Random& random) {
  const ContactSides sides = random.pick(std::span<const ContactSides>(all_sides).subspan(1));
  Shape shape = sized(random, sides, random.between(0.05, 1));
  double s = near_end(random), t = random.one_in(2) ? random.unit() : near_end(random);
  // puts the point near the edge opposite to the first corner
  if (sides == ContactSides::point_triangle && random.one_in(3)) {
    s = random.unit();
    t = 1 - s + random.rung();
  }
  put(random, shape, s, t);
  return shape;
}

/// Returns a contact of two edges, one of them short, or of a point and a triangle with a small height or a short edge.
/// `thinness` is the small length relative to `shape.size`.
Shape thin_by(Random& random, double thinness) {
  Shape shape = sized(random, random.one_in(4) ? ContactSides::edge_edge : ContactSides::point_triangle,
                      random.between(0.05, 1));
  shape.turned = thinness > 0;
  const double b = random.between(-0.2, 1.2), c = random.one_in(2) ? random.between(-0.2, 1.2) : random.rung();
  if (shape.sides == ContactSides::edge_edge) {
    shape.x = crossing(shape, shape.size * thinness, random.unit(), b, c);
    if (random.one_in(2)) std::rotate(shape.x.begin(), shape.x.begin() + 2, shape.x.end());
    return shape;
  }
  const double length = shape.size, width = length * thinness, lean = random.between(-0.3, 1.3);
  const std::array<Base, 3> bases{{{{length, 0, 0}, {lean * length, width, 0}},
                                   {{0, width, 0}, {length, lean * width, 0}},
                                   {{length, 0, 0}, {length, width, 0}}}};
  const Base& base = bases[random.below(3)];
  put_triangle(shape, base.second, base.third, b, c);
  return shape;
}

/// `thin` returns contacts of a thinness of 0 or 10^−2.4 … 10^−0.5. `needle` returns contacts of a thinness of 10⁻⁹ …
/// 10^−2.4, most of them needles (compare/stages/contact_force.hpp).
Shape thin(Random& random) { return thin_by(random, random.one_in(4) ? 0.0 : random.magnitude(-2.4, -0.5)); }
Shape needle(Random& random) { return thin_by(random, random.magnitude(-9, -2.4)); }

/// Makes edges whose angle is near the limit of nearly parallel edges or near 0. In two of three cases they do not
/// cross, but overlap by a part of their length, meet at their ends, or leave a gap.
Shape nearly_parallel(Random& random) {
  Shape shape = sized(random, ContactSides::edge_edge, random.between(0.05, 1));
  const double sine = random.one_in(2) ? 1e-3 * (1 + random.rung()) : std::min(1.0, std::abs(random.rung()));
  const double length = other_length(random, shape);
  if (random.one_in(3)) {
    shape.x = crossing(shape, length, sine, random.between(0.05, 0.95), random.between(0.05, 0.95));
    return shape;
  }
  // The second edge begins beside the end of the first: their overlap is up to half of the first, 0, or negative.
  const double overlap = random.one_in(2) ? random.between(-0.5, 0.5) : random.rung(),
               aside = random.one_in(2) ? 0.0 : random.between(-1, 1) * shape.contact_radius;
  shape.x = crossing(shape, length, sine, 1 - overlap, 0);
  const double tilt = random.one_in(2) ? 0.0 : sine * length;
  shape.x[2].y += aside;
  shape.x[3] = {shape.x[3].x, shape.x[3].y + aside, shape.x[3].z + tilt};
  if (random.one_in(2)) std::swap(shape.x[2], shape.x[3]);
  return shape;
}

/// Returns a shape with small coordinates of few bits, for which decisions are often ties.
Shape on_grid(Random& random) {
  Shape shape = sized(random, any_sides(random), 0);
  shape.size = std::ldexp(1.0, random.below(9) - 8);
  shape.contact_radius = shape.size * 0.5 * (1 + random.below(6));
  for (Vec3& p : shape.x) p = scaled(on_lattice(random, 1), shape.size);
  shape.turned = false;
  return shape;
}

/// Sets the points at the last detection: the current ones, or points a little beside them.
void detect(Random& random, Shape& shape) {
  shape.previous = shape.x;
  const double step = random.one_in(2) ? 0.0 : shape.size * random.magnitude(-4, -1);
  for (Vec3& p : shape.previous) p = sum(p, scaled(in_box(random, -1, 1), step));
}

float squared_length(const Vec3f& a, const Vec3f& b) {
  const double x = double{b.x} - a.x, y = double{b.y} - a.y, z = double{b.z} - a.z;
  return static_cast<float>(x * x + y * y + z * z);
}

/// Returns the case of a shape; `moved` is the motion of each vertex since the start of the step. The same rigid motion
/// takes the points now, at the last detection and at the start out of the canonical frame.
FrictionForceCase placed(Random& random, const Shape& shape, const std::array<Vec3, 4>& moved) {
  std::array<Vec3, 12> points;
  for (std::size_t k = 0; k < 4; ++k) {
    points[k] = shape.x[k];
    points[4 + k] = shape.previous[k];
    points[8 + k] = sum(shape.x[k], scaled(moved[k], -1));
  }
  permute(random, points);
  if (shape.turned && random.one_in(2)) rotate(random, points);
  FrictionForceCase question;
  ContactForceCase& contact = question.contact;
  contact.sides = shape.sides;
  contact.own = random.below(vertex_count(shape.sides));
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(shape.sides)); ++k) {
    contact.vertex[k] = single(points[k]);
    contact.previous[k] = single(points[4 + k]);
    question.start[k] = single(points[8 + k]);
  }
  contact.contact_radius = static_cast<float>(shape.contact_radius);
  contact.stiffness = static_cast<float>(random.magnitude(-1, 4));
  if (shape.sides == ContactSides::edge_edge && !random.one_in(4)) {
    const double stretch = random.one_in(2) ? 1 : random.magnitude(-0.5, 0.5);
    contact.rest_squared = {
        std::max(0x1p-40f, static_cast<float>(stretch) * squared_length(contact.vertex[0], contact.vertex[1])),
        std::max(0x1p-40f, static_cast<float>(stretch) * squared_length(contact.vertex[2], contact.vertex[3]))};
    if (random.one_in(8)) contact.rest_squared[static_cast<std::size_t>(random.below(2))] = 0;
  }
  return question;
}

CaseData contact_case(Random& random, Shape shape) {
  detect(random, shape);
  return placed(random, shape, {}).contact;
}

double any_share(Random& random) { return random.between(0.02, 1.15); }

/// Approaches d = r.
Shape near_radius(Random& random) { return inside(random, any_sides(random), 1 + random.rung()); }
/// Approaches d = τ = r/2.
Shape near_switch(Random& random) { return inside(random, any_sides(random), 0.5 * (1 + random.rung())); }
/// Approaches d = 0, also below 2⁻²³ r.
Shape near_touching(Random& random) {
  return inside(random, any_sides(random), random.one_in(8) ? 0 : random.magnitude(-9, -1));
}

/// Takes random bits for points, edges and radii. Contacts of two edges and contacts of a point with a triangle are
/// excluded, because their shapes might be illegal.
Shape of_bits(Random& random) {
  Shape shape;
  shape.sides = random.one_in(2) ? ContactSides::point_point : ContactSides::point_edge;
  shape.x = points_of_bits(random);
  shape.previous = shape.x;
  shape.contact_radius = random.pattern();
  shape.size = shape.contact_radius;
  shape.turned = false;
  return shape;
}

CaseData contact_bits(Random& random) { return placed(random, of_bits(random), {}).contact; }

CaseData contact_uniform(Random& random) {
  return contact_case(random, inside(random, any_sides(random), any_share(random)));
}
CaseData contact_lattice(Random& random) { return contact_case(random, on_grid(random)); }
CaseData contact_feature(Random& random) { return contact_case(random, near_feature(random)); }
CaseData contact_thin(Random& random) { return contact_case(random, thin(random)); }
CaseData contact_needle(Random& random) { return contact_case(random, needle(random)); }
CaseData contact_parallel(Random& random) {
  auto question = case_of<ContactForceCase>(contact_case(random, nearly_parallel(random)));
  // Edges without triangles: e_k is the share of their overlap.
  if (random.one_in(2)) question.rest_squared = {};
  return question;
}
CaseData contact_radius(Random& random) { return contact_case(random, near_radius(random)); }
/// Takes d = r (1 ± k 2⁻²⁴) for small k, where single precision decides whether d < r. Also takes d up to 10⁴ r, which
/// occurs if vertices move far after the last detection.
CaseData contact_beyond(Random& random) {
  const double share = random.one_in(2) ? 1 + random.sign() * random.below(9) * 0x1p-24 : random.magnitude(0, 4);
  return contact_case(random, inside(random, any_sides(random), share));
}
CaseData contact_switch(Random& random) { return contact_case(random, near_switch(random)); }
CaseData contact_touching(Random& random) { return contact_case(random, near_touching(random)); }

/// Returns a shape at a boundary between features or at a distance where the activation changes, or a generic shape.
Shape any_shape(Random& random) {
  switch (random.below(5)) {
    case 0: return near_feature(random);
    case 1: return near_radius(random);
    case 2: return near_switch(random);
    case 3: return near_touching(random);
    default: return inside(random, any_sides(random), any_share(random));
  }
}
ContactActivation any_activation(Random& random) {
  return random.pick(std::span<const ContactActivation>(choices<ContactActivation>));
}

/// Returns a fine shape at a boundary between features, at d = r, or at d = r/2.
Shape near_boundary(Random& random) {
  random.be_fine();
  switch (random.below(4)) {
    case 0: return near_radius(random);
    case 1: return near_switch(random);
    default: return near_feature(random);
  }
}
CaseData contact_boundary(Random& random) { return contact_case(random, near_boundary(random)); }

CaseData contact_variants(Random& random) {
  auto question = case_of<ContactForceCase>(contact_case(random, any_shape(random)));
  question.activation = any_activation(random);
  return question;
}

/// Marks random vertices as updated together with the vertex of the question.
CaseData contact_together(Random& random) {
  auto question = case_of<ContactForceCase>(contact_case(random, any_shape(random)));
  question.together = static_cast<std::uint8_t>(1 + random.below(15));
  return question;
}

/// Approaches c = ε and c = 0 of the mollifier (method.md §4.3). c is the squared sine of the edges' angle at the last
/// detection, and ε = 10⁻³.
CaseData contact_mollifier(Random& random) {
  Shape shape = inside(random, ContactSides::edge_edge, any_share(random));
  const double sine = random.one_in(2) ? std::sqrt(1e-3) * (1 + random.rung()) : std::abs(random.rung());
  shape.previous = crossing(shape, other_length(random, shape), sine, 0.5, 0.5);
  return placed(random, shape, {}).contact;
}

/// Moves the first side against the second by `along` in the tangent plane and `lift` along the normal, in units of ε_v
/// h. Both sides also share a random motion.
CaseData friction_case(Random& random, Shape shape, double along, double lift) {
  detect(random, shape);
  const double limit = shape.size * random.magnitude(-5, -1), angle = random.between(0, 6.283185307179586);
  const Vec3 slip{limit * along * std::cos(angle), limit * along * std::sin(angle), limit * lift};
  const Vec3 common = random.one_in(2) ? Vec3{} : scaled(in_box(random, -1, 1), shape.size * random.magnitude(-4, -1));
  const double bend = random.one_in(2) ? 0.0 : limit * random.magnitude(-3, 0);
  const bool edges = shape.sides == ContactSides::edge_edge;
  std::array<Vec3, 4> moved;
  for (std::size_t k = 0; k < 4; ++k) {
    const bool first = k == 0 || (edges && k == 1);
    moved[k] = sum(sum(common, first ? slip : Vec3{}), scaled(in_box(random, -1, 1), bend));
  }
  FrictionForceCase question = placed(random, shape, moved);
  question.friction = random.one_in(16) ? 0.0f : static_cast<float>(random.between(0.01, 1.5));
  question.slip_limit = static_cast<float>(limit);
  return question;
}

CaseData friction_of(Random& random, const Shape& shape) {
  return friction_case(random, shape, random.between(0, 3), random.between(-1, 1));
}

CaseData friction_uniform(Random& random) {
  return friction_of(random, inside(random, any_sides(random), any_share(random)));
}
CaseData friction_feature(Random& random) {
  return friction_of(random, random.one_in(4) ? thin(random) : near_feature(random));
}
CaseData friction_needle(Random& random) { return friction_of(random, needle(random)); }
CaseData friction_parallel(Random& random) { return friction_of(random, nearly_parallel(random)); }
CaseData friction_distance(Random& random) {
  return friction_of(random, random.one_in(3)   ? near_touching(random)
                             : random.one_in(2) ? near_switch(random)
                                                : near_radius(random));
}

/// Makes slips of 0 or of one lattice step.
CaseData friction_lattice(Random& random) {
  Shape shape = on_grid(random);
  shape.previous = shape.x;
  std::array<Vec3, 4> moved;
  for (Vec3& m : moved) m = random.one_in(2) ? Vec3{} : scaled(on_lattice(random, 1), shape.size / 8);
  FrictionForceCase question = placed(random, shape, moved);
  question.friction = 0.5f;
  question.slip_limit = static_cast<float>(std::ldexp(shape.size, -random.below(8)));
  return question;
}

/// Takes random bits for the positions and for the motion.
CaseData friction_bits(Random& random) {
  FrictionForceCase question = placed(random, of_bits(random), points_of_bits(random));
  question.friction = static_cast<float>(random.between(0.01, 1.5));
  question.slip_limit = random.pattern();
  return question;
}

/// Approaches ‖u‖ = 0.
CaseData friction_still(Random& random) {
  return friction_case(random, inside(random, any_sides(random), any_share(random)), random.rung(),
                       random.one_in(2) ? 0 : random.between(-1, 1));
}

/// Approaches ‖u‖ = ε_v h.
CaseData friction_limit(Random& random) {
  return friction_case(random, inside(random, any_sides(random), any_share(random)), 1 + random.rung(),
                       random.between(-1, 1));
}

/// Makes displacements whose component along the normal is 1 to 10⁴ times ε_v h.
CaseData friction_lift(Random& random) {
  return friction_case(random, inside(random, any_sides(random), any_share(random)),
                       random.one_in(2) ? 0 : random.between(0, 3), random.magnitude(0, 4));
}

CaseData friction_boundary(Random& random) { return friction_of(random, near_boundary(random)); }

CaseData friction_variants(Random& random) {
  auto question = case_of<FrictionForceCase>(
      friction_case(random, any_shape(random), random.between(0, 3), random.between(-1, 1)));
  question.contact.activation = any_activation(random);
  return question;
}

CaseData friction_together(Random& random) {
  auto question = case_of<FrictionForceCase>(
      friction_case(random, any_shape(random), random.between(0, 3), random.between(-1, 1)));
  question.contact.together = static_cast<std::uint8_t>(1 + random.below(15));
  return question;
}

constexpr std::array<Generator, 16> contact_table{{{"uniform", 30, true, contact_uniform},
                                                   {"bits", 10, false, contact_bits},
                                                   {"dust", 8, false, contact_uniform},
                                                   {"lattice", 15, false, contact_lattice},
                                                   {"ladder.feature", 14, false, contact_feature},
                                                   {"ladder.thin", 8, false, contact_thin},
                                                   {"ladder.needle", 8, false, contact_needle},
                                                   {"ladder.parallel", 10, false, contact_parallel},
                                                   {"ladder.radius", 6, false, contact_radius},
                                                   {"ladder.beyond", 6, false, contact_beyond},
                                                   {"ladder.switch", 5, false, contact_switch},
                                                   {"ladder.touching", 7, false, contact_touching},
                                                   {"ladder.mollifier", 5, false, contact_mollifier},
                                                   {"ladder.variants", 25, false, contact_variants},
                                                   {"ladder.together", 12, false, contact_together},
                                                   {"ladder.boundary", 150, false, contact_boundary}}};
constexpr std::array<Generator, 13> friction_table{{{"uniform", 30, true, friction_uniform},
                                                    {"bits", 10, false, friction_bits},
                                                    {"lattice", 12, false, friction_lattice},
                                                    {"ladder.feature", 14, false, friction_feature},
                                                    {"ladder.needle", 8, false, friction_needle},
                                                    {"ladder.parallel", 8, false, friction_parallel},
                                                    {"ladder.distance", 10, false, friction_distance},
                                                    {"ladder.still", 10, false, friction_still},
                                                    {"ladder.limit", 8, false, friction_limit},
                                                    {"ladder.lift", 8, false, friction_lift},
                                                    {"ladder.variants", 20, false, friction_variants},
                                                    {"ladder.together", 12, false, friction_together},
                                                    {"ladder.boundary", 140, false, friction_boundary}}};

}  // namespace

std::span<const Generator> contact_force_generators() { return contact_table; }
std::span<const Generator> friction_force_generators() { return friction_table; }

}  // namespace ogc::compare
