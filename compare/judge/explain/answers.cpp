#include "compare/judge/explain/answers.hpp"

#include <algorithm>
#include <optional>

#include "compare/judge/explain/parts.hpp"
#include "compare/judge/features.hpp"
#include "compare/judge/questions.hpp"
#include "compare/judge/sweep_question.hpp"

namespace ogc::compare {

namespace {

/// The entries of a symmetric block, in order.
const std::vector<std::string> block_labels{"xx", "xy", "xz", "yy", "yz", "zz"};

template <class Contacts>
Quantity contacts(const Contacts& all, const Topology& topology) {
  std::vector<std::string> names;
  for (const auto& contact : all) names.push_back(contact_name(contact, topology));
  std::sort(names.begin(), names.end());
  return words("contacts", std::move(names));
}

Quantity flag(std::string name, unsigned value) {
  return word(std::move(name), value == 0 ? "no" : value == 1 ? "yes" : std::to_string(value));
}

/// The outputs of one side; `Out` and `Truth` have the same members where a stage's exact answer is rounded.
std::vector<Quantity> outputs(const ClosestFaceOut& out) {
  return {word("feature", feature_name(out.feature.at(0))), numbers("weights", "1", out.weights.at(0)),
          scalar("distance", "m", out.distance.at(0)), scalar("distance_below", "m", out.distance_below.at(0))};
}

std::vector<Quantity> outputs(const ClosestFaceTruth& truth) {
  return {word("feature", feature_name(truth.exact.feature[0])), numbers("weights", "1", truth.weights[0]),
          scalar("distance", "m", truth.distance[0]), scalar("distance_below", "m", truth.exact.distance_below[0])};
}

std::vector<Quantity> points_outputs(const ClosestPointsOut& out, const Quantity& parameters, double contact_distance) {
  return {word("first_feature", feature_name(out.first_feature.at(0), "first")),
          word("second_feature", feature_name(out.second_feature.at(0), "second")),
          flag("nearly_parallel", out.nearly_parallel.at(0)),
          parameters,
          scalar("contact_distance", "m", contact_distance),
          scalar("distance_below", "m", out.distance_below.at(0))};
}

std::vector<Quantity> outputs(const ClosestPointsOut& out) {
  return points_outputs(out, numbers("parameters", "1", out.parameters.at(0)), out.contact_distance.at(0));
}

std::vector<Quantity> outputs(const ClosestPointsTruth& truth) {
  return points_outputs(truth.exact, numbers("parameters", "1", truth.parameters[0]), truth.contact_distance[0]);
}

std::vector<Quantity> outputs(const ActivationOut& out) {
  return {scalar("energy", "J", out.energy.at(0)), scalar("slope", "N", out.slope.at(0)),
          scalar("curvature", "N/m", out.curvature.at(0))};
}

std::vector<Quantity> outputs(const ActivationTruth& truth) {
  return {scalar("energy", "J", truth.energy[0]), scalar("slope", "N", truth.slope[0]),
          scalar("curvature", "N/m", truth.curvature[0])};
}

template <class Block>
Quantity block_of(const Block& block) {
  Quantity quantity = numbers("block", "N/m", block);
  quantity.labels = block_labels;
  return quantity;
}

std::vector<Quantity> outputs(const ForceOut& out) {
  return {points("force", "N", std::array{out.force.at(0)}), block_of(out.block.at(0))};
}

std::vector<Quantity> outputs(const ForceTruth& truth) {
  const ForceAnswer& exact = truth.accepted[0][0];
  return {points("force", "N", std::array{exact.force}), block_of(exact.block)};
}

std::vector<Quantity> outputs(const TruncateOut& out) {
  return {points("position", "m", std::array{out.position.at(0)}), flag("exceeded", out.exceeded.at(0))};
}

std::vector<Quantity> outputs(const TruncateTruth& truth) {
  return {points("position", "m", std::array{truth.position[0]}), flag("exceeded", truth.exceeded[0])};
}

std::vector<Quantity> outputs(const BoundOut& out) { return {numbers("bound", "m", out.bound)}; }
std::vector<Quantity> outputs(const BoundTruth& truth) { return outputs(truth.exact); }

std::vector<Quantity> outputs(const DetectVertexFacetOut& out, const Topology& topology) {
  return {contacts(out.contacts, topology), numbers("d_min_vertex", "m", out.d_min_vertex),
          numbers("d_min_triangle", "m", out.d_min_triangle)};
}

std::vector<Quantity> outputs(const DetectEdgeEdgeOut& out, const Topology& topology) {
  return {contacts(out.contacts, topology), numbers("d_min_edge", "m", out.d_min_edge)};
}

template <class Truth>
std::vector<Quantity> outputs(const Truth& truth, const Topology& topology) {
  return outputs(truth.exact, topology);
}

Quantity inside(const std::vector<std::uint8_t>& values, const BlockCase& asked) {
  Quantity quantity = numbers("inside", "", values);
  for (const BlockQuestion& question : asked.questions)
    quantity.labels.push_back(question_name(question, *asked.topology));
  return quantity;
}

/// By triangle and by hinge what `pick` takes of it.
template <class Item, class Pick>
Quantity each(std::string name, std::string unit, const std::vector<Item>& items, Pick pick) {
  std::vector<double> values;
  for (const Item& item : items) values.push_back(pick(item));
  return numbers(std::move(name), std::move(unit), values);
}

std::vector<Quantity> outputs(const RestStateOut& out) {
  std::vector<std::array<float, 4>> gradients;
  std::vector<std::array<float, 3>> weights;
  for (const RestTriangle& t : out.triangles)
    gradients.push_back({t.gradient[0][0], t.gradient[0][1], t.gradient[1][0], t.gradient[1][1]});
  for (const RestHinge& h : out.hinges) weights.push_back(h.weight);
  return {numbers("mass", "kg", out.mass),
          each("area", "m²", out.triangles, [](const RestTriangle& t) { return t.area; }),
          rows("gradient", "1/m", gradients),
          each("rest_angle", "rad", out.hinges, [](const RestHinge& h) { return h.rest_angle; }),
          each("hinge_stiffness", "J", out.hinges, [](const RestHinge& h) { return h.stiffness; }),
          rows("weight", "1/m", weights),
          numbers("edge_length_squared", "m²", out.edge_length_squared),
          each("meeting_stiffness", "N/m", out.meetings, [](const MeetingMaterial& m) { return m.stiffness; }),
          each("meeting_friction", "1", out.meetings, [](const MeetingMaterial& m) { return m.friction; })};
}

std::vector<Quantity> outputs(const RestStateTruth& truth) { return outputs(truth.exact); }

std::vector<Quantity> guess_outputs(const Quantity& target, const Quantity& position, unsigned cut) {
  return {target, position, flag("cut", cut)};
}

Quantity event_names(const std::vector<StepEventKind>& kinds) {
  std::vector<std::string> names;
  for (const StepEventKind kind : kinds)
    names.emplace_back(kind == StepEventKind::detection ? "detection"
                       : kind == StepEventKind::guess   ? "guess"
                                                        : "sweep");
  return words("events", std::move(names));
}

std::vector<Quantity> outputs(const StepOut& out) {
  std::vector<StepEventKind> kinds;
  for (const StepEvent& event : out.events) kinds.push_back(event.kind);
  return {scalar("query_radius", "m", out.query_radius), event_names(kinds), points("velocity", "m/s", out.velocity)};
}

std::vector<Quantity> outputs(const StepTruth& truth) {
  return {scalar("query_radius", "m", truth.query_radius), event_names(truth.events),
          points("velocity", "m/s", truth.velocity)};
}

Quantity cut_count(Index cut) { return scalar("cut", "", cut); }

class BothSides {
 public:
  BothSides(const TestCase& test, const Contestant& contestant, const Authority& authority)
      : test_(test), contestant_(contestant), authority_(authority) {}

