#include "compare/record/worlds_folder.hpp"

#include <cstdio>
#include <utility>

#include "compare/problem/text.hpp"
#include "compare/record/run_folder.hpp"

namespace ogc::compare {

namespace fs = std::filesystem;

namespace {

/// Returns a cell of a table; a text with commas or quotes is quoted.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string cell(double number) { return shortest(number); }

std::string table_of(const std::vector<WorldRow>& rows) {
  std::string text = "world,jitter_seed,";
  if (!rows.empty())
    for (const auto& [name, value] : rows.front().settings) text += "set_" + name + ",";
  text +=
      "status,last_step,detections,iterations,repeats,vertex_facet_contacts,edge_edge_contacts,"
      "smallest_distance [m],largest_lag [m],largest_share_cut,kinetic_energy [J],elastic_energy [J],"
      "contact_energy [J],gravity_energy [J],audited_states,final_hash,failure\n";
  for (const WorldRow& row : rows) {
    text += std::to_string(row.world) + "," + std::to_string(row.jitter_seed) + ",";
    for (const auto& [name, value] : row.settings) text += cell(value) + ",";
    text += row.status;
    for (const std::int64_t count : {row.last_step, row.detections, row.iterations, row.repeats,
                                     row.vertex_facet_contacts, row.edge_edge_contacts})
      text += "," + std::to_string(count);
    for (const double number : {row.smallest_distance, row.largest_lag, row.largest_share_cut, row.kinetic_energy,
                                row.elastic_energy, row.contact_energy, row.gravity_energy})
      text += "," + cell(number);
    text += "," + std::to_string(row.audited_states) + "," + row.final_hash + "," + cell(row.failure) + "\n";
  }
  return text;
}

fs::path end_file(int world) {
  char name[32];
  std::snprintf(name, sizeof(name), "world_%04d.h5", world);
  return name;
}

}  // namespace

WorldsWriter::WorldsWriter(fs::path folder, const Scene& scene, const Provenance& provenance)
    : folder_(std::move(folder)), scene_(scene), manifest_{provenance, scene.name, {}, {}} {
  expect_new_run_folder(folder_);
  fs::create_directories(folder_ / "ends");
  manifest_.scene_file = store_scene(folder_, scene_);
  steps_.emplace(folder_ / "worlds_steps.csv");
  steps_->append("world," + step_header({}, groups_of(scene_, manifest_)));
  if (manifest_.provenance.started.empty()) manifest_.provenance.started = utc_now();
  manifest_.provenance.status = "running";
  write_durably(folder_ / "run.json", manifest_text(manifest_, scene_));
}

void WorldsWriter::add_steps(int world, const std::vector<StepMetrics>& rows) {
  if (rows.empty()) return;
  const std::string number = std::to_string(world) + ",", lines = step_lines(rows, 0, groups_of(scene_, manifest_));
  std::string numbered;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = lines.find('\n', at) + 1;
    numbered += number + lines.substr(at, end - at);
    at = end;
  }
  steps_->append(numbered);
}

void WorldsWriter::finish(const std::vector<WorldRow>& rows, const std::vector<Frame>& ends,
                          const std::string& status) {
  std::vector<fs::path> files;
  for (std::size_t w = 0; w < ends.size(); ++w) {
    files.push_back(folder_ / "ends" / end_file(static_cast<int>(w)));
    write_partial(files.back(), frame_bytes(pack(ends[w])));
  }
  commit_group(folder_ / "ends", files);
  write_durably(folder_ / "worlds.csv", table_of(rows));
  give_up(status);
}

void WorldsWriter::give_up(const std::string& status) {
  manifest_.provenance.status = status;
  manifest_.provenance.ended = utc_now();
  write_durably(folder_ / "run.json", manifest_text(manifest_, scene_));
}

}  // namespace ogc::compare
