#include "reference/solvers/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <tbb/parallel_for.h>

#include "reference/solvers/measure.hpp"
#include "reference/solvers/vertex_system.hpp"

namespace ogc::reference {
namespace {

using compare::at, compare::Index;
using compare::StepEvent;
using compare::StepEventKind;
using compare::StepLedger;
using compare::Vec3f;

void add(compare::Vec3& sum, const Triple<double>& a) { sum = {sum.x + a[0], sum.y + a[1], sum.z + a[2]}; }

/// The scene rounded to single precision, as the stages read it, and data derived from it. It is a base class, so that
/// it is constructed before the members that read it.
struct RoundedScene {
  compare::Scene scene;
  compare::Topology topology;
  compare::Exclusions exclusions;
  explicit RoundedScene(const compare::Scene& from) : scene(from), exclusions(compare::exclusions(from)) {
    round_to_single(scene);
    topology = build_topology(scene);
  }
};

}  // namespace

class LedgerWriter::Writer : private RoundedScene {
 public:
  explicit Writer(const compare::Scene& from)
      : RoundedScene(from), potential_(scene, topology), systems_(potential_), step_(scene.settings.time_step) {
    for (std::size_t v = 0; v < potential_.mobility().size(); ++v) {
      const Mobility mobility = potential_.mobility()[v];
      if (mobility == Mobility::free) free_.push_back(v);
      if (mobility == Mobility::prescribed) prescribed_.push_back(v);
      is_fixed_.push_back(mobility == Mobility::fixed ? 1 : 0);
    }
  }

  StepLedger write(const std::vector<Vec3f>& start, const std::vector<Vec3f>& velocity, const compare::StepOut& trace,
                   const ContactSets& contacts_at_end) {
    if (trace.events.empty() || trace.events.front().kind != StepEventKind::detection)
      throw std::invalid_argument("ledger: a step begins with a detection");
    ledger_ = {};
    cut_.clear();
    is_cut_.assign(start.size(), 0);
    query_radius_ = trace.query_radius;
    start_ = x_ = widened(start);
    target_ = widened(trace.target);
    potential_.begin_step(start_, target_);
    read_contacts({trace.events[0].vertex_facet.contacts, trace.events[0].edge_edge.contacts}, start);
    ledger_.energy_start = energy_ = potential_energy(x_) + kinetic_energy(velocity);
    for (const std::size_t v : free_) add(ledger_.momentum_start, potential_.mass()[v] * widened(velocity[v]));
    for (auto event = trace.events.begin() + 1; event != trace.events.end(); ++event) enter(*event, trace.colour);
    subtract(ledger_.momentum_guess, ledger_.momentum_start);
    read_contacts(contacts_at_end, trace.position);
    ledger_.energy_commit = potential_energy(x_) + kinetic_energy(trace.velocity) - energy_;
    ledger_.vertices_still = count_still(start, trace.position, free_);
    ledger_.vertices_held = count_still(start, trace.position, cut_);
    return ledger_;
  }

  const std::vector<std::uint8_t>& cut() const { return is_cut_; }

 private:
  static void subtract(compare::Vec3& from, const compare::Vec3& a) {
    from = {from.x - a.x, from.y - a.y, from.z - a.z};
  }

  static double count_still(const std::vector<Vec3f>& start, const std::vector<Vec3f>& end,
                            const std::vector<std::size_t>& vertices) {
    return static_cast<double>(std::ranges::count_if(vertices, [&](std::size_t v) { return start[v] == end[v]; }));
  }

  /// Sets the contacts, and the centres of the regions: X_prev = `previous`.
  void read_contacts(const ContactSets& contacts, const std::vector<Vec3f>& previous) {
    previous_ = previous;
    nearest_.assign(previous.size(), {});
    potential_.set_contacts(contacts, widened(previous));
    systems_.read_contacts();
  }