  Answers ask() {
    switch (test_.name.stage) {
      case Stage::closest_face:
        return plain(face_question({&test_, 1}), contestant_.closest_face, authority_.closest_face);
      case Stage::closest_points:
        return plain(points_question({&test_, 1}), contestant_.closest_points, authority_.closest_points);
      case Stage::activation:
        return plain(activation_question({&test_, 1}), contestant_.activation, authority_.activation);
      case Stage::truncate: return plain(truncate_question({&test_, 1}), contestant_.truncate, authority_.truncate);
      case Stage::contact_force:
        return force(&ContactForceIn::cases, contestant_.contact_force, authority_.contact_force);
      case Stage::friction_force:
        return force(&FrictionForceIn::cases, contestant_.friction_force, authority_.friction_force);
      case Stage::membrane: return force(&MembraneIn::cases, contestant_.membrane, authority_.membrane);
      case Stage::bending: return force(&BendingIn::cases, contestant_.bending, authority_.bending);
      case Stage::spring: return force(&SpringIn::cases, contestant_.spring, authority_.spring);
      case Stage::bound: return plain(bound_question(test_), contestant_.bound, authority_.bound);
      case Stage::rest_state: return plain(rest_question(test_), contestant_.rest_state, authority_.rest_state);
      case Stage::block: return block();
      case Stage::initial_guess: return guess();
      case Stage::detect_vertex_facet:
        return detection(contestant_.detect_vertex_facet, authority_.detect_vertex_facet);
      case Stage::detect_edge_edge: return detection(contestant_.detect_edge_edge, authority_.detect_edge_edge);
      case Stage::sweep: return sweep();
      case Stage::step: return step();
    }
    return {};
  }

