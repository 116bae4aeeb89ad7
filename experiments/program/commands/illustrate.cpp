// `ogc illustrate`: writes the data of the paper's drawings as JSON files, for paper_figures/figures/illustrations.py.
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/output.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {

namespace {

struct IllustrateOptions {
  std::vector<std::string> figures;
  std::string folder = ".";
};

Json to_json(const reference::DrawingLayer& layer) {
  return {{"name", layer.name},           {"closed", layer.closed}, {"points", layer.points},
          {"triangles", layer.triangles}, {"lines", layer.lines},   {"values", layer.values}};
}

Json to_json(const std::string& figure, const std::vector<reference::DrawingPanel>& panels) {
  Json json{{"format", "ogc illustration 1"}, {"figure", figure}, {"panels", Json::array()}};
  for (const reference::DrawingPanel& panel : panels) {
    Json layers = Json::array();
    for (const reference::DrawingLayer& layer : panel.layers) layers.push_back(to_json(layer));
    json["panels"].push_back({{"name", panel.name}, {"caption", panel.caption}, {"layers", std::move(layers)}});
  }
  return json;
}

void run_illustrate(const IllustrateOptions& options, const CommandContext& context) {
  std::vector<std::string> figures = options.figures;
  if (figures.empty()) {
    const auto names = reference::illustration_names();
    figures.assign(names.begin(), names.end());
  }
  Json written = Json::array();
  for (const std::string& figure : figures) {
    const Json json = to_json(figure,
                              figure == "fig21d" ? reference::activation_drawing() : reference::illustration(figure));
    const std::string path = (std::filesystem::path(options.folder) / (figure + ".json")).string();
    compare::write_bytes(path, json.dump() + "\n");
    written.push_back(path);
    if (!context.json) print_result(path + "\n");
  }
  if (context.json) print_result(Json{{"written", written}});
}

}  // namespace

void add_illustrate_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<IllustrateOptions>();
  CLI::App* command = app.add_subcommand("illustrate",
                                         "Data of the paper's drawings of blocks, Gauss maps, contact sets and "
                                         "truncated steps (Fig. 2c to e, 3 to 9, 22)");
  command->add_option("FIGURE", options->figures,
                      "fig02_models fig03 fig04 fig05 fig06 fig07 fig08 fig09 fig22 (default: all of these) fig21d "
                      "(for paper_figures/figures/fig21_activation_drop.py)");
  command->add_option("--out", options->folder, "Folder to write to, made where it is missing")->capture_default_str();
  command->footer(
      "Everything is computed by the exact reference; nothing is drawn by hand. The pictures:\n"
      "  python3 -m paper_figures.figures.illustrations FOLDER\n\n"
      "Example:\n"
      "  ogc illustrate fig07 fig08 --out runs/illustrations");
  command->callback([options, &context] { run_illustrate(*options, context); });
}

}  // namespace ogc::experiments
