// Plants faults of the step. The parts of the step are right, but their order or their inputs are wrong.
#include <algorithm>
#include <cmath>

#include "compare/problem/volumes.hpp"
#include "reference/definitions/scene_volumes.hpp"
#include "reference/geometry/pair_planes.hpp"
#include "reference/geometry/truncate.hpp"
#include "reference/solvers/guess_contacts.hpp"
#include "reference/solvers/step.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;
using reference::operator+, reference::operator-, reference::operator*;

namespace {

/// Returns a fault that computes the right step of a wrong scene: `change(scene)` changes a copy of the scene.
Fault asked_wrongly(const std::string& name, const std::function<void(Scene&)>& change) {
  return {"step: " + name, Stage::step, [change](Contestant& contestant, const Authority&) {
            contestant.step = [right = contestant.step, change](const StepIn& in) {
              Scene other = *in.scene;
              change(other);
              return right({&other, in.topology});
            };
          }};
}

/// Returns a fault that changes the right step by `spoil(in, out)`.
Fault spoiled(const std::string& name, const std::function<void(const StepIn&, StepOut&)>& spoil) {
  return {"step: " + name, Stage::step, [spoil](Contestant& contestant, const Authority&) {
            contestant.step = [right = contestant.step, spoil](const StepIn& in) {
              StepOut out = right(in);
              spoil(in, out);
              return out;
            };
          }};
}

/// Marks a fault that only cases of one generator reveal, so that the test uses more of them.
Fault shown_by(const std::string& generator, Fault fault) {
  fault.generator = generator;
  return fault;
}

/// Lowers the re-detection count from ⌈γ_e K⌉ to max(1, ⌊γ_e K⌋), where K is the number of moving vertices. Sets γ_e to
/// (⌊γ_e K⌋ − 1/2)/K.
void round_threshold_down(Scene& scene) {
  const std::vector<Index> groups = rigid_groups(scene);
  const auto moving = static_cast<double>(
      std::count_if(groups.begin(), groups.end(), [](Index group) { return group != 0; }));
  const double floor = std::floor(scene.settings.detection_fraction * moving);
  if (floor >= 1) scene.settings.detection_fraction = (floor - 0.5) / moving;
}

bool is_detection(const StepEvent& event) { return event.kind == StepEventKind::detection; }

/// Removes all detections between iterations.
void detect_before_iterations_only(const StepIn&, StepOut& out) {
  const auto first_sweep = std::find_if(out.events.begin(), out.events.end(),
                                        [](const StepEvent& event) { return event.kind == StepEventKind::sweep; });
  out.events.erase(std::remove_if(first_sweep, out.events.end(), is_detection), out.events.end());
}

void keep_first_previous(const StepIn&, StepOut& out) {
  for (StepEvent& event : out.events)
    if (is_detection(event)) event.position = out.events.front().position;
}

using Places = std::vector<reference::Triple<double>>;
using GuessContacts = std::vector<reference::GuessContact>;

/// A wrong rule for the move that contacts leave to vertex v: it changes the contacts or the targets y.
using Wrong = std::function<void(GuessContacts&, const Places& previous, Places& target, std::size_t v)>;

/// Returns a fault that applies `wrong` to the moves of the guess loop's first round if bounds=ball. The rest of the
/// step is right. If `sign` is −1, the move that contacts leave is reversed.
Fault held_wrongly(const std::string& name, const Wrong& wrong, double sign = 1) {
  return spoiled(name, [wrong, sign](const StepIn& in, StepOut& out) {
    const Settings& settings = in.scene->settings;
    if (settings.bounds != Bounds::ball || out.events.size() < 2) return;
    const StepEvent& detection = out.events[0];
    const GuessContacts contacts = reference::guess_contacts(
        *in.scene, *in.topology, out.rest, detection.vertex_facet.contacts, detection.edge_edge.contacts);
    const std::vector<Index> groups = rigid_groups(*in.scene);
    Places previous, target;
    for (const Vec3f& x : detection.position) previous.push_back({x.x, x.y, x.z});
    for (const Vec3f& y : out.target) target.push_back({y.x, y.y, y.z});
    const auto place = [&](const GuessContacts& held_by, const Places& to, std::size_t v) {
      return reference::HeldMoves(groups, settings.contact_radius).round(held_by, previous, to)[v];
    };
    for (std::size_t v = 0; v < groups.size(); ++v) {
      if (groups[v] != -1) continue;
      GuessContacts others = contacts;
      Places to = target;
      wrong(others, previous, to, v);
      const auto x = previous[v] + sign * (place(others, to, v) - previous[v]);
      if (x == place(contacts, target, v)) continue;
      const Vec3f y{static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])};
      const TruncateTruth truth = reference::truncate({{detection.position[v]}, {y}, {detection.bound[v]}});
      out.events[1].position[v] = reference::stored_within(truth.position[0], detection.position[v],
                                                           detection.bound[v]);
    }
  });
}

