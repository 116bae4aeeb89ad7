#include "compare/judge/determinism.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "compare/judge/judge.hpp"
#include "compare/judge/questions.hpp"
#include "compare/judge/renumbered.hpp"
#include "compare/judge/stage_table.hpp"
#include "compare/judge/sweep_question.hpp"

namespace ogc::compare {

namespace {

/// The bits of numbers one after another.
class Bits {
 public:
  template <class T>
  void add(const T& value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  template <class T>
  void add(const std::vector<T>& values) {
    add(values.size());
    for (const T& value : values) add(value);
  }

  /// Faces have padding between their members.
  void add(const Face& face) {
    add(face.kind);
    add(face.index);
  }
  void add(const VertexFacetContact& c) {
    add(c.vertex);
    add(c.face);
    add(c.owner);
  }
  void add(const EdgeEdgeContact& c) {
    add(c.first);
    add(c.second);
    add(c.first_edge);
    add(c.second_edge);
  }
  void add(const DetectVertexFacetOut& out) {
    add(out.contacts);
    add(out.d_min_vertex);
    add(out.d_min_triangle);
  }
  void add(const DetectEdgeEdgeOut& out) {
    add(out.contacts);
    add(out.d_min_edge);
  }
  void add(const RestStateOut& out) {
    add(out.mass);
    add(out.triangles);
    add(out.hinges);
    add(out.edge_length_squared);
    add(out.meetings);
  }
  void add(const SweepOut& out) {
    add(out.position);
    add(out.cut);
  }
  void add(const StepEvent& event) {
    add(event.kind);
    add(event.position);
    add(event.cut);
    add(event.vertex_facet);
    add(event.edge_edge);
    add(event.bound);
  }
  void add(const StepOut& out) {
    add(out.colour);
    add(out.rest);
    add(out.query_radius);
    add(out.target);
    for (const StepEvent& event : out.events) add(event);
    add(out.position);
    add(out.velocity);
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Entry i of each array belongs to case i.
template <class... Arrays>
std::vector<std::string> by_case(std::size_t count, const Arrays&... arrays) {
  std::vector<Bits> bits(count);
  const auto add_entries = [&](const auto& array) {
    for (std::size_t i = 0; i < count && i < array.size(); ++i) bits[i].add(array[i]);
  };
  (add_entries(arrays), ...);
  std::vector<std::string> texts;
  for (Bits& one : bits) texts.push_back(one.take());
  return texts;
}

std::vector<std::string> pair_bits(Stage stage, Cases cases, const Contestant& contestant) {
  const std::size_t n = cases.size();
  const auto of_force = [&](const ForceOut& out) { return by_case(n, out.force, out.block); };
  switch (stage) {
    case Stage::closest_face: {
      const ClosestFaceOut out = contestant.closest_face(face_question(cases));
      return by_case(n, out.feature, out.weights, out.distance, out.distance_below);
    }
    case Stage::closest_points: {
      const ClosestPointsOut out = contestant.closest_points(points_question(cases));
      return by_case(n, out.first_feature, out.second_feature, out.nearly_parallel, out.parameters,
                     out.contact_distance, out.distance_below);
    }
    case Stage::initial_guess: {
      const InitialGuessOut out = contestant.initial_guess(case_question(cases, &InitialGuessIn::cases));
      return by_case(n, out.target, out.position, out.cut);
    }
    case Stage::activation: {
      const ActivationOut out = contestant.activation(activation_question(cases));
      return by_case(n, out.energy, out.slope, out.curvature);
    }
    case Stage::contact_force: return of_force(contestant.contact_force(case_question(cases, &ContactForceIn::cases)));
    case Stage::friction_force:
      return of_force(contestant.friction_force(case_question(cases, &FrictionForceIn::cases)));
    case Stage::membrane: return of_force(contestant.membrane(case_question(cases, &MembraneIn::cases)));
    case Stage::spring: return of_force(contestant.spring(case_question(cases, &SpringIn::cases)));
    case Stage::bending: return of_force(contestant.bending(case_question(cases, &BendingIn::cases)));
    default: {
      const TruncateOut out = contestant.truncate(truncate_question(cases));
      return by_case(n, out.position, out.exceeded);
    }
  }
}

std::string mesh_bits(Stage stage, const TestCase& test, const Contestant& contestant, const Authority& authority) {
  Bits bits;
  switch (stage) {
    case Stage::rest_state: bits.add(contestant.rest_state(rest_question(test))); break;
    case Stage::block: bits.add(contestant.block(block_question(test)).inside); break;
    case Stage::detect_vertex_facet: bits.add(contestant.detect_vertex_facet(detect_question(test))); break;
    case Stage::detect_edge_edge: bits.add(contestant.detect_edge_edge(detect_question(test))); break;
    case Stage::bound: bits.add(contestant.bound(bound_question(test)).bound); break;
    case Stage::sweep: {
      const SweepQuestion question(std::get<SweepCase>(test.data), authority);
      bits.add(contestant.sweep(question.in()));
      break;
    }
    default: bits.add(contestant.step(step_question(test)));
  }
  return bits.take();
}

/// In batches of that size.
std::vector<std::string> in_batches(Stage stage, Cases cases, std::size_t size, const Contestant& contestant,
                                    const Authority& authority) {
  std::vector<std::string> all;
  for (std::size_t first = 0; first < cases.size(); first += size) {
    const auto part = answer_bits(stage, cases.subspan(first, std::min(size, cases.size() - first)), contestant,
                                  authority);
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

/// A fixed shuffle, by the judge's own random numbers.
std::vector<std::size_t> shuffled(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random("determinism", "shuffle", 1, count);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
  return order;
}

std::uint64_t digest_of(const std::vector<std::string>& bits) {
  std::uint64_t digest = 0xcbf29ce484222325u;
  for (const std::string& answer : bits)
    for (const char c : answer) digest = (digest ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return digest;
}

std::vector<TestCase> cases_of(Stage stage, std::uint64_t count, std::uint64_t seed) {
  std::vector<TestCase> cases;
  double shares = 0;
  for (const Generator& row : generators(stage)) shares += row.least > 0 ? 0 : row.share;
  for (const Generator& row : generators(stage)) {
    if (row.least > 0) continue;
    const auto wanted = static_cast<std::uint64_t>(static_cast<double>(count) * row.share / shares) + 1;
    for (std::uint64_t i = 0; i < wanted; ++i)
      cases.push_back(generate({stage, std::string(row.name), seed, i, "", {}}));
  }
  return cases;
}

}  // namespace

std::vector<std::string> answer_bits(Stage stage, std::span<const TestCase> cases, const Contestant& contestant,
                                     const Authority& authority) {
  if (cases.empty()) return {};
  if (!is_mesh_stage(stage)) return pair_bits(stage, cases, contestant);
  std::vector<std::string> bits;
  for (const TestCase& test : cases) bits.push_back(mesh_bits(stage, test, contestant, authority));
  return bits;
}

DeterminismReport check_determinism(Stage stage, std::uint64_t cases, std::uint64_t seed, const Contestant& contestant,
                                    const Authority& authority, std::span<const Surrounding> surroundings) {
  DeterminismReport report;
  report.stage = stage;
  if (!can_judge(stage, contestant, authority)) {
    report.skipped = true;
    return report;
  }
  const std::vector<TestCase> all = cases_of(stage, cases, seed);
  const std::vector<std::string> right = answer_bits(stage, all, contestant, authority);
  report.cases = all.size();
  report.digest = digest_of(right);
  const auto compare_with = [&](const std::string& way, const std::vector<std::string>& bits) {
    std::size_t count = 0, first = 0;
    for (std::size_t i = right.size(); i-- > 0;)
      if (i >= bits.size() || bits[i] != right[i]) {
        ++count;
        first = i;
      }
    if (count > 0)
      report.changed.push_back(way + ": " + std::to_string(count) + " cases, the first " +
                               print_problem(all[first].name));
  };
  compare_with("again", answer_bits(stage, all, contestant, authority));
  for (const Surrounding& surrounding : surroundings)
    surrounding.run([&] { compare_with(surrounding.name, answer_bits(stage, all, contestant, authority)); });
  const std::vector<std::size_t> order = shuffled(all.size());
  std::vector<TestCase> mixed;
  for (const std::size_t i : order) mixed.push_back(all[i]);
  const std::vector<std::string> answers = answer_bits(stage, mixed, contestant, authority);
  std::vector<std::string> sorted(all.size());
  for (std::size_t i = 0; i < order.size() && i < answers.size(); ++i) sorted[order[i]] = answers[i];
  compare_with("shuffled", sorted);
  if (is_free_of_order(stage)) {
    std::vector<TestCase> generic;
    const auto is_generic = [](const TestCase& test) {
      return find_generator(test.name.stage, test.name.generator).generic;
    };
    std::copy_if(all.begin(), all.end(), std::back_inserter(generic), is_generic);
    const std::vector<bool> same = same_when_renumbered(stage, generic, contestant);
    if (const auto wrong = std::find(same.begin(), same.end(), false); wrong != same.end())
      report.changed.push_back("renumbered: " + std::to_string(std::count(same.begin(), same.end(), false)) +
                               " cases, the first " +
                               print_problem(generic[static_cast<std::size_t>(wrong - same.begin())].name));
  }
  if (!is_mesh_stage(stage))
    for (const std::size_t size : {1u, 2u, 3u, 5u, 10u, 50u})
      compare_with("batches of " + std::to_string(size), in_batches(stage, all, size, contestant, authority));
  return report;
}

std::string determinism_table(std::span<const DeterminismReport> reports) {
  std::string text;
  for (const DeterminismReport& report : reports) {
    char line[160];
    std::snprintf(line, sizeof line, "%-20s %-12s %8llu  %016llx  %s\n", std::string(stage_name(report.stage)).c_str(),
                  std::string(determinism_name(stage_info(report.stage).determinism)).c_str(),
                  static_cast<unsigned long long>(report.cases), static_cast<unsigned long long>(report.digest),
                  report.skipped           ? "skipped"
                  : report.changed.empty() ? "the same bits"
                                           : "CHANGES:");
    text += line;
    for (const std::string& change : report.changed) text += "  " + change + "\n";
  }
  return text;
}

}  // namespace ogc::compare
