#include "reference/solvers/guess/held_moves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/energies/closest_form.hpp"
#include "reference/energies/meeting.hpp"

namespace ogc::reference {
namespace {

using compare::Index;
using compare::Vec3f;
using Move = Triple<double>;

double norm(const Move& a) { return std::hypot(a[0], a[1], a[2]); }
Move wide(const Vec3f& p) { return {p.x, p.y, p.z}; }

}  // namespace

double Hold::taken(const Move& move) const {
  const double leaving = std::max(0.0, dot(normal, others)) / std::abs(weight);
  return -std::copysign(1.0, weight) * dot(normal, move) - leaving;
}

Move Hold::slide(const Move& move) const {
  const Move relative = move + (1 / weight) * others;
  return relative - dot(normal, relative) * normal;
}

Move held_by(const Hold& contact, const Move& move) {
  const double taken = contact.taken(move);
  if (!(taken > 0)) return move;
  const Move kept = move + std::copysign(taken, contact.weight) * contact.normal, slide = contact.slide(move);
  const double length = norm(slide), limit = contact.friction * taken;
  return length <= limit ? kept - slide : kept - (limit / length) * slide;
}

std::vector<Move> HeldMoves::round(std::span<const GuessContact> contacts, const std::vector<Move>& previous,
                                   const std::vector<Move>& target) {
  std::vector<std::vector<Hold>> holds(groups_.size());
  const bool is_later = !std::exchange(is_first_, false);
  stays_.assign(groups_.size(), false);
  for (const GuessContact& contact : contacts) {
    std::array<Move, 4> corners{}, expected{};
    Move all{};
    const auto count = static_cast<std::size_t>(vertex_count(contact.sides));
    const auto vertex = [&](std::size_t k) { return static_cast<std::size_t>(contact.vertex[k]); };
    for (std::size_t k = 0; k < count; ++k) corners[k] = previous[vertex(k)];
    const ClosestForm form = closest_form(contact.sides, corners);
    const Move apart = separation(form.weight, corners);
    const double distance = norm(apart);
    if (!(distance > 0) || !(distance < radius_)) continue;
    for (std::size_t k = 0; k < count; ++k) {
      expected[k] = form.weight[k] * (target[vertex(k)] - previous[vertex(k)] + taken_[vertex(k)]);
      all = all + expected[k];
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (is_later && is_prescribed(contact.vertex[k])) stays_[vertex(k)] = true;
      if (is_free(contact.vertex[k]) && form.weight[k] != 0)
        holds[vertex(k)].push_back({form.weight[k], (1 / distance) * apart, all - expected[k], contact.friction});
    }
  }
  std::vector<Move> result = target;
  for (std::size_t v = 0; v < holds.size(); ++v) {
    const Move wanted = target[v] - previous[v];
    Move move = wanted;
    for (const Hold& hold : holds[v]) move = held_by(hold, move);
    taken_[v] = move - wanted;
    if (move != wanted) result[v] = previous[v] + move;
    if (stays_[v]) result[v] = previous[v];
  }
  return result;
}

namespace {

/// Number of roundings from the inputs to the move that one contact leaves:
///   36  the normal, as in the stage contact_force
///    5  another vertex's move (2); its product with the weight, and the sum over three vertices (3)
///    3  n·move or n·others; only one of them counts, because neither is an input of the other
///    2  the difference of these products, and the quotient
///    2  the product with the normal, and the sum
///   11  the relative move (2), its normal component (4), their difference (1), and the length of this slip (4)
///    6  the limit of friction (2), quotients (2), product and difference (2)
constexpr double roundings = 65, unit = roundings * compare::unit_roundoff;

/// A move and its accepted error [m].
struct Doubted {
  Move move{};
  double error = 0;
  bool is_grey = false;
};

/// A contact, with all accepted pairs of its contact points (`ways`) and the moves that its vertices are expected to
/// make.
struct Asked {
  std::vector<Meeting> ways;
  std::array<Doubted, 4> expected{};
  std::array<double, 4> size{};  ///< sum of the norms of the terms of `expected` [m]
  double friction = 0;
};

/// The quantities that determine what one contact leaves of a move, and their errors.
struct Measured {
  Hold hold;
  double taken = 0, sliding = 0, normal = 0;  ///< errors of the removed part q, the slip s/w and the normal n
};

using InputMove = Triple<Input>;

InputMove as_input(Inputs& inputs, const Move& move, double size) {
  return {inputs.number(move[0], size), inputs.number(move[1], size), inputs.number(move[2], size)};
}

/// Returns the quantities of a contact for its vertex at place `own`, whose weight must not be 0. Their errors do not
/// include the error of `move`.
Measured measure(Meeting meeting, const Asked& asked, std::size_t own, const Move& move) {
  Inputs& inputs = meeting.inputs;
  const InputMove apart = meeting.separation(), normal = Input(1.0) / meeting.distance * apart,
                  wanted = as_input(inputs, move, norm(move));
  InputMove others;
  double others_error = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k == own || asked.size[k] == 0) continue;
    others = others + meeting.weight[k] * as_input(inputs, asked.expected[k].move, asked.size[k]);
    others_error += std::abs(meeting.weight[k].value) * asked.expected[k].error;
  }
  const Input& weight = meeting.weight[own];
  const double share = std::abs(weight.value);
  const InputMove relative = wanted + Input(1.0) / weight * others, slide = relative - dot(normal, relative) * normal;
  const Input closing = dot(normal, wanted), opening = dot(normal, others) / weight;
  const auto plain_of = [](const InputMove& a) { return Move{a[0].value, a[1].value, a[2].value}; };
  // If the other vertices certainly approach this vertex, the removed part does not depend on their moves. Then errors
  // of their moves do not count.
  const double room = dot(plain_of(normal), plain_of(others)) / share,
               room_error = unit * inputs.condition({&opening, 1}) + others_error / share;
  Measured result;
  result.hold = {weight.value, plain_of(normal), plain_of(others), asked.friction};
  result.taken = unit * inputs.condition({&closing, 1}) + (room < -room_error ? 0 : room_error);
  result.sliding = unit * inputs.condition(slide) + others_error / share;
  result.normal = unit * inputs.condition(normal);
  return result;
}

