// Tests the ledger of real runs: writing it changes no bit of the run, its parts add up, and it agrees with steps.csv
// and the frames.
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/files/bytes.hpp"
#include "compare/record/run_folder.hpp"
#include "compare/record/steps_csv.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::StepLedger;
using compare::StepMetrics;

namespace {

std::string hash_of(const std::filesystem::path& run) {
  return compare::RunReader(run).provenance().extra.at("final_hash");
}

void make(const std::filesystem::path& run, const std::string& arguments) {
  const ProgramResult result = run_ogc("run " + arguments + " --out " + run.string());
  INFO(arguments << "\n" << result.err);
  REQUIRE(result.status == 0);
}

std::string header_of(const std::filesystem::path& run) {
  const std::string text = compare::read_bytes(run / "steps.csv");
  return text.substr(0, text.find('\n') + 1);
}

/// Returns the sum of the absolute values of the energy's parts [J].
double size_of(const StepLedger& l) {
  return std::abs(l.energy_start) + std::abs(l.energy_guess) + std::abs(l.energy_detection) + std::abs(l.energy_sweep) +
         std::abs(l.energy_truncation) + std::abs(l.energy_commit);
}

double end_of(const StepLedger& l) {
  return l.energy_start + l.energy_guess + l.energy_detection + l.energy_sweep + l.energy_truncation;
}

}  // namespace

TEST_CASE("the option --ledger changes no bit, and without it steps.csv has the columns that it had", "[property]") {
  const TemporaryFolder folder;
  const std::string options = GENERATE("cloth_on_sphere --scale smoke --audit off",
                                       "twist --scale smoke --steps 20 --audit off --set bounds=planes");
  make(folder / "plain", options);
  make(folder / "with", options + " --ledger");
  CHECK(hash_of(folder / "plain") == hash_of(folder / "with"));
  CHECK(header_of(folder / "plain") == compare::step_header({}, {.convergence = true}));
  CHECK(header_of(folder / "with") == compare::step_header({}, {.convergence = true, .ledger = true}));
  for (const StepMetrics& row : compare::read_steps(folder / "plain").rows) CHECK(!row.ledger);
  const std::string manifest = compare::read_bytes(folder / "plain/run.json");
  CHECK(manifest.find("\"ledger\"") == std::string::npos);
}

// Energies are sums of about ten thousand terms in double precision; their rounding is below 10⁻¹¹ of their size. The
// momenta of the next step come from velocities that are rounded to 2⁻²⁴ of each coordinate.
TEST_CASE("the parts of a step add up to the start of the next, and to the energies and vertices of its end",
          "[property]") {
  const TemporaryFolder folder;
  const std::string bounds = GENERATE("ball", "planes"),
                    scene = GENERATE("cloth_on_sphere --scale smoke", OGC_SOURCE_DIR
                                     "/experiments/examples/solid_on_cloth/solid_on_cloth.json --steps 90");
  make(folder / "run", scene + " --ledger --audit off --set frame_steps=1 --set bounds=" + bounds);
  const std::vector<StepMetrics> rows = compare::read_steps(folder / "run").rows;
  const compare::RunReader reader(folder / "run");
  const std::vector<compare::Index> groups = rigid_groups(reader.scene());
  double taken = 0, contact = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    REQUIRE(rows[k].ledger);
    const StepLedger& l = *rows[k].ledger;
    INFO("step " << rows[k].step);
    const double energy = rows[k].kinetic_energy + rows[k].elastic_energy + rows[k].contact_energy +
                          rows[k].gravity_energy;
    // steps.csv adds the terms in single precision. The limit is a thousand times the rounding of that sum.
    CHECK(std::abs(end_of(l) - energy) < 1e-4 * size_of(l));
    CHECK(l.motion_taken <= l.motion_proposed * (1 + 1e-12) + 1e-12);
    CHECK(l.motion_taken_tangential <= l.motion_taken * (1 + 1e-12));
    CHECK(l.motion_taken_leaving + l.motion_taken_unpaired <= l.motion_taken * (1 + 1e-12));
    CHECK((l.motion_taken > 0 || l.energy_truncation == 0));
    CHECK(l.vertices_held <= l.vertices_still);
    CHECK(l.vertices_held <= static_cast<double>(rows[k].vertices_cut));
    const compare::Frame before = reader.frame(k), after = reader.frame(k + 1);
    double still = 0;
    for (std::size_t v = 0; v < groups.size(); ++v)
      still += groups[v] == -1 && before.positions[v] == after.positions[v];
    CHECK(l.vertices_still == still);
    taken += l.motion_taken, contact += rows[k].contact_energy;
    if (k + 1 == rows.size()) break;
    const StepLedger& next = *rows[k + 1].ledger;
    CHECK(std::abs(end_of(l) + l.energy_commit - next.energy_start) < 1e-11 * size_of(l));
    const auto momentum = [&](auto coordinate) {
      const double end = l.momentum_start.*coordinate + l.momentum_guess.*coordinate + l.momentum_sweep.*coordinate +
                         l.momentum_truncation.*coordinate;
      return std::abs(end - next.momentum_start.*coordinate);
    };
    // Σ m |v| ≤ √(2 Σ m · kinetic energy), and the mass of every scene here is below a kilogram.
    const double size = std::sqrt(2 * rows[k].kinetic_energy) * 0x1p-23;
    CHECK(momentum(&compare::Vec3::x) < size);
    CHECK(momentum(&compare::Vec3::y) < size);
    CHECK(momentum(&compare::Vec3::z) < size);
  }
  CHECK(contact > 0);
  CHECK((taken > 0 || bounds == "planes"));
}

// The cloth falls far from everything. So the guess contains the whole impulse of gravity, and truncation removes
// nothing.
TEST_CASE("in free fall truncation does nothing", "[property]") {
  const TemporaryFolder folder;
  make(folder / "run", "cloth_on_sphere --scale smoke --steps 3 --ledger --audit off");
  for (const StepMetrics& row : compare::read_steps(folder / "run").rows) {
    REQUIRE(row.vertices_cut == 0);
    CHECK(row.ledger->energy_truncation == 0);
    CHECK(row.ledger->motion_taken == 0);
    CHECK(row.ledger->vertices_held == 0);
    CHECK(row.ledger->momentum_truncation == compare::Vec3{});
    CHECK(row.ledger->momentum_guess.y < 0);
  }
}

TEST_CASE("a ledger is refused where there is none, and help teaches it", "[unit]") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& options, std::initializer_list<std::string> words) {
    const ProgramResult result = run_ogc("run twist --scale smoke " + options + " --out " + (folder / "run").string());
    INFO(options << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, words));
  };
  refused("--ledger --solver newton", {"--ledger", "--solver vbd"});
  refused("--ledger --solver ipc", {"--ledger", "--solver vbd"});
  refused("--ledger --set damping=per_vertex", {"per_vertex", "damping"});
  CHECK(contains(run_ogc("run --help").out, {"--ledger", "energy and momentum", "reference/ledger.md"}));
}
