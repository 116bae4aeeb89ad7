// Scenes and simulations as Python sees them: arrays in, compare::Scene and compare::Simulation within.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/problem/scene.hpp"
#include "experiments/python/state_view.hpp"
#include "fast/resident_state.hpp"

namespace ogc::python {

/// Material of a cloth in the terms of its user.
struct ClothMaterial {
  double density = 0.2;            ///< mass per rest area [kg/m²]
  double young = 1e3;              ///< Young's modulus times thickness [N/m]
  double poisson = 0.3;            ///< Poisson's ratio ν [1], in (−1, 1)
  double bending = 5e-7;           ///< k_b [J]
  double friction = 0.2;           ///< μ_c [1]
  double contact_stiffness = 100;  ///< k_c [N/m]
  double damping = 0;              ///< k_d of the membrane [s]
  double bending_damping = 0;      ///< k_d of the hinges [s]
  std::string membrane = "stable_neo_hookean", bending_model = "discrete_hinge";  ///< names of the energies
};

/// Returns the constants of the energies: μ = E/(2(1 + ν)) and λ = Eν/(1 − ν²), plane stress. Throws
/// compare::InputError for an unknown name of an energy or for a Poisson's ratio outside (−1, 1).
compare::Material material_of(const ClothMaterial& cloth);

/// Returns a mesh of triangles at positions, widened without loss. Throws compare::InputError if a triangle names a
/// vertex that does not exist.
compare::Mesh mesh_of(std::span<const compare::Vec3f> positions, std::span<const compare::Triangle> triangles);

/// Returns a material without energies for a body that is fixed or driven.
compare::Material obstacle_material(double friction, double contact_stiffness);

/// One column of the metrics of a step.
struct MetricColumn {
  const char* name;                                    ///< as in compare::StepMetrics
  bool is_whole;                                       ///< int64, else float64
  double (*number)(const compare::StepMetrics&);       ///< value of a float64 column
  std::int64_t (*whole)(const compare::StepMetrics&);  ///< value of an int64 column
};
/// Returns the columns in the order of compare::StepMetrics.
std::span<const MetricColumn> metric_columns();

/// Returns the scene in single precision. Throws compare::InputError if it is not valid or has a setting that the
/// solver does not read.
compare::Scene checked(compare::Scene scene);

/// Returns why a step ends a simulation, and what to do; empty if it does not.
std::string failure_of(const compare::StepMetrics& row);

/// A running simulation. Several threads may call it, one after the other is served.
class Simulation : public StateOwner {
 public:
  /// Throws compare::InputError if the scene is not valid or has a setting that the solver does not read, and
  /// compare::ResourceError if the backend is not there.
  Simulation(compare::Scene scene, std::string_view backend, const compare::SimulationOptions& options);

  /// Runs `steps` steps and returns their rows. Calls `between` after each frame, where it and other threads may call
  /// the simulation, too; an exception of `between` ends the call, and the simulation can go on. Throws
  /// std::runtime_error if a step fails; its row is in `rows()`.
  std::vector<compare::StepMetrics> advance(std::int64_t steps, const std::function<void()>& between);
  /// Returns the rows of all steps since the start or the last restore.
  std::vector<compare::StepMetrics> rows() const;
  compare::Snapshot snapshot() const;
  /// Goes on from a snapshot. Throws compare::InputError if it is of a scene with another number of vertices.
  void restore(const compare::Snapshot& snapshot);
  std::string device() const { return simulation_->device(); }
  const compare::Vec3f* lend_rows(StateField field, std::uint64_t version) override;
  std::vector<compare::Vec3f> copy_rows(StateField field, std::uint64_t version) override;
  int device_number() const { return state_->device_number(); }
  const compare::Scene& scene() const { return scene_; }

 private:
  void begin_overwriting() {
    if (is_lent()) state_->wait_for_device();
    note_overwritten();
  }

  compare::Scene scene_;
  std::unique_ptr<compare::Simulation> simulation_;
  fast::ResidentState* state_ = nullptr;  // of simulation_
  std::vector<compare::StepMetrics> rows_;
  std::string failure_;
  mutable std::mutex busy_;
};

}  // namespace ogc::python