using Matrix = std::array<Move, 3>;  // rows

constexpr Matrix identity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) c[i] = c[i] + a[i][k] * b[k];
  return c;
}

/// Returns an upper limit of the largest singular value: the root of the product of the largest row sum and the largest
/// column sum of moduli.
double norm(const Matrix& a) {
  double row = 0, column = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    row = std::max(row, std::abs(a[i][0]) + std::abs(a[i][1]) + std::abs(a[i][2]));
    column = std::max(column, std::abs(a[0][i]) + std::abs(a[1][i]) + std::abs(a[2][i]));
  }
  return std::sqrt(row * column);
}

double distance(const Matrix& a, const Matrix& b) { return norm(Matrix{a[0] - b[0], a[1] - b[1], a[2] - b[2]}); }

/// What a contact leaves of a move: the new move, its derivative by the old move, and an additional error [m].
struct Passed {
  Move move{};
  Matrix slope = identity;
  double error = 0;
  bool is_grey = false;
};

/// Returns the derivative of the new move by the old move. The contact must certainly remove a part of the move, and
/// the vertex must certainly slip.
Matrix slipping(const Hold& hold, double taken, const Move& slide) {
  const double length = norm(slide), mu = hold.friction, share = mu * taken / length;
  const Move &n = hold.normal, along = (1 / length) * slide;
  Matrix slope{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double one = i == k ? 1 : 0;
      slope[i][k] = one - n[i] * n[k] - share * (one - n[i] * n[k] - along[i] * along[k]) +
                    std::copysign(mu, hold.weight) * along[i] * n[k];
    }
  return slope;
}

