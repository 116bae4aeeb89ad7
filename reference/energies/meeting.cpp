#include "reference/energies/meeting.hpp"

#include <algorithm>
#include <cmath>

#include "reference/energies/mollifier.hpp"
#include "reference/energies/overlap_share.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"

namespace ogc::reference {
namespace {

using compare::ContactForceCase;
using compare::ContactSides;

/// The position of the contact points: the weights of a triangle's second and third corner, or the parameters on both
/// edges, 0 at end 0 and 1 at end 1.
using Parameters = std::array<Input, 2>;
using Vertices = std::array<Triple<Input>, 4>;

const Input zero(0.0), one(1.0);

/// Returns the parameter of the point of the line ab closest to p.
Input foot(const Triple<Input>& p, const Triple<Input>& a, const Triple<Input>& b) {
  const Triple<Input> e = b - a;
  return dot(p - a, e) / dot(e, e);
}

/// Returns the clamped parameter `end`, which is 0 or 1. If the unclamped parameter `free` is within rounding of `end`,
/// the result has the derivatives of `free`, because rounding may leave the parameter unclamped.
Input at_end(const Inputs& inputs, Input free, double end) {
  if (!(std::abs(free.value - end) <= compare::contact_grey * compare::unit_roundoff * inputs.condition({&free, 1})))
    return Input(end);
  free.value = end;
  return free;
}

/// Returns the weights of the second and third corner at the foot of point x[0] in the triangle's plane.
Parameters in_plane(const Vertices& x) {
  const auto &p = x[0], &a = x[1], &b = x[2], &c = x[3];
  const Triple<Input> n = cross(b - a, c - a);
  const Input area = dot(n, n);
  return {dot(cross(p - a, c - a), n) / area, dot(cross(b - a, p - a), n) / area};
}

Parameters on_triangle(const Inputs& inputs, TriangleFeature feature, const Vertices& x) {
  const auto &p = x[0], &a = x[1], &b = x[2], &c = x[3];
  const auto none = [&](const Input& free) { return at_end(inputs, free, 0); };
  const Parameters plane = in_plane(x);
  switch (feature) {
    case TriangleFeature::corner_0: return {none(foot(p, a, b)), none(foot(p, a, c))};
    case TriangleFeature::corner_1: return {one - none(foot(p, b, a)) - none(foot(p, b, c)), none(foot(p, b, c))};
    case TriangleFeature::corner_2: return {none(foot(p, c, b)), one - none(foot(p, c, a)) - none(foot(p, c, b))};
    case TriangleFeature::edge_01: return {foot(p, a, b), none(plane[1])};
    case TriangleFeature::edge_12: return {foot(p, c, b), foot(p, b, c) - none(one - plane[0] - plane[1])};
    case TriangleFeature::edge_20: return {none(plane[0]), foot(p, a, c)};
    case TriangleFeature::interior: break;
  }
  return plane;
}

std::vector<Parameters> all_on_triangle(const Inputs& inputs, const ContactForceCase& q, const Vertices& x) {
  const Corners corners{q.vertex[1], q.vertex[2], q.vertex[3]};
  const TriangleFeature closest = closest_feature(corners, q.vertex[0]);
  const unsigned possible = possible_features(corners, q.vertex[0]);
  std::vector<Parameters> all{on_triangle(inputs, closest, x)};
  for (unsigned f = 0; f < 7; ++f) {
    const auto feature = static_cast<TriangleFeature>(f);
    if (feature != closest && (possible >> f & 1) != 0) all.push_back(on_triangle(inputs, feature, x));
  }
  return all;
}

/// Returns the accepted parameters of the closest point of a segment, the exact one first. On a collapsed segment, this
/// is end 0.
std::vector<Parameters> all_on_segment(const Inputs& inputs, const ContactForceCase& q, const Vertices& x) {
  const Vec3f &p = q.vertex[0], &a = q.vertex[1], &b = q.vertex[2];
  std::array<Membership, 3> membership;
  require(membership[0], {along(a, b, p), false});
  require(membership[1], {along(b, a, p), false});
  require(membership[2], {along(a, b, p), true});
  require(membership[2], {along(b, a, p), true});
  const auto parameters = [&](std::size_t feature) {
    const Input free = foot(x[0], x[1], x[2]);
    return Parameters{feature == 2 ? free : at_end(inputs, free, static_cast<double>(feature)), zero};
  };
  const std::size_t closest = membership[0].exact ? 0 : membership[1].exact ? 1 : 2;
  std::vector<Parameters> all{parameters(closest)};
  for (std::size_t feature = 0; feature < 3; ++feature) {
    if (feature != closest && membership[feature].possible && !membership[closest].certain)
      all.push_back(parameters(feature));
  }
  return all;
}

/// Returns the parameter of the closest point on the first of two edges. `feature` and `other` are the closest features
/// of the first and the second edge; `skew` is whether the lines of the edges have unique closest points.
Input on_edge(const Inputs& inputs, bool skew, EdgeFeature feature, const Triple<Input>& u0, const Triple<Input>& u1,
              EdgeFeature other, const Triple<Input>& v0, const Triple<Input>& v1) {
  if (!skew && feature != EdgeFeature::interior && other == EdgeFeature::interior)
    return feature == EdgeFeature::end_1 ? one : zero;
  const Triple<Input> v = v1 - v0, n = cross(u1 - u0, v);
  const Input free = other == EdgeFeature::interior ? dot(cross(v0 - u0, v), n) / dot(n, n)
                                                    : foot(other == EdgeFeature::end_1 ? v1 : v0, u0, u1);
  return feature == EdgeFeature::interior ? free : at_end(inputs, free, feature == EdgeFeature::end_1 ? 1 : 0);
}

Parameters on_edges(const Inputs& inputs, bool skew, EdgeFeatures features, const Vertices& x) {
  return {on_edge(inputs, skew, features.first, x[0], x[1], features.second, x[2], x[3]),
          on_edge(inputs, skew, features.second, x[2], x[3], features.first, x[0], x[1])};
}

/// Returns the parameters by the rule for nearly parallel edges: the middle of the overlap on the first edge, and its
/// projection on the second.
Parameters middle_of_overlap(const Vertices& x) {
  const Input s = Input(0.5) * (within_unit(foot(x[2], x[0], x[1])) + within_unit(foot(x[3], x[0], x[1])));
  return {s, within_unit(foot(x[0] + s * (x[1] - x[0]), x[2], x[3]))};
}

std::vector<Parameters> all_on_edges(const Inputs& inputs, const ContactForceCase& q, const Vertices& x) {
  const EdgePair pair{{q.vertex[0], q.vertex[1]}, {q.vertex[2], q.vertex[3]}};
  const EdgeFeatures closest = closest_features(pair), interiors{EdgeFeature::interior, EdgeFeature::interior};
  const Membership rule = are_nearly_parallel(pair);
  if (rule.certain) return {middle_of_overlap(x)};
  std::vector<Parameters> all;
  if (rule.exact) all.push_back(middle_of_overlap(x));
  // Nearly parallel edges whose interiors hold the closest points overlap, so the rule for nearly parallel edges
  // applies. The intersection of their lines is then not computed.
  const Margin angle = parallel(q.vertex[0], q.vertex[1], q.vertex[2], q.vertex[3]);
  const bool is_small = sign(angle) < 0 && !grey(angle), certain = are_closest(pair, closest).certain;
  if (!(is_small && closest == interiors)) all.push_back(on_edges(inputs, !is_small, closest, x));
  if (!rule.exact && rule.possible) all.push_back(middle_of_overlap(x));
  for (int k = 0; k < edge_feature_pairs && !certain; ++k) {
    const EdgeFeatures other = edge_features(k);
    if (other == closest || (is_small && other == interiors)) continue;
    if (are_closest(pair, other).possible) all.push_back(on_edges(inputs, !is_small, other, x));
  }
  return all;
}

std::vector<Parameters> all_parameters(const Inputs& inputs, const ContactForceCase& q, const Vertices& x) {
  switch (q.sides) {
    case ContactSides::point_edge: return all_on_segment(inputs, q, x);
    case ContactSides::edge_edge: return all_on_edges(inputs, q, x);
    case ContactSides::point_triangle: return all_on_triangle(inputs, q, x);
    case ContactSides::point_point: break;
  }
  return {{zero, zero}};
}

std::array<Input, 4> weights(ContactSides sides, const Input& first, const Input& second) {
  switch (sides) {
    case ContactSides::point_edge: return {one, first - one, -first, zero};
    case ContactSides::edge_edge: return {one - first, first, second - one, -second};
    case ContactSides::point_triangle: return {one, first + second - one, -first, -second};
    case ContactSides::point_point: break;
  }
  return {one, -one, zero, zero};
}

/// Returns e_k as one input. The scale of its error is the sum of
///
///  - its condition, which is 0 for parallel edges,
///  - the square of the error of the normal e × e': 4 u ‖e‖‖e'‖ (u = 2⁻²⁴), from two products and a difference of
///    rounded edges.
Input mollified(const ContactForceCase& q, Inputs& inputs) {
  Inputs own;
  const Triple<Input> e = own.vector(q.previous[1], q.previous[0]), f = own.vector(q.previous[3], q.previous[2]);
  const Mollifier<Input> mollifier(e, f, own.number(q.rest_squared[0]), own.number(q.rest_squared[1]));
  if (!mollifier.acts()) return one;
  const Input result = mollifier.value();
  const double square = 2 * 16 * compare::unit_roundoff * dot(e, e).value * dot(f, f).value / mollifier.limit.value;
  return inputs.number(result.value, own.condition({&result, 1}) + square);
}

/// Returns e_k of nearly parallel loose edges: their overlap share.
Input shared(const ContactForceCase& q, Inputs& inputs) {
  Inputs own;
  const auto& x = q.previous;
  const Triple<Input> first = own.vector(x[1], x[0]), start = own.vector(x[2], x[0]), end = own.vector(x[3], x[0]);
  const Input result = overlap_share(first, end - start, start);
  return inputs.number(result.value, own.condition({&result, 1}));
}

/// Returns the exact e_k first. If rounding may change whether the edges are nearly parallel, the other e_k follows.
std::vector<Input> energy_shares(const ContactForceCase& q, Inputs& inputs) {
  if (q.sides != ContactSides::edge_edge) return {one};
  if (q.rest_squared[0] > 0 && q.rest_squared[1] > 0) return {mollified(q, inputs)};
  if (q.rest_squared[0] != 0 || q.rest_squared[1] != 0) return {one};
  const Membership rule = are_nearly_parallel({{q.previous[0], q.previous[1]}, {q.previous[2], q.previous[3]}});
  if (!rule.possible) return {one};
  const Input share = shared(q, inputs);
  if (rule.certain) return {share};
  return rule.exact ? std::vector{share, one} : std::vector{one, share};
}

/// Returns the vertices relative to an origin: end 0 of the first edge, or the second side's first vertex if the first
/// side is a point.
Vertices relative(ContactSides sides, const std::array<Vec3f, 4>& at, Inputs& inputs) {
  Vertices vertices;
  const std::size_t base = sides == ContactSides::edge_edge ? 0 : 1;
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(sides)); ++k)
    if (k != base) vertices[k] = inputs.vector(at[k], at[base]);
  return vertices;
}

