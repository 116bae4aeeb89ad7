#include "reference/solvers/residual.hpp"

#include <limits>

#include "reference/solvers/contact_step.hpp"
#include "reference/solvers/vertex_system.hpp"

namespace ogc::reference {
namespace {

/// The scene and its topology. It is a base class, so that it is constructed before the ContactStep that reads it.
struct Problem {
  compare::Scene scene;
  compare::Topology topology;
  explicit Problem(const compare::Scene& from) : scene(from) {
    round_to_single(scene);
    topology = build_topology(scene);
  }
};

}  // namespace

class ResidualMeter::Meter : private Problem, private ContactStep {
 public:
  explicit Meter(const compare::Scene& from)
      : Problem(from), ContactStep(scene, topology, {}, 1), systems_(potential_) {}

  void begin_step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                  std::int64_t number, std::span<const compare::Quaternion> orientations) {
    potential_.rods().set_start(orientations);
    begin(start, velocity, number);
    guess(GuessEnd::rounds);
    at(x_, {});
  }

  Residual at(const State& x, std::span<const compare::Quaternion> orientations) {
    x_ = x;
    potential_.rods().put(orientations);
    detect_here();
    return measured(detected_.sets);
  }

  Residual with(const ContactSets& contacts, const State& previous, const State& x,
                std::span<const compare::Quaternion> orientations) {
    x_ = x;
    potential_.rods().put(orientations);
    potential_.set_contacts(contacts, previous);
    return measured(contacts);
  }

  double reference_force() const { return reference_force_; }

 private:
  Residual measured(const ContactSets& contacts) {
    systems_.read_contacts();
    const std::vector<double> forces = systems_.forces(x_);
    const double force = systems_.mean_over_free(forces);
    set_residual(force);
    return {residual_,
            force,
            Potential::total(potential_.terms(x_)),
            potential_.rods().mean_torque(x_),
            static_cast<std::int64_t>(contacts.vertex_facet.size() + contacts.edge_edge.size()),
            shares(forces)};
  }

  std::vector<float> shares(const std::vector<double>& forces) const {
    std::vector<float> result;
    for (std::size_t v = 0; v < forces.size(); ++v) {
      const double share = reference_force_ > 0 ? forces[v] / reference_force_ : 0;
      const bool is_free = potential_.mobility()[v] == Mobility::free;
      result.push_back(is_free ? static_cast<float>(share) : std::numeric_limits<float>::quiet_NaN());
    }
    return result;
  }

  VertexSystems systems_;
};

ResidualMeter::ResidualMeter(const compare::Scene& scene) : meter_(std::make_unique<Meter>(scene)) {}
ResidualMeter::~ResidualMeter() = default;

void ResidualMeter::begin_step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                               std::int64_t number, std::span<const compare::Quaternion> orientations) {
  meter_->begin_step(start, velocity, number, orientations);
}

double ResidualMeter::reference_force() const { return meter_->reference_force(); }

Residual ResidualMeter::at(const std::vector<compare::Vec3f>& position,
                           std::span<const compare::Quaternion> orientations) {
  return meter_->at(widened(position), orientations);
}
Residual ResidualMeter::at(const std::vector<std::array<double, 3>>& position,
                           std::span<const compare::Quaternion> orientations) {
  return meter_->at(position, orientations);
}

Residual ResidualMeter::with(const ContactSets& contacts, const std::vector<compare::Vec3f>& previous,
                             const std::vector<compare::Vec3f>& position,
                             std::span<const compare::Quaternion> orientations) {
  return meter_->with(contacts, widened(previous), widened(position), orientations);
}

}  // namespace ogc::reference
