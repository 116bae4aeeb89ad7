// Holds wrong forms that several force stages have.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "compare/judge/report/form_tools.hpp"

namespace ogc::compare {

/// A force stage of the authority.
template <class In>
using ForceMember = std::function<ForceTruth(const In&)> Authority::*;

/// Makes a form that changes each case of the question by `change(case)`.
template <class In, class Change>
WrongForm case_asked(std::string name, std::string meaning, ForceMember<In> stage, Change change) {
  return asked(std::move(name), std::move(meaning), stage, [change](In& in) {
    for (auto& c : in.cases) change(c);
  });
}

/// Makes a form that changes each accepted answer by `change(case, answer)`.
template <class In, class Change>
WrongForm case_told(std::string name, std::string meaning, ForceMember<In> stage, Change change) {
  return told(std::move(name), std::move(meaning), stage, [change](const In& in, ForceTruth& truth) {
    for (std::size_t i = 0; i < in.cases.size(); ++i)
      for (ForceAnswer& answer : truth.accepted[i]) change(in.cases[i], answer);
  });
}

/// Multiplies the force and its scale by a factor.
inline void scale_force(ForceAnswer& answer, double factor) {
  answer.force = {factor * answer.force.x, factor * answer.force.y, factor * answer.force.z};
  answer.force_scale *= std::abs(factor);
}

/// Multiplies the block and its scale by a factor.
inline void scale_block(ForceAnswer& answer, double factor) {
  for (double& b : answer.block) b *= factor;
  answer.block_scale *= std::abs(factor);
}

/// Returns the trace of the block.
inline double trace(const ForceAnswer& answer) { return answer.block[0] + answer.block[3] + answer.block[5]; }

/// Replaces a part `coefficient` · I of the block by `coefficient` times a matrix of ones.
inline void add_ones(ForceAnswer& answer, double coefficient) {
  for (const std::size_t k : {1, 2, 4}) answer.block[k] += coefficient;
  answer.block_scale = std::max(answer.block_scale, std::abs(coefficient));
}

/// Returns the mistakes that are possible for every force and block.
template <class In>
std::vector<WrongForm> common_forms(ForceMember<In> stage) {
  using Case = std::decay_t<decltype(In{}.cases[0])>;
  const auto factor = [stage](const char* name, const char* meaning, double of_force, double of_block) {
    return case_told(name, meaning, stage, [of_force, of_block](const Case&, ForceAnswer& answer) {
      scale_force(answer, of_force);
      scale_block(answer, of_block);
    });
  };
  return {factor("flipped_sign", "the force with the other sign: the gradient in place of minus it", -1, 1),
          factor("twice_as_stiff", "force and block doubled", 2, 2),
          factor("half_as_stiff", "force and block halved", 0.5, 0.5),
          factor("force_doubled", "the force doubled, the block right", 2, 1),
          factor("force_halved", "the force halved, the block right", 0.5, 1),
          factor("hessian_counted_twice", "the block doubled, the force right", 1, 2),
          factor("hessian_halved", "the block halved, the force right", 1, 0.5),
          factor("hessian_flipped", "the block with the other sign", 1, -1),
          factor("hessian_missing", "the block is 0, the force right", 1, 0),
          factor("term_missing", "force and block are 0: the whole term is dropped", 0, 0),
          case_told("hessian_diagonal_alone", "the block without what is off its diagonal", stage,
                    [](const Case&, ForceAnswer& answer) { answer.block[1] = answer.block[2] = answer.block[4] = 0; }),
          case_told("hessian_isotropic", "the block's trace on its diagonal: I in place of n nᵀ or I − n nᵀ", stage,
                    [](const Case&, ForceAnswer& answer) {
                      const double all = trace(answer);
                      answer.block = {all, 0, 0, all, 0, all};
                    })};
}

/// Adds forms with wrong damping: none, twice as much, the other DampingForm, or damping in the force alone.
template <class In>
void add_damping(std::vector<WrongForm>& forms, ForceMember<In> stage) {
  using Case = std::decay_t<decltype(In{}.cases[0])>;
  using Right = std::function<ForceTruth(const In&)>;
  forms.push_back(case_asked("damping_missing", "without damping", stage, [](Case& c) { c.damping = 0; }));
  forms.push_back(case_asked("damping_doubled", "2 k for the damping k", stage, [](Case& c) { c.damping *= 2; }));
  forms.push_back(case_asked("damping_of_strains_for_every_form",
                             "damping of strains, where damping by vertex is asked for", stage,
                             [](Case& c) { c.damping_form = DampingForm::strain; }));
  forms.push_back(case_asked("damping_per_vertex_for_every_form",
                             "damping by vertex, where damping of strains is asked for", stage,
                             [](Case& c) { c.damping_form = DampingForm::per_vertex; }));
  forms.push_back(form("damping_without_block", "damping in the force alone: the block lacks its part", stage,
                       [](const Right& right, const In& in) {
                         ForceTruth truth = right(in);
                         In undamped = in;
                         for (Case& c : undamped.cases) c.damping = 0;
                         const ForceTruth without = right(undamped);
                         for (std::size_t i = 0; i < truth.accepted.size(); ++i)
                           for (ForceAnswer& answer : truth.accepted[i]) answer.block = without.accepted[i][0].block;
                         return truth;
                       }));
}

}  // namespace ogc::compare
