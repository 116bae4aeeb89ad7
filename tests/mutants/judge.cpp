// Judges mutants (tests/mutants.py). The truth about every case is found once, with the kernels as they are, and kept; each mutant whose number comes in on
// standard input is then switched on and judged on the same cases in a process of its own, which it may crash or hang. Those that the judge lets through meet
// the kernels' own tests.
//
// Usage: mutant_judge CASES SEED SECONDS CORPUS STAGE …
// First line out: "tests" and the numbers that the kernels' tests reach; second line: "right" and those that the cases reach. Then a line for each mutant: empty where it
// survives, "test" where only a test of the kernels finds it, otherwise what the judge said.
#include <signal.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "compare/judge/corpus.hpp"
#include "compare/judge/judge.hpp"
#include "reference/contestant.hpp"
#include "tests/mutants/contestant.hpp"
#include "tests/mutants/kernel_tests.hpp"
#include "tests/mutants/switch.hpp"

namespace {

using namespace ogc::compare;

/// Answers from memory, in the order in which the questions came first: the judge on one thread asks the same ones again.
template <class Truth, class In>
std::function<Truth(const In&)> remembered(std::function<Truth(const In&)> authority, const std::size_t& round) {
  if (!authority) return authority;
  struct Memory {
    std::vector<Truth> truths;
    std::size_t next = 0, round = 0;
  };
  auto memory = std::make_shared<Memory>();
  return [authority, memory, &round](const In& in) {
    if (memory->round != round) {
      memory->round = round;
      memory->next = 0;
    }
    if (memory->next == memory->truths.size()) memory->truths.push_back(authority(in));
    return memory->truths[memory->next++];
  };
}

Authority remembering(const Authority& a, const std::size_t& round) {
  Authority r;
  r.closest_face = remembered(a.closest_face, round);
  r.closest_points = remembered(a.closest_points, round);
  r.detect_vertex_facet = remembered(a.detect_vertex_facet, round);
  r.detect_edge_edge = remembered(a.detect_edge_edge, round);
  r.bound = remembered(a.bound, round);
  r.activation = remembered(a.activation, round);
  r.truncate = remembered(a.truncate, round);
  r.membrane = remembered(a.membrane, round);
  r.bending = remembered(a.bending, round);
  r.spring = remembered(a.spring, round);
  r.contact_force = remembered(a.contact_force, round);
  r.friction_force = remembered(a.friction_force, round);
  r.block = remembered(a.block, round);
  r.initial_guess = remembered(a.initial_guess, round);
  r.rest_state = remembered(a.rest_state, round);
  r.sweep = a.sweep;  // their truth follows the answer
  r.step = a.step;
  return r;
}

struct Plan {
  JudgeOptions options;
  std::vector<Stage> stages;
  std::vector<TestCase> corpus;
};

/// "" where nothing is wrong, else the first stage and message.
std::string verdict(const Contestant& contestant, const Authority& authority, const Plan& plan) {
  const auto first = [](const StageReport& report) {
    const auto& listed = report.tally.mismatches;
    if (report.skipped) return std::string(stage_name(report.tally.stage)) + " is not judged";
    return listed.empty() ? std::string() : print_problem(listed[0].name) + ": " + listed[0].message;
  };
  std::string found;
  for (const StageReport& report : judge_cases(plan.corpus, contestant, authority))
    if (found.empty()) found = first(report);
  for (const Stage stage : plan.stages) {
    if (!found.empty()) return found;
    JudgeOptions options = plan.options;
    if (is_mesh_stage(stage)) options.cases /= 4;
    found = first(judge_stage(stage, contestant, authority, options));
  }
  return found;
}

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
  if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGALRM ? "hangs" : "crashes: signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return "could not be judged: exit status " + std::to_string(WEXITSTATUS(status));
  return found;
}

std::string numbers_reached() {
  std::string numbers;
  for (std::size_t id = 0; id < std::size(ogc_mutant::reached); ++id)
    if (ogc_mutant::reached[id]) numbers += ' ' + std::to_string(id);
  return numbers;
}

/// " 1 5 …": the mutants that the kernels' tests reach; the tests pass, or the text says that they do not.
std::string reached_by_tests() {
  ogc_mutant::recording = true;
  return ogc::tests::failing_kernel_tests() == 0 ? numbers_reached() : " the kernels' own tests fail";
}

}  // namespace

int main(int count, char** words) {
  if (count < 6) return 2;
  // Children are forked, and a pool of threads would be gone in them.
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  Plan plan;
  plan.options.cases = std::stoull(words[1]);
  plan.options.seed = std::stoull(words[2]);
  plan.options.threads = 1;
  plan.options.batch = 1000;
  for (int i = 5; i < count; ++i) plan.stages.push_back(find_stage(words[i]).value());
  for (const CaseName& name : load_batch(words[4])) plan.corpus.push_back(generate(name));
  std::size_t round = 0;
  const Authority authority = remembering(ogc::reference::authority(), round);
  const Contestant contestant = ogc::tests::mutant_contestant();
  const auto seconds = static_cast<unsigned>(std::stoul(words[3]));
  std::cout << "tests" << apart(10 * seconds, reached_by_tests) << std::endl;
  ogc_mutant::recording = true;
  const std::string wrong = verdict(contestant, authority, plan);
  ogc_mutant::recording = false;
  std::cout << (wrong.empty() ? "right" : wrong) << numbers_reached() << std::endl;
  for (std::string number; std::getline(std::cin, number);) {
    ++round;
    ogc_mutant::active = std::stoi(number);
    std::string found = apart(seconds, [&] { return verdict(contestant, authority, plan); });
    if (found.empty()) found = apart(seconds, [] { return std::string(ogc::tests::failing_kernel_tests() > 0 ? "test" : ""); });
    ogc_mutant::active = 0;
    for (char& c : found)
      if (c == '\n') c = ' ';
    std::cout << found << std::endl;
  }
  return 0;
}
