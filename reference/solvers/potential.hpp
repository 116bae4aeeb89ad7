// The incremental potential of a step (backward Euler): inertia, elasticity, damping, contact of the last detection,
// lagged friction. Its gradient is minus the total force of Eq. 29.
#pragma once

#include <optional>
#include <vector>

#include "compare/problem/scene.hpp"
#include "compare/stages/volume_depth.hpp"
#include "reference/energies/stencil_terms.hpp"
#include "reference/energies/stencils/stencil_derivatives.hpp"
#include "reference/energies/volume_term.hpp"
#include "reference/solvers/contacts.hpp"
#include "reference/solvers/kinds/kinds.hpp"

namespace ogc::reference {

/// The positions in double.
State widened(const std::vector<compare::Vec3f>& positions);

/// What moves a vertex: nothing, its motion, or forces.
enum class Mobility : std::uint8_t { fixed, prescribed, free };
/// By vertex.
std::vector<Mobility> mobility_of(const compare::Scene& scene);

/// Energies at one state, by term, so that two states are compared term by term: their difference is small beside their
/// sum.
struct PotentialTerms {
  std::vector<double> stencil;  ///< of all stencils [J]
  std::vector<double> inertia;  ///< by vertex; 0 where not free [J]
};

/// Derivatives at one state.
struct PotentialDerivatives {
  std::vector<StencilDerivatives> stencil;
  std::vector<double> slopes, curvatures;  ///< Σ |∂E| and Σ |∂²E| of each stencil's free vertices [N], [N/m]
  State gradient;                          ///< by unknown, vertices [N] then segments [N m]; 0 where not free
  /// What rounding of the unknowns alone does to the mean of ‖gradient‖ over free vertices, to its sum over segments of
  /// rods, and to the energy: 2⁻⁵² times the sums of |∂²E| and of |∂E|, each by the size of the unknown that is
  /// rounded, ‖x‖_∞ of positions and 1 of frames, which are unit quaternions.
  double force_noise = 0, torque_noise = 0, energy_noise = 0;  ///< [N], [N m], [J]
};

/// The incremental potential of a scene, step after step.
class Potential {
 public:
  /// The scene must be rounded; both must outlive it. Throws InputError for damping by vertex, which is no potential.
  Potential(const compare::Scene& scene, const compare::Topology& topology);

  /// xᵗ and y of the step; strains and angles at xᵗ. Contacts and friction of the step before are gone.
  void begin_step(const State& start, const State& target);
  /// Contacts found at `previous`, where e_k is evaluated. Those without a free vertex act on nothing and are left out.
  void set_contacts(const ContactSets& sets, const State& previous);
  /// λ, n and w of the present contacts that act at x (method.md §4.4), until the next call.
  void lag_friction(const State& x);

  /// Energies at x, by term.
  PotentialTerms terms(const State& x) const;
  /// E(to) − E(from), the same stencils in both.
  static double change(const PotentialTerms& from, const PotentialTerms& to);
  static double total(const PotentialTerms& terms);
  /// `room`: an earlier result whose memory is used again.
  PotentialDerivatives derivatives(const State& x, HessianProjection projection, PotentialDerivatives room = {}) const;

  /// The number of stencils of all kinds.
  std::size_t stencil_count() const { return frictionless_count() + frictions_.size(); }
  /// the first stencils: those that never change
  std::size_t elastic_count() const {
    return std::apply([](const auto&... lists) { return (lists.size() + ...); }, elements_);
  }
  /// the stencils before those of friction
  std::size_t frictionless_count() const { return elastic_count() + contacts_.size() + volumes_.size(); }
  /// By vertex, then by segment of a rod, whether Newton's method moves it (rods/rod_system.hpp).
  std::vector<Mobility> unknowns() const;
  /// The stencil's unknowns in the order of its derivatives; those that it lacks are −1.
  std::array<compare::Index, 4> vertices(std::size_t stencil) const;
  std::vector<std::array<compare::Index, 4>> vertices() const;  ///< of all stencils

  double elastic_energy(const State& x) const;             ///< without damping [J]
  double contact_energy(const State& x) const;             ///< normal energies [J]
  std::int64_t inverted_tetrahedra(const State& x) const;  ///< those with J ≤ 0
  /// m_v by vertex [kg].
  const std::vector<double>& mass() const { return mass_; }
  /// By vertex.
  const std::vector<Mobility>& mobility() const { return mobility_; }
  /// Rest shape, rounded as the fast path has it.
  const compare::RestStateOut& rest() const { return rest_; }
  /// The elements of a kind.
  template <class Kind>
  const typename Kind::List& elements() const {
    return std::get<typename Kind::List>(elements_);
  }
  /// The stencils of the present contacts.
  const std::vector<ContactTerm>& contacts() const { return contacts_; }
  const std::vector<VolumeTerm>& volumes() const { return volumes_; }
  /// Friction of a contact with λ, n and w of these corners (all four places; those that it lacks are read by none);
  /// empty where there is none.
  std::optional<FrictionTerm> friction_at(const ContactTerm& term, const std::array<Triple<double>, 4>& corners) const;
  /// Segments of rods with their orientations, at which energies and forces are evaluated.
  RodSystem& rods() { return std::get<RodSystem>(elements_); }
  const RodSystem& rods() const { return elements<SegmentKind>(); }
  const State& target() const { return target_; }                                       ///< y of the step [m]
  double inertia(std::size_t vertex) const { return mass_[vertex] / (step_ * step_); }  ///< m/h² [N/m]
  /// Of each unknown: m/h² of a vertex [N/m], of a segment what makes its twist definite
  std::vector<double> inertias() const;
  /// Number of free vertices.
  std::size_t free_count() const { return free_count_; }

 private:
  void add_contact(const ContactStencil& stencil, const State& previous);
  void add_contact(const compare::VolumeContact& contact);
  /// What `use` makes of the list that has the stencil and of its place there: a list of elements, contacts, volumes
  /// or friction.
  template <class Use>
  auto in_its_list(std::size_t stencil, Use use) const;
  double stencil_energy(std::size_t stencil, const State& x) const;
  /// `corners`: how many of the stencil's first unknowns are vertices.
  void measure(std::size_t stencil, std::size_t corners, PotentialDerivatives& result) const;
  void add_frame_noise(const State& x, PotentialDerivatives& result) const;
  void sum_gradient(const State& x, PotentialDerivatives& result) const;

  const compare::Scene& scene_;
  const compare::Topology& topology_;
  compare::RestStateOut rest_;
  std::vector<compare::Index> body_;
  std::vector<Mobility> mobility_, unknowns_;
  std::vector<double> mass_;
  double step_;
  std::size_t free_count_ = 0;
  ElementLists elements_;
  std::vector<ContactTerm> contacts_;
  std::vector<FrictionTerm> frictions_;
  std::vector<VolumeTerm> volumes_;
  State start_, target_;
};

}  // namespace ogc::reference
