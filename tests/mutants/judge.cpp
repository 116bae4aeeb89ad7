// Judges mutants (tests/mutants.py). The truth about every case is found once, without any mutant, and kept. Then each
// mutant whose number comes in on standard input is switched on and judged on the same cases. They are divided into
// parts (the corpus' cases of a stage, or a stage's generated ones); each runs in its own process, which the mutant may
// crash or hang. Only parts that reach the mutant run, because the others give the same result. A mutant that passes
// the judge then runs the unit tests that reach it, one by one in the same way. Parts come first, then tests, both by
// the time that they take without a mutant, and each may take ten times that.
//
// Usage: mutant_judge CASES SEED SECONDS CORPUS JOBS STAGE …
// After SECONDS of wall-clock time no further mutant is begun. Times go to standard error. The first line of output is
// "right", or what is wrong without any mutant. Then comes a line for each mutant, as they are judged, JOBS at a time:
// its number, a tab, and
//   (no text)                        if it survives,
//   "test NAME" …                    if only a test finds it,
//   "ten times slower: …"            if all that ends is right and what is named does not end in ten times the
//                                    time that it takes without a mutant,
//   "not decided: …"                 if what is named neither ended nor took the processor's time,
//   "not reached"                    if no part and no test reaches it,
// otherwise the judge's message.
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <iostream>
#include <iterator>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "compare/judge/engine/judge.hpp"
#include "compare/judge/report/corpus.hpp"
#include "compare/stages/all.hpp"
#include "reference/contestant.hpp"
#include "tests/mutants/apart.hpp"
#include "tests/mutants/contestant.hpp"
#include "tests/mutants/switch.hpp"
#include "tests/mutants/unit_tests.hpp"

namespace {

using namespace ogc::compare;
using namespace ogc::tests;

constexpr double slow_factor = 10;
constexpr double least_time = 0.1;  ///< what takes less counts as this [s of the processor]
constexpr double longest = 300;     ///< limit of a part or a test without any mutant [s of the processor]
constexpr int most_slow = 3;        ///< parts and tests that may time out before a mutant counts as slow

/// What a thread is judging now. `round` is 0 while the truth is found.
struct Moment {
  std::size_t round = 0, part = 0;
};
thread_local Moment now;

/// Answers from memory, in the order in which the questions of the part first came: on one thread the judge asks the
/// same questions again.
template <class Truth, class In>
std::function<Truth(const In&)> remembered(std::function<Truth(const In&)> authority, std::size_t parts) {
  if (!authority) return authority;
  struct Memory {
    std::vector<Truth> truths;
    std::size_t next = 0, round = 0;
  };
  auto memories = std::make_shared<std::vector<Memory>>(parts);
  return [authority, memories](const In& in) {
    Memory& memory = (*memories)[now.part];
    if (memory.round != now.round) memory.next = 0;
    memory.round = now.round;
    if (memory.next == memory.truths.size()) memory.truths.push_back(authority(in));
    return memory.truths[memory.next++];
  };
}

Authority remembering(const Authority& a, std::size_t parts) {
  Authority r;
  r.closest_face = remembered(a.closest_face, parts);
  r.closest_points = remembered(a.closest_points, parts);
  r.detect_vertex_facet = remembered(a.detect_vertex_facet, parts);
  r.detect_edge_edge = remembered(a.detect_edge_edge, parts);
  r.bound = remembered(a.bound, parts);
  r.activation = remembered(a.activation, parts);
  r.barrier = remembered(a.barrier, parts);
  r.ccd = remembered(a.ccd, parts);
  r.truncate = remembered(a.truncate, parts);
  r.membrane = remembered(a.membrane, parts);
  r.bending = remembered(a.bending, parts);
  r.spring = remembered(a.spring, parts);
  r.tetrahedron = remembered(a.tetrahedron, parts);
  r.rod = remembered(a.rod, parts);
  r.orientation = remembered(a.orientation, parts);
  r.contact_force = remembered(a.contact_force, parts);
  r.friction_force = remembered(a.friction_force, parts);
  r.volume_depth = remembered(a.volume_depth, parts);
  r.volume_force = remembered(a.volume_force, parts);
  r.block = remembered(a.block, parts);
  r.initial_guess = remembered(a.initial_guess, parts);
  r.rest_state = remembered(a.rest_state, parts);
  r.sweep = a.sweep;  // their truth depends on the answer
  r.step = a.step;
  return r;
}

/// Holds cases of one stage: the corpus' cases or, if there are none, generated ones.
struct Part {
  Stage stage{};
  std::vector<TestCase> corpus;
};

struct WrongAnswer {};

/// Returns the first mistake in the part, or "" if there is none.
std::string verdict(const Part& part, const Contestant& contestant, const Authority& authority, JudgeOptions options) {
  const auto first = [&](const StageReport& report) {
    const auto& listed = report.tally.mismatches;
    if (report.skipped) return std::string("is not judged");
    return listed.empty() ? std::string() : print_problem(listed[0].name) + ": " + listed[0].message;
  };
  if (!part.corpus.empty()) return first(judge_cases(part.corpus, contestant, authority).at(0));
  if (is_mesh_stage(part.stage)) options.cases /= 4;
  options.progress = [](std::uint64_t, std::uint64_t mismatches) {
    if (mismatches > 0) throw WrongAnswer();
  };
  try {
    return first(judge_stage(part.stage, contestant, authority, options));
  } catch (const WrongAnswer&) {
    return "wrong answers";
  }
}

/// Returns the numbers of the mutants that `work` reaches, as text.
template <class Work>
std::string reached_by(Work work) {
  ogc_mutant::recording = true;
  work();
  ogc_mutant::recording = false;
  std::string numbers;
  for (std::size_t id = 0; id < std::size(ogc_mutant::reached); ++id)
    if (ogc_mutant::reached[id]) numbers += std::to_string(id) + ' ';
  return numbers;
}

/// A part or a test that a mutant must pass, its cost and the mutants that it reaches. Numbers up to the count of parts
/// are parts, higher ones tests.
struct Hurdle {
  std::size_t number = 0;
  double seconds = 0;
  std::set<int> reached{};
};

/// Holds the judge with its memory, the tests, and which mutants each of them reaches.
class MutantJudge {
 public:
  MutantJudge(std::vector<Part> parts, const JudgeOptions& options, std::size_t jobs)
      : parts_(std::move(parts)),
        options_(options),
        jobs_(jobs),
        authority_(remembering(ogc::reference::authority(), parts_.size())),
        tests_(unit_test_names()) {}

