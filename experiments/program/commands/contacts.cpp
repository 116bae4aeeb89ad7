// `ogc contacts`: prints the contact sets and bounds of a mesh, to inspect them, to pass them to another program, or to
// compare engines.
#include <chrono>
#include <map>
#include <memory>

#include <tbb/task_arena.h>
#include <nlohmann/json.hpp>

#include "compare/oracle/audit.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/scene.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/contact_report.hpp"
#include "experiments/program/mesh_input.hpp"
#include "experiments/program/option_checks.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

namespace {

/// Default of r_q in multiples of r: the default of `detection_radius_cap`.
constexpr double default_query_ratio = 4;
/// Limits of r [m], equal to those of the setting `contact_radius`, and the upper limit of r_q [m].
constexpr double least_radius = 0x1p-20, most_radius = 0x1p20, most_query_radius = 0x1p30;
/// Default of r in edge lengths. In the paper's cloth scenes, r lies between a fifth of an edge (twist) and a whole
/// edge (large_radius_twist).
constexpr double default_radius_ratio = 0.2;

struct ContactsOptions {
  std::string mesh, engine = "exact";
  double contact_radius = 0, query_radius = 0;
  compare::MeshOptions taken;
  int threads = 0;
  FurtherSets further;
  bool schema = false, margins = true, squares = false;
};

/// Returns the numbers that vertices and triangles have in the file. The rest of the JSON numbers them from 0.
Json numbers_in_file(const MeshInput& input) {
  const compare::MeshSource& source = input.source;
  const auto listed = [&](const std::vector<compare::Index>& numbers, std::size_t count) {
    Json list = Json::array();
    for (std::size_t i = 0; i < count; ++i)
      list.push_back((numbers.empty() ? static_cast<compare::Index>(i) : numbers[i]) + source.first);
    return list;
  };
  Json json{{"face_in_file", listed(source.faces, input.mesh.triangles.size())}};
  if (source.shares_vertices) json["vertex_in_file"] = listed(source.vertices, input.mesh.positions.size());
  return json;
}

/// Throws compare::ResourceError if the engine is not available, before a large mesh is read in vain.
void expect_engine(const std::string& engine) {
  if (engine != "cuda") return;
  const fast::BackendInfo device = fast::backend_info(fast::Backend::cuda);
  if (!device.usable)
    throw compare::ResourceError("--engine cuda: " + device.description + ", or take --engine cpu or --engine exact");
}

void run_contacts(const ContactsOptions& options, const CommandContext& context) {
  if (options.schema) return print_result(contacts_schema());
  if (options.mesh.empty())
    throw compare::InputError("ogc contacts needs a mesh, or --schema; see ogc contacts --help");
  if (options.engine != "exact" && (options.further.ipc || options.further.sdf))
    throw compare::InputError("--ipc and --sdf are answered by the reference; take --engine exact");
  expect_engine(options.engine);
  const auto limit = limited_threads(options.threads);
  const MeshInput input = read_mesh_input(options.mesh, options.taken);
  const compare::Mesh& mesh = input.mesh;
  if (options.squares && (!context.json || options.engine != "exact"))
    throw compare::InputError("--squares adds to the JSON of the exact engine; give --json and --engine exact");
  const double contact_radius = options.contact_radius > 0 ? options.contact_radius
                                                           : default_radius_ratio * mean_edge_length(mesh);
  const double query_radius = options.query_radius > 0 ? options.query_radius : default_query_ratio * contact_radius;
  if (query_radius < contact_radius)
    throw compare::InputError("--query-radius " + number(query_radius) + " is below the contact radius " +
                              number(contact_radius) + "; give at least that");
  const std::map<std::string, Engine> engines{{"exact", Engine::exact}, {"cpu", Engine::cpu}, {"cuda", Engine::cuda}};
  const auto bounds_relaxation = static_cast<float>(compare::Settings{}.bounds_relaxation);
  const auto start = std::chrono::steady_clock::now();
  const ContactReport report = find_contacts(mesh, engines.at(options.engine), static_cast<float>(contact_radius),
                                             static_cast<float>(query_radius), bounds_relaxation, options.further);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::size_t intersections = compare::audit(report.topology, mesh.positions).count;
  if (intersections > 0)
    log_line("ogc: " + options.mesh + " intersects itself (" + counted(intersections, "pair") +
             ", see ogc audit): these bounds keep nothing apart");
  if (!context.json) return print_result(describe(report, input.names));
  Json head{{"format", "ogc contacts 2"},
            {"mesh", options.mesh},
            {"engine", options.engine},
            {"bounds_relaxation", bounds_relaxation},
            {"intersections", intersections},
            {"threads", options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency()},
            {"seconds", seconds}};
  head.update(numbers_in_file(input));
  if (options.squares) head.update(exact_squares(report, bounds_relaxation));
  print_json(head, report, options.margins);
}

}  // namespace

void add_contacts_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<ContactsOptions>();
  CLI::App* command = app.add_subcommand("contacts", "Contact sets, distances and conservative bounds of a mesh");
  command->add_option("MESH", options->mesh,
                      "A mesh file: .obj, .ply, .stl, .off, .gltf, .glb, .vtp, .vtu, .vtk, .msh or .mesh");
  add_mesh_options(*command, options->taken);
  command
      ->add_option("--radius", options->contact_radius,
                   "Contact radius r [m] (default: a fifth of the mean edge length)")
      ->check(real_number(least_radius, most_radius, "m"));
  command->add_option("--query-radius", options->query_radius, "Query radius r_q ≥ r [m] (default: 4 r)")
      ->check(real_number(least_radius, most_query_radius, "m"));
  command->add_option("--engine", options->engine, "The reference computes (exact), or the fast path on cpu or cuda")
      ->check(CLI::IsMember({"exact", "cpu", "cuda"}))
      ->capture_default_str();
  add_threads_option(*command, options->threads);
  command->add_flag("--ipc", options->further.ipc,
                    "With --engine exact: F_IPC (Eq. 3) is listed, too, from all pairs of vertices and triangles");
  command->add_flag("--sdf", options->further.sdf,
                    "With --engine exact: F_SDF (Eq. 4) is listed, too, from all pairs of vertices and triangles");
  command->add_flag("!--no-margins", options->margins,
                    "The JSON leaves out the margins of contacts, which make it several times as large");
  command->add_flag("--squares", options->squares,
                    "With --json: smallest distances and bounds come with their exact squares, as fractions [m²]");
  command->add_flag("--schema", options->schema, "Print the JSON Schema of --json");
  command->add_flag("--json", context.json,
                    "Print all contacts, sets by primitive, smallest distances and bounds as JSON on standard output");
  command->footer(
      "The exact engine's JSON has the signed margins of every contact to the boundaries of its blocks and the kind of "
      "every vertex besides;\n"
      "seconds is what contacts, distances and bounds took, without reading the mesh and the warning's audit.\n"
      "The schema says what each key means: experiments/contacts.md.\n"
      "Lengths are in metres; dust among coordinates is taken as 0, and they are rounded to single precision first.\n\n"
      "Examples:\n"
      "  ogc contacts shirt.obj --radius 0.002\n"
      "  ogc contacts shirt.ply --engine cpu --threads 8 --json > contacts.json");
  command->callback([options, &context] { run_contacts(*options, context); });
}

}  // namespace ogc::experiments
