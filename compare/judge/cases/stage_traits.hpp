// Holds all that the judge knows of a stage as one object: its question, where its cases come from, how both sides are
// asked and judged, how a case is written, drawn, mutated and made smaller. The judge's engine works through this
// object alone, so that it knows no stage by name. compare/judge/stages/NAME.cpp makes the object of a stage from a
// class (compare/judge/stages/stage_of.hpp), whose missing members do not compile.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/parameters.hpp"
#include "compare/judge/cases/random.hpp"
#include "compare/judge/cases/stage.hpp"

namespace ogc::compare {

struct Authority;
struct Contestant;
struct Topology;
struct Answers;
class Asker;
struct BenchmarkCall;
struct Evidence;
class FirstProblem;
struct Generator;
struct MeshPart;
struct Quantity;
class Renumbering;
struct ShortenedNumbers;
struct Shape;
class States;
class Tally;
struct WrongForm;

/// Tells when the same question gives the same bits; each level includes those before it (the first three words are
/// CUB's).
enum class Determinism : std::uint8_t {
  not_guaranteed,
  run_to_run,  ///< when asked again on the same device, with any number of threads, together with any other cases
  gpu_to_gpu,  ///< on devices of any number of multiprocessors: no size of device, grid or block enters an answer
  cpu_to_gpu   ///< on CPU and CUDA, where both are built without contraction (preset `strict`)
};

/// The kinds of cases.
enum class CaseKind : std::uint8_t {
  single,   ///< a pair, a stencil, a vertex: many are asked at once
  mesh,     ///< a mesh, one question
  followed  ///< a mesh whose truth follows the contestant's answer, update by update: costly to judge
};

/// A stage in words: a row of the table in compare/README.md, which `ogc compare --list --markdown` prints.
struct StageInfo {
  std::string_view name;       ///< "closest_face"
  std::string_view question;   ///< the question in a few words
  std::string_view unit;       ///< what counts as a case
  std::string_view reference;  ///< file of the reference's answer
  CaseKind kind;               ///< how cases are asked
  /// its answer has a discrete part; reports count the cases near a boundary of it
  bool has_boundary;
  Determinism determinism;
};

/// A continuous answer of a stage: its name, its unit and the largest error accepted (compare/stages).
struct MetricInfo {
  std::string_view name, unit;  ///< "force", "u cond"
  double tolerance;             ///< in that unit
  /// why no error of ours comes near the tolerance (compare/judge/engine/tally.hpp, loose_factor); empty where one does
  std::string_view loose_because{};
};

/// The object of a stage. Its functions never keep a view.
struct StageTraits {
  StageInfo info;                              ///< in words
  std::span<const Generator> (*generators)();  ///< the stage's table
  std::span<const MetricInfo> metrics;         ///< none where all answers are discrete
  std::span<const ParameterInfo> parameters;   ///< none where a case has nothing but coordinates

  // Functions of a case; each takes data of the stage's own type.

  /// Names what makes the question illegal.
  void (*check)(const CaseData&, FirstProblem&);
  /// Puts parameters of the table into the case; says what makes them illegal together, otherwise nothing.
  std::string (*set)(CaseData&, std::span<const Override>);
  /// Moves a few points (compare/judge/cases/mutate.hpp).
  void (*mutate)(Random&, CaseData&);
  /// Returns the coordinates that dust may make small; none where a case has none of its own.
  std::vector<float*> (*coordinates)(CaseData&);
  /// Says why a run has no cases for the stage; empty where it has some.
  std::string (*missing_in)(const States&);
  CaseData (*of_state)(const States&, std::uint64_t index, Random&);
  nlohmann::ordered_json (*write)(const CaseData&);  ///< keeps every bit
  /// Throws what the JSON library throws for a missing key or a wrong type, and InputError for a value that no case can
  /// have.
  CaseData (*read)(const nlohmann::ordered_json&);
  Shape (*shape)(const CaseData&);
  std::vector<Quantity> (*inputs)(const CaseData&);  ///< by name and unit, in the contract's order
  /// Returns the mesh whose primitives a smaller case may lack; null where a case stays whole.
  const Topology* (*mesh)(const CaseData&);
  CaseData (*part)(const CaseData&, const MeshPart&);
  ShortenedNumbers (*numbers)(CaseData&);

  // Functions of the question.

  /// Checks whether both sides have the stage, and the authority also the stages that the verdict asks.
  bool (*can_judge)(const Contestant&, const Authority&);
  /// Puts cases to both sides and judges the answers.
  void (*ask)(std::span<const TestCase>, const Contestant&, const Authority&, Asker&, Tally&);
  /// Returns the bits of the answers, one string a case.
  std::vector<std::string> (*bits)(std::span<const TestCase>, const Contestant&, const Authority&);
  /// Returns both answers to one case, for people.
  Answers (*answers)(const TestCase&, const Contestant&, const Authority&);
  std::vector<WrongForm> (*wrong_forms)(std::span<const Evidence>);  ///< known mistakes
  /// Returns the cases as a question that can be asked again and again.
  BenchmarkCall (*benchmark)(std::span<const TestCase>, const Contestant&, const Authority&);
  /// Returns the question that a step asks about a scene at its start, for benchmarks; null where the stage's own cases
  /// serve.
  CaseData (*of_scene)(const Scene&, const Contestant&);
  /// Checks whether the answer to the case is the same under other numbers of vertices and triangles; null where it
  /// depends on them.
  bool (*is_same_renumbered)(const TestCase&, Random&, const Contestant&);
};

const StageTraits& traits_of(Stage stage);  ///< Returns the traits of a stage.

const StageInfo& stage_info(Stage stage);  ///< Returns the stage in words.

/// Returns the metrics of a stage; their positions are the numbers that Tally::error takes.
std::span<const MetricInfo> metrics(Stage stage);

/// Returns the level's name: "run_to_run" …
std::string_view determinism_name(Determinism level);

}  // namespace ogc::compare
