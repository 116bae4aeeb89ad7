// Defines how the judge compares answers of stage rest_state. It folds over the kinds of elements; each kind has a
// specialisation of RestJudge.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/cases/rest_cases.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/stage_of.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/rods.hpp"
#include "compare/stages/rest_state.hpp"

namespace ogc::compare {

namespace {

/// An exact angle. If rounding errors could move it past ±π, the angle plus or minus 2π is accepted, too.
struct Angle {
  double exact;
};

/// Returns whether the rest angle is so near ±π that rounding errors could change it by 2π.
bool is_folded(double angle, double scale) {
  return std::abs(angle) + rest_state_angle_tolerance * unit_roundoff * scale >= std::numbers::pi;
}

/// Returns ‖x‖ of two or three numbers.
template <class Vector>
double length(const Vector& x) {
  return std::apply([](auto... number) { return std::hypot(double{number}...); }, x);
}

/// Returns the distance of `stored` from `exact` or −`exact`, whichever is nearer; 1 if `stored` is no unit quaternion.
double apart(const Quaternion& stored, const std::array<double, 4>& exact) {
  double same = 0, other = 0, squared = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double q = stored[k];
    same += (q - exact[k]) * (q - exact[k]);
    other += (q + exact[k]) * (q + exact[k]);
    squared += q * q;
  }
  if (!(std::abs(squared - 1) <= unit_quaternion_slack)) return 1;
  return std::sqrt(std::min(same, other));
}

/// Holds what the judge needs of a kind of element: metrics, a function that visits each number (to compare and to
/// round it), printed quantities, and wrong forms.
template <class Kind>
struct RestJudge;

void round_exact(RestStateTruth& truth);

/// Makes a wrong form: `change` makes the truth wrong in one respect, and the result is rounded.
template <class Change>
WrongForm rest_told(std::string name, std::string meaning, Change change) {
  return told(std::move(name), std::move(meaning), &Authority::rest_state,
              [change](const RestStateIn&, RestStateTruth& truth) {
                change(truth);
                round_exact(truth);
              });
}

void scale(std::vector<double>& values, double factor) {
  for (double& x : values) x *= factor;
}

template <>
struct RestJudge<TriangleKind> {
  static constexpr std::array metrics{MetricInfo{"area", "u cond", rest_state_tolerance},
                                      MetricInfo{"gradient", "u cond", rest_state_tolerance}};

  template <class Element, class Visit>
  static void each_number(Element& rest, const RestStateTruth& truth, std::size_t i, Visit visit) {
    visit(0, "triangle", i, rest.area, truth.area[i], truth.area_scale[i]);
    for (std::size_t k = 0; k < 2; ++k)
      visit(1, k == 0 ? "first gradient of triangle" : "second gradient of triangle", i, rest.gradient[k],
            truth.gradient[i][k], truth.gradient_scale[i][k]);
  }

  static std::vector<Quantity> quantities(const RestStateOut& out) {
    std::vector<std::array<float, 4>> gradients;
    for (const RestTriangle& t : out.triangles)
      gradients.push_back({t.gradient[0][0], t.gradient[0][1], t.gradient[1][0], t.gradient[1][1]});
    return {each("area", "m²", out.triangles, [](const RestTriangle& t) { return t.area; }),
            rows("gradient", "1/m", gradients)};
  }

