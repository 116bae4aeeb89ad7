// The registry of stages: what each is asked, what a case of it is, where its answers come from and how repeatable they
// are. The table in compare/README.md is printed from it (`ogc compare --list --markdown`), and a test fails where a
// stage lacks its contract, reference, CPU, CUDA or agreement test.
#pragma once

#include <array>
#include <string_view>

#include "compare/judge/stage.hpp"

namespace ogc::compare {

/// How far the same question gives the same bits; each level includes those before it (the first three words are
/// CUB's).
enum class Determinism : std::uint8_t {
  not_guaranteed,
  run_to_run,  ///< again, on the same device, with any number of threads, in any company of other cases
  gpu_to_gpu,  ///< on devices of any number of multiprocessors: no size of device, grid or block enters an answer
  cpu_to_gpu   ///< on CPU and CUDA, where both are built without contraction (preset `strict`)
};

struct StageInfo {
  Stage stage;
  std::string_view question;   ///< what is asked, in a few words
  std::string_view unit;       ///< what is counted as a case
  std::string_view reference;  ///< file of the reference's answer
  /// its answer has a discrete part, and reports say how many cases lie near a boundary of it
  bool has_boundary;
  Determinism determinism;
};

/// One row a stage, in the order of all_stages.
const std::array<StageInfo, all_stages.size()>& stage_table();

const StageInfo& stage_info(Stage stage);

/// "run_to_run" …
std::string_view determinism_name(Determinism level);

}  // namespace ogc::compare
