#include "reference/solvers/kinds/rest_state.hpp"

#include "reference/energies/rest_builder.hpp"
#include "reference/solvers/kinds/kinds.hpp"

namespace ogc::reference {
namespace {

void add_edge(RestBuilder& to, const compare::Edge& edge) {
  const Point<Exact> e = exact(to.at(edge[1])) - exact(to.at(edge[0]));
  Inputs inputs;
  const Point<Input> reacting = input(inputs, to.at(edge[1]), to.at(edge[0]));
  const long double squared = number(dot(e, e));
  to.truth.exact.edge_length_squared.push_back(static_cast<float>(squared));
  to.truth.edge_length_squared.push_back(static_cast<double>(squared));
  to.truth.edge_length_squared_scale.push_back(unit_of(inputs, dot(reacting, reacting)));
}

/// Adds the material of contacts between two bodies: the harmonic mean of the stiffnesses (0 if one is 0) and the mean
/// friction.
void add_meeting(compare::RestStateTruth& truth, const compare::Material& a, const compare::Material& b) {
  const long double ka = a.contact_stiffness, kb = b.contact_stiffness;
  const long double stiffness = ka == 0 || kb == 0 ? 0 : 2 / (1 / ka + 1 / kb);
  const long double friction = (static_cast<long double>(a.friction) + b.friction) / 2;
  truth.exact.meetings.push_back({static_cast<float>(stiffness), static_cast<float>(friction)});
  truth.meeting_stiffness.push_back(static_cast<double>(stiffness));
  truth.meeting_friction.push_back(static_cast<double>(friction));
}

}  // namespace

compare::RestStateTruth rest_state(const compare::RestStateIn& in) {
  RestBuilder to{*in.scene, *in.topology};
  for_each_kind([&]<class Kind, std::size_t>() {
    if constexpr (compare::InRestState<Kind>) Kind::add_at_rest(to);
  });
  for (std::size_t v = 0; v < to.mass.size(); ++v) {
    to.truth.exact.mass.push_back(static_cast<float>(to.mass[v]));
    to.truth.mass.push_back(static_cast<double>(to.mass[v]));
  }
  to.truth.mass_scale = std::move(to.mass_scale);
  for (const compare::Edge& edge : in.topology->edges) add_edge(to, edge);
  for (const compare::Body& a : in.scene->bodies)
    for (const compare::Body& b : in.scene->bodies) add_meeting(to.truth, a.material, b.material);
  return std::move(to.truth);
}

}  // namespace ogc::reference
