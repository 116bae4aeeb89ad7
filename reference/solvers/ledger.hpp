// Computes the ledger of a step by any solver: the changes of energy and momentum by each part of the step
// (reference/ledger.md). The trace of the step is enough: what a sweep would have written without bounds is computed
// here in double from the positions before and after it. So no solver or device needs code for the ledger.
#pragma once

#include <memory>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/stages/step.hpp"
#include "reference/solvers/contacts.hpp"

namespace ogc::reference {

/// Computes the ledgers of a scene's steps.
class LedgerWriter {
 public:
  /// Rounds its copy of the scene, which must be valid. Throws InputError for damping by vertex, which has no
  /// potential.
  explicit LedgerWriter(const compare::Scene& scene);
  ~LedgerWriter();
  /// Returns the ledger of the step from Xᵗ, Vᵗ that `trace` records. `contacts_at_end`: the contacts up to r at the
  /// trace's last position, as the solver's detections find them. Throws std::invalid_argument if the trace does not
  /// begin with a detection.
  compare::StepLedger of(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                         const compare::StepOut& trace, const ContactSets& contacts_at_end);

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace ogc::reference
