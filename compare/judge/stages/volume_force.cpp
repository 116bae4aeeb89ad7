// Makes the traits of stage volume_force. In the canonical frame the point c of the volume's triangle is at the origin
// and the direction n out of the volume along z, so that φ and the slip along n are single coordinates. Ladders
// approach
// - φ = r, a slip of 0, a slip of ε_v h, and motion along n,
// - weights of 0 (edges and corners of the volume),
// - depths of many radii, and very small and very large cases.
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/judge/cases/placement.hpp"
#include "compare/judge/stages/force_forms.hpp"
#include "compare/judge/stages/force_stage.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

constexpr float least_slip_limit = 0x1p-38f, least_weight = 0x1p-40f;

/// A contact in its canonical frame.
struct Pressed {
  double size = 1, contact_radius = 1;    ///< about the length of an edge, and r
  std::array<Vec3, 4> x{};                ///< x₀, and the corners
  std::array<Vec3, 4> moved{};            ///< x − xᵗ
  std::array<float, 3> weights{1, 0, 0};  ///< weights of the triangle's point c
  Vec3 direction{0, 0, 1};                ///< n
  double slip_limit = 1;                  ///< ε_v h
  bool turned = true;                     ///< true if it may be rotated
};

/// Returns three weights, whose sum is 1 up to rounding. `second` and `third` are two of them.
std::array<float, 3> weights_of(double second, double third) {
  const auto b = static_cast<float>(second), c = static_cast<float>(third);
  const float a = std::max(0.0f, 1.0f - b - c);
  const auto legal = [](float w) { return w < least_weight ? 0.0f : w; };
  return {legal(a), legal(b), legal(c)};
}

Vec3 some_direction(Random& random) {
  const double height = random.between(-1, 1), turn = random.between(0, 6.283185307179586),
               ring = std::sqrt(1 - height * height);
  return {ring * std::cos(turn), ring * std::sin(turn), height};
}

/// Puts the triangle's point with these weights at the origin, and x₀ at `height` along n.
void put(Random& random, Pressed& p, const std::array<float, 3>& weights, double height) {
  p.weights = weights;
  const double lean = random.between(-0.3, 1.3), width = random.magnitude(-1, 0.3);
  const Vec3 second{p.size, 0, 0}, third{lean * p.size, width * p.size, 0};
  const Vec3 foot = sum(scaled(second, weights[1]), scaled(third, weights[2]));
  p.x = {Vec3{}, scaled(foot, -1), sum(second, scaled(foot, -1)), sum(third, scaled(foot, -1))};
  if (random.one_in(2)) p.direction = some_direction(random);  // at ridges n is not the triangle's normal
  p.x[0] = scaled(p.direction, height);
}

/// Returns the weights of a point in the interior, on an edge or at a corner.
std::array<float, 3> some_weights(Random& random) {
  const double s = random.unit(), t = random.unit();
  std::array<float, 3> weights = random.one_in(3) ? weights_of(s, 0) : weights_of(s * (1 - t), s * t);
  if (random.one_in(8)) weights = {1, 0, 0};
  std::rotate(weights.begin(), weights.begin() + random.below(3), weights.end());
  return weights;
}

Pressed sized(Random& random) {
  Pressed p;
  p.size = random.magnitude(-3, 0);
  p.contact_radius = p.size * random.magnitude(-0.5, 0.5);
  p.slip_limit = p.size * random.magnitude(-5, -1);
  return p;
}