  double energy_at(const State& x, const State& start) const {
    compare::StepMetrics metrics;
    measure_energies(metrics, {x, start, target_}, potential_, scene, true);
    return metrics.kinetic_energy + metrics.elastic_energy + metrics.contact_energy + metrics.gravity_energy;
  }

  double potential_energy(const State& x) const { return energy_at(x, x); }

  double kinetic_energy(const std::vector<Vec3f>& velocity) const {
    double sum = 0;
    for (std::size_t v = 0; v < velocity.size(); ++v)
      sum += 0.5 * potential_.mass()[v] * dot(widened(velocity[v]), widened(velocity[v]));
    return sum;
  }

  /// Evaluates the energy at `x`, stores it, and returns the change since the last call.
  double change_to(const State& x) {
    const double now = energy_at(x, start_);
    return now - std::exchange(energy_, now);
  }

  /// Adds to `sum` the change of the free vertices' momentum from `from` to `to`.
  void add_momentum(compare::Vec3& sum, const State& from, const State& to) const {
    for (const std::size_t v : free_) add(sum, (potential_.mass()[v] / step_) * (to[v] - from[v]));
  }

  void enter(const StepEvent& event, const std::vector<Index>& colour) {
    switch (event.kind) {
      case StepEventKind::detection:
        read_contacts({event.vertex_facet.contacts, event.edge_edge.contacts}, event.position);
        ledger_.energy_detection += change_to(x_);
        return;
      case StepEventKind::guess: {
        const State guessed = widened(event.position);
        ledger_.energy_guess += change_to(guessed);
        add_momentum(ledger_.momentum_guess, x_, guessed);
        x_ = guessed;
        return;
      }
      case StepEventKind::sweep: enter_sweep(event, colour);
    }
  }

  void enter_sweep(const StepEvent& event, const std::vector<Index>& colour) {
    const State stored = widened(event.position);
    State proposed = proposals(stored, colour);
    for (const std::size_t v : free_)
      ledger_.motion_proposed += potential_.mass()[v] / step_ * length(proposed[v] - x_[v]);
    find_cut(proposed, stored, event.cut);
    enter_taken(proposed, stored);
    ledger_.energy_sweep += change_to(proposed);
    add_momentum(ledger_.momentum_sweep, x_, proposed);
    ledger_.energy_truncation += change_to(stored);
    add_momentum(ledger_.momentum_truncation, proposed, stored);
    x_ = stored;
  }

  /// Returns the positions before truncation: x + H⁻¹ f for each free vertex, the target for each prescribed vertex. A
  /// free vertex reads the stored positions of vertices with lower colours.
  State proposals(const State& stored, const std::vector<Index>& colour) const {
    State proposed = stored;
    const SweepView view{x_, stored, colour};
    for (const std::size_t v : prescribed_) proposed[v] = target_[v];
    tbb::parallel_for(std::size_t{0}, free_.size(), [&](std::size_t k) {
      const std::size_t v = free_[k];
      const VertexSystem system = systems_.at(static_cast<Index>(v), view);
      proposed[v] = x_[v] + solved(system, system.force);
    });
    return proposed;
  }

  /// Finds the vertices that the sweep cut; the trace has only their number. A prescribed vertex was cut if its stored
  /// position differs from its proposal, because nothing else changes it. Rounding makes the stored positions of all
  /// free vertices differ from their proposals. So the remaining cuts are assigned to the free vertices farthest from
  /// their proposals. The proposals of all other free vertices are set to their stored positions.
  void find_cut(State& proposed, const State& stored, Index cut) {
    std::ranges::fill(is_cut_, std::uint8_t{0});
    for (const std::size_t v : prescribed_) is_cut_[v] = proposed[v] != stored[v] ? 1 : 0;
    const auto behind = std::ranges::count(is_cut_, 1);
    const auto taken = [&](std::size_t v) { return length(proposed[v] - stored[v]); };
    cut_ = free_;
    const auto end = cut_.begin() + std::clamp<std::ptrdiff_t>(cut - behind, 0, std::ssize(cut_));
    std::ranges::nth_element(cut_, end, std::ranges::greater{}, taken);
    for (auto v = end; v != cut_.end(); ++v) proposed[*v] = stored[*v];
    cut_.erase(end, cut_.end());
    for (const std::size_t v : cut_) is_cut_[v] = 1;
  }