/// Applies a contact to a move with an error. To first order, neither the removal of the normal part q nor sticking
/// increases the error. The friction limit μ q changes by μ times the change of q. If rounding decides whether the
/// contact removes a part, or whether the vertex slips, the error grows by the largest factor of the possible cases.
Passed passed(const Measured& at, const Move& move, double error) {
  const Hold& hold = at.hold;
  const double taken = hold.taken(move), mu = hold.friction, doubt = at.taken + error,
               most = std::max(0.0, taken) + doubt;
  if (taken < -doubt) return {.move = move};
  const Move slide = hold.slide(move);
  const double length = norm(slide), off = at.sliding + error, limit = mu * most;
  double direction = std::min(at.sliding, 2 * limit);
  if (length > 2 * at.sliding) direction = std::min(direction, limit * at.sliding / (length - at.sliding));
  Passed result{.move = held_by(hold, move), .slope = {}};
  result.error = (1 + mu) * at.taken + most * at.normal + direction + unit * (norm(move) + most);
  const bool takes = taken > doubt, sticks = length + off <= mu * (taken - doubt),
             slips = length - off >= limit && length > 4 * off;
  if (takes && slips && mu > 0) {
    result.slope = slipping(hold, taken, slide);
    result.error += error * error / length;
  } else if (takes && mu == 0) {
    for (std::size_t i = 0; i < 3; ++i) result.slope[i] = identity[i] - hold.normal[i] * hold.normal;
  } else if (!(takes && sticks)) {
    result.error += error * (takes ? std::sqrt(1 + mu * mu) : 0.5 * (mu + std::sqrt(mu * mu + 4)));
  }
  return result;
}

/// Applies a contact to a move. `meeting` has one accepted pair of contact points.
Passed passed(const Meeting& meeting, const Asked& asked, std::size_t own, const Move& move, double error) {
  const double apart = meeting.distance.value, weight = meeting.weight[own].value;
  const bool ends = meeting.may_end(), acts = meeting.acts();
  if (!(apart > 0) || weight == 0 || (!acts && !ends)) return {.move = move};
  Measured at = measure(meeting, asked, own, move);
  // Weight and distance are divisors. If one of them has the relative error `doubt`, first-order errors grow by the
  // factor 1/(1 − doubt).
  const double doubt = std::max(unit * meeting.inputs.condition({&meeting.weight[own], 1}) / std::abs(weight),
                                roundings / compare::contact_grey * meeting.doubt / apart);
  for (double* number : {&at.taken, &at.sliding, &at.normal}) *number /= 1 - std::min(doubt, 0.5);
  Passed result = passed(at, move, error);
  // The removed normal part q is at most as long as the move, and friction is at most μ q. So the contact changes the
  // move by at most 1 + μ times the move's length.
  if (meeting.needle || doubt > 0.5)
    result = {result.move, {}, error + 2 * (1 + at.hold.friction) * (norm(move) + error), true};
  if (!ends) return result;
  result.error += norm(result.move - move) + distance(result.slope, identity) * error;
  result.is_grey = true;
  if (!acts) result.move = move, result.slope = identity;
  return result;
}

Passed passed(const Asked& asked, std::size_t own, const Move& move, double error) {
  Passed result = passed(asked.ways.front(), asked, own, move, error);
  for (std::size_t i = 1; i < asked.ways.size(); ++i) {
    const Passed other = passed(asked.ways[i], asked, own, move, error);
    const double off = norm(other.move - result.move) + distance(other.slope, result.slope) * error;
    result.error = std::max(result.error, off + other.error);
    result.is_grey = true;
  }
  return result;
}

/// Applies all contacts of a vertex to its move, one after the other. Each contact also transforms the errors that
/// earlier contacts caused.
class Carried {
 public:
  Carried(const Move& move, double error) : at_{move, error, false}, sources_{{identity, error}} {}
  const Doubted& at() const { return at_; }
  void pass(const Asked& asked, std::size_t own) {
    const Passed next = passed(asked, own, at_.move, at_.error);
    at_ = {next.move, next.error, at_.is_grey || next.is_grey};
    for (Source& source : sources_) {
      source.slope = product(next.slope, source.slope);
      at_.error += norm(source.slope) * source.size;
    }
    if (next.error > 0) sources_.push_back({identity, next.error});
  }

