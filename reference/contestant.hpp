// Provides the reference as the judge's authority: exact for discrete answers, with derived error bounds for all
// others. It also provides the reference's solvers as contestants that only start simulations.
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

/// Returns the authority with all stages of the reference.
compare::Authority authority();

/// Returns Newton-OGC (method.md §7.6). It answers no stage and only starts simulations.
compare::Contestant newton();

/// Returns the penalty baseline: Newton's method without bounds, line search or guarantee. It answers no stage.
compare::Contestant penalty();

/// Returns the IPC baseline. It answers no stage.
compare::Contestant ipc();

/// Returns Vertex Block Descent in double. It answers no stage. `colours` returns the colours of a scene's vertices and
/// is called once for each simulation (reference/solvers/vbd_solver.hpp). If it is empty, the solver colours the
/// vertices itself.
compare::Contestant vbd(std::function<std::vector<compare::Index>(const compare::Scene&)> colours = {});

}  // namespace ogc::reference
