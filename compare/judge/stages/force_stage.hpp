// Makes a stage whose answer is the force and block of one vertex of a stencil.
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/engine/force_members.hpp"
#include "compare/judge/engine/stencil_json.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

/// Lists the members of a force stage's case in order.
class StencilInputs {
 public:
  StencilInputs(std::vector<std::string> roles, std::vector<Quantity>& inputs)
      : roles_(std::move(roles)), inputs_(inputs) {}
  void operator()(const char* name, const char* unit, float x) { inputs_.push_back(scalar(name, unit, x)); }
  void operator()(const char* name, const char*, std::int32_t own) {
    inputs_.push_back(word(name, roles_.at(static_cast<std::size_t>(own))));
  }
  void operator()(const char* name, const char*, std::uint8_t bits) {
    std::string all;
    for (std::size_t k = 0; k < roles_.size(); ++k)
      if ((bits >> k & 1) != 0) all += (all.empty() ? "" : "; ") + roles_[k];
    inputs_.push_back(word(name, all.empty() ? "none" : all));
  }
  void operator()(const char* name, const char*, Named auto x) {
    inputs_.push_back(word(name, std::string(names_of(x)[static_cast<std::size_t>(x)])));
  }
  template <std::size_t n>
  void operator()(const char* name, const char* unit, const std::array<Vec3f, n>& stencil) {
    inputs_.push_back(points(name, unit, std::span(stencil).first(roles_.size())));
    inputs_.back().labels = roles_;
  }
  template <std::size_t n>
  void operator()(const char* name, const char* unit, const std::array<float, n>& values) {
    inputs_.push_back(numbers(name, unit, values));
  }

 private:
  std::vector<std::string> roles_;
  std::vector<Quantity>& inputs_;
};

/// Lists the entries of an answer's symmetric block.
template <class Block>
Quantity block_quantity(const Block& block) {
  return labelled(numbers("block", "N/m", block), {"xx", "xy", "xz", "yy", "yz", "zz"});
}

/// A force stage. `S::roles(case)` names the vertices of the stencil. `S::checked(case)` checks a case read from a
/// file: it returns the case or throws InputError.
template <class S, class StencilCase, auto contestant, auto authority>
struct ForceStage : BatchStage<S, contestant, authority>, TakenWhole, ParametersOfCase<S> {
  using Base = BatchStage<S, contestant, authority>;
  using typename Base::In;
  using typename Base::Out;
  using typename Base::Truth;
  using Case = StencilCase;

  /// `checked` accepts any stencil that was read. `write` and `read` convert a case to JSON and back.
  static Case checked(Case c) { return c; }
  static Json write(const Case& c) { return write_stencil(c); }
  static Case read(const Json& data) { return S::checked(read_stencil<Case>(data)); }
  /// Lists the members by name and unit.
  static std::vector<Quantity> inputs(const Case& c) {
    std::vector<Quantity> all;
    visit_members(c, StencilInputs(S::roles(c), all));
    return all;
  }

  /// Makes a question that consists of the unchanged cases.
  static In question(Cases cases) { return case_question(cases, &In::cases); }
  static void judge(Cases cases, const In&, const Truth& truth, const Out& out, Tally& tally) {
    judge_force(cases, truth, out, tally);
  }
  static auto arrays(const Out& out) { return std::tie(out.force, out.block); }

  /// Returns a text with the number of accepted answers; empty if there is one.
  static std::string note(const Truth& truth) {
    const std::size_t accepted = truth.accepted[0].size();
    return accepted == 1 ? ""
                         : "grey: " + std::to_string(accepted) +
                               " answers are accepted, on either side of a jump; the exact one is shown";
  }
  /// Return force and block of the answer, and the exact ones of the truth.
  static std::vector<Quantity> outputs(const In&, const Out& out) {
    return {points("force", "N", std::array{out.force.at(0)}), block_quantity(out.block.at(0))};
  }
  static std::vector<Quantity> outputs(const In&, const Truth& truth) {
    const ForceAnswer& exact = truth.accepted[0][0];
    return {points("force", "N", std::array{exact.force}), block_quantity(exact.block)};
  }
};

}  // namespace ogc::compare
