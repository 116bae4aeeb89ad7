#include "experiments/bench/processes.hpp"

#include <stdexcept>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "experiments/bench/results.hpp"
#include "experiments/program/own_process.hpp"
#include "experiments/program/progress.hpp"

namespace ogc::experiments {

void bench_in_processes(const std::vector<std::string>& arguments, int count, const std::filesystem::path& file) {
  const std::filesystem::path part = file.string() + ".part";
  Json all;
  Progress progress(0, count, "process");
  for (int k = 0; k < count; ++k) {
    progress.show(k, "");
    std::vector<std::string> words = arguments;
    words.insert(words.end(), {"--json", part.string()});
    if (const int status = status_of(start_self(words)); status != 0)
      throw std::runtime_error("process " + std::to_string(k + 1) + " ended with status " + std::to_string(status));
    Json one = parse_results(part);
    std::filesystem::remove(part);
    for (Json& run : one.at("benchmarks")) run["process"] = k;
    if (all.is_null()) {
      all = std::move(one);
      continue;
    }
    for (Json& run : one.at("benchmarks")) all.at("benchmarks").push_back(std::move(run));
  }
  progress.show(count, "");
  compare::write_bytes(file, all.dump(1) + "\n");
}

}  // namespace ogc::experiments
