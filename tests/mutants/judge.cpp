// Judges mutants (tests/mutants.py). The truth about every case is found once, without any of them, and kept;
// each mutant whose number comes in on standard input is then switched on and judged on the same cases in a process of
// its own, which it may crash or hang, in those parts (the corpus, a stage) that reach it: it changes nothing in the
// others. What the judge lets through, or is not through with in time, meets the unit tests.
//
// Usage: mutant_judge CASES SEED SECONDS CORPUS JOBS STAGE …
// First line out: "right", or what is wrong without any mutant. Then a line for each mutant, as they are judged, JOBS
// at a time: its number, a tab, and nothing where it survives, "test" where only a test finds it, "not reached" where
// nothing looks at it, otherwise what the judge said.
#include <signal.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "compare/judge/corpus.hpp"
#include "compare/judge/judge.hpp"
#include "reference/contestant.hpp"
#include "tests/mutants/contestant.hpp"
#include "tests/mutants/unit_tests.hpp"
#include "tests/mutants/switch.hpp"

namespace {

using namespace ogc::compare;

/// The corpus (0), and from 1 on the stages of the plan.
using Part = std::size_t;

/// What is judged just now.
struct Moment {
  std::size_t round = 0;  ///< 0: without any mutant
  Part part = 0;
  friend bool operator==(const Moment&, const Moment&) = default;
};

/// Answers from memory, in the order in which the part's questions came first: the judge on one thread asks the same ones again.
template <class Truth, class In>
std::function<Truth(const In&)> remembered(std::function<Truth(const In&)> authority, const Moment& now) {
  if (!authority) return authority;
  struct Memory {
    std::map<Part, std::vector<Truth>> truths;
    std::size_t next = 0;
    Moment moment;
  };
  auto memory = std::make_shared<Memory>();
  return [authority, memory, &now](const In& in) {
    if (memory->moment != now) {
      memory->moment = now;
      memory->next = 0;
    }
    auto& truths = memory->truths[now.part];
    if (memory->next == truths.size()) truths.push_back(authority(in));
    return truths[memory->next++];
  };
}

Authority remembering(const Authority& a, const Moment& now) {
  Authority r;
  r.closest_face = remembered(a.closest_face, now);
  r.closest_points = remembered(a.closest_points, now);
  r.detect_vertex_facet = remembered(a.detect_vertex_facet, now);
  r.detect_edge_edge = remembered(a.detect_edge_edge, now);
  r.bound = remembered(a.bound, now);
  r.activation = remembered(a.activation, now);
  r.truncate = remembered(a.truncate, now);
  r.membrane = remembered(a.membrane, now);
  r.bending = remembered(a.bending, now);
  r.spring = remembered(a.spring, now);
  r.contact_force = remembered(a.contact_force, now);
  r.friction_force = remembered(a.friction_force, now);
  r.block = remembered(a.block, now);
  r.initial_guess = remembered(a.initial_guess, now);
  r.rest_state = remembered(a.rest_state, now);
  r.sweep = a.sweep;  // their truth follows the answer
  r.step = a.step;
  return r;
}

struct Plan {
  JudgeOptions options;
  std::vector<Stage> stages;
  std::vector<TestCase> corpus;
};

/// "" where nothing is wrong in the part, else the first stage and message.
std::string verdict(Part part, const Contestant& contestant, const Authority& authority, const Plan& plan) {
  const auto first = [](const StageReport& report) {
    const auto& listed = report.tally.mismatches;
    if (report.skipped) return std::string(stage_name(report.tally.stage)) + " is not judged";
    return listed.empty() ? std::string() : print_problem(listed[0].name) + ": " + listed[0].message;
  };
  if (part > 0) {
    const Stage stage = plan.stages[part - 1];
    JudgeOptions options = plan.options;
    if (is_mesh_stage(stage)) options.cases /= 4;
    return first(judge_stage(stage, contestant, authority, options));
  }
  for (const StageReport& report : judge_cases(plan.corpus, contestant, authority))
    if (const std::string found = first(report); !found.empty()) return found;
  return {};
}

const std::string hangs = "hangs";

/// What `work` says, in a process of its own, or how that ended.
template <class Work>
std::string apart(unsigned seconds, Work work) {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    alarm(seconds);
    const std::string found = work();
    if (write(ends[1], found.data(), found.size()) < 0) _exit(4);
    _exit(0);
  }
  close(ends[1]);
  std::string found;
  char buffer[4096];
  for (ssize_t got = 0; (got = read(ends[0], buffer, sizeof buffer)) > 0;) found.append(buffer, static_cast<std::size_t>(got));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGALRM ? hangs : "crashes: signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return "could not be judged: exit status " + std::to_string(WEXITSTATUS(status));
  return found;
}

