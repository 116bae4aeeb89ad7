// Runs one simulation from its scene to its run folder. If states are audited, a state is stored only after its audit,
// so that the last frame of a folder is the last good state. When an audit fails, the simulation may be a few states
// ahead; it is then stopped.
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/record/run_folder.hpp"
#include "experiments/program/audits/auditor.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/jitter.hpp"
#include "experiments/program/runs/measured_simulation.hpp"
#include "experiments/program/runs/momentum_share.hpp"
#include "experiments/program/runs/pace.hpp"
#include "experiments/program/runs/start_pairs.hpp"
#include "experiments/program/runs/warnings.hpp"

namespace ogc::experiments {

/// Largest computing time that an interruption may lose, apart from the steps in progress [s].
inline constexpr double default_checkpoint_seconds = 60;

/// Holds the duration of a run and of its parts [s].
struct RunSeconds {
  double whole = 0;    ///< since the command began
  double start = 0;    ///< until the first step: scene, its audit, device, folder
  double steps = 0;    ///< sum of StepMetrics::wall_ms
  double audits = 0;   ///< time in which the run waited for audits
  double writing = 0;  ///< time in which the run waited for the disk
};

/// Describes the requested run.
struct RunRequest {
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();  ///< when the command began
  compare::Scene scene;                                                            ///< with all settings applied
  compare::MeshSources sources;  ///< sources of the bodies' meshes, for messages
  compare::Vec3 origin{};        ///< see compare::SceneFile::origin
  std::string scale;             ///< "smoke", …; empty for a scene file
  std::string solver = "vbd";    ///< value of --solver
  std::string backend = "cpu";   ///< value of --backend
  AuditMode audit = AuditMode::frame;
  bool audit_beside = false;                        ///< see Auditor
  std::optional<std::filesystem::path> from_state;  ///< frame whose state is the start of the run
  Jitter jitter;                                    ///< offsets of the start
  bool tolerate_start = false;                      ///< exclude pairs that intersect at the start until they separate
  std::optional<compare::Checkpoint> resume;  ///< the checkpoint of `folder` from which the run continues (resume.hpp)
  double checkpoint_seconds = default_checkpoint_seconds;  ///< least time between two checkpoints [s]
  std::optional<double> deepest;               ///< depth inside a volume above which a state fails [m]; empty: no limit
  bool profile = false;                        ///< records times by stage
  bool iterations = false, condition = false;  ///< see compare::SimulationOptions
  /// what the wrapped contestant measures (experiments/program/runs/measured_simulation.hpp), for run.json
  bool residual = false, ledger = false;
  std::int64_t repeats = 0;           ///< repetitions of each step for its times
  std::optional<StepRange> meetings;  ///< steps whose meetings the wrapped contestant counts
  std::filesystem::path folder;
  std::filesystem::path show;  ///< folder for .vtp files of intersections; empty: none
  std::string command_line;
};

/// Holds the results of a run. Times of steps are in ms, or not-a-number if no step was done.
struct RunSummary {
  /// values of run.json
  std::string scene, scale, solver, backend, device, folder, status;
  /// warnings of settings that are hardly intended (experiments/program/runs/warnings.hpp)
  std::vector<std::string> warnings;
  std::string left_out_of_audits;    ///< in words; empty if nothing is left out
  AuditMode audit = AuditMode::off;  ///< which states were requested for audits
  std::string failure;           ///< description of the failure, with the names of primitives; empty if there was none
  bool was_interrupted = false;  ///< whether Ctrl-C ended the run
  bool is_unbounded = false;     ///< bounds=off: nothing is guaranteed
  std::int64_t first_step = 0, last_step = 0;  ///< steps of the first and the last state
  double median_ms = 0, worst_ms = 0;          ///< median and largest time of a step
  std::int64_t worst_step = 0;                 ///< step with the largest time
  /// largest number of vertex–facet and edge–edge contacts together in one step; number of each in the last step
  std::int64_t most_contacts = 0, last_vertex_facet_contacts = 0, last_edge_edge_contacts = 0;
  /// sums over the steps of StepMetrics::broad_phases, discrete_detections and continuous_detections
  std::int64_t detections = 0, discrete_detections = 0, continuous_detections = 0;
  std::int64_t guess_rounds = 0, iterations = 0, repeats = 0;
  double largest_share_cut = 0, largest_lag = 0, smallest_distance = 0;
  /// largest MomentumShare among steps that follow a frame; empty if none of these steps did all guess rounds
  std::optional<double> largest_momentum_lost;
  /// results of ForcesLeft: number of steps that count, median residual of Eq. 29 [1], median number of vertices held
  /// by a bound
  std::size_t measured_steps = 0;
  double left_residual = 0, left_held = 0;
  std::size_t audited_states = 0, failed_states = 0, intersections = 0, certificate_violations = 0, unsafe_bounds = 0;
  bool has_volumes = false;  ///< the next members describe the states that this command audited, if there are volumes
  /// largest number of vertices inside volumes, largest number of edges that meet a volume's surface, and number of
  /// vertices inside at the start
  std::size_t most_inside = 0, most_edges_meeting = 0, inside_at_start = 0;
  double deepest = 0;                ///< largest depth inside a volume [m]
  std::int64_t deepest_step = 0;     ///< step of the largest depth
  std::int64_t most_unresolved = 0;  ///< largest StepMetrics::depth_unresolved
  bool asks_meetings = false;        ///< whether meetings were counted; the next two members cover the counted steps
  std::int64_t meetings = 0, first_meeting = -1;  ///< pairs that met during steps; step of the first meeting
  std::optional<bool> guarantee_kept;             ///< empty if nothing was audited and no violation is known
  /// results of StartPairs: number of pairs that the guarantee excludes; number of them that are still open at the end
  std::size_t start_pairs = 0, open_pairs = 0;
  std::string final_hash;  ///< state_hash of the last good state
  RunSeconds seconds;      ///< times of this command alone, which may have continued an earlier run
};

/// Returns the summary as JSON.
Json to_json(const RunSummary& summary);
/// Returns the summary as text.
std::string describe(const RunSummary& summary);
/// Returns in words whether the guarantee was kept: "yes", "no", "not checked", or for example "but for 12 pairs of
/// vertices that met at the start, 3 still open" (not yet apart).
std::string guarantee_text(const RunSummary& summary);

/// Returns the number of steps between frames. If the scene does not set it, a simulated second has about 60 frames.
std::int64_t frame_steps(const compare::Settings& settings);
/// Brings a scene to single precision and removes its dust. Throws compare::InputError for an invalid scene.
void check_scene(compare::Scene& scene, const compare::MeshSources& sources);
/// Returns the request with its scene in single precision and without dust. Throws compare::InputError for an invalid
/// scene or an unusable folder.
RunRequest checked(RunRequest request);
/// Returns what run.json says of the run when it begins.
compare::Provenance provenance(const RunRequest& request, const std::string& device);
/// Returns in words why a step ends the run; empty if it does not.
std::string step_failure(const compare::StepMetrics& row);

/// Runs one simulation and writes its folder.
class RunSession {
 public:
  /// Checks the scene, the folder and the start. If a run continues, resumed_run has checked the folder, and the state
  /// of the checkpoint was audited before it was stored. Throws compare::InputError for an invalid scene, an unusable
  /// folder, or intersections at the start, which the message lists.
  RunSession(RunRequest request, compare::Contestant contestant);
  RunSession(const RunSession&) = delete;
  RunSession& operator=(const RunSession&) = delete;
  /// Runs to the end, to a failure (RunSummary::failure), or to an interruption. Throws compare::ResourceError if the
  /// disk is full; if possible, the folder records this.
  RunSummary run();

