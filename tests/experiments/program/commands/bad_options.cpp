// Tests bad numbers and paths. The message must be short and name the number or path, and the exit status must be 2. A
// crash, an internal error or a hang is a failure.
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "tests/catch.hpp"
#include "tests/compare/problem/renamed.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc::tests;

namespace fs = std::filesystem;

namespace {

/// Checks that the input is refused with exit status 2 and one short message that contains all of `parts`.
void check_refused(const std::string& arguments, std::initializer_list<std::string> parts,
                   const std::string& before = "") {
  constexpr std::size_t longest_message = 460;
  const ProgramResult result = run_ogc(arguments, before);
  INFO(before << "ogc " << arguments << "\n" << result.err);
  CHECK(result.status == 2);
  CHECK(contains(result.err, parts));
  CHECK(contains(result.err, {"ogc: "}));
  CHECK(!contains(result.err, {"internal error"}));
  CHECK(result.err.size() <= longest_message);
}

/// Returns the options of a command that take numbers, read from its help.
std::set<std::string> numeric_options(const std::string& command) {
  const std::string help = run_ogc(command + " --help").out;
  const std::regex option("\n *(--[a-z-]+) (?:INT|UINT|FLOAT)\\b");
  std::set<std::string> names;
  for (auto found = std::sregex_iterator(help.begin(), help.end(), option); found != std::sregex_iterator(); ++found)
    names.insert((*found)[1]);
  return names;
}

std::set<std::string> commands() {
  std::istringstream help(run_ogc("--help").out);
  std::set<std::string> names;
  std::string line;
  while (std::getline(help, line) && line != "Subcommands:") {}
  while (std::getline(help, line) && !line.empty() && line.starts_with("  "))
    if (line[2] != ' ') names.insert(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

struct Refusal {
  const char *command, *option, *range;
  std::vector<const char*> values;
};

}  // namespace

TEST_CASE("a number that an option can't take is refused by the option's name, the text and the legal range",
          "[unit]") {
  const std::vector<const char*> never{"nan", "inf", "-inf", "1e400", "-1", "five", "0x10", "1,5"};
  for (const auto& [command, option, range, values] : std::vector<Refusal>{
           {"contacts", "--radius", "9.5367431640625e-07 to 1048576 m", {"0", "1e20", "1e-46", "1e6000"}},
           {"contacts", "--query-radius", "9.5367431640625e-07 to 1073741824 m", {"0", "1e20", "1e-46"}},
           {"contacts", "--threads", "1 to 1024", {"0", "1e20", "1e-46", "100000", "1.5"}},
           {"run", "--threads", "1 to 1024", {"0", "1e20", "1e-46", "100000", "1.5"}},
           {"bench", "--threads", "1 to 1024", {"0", "100000"}},
           {"run", "--steps", "1 to 1073741824", {"0", "1e20", "99999999999999999999"}},
           {"run", "--checkpoint", "0 or from 0.001 to 86400 s", {"1e20", "1e-46", "100000"}},
           {"ablate", "--checkpoint", "0 or from 0.001 to 86400 s", {"1e20", "1e-46"}},
           {"compare", "--cases", "1 to 1000000000000", {"0", "1e20", "1.5"}},
           {"compare", "--seed", "0 to 18446744073709551615", {"1e20", "18446744073709551616"}},
           {"compare", "--time-limit", "1 to 3600", {"0", "3601"}},
           {"bench", "--repetitions", "1 to 1000000", {"0", "1e20"}},
           {"audit", "--limit", "0 to 1073741824", {"1e20", "2.5"}}}) {
    for (const char* value : never)
      check_refused(std::string(command) + " " + option + " " + value, {option, value, range, command});
    for (const char* value : values)
      check_refused(std::string(command) + " " + option + " " + value, {option, value, range, command});
  }
  check_refused("contacts --radius ''", {"--radius", "''"});
  check_refused("contacts --radius " + std::string(5000, '9'), {"--radius", "9999…"});
  check_refused("run --solver " + std::string(5000, 'x'), {"--solver", "xxxx…"});
}

// The options are read from the help, so that new options are tested, too.
TEST_CASE("no numeric option of any command takes what is no number, or none of this world", "[property]") {
  std::size_t asked = 0;
  const std::set<std::string> all = commands();
  CHECK(all.contains("run"));
  for (const std::string& command : all) {
    for (const std::string& option : numeric_options(command)) {
      ++asked;
      for (const char* value : {"nan", "inf", "-inf", "1e400", "1e20", "-1e20", "five", "1,5"})
        check_refused(command + " " + option + " " + value, {option, value});
    }
  }
  CHECK(asked >= 16);
}

TEST_CASE("the ends of the ranges of contacts are taken by every engine, and a plus sign, too", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("parallel.obj", parallel_triangles_obj).string();
  for (const char* engine : {"exact", "cpu"})
    for (const char* radii : {"--radius 1048576", "--radius +1e-6 --query-radius 1073741824",
                              "--radius 9.5367431640625e-07 --threads 1024"}) {
      const ProgramResult result = run_ogc("contacts " + mesh + " --engine " + engine + " " + radii);
      INFO(radii << result.err);
      CHECK(result.status == 0);
    }
}

TEST_CASE("a range of steps that is none is refused by its option and text", "[unit]") {
  for (const char* value : {"5", "0:4", "7:3", "1:", ":3", "1:2:3", "one:two", "1:99999999999999999999", "on"})
    check_refused("run twist --scale smoke --audit-meetings " + std::string(value),
                  {"--audit-meetings", value, "as in 40:139", "or off"});
}

TEST_CASE("a setting that a scene can't have is refused by name with its range and what it means", "[unit]") {
  for (const char* value : {"nan", "inf", "0", "1e20", "1e-46"})
    check_refused("run twist --scale smoke --set contact_radius=" + std::string(value),
                  {"contact_radius", value, "1048576 m", "push each other apart"});
  check_refused("run twist --scale smoke --set newton_tolerance=1e-46",
                {"newton_tolerance", "1e-46", "0, or 1.401298464324817e-45 to 1"});
  check_refused("run twist --scale smoke --set membrane=stvk",
                {"stvk", "did you mean 'st_venant_kirchhoff'?", "none", "stable_neo_hookean"});
  check_refused("run yarn_stretch --scale smoke --set rod_orientation=published",
                {"rod_orientation", "exact", "as_published"});
  check_refused("run yarn_stretch --scale smoke --set rod_start=0", {"rod_start", "turned", "kept"});
  for (const Renamed& setting : renamed_settings)
    check_refused("run twist --scale smoke --set " + std::string(setting.before) + "=1", {setting.refusal()});
  check_refused("run twist --scale smoke --solver admm", {"--solver", "admm", "vbd", "newton", "ipc", "penalty"});
  CHECK(!contains(run_ogc("run --help").out, {"admm"}));
  const ProgramResult unknown = run_ogc("run twist --scale smoke --set h=0.01");
  CHECK(unknown.status == 2);
  const std::string first =
      "unknown setting 'h'; there are: membrane, bending, body_contact, contact_stiffness, friction, "
      "solid_density, solid_mu, solid_lambda, solid_damping, solid_young, solid_poisson, "
      "time_step";
  CHECK(contains(unknown.err, {first, "ipc_iterations", "seed"}));
  check_refused("run twist --scale smoke --set solid_young=1e5",
                {"--set solid_young belongs to bodies with tetrahedra, and scene 'twist' has none", ".msh"});
  check_refused("run mat_twist --scale smoke --set solid_poisson=0.5",
                {"solid_poisson", "'0.5'", "to 0.4999", "Poisson's ratio"});
  check_refused("run mat_twist --scale smoke --set solid_young=-1", {"solid_young", "'-1'", "Young's modulus"});
  check_refused("run mat_twist --scale smoke --set friction=much", {"friction", "'much'", "to 1024"});
}

TEST_CASE("JSON that nests a hundred thousand levels is refused wherever JSON is read", "[unit]") {
  const TemporaryFolder folder;
  const std::string deep(100000, '['), file = folder
                                                  .write("deep.json", "{\"format_version\": 1, \"bodies\": " + deep +
                                                                          std::string(deep.size(), ']') + "}")
                                                  .string();
  fs::create_directories(folder / "run");
  fs::copy_file(file, folder / "run/run.json");
  for (const std::string& arguments :
       {"run " + file, "compare --replay " + file, "bench --against " + file + " --results " + file,
        "audit " + (folder / "run").string()})
    check_refused(arguments, {".json", "more than 64 levels"});
  check_refused("run " + folder.write("open.json", deep).string(), {"open.json", "more than 64 levels"});
  check_refused("run " + folder.write("long.json", "{\"format_version\": 1" + std::string(400, '0') + "}").string(),
                {"long.json"});
}

TEST_CASE("a pipe in the place of a file is refused by name, without a wait", "[unit]") {
  const TemporaryFolder folder;
  for (const char* name : {"pipe.obj", "pipe.ply", "pipe.json", "pipe.h5", "pipe.npz"})
    REQUIRE(::mkfifo((folder / name).c_str(), 0600) == 0);
  const auto in = [&](const char* name) { return (folder / name).string(); };
  for (const std::string& arguments :
       {"contacts " + in("pipe.obj"), "audit " + in("pipe.ply"), "run " + in("pipe.json"),
        "run twist --scale smoke --from-state " + in("pipe.h5"), "compare --batch " + in("pipe.json"),
        "compare --replay " + in("pipe.h5"), "compare --replay " + in("pipe.json"),
        "bench --against " + in("pipe.json"), "audit " + in("pipe.npz")})
    check_refused(arguments, {"pipe.", "is a pipe or a device", "save its content"}, "timeout 20 ");
}

TEST_CASE("links in a circle, names that are too long and a file in a folder's place are refused by path and reason",
          "[unit]") {
  const TemporaryFolder folder;
  fs::create_symlink(folder / "b.obj", folder / "a.obj");
  fs::create_symlink(folder / "a.obj", folder / "b.obj");
  const std::string loop = (folder / "a.obj").string(), name(300, 'x'), file = folder.write("file", "").string();
  for (const std::string command : {"contacts ", "audit "})
    check_refused(command + loop, {"a.obj", "links lead in a circle"});
  check_refused("export " + loop, {"a.obj", "symbolic links"});
  const std::string run = "run cloth_on_sphere --scale smoke --steps 1 --audit off --out ";
  for (const std::string& arguments : {run + loop, "scenes twist --scale smoke --write " + loop})
    check_refused(arguments, {"a.obj", "symbolic links"});
  const std::string report = "compare truncate --cases 10 --report ", drawings = "illustrate fig07 --out ";
  for (const std::string& command : {run, std::string("scenes twist --scale smoke --write "), report, drawings}) {
    check_refused(command + (folder / name).string(), {"xxxx", "too long", "choose a shorter name"});
    check_refused(command + file + "/below", {"file", "Not a directory"});
  }
  for (const std::string command : {"contacts ", "audit "})
    check_refused(command + name + ".obj", {"xxxx", "too long"});
}

TEST_CASE("a folder that the user may not write to is refused by path and reason, before anything is computed",
          "[unit]") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "closed");
  fs::permissions(folder / "closed",
                  fs::perms::owner_read | fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec);
  // Root may write everywhere, so the program runs as another user.
  const std::string as_user = ::geteuid() == 0 ? "setpriv --reuid 65534 --regid 65534 --clear-groups " : "";
  if (run_ogc("--version", as_user).status != 0) {
    WARN("this program can't be run as another user here: not tested");
    return;
  }
  const std::string there = (folder / "closed").string();
  for (const std::string& command :
       {std::string("run knot --scale paper --out "), std::string("scenes twist --scale smoke --write "),
        std::string("compare truncate --cases 10 --report "), std::string("illustrate fig07 --out ")})
    for (const char* below : {"", "/new", "/new/below"})
      check_refused(command + there + below, {"closed", "Permission denied", "may write to"}, as_user);
}