  /// Judges the unchanged program: returns "right" or what is wrong.
  std::string judge_original() {
    const auto start = std::chrono::steady_clock::now();
    if (const std::string wrong = find_truth(); !wrong.empty()) return wrong;
    std::cerr << "the truth: " << seconds_since(start) << " s by the clock" << std::endl;
    const std::string wrong = measure();
    return wrong.empty() ? "right" : wrong;
  }

  /// Returns the result of one mutant in one line.
  std::string judge_mutant(int id) const {
    bool reached = false;
    int slow = 0;
    std::string first_slow, not_decided;
    for (const Hurdle& hurdle : hurdles_) {
      if (!hurdle.reached.contains(id)) continue;
      reached = true;
      const Ended ended = apart(slow_factor * std::max(least_time, hurdle.seconds), [&] {
        ogc_mutant::active = id;
        return meet(hurdle.number);
      });
      if (ended.ending == Ending::crashes) return found_by(hurdle.number, "crashes: " + ended.said);
      if (ended.ending == Ending::says && !ended.said.empty()) return found_by(hurdle.number, ended.said);
      if (ended.ending == Ending::says) continue;
      std::string& where = ended.ending == Ending::late ? first_slow : not_decided;
      if (where.empty()) where = name_of(hurdle.number);
      if (++slow == most_slow) break;
    }
    if (!first_slow.empty()) return "ten times slower: " + first_slow;
    if (!not_decided.empty()) return "not decided: " + not_decided;
    return reached ? "" : "not reached";
  }

 private:
  std::string judged(std::size_t part) const {
    return verdict(parts_[part], mutant_contestant(), authority_, options_);
  }

  /// Runs a part or a test on the mutant that is switched on and returns what it finds.
  std::string meet(std::size_t number) const {
    if (number >= parts_.size()) return unit_test_fails(tests_[number - parts_.size()]) ? "fails" : "";
    now = {1, number};
    return judged(number);
  }

  std::string name_of(std::size_t number) const {
    if (number >= parts_.size()) return "test " + tests_[number - parts_.size()];
    return (parts_[number].corpus.empty() ? "" : "corpus of ") + std::string(stage_name(parts_[number].stage));
  }

  std::string found_by(std::size_t number, std::string what) const {
    what.resize(std::min<std::size_t>(what.size(), 300));
    std::replace(what.begin(), what.end(), '\n', ' ');
    return name_of(number) + ": " + what;
  }