/// Returns a Meeting with vertices, radius, stiffness k_c and activation of the case. Its weights, which place the
/// contact points, and the factor e_k of its stiffness are not yet set.
Meeting begun(const ContactForceCase& q) {
  Meeting meeting;
  meeting.vertex = relative(q.sides, q.vertex, meeting.inputs);
  meeting.contact_radius = meeting.inputs.number(q.contact_radius);
  meeting.stiffness = meeting.inputs.number(q.stiffness);
  meeting.activation = q.activation;
  return meeting;
}

void measure(Meeting& meeting) {
  const Triple<Input> apart = meeting.separation();
  meeting.distance = sqrt(dot(apart, apart));
  constexpr double factor = compare::contact_grey * compare::unit_roundoff;
  meeting.doubt = factor * meeting.inputs.condition(apart);
  meeting.distance_doubt = factor * meeting.inputs.condition({&meeting.distance, 1});
}

/// Returns whether the triangle's height h is below 2⁻⁹ of its longest edge (a needle), or one edge is below 2⁻⁹ of the
/// other. In units of the longest edge, the foot of a point at distance d from the triangle has an error of u d/h (u =
/// 2⁻²⁴). For h = 2⁻⁹ and d = 3 this error is 3/64 of h.
bool has_needle(const ContactForceCase& q, const Vertices& x) {
  constexpr double least_squared = 0x1p-18;
  const auto squared = [&](std::size_t a, std::size_t b) { return dot(x[a] - x[b], x[a] - x[b]).value; };
  if (q.sides == ContactSides::edge_edge) {
    const double e = squared(0, 1), f = squared(2, 3);
    return std::min(e, f) > 0 && std::min(e, f) < least_squared * std::max(e, f);
  }
  if (q.sides != ContactSides::point_triangle) return false;
  const Triple<Input> n = cross(x[2] - x[1], x[3] - x[1]);
  const double longest = std::max({squared(1, 2), squared(2, 3), squared(3, 1)});
  return dot(n, n).value < least_squared * longest * longest;
}

