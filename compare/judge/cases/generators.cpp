#include "compare/judge/cases/generators.hpp"

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/legal.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/cases/parameters.hpp"
#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/cases/states.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {

namespace {

// The limit of grey decisions does not apply to real states. In a regular sheet every vertex lies on the planes of its
// neighbours, and parallel edges meet at the borders of blocks. Therefore many decisions are grey although no kernel is
// wrong.
constexpr Generator real_states{"states", 50, false, nullptr}, mutated_states{"mutated", 50, false, nullptr};

}  // namespace

std::span<const Generator> generators(Stage stage) { return traits_of(stage).generators(); }

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
    TestCase other = test;
    mutate(random, other);
    if (problem_of(other).empty()) test = std::move(other);
  }
  if (generator.name == "dust") add_dust(random, test);
  if (!test.name.overrides.empty()) apply_overrides(test);
  return test;
}

}  // namespace ogc::compare