 private:
  struct Source {
    Matrix slope;
    double size;
  };
  Doubted at_;
  std::vector<Source> sources_;
};

/// Whether a prescribed vertex has a contact that acts, certainly or possibly within rounding.
struct Touch {
  bool is_certain = true, is_possible = false;
};

Touch touch_of(const std::vector<Meeting>& ways) {
  Touch touch;
  for (const Meeting& way : ways) {
    const bool is_doubtful = way.may_end() || way.may_touch() || way.needle;
    touch.is_certain = touch.is_certain && way.acts() && !is_doubtful;
    touch.is_possible = touch.is_possible || way.acts() || is_doubtful;
  }
  return touch;
}

/// Returns the contact as a case of the stage contact_force. Its energy is not used, so the stiffness is 1 N/m and no
/// mollifier acts.
compare::ContactForceCase question_of(const GuessContact& contact, const std::vector<Vec3f>& positions, double radius) {
  compare::ContactForceCase question;
  question.sides = contact.sides;
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(contact.sides)); ++k)
    question.vertex[k] = positions[static_cast<std::size_t>(contact.vertex[k])];
  question.previous = question.vertex;
  question.rest_squared = {-1, -1};
  question.contact_radius = static_cast<float>(radius);
  question.stiffness = 1;
  question.activation = compare::ContactActivation::quadratic;
  return question;
}

}  // namespace

std::vector<compare::HeldMove> HeldMoves::judged_round(std::span<const GuessContact> contacts,
                                                       const std::vector<Vec3f>& previous,
                                                       const std::vector<Vec3f>& target) {
  std::vector<Asked> all;
  // pairs (contact, place in it) of each free vertex
  std::vector<std::vector<std::array<std::size_t, 2>>> rows(groups_.size());
  std::vector<Touch> touches(groups_.size(), {.is_certain = false});  // whether contacts act on each prescribed vertex
  const bool is_later = !std::exchange(is_first_, false);
  for (const GuessContact& contact : contacts) {
    Asked asked{meetings(question_of(contact, previous, radius_)), {}, {}, contact.friction};
    for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(contact.sides)); ++k) {
      const auto u = static_cast<std::size_t>(contact.vertex[k]);
      const Move wanted = wide(target[u]) - wide(previous[u]);
      asked.expected[k] = {wanted + taken_[u], taken_error_[u], false};
      asked.size[k] = norm(wanted) + norm(taken_[u]);
      if (is_free(contact.vertex[k])) rows[u].push_back({all.size(), k});
      if (!is_later || !is_prescribed(contact.vertex[k])) continue;
      const Touch touch = touch_of(asked.ways);
      touches[u] = {touches[u].is_certain || touch.is_certain, touches[u].is_possible || touch.is_possible};
    }
    all.push_back(std::move(asked));
  }
  std::vector<compare::HeldMove> result(groups_.size());
  for (std::size_t v = 0; v < rows.size(); ++v) {
    const Move wanted = wide(target[v]) - wide(previous[v]);
    Carried carried(wanted, compare::unit_roundoff * norm(wanted));
    for (const auto& [contact, place] : rows[v]) carried.pass(all[contact], place);
    const Doubted& move = carried.at();
    taken_[v] = move.move - wanted;
    taken_error_[v] = rows[v].empty() ? 0 : move.error + compare::unit_roundoff * norm(taken_[v]);
    // A move with a grey decision is not grey if its error is at most 1/16 of the intended move, because the accepted
    // error covers both decisions.
    const bool is_grey = move.is_grey && move.error > norm(wanted) / 16;
    result[v] = {{move.move[0], move.move[1], move.move[2]}, move.error, !rows[v].empty(), is_grey};
    if (touches[v].is_possible) result[v] = {{}, 0, 1, !touches[v].is_certain};
  }
  return result;
}

}  // namespace ogc::reference
