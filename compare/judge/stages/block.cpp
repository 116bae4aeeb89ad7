// Makes the traits of stage block.
#include <algorithm>
#include <array>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/engine/features.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/engine/topology_json.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

void judge_block(const TestCase& test, const BlockTruth& truth, const BlockOut& out, Tally& tally) {
  const auto& asked = case_of<BlockCase>(test.data);
  const auto& questions = asked.questions;
  tally.begin(test.name);
  const auto marked = [](const std::vector<std::uint8_t>& flags) {
    return static_cast<std::uint64_t>(std::count(flags.begin(), flags.end(), std::uint8_t{1}));
  };
  tally.count(questions.size(), questions.size(), marked(truth.grey), marked(truth.near));
  if (out.inside.size() != questions.size()) {
    tally.mismatch("inside has " + std::to_string(out.inside.size()) + " entries instead of " +
                   std::to_string(questions.size()));
    return;
  }
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (out.inside[i] == truth.inside[i]) continue;
    if (out.inside[i] <= 1 && truth.grey[i]) {
      tally.answered_not_exactly();
      continue;
    }
    tally.mismatch("question " + std::to_string(i) + ", " + question_name(questions[i], *asked.topology) + ": " +
                   std::to_string(out.inside[i]) + ", exact " + std::to_string(truth.inside[i]));
  }
}

namespace {

bool has_vertex(const Topology& topology, const Face& face, Index v) {
  const auto has = [v](const auto& vertices) {
    return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
  };
  const auto i = static_cast<std::size_t>(face.index);
  switch (face.kind) {
    case FaceKind::vertex: return face.index == v;
    case FaceKind::edge: return has(topology.edges[i]);
    case FaceKind::triangle: return has(topology.triangles[i]);
  }
  return false;
}

bool is_question(const BlockCase& c, const BlockQuestion& question) {
  if (question.kind == BlockQuestion::Kind::vertex_in_surface)
    return !has_vertex(*c.topology, question.face, question.of);
  const Edge& e = c.topology->edges[static_cast<std::size_t>(question.of)];
  return question.face.kind != FaceKind::triangle && !has_vertex(*c.topology, question.face, e[0]) &&
         !has_vertex(*c.topology, question.face, e[1]);
}

constexpr std::array<std::string_view, 2> question_kinds{"vertex_in_surface", "edge_in_edges"};
constexpr std::array<std::string_view, 3> face_kinds{"vertex", "edge", "triangle"};

Json question_to_json(const BlockQuestion& question) {
  return {{"kind", question_kinds[static_cast<std::size_t>(question.kind)]},
          {"of", question.of},
          {"face", face_kinds[static_cast<std::size_t>(question.face.kind)]},
          {"index", question.face.index}};
}

BlockQuestion to_question(const Json& json) {
  return {static_cast<BlockQuestion::Kind>(number_of(json.at("kind"), question_kinds)),
          json.at("of").get<Index>(),
          {static_cast<FaceKind>(number_of(json.at("face"), face_kinds)), json.at("index").get<Index>()}};
}

void check_question(const BlockQuestion& question, const Topology& topology) {
  const auto names = [](Index i, std::size_t count) { return i >= 0 && static_cast<std::size_t>(i) < count; };
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  const bool is_edge = question.kind == BlockQuestion::Kind::edge_in_edges;
  const std::array<std::size_t, 3> counts{vertices, topology.edges.size(), topology.triangles.size()};
  if (!names(question.of, is_edge ? topology.edges.size() : vertices) ||
      !names(question.face.index, counts[static_cast<std::size_t>(question.face.kind)]) ||
      (is_edge && question.face.kind == FaceKind::triangle))
    throw InputError("a question names a face that does not exist: of " + std::to_string(question.of) + ", index " +
                     std::to_string(question.face.index));
}

std::vector<WrongForm> block_forms() {
  const auto changed = [](std::string name, std::string meaning, std::uint8_t (*change)(std::uint8_t)) {
    return told(std::move(name), std::move(meaning), &Authority::block, [change](const BlockIn&, BlockTruth& truth) {
      for (std::uint8_t& inside : truth.inside) inside = change(inside);
    });
  };
  return {
      changed("inverted", "inside for outside", [](std::uint8_t inside) { return static_cast<std::uint8_t>(!inside); }),
      changed("always_inside", "every point counts as inside: no test at all",
              [](std::uint8_t) { return std::uint8_t{1}; }),
      changed("always_outside", "no point counts as inside", [](std::uint8_t) { return std::uint8_t{0}; })};
}

struct Block : MeshStage<Block, &Contestant::block, &Authority::block>,
               TakenWhole,
               Numbered,
               OwnCases,
               NoParameters,
               InEveryRun {
  using Case = BlockCase;
  static constexpr StageInfo info{.name = "block",
                                  .question = "is a point in the block of a face",
                                  .unit = "question",
                                  .reference = "reference/geometry/block.cpp",
                                  .kind = CaseKind::mesh,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::span<const MetricInfo> metrics{};

  static std::span<const Generator> generators() { return block_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    problem.vectors("a coordinate", c.positions);
    for (const BlockQuestion& question : c.questions)
      problem.require(is_question(c, question), "a question is about a face that has a vertex of the asking one");
  }
  static void mutate(Random& random, Case& c) {
    // If edges move, they may become parallel, which makes questions about them illegal.
    std::erase_if(c.questions, [](const BlockQuestion& q) {
      return q.kind == BlockQuestion::Kind::edge_in_edges && q.face.kind == FaceKind::edge;
    });
    mutate_points(random, c.positions);
  }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.positions}); }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.block(states.frame(index), random);
  }

  static Json write(const Case& c) {
    Json questions = Json::array();
    for (const BlockQuestion& question : c.questions) questions.push_back(question_to_json(question));
    return {
        {"mesh", topology_to_json(*c.topology)}, {"positions", points_to_json(c.positions)}, {"questions", questions}};
  }
  static Case read(const Json& data) {
    Case c{to_topology(data.at("mesh"), data.at("positions").size()), {}, {}};
    for (const Json& p : data.at("positions")) c.positions.push_back(to_point(p));
    if (c.positions.size() != static_cast<std::size_t>(c.topology->vertex_count))
      throw InputError("positions need one entry a vertex");
    for (const Json& question : data.at("questions")) {
      c.questions.push_back(to_question(question));
      check_question(c.questions.back(), *c.topology);
    }
    return c;
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add(*c.topology, c.positions);
    for (const BlockQuestion& question : c.questions)
      if (question.kind == BlockQuestion::Kind::vertex_in_surface) shape.dots.push_back(question.of);
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    std::vector<std::string> questions;
    for (const BlockQuestion& question : c.questions) questions.push_back(question_name(question, *c.topology));
    return joined(mesh_quantities(*c.topology),
                  std::vector{points("positions", "m", c.positions), words("questions", questions)});
  }

  static In question(const Case& c) { return {c.topology.get(), c.positions, c.questions}; }
  static constexpr auto judge = judge_block;
  static void add(Bits& bits, const Out& out) { bits.add(out.inside); }
  static std::int64_t items(const Case& c) { return static_cast<std::int64_t>(c.questions.size()); }

  template <class Answer>
  static std::vector<Quantity> outputs(const In& in, const Answer& answer) {
    Quantity inside = compare::numbers("inside", "", answer.inside);
    for (const BlockQuestion& question : in.questions) inside.labels.push_back(question_name(question, *in.topology));
    return {inside};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return block_forms(); }
};

}  // namespace

constinit const StageTraits stages::block = make_traits<Block>();

}  // namespace ogc::compare
