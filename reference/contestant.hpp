// The reference as the judge's authority: exact where the answer is discrete, correctly bounded where it is not.
#pragma once

#include "compare/contestant.hpp"
#include "reference/definitions/block_margins.hpp"
#include "reference/definitions/contact_sets.hpp"
#include "reference/definitions/gauss_map.hpp"
#include "reference/definitions/nearest.hpp"
#include "reference/definitions/pair_margins.hpp"
#include "reference/geometry/filter_counts.hpp"
#include "reference/geometry/plane.hpp"
#include "reference/geometry/primitive_distances.hpp"
#include "reference/illustrations/activation_drawing.hpp"
#include "reference/illustrations/illustrations.hpp"
#include "reference/ipc/stopping.hpp"
#include "reference/solvers/ledger.hpp"
#include "reference/solvers/residual.hpp"
#include "reference/solvers/variants/settings.hpp"

namespace ogc::reference {

/// Every stage that the reference has.
compare::Authority authority();

/// Newton-OGC: no stages, but a simulation to `start` (method.md §7.6).
compare::Contestant newton();

/// The penalty baseline: Newton's method without bounds, line search or guarantee. Likewise.
compare::Contestant penalty();

/// The IPC baseline: likewise.
compare::Contestant ipc();

/// Vertex Block Descent in double, likewise. `colours`: of a scene's vertices, asked once a simulation
/// (reference/solvers/vbd_solver.hpp); empty for its own.
compare::Contestant vbd(std::function<std::vector<compare::Index>(const compare::Scene&)> colours = {});

}  // namespace ogc::reference
