// Makes the exact contestant, the contestants of wrong forms, and the list of planted faults.
#include "tests/compare/judge/faults.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "compare/judge/engine/exact_sum.hpp"
#include "compare/judge/stages/verdict.hpp"
#include "compare/stages/all.hpp"
#include "fast/contestant.hpp"
#include "reference/geometry/pair_planes.hpp"
#include "reference/geometry/truncate.hpp"
#include "reference/solvers/sweep.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

Vec3f single(const Vec3& x) { return {static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z)}; }
std::vector<float> single(const std::vector<double>& values) { return {values.begin(), values.end()}; }
Quaternion single(const std::array<double, 4>& q) {
  return {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]), static_cast<float>(q[3])};
}

/// Returns force and block of each case, rounded. If several answers are accepted, takes the first.
ForceOut rounded(const ForceTruth& truth) {
  ForceOut out;
  for (const auto& accepted : truth.accepted) {
    std::array<float, 6> block{};
    for (std::size_t k = 0; k < block.size(); ++k) block[k] = static_cast<float>(accepted[0].block[k]);
    out.force.push_back(single(accepted[0].force));
    out.block.push_back(block);
  }
  return out;
}

template <class In>
std::function<ForceOut(const In&)> forces(const std::function<ForceTruth(const In&)>& ask) {
  return [ask](const In& in) { return rounded(ask(in)); };
}

bool obeys(const Vec3f& x, const Vec3f& p, float b) {
  ExactSum margin;
  for (const auto [a, c] : {std::array{x.x, p.x}, std::array{x.y, p.y}, std::array{x.z, p.z}}) {
    margin.add_product(a, a);
    margin.add_product(-2.0 * a, c);
    margin.add_product(c, c);
  }
  margin.add_product(-double{b}, b);
  return margin.sign() <= 0;
}

/// Returns the exact position, rounded, then moved towards `previous` by units in the last place until it obeys the
/// bound.
Vec3f stored(const Vec3& exact, const Vec3f& previous, float bound) {
  Vec3f x = single(exact);
  while (!obeys(x, previous, bound))
    x = {std::nextafter(x.x, previous.x), std::nextafter(x.y, previous.y), std::nextafter(x.z, previous.z)};
  return x;
}

TruncateOut truncated(const TruncateIn& in, const TruncateTruth& truth) {
  TruncateOut out{in.position, truth.cut};
  for (std::size_t i = 0; i < in.position.size(); ++i)
    if (truth.cut[i])
      out.position[i] = in.half_spaces.of(i).empty() ? stored(truth.position[i], in.previous[i], in.bound[i])
                                                     : reference::stored_in_region(truth.position[i], in, i);
  return out;
}

/// Returns the exact targets, rounded, and the positions and cut flags that follow from the rounded targets.
InitialGuessOut guessed(const InitialGuessIn& in, const Authority& authority) {
  const InitialGuessTruth truth = authority.initial_guess(in);
  InitialGuessOut out;
  for (const Vec3& y : truth.target) out.target.push_back(single(y));
  const TruncateIn question = cut_question(in, out);
  TruncateOut cut = truncated(question, authority.truncate(question));
  out.position = std::move(cut.position);
  out.cut = std::move(cut.cut);
  for (const auto& q : truth.orientation) out.orientation.push_back(single(q));
  return out;
}

/// Returns the exact contacts, rounded.
VolumeDepthOut rounded(const VolumeDepthTruth& truth) {
  VolumeDepthOut out;
  const auto add = [&](const VolumeAnswer& a) {
    VolumeContact c = a.contact;
    for (std::size_t k = 0; k < 3; ++k) c.weights[k] = static_cast<float>(a.weights[k]);
    c.direction = single(a.direction);
    c.depth = static_cast<float>(a.depth);
    out.contacts.push_back(c);
  };
  for (std::size_t i = 0; i < truth.parts.size(); ++i)
    for (const VolumePartTruth& part : truth.parts[i]) {
      for (const VolumeAnswer* answer : exact_answers(part)) add(*answer);
      out.unresolved.insert(out.unresolved.end(), exact_unresolved(part), static_cast<Index>(i));
    }
  std::ranges::sort(out.contacts, {},
                    [](const VolumeContact& c) { return std::tuple(c.point, c.inside, c.triangle, c.face); });
  return out;
}

CcdOut rounded_down(const CcdTruth& truth) {
  CcdOut out;
  for (const double impact : truth.impact) {
    const float nearest = std::min(static_cast<float>(impact), 1.0f);
    out.time.push_back(nearest > impact ? std::nextafter(nearest, 0.0f) : nearest);
  }
  return out;
}