/// Makes x₀ slip by `along` and lift by `lift` relative to the triangle, in units of ε_v h. All vertices also share a
/// random motion.
void move(Random& random, Pressed& p, double along, double lift) {
  const Vec3 helper = std::abs(p.direction.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n = p.direction;
  const double inner = helper.x * n.x + helper.y * n.y + helper.z * n.z;
  Vec3 tangent = sum(helper, scaled(n, -inner));
  tangent = scaled(tangent, 1 / std::hypot(tangent.x, tangent.y, tangent.z));
  const Vec3 across{n.y * tangent.z - n.z * tangent.y, n.z * tangent.x - n.x * tangent.z,
                    n.x * tangent.y - n.y * tangent.x};
  const double angle = random.between(0, 6.283185307179586);
  const Vec3 slip = sum(sum(scaled(tangent, std::cos(angle) * along), scaled(across, std::sin(angle) * along)),
                        scaled(n, lift));
  const Vec3 common = random.one_in(2) ? Vec3{} : scaled(in_box(random, -1, 1), p.size * random.magnitude(-4, -1));
  for (Vec3& m : p.moved) m = common;
  p.moved[0] = sum(common, scaled(slip, p.slip_limit));
}

/// Moves all vertices away from their positions at the detection, so that φ is not the distance of closest points.
void drift(Random& random, Pressed& p) {
  const double step = p.size * random.magnitude(-4, -1);
  for (Vec3& x : p.x) x = sum(x, scaled(in_box(random, -1, 1), step));
}

/// Moves the contact out of its canonical frame, by one symmetry and, in half of the cases, one rotation of points and
/// direction.
VolumeForceCase placed(Random& random, const Pressed& p) {
  std::array<Vec3, 10> points;
  for (std::size_t k = 0; k < 4; ++k) {
    points[k] = p.x[k];
    points[4 + k] = sum(p.x[k], scaled(p.moved[k], -1));
  }
  points[8] = Vec3{};
  points[9] = p.direction;
  permute(random, points);
  if (p.turned && random.one_in(2)) rotate(random, points);
  VolumeForceCase question;
  for (std::size_t k = 0; k < 4; ++k) {
    question.vertex[k] = single(points[k]);
    question.start[k] = single(points[4 + k]);
  }
  const Vec3 n = sum(points[9], scaled(points[8], -1)), unit = scaled(n, 1 / std::hypot(n.x, n.y, n.z));
  question.direction = {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)};
  question.weights = p.weights;
  question.own = random.below(4);
  question.contact_radius = std::clamp(static_cast<float>(p.contact_radius), least_length, most_length);
  question.stiffness = static_cast<float>(random.magnitude(-1, 4));
  question.friction = random.one_in(8) ? 0.0f : static_cast<float>(random.between(0.01, 1.5));
  question.slip_limit = std::clamp(static_cast<float>(p.slip_limit), least_slip_limit, most_length);
  return question;
}

/// Returns φ/r: below 0 (inside), between 0 and 1, or above 1 (farther than r).
double some_share(Random& random) { return random.between(-3, 1.2); }

Pressed pressed(Random& random, double share) {
  Pressed p = sized(random);
  put(random, p, some_weights(random), p.contact_radius * share);
  return p;
}

CaseData uniform(Random& random) {
  Pressed p = pressed(random, some_share(random));
  if (random.one_in(2)) drift(random, p);
  move(random, p, random.between(0, 3), random.between(-1, 1));
  return placed(random, p);
}

/// Takes random bits for coordinates, radii, stiffnesses and limits.
CaseData bits(Random& random) {
  VolumeForceCase question;
  const std::array<Vec3, 4> now = points_of_bits(random), before = points_of_bits(random);
  for (std::size_t k = 0; k < 4; ++k) {
    question.vertex[k] = single(now[k]);
    question.start[k] = random.one_in(2) ? single(before[k]) : question.vertex[k];
  }
  question.weights = some_weights(random);
  const Vec3 n = some_direction(random);
  question.direction = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
  question.own = random.below(4);
  question.contact_radius = random.pattern();
  question.stiffness = random.pattern();
  question.friction = random.pattern(0x1p-20f, 1);
  question.slip_limit = random.pattern();
  return question;
}

/// Makes cases without rounding errors, so that φ = r, ‖u‖ = ε_v h and ‖u‖ = 0 occur exactly.
CaseData lattice(Random& random) {
  Pressed p;
  p.size = std::ldexp(1.0, random.below(9) - 8);
  p.contact_radius = p.size * (1 + random.below(4));
  for (Vec3& x : p.x) x = scaled(on_lattice(random, 2), p.size);
  for (Vec3& m : p.moved) m = random.one_in(2) ? Vec3{} : scaled(on_lattice(random, 1), p.size / 8);
  const double second = 0.25 * random.below(4);
  p.weights = weights_of(second, (1 - second) * random.below(2));
  p.slip_limit = std::ldexp(p.size, -random.below(8));
  p.turned = false;
  return placed(random, p);
}

/// Approaches φ = r.
Pressed at_radius(Random& random) { return pressed(random, 1 + random.rung()); }

CaseData radius(Random& random) {
  Pressed p = at_radius(random);
  move(random, p, random.between(0, 3), random.between(-1, 1));
  return placed(random, p);
}

/// Approaches ‖u‖ = ε_v h.
CaseData limit(Random& random) {
  Pressed p = pressed(random, random.between(-3, 0.9));
  move(random, p, 1 + random.rung(), random.one_in(2) ? 0 : random.between(-1, 1));
  return placed(random, p);
}

/// Approaches ‖u‖ = 0.
CaseData still(Random& random) {
  Pressed p = pressed(random, random.between(-3, 0.9));
  move(random, p, random.rung(), random.one_in(2) ? 0 : random.between(-1, 1));
  return placed(random, p);
}

/// Makes displacements whose component along n is 1 to 10⁴ times ε_v h.
CaseData lift(Random& random) {
  Pressed p = pressed(random, some_share(random));
  move(random, p, random.one_in(2) ? 0 : random.between(0, 3), random.magnitude(0, 4));
  return placed(random, p);
}

