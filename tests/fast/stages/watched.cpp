// Runs the stages on a backend that observes them: arrays have guarded margins, replayed recordings are noted, and a
// test can spoil positions before a step checks them.
#include <cstring>
#include <functional>
#include <set>
#include <typeindex>

#include "fast/cpu/backend.hpp"
#include "fast/probes/contact_engine.hpp"
#include "fast/probes/probe_step.hpp"
#include "fast/stages/simulation.hpp"
#include "fast/stages/update_vertices.hpp"
#include "tests/catch.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

int broken_margins = 0;
int strains_begun = 0, angles_begun = 0;  // loops that compute strains and angles at the start of a step

using Launches = std::vector<std::type_index>;
Launches* launched = nullptr;  // functors in the order of their launches

template <class F>
void note_launch() {
  if (launched != nullptr) launched->push_back(typeid(F));
}

/// A CpuBuffer with a margin of set bits behind its items: NaN as floats, −1 as integers.
template <class T>
class GuardedBuffer {
 public:
  GuardedBuffer() = default;
  GuardedBuffer(GuardedBuffer&&) noexcept = default;
  GuardedBuffer& operator=(GuardedBuffer&&) noexcept = default;
  ~GuardedBuffer() { check(); }

  T* data() { return items_.get(); }
  const T* data() const { return items_.get(); }
  std::size_t size() const { return size_; }
  void resize(std::size_t n) {
    check();
    if (n > capacity_) {
      items_ = std::make_unique<T[]>(n + margin);
      capacity_ = n;
      std::memset(static_cast<void*>(items_.get() + n), 0xff, margin * sizeof(T));
    }
    size_ = n;
  }
  void upload(const T* from, std::size_t n) {
    resize(n);
    std::copy(from, from + n, items_.get());
  }
  void download(T* to, std::size_t n) const { std::copy(items_.get(), items_.get() + n, to); }
  void fill_zero() {
    if (size_ > 0) std::memset(static_cast<void*>(items_.get()), 0, size_ * sizeof(T));
  }

 private:
  static constexpr std::size_t margin = 4096;

  void check() const {
    if (!items_) return;
    const auto* bytes = reinterpret_cast<const unsigned char*>(items_.get() + capacity_);
    if (std::any_of(bytes, bytes + margin * sizeof(T), [](unsigned char b) { return b != 0xff; })) ++broken_margins;
  }

  std::unique_ptr<T[]> items_;
  std::size_t size_ = 0, capacity_ = 0;
};

/// Tells whether a launch contains a step's certificate.
template <class F>
constexpr bool is_check = false;
template <class F>
constexpr bool is_check<Beside<F, CheckVertex>> = true;

class WatchedBackend : public CpuBackend {
 public:
  template <class T>
  using Buffer = GuardedBuffer<T>;
  struct Recording {
    char own_address = 0;
    void clear() {}
  };
  using Replayed = std::vector<const Recording*>;

  /// `before_check` is called before a step checks its positions.
  explicit WatchedBackend(Replayed* replayed = nullptr, std::function<void(Vec*)> before_check = nullptr)
      : replayed_(replayed), before_check_(std::move(before_check)) {}

  template <class F>
  void for_each(int n, F f) {
    note_launch<F>();
    if constexpr (std::is_same_v<F, BeginElement<TriangleKind>>) ++strains_begun;
    if constexpr (std::is_same_v<F, BeginElement<HingeKind>>) ++angles_begun;
    if constexpr (is_check<F>) {
      if (before_check_) before_check_(const_cast<Vec*>(f.g.position));
    }
    CpuBackend::for_each(n, f);
  }
  template <int W, class F>
  void for_each_group(int n, F f) {
    note_launch<F>();
    CpuBackend::for_each_group<W>(n, f);
  }
  template <class F>
  void for_each_counted(const int* n, int capacity, F f) {
    note_launch<F>();
    CpuBackend::for_each_counted(n, capacity, f);
  }
  template <class F, class G>
  void for_both(int m, F f, const int* n, int capacity, G g) {
    note_launch<F>(), note_launch<G>();
    CpuBackend::for_both(m, f, n, capacity, g);
  }
  template <int W, class F>
  void for_each_team(Teams n, F f, Start start) {
    note_launch<F>();
    CpuBackend::for_each_team<W>(n, f, start);
  }
  template <class First, class Second>
  void search(const Searches<First>& first, const Searches<Second>& second) {
    note_launch<First>(), note_launch<Second>();
    CpuBackend::search(first, second);
  }
  template <class F, class Body>
  void when(F decide, const int* flag, Body body) {
    note_launch<F>();
    CpuBackend::when(decide, flag, body);
  }
  template <class F, class Body, class G>
  void repeat(F decide, const int* flag, Body body, G decide_again) {
    note_launch<F>(), note_launch<G>();
    CpuBackend::repeat(decide, flag, body, decide_again);
  }
  template <class Body>
  void replay(Recording& recording, int times, Body body, const int*) {
    if (replayed_ != nullptr) replayed_->push_back(&recording);
    CpuBackend::Recording nothing;
    CpuBackend::replay(nothing, times, body);
  }

