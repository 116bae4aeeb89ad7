// Holds all that the judge knows of a stage as one object. The object defines the question, the generators, the calls
// of contestant and authority, the verdict, and how a case is written, drawn, mutated and made smaller. The engine uses
// only this object, so it knows no stage by name. compare/judge/stages/NAME.cpp makes the object from a class
// (compare/judge/stages/stage_of.hpp); a class that lacks a member does not compile.
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

/// When the same question gives the same bits. Each level includes the levels before it. The first three names are
/// taken from the library CUB.
enum class Determinism : std::uint8_t {
  not_guaranteed,
  run_to_run,  ///< on the same device, with any number of threads, together with any other cases
  gpu_to_gpu,  ///< on devices with any number of multiprocessors: no size of device, grid or block affects an answer
  cpu_to_gpu   ///< on CPU and CUDA, if both are built without contraction (preset `strict`)
};

/// Kinds of questions that the cases of a stage make.
enum class CaseKind : std::uint8_t {
  single,   ///< a pair, a stencil or a vertex: many cases make one question
  mesh,     ///< a mesh, which makes one question
  followed  ///< a mesh; the truth starts from the answer's state before each update, which makes judging costly
};

/// A stage described in words: a row of the table in compare/README.md, which `ogc compare --list --markdown` prints.
struct StageInfo {
  std::string_view name;       ///< "closest_face"
  std::string_view question;   ///< in a few words
  std::string_view unit;       ///< what counts as a case
  std::string_view reference;  ///< file of the reference's answer
  CaseKind kind;               ///< how cases make questions
  /// true if the answer has a discrete part; reports then count the cases near its boundary
  bool has_boundary;
  Determinism determinism;
};

/// A continuous output of a stage, and the largest error that is accepted (compare/stages).
struct MetricInfo {
  std::string_view name, unit;  ///< "force", "u cond"
  double tolerance;             ///< in that unit
  /// Why errors stay far below the tolerance (loose_factor in compare/judge/engine/tally.hpp); empty if they do not.
  std::string_view loose_because{};
};

/// All that the judge knows of a stage. No function keeps a view of its arguments.
struct StageTraits {
  StageInfo info;                              ///< in words
  std::span<const Generator> (*generators)();  ///< the stage's table
  std::span<const MetricInfo> metrics;         ///< empty if all answers are discrete
  std::span<const ParameterInfo> parameters;   ///< empty if a case has nothing but coordinates

  // Functions of a case. Its data have the stage's own type.

  /// Notes what makes the question illegal.
  void (*check)(const CaseData&, FirstProblem&);
  /// Puts parameters into the case. Returns what makes them illegal together; empty if they are legal.
  std::string (*set)(CaseData&, std::span<const Override>);
  /// Moves a few points (compare/judge/cases/mutate.hpp).
  void (*mutate)(Random&, CaseData&);
  /// Returns the coordinates that may be made tiny; empty if a case has no coordinates of its own.
  std::vector<float*> (*coordinates)(CaseData&);
  /// Returns why a run has no cases for the stage; empty if it has some.
  std::string (*missing_in)(const States&);
  CaseData (*of_state)(const States&, std::uint64_t index, Random&);
  nlohmann::ordered_json (*write)(const CaseData&);  ///< keeps every bit
  /// Throws InputError for a value that no case can have, and the JSON library's exception for a missing key or a wrong
  /// type.
  CaseData (*read)(const nlohmann::ordered_json&);
  Shape (*shape)(const CaseData&);
  std::vector<Quantity> (*inputs)(const CaseData&);  ///< by name and unit, in the contract's order
  /// Returns the mesh from which primitives may be removed to make the case smaller; null if the case stays whole.
  const Topology* (*mesh)(const CaseData&);
  CaseData (*part)(const CaseData&, const MeshPart&);
  ShortenedNumbers (*numbers)(CaseData&);

  // Functions of the question.

  /// Checks whether contestant and authority have the stage, and whether the authority has all stages that the verdict
  /// calls.
  bool (*can_judge)(const Contestant&, const Authority&);
  /// Gives the cases to contestant and authority, and judges the answers.
  void (*ask)(std::span<const TestCase>, const Contestant&, const Authority&, Asker&, Tally&);
  /// Returns the bits of the answers, one string for each case.
  std::vector<std::string> (*bits)(std::span<const TestCase>, const Contestant&, const Authority&);
  /// Returns both answers to one case for printing.
  Answers (*answers)(const TestCase&, const Contestant&, const Authority&);
  std::vector<WrongForm> (*wrong_forms)(std::span<const Evidence>);  ///< known mistakes
  /// Returns the cases as a question that can be repeated.
  BenchmarkCall (*benchmark)(std::span<const TestCase>, const Contestant&, const Authority&);
  /// Returns the question that arises at the start of a scene's step, for benchmarks; null if the stage's own cases are
  /// used.
  CaseData (*of_scene)(const Scene&, const Contestant&);
  /// Checks whether renumbering vertices and triangles leaves the answer the same; null if the answer depends on their
  /// indices.
  bool (*is_same_renumbered)(const TestCase&, Random&, const Contestant&);
};

const StageTraits& traits_of(Stage stage);  ///< Returns the traits of a stage.

const StageInfo& stage_info(Stage stage);  ///< Returns the stage in words.

/// Returns the metrics of a stage. Tally::error takes an index into this list.
std::span<const MetricInfo> metrics(Stage stage);

/// Returns the level's name, as "run_to_run".
std::string_view determinism_name(Determinism level);

}  // namespace ogc::compare
