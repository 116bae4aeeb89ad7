// `ogc audit`: checks exactly whether anything intersects in a mesh, or in each frame of a run, from any program.
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <nlohmann/json.hpp>

#include "compare/files/scenes/scene_files.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/validate_mesh.hpp"
#include "experiments/program/audits/audit_source.hpp"
#include "experiments/program/audits/between.hpp"
#include "experiments/program/audits/box_audit.hpp"

#include "experiments/program/audits/offenders.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/interrupt.hpp"
#include "experiments/program/mesh_input.hpp"
#include "experiments/program/option_checks.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/progress.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

namespace {

using compare::SmallestDistances;

struct AuditOptions {
  AuditRequest request;
  std::string show;               ///< folder of the .vtp files; empty: none
  std::optional<double> deepest;  ///< depth inside a volume above which a state fails [m]; empty: no limit
  bool between = false;           ///< also check the straight motions between states
  BoxRequest boxes;               ///< count 0: whole states are audited
  std::string engine = "cpu";     ///< finds the contacts of the state that is audited in boxes
};

/// Largest number of states for which --show writes a file. Further states would show much the same.
constexpr std::size_t most_shown = 8;

struct State {
  std::string name;  ///< "step 12", "frame 3", or the mesh's file
  Json json;
  std::string text;
  std::size_t count = 0;
  bool has_triangles = true;
  std::size_t loose_edges = 0;  ///< edges that belong to no triangle
  SmallestDistances distances;
  std::optional<compare::VolumePenetration> volumes;
  std::string in_volumes;
  std::string doubt{};  ///< findings that the rounding of the file's numbers may have caused, in words
};

Json to_json(const SmallestDistances& distances, const compare::Topology& topology,
             const compare::ElementNames& names) {
  Json json{{"vertex_triangle", nullptr}, {"edge_edge", nullptr}};
  if (distances.vertex >= 0) {
    const compare::Triangle& corners = topology.triangles[static_cast<std::size_t>(distances.triangle)];
    json["vertex_triangle"] = {
        {"distance", distances.vertex_triangle},
        {"vertex", distances.vertex},
        {"triangle", distances.triangle},
        {"triangle_vertices", corners},
        {"names", {names.vertex(distances.vertex), names.triangle(distances.triangle, corners)}}};
  }
  if (distances.edge >= 0) {
    const auto vertices = [&](compare::Index e) { return topology.edges[static_cast<std::size_t>(e)]; };
    json["edge_edge"] = {{"distance", distances.edge_edge},
                         {"edge", distances.edge},
                         {"edge_vertices", vertices(distances.edge)},
                         {"other_edge", distances.other_edge},
                         {"other_edge_vertices", vertices(distances.other_edge)},
                         {"names", {names.edge(vertices(distances.edge)), names.edge(vertices(distances.other_edge))}}};
  }
  return json;
}

const char* name_of(compare::IntersectionKind kind) {
  switch (kind) {
    case compare::IntersectionKind::edge_triangle: return "edge_triangle";
    case compare::IntersectionKind::vertex_triangle: return "vertex_triangle";
    case compare::IntersectionKind::edge_edge: return "edge_edge";
  }
  return "";
}

/// Returns the pairs of vertices of intersecting faces in the format of a scene file's excluded pairs. A mesh counts as
/// one body with the name that `ogc run MESH` uses.
Json excluded_json(const AuditedState& audited, const compare::Scene* scene) {
  std::vector<compare::Edge> pairs = vertex_pairs(audited.result, *audited.topology);
  if (scene != nullptr) {
    const std::vector<compare::Index> owner = body_of_vertex(*scene);
    const auto body_of = [&](compare::Index v) { return owner[static_cast<std::size_t>(v)]; };
    std::ranges::stable_sort(pairs, {},
                             [&](const compare::Edge& e) { return std::pair(body_of(e[0]), body_of(e[1])); });
    return compare::excluded_pairs_json(scene->bodies, pairs);
  }
  const compare::Body body{
      .name = audited.is_solid ? "solid" : "cloth", .vertex_count = audited.topology->vertex_count, .material = {}};
  return compare::excluded_pairs_json({&body, 1}, pairs);
}

State state_of(const AuditedState& audited, const compare::Scene* scene) {
  const compare::Topology& topology = *audited.topology;
  State state{.name = audited.name,
              .json = {{"state", audited.name}, {"count", audited.result.count}, {"intersections", Json::array()}},
              .text = audited.text,
              .count = audited.result.count,
              .has_triangles = !topology.triangles.empty(),
              .distances = audited.distances,
              .volumes = audited.volumes,
              .in_volumes = audited.in_volumes};
  if (audited.volumes)
    state.json["volumes"] = {{"vertices_inside", audited.volumes->vertices_inside},
                             {"deepest", audited.volumes->deepest},
                             {"edges_meeting", audited.volumes->edges_meeting}};
  for (std::size_t e = 0; e < topology.edges.size(); ++e) state.loose_edges += topology.edge_triangles[e].empty();
  if (audited.doubt) {
    state.json["printed"] = to_json(*audited.doubt);
    state.doubt = describe(*audited.doubt, audited.name);
  }
  state.json["smallest_distances"] = to_json(audited.distances, topology, audited.names);
  if (audited.result.count > 0) state.json["excluded_pairs"] = excluded_json(audited, scene);
  for (const compare::Intersection& pair : audited.result.intersections) {
    const auto first = static_cast<std::size_t>(pair.first), second = static_cast<std::size_t>(pair.second);
    Json entry{{"kind", name_of(pair.kind)}};
    if (pair.kind == compare::IntersectionKind::vertex_triangle) {
      entry["vertex"] = pair.first;
    } else {
      entry["edge"] = pair.first;
      entry["edge_vertices"] = topology.edges[first];
    }
    if (pair.kind == compare::IntersectionKind::edge_edge) {
      entry["other_edge"] = pair.second;
      entry["other_edge_vertices"] = topology.edges[second];
    } else {
      entry["triangle"] = pair.second;
      entry["triangle_vertices"] = topology.triangles[second];
    }
    entry["text"] = describe(pair, topology, audited.names);
    state.json["intersections"].push_back(entry);
  }
  return state;
}

/// Holds all audits up to the end, an interruption, or a state that can't be read.
struct Audits {
  std::vector<State> states;
  std::vector<std::string> shown;   ///< one line for each file that --show wrote
  std::optional<WaysBetween> ways;  ///< empty without --between
  std::string proof_of_ways;        ///< AuditSource::proof_of_ways
  std::size_t planned = 0;
  std::string stopped;  ///< why the remaining states can't be read; empty if all were read
};

/// Holds a state from its reading to its report, or the reason why it can't be read.
struct Item {
  std::optional<AuditedState> state;
  std::string problem;
  bool judged = false;
};
using Handle = std::shared_ptr<Item>;

/// Reads the states one after the other, up to the end, an interruption, or a state that can't be read.
class Reading {
 public:
  explicit Reading(AuditSource& source) : source_(source) {}
  Handle operator()(tbb::flow_control& control) {
    if (next_ == source_.size() || failed_ || interrupted()) {
      control.stop();
      return nullptr;
    }
    auto item = std::make_shared<Item>();
    try {
      item->state = source_.next();
    } catch (const compare::InputError& error) {
      if (next_ == 0) throw;
      failed_ = true;
      item->problem = error.what();
    }
    ++next_;
    return item;
  }