 private:
  Replayed* replayed_;
  std::function<void(Vec*)> before_check_;
};

using Watched = ResidentSimulation<WatchedBackend>;

/// A trace whose own launches are not noted.
class Onlooker : public StepTrace<WatchedBackend> {
 public:
  using StepTrace::StepTrace;

  void after(compare::StepEventKind kind, const Vec* position) override {
    Launches* const noted = std::exchange(launched, nullptr);
    StepTrace::after(kind, position);
    launched = noted;
  }
  void after_finding() override {
    Launches* const noted = std::exchange(launched, nullptr);
    StepTrace::after_finding();
    launched = noted;
  }
};

compare::Scene thrown_sheet() {
  compare::Scene scene = empty_scene();
  compare::Material material;
  material.bending_damping = material.membrane_damping = 2e-6;
  add_sheet(scene, 7, 0.06, 0.006, false, material);
  add_sheet(scene, 6, 0.08, 0, true, material);
  for (std::size_t v = 0; v < 49; ++v) {
    scene.mesh.positions[v].y += 0.05 * scene.mesh.positions[v].x;
    scene.velocities[v] = {0.2, -0.5, 0.1};
  }
  scene.settings.iterations = 4;
  return scene;
}

compare::Scene still_sheet() {
  compare::Scene scene = empty_scene();
  scene.gravity = {};
  scene.settings.iterations = 4;
  add_sheet(scene, 5, 0.06, 0, false);
  return scene;
}

/// Returns the replayed recordings of `frames` calls of advance, one step each.
WatchedBackend::Replayed replayed(const compare::Scene& scene, int frames, int capacity = 0) {
  WatchedBackend::Replayed noted;
  Watched simulation(WatchedBackend(&noted), scene, {}, "watched", capacity);
  for (int k = 0; k < frames; ++k) simulation.advance(1);
  return noted;
}

/// Returns the number of different recordings in `noted`.
std::size_t kinds(const WatchedBackend::Replayed& noted) { return std::set(noted.begin(), noted.end()).size(); }

}  // namespace

TEST_CASE("nothing is written behind an array, and nothing that is read there matters", "[property]") {
  broken_margins = 0;
  compare::Scene scene = thrown_sheet();
  scene.springs = {{3, 40, 0.5, 0, 1e-3}};
  compare::PrescribedMotion motion;
  motion.vertices = {0, 1, 2};
  motion.velocity = {0.1, 0, 0};
  scene.motions.push_back(motion);
  for (const bool profile : {false, true}) {
    compare::SimulationOptions options;
    options.profile = profile;
    ResidentSimulation<CpuBackend> expected(CpuBackend{}, scene, options, "");
    const std::vector<compare::StepMetrics> rows = expected.advance(6);
    for (const int capacity : {0, 1}) {
      Watched simulation(WatchedBackend{}, scene, options, "", capacity);
      const std::vector<compare::StepMetrics> watched = simulation.advance(6);
      REQUIRE(watched.size() == rows.size());
      CHECK(watched.back().status % compare::step_list_grew == compare::step_clean);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        CHECK(watched[k].kinetic_energy == rows[k].kinetic_energy);
        CHECK(watched[k].elastic_energy == rows[k].elastic_energy);
        CHECK(watched[k].contact_energy == rows[k].contact_energy);
        CHECK(watched[k].momentum_lost_end == rows[k].momentum_lost_end);
      }
      CHECK(simulation.snapshot().positions == expected.snapshot().positions);
    }
  }
  for (const compare::Bounds bounds : {compare::Bounds::ball, compare::Bounds::planes}) {
    Watched simulation(WatchedBackend{}, dense_stack(bounds), {}, "");  // lists grow before the first step
    CHECK(simulation.advance(1)[0].repeats == 0);
  }
  {
    const compare::Topology topology = compare::build_topology(scene);
    WatchedBackend backend;
    BackendContactEngine<WatchedBackend> engine(backend, topology, {}, 1);
    CpuBackend own;
    BackendContactEngine<CpuBackend> expected(own, topology, {});
    const std::vector<compare::Vec3f> x = compare::to_single(scene.mesh.positions);
    const ContactQuery query{.contact_radius = 0.005F, .query_radius = 0.02F};
    for (int k = 0; k < 5; ++k) CHECK(engine.find(x, query) == expected.find(x, query));
  }
  CHECK(broken_margins == 0);
  {
    GuardedBuffer<double> buffer;
    buffer.resize(3);
    buffer.data()[3] = 0;
  }
  CHECK(broken_margins == 1);
}