void add_geometry(Contestant& exact, const Authority& authority) {
  exact.closest_face = [authority](const ClosestFaceIn& in) { return authority.closest_face(in).exact; };
  exact.closest_points = [authority](const ClosestPointsIn& in) { return authority.closest_points(in).exact; };
  exact.detect_vertex_facet = [authority](const DetectIn& in) { return authority.detect_vertex_facet(in).exact; };
  exact.detect_edge_edge = [authority](const DetectIn& in) { return authority.detect_edge_edge(in).exact; };
  exact.block = [authority](const BlockIn& in) { return BlockOut{authority.block(in).inside}; };
  exact.bound = [authority](const BoundIn& in) { return authority.bound(in).exact; };
  exact.plane = reference::pair_planes;
  exact.truncate = [authority](const TruncateIn& in) { return truncated(in, authority.truncate(in)); };
  exact.volume_depth = [authority](const VolumeDepthIn& in) { return rounded(authority.volume_depth(in)); };
  exact.ccd = [authority](const CcdIn& in) { return rounded_down(authority.ccd(in)); };
}

void add_energies(Contestant& exact, const Authority& authority) {
  exact.activation = [authority](const ActivationIn& in) {
    const ActivationTruth truth = authority.activation(in);
    return ActivationOut{single(truth.energy), single(truth.slope), single(truth.curvature)};
  };
  exact.barrier = [authority](const BarrierIn& in) {
    const BarrierTruth truth = authority.barrier(in);
    return BarrierOut{single(truth.energy), single(truth.slope), single(truth.curvature)};
  };
  exact.contact_force = forces(authority.contact_force);
  exact.friction_force = forces(authority.friction_force);
  exact.volume_force = forces(authority.volume_force);
  exact.membrane = forces(authority.membrane);
  exact.bending = forces(authority.bending);
  exact.spring = forces(authority.spring);
  exact.tetrahedron = forces(authority.tetrahedron);
  exact.rod = forces(authority.rod);
  exact.orientation = [authority](const OrientationIn& in) {
    OrientationOut out;
    for (const auto& accepted : authority.orientation(in).accepted)
      out.orientation.push_back(single(accepted[0].orientation));
    return out;
  };
}

}  // namespace

Contestant exact_contestant(const Authority& authority) {
  Contestant exact;
  exact.name = "exact";
  add_geometry(exact, authority);
  add_energies(exact, authority);
  exact.rest_state = [authority](const RestStateIn& in) { return authority.rest_state(in).exact; };
  exact.initial_guess = [authority](const InitialGuessIn& in) { return guessed(in, authority); };
  exact.sweep = [](const SweepIn& in) { return reference::reference_sweep(in, reference::SweepStencils(in)); };
  // A step has no exact answer: the judge checks what follows from the answer's own positions and counts. So the fast
  // path's step is used.
  exact.step = fast::contestant(fast::Backend::cpu).step;
  return exact;
}

Contestant contestant_of(const WrongForm& form, const Authority& authority) {
  Contestant wrong = exact_contestant(form.wrong(authority));
  // The truth about a plane or a sweep depends on the answer. So this contestant changes the input as the wrong form
  // does, and answers the changed input correctly.
  wrong.plane = [form, authority, right = wrong.plane](const PlaneIn& in) {
    PlaneOut out;
    Authority seen = authority;
    seen.plane = [&](const PlaneIn& changed, const PlaneOut&) { return out = right(changed), PlaneTruth{}; };
    form.wrong(seen).plane(in, {});
    return out;
  };
  wrong.sweep = [form, authority, right = wrong.sweep](const SweepIn& in) {
    SweepOut out;
    Authority seen = authority;
    seen.sweep = [&](const SweepIn& changed, const SweepOut&) { return out = right(changed), SweepTruth{}; };
    form.wrong(seen).sweep(in, {});
    return out;
  };
  return wrong;
}

std::vector<WrongForm> answering_forms(Stage stage) {
  if (stage == Stage::step) return {};
  std::vector<WrongForm> forms = wrong_forms(stage, {});
  std::erase_if(forms, [](const WrongForm& form) { return !form.wrong; });
  return forms;
}

Stage stage_of(const std::string& fault) { return find_stage(fault.substr(0, fault.find(':'))).value(); }

std::vector<Fault> faults() {
  std::vector<Fault> all;
  for (auto* const of_file : {pair_faults, set_faults, plane_faults, scalar_faults, region_faults, force_faults,
                              rest_faults, step_faults, sweep_faults, volume_faults, rod_faults, ipc_faults})
    for (Fault& fault : of_file()) all.push_back(std::move(fault));
  return all;
}

}  // namespace ogc::tests
