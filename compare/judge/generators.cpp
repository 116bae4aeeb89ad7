#include "compare/judge/generators.hpp"

#include "compare/judge/dust.hpp"
#include "compare/judge/legal.hpp"
#include "compare/judge/mutate.hpp"
#include "compare/judge/parameters.hpp"
#include "compare/judge/states.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {

namespace {

// In a regular sheet every vertex lies on the planes of its neighbours, and parallel edges meet on the borders of
// blocks: grey decisions about frames say nothing of the kernel, so that no limit holds for them.
constexpr Generator real_states{"states", 50, false, nullptr}, mutated_states{"mutated", 50, false, nullptr};

}  // namespace

std::span<const Generator> generators(Stage stage) {
  switch (stage) {
    case Stage::closest_face: return closest_face_generators();
    case Stage::closest_points: return closest_points_generators();
    case Stage::rest_state: return rest_state_generators();
    case Stage::block: return block_generators();
    case Stage::initial_guess: return initial_guess_generators();
    case Stage::bound: return bound_generators();
    case Stage::activation: return activation_generators();
    case Stage::truncate: return truncate_generators();
    case Stage::contact_force: return contact_force_generators();
    case Stage::friction_force: return friction_force_generators();
    case Stage::membrane: return membrane_generators();
    case Stage::bending: return bending_generators();
    case Stage::spring: return spring_generators();
    case Stage::sweep: return sweep_generators();
    case Stage::step: return step_generators();
    default: return detect_generators();
  }
}

const Generator& find_generator(Stage stage, std::string_view name) {
  if (name == real_states.name) return real_states;
  if (name == mutated_states.name) return mutated_states;
  std::string known;
  for (const Generator& generator : generators(stage)) {
    if (generator.name == name) return generator;
    known += std::string(generator.name) + ", ";
  }
  throw InputError("stage " + std::string(stage_name(stage)) + " has no generator '" + std::string(name) +
                   "'; known: " + known + "states, mutated");
}

TestCase generate(const CaseName& name, const States* states) {
  return generate(find_generator(name.stage, name.generator), name, states);
}

TestCase generate(const Generator& generator, CaseName name, const States* states) {
  Random random(stage_name(name.stage), name.generator, name.seed, name.index);
  if (!generator.make && !states)
    throw InputError("'" + print_problem(name) + "' asks for real states: name the run folder, states=RUN");
  CaseData data = generator.make ? generator.make(random) : states->make(name.stage, name.index, random);
  TestCase test{std::move(name), std::move(data)};
  if (generator.name == mutated_states.name) {
    CaseData mutated = test.data;
    mutate(random, mutated);
    if (problem_of(mutated).empty()) test.data = std::move(mutated);
  }
  if (generator.name == "dust") add_dust(random, test.data);
  if (!test.name.overrides.empty()) apply_overrides(test);
  return test;
}

}  // namespace ogc::compare