  static std::vector<WrongForm> forms() {
    return {
        rest_told("area_not_halved", "twice the area of each triangle: the cross product itself",
                  [](RestStateTruth& truth) { scale(truth.area, 2), scale(truth.area_scale, 2); }),
        rest_told("gradients_exchanged", "∇N₁ and ∇N₂ exchanged",
                  [](RestStateTruth& truth) {
                    for (auto& gradient : truth.gradient) std::swap(gradient[0], gradient[1]);
                    for (auto& scales : truth.gradient_scale) std::swap(scales[0], scales[1]);
                  }),
        rest_told("axes_exchanged", "the two axes of a triangle exchanged in its gradients",
                  [](RestStateTruth& truth) {
                    for (auto& gradient : truth.gradient)
                      for (auto& g : gradient) std::swap(g[0], g[1]);
                  }),
        rest_told("second_axis_flipped", "the third corner below the first axis, not above", [](RestStateTruth& truth) {
          for (auto& gradient : truth.gradient)
            for (auto& g : gradient) g[1] = -g[1];
        })};
  }
};

template <>
struct RestJudge<HingeKind> {
  static constexpr std::array metrics{MetricInfo{"rest_angle", "u cond", rest_state_angle_tolerance},
                                      MetricInfo{"stiffness", "u cond", rest_state_tolerance},
                                      MetricInfo{"weight", "u cond", rest_state_tolerance}};

  template <class Element, class Visit>
  static void each_number(Element& rest, const RestStateTruth& truth, std::size_t i, Visit visit) {
    visit(0, "hinge", i, rest.rest_angle, Angle{truth.rest_angle[i]}, truth.rest_angle_scale[i]);
    visit(1, "hinge", i, rest.stiffness, truth.stiffness[i], truth.stiffness_scale[i]);
    visit(2, "weights of hinge", i, rest.weight, truth.weight[i], truth.weight_scale[i]);
  }

  static std::vector<Quantity> quantities(const RestStateOut& out) {
    std::vector<std::array<float, 3>> weights;
    for (const RestHinge& h : out.hinges) weights.push_back(h.weight);
    return {each("rest_angle", "rad", out.hinges, [](const RestHinge& h) { return h.rest_angle; }),
            each("hinge_stiffness", "J", out.hinges, [](const RestHinge& h) { return h.stiffness; }),
            rows("weight", "1/m", weights)};
  }

  static std::vector<WrongForm> forms() {
    return {rest_told("rest_angle_flipped", "θ₀ with the other sign",
                      [](RestStateTruth& truth) { scale(truth.rest_angle, -1); }),
            rest_told("rest_angle_missing", "θ₀ is 0", [](RestStateTruth& truth) { scale(truth.rest_angle, 0); }),
            rest_told("hinge_stiffness_third", "k_b ‖e‖²/(A₀ + A₁) without the factor 3", [](RestStateTruth& truth) {
              scale(truth.stiffness, 1.0 / 3), scale(truth.stiffness_scale, 1.0 / 3);
            })};
  }
};

template <>
struct RestJudge<TetrahedronKind> {
  static constexpr std::array metrics{MetricInfo{"tetrahedron", "u cond", rest_state_tolerance}};

  template <class Element, class Visit>
  static void each_number(Element& rest, const RestStateTruth& truth, std::size_t i, Visit visit) {
    visit(0, "volume of tetrahedron", i, rest.volume, truth.volume[i], truth.volume_scale[i]);
    visit(0, "inverse of tetrahedron", i, rest.inverse, truth.inverse[i], truth.inverse_scale[i]);
    for (std::size_t k = 0; k < 6; ++k)
      visit(0, "a weight of tetrahedron", i, rest.weight[k], truth.tetrahedron_weight[i][k],
            truth.tetrahedron_weight_scale[i]);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        visit(0, "a gradient of tetrahedron", i, rest.gradient[k][axis], truth.tetrahedron_gradient[i][k][axis],
              truth.tetrahedron_gradient_scale[i]);
  }

  static std::vector<Quantity> quantities(const RestStateOut& out) {
    std::vector<std::array<float, 6>> weights;
    for (const RestTetrahedron& t : out.tetrahedra) weights.push_back(t.weight);
    return {each("volume", "m³", out.tetrahedra, [](const RestTetrahedron& t) { return t.volume; }),
            each("inverse", "1/m³", out.tetrahedra, [](const RestTetrahedron& t) { return t.inverse; }),
            rows("tetrahedron_weight", "m", weights)};
  }

