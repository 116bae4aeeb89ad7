#include "reference/solvers/rods/segment_questions.hpp"

#include <algorithm>

#include "reference/energies/rods/orientation.hpp"

namespace ogc::reference {
namespace {

using compare::at, compare::Index;

const compare::RodMaterial& material_of(const compare::SweepIn& in, std::size_t segment) {
  return *in.scene->bodies[at(in.rest->segments[segment].body)].material.rod;
}

float damping_of(const compare::SweepIn& in, std::size_t segment) {
  return static_cast<float>(material_of(in, segment).damping / in.scene->settings.time_step);
}

}  // namespace

compare::OrientationCase orientation_question(const compare::SweepIn& in, const compare::SweepOut& answer,
                                              std::size_t segment) {
  const compare::RestSegment& rest = in.rest->segments[segment];
  compare::OrientationCase question;
  for (std::size_t end = 0; end < 2; ++end) {
    const auto v = at(rest.end[end]);
    question.vertex[end] = in.colour[v] < 0 ? answer.position[v] : in.old[v];
    question.start[end] = in.start[v];
    if (rest.neighbour[end] < 0) continue;
    const auto f = at(rest.neighbour[end]);
    const bool is_set = in.segment_colour[f] < in.segment_colour[segment];
    compare::RodNeighbour& seen = end == 0 ? question.behind : question.ahead;
    seen.weight = rest.weight[end];
    seen.now = is_set ? answer.orientation[f] : in.orientation[f];
    seen.start = in.orientation_start[f];
    seen.rest = rest.relative[end];
  }
  question.orientation = in.orientation[segment];
  question.orientation_start = in.orientation_start[segment];
  question.rest_length = rest.length;
  question.stretch = static_cast<float>(material_of(in, segment).stretch);
  question.damping = damps_strain(in.scene->settings.damping) ? damping_of(in, segment) : 0;
  return question;
}

compare::RodCase rod_question(const compare::SweepIn& in, const compare::SweepOut& answer, std::size_t segment,
                              std::size_t end, const std::array<compare::Vec3f, 2>& ends) {
  const compare::RestSegment& rest = in.rest->segments[segment];
  compare::RodCase question;
  question.vertex = ends;
  question.start = {in.start[at(rest.end[0])], in.start[at(rest.end[1])]};
  question.orientation = answer.orientation[segment];
  question.orientation_start = in.orientation_start[segment];
  question.rest_length = rest.length;
  question.stretch = static_cast<float>(material_of(in, segment).stretch);
  question.damping = damping_of(in, segment);
  question.own = static_cast<std::int32_t>(end);
  question.damping_form = in.scene->settings.damping;
  return question;
}

void add_orientations(const compare::SweepIn& in, const compare::SweepOut& answer, compare::SweepTruth& truth) {
  compare::OrientationIn questions;
  for (std::size_t e = 0; e < in.segment_colour.size(); ++e) {
    if (in.segment_colour[e] < 0) continue;
    truth.free_segments.push_back(static_cast<Index>(e));
    questions.cases.push_back(orientation_question(in, answer, e));
  }
  truth.orientation = orientation(questions);
}

void set_orientations(const compare::SweepIn& in, compare::SweepOut& out) {
  out.orientation.assign(in.orientation.begin(), in.orientation.end());
  const Index colours = in.segment_colour.empty() ? 0 : 1 + *std::ranges::max_element(in.segment_colour);
  for (Index c = 0; c < colours; ++c) {
    std::vector<std::size_t> members;
    compare::OrientationIn questions;
    for (std::size_t e = 0; e < in.segment_colour.size(); ++e) {
      if (in.segment_colour[e] != c) continue;
      members.push_back(e);
      questions.cases.push_back(orientation_question(in, out, e));
    }
    const compare::OrientationTruth found = orientation(questions);
    for (std::size_t k = 0; k < members.size(); ++k)
      for (std::size_t i = 0; i < 4; ++i)
        out.orientation[members[k]][i] = static_cast<float>(found.accepted[k].front().orientation[i]);
  }
}

}  // namespace ogc::reference
