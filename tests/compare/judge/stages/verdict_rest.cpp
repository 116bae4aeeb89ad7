// Tests verdicts of rest_state, block and initial_guess on answers written by hand.
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "compare/judge/stages/verdict.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

/// Holds the truth and an answer for one triangle and one hinge. Most error scales are 1.
struct RestFixture {
  RestStateTruth truth;
  RestStateOut out;

  RestFixture() {
    truth.exact = {{1}, {{{0, 1, 2}, 0, 0.5f, {{{1, 0}, {0, 1}}}}}, {{{0, 1, 2, 3}, 0, 0.25f, 2}}, {1}, {{4, 0.5f}}};
    truth.mass = truth.mass_scale = {1};
    truth.area = {0.5};
    truth.gradient = {{{{1, 0}, {0, 1}}}};
    truth.gradient_scale = {{1, 1}};
    truth.rest_angle = {0.25};
    truth.rest_angle_scale = {4};
    truth.stiffness = {2};
    truth.weight = {{0, 0, 0}};
    truth.weight_scale = {1};
    truth.edge_length_squared = truth.edge_length_squared_scale = truth.area_scale = truth.stiffness_scale = {1};
    truth.meeting_stiffness = {4};
    truth.meeting_friction = {0.5};
    out = truth.exact;
  }
  Tally tally() const {
    Tally tally(Stage::rest_state);
    judge_rest_state({{Stage::rest_state, "soup", 0, 0, "", {}}, RestStateCase{}}, truth, out, tally);
    return tally;
  }
  std::string verdict() const {
    const Tally judged = tally();
    return judged.mismatches.empty() ? "" : judged.mismatches[0].message;
  }
  /// Returns the verdict after a change to the right answer.
  static std::string after(const std::function<void(RestStateOut&)>& change) {
    RestFixture test;
    change(test.out);
    return test.verdict();
  }
};

std::string block_verdict(std::vector<std::uint8_t> answer) {
  BlockCase c{std::make_shared<Topology>(), {}, {}};
  c.questions = {{BlockQuestion::Kind::vertex_in_surface, 0, {FaceKind::edge, 7}},
                 {BlockQuestion::Kind::edge_in_edges, 3, {FaceKind::vertex, 1}}};
  Tally tally(Stage::block);
  judge_block({{Stage::block, "soup", 0, 0, "", {}}, c}, {{1, 0}, {0, 1}, {0, 1}}, {std::move(answer)}, tally);
  return tally.mismatches.empty() ? "" : tally.mismatches[0].message;
}

/// Holds a motion by (3, 4, 0) from (1, 0, 0) with bound 2.5, so truncation halves it.
struct GuessFixture {
  InitialGuessIn in{{{{1, 0, 0}, {3, 4, 0}, {}, 1, {1, 0, 0}, 2.5f, 0}}};
  InitialGuessTruth truth{{{4, 4, 0}}, {4}};
  TruncateTruth cut{{1}, {0}, {0}, {{2.5, 2, 0}}};
  InitialGuessOut out{{{4, 4, 0}}, {{2.5f, 2, 0}}, {1}};

  std::string verdict() const {
    const std::vector<TestCase> cases{{{Stage::initial_guess, "uniform", 0, 0, "", {}}, in.cases[0]}};
    Tally tally(Stage::initial_guess);
    judge_initial_guess(cases, in, truth, cut, out, tally);
    return tally.mismatches.empty() ? "" : tally.mismatches[0].message;
  }
};

}  // namespace