 private:
  void start_state();
  void name_pairs();
  void judge_with_pairs();
  void check_start();
  void tell_pairs() const;
  void start_simulation();
  void close_pairs();
  void count_pairs(std::int64_t step);
  void write_pairs() const;
  void count(const compare::VolumePenetration& penetration, std::int64_t step);
  std::string show(const std::string& name, const compare::Snapshot& state, const compare::AuditResult& result) const;
  void open_folder();
  void begin_folder();
  void reopen_folder();
  void remember_starts(const std::vector<compare::StepMetrics>& rows);
  void save_checkpoint();
  void simulate();
  bool one_chunk();
  std::int64_t chunk() const;
  bool is_frame(std::int64_t step) const;
  bool is_planned(std::int64_t step) const;
  bool is_checkpoint_due() const;
  void offer_state(std::int64_t before);
  void add_rows(const std::vector<compare::StepMetrics>& rows);
  void count(const std::vector<compare::StepMetrics>& rows);
  void offer(compare::Snapshot snapshot);
  void accept(compare::Snapshot snapshot);
  void collect(const std::vector<Verdict>& verdicts);
  void submit(const compare::Snapshot& snapshot);
  double since_begun() const;
  void take_times();
  void reject(const Verdict& verdict, const compare::Snapshot& snapshot);
  void store_frame(const compare::Snapshot& snapshot);
  void finish();
  static bool finite(const compare::Snapshot& snapshot);
  bool failed() const { return !summary_.failure.empty(); }

  RunRequest request_;
  const compare::Settings& settings_;
  compare::Contestant contestant_;
  std::optional<StartPairs> pairs_;  ///< open pairs of a start that is tolerated
  std::string pairs_csv_;            ///< rows of start_pairs.csv
  /// the scene with open pairs excluded; null if no pair is tolerated
  std::unique_ptr<compare::Scene> tolerant_scene_;
  std::unique_ptr<compare::Simulation> simulation_;
  std::unique_ptr<StateJudge> judge_;
  Warnings warnings_;
  MomentumShare momentum_;
  std::unique_ptr<Auditor> auditor_;
  std::unique_ptr<compare::RunWriter> writer_;
  std::deque<compare::Snapshot> offered_;  ///< states whose verdict is not yet known
  compare::Snapshot start_, last_good_;
  std::map<std::int64_t, VertexMeasures> measures_;  ///< of states that may become frames, by step
  std::int64_t step_ = 0, last_frame_ = -1, frame_steps_ = 1;
  std::int64_t offered_step_ = 0;  ///< step of the last offered state
  Pace pace_;
  std::int64_t saved_step_ = -1;  ///< step of the last checkpoint
  std::chrono::steady_clock::time_point saved_at_;
  std::size_t unplanned_audits_ = 0;
  std::vector<double> step_times_;
  RunSummary summary_;
};

}  // namespace ogc::experiments
