// All that the judge knows of a stage, as one object: what it is asked, where its cases come from, how both sides are
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

/// How far the same question gives the same bits; each level includes those before it (the first three words are
/// CUB's).
enum class Determinism : std::uint8_t {
  not_guaranteed,
  run_to_run,  ///< again, on the same device, with any number of threads, in any company of other cases
  gpu_to_gpu,  ///< on devices of any number of multiprocessors: no size of device, grid or block enters an answer
  cpu_to_gpu   ///< on CPU and CUDA, where both are built without contraction (preset `strict`)
};

/// What a case of a stage is.
enum class CaseKind : std::uint8_t {
  single,   ///< a pair, a stencil, a vertex: many are asked at once
  mesh,     ///< a mesh, one question
  followed  ///< a mesh whose truth follows the contestant's answer, update by update: dear to judge
};

/// A stage in words: a row of the table in compare/README.md, which `ogc compare --list --markdown` prints.
struct StageInfo {
  std::string_view name;       ///< "closest_face"
  std::string_view question;   ///< what is asked, in a few words
  std::string_view unit;       ///< what counts as a case
  std::string_view reference;  ///< file of the reference's answer
  CaseKind kind;               ///< how cases are asked
  /// its answer has a discrete part, and reports say how many cases lie near a boundary of it
  bool has_boundary;
  Determinism determinism;
};

/// A continuous answer of a stage: what it is, its unit and the largest error accepted (compare/stages).
struct MetricInfo {
  std::string_view name, unit;  ///< "force", "u cond"
  double tolerance;             ///< in that unit
  /// Why no error of ours comes near the tolerance (compare/judge/engine/tally.hpp, loose_factor); empty where one
  /// does.
  std::string_view loose_because{};
};

/// The object of a stage; functions take and return what their types say, and never keep a view.
struct StageTraits {
  StageInfo info;                              ///< in words
  std::span<const Generator> (*generators)();  ///< the stage's table
  std::span<const MetricInfo> metrics;         ///< none where all answers are discrete
  std::span<const ParameterInfo> parameters;   ///< none where a case has nothing but coordinates

  // A case. Each takes data of the stage's own type.

  /// Names what makes the question illegal.
  void (*check)(const CaseData&, FirstProblem&);
  /// Puts parameters of the table into the case; says what makes them illegal together, else nothing.
  std::string (*set)(CaseData&, std::span<const Override>);
  /// Moves a few points (compare/judge/cases/mutate.hpp).
  void (*mutate)(Random&, CaseData&);
  /// The coordinates that dust may make small; none where a case has none of its own.
  std::vector<float*> (*coordinates)(CaseData&);
  /// Why a run has no cases for the stage; empty where it has.
  std::string (*missing_in)(const States&);
  CaseData (*of_state)(const States&, std::uint64_t index, Random&);
  nlohmann::ordered_json (*write)(const CaseData&);  ///< every bit comes back
  /// Throws what the JSON library throws for a missing key or a wrong type, InputError for a value that no case can
  /// have.
  CaseData (*read)(const nlohmann::ordered_json&);
  Shape (*shape)(const CaseData&);
  std::vector<Quantity> (*inputs)(const CaseData&);  ///< by name and unit, in the contract's order
  /// The mesh whose primitives a smaller case may lack; null where a case stays whole.
  const Topology* (*mesh)(const CaseData&);
  CaseData (*part)(const CaseData&, const MeshPart&);
  ShortenedNumbers (*numbers)(CaseData&);

  // The question.

  /// Whether both sides have the stage, and the authority those that the verdict asks besides.
  bool (*can_judge)(const Contestant&, const Authority&);
  /// Puts cases to both sides and judges the answers.
  void (*ask)(std::span<const TestCase>, const Contestant&, const Authority&, Asker&, Tally&);
  /// The bits of the answers, one string a case.
  std::vector<std::string> (*bits)(std::span<const TestCase>, const Contestant&, const Authority&);
  /// Both answers to one case, for people.
  Answers (*answers)(const TestCase&, const Contestant&, const Authority&);
  std::vector<WrongForm> (*wrong_forms)(std::span<const Evidence>);  ///< known ways to get it wrong
  /// The cases as a question to ask again and again.
  BenchmarkCall (*benchmark)(std::span<const TestCase>, const Contestant&, const Authority&);
  /// The question that a step asks about a scene as it starts, for benchmarks; null where the stage's own cases serve.
  CaseData (*of_scene)(const Scene&, const Contestant&);
  /// Whether the answer to the case is the same under other numbers of vertices and triangles; null where it depends on
  /// them.
  bool (*is_same_renumbered)(const TestCase&, Random&, const Contestant&);
};

const StageTraits& traits_of(Stage stage);  ///< of an enumerator

const StageInfo& stage_info(Stage stage);  ///< its traits' words

/// The metrics of a stage; their positions are the numbers that Tally::error takes.
std::span<const MetricInfo> metrics(Stage stage);

/// "run_to_run" …
std::string_view determinism_name(Determinism level);

}  // namespace ogc::compare