 private:
  AuditSource& source_;
  std::size_t next_ = 0;
  bool failed_ = false;
};

/// Judges as many states in parallel as there are threads, because a single thread does most of the work on a state.
/// Motions between states are checked one after the other, each by all threads.
Audits audit_all(AuditSource& source, const AuditOptions& options) {
  const std::string& show = options.show;
  Audits audits;
  audits.planned = source.size();
  audits.proof_of_ways = source.proof_of_ways();
  if (options.between) audits.ways.emplace(source, options.request.limit);
  catch_interrupts();
  Progress progress(0, static_cast<std::int64_t>(source.size()), "frame");
  Reading reading(source);
  const auto judge = [&](const Handle& item) {
    // After an interruption no further state is judged, because a large state takes a minute.
    if (!item->state || interrupted()) return item;
    source.judge(*item->state);
    item->judged = true;
    return item;
  };
  const auto keep = [&](const Handle& item) {
    if (!item->state) {
      audits.stopped = item->problem;
      return;
    }
    if (!item->judged || !audits.stopped.empty()) return;
    const AuditedState& audited = *item->state;
    try {
      if (audits.ways) audits.ways->look_at(audited);
    } catch (const compare::InputError& error) {
      audits.stopped = error.what();
      return;
    }
    audits.states.push_back(state_of(audited, source.scene()));
    if (!show.empty() && audited.result.count > 0 && audits.shown.size() < most_shown)
      audits.shown.push_back(show_offenders(show, audited.name, audited.result, *audited.topology, audited.positions));
    if (source.size() > 1)
      progress.show(static_cast<std::int64_t>(audits.states.size()), counted(audited.result.count, "intersection"));
  };
  const auto together = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  tbb::parallel_pipeline(together,
                         tbb::make_filter<void, Handle>(tbb::filter_mode::serial_in_order, std::ref(reading)) &
                             tbb::make_filter<Handle, Handle>(tbb::filter_mode::parallel, judge) &
                             tbb::make_filter<Handle, void>(tbb::filter_mode::serial_in_order, keep));
  return audits;
}

/// Returns the smallest distances over all states in words. If distances are equal, the first state is named.
std::string describe_distances(const std::vector<State>& states) {
  const auto describe_pair = [&](const std::string& what, const State& state, const char* key) {
    const Json& pair = state.json.at("smallest_distances").at(key);
    const std::string beginning = "smallest distance of " + what + ": ";
    if (pair.is_null()) return beginning + "there is no such pair\n";
    return beginning + number(pair.at("distance").get<double>(), 9) + " m, " +
           pair.at("names").at(0).get<std::string>() + " and " + pair.at("names").at(1).get<std::string>() +
           (states.size() == 1 ? "" : ", " + state.name) + "\n";
  };
  const auto& facet = *std::ranges::min_element(states, {},
                                                [](const State& state) { return state.distances.vertex_triangle; });
  const auto& edges = *std::ranges::min_element(states, {},
                                                [](const State& state) { return state.distances.edge_edge; });
  return describe_pair("a vertex to a triangle without it", facet, "vertex_triangle") +
         describe_pair("two edges without a common vertex", edges, "edge_edge");
}

/// Warns that nothing was checked between the states, because two states prove nothing about the motion between them
/// (method.md §5.5).
std::string unseen_ways(const Audits& audits) {
  if (audits.states.size() < 2 || audits.ways) return "";
  return "what happened between these states was not looked at: surfaces may have passed through each other there; " +
         audits.proof_of_ways + "--between asks the straight ways";
}

/// Warns that two states do not show whether curves passed through each other between them.
std::string unseen_curves(const std::vector<State>& states) {
  const auto has = std::ranges::find_if(states, [](const State& state) { return state.loose_edges > 0; });
  if (has == states.end()) return "";
  const std::string edges = counted(has->loose_edges, "edge") + " without a triangle";
  if (!has->has_triangles)
    return edges +
           " and nothing else: that no two of them touch in a state proves nothing about the way to it; they may have "
           "passed through each other. Only the motion tells: ask it while the run goes on (ogc run --audit-meetings)";
  return "of " + edges +
         ", whether they touch is seen, but not whether they passed through each other on the way (ogc run "
         "--audit-meetings)";
}

/// Describes the first state with findings that the rounding of printed coordinates may have caused, and counts the
/// further states with such findings. Empty if no state has any.
std::string in_doubt(const std::vector<State>& states) {
  const auto has = [](const State& state) { return !state.doubt.empty(); };
  const auto first = std::ranges::find_if(states, has);
  if (first == states.end()) return "";
  const auto others = static_cast<std::size_t>(std::ranges::count_if(states, has)) - 1;
  return first->doubt + (others == 0 ? "" : " (likewise " + counted(others, "further state") + ")");
}

/// Names the state with the most vertices inside volumes and the state with the deepest vertex; empty without volumes.
std::string describe_volumes(const std::vector<State>& states) {
  std::string text;
  const State *fullest = nullptr, *deepest = nullptr;
  for (const State& state : states) {
    if (!state.volumes) continue;
    if (fullest == nullptr || state.volumes->vertices_inside > fullest->volumes->vertices_inside) fullest = &state;
    if (deepest == nullptr || state.volumes->deepest > deepest->volumes->deepest) deepest = &state;
  }
  if (fullest == nullptr) return text;
  text = "most inside, " + fullest->name + ": " + fullest->in_volumes + "\n";
  if (deepest != fullest) text += "deepest, " + deepest->name + ": " + deepest->in_volumes + "\n";
  return text;
}

struct Totals {
  std::size_t intersections = 0, intersecting = 0;
  double deepest = 0;         ///< largest depth inside a volume over all states [m]
  std::string first;          ///< name of the first intersecting state
  bool says_nothing = false;  ///< no state has a triangle
};

Totals totals_of(const std::vector<State>& states) {
  Totals totals;
  for (const State& state : states) {
    totals.intersections += state.count;
    if (state.volumes) totals.deepest = std::max(totals.deepest, state.volumes->deepest);
    if (state.count > 0 && totals.intersecting++ == 0) totals.first = state.name;
  }
  totals.says_nothing = std::ranges::none_of(states, &State::has_triangles);
  return totals;
}

/// Returns one warning for each kind of event that the audit could not see.
std::vector<std::string> unseen(const Audits& audits) {
  std::vector<std::string> lines;
  for (std::string line : {unseen_ways(audits), audits.ways ? "" : unseen_curves(audits.states)})
    if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

std::string headline(const Audits& audits, const Totals& totals) {
  const std::string states = counted(audits.states.size(), "state");
  std::string text = totals.says_nothing
                         ? states + " audited exactly, " +
                               (totals.intersections > 0 ? counted(totals.intersections, "intersection")
                                                         : "no two curves touch")
                         : states + " audited exactly, " + counted(totals.intersections, "intersection");
  if (totals.intersecting > 0 && audits.planned > 1)
    text += " in " + counted(totals.intersecting, "state") + ", the first: " + totals.first;
  if (audits.ways) text += "; " + audits.ways->headline();
  return text + (interrupted() ? "; interrupted, the rest was not looked at" : "") + "\n";
}

void print(const Audits& audits, const Totals& totals, const std::string& left_out) {
  std::string text;
  for (const State& state : audits.states)
    if (state.count > 0) text += state.name + ": " + counted(state.count, "intersection") + "\n" + state.text + "\n";
  for (const Way& way : audits.ways ? audits.ways->ways() : std::vector<Way>())
    if (way.found.count > 0)
      text += "from " + way.from + " to " + way.to + ": " + counted(way.found.count, "meeting") + "\n" + way.text +
              "\n";
  text += headline(audits, totals);
  if (!audits.stopped.empty())
    text += counted(audits.planned - audits.states.size(), "further state") + " not audited: one can't be read\n";
  for (const std::string& line : unseen(audits)) text += line + "\n";
  if (const std::string note = in_doubt(audits.states); !note.empty()) text += note + "\n";
  if (!left_out.empty()) text += "left out: " + left_out + "\n";
  for (const std::string& line : audits.shown) text += line + "\n";
  text += describe_volumes(audits.states);
  print_result(text + (audits.states.empty() ? "" : describe_distances(audits.states)));
}

void print_json(const AuditOptions& options, const Audits& audits, const Totals& totals, const std::string& left_out) {
  const auto& paths = options.request.paths;
  Json json{{"audited", paths.size() == 1 ? Json(paths.front()) : Json(paths)}, {"states", Json::array()}};
  for (const State& state : audits.states) json["states"].push_back(state.json);
  json["intersections"] = totals.intersections;
  json["intersecting_states"] = totals.intersecting;
  json["first_intersecting"] = totals.first.empty() ? Json(nullptr) : Json(totals.first);
  json["clean"] = totals.says_nothing && totals.intersections == 0 ? Json(nullptr) : Json(totals.intersections == 0);
  json["complete"] = !interrupted() && audits.stopped.empty();
  if (!audits.stopped.empty()) json["stopped"] = audits.stopped;
  if (const std::vector<std::string> lines = unseen(audits); !lines.empty()) json["unseen"] = lines;
  if (audits.ways) {
    json["meetings"] = audits.ways->meetings();
    json["ways"] = Json::array();
    for (const Way& way : audits.ways->ways()) json["ways"].push_back(way.json);
  }
  if (const std::string note = in_doubt(audits.states); !note.empty()) json["in_doubt"] = note;
  if (!left_out.empty()) json["left_out"] = left_out;
  if (!options.show.empty()) json["shown"] = audits.shown;
  print_result(json);
}

Json to_json(const BoxFindings& found, const std::string& state, const AuditOptions& options) {
  return {{"audited", options.request.paths.front()},
          {"state", state},
          {"engine", options.engine},
          {"seed", options.boxes.seed},
          {"cells", found.cells},
          {"boxes", found.boxes},
          {"densest_boxes", found.densest},
          {"side", found.side},
          {"contacts_of_densest_box", found.most_contacts},
          {"contacts_of_last_of_densest", found.least_of_densest},
          {"vertices", found.vertices},
          {"triangles", found.triangles},
          {"pairs_tested", found.pairs_tested},
          {"intersections", found.intersections},
          {"contacts", found.contacts},
          {"missing", found.missing},
          {"extra", found.extra},
          {"grey", found.grey},
          {"first", found.first}};
}

std::string describe(const BoxFindings& found, const std::string& state, const AuditOptions& options) {
  const std::string differences = counted(found.missing, "missing contact") + ", " + counted(found.extra, "contact") +
                                  " too many, " + counted(found.grey, "accepted difference");
  return state + " audited in " + std::to_string(found.boxes) + " boxes of " + number(found.side) + " m among " +
         std::to_string(found.cells) + " that contain a vertex: the " + std::to_string(found.densest) +
         " with most contacts (" + std::to_string(found.most_contacts) + " to " +
         std::to_string(found.least_of_densest) + "), the others drawn with seed " +
         std::to_string(options.boxes.seed) + "\n" + std::to_string(found.vertices) + " vertices, " +
         counted(found.triangles, "triangle") + ", " + counted(found.pairs_tested, "pair") +
         " tested exactly: " + counted(found.intersections, "intersection") + "\n" +
         counted(found.contacts, "exact contact") + " beside those of " + options.engine + ": " + differences + "\n" +
         (found.first.empty() ? "" : "the first: " + found.first + "\n");
}

/// Audits the last state of a run in boxes.
int run_box_audit(AuditSource& source, const AuditOptions& options, const CommandContext& context) {
  const compare::Scene* scene = source.scene();
  if (scene == nullptr)
    throw compare::InputError("--boxes needs the contact radius of a run; give a run folder, not a mesh");
  AuditedState state;
  for (std::size_t i = 0; i < source.size(); ++i) state = source.next();
  const auto radius = static_cast<float>(scene->settings.contact_radius);
  const std::vector<compare::Vec3f> positions = compare::to_single(state.positions);
  const compare::DetectIn in{state.topology.get(), source.exclusions(), positions, radius, radius};
  const compare::Contestant engine = fast::contestant(options.engine == "cuda" ? fast::Backend::cuda
                                                                               : fast::Backend::cpu);
  const FoundContacts contacts{engine.detect_vertex_facet(in).contacts, engine.detect_edge_edge(in).contacts};
  const BoxFindings found = audit_boxes(*state.topology, positions, source.exclusions(), contacts, radius,
                                        options.boxes);
  if (context.json) {
    print_result(to_json(found, state.name, options));
  } else {
    print_result(describe(found, state.name, options));
  }
  const bool is_clean = found.intersections + found.missing + found.extra == 0;
  return is_clean ? static_cast<int>(exit_success) : static_cast<int>(exit_check_failed);
}

int run_audit(const AuditOptions& options, const CommandContext& context) {
  const std::unique_ptr<AuditSource> source = open_audit(options.request);
  if (options.boxes.count > 0) return run_box_audit(*source, options, context);
  const Audits audits = audit_all(*source, options);
  const Totals totals = totals_of(audits.states);
  if (context.json) {
    print_json(options, audits, totals, source->left_out());
  } else {
    print(audits, totals, source->left_out());
  }
  if (!audits.stopped.empty()) log_line("ogc: " + audits.stopped);
  if (totals.intersections > 0 || (audits.ways && audits.ways->meetings() > 0)) return exit_check_failed;
  if (options.deepest && totals.deepest > *options.deepest) {
    log_line("ogc: a vertex is " + number(totals.deepest) + " m inside a volume, where --deepest allows " +
             number(*options.deepest) + " m");
    return exit_check_failed;
  }
  if (!audits.stopped.empty()) return exit_bad_input;
  return interrupted() ? exit_interrupted : static_cast<int>(exit_success);
}

}  // namespace

void add_audit_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<AuditOptions>();
  CLI::App* command = app.add_subcommand(
      "audit", "Exact self-intersection audit of a mesh, of a run, or of the frames of any other program");
  command
      ->add_option("MESH|FRAMES|RUN", options->request.paths,
                   "A mesh (.obj, .ply, .vtp, .vtu, .vtk, .msh, .mesh, .stl, .off, .gltf, .glb); frames as several "
                   "meshes, as a folder of meshes, as several .npy, or in one file (.npz, .npy, .pc2); or a run folder")
      ->required();
  command->add_option(
      "--mesh", options->request.topology,
      "This mesh or array (.npy, .npz) has the triangles of frames that come without: in .npy, .pc2, or .npz");
  command->add_option("--show", options->show,
                      "The first 8 states with an intersection get a .vtp of what intersects in this folder; python3 "
                      "-m plots.offenders FILE draws one");
  command
      ->add_option("--deepest", options->deepest,
                   "A state fails where a vertex lies deeper inside a volume than this (default: no state does)")
      ->check(real_number(0, compare::most_length, "m"));
  command->add_flag(
      "--between", options->between,
      "The audit also asks which faces meet while every vertex moves straight from one state to the next");
  command
      ->add_option("--boxes", options->boxes.count,
                   "Instead of whole states, the run's last state is audited in so many boxes, half of them where "
                   "contacts are densest: intersections, and the contacts of the fast path against the exact ones")
      ->check(whole_number(1, most_counted));
  command->add_option("--seed", options->boxes.seed, "With --boxes: seed of the other half")
      ->check(whole_number(0, most_counted))
      ->capture_default_str();
  command->add_option("--engine", options->engine, "With --boxes: the fast path on cpu or cuda finds the contacts")
      ->check(CLI::IsMember({"cpu", "cuda"}))
      ->capture_default_str();
  add_mesh_options(*command, options->request.meshes);
  command
      ->add_option("--limit", options->request.limit,
                   "The audit lists at most so many intersections of a state; it counts all of them")
      ->check(whole_number(0, most_counted))
      ->capture_default_str();
  command->add_flag("--json", context.json, "Print the result as JSON on standard output");
  command->footer(
      "Two triangles, or two edges, intersect where they meet beyond the corner or side that they share. Touching "
      "counts, and so does a triangle that is folded flat onto its neighbour.\n"
      "No rounding decides. In a run, pairs inside one fixed or prescribed body, and the scene's excluded "
      "pairs, are left out. Of volumes, which may be entered, it says how many vertices are inside (by winding "
      "number), "
      "the deepest, and how many\n"
      "edges meet. Exit status 1: there is an intersection, a meeting, or a vertex beyond --deepest.\n"
      "Between states, two sheets may have changed places. --between asks, without rounding, which faces meet while "
      "each "
      "vertex moves straight from one state to the next,\n"
      "and says before it begins what that will take. Where a program turned something between two frames, or they are "
      "many steps apart, it went another way, and a meeting may be none of its motion.\n"
      "The smallest distances of a vertex to a triangle without it, and of two edges without a common vertex, are "
      "found exactly too, and\n"
      "rounded down; of pairs equally near the one with the lowest numbers is named.\n"
      "Text names elements as the mesh's file counts them; numbers of the JSON are from 0, without unused vertices.\n\n"
      "JSON has the vertices of what meets as excluded_pairs, as a scene file takes them: what is excluded may go on "
      "meeting (experiments/garments.md).\n"
      "Frames of whatever solver: files are taken in natural order (frame_2 before frame_10), and a pattern in quotes "
      "is expanded here. A .npz\n"
      "(numpy.savez) holds positions [frames, vertices, 3] (or x, vertices, points, verts, v, V, SMPL's v_template) in "
      "float32 or float64, or one array\n"
      "[vertices, 3] a frame (frame_0, frame_1; arr_0, arr_1), and triangles [n, 3] (or faces, f, F) and edges [n, 2] "
      "of whole numbers from 0; in C or\n"
      "Fortran order. Of several .npy one may hold the triangles, and so may a .npy for --mesh. A .pc2 is a point "
      "cache, as Blender writes it. Numbers\n"
      "are audited as they are stored, none is rounded; where a text file prints too few digits to tell, that is said. "
      "Where a frame can't be read,\n"
      "those before it are reported, and the exit status is 2, or 1.\n\n"
      "Examples:\n"
      "  ogc audit shirt.obj\n"
      "  ogc audit runs/twist-small-20250801-120000\n"
      "  ogc audit their_run/*.ply --show crossings\n"
      "  ogc audit cloth.pc2 --mesh cloth.obj --between\n"
      "  ogc audit frames.npz --json --limit 20 > verdict.json");
  command->callback([options, &context] { context.status = run_audit(*options, context); });
}

}  // namespace ogc::experiments
