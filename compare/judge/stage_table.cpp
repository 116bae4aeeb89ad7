#include "compare/judge/stage_table.hpp"

namespace ogc::compare {

namespace {

constexpr auto everywhere = Determinism::cpu_to_gpu;

constexpr std::array<StageInfo, all_stages.size()> table{{
    {Stage::rest_state, "masses, stencils, rest angles, meeting stiffness of a scene", "vertex",
     "reference/energies/rest_state.cpp", false, everywhere},
    {Stage::closest_face, "the face of a triangle closest to a point, weights, distance", "pair",
     "reference/geometry/closest_face.cpp", true, everywhere},
    {Stage::closest_points, "the closest points of two edges, their faces, distance", "pair",
     "reference/geometry/closest_points.cpp", true, everywhere},
    {Stage::block, "is a point in the block of a face", "question", "reference/geometry/block.cpp", true, everywhere},
    {Stage::detect_vertex_facet, "all vertex–facet contacts, smallest distances", "vertex",
     "reference/geometry/detect_vertex_facet.cpp", true, everywhere},
    {Stage::detect_edge_edge, "all edge–edge contacts, smallest distances", "edge",
     "reference/geometry/detect_edge_edge.cpp", true, everywhere},
    {Stage::bound, "conservative bound of each vertex", "vertex", "reference/geometry/bound.cpp", false, everywhere},
    {Stage::initial_guess, "inertial target, truncated", "vertex", "reference/solvers/initial_guess.cpp", true,
     everywhere},
    {Stage::activation, "contact energy over distance, slope, curvature", "distance",
     "reference/energies/activation.cpp", true, everywhere},
    {Stage::contact_force, "normal force and block of one vertex of one contact", "stencil",
     "reference/energies/contact_force.cpp", true, everywhere},
    {Stage::friction_force, "likewise, friction", "stencil", "reference/energies/friction_force.cpp", true, everywhere},
    {Stage::membrane, "force and block of one corner of one triangle", "stencil", "reference/energies/membrane.cpp",
     false, everywhere},
    {Stage::bending, "force and block of one vertex of one hinge", "stencil", "reference/energies/bending.cpp", false,
     everywhere},
    {Stage::spring, "force and block of one end of one spring", "stencil", "reference/energies/spring.cpp", false,
     everywhere},
    {Stage::sweep, "one sweep over all colours", "vertex", "reference/solvers/sweep.cpp", false, everywhere},
    {Stage::truncate, "a position kept within its bound", "vertex", "reference/geometry/truncate.cpp", true,
     everywhere},
    {Stage::step, "Algorithm 3, event by event", "vertex at an event", "reference/solvers/step.cpp", false, everywhere},
}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table[i].stage != all_stages[i]) return false;
  return true;
}
static_assert(in_order());

}  // namespace

const std::array<StageInfo, all_stages.size()>& stage_table() { return table; }

const StageInfo& stage_info(Stage stage) { return table[static_cast<std::size_t>(stage)]; }

std::string_view determinism_name(Determinism level) {
  constexpr std::array<std::string_view, 4> names{"not_guaranteed", "run_to_run", "gpu_to_gpu", "cpu_to_gpu"};
  return names[static_cast<std::size_t>(level)];
}

}  // namespace ogc::compare