TEST_CASE("rest_state: stencils by name, numbers within one rounding of their unit", "[unit]") {
  CHECK(RestFixture().verdict().empty());
  CHECK(RestFixture::after([](RestStateOut& out) { out.mass[0] = std::nextafter(1.0f, 0.0f); }).empty());
  CHECK(RestFixture::after([](RestStateOut& out) { out.mass[0] = 1 - 0x1.8p-23f; }).starts_with("mass"));
  CHECK(RestFixture::after([](RestStateOut& out) {
          out.mass[0] = std::numeric_limits<float>::quiet_NaN();
        }).starts_with("mass"));
  CHECK(RestFixture::after([](RestStateOut& out) { out.mass.clear(); }).starts_with("mass"));
  CHECK(RestFixture::after([](RestStateOut& out) { out.triangles[0].area = 0.5001f; }).starts_with("area"));
  CHECK(RestFixture::after([](RestStateOut& out) { out.triangles[0].corner = {1, 2, 0}; }).starts_with("triangle 0"));
  CHECK(RestFixture::after([](RestStateOut& out) { out.triangles[0].gradient[1][0] = 1e-6f; }).starts_with("gradient"));
  CHECK(RestFixture::after([](RestStateOut& out) { out.hinges[0].body = 1; }).starts_with("hinge 0"));
  CHECK(RestFixture::after([](RestStateOut& out) { out.hinges[0].stiffness = 2.001f; }).starts_with("stiffness"));
  CHECK(RestFixture::after([](RestStateOut& out) { out.hinges[0].rest_angle = -0.25f; }).starts_with("rest_angle"));
  CHECK(RestFixture::after([](RestStateOut& out) {
          out.edge_length_squared[0] = 1.001f;
        }).starts_with("edge_length_squared"));
  CHECK(RestFixture::after([](RestStateOut& out) { out.meetings[0].stiffness = 4.001f; }).starts_with("meeting"));
  CHECK(RestFixture::after([](RestStateOut& out) { out.meetings[0].friction = 0; }).starts_with("meeting"));
}

TEST_CASE("rest_state: an angle that cannot be told from a half turn may have either sign, any other may not",
          "[unit]") {
  RestFixture test;
  test.truth.rest_angle = {std::numbers::pi - 1e-7};
  test.out.hinges[0].rest_angle = std::numbers::pi_v<float>;
  CHECK(test.verdict().empty());
  CHECK(test.tally().total().not_exact == 0);
  test.out.hinges[0].rest_angle = -std::numbers::pi_v<float>;
  CHECK(test.verdict().empty());
  CHECK(test.tally().total().not_exact == 1);
  test.truth.rest_angle = {std::numbers::pi - 1e-5};
  CHECK(test.verdict().starts_with("rest_angle"));
}

TEST_CASE("block: equal outside grey questions, which are named where they are wrong", "[unit]") {
  CHECK(block_verdict({1, 0}).empty());
  CHECK(block_verdict({1, 1}).empty());
  CHECK(block_verdict({0, 0}).find("vertex 0 in the block of edge 7") != std::string::npos);
  CHECK_FALSE(block_verdict({1, 2}).empty());
  CHECK_FALSE(block_verdict({1}).empty());
}

TEST_CASE("initial_guess: the target, then position and cut for the target that is stored", "[unit]") {
  GuessFixture test;
  CHECK(test.verdict().empty());
  test.out.target[0].x = std::nextafter(4.0f, 5.0f);
  CHECK(test.verdict().empty());
  test.out.target[0].x = 4.0001f;
  CHECK(test.verdict().starts_with("target"));
  test.out.target[0].x = std::numeric_limits<float>::infinity();
  CHECK(test.verdict().starts_with("target"));
  test = {};
  test.out.cut[0] = 0;
  CHECK(test.verdict().starts_with("cut"));
  test = {};
  test.out.position[0] = {4, 4, 0};
  CHECK(test.verdict().find("from the previous one") != std::string::npos);
  test.out.position.clear();
  CHECK_FALSE(test.verdict().empty());
}

TEST_CASE("initial_guess: truncation is asked about the stored target, or about nothing where that is no point",
          "[unit]") {
  GuessFixture test;
  CHECK(cut_question(test.in, test.out).position[0] == Vec3f{4, 4, 0});
  test.out.target[0].y = std::numeric_limits<float>::quiet_NaN();
  CHECK(cut_question(test.in, test.out).position[0] == Vec3f{1, 0, 0});
  test.out.target.clear();
  CHECK(cut_question(test.in, test.out).position.size() == 1);
}
