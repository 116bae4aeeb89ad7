#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "experiments/bench/results.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::experiments;
using namespace ogc::tests;

namespace {

using Verdict = BenchChange::Verdict;

/// Writes a results file of one benchmark, with one process for each time [ms].
std::filesystem::path results_file(const TemporaryFolder& folder, const std::string& name,
                                   const std::vector<double>& times, const std::string& device = "d") {
  Json json{{"context", {{"device_cpu", device}, {"num_cpus", 2}}}, {"benchmarks", Json::array()}};
  int process = 0;
  for (const double time : times)
    json["benchmarks"].push_back({{"run_name", "step/x/cpu/iterations:4/repeats:3/manual_time"},
                                  {"run_type", "iteration"},
                                  {"real_time", time},
                                  {"time_unit", "ms"},
                                  {"process", process++}});
  return folder.write(name, json.dump());
}

BenchChange change_between(const std::vector<double>& before, const std::vector<double>& after) {
  const TemporaryFolder folder;
  const BenchComparison comparison = compare_results(read_results(results_file(folder, "before", before)),
                                                     read_results(results_file(folder, "after", after)));
  REQUIRE(comparison.changes.size() == 1);
  return comparison.changes[0];
}

}  // namespace

TEST_CASE("a verdict comes from ranks, not from percentages: 1 % that is certain, 30 % that is noise", "[unit]") {
  const std::vector<double> steady{100, 100.1, 100.2, 100.3, 100.4, 100.5, 100.6, 100.7},
      restless{70, 150, 90, 120, 80, 160, 75, 110};
  std::vector<double> one_percent, third;
  for (const double time : steady) one_percent.push_back(1.01 * time);
  for (const double time : restless) third.push_back(1.3 * time);
  const BenchChange certain = change_between(steady, one_percent);
  CHECK(certain.verdict == Verdict::slower);
  CHECK(certain.ratio == Approx(1.01));
  CHECK(certain.name == "step/x/cpu/iterations:4");
  CHECK(certain.before_ns == Approx(100.35e6));
  CHECK(change_between(one_percent, steady).verdict == Verdict::faster);
  CHECK(change_between(restless, third).verdict == Verdict::none_found);
  CHECK(change_between({1, 2, 3}, {4, 5, 6}).verdict == Verdict::too_few);
}

TEST_CASE("repetitions of one process are not samples of what differs between starts, and the report says so",
          "[unit]") {
  const TemporaryFolder folder;
  Json json = Json::parse(compare::read_bytes(results_file(folder, "many", {1, 2, 3, 4, 5, 6, 7, 8})));
  for (Json& run : json["benchmarks"]) run.erase("process");
  const BenchResults single = read_results(folder.write("single", json.dump()));
  CHECK(single.processes == 1);
  CHECK(single.times.begin()->second.size() == 8);
  CHECK(describe(compare_results(single, single)).find("inside one process") != std::string::npos);
}

TEST_CASE("the program measures in processes, keeps every repetition, and compares two files with its exit status",
          "[unit]") {
  const TemporaryFolder folder;
  const std::string file = (folder / "out.json").string();
  const ProgramResult measured = run_ogc(
      "bench --scale smoke --backend cpu --filter '^(stage/truncate|step/twist|part/(sweep|detection)/twist)' --steps "
      "2 --repetitions 2 --processes 2 --json " +
      file);
  INFO(measured.err);
  REQUIRE(measured.status == 0);
  CHECK(contains(measured.out, {"stage/truncate/cpu", "step/twist/smoke/cpu", "part/sweep/twist/smoke/cpu",
                                "part/detection/twist/smoke/cpu"}));
  const Json json = parse_results(file);
  std::size_t runs = 0;
  for (const Json& run : json.at("benchmarks")) {
    if (run.at("run_type") != "iteration") continue;
    ++runs;
    CHECK(run.at("real_time") > 0);
    const std::string name = run.at("name");
    if (name.starts_with("stage")) continue;
    CHECK((run.at("flop") > 0 && run.at("bytes") > 0));
    CHECK(run.contains("nodes") == !name.starts_with("part/sweep"));
  }
  CHECK(runs == 4 * 2 * 2);
  const std::string before = results_file(folder, "before", {1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6}).string();
  const std::string slower = results_file(folder, "slower", {2, 2.1, 2.2, 2.3, 2.4, 2.5, 2.6}, "other").string();
  const ProgramResult compared = run_ogc("bench --against " + before + " --results " + slower);
  CHECK(compared.status == 1);
  CHECK(contains(compared.out, {"slower", "Mann-Whitney", "Holm", "device_cpu: d, then other"}));
  CHECK(run_ogc("bench --against " + before + " --results " + before).status == 0);
}

TEST_CASE("a window can begin at a frame of a run", "[unit]") {
  const TemporaryFolder folder;
  REQUIRE(
      run_ogc("run twist --scale smoke --steps 6 --set frame_steps=3 --audit off --out " + (folder / "run").string())
          .status == 0);
  const ProgramResult result = run_ogc("bench --backend cpu --steps 2 --repetitions 1 --filter ^step --from-state " +
                                       (folder / "run/frames/frame_000003.h5").string());
  INFO(result.err);
  CHECK(result.status == 0);
  CHECK(contains(result.out, {"step/twist@3/cpu"}));
}

TEST_CASE("worlds side by side are measured, beside the same cloths in one scene", "[unit]") {
  const TemporaryFolder folder;
  const std::string file = (folder / "out.json").string();
  const ProgramResult result = run_ogc(
      "bench --worlds 3 --scale smoke --backend cpu --steps 8 --repetitions 1 --processes 1 --filter "
      "'^(worlds/3/(small_cloth|twist)|step/small_cloths)' --json " +
      file);
  INFO(result.err);
  REQUIRE(result.status == 0);
  CHECK(contains(result.out, {"worlds/3/small_cloth/cpu", "worlds/3/twist/smoke/cpu", "step/small_cloths/3/cpu"}));
  for (const Json& run : parse_results(file).at("benchmarks")) {
    const std::string name = run.at("name");
    if (!name.starts_with("worlds/3/small_cloth")) continue;
    CHECK(run.at("free_vertices") == 81);
    CHECK(run.at("contacts") > 0);
    CHECK(run.at("real_time") > 0);
  }
}

TEST_CASE("wrong files, filters and options of bench exit 2 and say what to do", "[unit]") {
  const TemporaryFolder folder;
  const std::string text = folder.write("text", "no json").string(),
                    empty = folder.write("empty", "{\"context\": {}, \"benchmarks\": []}").string();
  const auto refused = [](const std::string& arguments, std::initializer_list<std::string> words) {
    const ProgramResult result = run_ogc("bench " + arguments);
    INFO(arguments << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, words));
  };
  refused("--against " + text + " --results " + text, {text, "ogc bench --json"});
  refused("--against " + empty + " --results " + empty, {empty, "no measurement"});
  refused("--against missing --results missing", {"missing", "no such file"});
  refused("--results " + text, {"--against"});
  refused("--filter nothing_is_called_so --backend cpu", {"--filter nothing_is_called_so", "--list"});
  refused("--backend cpu --from-state " + text, {"run.json"});
  refused("--backend cpu --worlds 0", {"--worlds"});
}
