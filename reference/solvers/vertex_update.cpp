// Derives the error limit of an update. A right answer dx solves (H + δH) dx = f + δf with ‖δf‖ ≤ φ and ‖δH‖ ≤ η. With
// the exact dx* of H dx* = f, the eigenvectors vᵢ and eigenvalues λᵢ of H, and the smallest eigenvalue λ,
//
//   H (dx − dx*) = δf − δH dx,   |vᵢ·(dx − dx*)| ≤ (φ + η ‖dx‖)/λᵢ,   ‖dx‖ ≤ (‖dx*‖ + φ/λ)/(1 − η/λ).
//
// Storing the position x + dx adds an error of u ‖x + dx‖, u = 2⁻²⁴. The limit depends on truncation:
//
// - not cut: the limits above, along each eigenvector
// - may be cut by the ball: the largest of the three limits in all directions. The projection on the ball does not
//   increase distances, but it changes directions.
// - may be cut by half-spaces: no limit; the judge checks that the position is inside the region. If vertices do not
//   slide, the position must also be on the path from X_prev to the proposal, within the proposal's error.
#include "reference/solvers/vertex_update.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "compare/stages/truncate.hpp"
#include "reference/solvers/symmetric3.hpp"

namespace ogc::reference {
namespace {

using compare::Vec3;
using compare::Vec3f;

using reference::norm;

constexpr double u = compare::unit_roundoff, infinity = std::numeric_limits<double>::infinity();
/// If the accepted answers of a vertex's terms have more combinations than this, only the bound is checked.
constexpr std::size_t most_combinations = 4096;

Vec3 wide(const Vec3f& a) { return {a.x, a.y, a.z}; }
Vec3 plus(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 times(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
double inner(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double norm(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }

/// H and f for one choice among the accepted answers, with their errors η and φ. These errors include the error of
/// solving H dx = f.
struct System {
  Vec3 force;
  Symmetric3 block{};
  double force_error = 0, block_error = 0;
};

System system_of(const VertexTerms& terms, const FreeVertex& vertex, std::span<const std::size_t> choice) {
  const Vec3 pull = times(vertex.inertia, minus(wide(vertex.target), wide(vertex.old)));
  System sum{pull, {vertex.inertia, 0, 0, vertex.inertia, 0, vertex.inertia}};
  double errors_force = compare::sweep_inertia_tolerance * norm(pull), errors_block = vertex.inertia * std::sqrt(3.0);
  double moduli_force = norm(pull), moduli_block = norm(sum.block);
  for (std::size_t i = 0; i < terms.terms.size(); ++i) {
    const Term& term = terms.terms[i];
    const compare::ForceAnswer& answer = term.accepted[choice[i]];
    sum.force = plus(sum.force, answer.force);
    for (std::size_t k = 0; k < 6; ++k) sum.block[k] += answer.block[k];
    errors_force += term.force_tolerance * answer.force_scale + term.force_spread / u;
    // The stage's tolerance counts each entry off the diagonal once, but the matrix contains it twice.
    errors_block += term.block_tolerance * answer.block_scale * std::sqrt(2.0) + term.block_spread / u;
    moduli_force += norm(answer.force);
    moduli_block += norm(answer.block);
  }
  const auto additions = static_cast<double>(terms.terms.size() + 1);
  sum.force_error = u * (errors_force + additions * moduli_force);
  sum.block_error = u * (errors_block + compare::sweep_block_additions * additions * moduli_block);
  return sum;
}

/// Returns the point of the ball that is closest to x.
Vec3 projected(const Vec3& x, const FreeVertex& vertex) {
  const Vec3 step = minus(x, wide(vertex.previous));
  const double length = norm(step);
  return length > vertex.bound ? plus(wide(vertex.previous), times(vertex.bound / length, step)) : x;
}

/// Returns ‖X_prev‖_∞ + b_v.
double size_of(const FreeVertex& vertex) {
  const Vec3f& p = vertex.previous;
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) + vertex.bound;
}
double truncation_error(const FreeVertex& vertex) { return compare::truncate_position_tolerance * u * size_of(vertex); }
double region_error(const FreeVertex& vertex) { return compare::truncate_region_tolerance * u * size_of(vertex); }

/// Returns the point of the segment from X_prev to the proposal that is closest to x.
Vec3 nearest_on_way(const FreeVertex& vertex, const Vec3& proposal, const Vec3& x) {
  const Vec3 from = wide(vertex.previous), way = minus(proposal, from);
  const double square = inner(way, way);
  const double share = square > 0 ? std::clamp(inner(minus(x, from), way) / square, 0.0, 1.0) : 0;
  return plus(from, times(share, way));
}

/// Returns the largest distance of x beyond one of its half-spaces [m]: negative inside all of them, minus infinity if
/// there are none.
double beyond_planes(const FreeVertex& vertex, const Vec3& x) {
  double beyond = -infinity;
  for (const compare::VertexPlane& plane : vertex.planes) {
    const Vec3 n = wide(plane.normal);
    beyond = std::max(beyond, (inner(n, x) - plane.offset) / norm(n));
  }
  return beyond;
}

/// Returns the accepted error of a vertex whose block is so ill-conditioned that the exact position is unknown. The
/// error is infinite if the vertex may be cut, or if dx·f ≥ −‖dx‖(φ + η‖dx‖) for the stored position, up to its
/// rounding (φ, η: head of this file). Otherwise the answer is wrong, and the error is 0.
double accepted_without_position(const System& system, const FreeVertex& vertex, const Vec3f& answer) {
  const Vec3 moved = minus(wide(answer), wide(vertex.old));
  const bool may_be_cut = norm(minus(wide(answer), wide(vertex.previous))) + truncation_error(vertex) >= vertex.bound ||
                          beyond_planes(vertex, wide(answer)) + truncation_error(vertex) >= 0;
  if (may_be_cut) return infinity;
  const double stored = u * norm(wide(answer)), length = norm(moved) + stored;
  const double slack = length * (system.force_error + system.block_error * length) + stored * norm(system.force);
  return inner(moved, system.force) >= -slack ? infinity : 0;
}

/// Returns the largest accepted length of an error in the direction of `error`. The component of this error along the
/// i-th eigenvector may be at most `along[i]`.
double accepted_along(const Vec3& error, const Eigen3& eigen, const std::array<double, 3>& along) {
  double share = 0;
  for (std::size_t i = 0; i < 3; ++i) share = std::max(share, std::abs(inner(error, eigen.axis[i])) / along[i]);
  return share > 0 ? norm(error) / share : *std::min_element(along.begin(), along.end());
}

VertexUpdate update_with(const System& system, const FreeVertex& vertex, const Vec3f& answer) {
  const Eigen3 eigen = eigen_of(system.block);
  std::array<double, 3> stiffness;
  // All terms of the block except inertia are positive semidefinite, so no eigenvalue is below the inertia.
  for (std::size_t i = 0; i < 3; ++i) stiffness[i] = std::max(eigen.value[i], vertex.inertia);
  const auto [least, most] = std::minmax_element(stiffness.begin(), stiffness.end());
  Vec3 change;
  for (std::size_t i = 0; i < 3; ++i)
    change = plus(change, times(inner(system.force, eigen.axis[i]) / stiffness[i], eigen.axis[i]));
  const double block_error = system.block_error + u * compare::sweep_solve_tolerance * *most,
               relative = block_error / *least;
  const Vec3 proposal = plus(wide(vertex.old), change);
  VertexUpdate update{projected(proposal, vertex)};
  if (relative >= 0.5) {
    update.cut = Cut::doubtful;
    update.grey = true;
    update.accepted = accepted_without_position({system.force, system.block, system.force_error, block_error}, vertex,
                                                answer);
    return update;
  }
  const double length = (norm(change) + system.force_error / *least) / (1 - relative),
               numerator = system.force_error + block_error * length;
  // Adds the smallest positive number, which covers underflow.
  const double stored = u * (norm(proposal) + numerator / *least) + std::numeric_limits<float>::denorm_min();
  std::array<double, 3> along;
  for (std::size_t i = 0; i < 3; ++i) along[i] = numerator / stiffness[i] + stored;
  const double largest = numerator / *least + stored, reach = norm(minus(proposal, wide(vertex.previous)));
  const double beyond = beyond_planes(vertex, proposal), slack = largest + truncation_error(vertex);
  if (beyond > -slack) {
    update.cut = beyond > slack || reach - largest > vertex.bound ? Cut::yes : Cut::doubtful;
    update.accepted = infinity;
    if (!vertex.is_scaled) return update;
    update.position = nearest_on_way(vertex, proposal, wide(answer));
    update.accepted = largest + region_error(vertex);
    return update;
  }
  if (reach + largest <= vertex.bound) {
    update.accepted = accepted_along(minus(wide(answer), update.position), eigen, along);
    return update;
  }
  update.cut = reach - largest > vertex.bound ? Cut::yes : Cut::doubtful;
  const double shrunk = update.cut == Cut::yes ? vertex.bound / (reach - largest) : 1;
  update.accepted = shrunk * largest + truncation_error(vertex);
  return update;
}

/// Returns the answer's error divided by the accepted error.
double share_of(const VertexUpdate& update, const Vec3f& answer) {
  const double error = norm(minus(wide(answer), update.position));
  return error == 0 ? 0 : error / update.accepted;
}

/// Moves to the next choice among the accepted answers of all terms; returns false after the last one.
bool advance(std::vector<std::size_t>& choice, const VertexTerms& terms) {
  for (std::size_t i = 0; i < choice.size(); ++i) {
    if (++choice[i] < terms.terms[i].accepted.size()) return true;
    choice[i] = 0;
  }
  return false;
}

}  // namespace

VertexUpdate update_of(const VertexTerms& terms, const FreeVertex& vertex, const Vec3f& answer) {
  std::vector<std::size_t> choice(terms.terms.size(), 0);
  VertexUpdate best = update_with(system_of(terms, vertex, choice), vertex, answer);
  std::size_t combinations = 1;
  for (const Term& term : terms.terms)
    combinations = std::min(combinations * term.accepted.size(), most_combinations + 1);
  if (combinations > most_combinations) return {best.position, infinity, true, Cut::doubtful};
  // Several combinations of accepted answers may fit the contestant's position, because truncation can hide their
  // difference. If these combinations disagree about whether the vertex was cut, both counts are right.
  bool cuts_differ = false;
  while (advance(choice, terms)) {
    const VertexUpdate other = update_with(system_of(terms, vertex, choice), vertex, answer);
    cuts_differ = cuts_differ || (other.cut != best.cut && share_of(other, answer) <= 1);
    if (share_of(other, answer) < share_of(best, answer)) best = other;
  }
  if (cuts_differ) best.cut = Cut::doubtful;
  best.grey = best.grey || combinations > 1;
  return best;
}

}  // namespace ogc::reference