  /// Fills the memory, `jobs` parts at a time. It uses threads, which have ended before the first process is forked.
  std::string find_truth() {
    std::vector<std::string> wrong(parts_.size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      for (std::size_t part = 0; (part = next++) < parts_.size();) {
        now = {0, part};
        wrong[part] = judged(part);
      }
    };
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < jobs_; ++k) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    for (const std::string& text : wrong)
      if (!text.empty()) return text;
    return "";
  }

  /// Measures the time of each part and test with the truth at hand and notes the mutants that it reaches. As many run
  /// at once as later with mutants.
  std::string measure() {
    const auto noted = [&](std::size_t number) {
      const Ended ended = apart(longest, [&] {
        std::string wrong;
        const std::string numbers = reached_by([&] { wrong = meet(number); });
        return wrong.empty() ? numbers : "wrong: " + wrong;
      });
      std::string text = ended.ending == Ending::says ? ended.said : "wrong: does not come to an end " + ended.said;
      std::replace(text.begin(), text.end(), '\n', ' ');
      return std::to_string(ended.seconds) + ' ' + text;
    };
    const auto start = std::chrono::steady_clock::now();
    const std::vector<std::string> said = in_parallel(jobs_, parts_.size() + tests_.size(), noted);
    double of_parts = 0, of_tests = 0;
    for (std::size_t number = 0; number < said.size(); ++number) {
      std::istringstream words(said[number]);
      Hurdle hurdle{number};
      if (!(words >> hurdle.seconds) || said[number].find("wrong: ") != std::string::npos)
        return name_of(number) + ": " + said[number];
      for (int id = 0; words >> id;) hurdle.reached.insert(id);
      (number < parts_.size() ? of_parts : of_tests) += hurdle.seconds;
      std::cerr << name_of(number) << '\t' << hurdle.seconds << " s\t" << hurdle.reached.size() << " mutants\n";
      hurdles_.push_back(std::move(hurdle));
    }
    const auto tests = hurdles_.begin() + static_cast<std::ptrdiff_t>(parts_.size());
    const auto faster = [](const Hurdle& a, const Hurdle& b) { return a.seconds < b.seconds; };
    std::stable_sort(hurdles_.begin(), tests, faster);
    std::stable_sort(tests, hurdles_.end(), faster);
    std::cerr << "without a mutant: " << parts_.size() << " parts of the judge take " << of_parts << " s, "
              << tests_.size() << " tests " << of_tests << " s of the processor, together " << seconds_since(start)
              << " s by the clock" << std::endl;
    return "";
  }

  std::vector<Part> parts_;
  JudgeOptions options_;
  std::size_t jobs_;
  Authority authority_;
  std::vector<std::string> tests_;
  std::vector<Hurdle> hurdles_;  ///< parts, then tests, each sorted by time
};

std::vector<Part> parts_of(const std::vector<TestCase>& corpus, const std::vector<Stage>& stages) {
  std::vector<Part> parts;
  for (const Stage stage : all_stages) {
    Part part{stage, {}};
    const auto mine = [&](const TestCase& test) { return test.name.stage == stage; };
    std::copy_if(corpus.begin(), corpus.end(), std::back_inserter(part.corpus), mine);
    if (!part.corpus.empty()) parts.push_back(part);
  }
  for (const Stage stage : stages) parts.push_back({stage, {}});
  return parts;
}

}  // namespace

int main(int count, char** words) {
  if (count < 7) return 2;
  const auto start = std::chrono::steady_clock::now();
  // Children are forked, and a pool's threads would not exist in them.
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  JudgeOptions options;
  options.cases = std::stoull(words[1]);
  options.seed = std::stoull(words[2]);
  options.threads = 1;
  options.batch = 1000;
  const double seconds = std::stod(words[3]);
  std::vector<TestCase> corpus;
  for (const CaseName& name : load_batch(words[4])) corpus.push_back(generate(name));
  const std::size_t jobs = std::stoul(words[5]);
  std::vector<Stage> stages;
  for (int i = 6; i < count; ++i) stages.push_back(find_stage(words[i]).value());
  MutantJudge judge(parts_of(corpus, stages), options, jobs);
  std::cout << judge.judge_original() << std::endl;
  std::vector<int> ids;
  for (int id = 0; std::cin >> id;) ids.push_back(id);
  const auto judged = [&](std::size_t i) {
    write_all(STDOUT_FILENO, std::to_string(ids[i]) + '\t' + judge.judge_mutant(ids[i]) + '\n');
  };
  hand_out(jobs, ids.size(), judged, [&] { return seconds_since(start) < seconds; });
  return 0;
}
