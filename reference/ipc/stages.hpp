// What the judge asks of kernels of an IPC solver: the stages ccd and barrier.
#pragma once

#include "compare/stages/barrier.hpp"
#include "compare/stages/ccd.hpp"

namespace ogc::reference {

/// Impacts decided without rounding (compare/oracle/first_meeting.hpp); `early` by additive_ccd with the distance that
/// is left as its thickness.
compare::CcdTruth ccd_truth(const compare::CcdIn& in);

/// By barrier_slopes, in double.
compare::BarrierTruth barrier_truth(const compare::BarrierIn& in);

}  // namespace ogc::reference