void ignore_partners(GuessContacts&, const Places& previous, Places& target, std::size_t v) {
  const auto own = target[v];
  target = previous;
  target[v] = own;
}

/// Reverses the move of v, removes friction, and treats other vertices as at rest. If its `sign` is −1, held_wrongly
/// reverses the result again. So contacts remove the part of the move that leads away from them.
void take_leaving(GuessContacts& contacts, const Places& previous, Places& target, std::size_t v) {
  for (reference::GuessContact& contact : contacts) contact.friction = 0;
  ignore_partners(contacts, previous, target, v);
  target[v] = previous[v] - (target[v] - previous[v]);
}

/// Makes cut vertices slide along their half-spaces in the first round, although bounds=dat must scale their moves.
void slide_with_dat(const StepIn& in, StepOut& out) {
  if (in.scene->settings.bounds != Bounds::dat) return;
  const StepEvent& detection = out.events[0];
  for (std::size_t v = 0; v < out.target.size(); ++v) {
    const Vec3f& x = detection.position[v];
    const TruncateIn question{{x},
                              {out.target[v]},
                              {detection.bound[v]},
                              half_spaces_of(detection.planes.of(static_cast<Index>(v)), x, false)};
    const TruncateTruth truth = reference::truncate(question);
    if (truth.cut[0] != 0) out.events[1].position[v] = reference::stored_in_region(truth.position[0], question, 0);
  }
}

/// Finds vertices that half-spaces stopped in an iteration. Moves each of them sideways off its path, but keeps it
/// inside its region.
void stop_beside_the_way(const StepIn& in, StepOut& out) {
  if (in.scene->settings.bounds != Bounds::dat) return;
  const StepEvent* detection = nullptr;
  for (StepEvent& event : out.events) {
    if (is_detection(event)) detection = &event;
    if (event.kind != StepEventKind::sweep) continue;
    for (std::size_t v = 0; v < event.position.size(); ++v) {
      Vec3f& x = event.position[v];
      const Vec3f& p = detection->position[v];
      const Vec3 way{double{x.x} - p.x, double{x.y} - p.y, double{x.z} - p.z};
      for (const VertexPlane& plane : detection->planes.of(static_cast<Index>(v))) {
        const Vec3 n{plane.normal.x, plane.normal.y, plane.normal.z};
        if (n.x * x.x + n.y * x.y + n.z * x.z < plane.offset - 0x1p-20 * std::abs(plane.offset)) continue;
        const Vec3 aside{n.y * way.z - n.z * way.y - 0.1 * way.x, n.z * way.x - n.x * way.z - 0.1 * way.y,
                         n.x * way.y - n.y * way.x - 0.1 * way.z};
        x = {static_cast<float>(x.x + 0.1 * aside.x), static_cast<float>(x.y + 0.1 * aside.y),
             static_cast<float>(x.z + 0.1 * aside.z)};
        break;
      }
    }
  }
}

