// Computes the ledger of a step: how much each part of the step changes energy and momentum (reference/ledger.md). Only
// the step's trace is needed, from any solver: the positions that a sweep would have reached without bounds are
// computed here in double from the positions before and after the sweep. So neither solvers nor devices need code for
// the ledger.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/stages/step.hpp"
#include "reference/solvers/contacts.hpp"

namespace ogc::reference {

/// Computes the ledgers of the steps of one scene.
class LedgerWriter {
 public:
  /// Takes a valid scene and rounds its copy. Throws InputError for damping by vertex, which has no potential.
  explicit LedgerWriter(const compare::Scene& scene);
  ~LedgerWriter();
  /// Returns the ledger of the step from Xᵗ, Vᵗ that `trace` records. `contacts_at_end`: the contacts within r that the
  /// solver's detections find at the trace's last position. Throws std::invalid_argument if the trace does not begin
  /// with a detection.
  compare::StepLedger of(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                         const compare::StepOut& trace, const ContactSets& contacts_at_end);
  /// Returns by vertex whether the last sweep of that step cut it (1) or not (0). Their sum is the number in the trace.
  const std::vector<std::uint8_t>& cut() const;

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace ogc::reference
