// Computes the ledger of a step that any solver took: what the parts of the step did to energy and momentum
// (reference/ledger.md), from the trace of the step alone. What a sweep would have written without bounds is computed
// here, in double, from the positions before and after it in the trace; so no solver needs code for this, on whatever
// device it runs.
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
  /// Rounds its copy of the scene, which must be valid. Throws InputError for damping by vertex, which has no
  /// potential.
  explicit LedgerWriter(const compare::Scene& scene);
  ~LedgerWriter();
  /// Returns the ledger of the step from Xᵗ, Vᵗ that `trace` records. `contacts_at_end`: the contacts up to r that the
  /// solver's detections find at the trace's last position. Throws std::invalid_argument where the trace does not begin
  /// with a detection.
  compare::StepLedger of(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                         const compare::StepOut& trace, const ContactSets& contacts_at_end);

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace ogc::reference
