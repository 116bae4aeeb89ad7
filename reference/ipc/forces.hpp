// The incremental potential of an IPC step: inertia, elasticity and damping as Newton-OGC has them, barriers in place
// of OGC's contacts, lagged friction, and, where prescribed vertices could not go all the way, what pulls them to their
// targets. Its unknowns are the free vertices, with such a pull the prescribed ones too, and behind all vertices the
// frames of rods (solvers/rods/rod_system.hpp).
#pragma once

#include <optional>

#include "reference/ipc/pairs.hpp"
#include "reference/solvers/newton/matrix.hpp"

namespace ogc::reference {

/// The augmented Lagrangian of prescribed vertices that lag: Σ ρ m/(2h²) ‖x − t‖² − λ·(x − t).
struct Pull {
  double stiffness = 0;  ///< ρ, in inertias [1]
  State force;           ///< λ, by vertex [N]
};

/// Energies at one state.
struct IpcEnergy {
  PotentialTerms elastic;                  ///< and inertia
  std::vector<double> barriers, friction;  ///< by term; b without κ [m⁴]; [J]
  double barrier = 0, rest = 0;            ///< κ Σ b; friction and pull [J]
};
/// E(to) − E(from) [J]; the barriers may be others.
double change(const IpcEnergy& from, const IpcEnergy& to);
/// What rounding does to the sum [J].
double value_noise(const IpcEnergy& energy);

/// Derivatives of the incremental potential with barriers at one state.
struct IpcDerivatives {
  std::vector<StencilDerivatives> stencil;
  std::vector<StencilVertices> vertices;  ///< of the stencils
  State gradient;                         ///< by vertex [N], then by segment [N m]; 0 where not unknown
  double energy_noise = 0;                ///< see PotentialDerivatives [J]
};

/// Energies of a step: the potential without contacts, barriers, lagged friction, the pull of prescribed vertices.
class IpcForces {
 public:
  /// Scene: rounded and valid. Both must outlive it.
  IpcForces(const compare::Scene& scene, const compare::Topology& topology, const BarrierShape& shape);

  /// xᵗ and y of the step with this number [m]. Friction and pull of the step before are gone.
  void begin_step(const State& start, const State& target, std::int64_t number);
  /// Segments of rods with their frames, at which energies and forces are evaluated.
  RodSystem& rods() { return potential_.rods(); }
  /// λ, n and weights of these barriers at x, until the next call.
  void lag_friction(const BarrierSet& set, const State& x, double stiffness);

  /// At x, which may have ω of frames behind its vertices, with the barriers of x and κ [J/m⁴].
  IpcEnergy energy(const State& x, const BarrierSet& set, double stiffness) const;
  /// `room`: an earlier result whose memory is used again: a fresh one is tens of megabytes that the kernel would have
  /// to clear.
  IpcDerivatives derivatives(const State& x, const BarrierSet& set, double stiffness, HessianProjection projection,
                             IpcDerivatives room = {}) const;
  /// ∇ Σ b of the unknowns [m³].
  State barrier_gradient(const State& x, const BarrierSet& set) const;

  /// Prescribed vertices become unknowns, or are held where they are again (without a value).
  void pull(std::optional<Pull> pull) { pull_ = std::move(pull); }
  /// The pull at present; empty where nothing is pulled.
  const std::optional<Pull>& pull() const { return pull_; }
  /// Of every vertex and frame at present.
  bool unknown(std::size_t index) const {
    return mobility_[index] == Mobility::free || (pull_ && mobility_[index] == Mobility::prescribed);
  }
  /// m/h², of pulled vertices ρ times that, by vertex [N/m]; of frames what makes their twist definite.
  std::vector<double> diagonal() const;
  /// What does not depend on contacts.
  const Potential& potential() const { return potential_; }

 private:
  void add_gradient(IpcDerivatives& result, const State& x) const;
  double friction_coefficient(const BarrierTerm& term) const;

  const compare::Scene& scene_;
  BarrierShape shape_;
  Potential potential_;
  std::vector<Mobility> mobility_;  ///< of vertices, then of frames
  std::vector<StencilVertices> elastic_vertices_;
  std::vector<compare::Index> body_;
  std::vector<FrictionTerm> frictions_;
  State start_, target_;
  std::optional<Pull> pull_;
};

}  // namespace ogc::reference
