#include "reference/solvers/residual.hpp"

#include "reference/solvers/contact_step.hpp"
#include "reference/solvers/vertex_system.hpp"

namespace ogc::reference {
namespace {

/// Stands before the step that reads it.
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
                  std::int64_t number) {
    begin(start, velocity, number);
    guess(GuessEnd::rounds);
    at(x_);
  }

  Residual at(const State& x) {
    x_ = x;
    detect_here();
    return measured(detected_.sets);
  }

  Residual with(const ContactSets& contacts, const State& previous, const State& x) {
    x_ = x;
    potential_.set_contacts(contacts, previous);
    return measured(contacts);
  }

  double reference_force() const { return reference_force_; }

 private:
  Residual measured(const ContactSets& contacts) {
    systems_.read_contacts();
    const double force = systems_.mean_force(x_);
    set_residual(force);
    return {residual_, force, Potential::total(potential_.terms(x_)),
            static_cast<std::int64_t>(contacts.vertex_facet.size() + contacts.edge_edge.size())};
  }

  VertexSystems systems_;
};

ResidualMeter::ResidualMeter(const compare::Scene& scene) : meter_(std::make_unique<Meter>(scene)) {}
ResidualMeter::~ResidualMeter() = default;

void ResidualMeter::begin_step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                               std::int64_t number) {
  meter_->begin_step(start, velocity, number);
}

double ResidualMeter::reference_force() const { return meter_->reference_force(); }

Residual ResidualMeter::at(const std::vector<compare::Vec3f>& position) { return meter_->at(widened(position)); }
Residual ResidualMeter::at(const std::vector<std::array<double, 3>>& position) { return meter_->at(position); }

Residual ResidualMeter::with(const ContactSets& contacts, const std::vector<compare::Vec3f>& previous,
                             const std::vector<compare::Vec3f>& position) {
  return meter_->with(contacts, widened(previous), widened(position));
}

}  // namespace ogc::reference