/// The mutants that `work` reaches.
template <class Work>
std::set<int> reached_by(Work work) {
  std::fill(std::begin(ogc_mutant::reached), std::end(ogc_mutant::reached), false);
  ogc_mutant::recording = true;
  work();
  ogc_mutant::recording = false;
  std::set<int> numbers;
  for (std::size_t id = 0; id < std::size(ogc_mutant::reached); ++id)
    if (ogc_mutant::reached[id]) numbers.insert(static_cast<int>(id));
  return numbers;
}

/// The mutants that the tests reach, as text; the tests pass, or it says that they do not.
std::string reached_by_tests() {
  int failing = 0;
  std::string text;
  for (const int number : reached_by([&] { failing = ogc::tests::failing_unit_tests(); }))
    text += std::to_string(number) + ' ';
  return failing == 0 ? text : "the tests fail";
}

/// The judge with its memory, and which parts reach which mutant.
class MutantJudge {
 public:
  explicit MutantJudge(Plan plan)
      : plan_(std::move(plan)), authority_(remembering(ogc::reference::authority(), now_)), contestant_(ogc::tests::mutant_contestant()) {}

  /// Judges what no mutant has changed: "right" or what is wrong.
  std::string judge_original(unsigned seconds) {
    std::string wrong;
    for (now_.part = 0; now_.part <= plan_.stages.size(); ++now_.part)
      reached_.push_back(reached_by([&] { wrong += verdict(now_.part, contestant_, authority_, plan_); }));
    const std::string tested = apart(20 * seconds, reached_by_tests);
    std::istringstream numbers(tested);
    for (int id = 0; numbers >> id;) tested_.insert(id);
    if (tested_.empty()) wrong += tested;
    return wrong.empty() ? "right" : wrong;
  }

  /// What is found of one mutant, in one line.
  std::string judge_mutant(int id, unsigned seconds) {
    const bool judged =
        std::any_of(reached_.begin(), reached_.end(), [&](const auto& part) { return part.contains(id); });
    if (!judged && !tested_.contains(id)) return "not reached";
    ++now_.round;
    ogc_mutant::active = id;
    std::string found = judged ? apart(seconds, [&] { return first_found(id); }) : "";
    // Slow is not wrong: what takes the judge too long must take the tests too long as well.
    if (found == hangs) found.clear();
    if (found.empty() && tested_.contains(id))
      found = apart(seconds, [] { return std::string(ogc::tests::failing_unit_tests() > 0 ? "test" : ""); });
    ogc_mutant::active = 0;
    std::replace(found.begin(), found.end(), '\n', ' ');
    return found;
  }

 private:
  std::string first_found(int id) {
    std::string found;
    for (now_.part = 0; now_.part < reached_.size() && found.empty(); ++now_.part)
      if (reached_[now_.part].contains(id)) found = verdict(now_.part, contestant_, authority_, plan_);
    return found;
  }

  Plan plan_;
  Moment now_;
  Authority authority_;
  Contestant contestant_;
  std::vector<std::set<int>> reached_;  ///< by part
  std::set<int> tested_;                ///< reached by tests
};

/// Judges the mutants, `jobs` at a time: each job every jobs-th of them, in a process of its own.
void judge_all(MutantJudge& judge, const std::vector<int>& ids, unsigned seconds, std::size_t jobs) {
  std::vector<pid_t> children;
  for (std::size_t job = 0; job < jobs; ++job) {
    children.push_back(fork());
    if (children.back() != 0) continue;
    for (std::size_t i = job; i < ids.size(); i += jobs) {
      const std::string line =
          (std::to_string(ids[i]) + '\t' + judge.judge_mutant(ids[i], seconds)).substr(0, 500) + '\n';
      if (write(STDOUT_FILENO, line.data(), line.size()) < 0) break;
    }
    _exit(0);
  }
  for (const pid_t child : children) waitpid(child, nullptr, 0);
}

}  // namespace

int main(int count, char** words) {
  if (count < 7) return 2;
  // Children are forked, and a pool of threads would be gone in them.
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  Plan plan;
  plan.options.cases = std::stoull(words[1]);
  plan.options.seed = std::stoull(words[2]);
  plan.options.threads = 1;
  plan.options.batch = 1000;
  for (int i = 6; i < count; ++i) plan.stages.push_back(find_stage(words[i]).value());
  for (const CaseName& name : load_batch(words[4])) plan.corpus.push_back(generate(name));
  MutantJudge judge(std::move(plan));
  const auto seconds = static_cast<unsigned>(std::stoul(words[3]));
  std::cout << judge.judge_original(seconds) << std::endl;
  std::vector<int> ids;
  for (int id = 0; std::cin >> id;) ids.push_back(id);
  judge_all(judge, ids, seconds, std::stoul(words[5]));
  return 0;
}
