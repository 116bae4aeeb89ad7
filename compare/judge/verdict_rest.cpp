// Verdicts of rest_state and block.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/judge/features.hpp"
#include "compare/judge/units.hpp"
#include "compare/judge/verdict.hpp"

namespace ogc::compare {

namespace {

/// The numbers of the metrics of rest_state, in the order of tally.cpp.
enum Metric : std::size_t {
  of_mass,
  of_area,
  of_gradient,
  of_edge_length_squared,
  of_rest_angle,
  of_stiffness,
  of_weight,
  of_meeting
};

/// Whether θ₀ cannot be told from its turn by 2π.
bool is_folded(double angle, double scale) {
  return std::abs(angle) + rest_state_angle_tolerance * unit_roundoff * scale >= std::numbers::pi;
}

class RestVerdict {
 public:
  RestVerdict(const RestStateTruth& truth, const RestStateOut& out, Tally& tally)
      : truth_(truth), exact_(truth.exact), out_(out), tally_(tally) {}

  void judge() {
    if (!has_right_lengths() || !names_right_vertices()) return;
    for (std::size_t v = 0; v < out_.mass.size(); ++v)
      one(of_mass, "vertex", v, out_.mass[v], truth_.mass[v], truth_.mass_scale[v]);
    for (std::size_t t = 0; t < out_.triangles.size(); ++t) judge_triangle(t);
    for (std::size_t e = 0; e < out_.edge_length_squared.size(); ++e)
      one(of_edge_length_squared, "edge", e, out_.edge_length_squared[e], truth_.edge_length_squared[e],
          truth_.edge_length_squared_scale[e]);
    for (std::size_t i = 0; i < out_.hinges.size(); ++i) judge_hinge(i);
    for (std::size_t i = 0; i < out_.meetings.size(); ++i) {
      one(of_meeting, "stiffness of meeting", i, out_.meetings[i].stiffness, truth_.meeting_stiffness[i],
          truth_.meeting_stiffness[i]);
      one(of_meeting, "friction of meeting", i, out_.meetings[i].friction, truth_.meeting_friction[i],
          truth_.meeting_friction[i]);
    }
  }

 private:
  void one(Metric metric, const char* what, std::size_t i, double value, double exact, double scale) {
    error(metric, what, i, std::abs(value - exact), scale, value, exact);
  }

  void error(Metric metric, const char* what, std::size_t i, double off, double scale, double value, double exact) {
    tally_.error(metric, in_units(off, scale), [&] {
      return std::string(what) + " " + std::to_string(i) + text(": %.9g, exact %.17g", value, exact);
    });
  }

  bool has_length(const char* what, std::size_t length, std::size_t wanted) {
    if (length == wanted) return true;
    tally_.mismatch(std::string(what) + ": " + std::to_string(length) + " entries instead of " +
                    std::to_string(wanted));
    return false;
  }

  bool has_right_lengths() {
    return has_length("mass", out_.mass.size(), exact_.mass.size()) &&
           has_length("triangles", out_.triangles.size(), exact_.triangles.size()) &&
           has_length("hinges", out_.hinges.size(), exact_.hinges.size()) &&
           has_length("edge_length_squared", out_.edge_length_squared.size(), exact_.edge_length_squared.size()) &&
           has_length("meetings", out_.meetings.size(), exact_.meetings.size());
  }

  bool names_right_vertices() {
    for (std::size_t t = 0; t < out_.triangles.size(); ++t) {
      const RestTriangle &a = out_.triangles[t], &b = exact_.triangles[t];
      if (a.corner != b.corner || a.body != b.body) return wrong_name("triangle", t);
    }
    for (std::size_t i = 0; i < out_.hinges.size(); ++i) {
      const RestHinge &a = out_.hinges[i], &b = exact_.hinges[i];
      if (a.vertex != b.vertex || a.body != b.body) return wrong_name("hinge", i);
    }
    return true;
  }

  bool wrong_name(const char* what, std::size_t i) {
    tally_.mismatch(std::string(what) + " " + std::to_string(i) +
                    " has other vertices, or another body, than the one that stands there");
    return false;
  }

  void judge_triangle(std::size_t t) {
    one(of_area, "triangle", t, out_.triangles[t].area, truth_.area[t], truth_.area_scale[t]);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& value = out_.triangles[t].gradient[k];
      const auto& exact = truth_.gradient[t][k];
      error(of_gradient, k == 0 ? "first gradient of triangle" : "second gradient of triangle", t,
            std::hypot(value[0] - exact[0], value[1] - exact[1]), truth_.gradient_scale[t][k],
            std::hypot(value[0], value[1]), std::hypot(exact[0], exact[1]));
    }
  }

  void judge_hinge(std::size_t i) {
    const double angle = out_.hinges[i].rest_angle, exact = truth_.rest_angle[i], scale = truth_.rest_angle_scale[i];
    const double turned = exact - std::copysign(2 * std::numbers::pi, exact);
    const bool is_turned = is_folded(exact, scale) && std::abs(angle - turned) < std::abs(angle - exact);
    if (is_turned && in_units(std::abs(angle - turned), scale) <= rest_state_angle_tolerance)
      tally_.answered_not_exactly();
    one(of_rest_angle, "hinge", i, angle, is_turned ? turned : exact, scale);
    one(of_stiffness, "hinge", i, out_.hinges[i].stiffness, truth_.stiffness[i], truth_.stiffness_scale[i]);
    const auto& weight = out_.hinges[i].weight;
    const auto& right = truth_.weight[i];
    error(of_weight, "weights of hinge", i,
          std::hypot(weight[0] - right[0], weight[1] - right[1], weight[2] - right[2]), truth_.weight_scale[i],
          std::hypot(weight[0], weight[1], weight[2]), std::hypot(right[0], right[1], right[2]));
  }

  const RestStateTruth& truth_;
  const RestStateOut &exact_, &out_;
  Tally& tally_;
};

}  // namespace

void judge_rest_state(const TestCase& test, const RestStateTruth& truth, const RestStateOut& out, Tally& tally) {
  tally.begin(test.name);
  std::uint64_t folded = 0;
  for (std::size_t i = 0; i < truth.rest_angle.size(); ++i)
    folded += is_folded(truth.rest_angle[i], truth.rest_angle_scale[i]);
  tally.count(truth.mass.size(), truth.rest_angle.size(), folded);
  RestVerdict(truth, out, tally).judge();
}

void judge_block(const TestCase& test, const BlockTruth& truth, const BlockOut& out, Tally& tally) {
  const auto& asked = std::get<BlockCase>(test.data);
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

}  // namespace ogc::compare