TEST_CASE("a position beyond its bound, or none, at a step's end stops the run at the last good state", "[unit]") {
  const compare::Scene scene = thrown_sheet();
  for (const bool finite : {true, false}) {
    int checks = 0;
    const auto spoil = [&](Vec* position) {
      if (++checks == 3) position[7].y = finite ? position[7].y + 1 : NAN;
    };
    Watched simulation(WatchedBackend(nullptr, spoil), scene, {}, "");
    const std::vector<compare::StepMetrics> rows = simulation.advance(5);
    REQUIRE(rows.size() == 3);
    CHECK(rows[1].status == compare::step_clean);
    CHECK((rows[2].status & (finite ? compare::step_bound_violated : compare::step_not_finite)) != 0);
    Watched good(WatchedBackend{}, scene, {}, "");
    good.advance(2);
    CHECK(simulation.snapshot().step == 2);
    CHECK(simulation.snapshot().positions == good.snapshot().positions);
    CHECK(simulation.snapshot().velocities == good.snapshot().velocities);
  }
}

TEST_CASE("iterations are asked in groups whether a detection is due until a frame has one in four of them", "[unit]") {
  // Steps that sort the trees (the first and the seventeenth) have their own recordings. Detections of the guess loop
  // are not counted, and this scene has no others. If a step is repeated because lists grew, its frame (the steps that
  // are enqueued together) is not counted.
  constexpr int frames = steps_between_sorts + 1;
  const WatchedBackend::Replayed still = replayed(still_sheet(), frames);
  REQUIRE(still.size() == frames);
  CHECK(still.front() == still.back());
  CHECK(still.front() != still[1]);
  CHECK(kinds(still) == 2);
  compare::Scene few = thrown_sheet();
  few.settings.detection_fraction = 1;
  const WatchedBackend::Replayed grown = replayed(few, frames, 1);
  REQUIRE(grown.size() > frames);
  CHECK(std::count(grown.begin(), grown.end(), grown.front()) > 1);
  CHECK(kinds(grown) == 2);
  compare::Scene many = thrown_sheet();
  many.settings.detection_every = 1;
  const WatchedBackend::Replayed changed = replayed(many, frames);
  REQUIRE(changed.size() == frames);
  CHECK(kinds({changed.begin() + 1, changed.end() - 1}) == 1);
  CHECK(kinds(changed) == 3);
}

TEST_CASE("strains at the start of a step are asked for where something damps, and nowhere else", "[unit]") {
  compare::Scene scene = thrown_sheet();
  for (const auto& [membrane, bending] : {std::pair(0.0, 0.0), std::pair(1e-6, 0.0), std::pair(0.0, 1e-6)}) {
    for (compare::Body& body : scene.bodies) {
      body.material.membrane_damping = membrane, body.material.bending_damping = bending;
    }
    Watched simulation(WatchedBackend{}, scene, {}, "");
    strains_begun = angles_begun = 0;
    simulation.advance(3);
    CHECK(strains_begun == (membrane > 0 ? 3 : 0));
    CHECK(angles_begun == (bending > 0 ? 3 : 0));
  }
}

TEST_CASE("a step that is timed, or observed, makes the launches of one that is neither", "[property]") {
  const compare::Scene scene = thrown_sheet();
  const auto launches = [&](bool profile, bool observed) {
    Launches noted;
    compare::SimulationOptions options;
    options.profile = profile;
    Watched simulation(WatchedBackend{}, scene, options, "");
    Onlooker onlooker(simulation.backend(), simulation.step(), simulation.state(), simulation.detection(),
                      simulation.volumes(), simulation.rods(), simulation.topology());
    if (observed) simulation.observe(&onlooker);
    launched = &noted;
    simulation.advance(1);
    launched = nullptr;
    CHECK(onlooker.take().empty() != observed);
    return noted;
  };
  const Launches expected = launches(false, false);
  const auto count = [&](const std::type_index& functor) {
    return std::count(expected.begin(), expected.end(), functor);
  };
  REQUIRE(count(typeid(GuessVertex)) > 1);                              // several rounds
  REQUIRE(count(typeid(RankAndResolve)) > count(typeid(GuessVertex)));  // detections between iterations, too
  CHECK(count(typeid(RankAndResolve)) == count(typeid(DetectEdgeEdge)));
  CHECK((launches(true, false) == expected));
  CHECK((launches(true, true) == expected));
}
