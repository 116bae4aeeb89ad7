// The incremental potential of a step (backward Euler): inertia, elasticity, damping, contacts of the last detection,
// lagged friction. Its gradient is minus the force f of Eq. 29.
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

/// Converts positions to double.
State widened(const std::vector<compare::Vec3f>& positions);

/// Tells whether a vertex never moves, follows its prescribed motion, or follows forces.
enum class Mobility : std::uint8_t { fixed, prescribed, free };
/// Returns the mobility of each vertex.
std::vector<Mobility> mobility_of(const compare::Scene& scene);

/// Energies at one state, term by term. The change between two states is summed term by term, because it is small
/// compared with the total.
struct PotentialTerms {
  std::vector<double> stencil;  ///< by stencil, all kinds [J]
  std::vector<double> inertia;  ///< by vertex; 0 if not free [J]
};

/// Derivatives at one state.
struct PotentialDerivatives {
  std::vector<StencilDerivatives> stencil;
  std::vector<double> slopes, curvatures;  ///< Σ |∂E| and Σ |∂²E| of each stencil's free vertices [N], [N/m]
  State gradient;                          ///< by unknown, vertices [N] then segments [N m]; 0 if not free
  /// Errors that rounding of the unknowns causes: in the mean ‖gradient‖ over free vertices, in the sum of ‖torque‖
  /// over segments of rods, and in the energy. Each is 2⁻⁵² times a sum of |∂²E| or |∂E| times the size of the rounded
  /// unknown: ‖x‖_∞ for positions, 1 for frames (unit quaternions).
  double force_noise = 0, torque_noise = 0, energy_noise = 0;  ///< [N], [N m], [J]
};

/// The incremental potential of a scene, step after step.
class Potential {
 public:
  /// Takes a rounded scene; scene and topology must outlive the potential. Throws InputError for damping by vertex,
  /// which has no potential.
  Potential(const compare::Scene& scene, const compare::Topology& topology);

  /// Begins a step from xᵗ with target y, without contacts and friction. Damping measures strains and angles relative
  /// to xᵗ.
  void begin_step(const State& start, const State& target);
  /// Sets the contacts that were found at `previous`, where e_k is evaluated. Leaves out contacts without a free
  /// vertex.
  void set_contacts(const ContactSets& sets, const State& previous);
  /// Sets λ, n and w of friction from the contacts that act at x (method.md §4.4); they stay until the next call.
  void lag_friction(const State& x);

  /// Returns the energies at x, by term.
  PotentialTerms terms(const State& x) const;
  /// Returns E(to) − E(from); both must come from the same stencils.
  static double change(const PotentialTerms& from, const PotentialTerms& to);
  static double total(const PotentialTerms& terms);
  /// Returns the derivatives at x. Reuses the memory of an earlier result, `room`.
  PotentialDerivatives derivatives(const State& x, HessianProjection projection, PotentialDerivatives room = {}) const;

  /// Returns the number of stencils: elements, contacts and frictions.
  std::size_t stencil_count() const { return frictionless_count() + frictions_.size(); }
  /// Returns the number of elements. Their stencils come first and never change.
  std::size_t elastic_count() const {
    return std::apply([](const auto&... lists) { return (lists.size() + ...); }, elements_);
  }
  /// Returns the number of stencils except friction. The stencils of friction come last.
  std::size_t frictionless_count() const { return elastic_count() + contacts_.size() + volumes_.size(); }
  /// Returns the mobility of each unknown of Newton's method: first of each vertex, then of each segment of a rod
  /// (rods/rod_system.hpp).
  std::vector<Mobility> unknowns() const;
  /// Returns the stencil's unknowns in the order of its derivatives; unused entries are −1.
  std::array<compare::Index, 4> vertices(std::size_t stencil) const;
  std::vector<std::array<compare::Index, 4>> vertices() const;  ///< unknowns of all stencils

  double elastic_energy(const State& x) const;             ///< without damping [J]
  double contact_energy(const State& x) const;             ///< normal energies [J]
  std::int64_t inverted_tetrahedra(const State& x) const;  ///< tetrahedra with J ≤ 0
  /// Returns m_v by vertex [kg].
  const std::vector<double>& mass() const { return mass_; }
  /// Returns the mobility of each vertex.
  const std::vector<Mobility>& mobility() const { return mobility_; }
  /// Returns the rest shape, rounded to single precision as for the fast path.
  const compare::RestStateOut& rest() const { return rest_; }
  /// Returns the elements of a kind.
  template <class Kind>
  const typename Kind::List& elements() const {
    return std::get<typename Kind::List>(elements_);
  }
  /// Returns the stencils of the present contacts between surfaces.
  const std::vector<ContactTerm>& contacts() const { return contacts_; }
  const std::vector<VolumeTerm>& volumes() const { return volumes_; }
  /// Returns the friction of a contact; empty if it has none. λ, n and w are evaluated at `corners`; entries beyond the
  /// contact's vertices are not read.
  std::optional<FrictionTerm> friction_at(const ContactTerm& term, const std::array<Triple<double>, 4>& corners) const;
  /// Returns the rods, whose orientations energies and forces use.
  RodSystem& rods() { return std::get<RodSystem>(elements_); }
  const RodSystem& rods() const { return elements<SegmentKind>(); }
  const State& target() const { return target_; }                                       ///< y of the step [m]
  double inertia(std::size_t vertex) const { return mass_[vertex] / (step_ * step_); }  ///< m/h² [N/m]
  /// Returns the diagonal term of each unknown: m/h² of a vertex [N/m], then the regularisation of a segment [N m],
  /// without which the matrix of a freely twisting rod would be singular.
  std::vector<double> inertias() const;
  /// Returns the number of free vertices.
  std::size_t free_count() const { return free_count_; }

 private:
  void add_contact(const ContactStencil& stencil, const State& previous);
  void add_contact(const compare::VolumeContact& contact);
  /// Calls `use` with the list that holds the stencil (elements of one kind, contacts, volumes or friction) and the
  /// stencil's index in that list. Returns the result of `use`.
  template <class Use>
  auto in_its_list(std::size_t stencil, Use use) const;
  double stencil_energy(std::size_t stencil, const State& x) const;
  /// Stores sums of the moduli of the stencil's gradient and Hessian. `sum_gradient` computes the noise of `result`
  /// from these sums. The stencil's first `corners` unknowns are vertices.
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
