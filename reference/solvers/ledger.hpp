// The ledger of a step that somebody else took: what its parts did to energy and momentum (reference/ledger.md), from
// the trace of the step alone. What a sweep would have written without bounds is computed here, in double, from the
// positions that the trace has before and after it; so the solver needs no code for this, wherever it computes.
#pragma once

#include <memory>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/stages/step.hpp"
#include "reference/solvers/contacts.hpp"

namespace ogc::reference {

/// Writes the ledgers of a scene's steps.
class LedgerWriter {
 public:
  /// The scene is rounded here; it must be valid. Throws InputError for damping by vertex, which is no potential.
  explicit LedgerWriter(const compare::Scene& scene);
  ~LedgerWriter();
  /// Of the step from Xᵗ, Vᵗ that `trace` tells; `contacts_at_end`: those that its solver's detections find at the
  /// trace's last position, up to r. Throws std::invalid_argument where the trace does not begin with a detection.
  compare::StepLedger of(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                         const compare::StepOut& trace, const ContactSets& contacts_at_end);

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace ogc::reference
