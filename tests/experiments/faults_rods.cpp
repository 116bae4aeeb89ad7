// Faults of rod and orientation.
#include <cmath>
#include <utility>

#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

/// `change(case)` spoils the question of either stage.
Fault of_rod(const std::string& name, const std::function<void(RodCase&)>& change) {
  return {"rod: " + name, Stage::rod, [change](Contestant& contestant, const Authority&) {
            contestant.rod = [right = contestant.rod, change](const RodIn& in) {
              RodIn other = in;
              for (RodCase& c : other.cases) change(c);
              return right(other);
            };
          }};
}

Fault of_force(const std::string& name, const std::function<void(Vec3f&, std::array<float, 6>&)>& spoil) {
  return {"rod: " + name, Stage::rod, [spoil](Contestant& contestant, const Authority&) {
            contestant.rod = [right = contestant.rod, spoil](const RodIn& in) {
              ForceOut out = right(in);
              for (std::size_t i = 0; i < out.force.size(); ++i) spoil(out.force[i], out.block[i]);
              return out;
            };
          }};
}

Fault of_orientation(const std::string& name, const std::function<void(OrientationCase&)>& change) {
  return {"orientation: " + name, Stage::orientation, [change](Contestant& contestant, const Authority&) {
            contestant.orientation = [right = contestant.orientation, change](const OrientationIn& in) {
              OrientationIn other = in;
              for (OrientationCase& c : other.cases) change(c);
              return right(other);
            };
          }};
}

Fault of_answer(const std::string& name, const std::function<void(const OrientationCase&, Quaternion&)>& spoil) {
  return {"orientation: " + name, Stage::orientation, [spoil](Contestant& contestant, const Authority&) {
            contestant.orientation = [right = contestant.orientation, spoil](const OrientationIn& in) {
              OrientationOut out = right(in);
              for (std::size_t i = 0; i < in.cases.size(); ++i) spoil(in.cases[i], out.orientation[i]);
              return out;
            };
          }};
}

/// `change(b of each choice of signs, M b, σ)` gives another q, as a formula would.
using Formula = std::function<std::array<double, 4>(const OrientationAnswer&)>;
Fault of_formula(const std::string& name, const Formula& formula) {
  return {"orientation: " + name, Stage::orientation, [formula](Contestant& contestant, const Authority& authority) {
            contestant.orientation = [ask = authority.orientation, formula](const OrientationIn& in) {
              OrientationOut out;
              const OrientationTruth truth = ask(in);
              for (const auto& accepted : truth.accepted) {
                const std::array<double, 4> q = formula(accepted[0]);
                out.orientation.push_back({static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]),
                                           static_cast<float>(q[3])});
              }
              return out;
            };
          }};
}

double size(const std::array<double, 4>& q) { return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]); }

/// (μ + M) b, of unit length, with the published μ = σ + ‖b‖.
std::array<double, 4> published(const OrientationAnswer& answer) {
  const auto& b = answer.vector;
  const double sigma = size(answer.matrix[0]);  // M² = σ² I
  std::array<double, 4> q{};
  for (std::size_t row = 0; row < 4; ++row) {
    q[row] = (sigma + size(b)) * b[row];
    for (std::size_t k = 0; k < 4; ++k) q[row] += answer.matrix[row][k] * b[k];
  }
  const double length = size(q);
  if (!(length > 0)) return answer.orientation;
  for (double& x : q) x /= length;
  return q;
}

void conjugate(Quaternion& q) {
  for (std::size_t k = 0; k < 3; ++k) q[k] = -q[k];
}

void both(OrientationCase& c, const std::function<void(RodNeighbour&)>& change) {
  change(c.behind);
  change(c.ahead);
}

