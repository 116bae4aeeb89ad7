// Measures the residual of Eq. 29 at any solver's states (method.md §6), and its f*. It runs beside the solver, with
// separate detections.
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
  double torque = 0;  ///< mean ‖(I − q qᵀ)(M q + b)‖ over free segments of rods [N m]
  std::int64_t contacts = 0;
};

/// Measures residuals in double. Forces are those of all energies at the state; friction takes λ, n and weights from
/// the state, too.
class ResidualMeter {
 public:
  /// Rounds its copy of the scene, which must be valid.
  explicit ResidualMeter(const compare::Scene& scene);
  ~ResidualMeter();
  /// Begins the step from Xᵗ, Vᵗ with this number, and runs its guess loop; then states of this step can be measured.
  /// `orientations`: Qᵗ of the segments of rods; empty: those of the scene's start.
  void begin_step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                  std::int64_t number, std::span<const compare::Quaternion> orientations = {});
  double reference_force() const;  ///< mean ‖f*‖ of the step [N]
  /// Measures with contacts detected at the state itself. `orientations` belong to the state; empty: those of the last
  /// state.
  Residual at(const std::vector<compare::Vec3f>& position, std::span<const compare::Quaternion> orientations = {});
  Residual at(const std::vector<std::array<double, 3>>& position,
              std::span<const compare::Quaternion> orientations = {});
  /// Measures with contacts detected at X_prev = `previous`, as a solver has them between two detections.
  Residual with(const ContactSets& contacts, const std::vector<compare::Vec3f>& previous,
                const std::vector<compare::Vec3f>& position, std::span<const compare::Quaternion> orientations = {});

 private:
  class Meter;
  std::unique_ptr<Meter> meter_;
};

}  // namespace ogc::reference
