// Computes the truth of the stages ccd and barrier, by which the judge tests IPC kernels.
#pragma once

#include "compare/stages/barrier.hpp"
#include "compare/stages/ccd.hpp"

namespace ogc::reference {

/// Returns the impacts, decided without rounding (compare/oracle/first_meeting.hpp). CcdTruth::early is the time until
/// which additive_ccd keeps the distance above the limit that compare/stages/ccd.hpp states.
compare::CcdTruth ccd_truth(const compare::CcdIn& in);

/// Computes the truth with barrier_slopes, in double.
compare::BarrierTruth barrier_truth(const compare::BarrierIn& in);

}  // namespace ogc::reference