  static std::vector<WrongForm> forms() {
    return {rest_told("volume_six_times", "6V in place of V",
                      [](RestStateTruth& truth) {
                        scale(truth.volume, 6), scale(truth.volume_scale, 6);
                        scale(truth.inverse, 1.0 / 6), scale(truth.inverse_scale, 1.0 / 6);
                        for (auto& weights : truth.tetrahedron_weight)
                          for (double& w : weights) w *= 6;
                        scale(truth.tetrahedron_weight_scale, 6);
                      }),
            rest_told("inverse_of_volume", "1/V for 1/(6V)",
                      [](RestStateTruth& truth) { scale(truth.inverse, 6), scale(truth.inverse_scale, 6); }),
            rest_told("opposite_weights_exchanged", "the weights of a tetrahedron's opposite edges exchanged",
                      [](RestStateTruth& truth) {
                        for (auto& weights : truth.tetrahedron_weight) std::swap(weights[0], weights[5]);
                      }),
            rest_told("tetrahedron_gradients_transposed", "the matrix of a tetrahedron's ∇N transposed",
                      [](RestStateTruth& truth) {
                        for (auto& gradient : truth.tetrahedron_gradient)
                          for (std::size_t k = 0; k < 3; ++k)
                            for (std::size_t axis = 0; axis < k; ++axis)
                              std::swap(gradient[k][axis], gradient[axis][k]);
                      }),
            rest_told("tetrahedron_gradients_flipped", "−∇N for ∇N of a tetrahedron", [](RestStateTruth& truth) {
              for (auto& gradient : truth.tetrahedron_gradient)
                for (auto& row : gradient)
                  for (double& g : row) g = -g;
            })};
  }
};

template <>
struct RestJudge<SegmentKind> {
  static constexpr std::array metrics{MetricInfo{"rod", "u cond", rest_state_tolerance}};

  template <class Element, class Visit>
  static void each_number(Element& rest, const RestStateTruth& truth, std::size_t i, Visit visit) {
    const std::vector<double>& frame_scale = truth.segment_frame_scale;
    visit(0, "length of segment", i, rest.length, truth.segment_length[i], truth.segment_length_scale[i]);
    visit(0, "frame of segment", i, rest.orientation, truth.segment_orientation[i], frame_scale[i]);
    for (std::size_t end = 0; end < 2; ++end) {
      const Index f = rest.neighbour[end];
      if (f < 0 && rest.weight[end] == 0) continue;
      visit(0, "weight of segment", i, rest.weight[end], truth.segment_weight[i][end],
            truth.segment_weight_scale[i][end]);
      if (f >= 0)
        visit(0, "relative rotation of segment", i, rest.relative[end], truth.segment_relative[i][end],
              std::max(frame_scale[i], frame_scale[static_cast<std::size_t>(f)]));
    }
  }

  static std::vector<Quantity> quantities(const RestStateOut& out) {
    std::vector<std::array<float, 2>> weights;
    std::vector<Quaternion> relatives;
    for (const RestSegment& s : out.segments) {
      weights.push_back(s.weight);
      relatives.insert(relatives.end(), s.relative.begin(), s.relative.end());
    }
    return {each("segment_length", "m", out.segments, [](const RestSegment& s) { return s.length; }),
            rows("segment_weight", "N m", weights), rows("segment_relative", "1", relatives)};
  }