/// In detections between iterations, too, divides each gap in proportion to the predicted motion y − x of its sides.
void divide_by_prediction(const StepIn& in, StepOut& out) {
  const Settings& settings = in.scene->settings;
  if (settings.bounds != Bounds::dat) return;
  const Exclusions excluded = exclusions(*in.scene);
  const std::vector<std::uint8_t> is_fixed = fixed_flags(excluded.groups);
  for (std::size_t i = 1; i < out.events.size(); ++i) {
    StepEvent& event = out.events[i];
    if (!is_detection(event) || out.events[i - 1].kind != StepEventKind::sweep) continue;
    const std::vector<Vec3f> displacement = displacements(event.position, out.target);
    event.planes = reference::pair_planes({in.topology, excluded, event.position, is_fixed, out.query_radius,
                                           static_cast<float>(settings.bounds_relaxation), displacement})
                       .planes;
  }
}

/// Finds contacts with volumes where the volumes were at the start of the step.
void ask_volumes_of_before(const StepIn& in, StepOut& out) {
  const reference::SceneVolumes volumes(*in.scene, *in.topology);
  const std::vector<Vec3f> start = to_single(in.scene->mesh.positions);
  const std::vector<bool> is_volume = volume_flags(*in.scene);
  for (StepEvent& event : out.events) {
    if (!is_detection(event)) continue;
    std::vector<Vec3f> positions = event.position;
    for (std::size_t v = 0; v < positions.size(); ++v)
      if (is_volume[v]) positions[v] = start[v];
    event.volumes = volumes.contacts(positions);
  }
}

/// Uses the first detection's contacts with volumes in all other detections.
void keep_contacts_with_volumes(const StepIn&, StepOut& out) {
  for (StepEvent& event : out.events)
    if (is_detection(event)) event.volumes = out.events.front().volumes;
}

/// Keeps volumes at their start in the first detection, so that they move only in the guess loop, with the other
/// vertices.
void let_volumes_lag(const StepIn& in, StepOut& out) {
  const std::vector<Vec3f> start = to_single(in.scene->mesh.positions);
  const std::vector<bool> is_volume = volume_flags(*in.scene);
  for (std::size_t v = 0; v < is_volume.size(); ++v)
    if (is_volume[v]) out.events.front().position[v] = start[v];
}