bool near_features(const ContactForceCase& q) {
  const auto& x = q.vertex;
  switch (q.sides) {
    case ContactSides::point_edge:
      return examine(along(x[1], x[2], x[0])).near || examine(along(x[2], x[1], x[0])).near;
    case ContactSides::edge_edge: {
      const EdgePair pair{{x[0], x[1]}, {x[2], x[3]}};
      return is_near_decision(pair, closest_features(pair), are_nearly_parallel(pair).exact);
    }
    case ContactSides::point_triangle: {
      const Corners corners{x[1], x[2], x[3]};
      return near_feature(corners, closest_feature(corners, x[0]), x[0]);
    }
    case ContactSides::point_point: break;
  }
  return false;
}

Input modulus(const Input& x) { return x.value < 0 ? -x : x; }

/// Returns the weight of the own vertex, then the weights of the vertices that are updated with it.
std::vector<Input> updated_weights(const Meeting& meeting, const ContactForceCase& q) {
  const auto own = static_cast<std::size_t>(q.own);
  std::vector<Input> all{meeting.weight[own]};
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(q.sides)); ++k)
    if (k != own && (q.together >> k & 1) != 0) all.push_back(meeting.weight[k]);
  return all;
}

}  // namespace

Input Meeting::majorant(const ContactForceCase& question) const {
  const std::vector<Input> all = updated_weights(*this, question);
  Input sum = zero;
  for (const Input& w : all) sum = sum + modulus(w);
  return modulus(all.front()) * sum;
}

