// Judges plug-ins with failures. Each failure must be reported correctly, the judge must continue or end cleanly, and
// standard output must contain only results.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <nlohmann/json.hpp>

#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc::tests;

namespace {

const std::string broken = OGC_TEST_PLUGINS "/libplugin_broken.so";

/// Returns the folder in which the broken plug-in runs. Failing cases are saved below it.
const TemporaryFolder& broken_folder() {
  static const TemporaryFolder folder;
  return folder;
}

/// Runs `ogc compare` with the broken plug-in; `how` is the value of OGC_BROKEN, which names the fault.
ProgramResult compare_broken(const std::string& how, const std::string& arguments) {
  const std::string folder = (broken_folder() / "").string();
  return run_ogc(
      "compare " + arguments + " --time-limit 3 --plugin " + broken,
      "cd '" + folder + "' && export ASAN_OPTIONS=handle_segv=0:handle_abort=0 OGC_BROKEN='" + how + "' && ");
}

/// Runs `ogc compare` with the plug-in of the fast path's kernels; `how` is the value of OGC_BROKEN.
ProgramResult compare_ours(const std::string& how, const std::string& arguments, const std::string& name = "ours") {
  static const TemporaryFolder scratch;
  return run_ogc("compare " + arguments + " --plugin " OGC_TEST_PLUGINS "/libplugin_" + name + ".so",
                 "cd '" + (scratch / "").string() +
                     "' && export ASAN_OPTIONS=handle_segv=0:handle_abort=0 OGC_BROKEN='" + how + "' && ");
}

/// Returns whether the process whose number is in the file ends within a second; true if the file does not exist. A
/// zombie counts as ended.
bool has_ended(const std::filesystem::path& file) {
  std::ifstream number(file);
  std::string id, name, state;
  if (!(number >> id)) return true;
  for (int i = 0; i < 100; ++i) {
    std::ifstream status("/proc/" + id + "/stat");
    if (!(status >> id >> name >> state) || state == "Z") return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Two cases of the plug-in `broken`: it fails at the case with d = r, and answers the case with d < r.
const std::string breaking = "--problem 'stage=activation gen=ladder.radius seed=1 index=1'",
                  harmless = "--problem 'stage=activation gen=ladder.radius seed=1 index=0'";

}  // namespace

TEST_CASE("a right plug-in passes, in C, and is timed beside ours", "[agreement]") {
  const ProgramResult result = compare_broken("", "activation --cases 3000 --json");
  INFO(result.err);
  REQUIRE(result.status == 0);
  const auto json = nlohmann::json::parse(result.out);
  CHECK(json.at("stages").at(0).at("mismatches") == 0);
  const auto& plugin = json.at("plugin");
  CHECK(plugin.at("name") == "broken");
  CHECK(plugin.at("times").at(0).at("plugin_seconds") > 0);
  CHECK(plugin.at("times").at(0).at("our_seconds") > 0);
  CHECK(plugin.at("times").at(0).at("plugin_seconds") == json.at("stages").at(0).at("contestant_seconds"));
  CHECK(plugin.at("not_a_number").empty());
  CHECK(contains(result.err, {"a plug-in may print"}));
}

TEST_CASE("a plug-in that gives no answer is reported as what it did, with exit status 1", "[agreement]") {
  const auto [how, what] = GENERATE(
      table<std::string, std::string>({{"crash", "it crashed: signal 11"},
                                       {"hang", "it hangs: no answer within 3 seconds"},
                                       {"exit", "it ended the process, exit status 7"},
                                       {"before", "it wrote out of range: before the beginning of `energy`"},
                                       {"behind", "it wrote out of range: behind the end of `curvature`"},
                                       {"far behind", "it crashed: signal 11"},
                                       {"input", "it crashed: signal 11"},
                                       {"close", "it closed the worker's socket"},
                                       {"status", "ogc_activation returned 5 instead of 0"}}));
  INFO(how);
  CHECK(compare_broken(how, harmless).status == 0);
  const ProgramResult result = compare_broken(how, breaking);
  INFO(result.out << result.err);
  CHECK(result.status == 1);
  CHECK(contains(result.out, {"no answer: " + what, "gen=ladder.radius seed=1 index=1\n"}));
}

TEST_CASE("a plug-in that writes into the worker's socket is told so, and the judge goes on", "[agreement]") {
  const std::string socket = ": it wrote into the worker's socket, descriptor 3, which is not its own";
  const auto [how, what] = GENERATE(table<std::string, std::string>(
      {{"zeros", "its worker sent a message that does not begin as its messages do"},
       {"three bytes", "its worker sent a message that does not begin as its messages do"},
       {"garbage", "its worker sent a message that does not begin as its messages do"},
       {"absurd length", "its worker sent a message that is 4611686018427387904 bytes long instead of "},
       {"empty message", "its worker sent a message that is 0 bytes long instead of "},
       {"no message behind its head", "its worker sent a message that holds 103 as the outcome of a call"}}));
  const ProgramResult result = compare_broken(how, "activation --generator ladder.radius --cases 400");
  INFO(how << "\n" << result.out << result.err);
  CHECK(result.status == 1);
  CHECK(contains(result.out, {"no answer: " + what, socket, "gen=ladder.radius seed=1 index=1\n", "3 mismatches"}));
}

TEST_CASE("a plug-in that ends in the middle of a message is told how it ended", "[agreement]") {
  const ProgramResult result = compare_broken("half a message", breaking);
  INFO(result.out << result.err);
  CHECK(result.status == 1);
  CHECK(contains(result.out, {"no answer: it ended the process, exit status 0"}));
}

TEST_CASE("a plug-in that forks gets its verdict, and no child of it is left", "[agreement]") {
  const auto [how, status, what] = GENERATE(table<std::string, int, std::string>(
      {{"fork", 0, "activation: passed"},
       {"fork, both return", 0, "activation: passed"},
       {"fork, child exits", 0, "activation: passed"},
       {"fork, child writes", 0, "activation: passed"},
       {"fork, parent exits", 1, "no answer: it ended the process, exit status 5"},
       {"fork, parent crashes", 1, "no answer: it crashed: signal 6"},
       {"fork while loading", 0, "activation: passed"},
       {"clone", 0, "activation: passed"},
       {"clone, both return", 0, "activation: passed"},
       {"clone, child writes", 1, "no answer: its worker sent a message that does not begin as its messages do"},
       {"clone, parent exits", 1, "no answer: it ended the process, exit status 5"}}));
  std::filesystem::remove(broken_folder() / "child");
  const ProgramResult result = compare_broken(how, breaking);
  INFO(how << "\n" << result.out << result.err);
  CHECK(result.status == status);
  CHECK(contains(result.out, {what}));
  CHECK(has_ended(broken_folder() / "child"));
}

TEST_CASE("the case at which a plug-in crashes is found in its batch, and the cases before it are judged",
          "[agreement]") {
  const ProgramResult result = compare_broken("behind", "activation --generator ladder.radius --cases 400 --json");
  INFO(result.out << result.err);
  REQUIRE(result.status == 1);
  const auto json = nlohmann::json::parse(result.out);
  const auto& stage = json.at("stages").at(0);
  REQUIRE(stage.at("listed").size() == 3);  // failures_allowed; only cases with d = r
  CHECK(stage.at("mismatches") == 3);
  CHECK(stage.at("listed").at(0).at("problem") == "stage=activation gen=ladder.radius seed=1 index=1");
  CHECK(stage.at("cases") > 3);
  CHECK(json.at("saved").size() == 3);
}

TEST_CASE("what a plug-in leaves unwritten or answers with NaN is a mismatch and is named", "[agreement]") {
  const ProgramResult nan = compare_broken("nan", breaking);
  CHECK(nan.status == 1);
  CHECK(contains(nan.out, {"broken returned NaN: 1 element of activation.slope"}));
  const ProgramResult unwritten = compare_broken("unwritten", breaking);
  CHECK(unwritten.status == 1);
  CHECK(contains(unwritten.out, {"broken left unwritten: 1 element of activation.energy"}));
}

TEST_CASE("lists of contacts that a plug-in miscounts or does not write are no answers", "[agreement]") {
  const std::string facet = "--problem 'stage=detect_vertex_facet gen=lattice seed=3 index=402'",
                    edge = "--problem 'stage=detect_edge_edge gen=ladder.stack seed=3 index=16'";
  CHECK(contains(compare_broken("no count", facet).out, {"no answer: it did not set the count of contacts"}));
  CHECK(contains(compare_broken("growing", facet).out, {"and, given room for as many, "}));
  CHECK(contains(compare_broken("absurd count", facet).out,
                 {"no answer: it counted 1152921504606846976 contacts, at most ", " being possible"}));
  CHECK(contains(compare_broken("wild contact", facet).out, {"is missing"}));
  CHECK(contains(compare_broken("few", facet).out, {"it counted 3 contacts, and did not write all of them"}));
  CHECK(contains(compare_broken("", edge).out, {"a contact names a face of kind 7"}));
  CHECK(contains(compare_broken("", facet).out, {"is missing"}));  // the list is empty, and well formed
}

TEST_CASE(
    "a library that is no plug-in for this program is refused with exit status 2, and one that breaks while it is "
    "loaded with 1",
    "[agreement]") {
  const auto refuses = [](const std::string& library, const std::string& stage, const std::string& what) {
    const ProgramResult result = run_ogc("compare " + stage + " --cases 10 --plugin " + library);
    INFO(library << ": " << result.out << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {what}));
  };
  const std::string folder = OGC_TEST_PLUGINS;
  refuses("nowhere.so", "", "there is no such file");
  refuses(OGC_SOURCE_DIR "/README.md", "", "it can't be loaded");
  refuses(folder + "/libplugin_anything.so", "", "no function ogc_plugin");
  refuses(folder + "/libplugin_newer.so", "", "built for version 12");
  refuses(folder + "/libplugin_older.so", "",
          "built for version 10 of compare/plugin.h, and this program takes version 11");
  refuses(folder + "/libplugin_odd_memory.so", "", "asks for memory 9");
  refuses(folder + "/libplugin_empty.so", "", "no stage's function");
  refuses(broken, "bound", "no function ogc_bound; its stages: detect_vertex_facet, detect_edge_edge, activation");
  refuses(broken, "bond", "there is no stage 'bond'");
  const ProgramResult crash = compare_broken("crash while loading", harmless),
                      hang = compare_broken("hang while loading", harmless);
  CHECK(crash.status == 1);
  CHECK(contains(crash.err, {"it crashed: signal 6"}));
  CHECK(hang.status == 1);
  CHECK(contains(hang.err, {"it hangs"}));
  const ProgramResult garbage = compare_broken("garbage while loading", harmless);
  CHECK(garbage.status == 1);
  CHECK(contains(garbage.err, {"its worker sent a message that does not begin as its messages do"}));
}

TEST_CASE("our own planes, regions, tetrahedra, rest state, sweep and step pass as a plug-in, timed beside ours",
          "[agreement]") {
  const ProgramResult result = compare_ours("", "--cases 1000 --json");
  INFO(result.out << result.err);
  REQUIRE(result.status == 0);
  const auto json = nlohmann::json::parse(result.out);
  REQUIRE(json.at("stages").size() == 6);
  for (const auto& stage : json.at("stages")) {
    CHECK(stage.at("mismatches") == 0);
    CHECK(stage.at("cases") >= 1000);
  }
  for (const auto& times : json.at("plugin").at("times")) {
    CHECK(times.at("plugin_seconds") > 0);
    CHECK(times.at("our_seconds") > 0);
  }
}

TEST_CASE("wrong plug-ins of the stages with scenes are found, and each wrong answer is named", "[agreement]") {
  const auto [how, stage, what] = GENERATE(table<std::string, std::string, std::string>(
      {{"rest angle", "rest_state", "hinge 0: "},
       {"area not a number", "rest_state", "ours returned NaN: "},
       {"behind the list", "rest_state", "no answer: it wrote out of range: behind the end of `corner`"},
       {"short list", "rest_state", "no answer: it "},
       {"corner order", "tetrahedron", "force"},
       {"mass of a third", "rest_state --generator solid", "vertex "},
       {"behind the solids", "rest_state --generator solid",
        "no answer: it wrote out of range: behind the end of `solid_body`"},
       {"tetrahedra without colours", "step --generator solid", "colour: vertex "},
       {"one contact dropped", "sweep", " m from the exact position"},
       {"cut", "sweep", "cut: "},
       {"crash", "sweep", "no answer: it crashed: signal 6"},
       {"one iteration less", "step", "events: "},
       {"threshold", "step", " is due"},
       {"rounds ask alike", "step", " is due"},
       {"touching vertices stay", "step", "your answer equals `touching_vertices_stay`"},
       {"one detection too many", "step", "no answer: it counted "},
       {"no end", "step", "no answer: the contacts of detection 0 are said to end at -1"},
       {"odd event", "step", "no answer: event 0 is of kind 9"}}));
  const std::string cases = stage == "step" ? " --cases 6000" : " --cases 1500";
  const ProgramResult result = compare_ours(how, stage + cases);
  INFO(how << "\n" << result.out << result.err);
  CHECK(result.status == 1);
  CHECK(contains(result.out, {what}));
}

TEST_CASE("indices of a step that name nothing are wrong answers, and no more", "[agreement]") {
  const auto [how, what] = GENERATE(table<std::string, std::string>({{"wild colour", "has 1000000000"},
                                                                     {"negative colour", "colour: vertex 0 has -7"},
                                                                     {"wild contact", "1000000000"},
                                                                     {"wild edges", "1000000000"}}));
  const ProgramResult result = compare_ours(how, "step --generator onto --cases 40");
  INFO(how << "\n" << result.out << result.err);
  CHECK(result.status == 1);
  CHECK(contains(result.out, {what}));
}

TEST_CASE("a plug-in with the stage tetrahedron is asked about solids", "[agreement]") {
  const std::string stage = GENERATE("rest_state", "sweep", "step");
  const ProgramResult result = compare_ours("", stage + " --generator solid --cases 200 --json");
  INFO(result.out << result.err);
  CHECK(result.status == 0);
  CHECK(nlohmann::json::parse(result.out).at("stages").at(0).at("cases") >= 200);
}

TEST_CASE("a plug-in's planes are judged by what they hold, and it is asked to truncate by half-spaces",
          "[agreement]") {
  const auto [how, question, status, what] = GENERATE(table<std::string, std::string, int, std::string>(
      {{"", "truncate --generator regions", 0, "truncate: passed"},
       {"", "plane --generator solid", 0, "plane: passed"},
       {"all slide", "truncate --generator regions", 1, " m from where it slides, or its way ends"},
       {"normals turned", "plane --generator few", 1, " half-spaces that their vertex does not keep where it is"},
       {"plane of nobody", "plane --generator few", 1, "no answer: plane 0 is of vertex "},
       {"plane of no pair", "plane --generator few", 1, " and of a pair of kind 7"}}));
  const ProgramResult result = compare_ours(how, question + " --cases 400");
  INFO(how << "\n" << result.out << result.err);
  CHECK(result.status == status);
  CHECK(contains(result.out, {what}));
}

TEST_CASE("a sweep that hangs is ended", "[agreement]") {
  const ProgramResult result = compare_ours("hang", "--problem 'stage=sweep gen=few seed=1 index=0' --time-limit 1");
  INFO(result.out << result.err);
  CHECK(result.status == 1);
  CHECK(contains(result.out, {"no answer: it hangs"}));
}

TEST_CASE("our own volumes and their forces pass as a plug-in", "[agreement]") {
  const ProgramResult result = compare_ours("", "--cases 1000 --json", "our_volumes");
  INFO(result.out << result.err);
  REQUIRE(result.status == 0);
  const auto json = nlohmann::json::parse(result.out);
  REQUIRE(json.at("stages").size() == 2);
  for (const auto& stage : json.at("stages")) {
    CHECK(stage.at("mismatches") == 0);
    CHECK(stage.at("cases") >= 1000);
  }
}

TEST_CASE("wrong plug-ins of volumes are found", "[agreement]") {
  const auto [how, stage, what] = GENERATE(table<std::string, std::string, std::string>(
      {{"never inside", "volume_depth", "volume_depth: mismatch"},
       {"face of no kind", "volume_depth", "a contact names a face of kind 3"},
       {"no friction", "volume_force", "volume_force: mismatch"}}));
  const ProgramResult result = compare_ours(how, stage + " --cases 400", "our_volumes");
  INFO(how << "\n" << result.out << result.err);
  CHECK(result.status == 1);
  CHECK(contains(result.out, {what}));
}