TEST_CASE("contacts and audit list as many as asked, count all and say how long it took", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("crossing.obj", crossing_triangles_obj).string();
  const ProgramResult one = run_ogc("audit --json --limit 1 " + mesh), none = run_ogc("audit --limit 0 " + mesh);
  CHECK(one.status == 1);
  CHECK(contains(one.out, {"\"intersections\": 2", "\"count\":2", "\"edge\":3"}));
  CHECK(!contains(one.out, {"\"edge\":4,\"edge_vertices\""}));
  CHECK(contains(none.out, {"and 2 more", "2 intersections"}));
  const ProgramResult contacts = run_ogc("contacts --json --engine cpu --threads 1 " + mesh);
  CHECK(contacts.status == 0);
  CHECK(contains(contacts.out, {"\"threads\": 1", "\"seconds\": "}));
}

TEST_CASE("without a usable device contacts advises an option that it has", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("parallel.obj", parallel_triangles_obj).string();
  const ProgramResult result = run_ogc("contacts --engine cuda " + mesh, "CUDA_VISIBLE_DEVICES= ");
  INFO(result.err);
  CHECK(result.status == 3);
  CHECK(contains(result.err, {"--engine cuda", "CUDA", "--engine cpu"}));
  CHECK(!contains(result.err, {"--backend"}));
  CHECK(run_ogc("contacts --engine cpu " + mesh).status == 0);
}