/// Removes the detection that follows an iteration if the iteration left a vertex deep inside a volume.
void ask_nothing_inside(const StepIn& in, StepOut& out) {
  const std::vector<VolumeContact>* contacts = nullptr;
  for (std::size_t i = 0; i + 1 < out.events.size(); ++i) {
    const StepEvent& event = out.events[i];
    if (is_detection(event)) contacts = &event.volumes.contacts;
    if (event.kind != StepEventKind::sweep || event.cut == 0 || !is_detection(out.events[i + 1])) continue;
    if (reference::depth_of(*contacts, *in.topology, event.position, in.scene->settings.contact_radius) ==
        reference::Depth::deep)
      out.events.erase(out.events.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
}

/// Returns a fault of the step that only scenes with volumes reveal.
Fault about_volumes(const std::string& name, const std::function<void(const StepIn&, StepOut&)>& spoil) {
  return shown_by("volume", spoiled(name, spoil));
}

/// Returns a fault of the step that only scenes with free volumes reveal.
Fault about_free_volumes(const std::string& name, const std::function<void(const StepIn&, StepOut&)>& spoil) {
  return shown_by("free_volume", spoiled(name, spoil));
}

/// Removes the contacts of a volume's vertices with other volumes.
void ask_from_surfaces_alone(const StepIn& in, StepOut& out) {
  const std::vector<bool> is_volume = volume_flags(*in.scene);
  for (StepEvent& event : out.events)
    std::erase_if(event.volumes.contacts,
                  [&](const VolumeContact& c) { return is_volume[static_cast<std::size_t>(c.point)]; });
}

/// Treats volumes as surfaces: they get surface contacts and bounds.
void bound_volumes(Scene& scene) {
  for (Body& body : scene.bodies) body.contact = BodyContact::surface;
}

/// Tells whether a rule ends the iterations of a step after `event`. `before` is the event before it; if `detects`, a
/// detection follows it.
using EndsAfter = std::function<bool(const StepIn& in, const StepEvent& before, const StepEvent& event, bool detects)>;

/// Returns the largest move of a vertex between two events [m]; `size` measures the move of one vertex.
template <class Size>
double largest_move(const StepEvent& before, const StepEvent& event, Size size) {
  double largest = 0;
  for (std::size_t v = 0; v < event.position.size(); ++v) {
    const Vec3f &a = before.position[v], &b = event.position[v];
    largest = std::max(largest, size(double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z));
  }
  return largest;
}

/// Returns whether no vertex moved farther than settled_move along an axis.
bool is_still(const StepIn& in, const StepEvent& before, const StepEvent& event) {
  const auto along_axes = [](double x, double y, double z) {
    return std::max({std::abs(x), std::abs(y), std::abs(z)});
  };
  return largest_move(before, event, along_axes) <= in.scene->settings.settled_move;
}

bool settles(const StepIn& in, const StepEvent& before, const StepEvent& event, bool detects) {
  return is_still(in, before, event) && event.cut == 0 && !detects;
}
bool settles_with_cuts(const StepIn& in, const StepEvent& before, const StepEvent& event, bool detects) {
  return is_still(in, before, event) && !detects;
}
bool settles_before_a_detection(const StepIn& in, const StepEvent& before, const StepEvent& event, bool) {
  return is_still(in, before, event) && event.cut == 0;
}
bool settles_by_length(const StepIn& in, const StepEvent& before, const StepEvent& event, bool detects) {
  const auto length = [](double x, double y, double z) { return std::hypot(x, y, z); };
  return largest_move(before, event, length) <= in.scene->settings.settled_move && event.cut == 0 && !detects;
}
/// Does not count prescribed vertices that lag as cut.
bool settles_with_lags(const StepIn& in, const StepEvent& before, const StepEvent& event, bool detects) {
  Index lagging = 0;
  for (const PrescribedMotion& motion : in.scene->motions) {
    const std::vector<Vec3f> targets = prescribed_targets(*in.scene, motion, in.scene->settings.time_step);
    for (std::size_t k = 0; k < targets.size(); ++k)
      lagging += !(event.position[static_cast<std::size_t>(motion.vertices[k])] == targets[k]);
  }
  return is_still(in, before, event) && event.cut == lagging && !detects;
}

/// Ends a step `late` events after the first iteration after which the rule ends it.
void end_by(const EndsAfter& ends, std::size_t late, const StepIn& in, StepOut& out) {
  std::size_t i = 1;
  const auto is_end = [&] {
    const StepEvent& event = out.events[i];
    return event.kind == StepEventKind::sweep && ends(in, out.events[i - 1], event, is_detection(out.events[i + 1]));
  };
  while (i + 1 < out.events.size() && !is_end()) ++i;
  out.events.resize(std::min(i + 1 + late, out.events.size()));
  out.position = out.events.back().position;
  const double h = in.scene->settings.time_step;
  for (std::size_t v = 0; v < out.position.size(); ++v) {
    const Vec3f& x = out.position[v];
    const Vec3& start = in.scene->mesh.positions[v];
    out.velocity[v] = {static_cast<float>((x.x - start.x) / h), static_cast<float>((x.y - start.y) / h),
                       static_cast<float>((x.z - start.z) / h)};
  }
}

/// Returns a fault that ends steps by a wrong rule if the scene has settled_move.
Fault settled_wrongly(const std::string& name, const EndsAfter& ends, std::size_t late = 0) {
  const auto plant = [ends, late](Contestant& contestant, const Authority&) {
    contestant.step = [right = contestant.step, ends, late](const StepIn& in) {
      if (in.scene->settings.settled_move == 0) return right(in);
      Scene whole = *in.scene;
      whole.settings.settled_move = 0;
      StepOut out = right({&whole, in.topology});
      end_by(ends, late, in, out);
      return out;
    };
  };
  return shown_by("settled", {"step: " + name, Stage::step, plant});
}

void velocity_from_last_detection(const StepIn& in, StepOut& out) {
  const auto last = std::find_if(out.events.rbegin(), out.events.rend(), is_detection);
  const double h = in.scene->settings.time_step;
  for (std::size_t v = 0; v < out.position.size(); ++v) {
    const Vec3f &x = out.position[v], &p = last->position[v];
    out.velocity[v] = {static_cast<float>((double{x.x} - p.x) / h), static_cast<float>((double{x.y} - p.y) / h),
                       static_cast<float>((double{x.z} - p.z) / h)};
  }
}

}  // namespace

std::vector<Fault> step_faults() {
  std::vector<Fault> faults{
      asked_wrongly("threshold rounded down", round_threshold_down),
      asked_wrongly("r_q without its cap", [](Scene& scene) { scene.settings.detection_radius_cap = 1000; }),
      asked_wrongly("detection_gap ignored", [](Scene& scene) { scene.settings.detection_gap = 1; }),
      asked_wrongly("one iteration too few", [](Scene& scene) { --scene.settings.iterations; }),
      asked_wrongly("prescribed targets of the next step",
                    [](Scene& scene) {
                      for (PrescribedMotion& motion : scene.motions)
                        motion.start -= scene.settings.time_step, motion.end -= scene.settings.time_step;
                    }),
      shown_by("settled", asked_wrongly("settled_move ignored", [](Scene& scene) { scene.settings.settled_move = 0; })),
      settled_wrongly("settles although vertices were cut", settles_with_cuts),
      settled_wrongly("settles although a detection is due", settles_before_a_detection),
      settled_wrongly("settles where every move's length is short", settles_by_length),
      settled_wrongly("settles one iteration late", settles, 1),
      shown_by("settled.planes", settled_wrongly("settles although prescribed vertices lag", settles_with_lags)),
      spoiled("no detection between iterations", detect_before_iterations_only),
      spoiled("X_prev of the first detection kept", keep_first_previous),
      held_wrongly("partners are taken to stand in the guess loop", ignore_partners),
      held_wrongly("what leaves a contact is held back in the guess loop", take_leaving, -1),
      spoiled("velocity since the last detection", velocity_from_last_detection),
      spoiled("a vertex that was cut not counted",
              [](const StepIn&, StepOut& out) {
                for (StepEvent& event : out.events) event.cut = std::max(0, event.cut - 1);
              }),
      spoiled("planes of the first detection kept",
              [](const StepIn&, StepOut& out) {
                for (StepEvent& event : out.events)
                  if (is_detection(event)) event.planes = out.events.front().planes;
              }),
      asked_wrongly("balls where planes are asked for", [](Scene& scene) { scene.settings.bounds = Bounds::ball; }),
      asked_wrongly("halved gaps and sliding where approach divides and nothing slides",
                    [](Scene& scene) {
                      if (scene.settings.bounds == Bounds::dat) scene.settings.bounds = Bounds::planes;
                    }),
      shown_by("dat", spoiled("sliding left on where approach divides", slide_with_dat)),
      shown_by("dat", spoiled("a vertex stops beside its way where approach divides", stop_beside_the_way)),
      shown_by("dat", spoiled("gaps of every detection divided by what inertia asks for", divide_by_prediction)),
      spoiled("two neighbours of one colour",
              [](const StepIn&, StepOut& out) {
                for (Index& colour : out.colour) colour = std::min(colour, 1);
              }),
      about_volumes("volumes of the step before", ask_volumes_of_before),
      about_volumes("contacts with volumes of the first detection kept", keep_contacts_with_volumes),
      about_volumes("volumes that lag", let_volumes_lag),
      about_volumes("a vertex left inside asks nothing", ask_nothing_inside),
      about_free_volumes("vertices of free volumes do not ask", ask_from_surfaces_alone),
      shown_by("volume", asked_wrongly("a volume that truncates", bound_volumes)),
      shown_by("volume",
               asked_wrongly("detection_deep ignored", [](Scene& scene) { scene.settings.detection_deep = 1; })),
  };
  return faults;
}

}  // namespace ogc::tests
