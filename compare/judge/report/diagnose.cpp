#include "compare/judge/report/diagnose.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/asked.hpp"
#include "compare/judge/report/inputs.hpp"

namespace ogc::compare {

namespace {

// Largest numbers of cases that are tried. They are large enough to exclude chance, and take the authority one or two
// seconds.
constexpr std::size_t most_failing = 120, most_failing_meshes = 24;
constexpr std::size_t sampled = 600, sampled_of_mesh_stage = 2;
// A property of all failing cases is reported if at least this many right cases lack it.
constexpr std::uint64_t least_elsewhere = 10;
// Number of cases on which each form is tried first. A form that fits a tenth of all cases fits at least one of 24 with
// a probability of 92 %.
constexpr std::size_t most_tried = 24;
// Largest number of mistakes that are named in addition to the first.
constexpr std::size_t most_seconds = 3;

/// Returns the number of sampled cases from each generator of a stage.
std::size_t cases_of_a_generator(CaseKind kind, std::size_t generators) {
  switch (kind) {
    case CaseKind::single: return (sampled + generators - 1) / generators;
    case CaseKind::mesh: return sampled_of_mesh_stage;
    case CaseKind::followed: return 1;
  }
  return 1;
}

/// Returns the first cases of every generator that is used for the contestant.
std::vector<TestCase> sample(Stage stage, const Contestant& contestant, std::uint64_t seed) {
  const auto rows = generators(stage);
  const std::size_t each = cases_of_a_generator(stage_info(stage).kind, rows.size());
  std::vector<TestCase> cases;
  for (const Generator& row : rows)
    for (std::size_t i = 0; i < each && row.least == 0 && is_asked(contestant, stage, row); ++i)
      cases.push_back(generate(row, {stage, std::string(row.name), seed, i, "", {}}));
  return cases;
}

/// Returns at most `most` of the cases, evenly spaced.
std::vector<TestCase> thinned(std::span<const TestCase> cases, std::size_t most) {
  std::vector<TestCase> kept;
  const std::size_t count = std::min(cases.size(), most);
  for (std::size_t i = 0; i < count; ++i) kept.push_back(cases[i * cases.size() / count]);
  return kept;
}

class Diagnosing {
 public:
  Diagnosing(Stage stage, const Contestant& contestant, const Authority& authority)
      : stage_(stage), contestant_(contestant), authority_(authority) {}

  void look_at(std::span<const TestCase> cases) {
    for (const TestCase& test : cases) {
      if (std::any_of(evidence_.begin(), evidence_.end(),
                      [&](const Evidence& seen) { return seen.test.name == test.name; }))
        continue;
      Evidence one{test, remembered(contestant_)};
      try {
        one.fails = !agrees(one, authority_);
      } catch (const ContestantFailure&) {
        return;  // The contestant crashes or hangs; every further case of this kind would cost a restart.
      }
      evidence_.push_back(std::move(one));
    }
  }

  std::uint64_t failing() const {
    return static_cast<std::uint64_t>(
        std::count_if(evidence_.begin(), evidence_.end(), [](const Evidence& one) { return one.fails; }));
  }

  Diagnosis conclude() {
    Diagnosis result;
    result.failing = failing();
    result.right = evidence_.size() - result.failing;
    const std::vector<WrongForm> forms = wrong_forms(stage_, evidence_);
    result.forms = forms.size();
    for (const bool vague : {false, true})
      for (const WrongForm& form : forms)
        if (form.is_vague == vague && (!vague || result.name.empty())) consider(form, result);
    if (stage_info(stage_).kind == CaseKind::single) find_parts(forms, result);
    find_where(result);
    return result;
  }

 private:
  static bool fits(const WrongForm& form, const Evidence& one, const Authority& authority) {
    try {
      return form.fits(one, authority);
    } catch (const std::exception&) {
      return false;  // the authority does not accept the changed question
    }
  }