Triple<Input> Meeting::separation() const {
  Triple<Input> sum;
  for (std::size_t k = 0; k < 4; ++k) sum = sum + weight[k] * vertex[k];
  return sum;
}

double Meeting::slope_doubt() const {
  if (!form_of(activation).ends_flat || std::abs(distance.value - contact_radius.value) > 2 * distance_doubt) return 0;
  const Derivative<double, 1> d(std::max(0x1p-23 * contact_radius.value, contact_radius.value - 3 * distance_doubt), 0);
  return -activation_energy(activation, d, contact_radius.value, stiffness.value).slope[0];
}

namespace {

/// Sets the weights. Each parameter gets an error of u = 2⁻²⁴ in addition to the errors of its inputs.
void weigh(Meeting& meeting, ContactSides sides, const Parameters& at) {
  const bool has_parameters = sides != ContactSides::point_point;
  const Input first = has_parameters ? meeting.inputs.number(0, 1) : zero,
              second = has_parameters ? meeting.inputs.number(0, 1) : zero;
  meeting.weight = weights(sides, at[0] + first, at[1] + second);
}

/// Returns one copy of `common` for each accepted position of the contact points, with the weights of this position.
std::vector<Meeting> weighed(const ContactForceCase& question, Meeting common) {
  std::vector<Meeting> all;
  common.needle = has_needle(question, common.vertex);
  for (const Parameters& at : all_parameters(common.inputs, question, common.vertex))
    weigh(all.emplace_back(common), question.sides, at);
  return all;
}

}  // namespace

std::vector<Meeting> meetings(const ContactForceCase& question) {
  Meeting common = begun(question);
  const std::vector<Input> shares = energy_shares(question, common.inputs);
  const std::vector<Meeting> of_whole = weighed(question, common);
  std::vector<Meeting> result;
  for (const Input& share : shares) {
    for (const Meeting& of_one : of_whole) {
      Meeting& meeting = result.emplace_back(of_one);
      meeting.stiffness = of_one.stiffness * share;
      measure(meeting);
    }
  }
  for (std::size_t i = 0, count = result.size(); i < count; ++i) {
    if (!result[i].may_jump()) continue;
    result.push_back(result[i]);
    result.back().across = true;
  }
  return result;
}