 private:
  /// The contestant's answer, or nothing and a note.
  template <class Out, class In>
  std::optional<Out> answer(const In& in, const std::function<Out(const In&)>& contestant) {
    try {
      return contestant(in);
    } catch (const ContestantFailure& failure) {
      note_ = std::string("no answer: ") + failure.what();
      return std::nullopt;
    }
  }

  Answers paired(const std::vector<Quantity>& given, const std::vector<Quantity>& exact) const {
    Answers answers{{}, note_};
    for (std::size_t i = 0; i < exact.size(); ++i)
      answers.outputs.push_back({i < given.size() ? given[i] : Quantity{}, exact[i]});
    return answers;
  }

  template <class In, class Out, class Truth>
  Answers plain(const In& in, const std::function<Out(const In&)>& contestant,
                const std::function<Truth(const In&)>& authority) {
    const auto out = answer(in, contestant);
    return paired(out ? outputs(*out) : std::vector<Quantity>{}, outputs(authority(in)));
  }

  template <class In, class Case>
  Answers force(std::vector<Case> In::*questions, const std::function<ForceOut(const In&)>& contestant,
                const std::function<ForceTruth(const In&)>& authority) {
    const In in = case_question({&test_, 1}, questions);
    const ForceTruth truth = authority(in);
    if (const std::size_t accepted = truth.accepted[0].size(); accepted > 1)
      note_ = "grey: " + std::to_string(accepted) +
              " answers are accepted, on either side of a jump; the exact one is shown";
    const auto out = answer(in, contestant);
    return paired(out ? outputs(*out) : std::vector<Quantity>{}, outputs(truth));
  }

  template <class Out, class Truth>
  Answers detection(const std::function<Out(const DetectIn&)>& contestant,
                    const std::function<Truth(const DetectIn&)>& authority) {
    const DetectIn in = detect_question(test_);
    const Truth truth = authority(in);
    if (!truth.grey.empty())
      note_ = "grey: " + std::to_string(truth.grey.size()) + " decisions may go either way; the exact one is shown";
    const auto out = answer(in, contestant);
    return paired(out ? outputs(*out, *in.topology) : std::vector<Quantity>{}, outputs(truth, *in.topology));
  }

  Answers block() {
    const auto& asked = std::get<BlockCase>(test_.data);
    const BlockIn in = block_question(test_);
    const auto out = answer(in, contestant_.block);
    return paired(out ? std::vector{inside(out->inside, asked)} : std::vector<Quantity>{},
                  {inside(authority_.block(in).inside, asked)});
  }

  Answers guess() {
    const InitialGuessIn in = case_question({&test_, 1}, &InitialGuessIn::cases);
    const InitialGuessTruth truth = authority_.initial_guess(in);
    const auto out = answer(in, contestant_.initial_guess);
    const InitialGuessCase& asked = in.cases[0];
    const TruncateTruth cut = authority_.truncate(cut_question(in, out ? *out : InitialGuessOut{}));
    const Vec3 held{asked.previous.x, asked.previous.y, asked.previous.z};
    std::vector<Quantity> given;
    if (out)
      given = guess_outputs(points("target", "m", std::array{out->target.at(0)}),
                            points("position", "m", std::array{out->position.at(0)}), out->cut.at(0));
    return paired(given, guess_outputs(points("target", "m", std::array{truth.target[0]}),
                                       points("position", "m", std::array{asked.held ? held : cut.position[0]}),
                                       asked.held ? 0 : cut.exceeded[0]));
  }

  Answers sweep() {
    const SweepQuestion question(std::get<SweepCase>(test_.data), authority_);
    const auto out = answer(question.in(), contestant_.sweep);
    if (!out) return {{}, note_};
    if (out->position.size() != question.in().old.size())
      return {{}, "the answer does not have one position for each vertex"};
    const SweepTruth truth = authority_.sweep(question.in(), *out);
    return paired({points("position", "m", out->position), cut_count(out->cut)},
                  {points("position", "m", truth.position), cut_count(truth.cut)});
  }

  Answers step() {
    const StepIn in = step_question(test_);
    const auto out = answer(in, contestant_.step);
    Tally tally(Stage::step);
    if (!out || !can_judge_step(test_, in, *out, tally)) return {{}, out ? tally.mismatches[0].message : note_};
    return paired(outputs(*out), outputs(authority_.step(in, *out)));
  }

  const TestCase& test_;
  const Contestant& contestant_;
  const Authority& authority_;
  std::string note_;
};

}  // namespace

Answers answers_to(const TestCase& test, const Contestant& contestant, const Authority& authority) {
  try {
    return BothSides(test, contestant, authority).ask();
  } catch (const std::out_of_range&) {
    return {{}, "an array of the answer does not have one entry for each case"};
  }
}

}  // namespace ogc::compare
