// The stages that an IPC solver's kernels are judged by: ccd and barrier.
#pragma once

#include "compare/stages/barrier.hpp"
#include "compare/stages/ccd.hpp"

namespace ogc::reference {

/// Returns impacts, decided without rounding (compare/oracle/first_meeting.hpp), and `early` by additive_ccd with the
/// remaining distance as its thickness.
compare::CcdTruth ccd_truth(const compare::CcdIn& in);

/// Computes the truth by barrier_slopes, in double.
compare::BarrierTruth barrier_truth(const compare::BarrierIn& in);

}  // namespace ogc::reference