bool is_near_decision(const ContactForceCase& question, const Meeting& exact) {
  const double width = exact.distance_doubt * (compare::near_factor / (compare::contact_grey * compare::unit_roundoff));
  const auto near = [&](double place) { return std::abs(exact.distance.value - place) <= width; };
  const bool has_stages = form_of(question.activation).has_stages;
  return near(exact.contact_radius.value) || (has_stages && near(0.5 * exact.contact_radius.value)) ||
         near_features(question);
}

LargestSlopes largest_slopes(const ContactForceCase& question, double distance) {
  using Once = Derivative<double, 1>;
  using Twice = Derivative<Once, 1>;
  const double r = question.contact_radius;
  LargestSlopes largest;
  // −g' decreases with the distance. Only for ogc_as_printed it also jumps at τ = r/2, so τ is examined, too.
  for (const double d : {std::clamp(distance, 0x1p-23 * r, r), std::clamp(distance, 0.5 * r, r)}) {
    const Twice g = activation_energy(question.activation, Twice(Once(d, 0), 0), r, double{question.stiffness});
    largest = {std::max(largest.first, -g.value.slope[0]), std::max(largest.second, g.slope[0].slope[0])};
  }
  return largest;
}

std::vector<compare::ForceAnswer> answers(const std::vector<Meeting>& meetings, Ends end,
                                          const std::function<compare::ForceAnswer(double)>& largest,
                                          const std::function<compare::ForceAnswer(const Meeting&)>& acting) {
  std::vector<compare::ForceAnswer> all;
  bool none = false, any = false;
  double nearest = 0;
  for (const Meeting& meeting : meetings) {
    const bool is_apart = meeting.distance.value > 0, has_end = end == Ends::at_radius;
    const bool acts = has_end ? meeting.acts() : is_apart, ends = has_end && is_apart && meeting.may_end();
    if (!acts && all.empty()) {
      all.push_back({});
      none = true;
    }
    if (acts || ends) all.push_back(acting(meeting));
    none = none || !acts || ends;
    // On a needle, rounding may move the contact points elsewhere, to any larger distance.
    const bool touches = meeting.doubt > 0 && meeting.may_touch(), of_needle = meeting.needle && (acts || ends);
    const double distance = touches ? 0 : meeting.distance.value - meeting.distance_doubt;
    if (touches || of_needle) nearest = any ? std::min(nearest, distance) : distance;
    any = any || touches || of_needle;
  }
  if (none && meetings.front().distance.value > 0 && (end == Ends::nowhere || meetings.front().acts()))
    all.push_back({});
  if (any) all.push_back(largest(nearest));
  return all;
}

double reach(const Inputs& inputs, std::span<const Input> answer) {
  double squared = 0;
  for (const Input& x : answer) squared += x.value * x.value;
  return std::sqrt(squared) + compare::contact_grey * compare::unit_roundoff * inputs.condition(answer);
}

void add_weight_error(const Meeting& meeting, const ContactForceCase& question, double force, double curvature,
                      compare::ForceAnswer& answer) {
  const Input& own = meeting.weight[static_cast<std::size_t>(question.own)];
  const std::vector<Input> all = updated_weights(meeting, question);
  const bool is_exact = std::all_of(all.begin(), all.end(), [&](const Input& w) {
    return meeting.inputs.condition({&w, 1}) == 0;
  });
  if (is_exact) return;
  double worst = 0, sum = 0;
  for (const Input& w : meeting.weight) worst = std::max(worst, meeting.inputs.condition({&w, 1}));
  for (const Input& w : all) sum += std::abs(w.value);
  const auto n = static_cast<double>(all.size());
  if (meeting.inputs.condition({&own, 1}) > 0) answer.force_scale += force * worst;
  const double second_order = compare::contact_grey * compare::unit_roundoff * worst;
  answer.block_scale += curvature * worst * (sum + n * std::abs(own.value) + n * second_order);
}

}  // namespace ogc::reference
