// The incremental potential of an IPC step: inertia, elasticity and damping as in Newton-OGC, barriers instead of OGC's
// contacts, and lagged friction. If prescribed vertices did not reach their targets, it also pulls them there. The
// unknowns are the free vertices, the prescribed vertices while they are pulled, and the frames of rods
// (solvers/rods/rod_system.hpp).
#pragma once

#include <optional>

#include "reference/ipc/pairs.hpp"
#include "reference/solvers/newton/matrix.hpp"

namespace ogc::reference {

/// A pull on prescribed vertices that lag behind their targets t, with the augmented Lagrangian Σ ρ m/(2h²) ‖x − t‖² −
/// λ·(x − t).
struct Pull {
  double stiffness = 0;  ///< ρ, in units of the inertia m/h² [1]
  State force;           ///< λ, by vertex [N]
};

/// Energies at one state.
struct IpcEnergy {
  PotentialTerms elastic;                  ///< elasticity and inertia
  std::vector<double> barriers, friction;  ///< by term: b without κ [m⁴]; friction [J]
  double barrier = 0, rest = 0;            ///< κ Σ b; friction and pull [J]
};
/// Returns E(to) − E(from) [J]; the barriers of the two states may differ.
double change(const IpcEnergy& from, const IpcEnergy& to);
/// Returns an upper limit of the rounding error of the energies' sum [J].
double value_noise(const IpcEnergy& energy);

/// Derivatives of the incremental potential with barriers at one state.
struct IpcDerivatives {
  std::vector<StencilDerivatives> stencil;
  std::vector<StencilVertices> vertices;  ///< by stencil
  State gradient;                         ///< by vertex [N], then by segment [N m]; 0 if not an unknown
  double energy_noise = 0;                ///< rounding error of the energy [J] (PotentialDerivatives)
};

/// The energies of a step: barriers, lagged friction, the pull of prescribed vertices, and the potential without
/// contacts.
class IpcForces {
 public:
  /// The scene must be rounded and valid; scene and topology must outlive this.
  IpcForces(const compare::Scene& scene, const compare::Topology& topology, const BarrierShape& shape);

  /// Begins step `number` from `start` = xᵗ with `target` = y [m]. Removes the previous friction and pull.
  void begin_step(const State& start, const State& target, std::int64_t number);
  /// Returns the rods. Energies and forces use the frames of the rods.
  RodSystem& rods() { return potential_.rods(); }
  /// Computes λ, n and the weights of lagged friction from the barriers `set` at x. They stay constant until the next
  /// call.
  void lag_friction(const BarrierSet& set, const State& x, double stiffness);

  /// Returns the energies at x. `set` holds the barriers at x; `stiffness` is κ [J/m⁴]. After the vertices, x may hold
  /// the rotations ω of the frames.
  IpcEnergy energy(const State& x, const BarrierSet& set, double stiffness) const;
  /// Returns the derivatives at x. `room` is an earlier result whose memory is used again, because the operating system
  /// would have to clear tens of megabytes of new memory.
  IpcDerivatives derivatives(const State& x, const BarrierSet& set, double stiffness, HessianProjection projection,
                             IpcDerivatives room = {}) const;
  /// Returns the gradient of Σ b, the barriers without κ, by the unknowns [m³].
  State barrier_gradient(const State& x, const BarrierSet& set) const;

  /// With a value, makes prescribed vertices unknowns and pulls them. Without a value, fixes them.
  void pull(std::optional<Pull> pull) { pull_ = std::move(pull); }
  /// Returns the present pull; empty if nothing is pulled.
  const std::optional<Pull>& pull() const { return pull_; }
  /// Returns whether this vertex or frame is an unknown at present.
  bool unknown(std::size_t index) const {
    return mobility_[index] == Mobility::free || (pull_ && mobility_[index] == Mobility::prescribed);
  }
  /// Returns m/h² by vertex, times ρ for pulled vertices [N/m]. For frames, returns the term that makes the Hessian
  /// definite in their twist [N m].
  std::vector<double> diagonal() const;
  /// Returns the potential without contacts.
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