/// Makes depths of many radii.
CaseData deep(Random& random) {
  Pressed p = pressed(random, -random.magnitude(0, 3));
  move(random, p, random.between(0, 3), random.between(-1, 1));
  return placed(random, p);
}

/// Approaches weights of 0 and 1.
CaseData corner(Random& random) {
  Pressed p = sized(random);
  std::array<float, 3> weights = weights_of(random.magnitude(-12, -1),
                                            random.one_in(2) ? 0 : random.magnitude(-12, -1));
  std::rotate(weights.begin(), weights.begin() + random.below(3), weights.end());
  put(random, p, weights, p.contact_radius * some_share(random));
  move(random, p, random.between(0, 3), random.between(-1, 1));
  return placed(random, p);
}

/// Scales a case by 2^±10 or 2^±20, within legal limits of r and ε_v h.
CaseData units(Random& random) {
  constexpr std::array<double, 4> scales{0x1p-20, 0x1p-10, 0x1p10, 0x1p20};
  const double scale = random.pick(std::span<const double>(scales));
  Pressed p = pressed(random, random.one_in(2) ? 1 + random.rung() : some_share(random));
  move(random, p, random.one_in(2) ? 1 + random.rung() : random.between(0, 3), random.between(-1, 1));
  for (Vec3& x : p.x) x = scaled(x, scale);
  for (Vec3& m : p.moved) m = scaled(m, scale);
  p.contact_radius *= scale;
  p.slip_limit *= scale;
  p.turned = random.one_in(2) && scale > 1;  // placed() shifts rotated points by about 1 m
  return placed(random, p);
}

/// Makes cases near φ = r or ‖u‖ = ε_v h.
CaseData boundary(Random& random) {
  random.be_fine();
  return random.one_in(2) ? radius(random) : limit(random);
}

constexpr std::array<Generator, 12> table{{{"uniform", 30, true, uniform},
                                           {"bits", 10, false, bits},
                                           {"dust", 8, false, uniform},
                                           {"lattice", 14, false, lattice},
                                           {"ladder.radius", 10, false, radius},
                                           {"ladder.limit", 8, false, limit},
                                           {"ladder.still", 10, false, still},
                                           {"ladder.lift", 8, false, lift},
                                           {"ladder.deep", 8, false, deep},
                                           {"ladder.weight", 10, false, corner},
                                           {"ladder.units", 12, false, units},
                                           {"ladder.boundary", 150, false, boundary}}};

std::vector<WrongForm> volume_force_forms() {
  constexpr auto stage = &Authority::volume_force;
  std::vector<WrongForm> forms = common_forms(stage);
  const auto changed = [&](const char* name, const char* meaning, void (*change)(VolumeForceCase&)) {
    forms.push_back(case_asked(name, meaning, stage, change));
  };
  changed("direction_flipped", "−n for n", [](VolumeForceCase& c) {
    for (float& x : c.direction) x = -x;
  });
  changed("radius_missing", "the depth without r: 0 − φ for r − φ", [](VolumeForceCase& c) { c.contact_radius = 0; });
  changed("friction_missing", "without friction", [](VolumeForceCase& c) { c.friction = 0; });
  changed("slip_since_now", "slip since the present position, not since the start of the step: none",
          [](VolumeForceCase& c) { c.start = c.vertex; });
  changed("slip_of_the_point_alone", "the motion of the volume left out of the slip", [](VolumeForceCase& c) {
    for (std::size_t k = 1; k < 4; ++k) c.start[k] = c.vertex[k];
  });
  changed("smoothing_missing", "f₁ is 1 below the slip limit, too",
          [](VolumeForceCase& c) { c.slip_limit *= 0x1p-24f; });
  changed("weights_rotated", "the weight of the next corner",
          [](VolumeForceCase& c) { std::rotate(c.weights.begin(), c.weights.begin() + 1, c.weights.end()); });
  changed("weights_rotated_back", "the weight of the corner before",
          [](VolumeForceCase& c) { std::rotate(c.weights.begin(), c.weights.begin() + 2, c.weights.end()); });
  changed("weights_swapped_01", "the weights of corners 0 and 1 exchanged",
          [](VolumeForceCase& c) { std::swap(c.weights[0], c.weights[1]); });
  changed("weights_swapped_12", "the weights of corners 1 and 2 exchanged",
          [](VolumeForceCase& c) { std::swap(c.weights[1], c.weights[2]); });
  changed("weights_swapped_02", "the weights of corners 0 and 2 exchanged",
          [](VolumeForceCase& c) { std::swap(c.weights[0], c.weights[2]); });
  changed("friction_squared", "μ² for μ", [](VolumeForceCase& c) { c.friction *= c.friction; });
  forms.push_back(form("ones_for_identity",
                       "friction's block from a matrix full of ones where I belongs: 1 − n nᵀ for I − n nᵀ", stage,
                       [](const std::function<ForceTruth(const VolumeForceIn&)>& right, const VolumeForceIn& in) {
                         ForceTruth truth = right(in);
                         VolumeForceIn smooth = in;
                         for (VolumeForceCase& c : smooth.cases) c.friction = 0;
                         const ForceTruth without = right(smooth);
                         for (std::size_t i = 0; i < truth.accepted.size(); ++i)
                           for (ForceAnswer& answer : truth.accepted[i])
                             add_ones(answer, (trace(answer) - trace(without.accepted[i][0])) / 2);
                         return truth;
                       }));
  return forms;
}

