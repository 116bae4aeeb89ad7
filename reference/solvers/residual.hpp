// Measures the residual of Eq. 29 at states of any solver (method.md §6), and the force f* of its denominator. The
// meter detects contacts itself and does not change the solver's.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "compare/problem/scene.hpp"
#include "reference/solvers/contacts.hpp"

namespace ogc::reference {

/// The residual of one state.
struct Residual {
  /// mean ‖f_v‖ over free vertices, divided by its value after the guess loop; 0 if that value is 0 [1]
  double share = 0;
  double force = 0;   ///< mean ‖f_v‖ [N]
  double energy = 0;  ///< incremental potential without friction [J]
  double torque = 0;  ///< mean torque ‖(I − q qᵀ)(M q + b)‖ over free segments (compare/rods.md) [N m]
  std::int64_t contacts = 0;
  /// by vertex: ‖f_v‖ divided by the same value, so that `share` is their mean over free vertices; not-a-number for a
  /// vertex that is not free [1]
  std::vector<float> shares{};
};

/// Measures residuals in double. The force of a state is the sum of the forces of all energies; friction takes λ, n and
/// w from the state, too.
class ResidualMeter {
 public:
  /// Rounds its copy of the scene, which must be valid.
  explicit ResidualMeter(const compare::Scene& scene);
  ~ResidualMeter();
  /// Begins the step from Xᵗ, Vᵗ with this number and runs its guess loop. Then states of this step can be measured.
  /// `orientations` are Qᵗ of the rods' segments; an empty span selects the orientations at the scene's start.
  void begin_step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                  std::int64_t number, std::span<const compare::Quaternion> orientations = {});
  double reference_force() const;  ///< mean ‖f*‖ of the step [N]
  /// Measures a state with contacts that the meter detects there. `orientations` belong to the state; an empty span
  /// keeps the orientations of the last state.
  Residual at(const std::vector<compare::Vec3f>& position, std::span<const compare::Quaternion> orientations = {});
  Residual at(const std::vector<std::array<double, 3>>& position,
              std::span<const compare::Quaternion> orientations = {});
  /// Measures a state with contacts that were detected at X_prev = `previous`, as a solver does between two detections.
  Residual with(const ContactSets& contacts, const std::vector<compare::Vec3f>& previous,
                const std::vector<compare::Vec3f>& position, std::span<const compare::Quaternion> orientations = {});

 private:
  class Meter;
  std::unique_ptr<Meter> meter_;
};

}  // namespace ogc::reference
