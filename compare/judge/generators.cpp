#include "compare/judge/generators.hpp"

#include "compare/judge/states.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {

namespace {

constexpr Generator real_states{"states", 50, true, nullptr};

}  // namespace

std::span<const Generator> generators(Stage stage) {
  switch (stage) {
    case Stage::closest_face: return closest_face_generators();
    case Stage::closest_points: return closest_points_generators();
    case Stage::bound: return bound_generators();
    case Stage::activation: return activation_generators();
    case Stage::truncate: return truncate_generators();
    default: return detect_generators();
  }
}

const Generator& find_generator(Stage stage, std::string_view name) {
  if (name == real_states.name) return real_states;
  std::string known;
  for (const Generator& generator : generators(stage)) {
    if (generator.name == name) return generator;
    known += std::string(generator.name) + ", ";
  }
  throw InputError("stage " + std::string(stage_name(stage)) + " has no generator '" + std::string(name) + "'; known: " + known + "states");
}

TestCase generate(const CaseName& name, const States* states) {
  const Generator& generator = find_generator(name.stage, name.generator);
  Random random(stage_name(name.stage), name.generator, name.seed, name.index);
  if (generator.make) return {name, generator.make(random)};
  if (!states) throw InputError("'" + print_problem(name) + "' asks for real states: name the run folder, states=RUN");
  return {name, states->make(name.stage, name.index, random)};
}

}  // namespace ogc::compare