  /// Stores the form as the best one if it fits enough failing cases, and fewer cases contradict it than the best form
  /// so far. If equally many cases contradict both forms, adds the form's name to `as_well`.
  void consider(const WrongForm& form, Diagnosis& best) const {
    const auto wanted = std::max<std::uint64_t>(
        least_fits, static_cast<std::uint64_t>(std::ceil(least_share * static_cast<double>(best.failing))));
    std::uint64_t fitting = 0, missed = 0, otherwise = 0;
    for (const Evidence& one : evidence_) {
      if (!one.fails) continue;
      (fits(form, one, authority_) ? fitting : missed) += 1;
      if (missed + wanted > best.failing) return;
    }
    for (const Evidence& one : evidence_) otherwise += !one.fails && !fits(form, one, authority_);
    const std::uint64_t against = missed + otherwise, against_best = best.failing - best.fits + best.otherwise;
    if (!best.name.empty() && against > against_best) return;
    if (!best.name.empty() && against == against_best) {
      best.as_well.push_back(form.name);
      return;
    }
    best.name = form.name;
    best.meaning = form.meaning;
    best.as_well.clear();
    best.fits = fitting;
    best.otherwise = otherwise;
  }

  /// Returns the cases that the form fits. `authority` may already contain the mistake of another form.
  static std::vector<const Evidence*> fitting(const WrongForm& form, const Authority& authority,
                                              const std::vector<const Evidence*>& rest) {
    std::vector<const Evidence*> found;
    std::ranges::copy_if(rest, std::back_inserter(found),
                         [&](const Evidence* one) { return fits(form, *one, authority); });
    return found;
  }

  /// A form, and the failing cases that it fits alone or together with the first form.
  struct Part {
    const WrongForm* form = nullptr;
    bool together = false;
    std::vector<const Evidence*> cases{};
  };

  /// Checks whether few right cases contradict the form. A form that is wrong nearly everywhere fits some failing cases
  /// by chance.
  static bool is_spoken_for(const WrongForm& form, const Authority& authority,
                            const std::vector<const Evidence*>& right) {
    double left = (1 - least_share_of_right) * static_cast<double>(right.size());
    return std::ranges::all_of(right,
                               [&](const Evidence* one) { return fits(form, *one, authority) || (left -= 1) >= 0; });
  }

  /// Checks whether the form fits at least one of a few sampled cases. Most forms fit none and need not be tried on all
  /// cases.
  static bool may_fit(const WrongForm& form, const Authority& authority, const std::vector<const Evidence*>& rest) {
    const std::size_t count = std::min(most_tried, rest.size());
    for (std::size_t i = 0; i < count; ++i)
      if (fits(form, *rest[i * rest.size() / count], authority)) return true;
    return false;
  }

  /// Returns the form that fits most of the remaining cases `rest`. Returns a vague form only if no other form fits
  /// `wanted` cases.
  Part best_part(const std::vector<WrongForm>& forms, const WrongForm* first, const std::vector<const Evidence*>& rest,
                 const std::vector<const Evidence*>& right, std::size_t wanted) const {
    Part best;
    const auto try_all = [&](bool vague, bool together) {
      const Authority authority = together ? first->wrong(authority_) : authority_;
      for (const WrongForm& form : forms) {
        if (form.is_vague != vague || &form == first || !may_fit(form, authority, rest)) continue;
        std::vector<const Evidence*> cases = fitting(form, authority, rest);
        if (cases.size() > best.cases.size() && is_spoken_for(form, authority, right))
          best = {&form, together, std::move(cases)};
      }
    };
    try_all(false, false);
    if (first != nullptr && first->wrong) try_all(false, true);
    if (best.cases.size() < wanted) try_all(true, false);
    return best;
  }