  /// Adds the momentum that truncation removed from the cut vertices: the total, and the parts across and against the
  /// normal towards the other side of the vertex's nearest pair.
  void enter_taken(const State& proposed, const State& stored) {
    find_nearest();
    for (const std::size_t v : cut_) {
      const Triple<double> taken = (potential_.mass()[v] / step_) * (proposed[v] - stored[v]),
                           n = widened(nearest_[v].normal);
      ledger_.motion_taken += length(taken);
      if (!(dot(n, n) > 0)) {
        ledger_.motion_taken_unpaired += length(taken);
        continue;
      }
      const double towards = dot(n, taken) / dot(n, n);
      ledger_.motion_taken_leaving += std::max(0.0, -towards * std::sqrt(dot(n, n)));
      ledger_.motion_taken_tangential += length(taken - towards * n);
    }
  }

  /// Finds for each cut vertex the nearest pair within r_q at X_prev.
  void find_nearest() {
    std::vector<std::uint8_t> sought(previous_.size(), 0);
    bool any = false;
    for (const std::size_t v : cut_) {
      if (std::exchange(nearest_[v].is_known, true)) continue;
      sought[v] = 1;
      any = true;
    }
    if (!any) return;
    const compare::PlaneIn in{.topology = &topology,
                              .exclusions = exclusions,
                              .positions = previous_,
                              .is_fixed = is_fixed_,
                              .query_radius = query_radius_,
                              .bounds_relaxation = static_cast<float>(scene.settings.bounds_relaxation)};
    for (const NearPair& pair : near_pairs_with_planes(in, sought))
      for (std::size_t k = 0; k < pair.vertices.size(); ++k) {
        Nearest& nearest = nearest_[at(pair.vertices[k])];
        if (!nearest.is_known || pair.below >= nearest.distance) continue;
        nearest.distance = pair.below;
        nearest.normal = pair.as_borne(k).normal;
      }
  }

  struct Nearest {
    bool is_known = false;                                    ///< whether the nearest pair was searched for
    float distance = std::numeric_limits<float>::infinity();  ///< [m]
    Vec3f normal{};  ///< from the vertex's side to the other; 0 if there is no pair
  };

  Potential potential_;
  VertexSystems systems_;
  double step_;
  std::vector<std::size_t> free_, prescribed_;
  std::vector<std::uint8_t> is_fixed_;
  State start_, target_, x_;
  double energy_ = 0;  ///< energy at x_ [J]
  float query_radius_ = 0;
  std::vector<Vec3f> previous_;       ///< X_prev of the last detection
  std::vector<Nearest> nearest_;      ///< by vertex, at X_prev
  std::vector<std::size_t> cut_;      ///< free vertices that the last sweep cut
  std::vector<std::uint8_t> is_cut_;  ///< by vertex: see LedgerWriter::cut
  StepLedger ledger_;
};

LedgerWriter::LedgerWriter(const compare::Scene& scene) : writer_(std::make_unique<Writer>(scene)) {}
LedgerWriter::~LedgerWriter() = default;

StepLedger LedgerWriter::of(const std::vector<Vec3f>& start, const std::vector<Vec3f>& velocity,
                            const compare::StepOut& trace, const ContactSets& contacts_at_end) {
  return writer_->write(start, velocity, trace, contacts_at_end);
}

const std::vector<std::uint8_t>& LedgerWriter::cut() const { return writer_->cut(); }

}  // namespace ogc::reference