  static std::vector<WrongForm> forms() {
    return {rest_told("rod_weight_of_one_segment", "4 k_b/l, or twice the mean length, for 4 k_b/l̄",
                      [](RestStateTruth& truth) {
                        for (auto* weights : {&truth.segment_weight, &truth.segment_weight_scale})
                          for (auto& weight : *weights) weight[0] /= 2, weight[1] /= 2;
                      }),
            rest_told("rod_relative_transposed", "p̄° for p°", [](RestStateTruth& truth) {
              for (auto& relative : truth.segment_relative)
                for (auto& p : relative)
                  for (std::size_t k = 0; k < 3; ++k) p[k] = -p[k];
            })};
  }
};

/// Calls visit(metric, what, element, value, exact value, scale) for each number of a kind.
template <class Kind, class Visit>
void each_number(auto& elements, const RestStateTruth& truth, const Visit& visit) {
  for (std::size_t i = 0; i < elements.size(); ++i) RestJudge<Kind>::each_number(elements[i], truth, i, visit);
}

/// Notes the errors of one kind of element in an answer. `metric` counts from `first`, the index of the kind's first
/// metric.
class RestErrors {
 public:
  RestErrors(Tally& tally, std::size_t first) : tally_(tally), first_(first) {}

  void operator()(std::size_t metric, const char* what, std::size_t i, double value, double exact, double scale) const {
    note(metric, what, i, std::abs(value - exact), scale, value, exact);
  }
  void operator()(std::size_t metric, const char* what, std::size_t i, double value, Angle angle, double scale) const {
    const double exact = angle.exact, turned = exact - std::copysign(2 * std::numbers::pi, exact);
    const bool is_turned = is_folded(exact, scale) && std::abs(value - turned) < std::abs(value - exact);
    if (is_turned && in_units(std::abs(value - turned), scale) <= rest_state_angle_tolerance)
      tally_.answered_not_exactly();
    (*this)(metric, what, i, value, is_turned ? turned : exact, scale);
  }
  template <std::size_t n>
  void operator()(std::size_t metric, const char* what, std::size_t i, const std::array<float, n>& value,
                  const std::array<double, n>& exact, double scale) const {
    std::array<double, n> off;
    for (std::size_t k = 0; k < n; ++k) off[k] = value[k] - exact[k];
    note(metric, what, i, length(off), scale, length(value), length(exact));
  }
  void operator()(std::size_t metric, const char* what, std::size_t i, const Quaternion& value,
                  const std::array<double, 4>& exact, double scale) const {
    const double off = apart(value, exact);
    const bool any = std::isinf(scale);  // any unit quaternion is right
    note(metric, what, i, any ? (off == 1 ? 1 : 0) : off, any ? 1 : scale, double{value[3]}, exact[3]);
  }

 private:
  void note(std::size_t metric, const char* what, std::size_t i, double off, double scale, double value,
            double exact) const {
    tally_.error(first_ + metric, in_units(off, scale), [&] {
      return std::string(what) + " " + std::to_string(i) + text(": %.9g, exact %.17g", value, exact);
    });
  }

  Tally& tally_;
  std::size_t first_;
};

/// Rounds exact values.
struct Rounding {
  void operator()(std::size_t, const char*, std::size_t, float& value, double exact, double) const {
    value = static_cast<float>(exact);
  }
  void operator()(std::size_t, const char*, std::size_t, float& value, Angle angle, double) const {
    value = static_cast<float>(angle.exact);
  }
  template <std::size_t n>
  void operator()(std::size_t, const char*, std::size_t, std::array<float, n>& value,
                  const std::array<double, n>& exact, double) const {
    for (std::size_t k = 0; k < n; ++k) value[k] = static_cast<float>(exact[k]);
  }
};

/// Indices of the metrics that belong to no kind of element. of_kinds is the index of the first metric that belongs to
/// a kind.
enum Metric : std::size_t { of_mass, of_edge_length_squared, of_meeting, of_kinds };

constexpr std::array common_metrics{MetricInfo{"mass", "u cond", rest_state_tolerance},
                                    MetricInfo{"edge_length_squared", "u cond", rest_state_tolerance},
                                    MetricInfo{"meeting", "u value", rest_state_tolerance}};

/// Joins the common metrics and those of the kinds, in their order.
template <class... Kinds>
constexpr auto metrics_of(std::tuple<Kinds...>) {
  return std::apply([](auto... all) { return std::array{all...}; },
                    std::tuple_cat(common_metrics, RestJudge<Kinds>::metrics...));
}

class RestVerdict {
 public:
  RestVerdict(const RestStateTruth& truth, const RestStateOut& out, Tally& tally)
      : truth_(truth), exact_(truth.exact), out_(out), tally_(tally) {}