  /// Names several forms, each for a part of the failing cases. If one form is already named, names forms for the cases
  /// that it does not fit.
  void find_parts(const std::vector<WrongForm>& forms, Diagnosis& result) const {
    std::vector<const Evidence*> rest, right;
    for (const Evidence& one : evidence_) (one.fails ? rest : right).push_back(&one);
    const auto share = [failing = static_cast<double>(rest.size())](std::size_t count) {
      return static_cast<double>(count) / failing;
    };
    const auto wanted = std::max<std::size_t>(
        least_fits, static_cast<std::size_t>(std::ceil(least_share_of_second * static_cast<double>(rest.size()))));
    std::vector<Part> parts;
    const auto take = [&](Part part) {
      std::erase_if(rest, [&](const Evidence* one) { return std::ranges::find(part.cases, one) != part.cases.end(); });
      parts.push_back(std::move(part));
    };
    if (!result.name.empty()) {
      const auto named = std::ranges::find(forms, result.name, &WrongForm::name);
      take({&*named, false, fitting(*named, authority_, rest)});
    }
    while (parts.size() <= most_seconds && rest.size() >= wanted) {
      Part part = best_part(forms, parts.empty() ? nullptr : parts[0].form, rest, right, wanted);
      if (part.cases.size() < wanted) break;
      take(std::move(part));
    }
    if (parts.empty()) return;
    if (result.name.empty()) {
      const std::size_t first = parts[0].cases.size(), all = result.failing - rest.size();
      if (share(first) < least_share_of_first && share(all) < least_share) return;
      result.name = parts[0].form->name;
      result.meaning = parts[0].form->meaning;
      result.fits = first;
      result.otherwise = right.size() - fitting(*parts[0].form, authority_, right).size();
    }
    for (std::size_t i = 1; i < parts.size(); ++i)
      result.seconds.push_back({parts[i].form->name, parts[i].form->meaning, parts[i].cases.size(), parts[i].together});
  }

  /// Returns a word for each input that has one entry: the name of a choice, or whether a number is 0.
  static std::map<std::string, std::string> words_of(const TestCase& test) {
    std::map<std::string, std::string> words;
    for (const Quantity& quantity : inputs_of(test)) {
      if (quantity.is_list || quantity.entries() != 1) continue;
      if (!quantity.words.empty())
        words[quantity.name] = quantity.words[0];
      else if (quantity.width == 1)
        words[quantity.name] = quantity.numbers[0] == 0 ? "0" : "not 0";
    }
    return words;
  }

  /// Finds the input for which the most right cases have a word that no failing case has. Of equally good inputs, takes
  /// the one with the fewest words in failing cases.
  void find_where(Diagnosis& result) const {
    if (is_mesh_stage(stage_) || result.failing < least_fits) return;
    std::map<std::string, std::set<std::string>> of_failing;
    for (const Evidence& one : evidence_)
      if (one.fails)
        for (const auto& [name, text] : words_of(one.test)) of_failing[name].insert(text);
    std::map<std::string, std::uint64_t> elsewhere;
    for (const Evidence& one : evidence_)
      if (!one.fails)
        for (const auto& [name, text] : words_of(one.test)) elsewhere[name] += of_failing[name].count(text) == 0;
    std::size_t words = 0;
    for (const auto& [name, count] : elsewhere) {
      const std::set<std::string>& texts = of_failing[name];
      if (count < least_elsewhere || count < result.elsewhere || (count == result.elsewhere && texts.size() >= words))
        continue;
      result.elsewhere = count;
      words = texts.size();
      result.where = name + " is ";
      for (const std::string& text : texts) result.where += (text == *texts.begin() ? "" : " or ") + text;
    }
  }

  Stage stage_;
  const Contestant& contestant_;
  const Authority& authority_;
  std::vector<Evidence> evidence_;
};

}  // namespace

Diagnosis diagnose(Stage stage, std::span<const TestCase> failing, const Contestant& contestant,
                   const Authority& authority, std::uint64_t seed) {
  Diagnosing diagnosing(stage, contestant, authority);
  diagnosing.look_at(thinned(failing, is_mesh_stage(stage) ? most_failing_meshes : most_failing));
  diagnosing.look_at(sample(stage, contestant, seed));
  return diagnosing.conclude();
}

}  // namespace ogc::compare