/// What a neighbour asks for: q_f p̄ ahead, q_f p behind.
std::array<double, 4> asked_for(const RodNeighbour& f, bool is_ahead) {
  Quaternion p = f.rest;
  if (is_ahead) conjugate(p);
  const std::array<double, 4> a{f.now[0], f.now[1], f.now[2], f.now[3]}, b{p[0], p[1], p[2], p[3]};
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
          a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

/// With an old q between what the neighbours ask for as it stands no sign flips.
void never_flipped(OrientationCase& c) {
  std::array<double, 4> between{};
  for (const bool is_ahead : {false, true}) {
    const RodNeighbour& f = is_ahead ? c.ahead : c.behind;
    if (!(f.weight > 0)) continue;
    const std::array<double, 4> t = asked_for(f, is_ahead);
    for (std::size_t k = 0; k < 4; ++k) between[k] += t[k];
  }
  const double length = size(between);
  if (!(length > 1e-3)) return;
  for (std::size_t k = 0; k < 4; ++k) c.orientation[k] = static_cast<float>(between[k] / length);
}

std::vector<Fault> rod_faults_of_forces() {
  return {of_rod("R(q) transposed", [](RodCase& c) { conjugate(c.orientation); }),
          of_rod("frame of the start read", [](RodCase& c) { c.orientation = c.orientation_start; }),
          of_rod("damping turns back with R(qt) in place of its transpose",
                 [](RodCase& c) { conjugate(c.orientation_start); }),
          of_rod("damping forgotten", [](RodCase& c) { c.damping = 0; }),
          of_rod("damping of the change of D, not of what the frame sees of it",
                 [](RodCase& c) { c.orientation_start = c.orientation; }),
          of_rod("the length at rest missing", [](RodCase& c) { c.rest_length = 1; }),
          of_rod("half the stiffness", [](RodCase& c) { c.stretch *= 0.5f; }),
          of_rod("the real part of q first",
                 [](RodCase& c) {
                   c.orientation = {c.orientation[1], c.orientation[2], c.orientation[3], c.orientation[0]};
                 }),
          of_force("force of the other sign",
                   [](Vec3f& f, std::array<float, 6>&) {
                     f = {-f.x, -f.y, -f.z};
                   }),
          of_force("force 0.01 % too small",
                   [](Vec3f& f, std::array<float, 6>&) {
                     f = {f.x * 0.9999f, f.y * 0.9999f, f.z * 0.9999f};
                   }),
          of_force("block of the stretch alone: a diagonal entry is lost",
                   [](Vec3f&, std::array<float, 6>& b) { b[5] = 0; })};
}

std::vector<Fault> orientation_faults() {
  return {
      of_orientation("p of the neighbour ahead not conjugated", [](OrientationCase& c) { conjugate(c.ahead.rest); }),
      of_orientation("rest rotation transposed",
                     [](OrientationCase& c) { both(c, [](RodNeighbour& f) { conjugate(f.rest); }); }),
      of_orientation("signs never flipped", never_flipped),
      of_orientation("half angle: 2 k_b for 4 k_b",
                     [](OrientationCase& c) { both(c, [](RodNeighbour& f) { f.weight *= 0.5f; }); }),
      of_orientation("frames of the start read",
                     [](OrientationCase& c) { both(c, [](RodNeighbour& f) { f.now = f.start; }); }),
      of_orientation("M without its factor 2", [](OrientationCase& c) { c.stretch *= 0.5f; }),
      of_orientation("D of the other end", [](OrientationCase& c) { std::swap(c.vertex[0], c.vertex[1]); }),
      of_orientation("damping forgotten", [](OrientationCase& c) { c.damping = 0; }),
      of_orientation("one neighbour forgotten", [](OrientationCase& c) { c.behind.weight = 0; }),
      of_orientation("no twist: neighbours left out", [](OrientationCase& c) { c.behind.weight = c.ahead.weight = 0; }),
      of_formula("the published multiplier", published),
      of_answer("not of unit length",
                [](const OrientationCase&, Quaternion& q) {
                  for (float& x : q) x *= 1 + 0x1p-20f;
                }),
      of_answer("q of the other sign",
                [](const OrientationCase&, Quaternion& q) {
                  for (float& x : q) x = -x;
                }),
      of_answer("the old q stays", [](const OrientationCase& c, Quaternion& q) { q = c.orientation; }),
      of_answer("turned by 0.01 degrees about the director", [](const OrientationCase&, Quaternion& q) {
        const double s = std::sin(8.7e-5), w = std::cos(8.7e-5);  // q (s k + w)
        const std::array<double, 4> a{q[0], q[1], q[2], q[3]};
        q = {static_cast<float>(w * a[0] + s * a[1]), static_cast<float>(w * a[1] - s * a[0]),
             static_cast<float>(w * a[2] + s * a[3]), static_cast<float>(w * a[3] - s * a[2])};
      })};
}

}  // namespace

std::vector<Fault> rod_faults() {
  std::vector<Fault> all = rod_faults_of_forces();
  for (Fault& fault : orientation_faults()) all.push_back(std::move(fault));
  return all;
}

void add_right_rods(Contestant& exact, const Authority& authority) {
  exact.rod = [ask = authority.rod](const RodIn& in) { return rounded(ask(in)); };
  exact.orientation = [ask = authority.orientation](const OrientationIn& in) {
    OrientationOut out;
    const OrientationTruth truth = ask(in);
    for (const auto& accepted : truth.accepted) {
      const auto& q = accepted[0].orientation;
      out.orientation.push_back(
          {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]), static_cast<float>(q[3])});
    }
    return out;
  };
}

}  // namespace ogc::tests