  void judge() {
    if (!has_right_lengths() || !names_right_vertices()) return;
    const RestErrors note(tally_, 0);
    for (std::size_t v = 0; v < out_.mass.size(); ++v)
      note(of_mass, "vertex", v, out_.mass[v], truth_.mass[v], truth_.mass_scale[v]);
    for (std::size_t e = 0; e < out_.edge_length_squared.size(); ++e)
      note(of_edge_length_squared, "edge", e, out_.edge_length_squared[e], truth_.edge_length_squared[e],
           truth_.edge_length_squared_scale[e]);
    for (std::size_t i = 0; i < out_.meetings.size(); ++i) {
      note(of_meeting, "stiffness of meeting", i, out_.meetings[i].stiffness, truth_.meeting_stiffness[i],
           truth_.meeting_stiffness[i]);
      note(of_meeting, "friction of meeting", i, out_.meetings[i].friction, truth_.meeting_friction[i],
           truth_.meeting_friction[i]);
    }
    std::size_t first = of_kinds;
    for_each_of<RestKinds>([&]<class Kind, std::size_t>() {
      each_number<Kind>(out_.*Kind::rest, truth_, RestErrors(tally_, first));
      first += RestJudge<Kind>::metrics.size();
    });
  }

 private:
  bool has_length(const char* what, std::size_t length, std::size_t wanted) {
    if (length == wanted) return true;
    tally_.mismatch(std::string(what) + ": " + std::to_string(length) + " entries instead of " +
                    std::to_string(wanted));
    return false;
  }

  bool has_right_lengths() {
    bool right = has_length("mass", out_.mass.size(), exact_.mass.size()) &&
                 has_length("edge_length_squared", out_.edge_length_squared.size(),
                            exact_.edge_length_squared.size()) &&
                 has_length("meetings", out_.meetings.size(), exact_.meetings.size());
    for_each_of<RestKinds>([&]<class Kind, std::size_t>() {
      right = right && has_length(Kind::plural, (out_.*Kind::rest).size(), (exact_.*Kind::rest).size());
    });
    return right;
  }