/// Makes a case from a contact of a frame. x₀ is the contact's first vertex, and the triangle's corners are its other
/// vertices. If there are fewer than three others, the last one is repeated. The weights of the triangle's point are
/// random.
VolumeForceCase of_contact(const FrictionForceCase& f, Random& random) {
  VolumeForceCase c;
  const auto count = static_cast<std::size_t>(vertex_count(f.contact.sides));
  for (std::size_t k = 0; k < 4; ++k) {
    c.vertex[k] = f.contact.vertex[k < count ? k : count - 1];
    c.start[k] = f.start[k < count ? k : count - 1];
  }
  c.weights = some_weights(random);
  Vec3 apart{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f &x = c.vertex[0], &y = c.vertex[k + 1];
    apart = sum(apart, scaled({double{x.x} - y.x, double{x.y} - y.y, double{x.z} - y.z}, c.weights[k]));
  }
  const double length = std::hypot(apart.x, apart.y, apart.z);
  const Vec3 n = length > 0 ? scaled(apart, random.sign() / length) : some_direction(random);
  c.direction = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
  c.own = random.below(4);
  c.contact_radius = f.contact.contact_radius;
  c.stiffness = f.contact.stiffness;
  c.friction = f.friction;
  c.slip_limit = std::max(f.slip_limit, least_slip_limit);
  return c;
}

struct VolumeForce : ForceStage<VolumeForce, VolumeForceCase, &Contestant::volume_force, &Authority::volume_force>,
                     OfContacts {
  static constexpr StageInfo info{.name = "volume_force",
                                  .question = "force and block of one vertex of one contact with a volume",
                                  .unit = "stencil",
                                  .reference = "reference/energies/volume_force.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"force", "u cond", volume_force_tolerance},
                                      MetricInfo{"block", "u cond", volume_block_tolerance}};
  static constexpr ParameterInfo slip_limit{"slip", "slip limit ε_v h [m]", least_slip_limit, ranges::most};
  static constexpr std::array parameters{ranges::contact_radius, ranges::contact_stiffness, ranges::friction,
                                         slip_limit};
  static float* parameter(Case& c, std::string_view name) {
    return name == ranges::contact_radius.name      ? &c.contact_radius
           : name == ranges::contact_stiffness.name ? &c.stiffness
           : name == ranges::friction.name          ? &c.friction
                                                    : &c.slip_limit;
  }

  static std::span<const Generator> generators() { return table; }

  static void check(const Case& c, FirstProblem& problem) {
    problem.require(c.own >= 0 && c.own < 4, "no such vertex is asked about");
    problem.vectors("a coordinate", c.vertex);
    problem.vectors("a coordinate at the start", c.start);
    double whole = 0, square = 0;
    for (const float w : c.weights) {
      if (w != 0) problem.number("a weight", w, least_weight, 1);
      whole += w;
    }
    for (const float x : c.direction) square += double{x} * x;
    problem.require(std::abs(whole - 1) <= 0x1p-20, "the weights do not add up to 1");
    problem.require(std::abs(square - 1) <= 0x1p-22, "the direction is no unit vector");
    problem.number("a contact radius", c.contact_radius, least_length, most_length);
    problem.number("a stiffness", c.stiffness, 0x1p-30f, vast);
    problem.number("a friction coefficient", c.friction, 0, 0x1p10f);
    problem.number("a slip limit", c.slip_limit, least_slip_limit, most_length);
  }
  static void mutate(Random& random, Case& c) { mutate_together(random, c.vertex, c.start); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.vertex, c.start}); }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return of_contact(states.contact(states.contact_frame(index), random), random);
  }
  static Shape shape(const Case& c) {
    Shape shape;
    shape.add_all(c.vertex);
    shape.triangles = {{1, 2, 3}};
    shape.dots.push_back(c.own);
    return shape;
  }
  static std::vector<std::string> roles(const Case&) {
    return {"vertex 0, the point", "vertex 1, of the triangle", "vertex 2, of the triangle",
            "vertex 3, of the triangle"};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return volume_force_forms(); }
};

}  // namespace

constinit const StageTraits stages::volume_force = make_traits<VolumeForce>();

}  // namespace ogc::compare