  bool names_right_vertices() {
    bool right = true;
    for_each_of<RestKinds>([&]<class Kind, std::size_t>() {
      for (std::size_t i = 0; i < (out_.*Kind::rest).size() && right; ++i) {
        const auto &a = (out_.*Kind::rest)[i], &b = (exact_.*Kind::rest)[i];
        right = Kind::vertices(a) == Kind::vertices(b) && a.body == b.body;
        if constexpr (requires { a.neighbour; }) right = right && a.neighbour == b.neighbour;
        if (!right)
          tally_.mismatch(std::string(Kind::name) + " " + std::to_string(i) +
                          " has other vertices or neighbours, or another body, than the one that stands there");
      }
    });
    return right;
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

namespace {

/// Rounds the truth's values and stores the result in truth.exact.
void round_exact(RestStateTruth& truth) {
  truth.exact.mass.assign(truth.mass.begin(), truth.mass.end());
  truth.exact.edge_length_squared.assign(truth.edge_length_squared.begin(), truth.edge_length_squared.end());
  for_each_of<RestKinds>(
      [&]<class Kind, std::size_t>() { each_number<Kind>(truth.exact.*Kind::rest, truth, Rounding()); });
}

std::vector<WrongForm> rest_state_forms() {
  std::vector<WrongForm> forms{
      rest_told("mass_of_whole_triangles", "ρ A in place of ρ A/3 for each corner",
                [](RestStateTruth& truth) { scale(truth.mass, 3), scale(truth.mass_scale, 3); }),
      rest_told("lengths_not_squared", "lengths of edges in place of their squares", [](RestStateTruth& truth) {
        for (double& x : truth.edge_length_squared) x = std::sqrt(x);
        for (double& x : truth.edge_length_squared_scale) x = std::sqrt(x);
      })};
  for_each_of<RestKinds>([&]<class Kind, std::size_t>() {
    for (WrongForm& form : RestJudge<Kind>::forms()) forms.push_back(std::move(form));
  });
  return forms;
}

Json wide_points_to_json(const std::vector<Vec3>& points) { return points_to_json(to_single(points)); }

std::vector<Vec3> to_wide_points(const Json& json) {
  std::vector<Vec3f> points;
  for (const Json& p : json) points.push_back(to_point(p));
  return to_double(points);
}

Json body_to_json(const Body& body) {
  Json json{{"name", body.name}, {"vertices", body.vertex_count}};
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasRange<List>) json[List::key] = body.*List::count;
  });
  json["fixed"] = body.fixed;
  json["membrane"] = name_of(body.material.membrane);
  json["bending"] = name_of(body.material.bending);
  for (const MaterialInfo& info : material_table())
    json[std::string(info.name)] = hexadecimal(static_cast<float>(body.material.*info.field));
  if (body.material.rod)
    for (const RodInfo& info : rod_table())
      json["rod"][std::string(info.name)] = hexadecimal(static_cast<float>((*body.material.rod).*info.field));
  return json;
}

/// Reads the next body of the scene; its ranges begin where those of the last body end.
Body to_body(const Json& json, const Scene& scene) {
  Body body;
  body.name = json.at("name").get<std::string>();
  const Body before = scene.bodies.empty() ? Body{} : scene.bodies.back();
  body.first_vertex = before.first_vertex + before.vertex_count;
  body.vertex_count = json.at("vertices").get<Index>();
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasRange<List>) {
      body.*List::first = before.*List::first + before.*List::count;
      body.*List::count = HasVolume<List> ? json.value(List::key, Index{0}) : json.at(List::key).template get<Index>();
    }
  });
  body.fixed = json.at("fixed").get<bool>();
  body.material.membrane = static_cast<MembraneModel>(number_of(json.at("membrane"), choice_names<MembraneModel>));
  body.material.bending = static_cast<BendingModel>(number_of(json.at("bending"), choice_names<BendingModel>));
  // A saved case may be older than a constant of the table; that constant keeps its default.
  for (const MaterialInfo& info : material_table())
    if (json.contains(info.name)) body.material.*info.field = number(json.at(std::string(info.name)));
  if (!json.contains("rod")) return body;
  body.material.rod.emplace();
  for (const RodInfo& info : rod_table())
    (*body.material.rod).*info.field = number(json.at("rod").at(std::string(info.name)));
  return body;
}

struct RestState : MeshStage<RestState, &Contestant::rest_state, &Authority::rest_state>,
                   TakenWhole,
                   Numbered,
                   NoParameters {
  using Case = RestStateCase;
  static constexpr StageInfo info{.name = "rest_state",
                                  .question = "masses, stencils, rest angles, meeting stiffness of a scene",
                                  .unit = "vertex",
                                  .reference = "reference/solvers/kinds/rest_state.cpp",
                                  .kind = CaseKind::mesh,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr auto metrics = metrics_of(RestKinds());

  static std::span<const Generator> generators() { return rest_state_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    const std::string why = problems_of(c);
    problem.require(why.empty(), why.c_str());
  }
  static void mutate(Random& random, Case& c) {
    Case other = c;
    for (int attempt = 0; attempt < 8; ++attempt) {
      auto scene = std::make_shared<Scene>(*c.scene);
      scene->rest_positions = mutated(random, c.scene->rest_positions);
      other.scene = std::move(scene);
      if (!problems_of(other).empty()) continue;
      c = std::move(other);
      return;
    }
  }
  static std::vector<float*> coordinates(Case&) { return {}; }
  static std::string missing_in(const States& states) { return problems_of(states.rest_state()); }
  static Case of_state(const States& states, std::uint64_t, Random&) { return states.rest_state(); }
  static Case of_scene(const Scene& scene, const Contestant&) {
    return {std::make_shared<Scene>(scene), std::make_shared<Topology>(build_topology(scene))};
  }

  /// Writes what the stage reads of the scene, and the start positions, which must not affect the answer.
  static Json write(const Case& c) {
    const Scene& scene = *c.scene;
    Json bodies = Json::array(), held = Json::array();
    for (const Body& body : scene.bodies) bodies.push_back(body_to_json(body));
    for (const PrescribedMotion& motion : scene.motions)
      held.push_back({{"name", motion.name}, {"vertices", motion.vertices}});
    Json json{{"rest_positions", wide_points_to_json(scene.rest_positions)},
              {"positions", wide_points_to_json(scene.mesh.positions)}};
    for_each_of<MeshLists>([&]<class List, std::size_t>() { json[List::key] = scene.mesh.*List::list; });
    json["bodies"] = bodies;
    json["motions"] = held;
    return json;
  }
  static Case read(const Json& data) {
    Scene scene;
    scene.name = "rest";
    scene.rest_positions = to_wide_points(data.at("rest_positions"));
    scene.mesh.positions = to_wide_points(data.at("positions"));
    for_each_of<MeshLists>([&]<class List, std::size_t>() {
      if (!HasVolume<List> || data.contains(List::key)) data.at(List::key).get_to(scene.mesh.*List::list);
    });
    scene.velocities.resize(scene.mesh.positions.size());
    for (const Json& body : data.at("bodies")) scene.bodies.push_back(to_body(body, scene));
    for (const Json& json : data.at("motions")) {
      PrescribedMotion motion;
      motion.name = json.at("name").get<std::string>();
      motion.vertices = json.at("vertices").get<std::vector<Index>>();
      scene.motions.push_back(std::move(motion));
    }
    round_to_single(scene);
    Case c;
    c.topology = std::make_shared<Topology>(build_topology(scene));
    c.scene = std::make_shared<Scene>(std::move(scene));
    if (const std::string problems = problems_of(c); !problems.empty()) throw InputError(problems);
    return c;
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add(*c.topology, to_single(c.scene->rest_positions));
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    return joined(mesh_quantities(*c.topology), scene_quantities(*c.scene),
                  std::vector{points("rest_positions", "m", c.scene->rest_positions)});
  }

  static In question(const Case& c) { return {c.scene.get(), c.topology.get()}; }
  static constexpr auto judge = judge_rest_state;
  static void add(Bits& bits, const Out& out) { bits.add(out); }
  static std::vector<Quantity> outputs(const In&, const Out& out) {
    std::vector<Quantity> all{compare::numbers("mass", "kg", out.mass)};
    for_each_of<RestKinds>([&]<class Kind, std::size_t>() { all = joined(all, RestJudge<Kind>::quantities(out)); });
    return joined(
        all, std::vector{
                 compare::numbers("edge_length_squared", "m²", out.edge_length_squared),
                 each("meeting_stiffness", "N/m", out.meetings, [](const MeetingMaterial& m) { return m.stiffness; }),
                 each("meeting_friction", "1", out.meetings, [](const MeetingMaterial& m) { return m.friction; })});
  }
  static std::vector<Quantity> outputs(const In& in, const Truth& truth) { return outputs(in, truth.exact); }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return rest_state_forms(); }
};

}  // namespace

constinit const StageTraits stages::rest_state = make_traits<RestState>();

}  // namespace ogc::compare
