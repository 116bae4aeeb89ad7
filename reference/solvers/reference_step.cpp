#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/problem/rods.hpp"
#include "compare/problem/volumes.hpp"
#include "reference/definitions/scene_volumes.hpp"
#include "reference/energies/rest_state.hpp"
#include "reference/geometry/bound.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "reference/geometry/pair_planes.hpp"
#include "reference/geometry/truncate.hpp"
#include "reference/solvers/colouring.hpp"
#include "reference/solvers/contacts.hpp"
#include "reference/solvers/detection.hpp"
#include "reference/solvers/guess_contacts.hpp"
#include "reference/solvers/initial_guess.hpp"
#include "reference/solvers/potential.hpp"
#include "reference/solvers/rods/rod_system.hpp"
#include "reference/solvers/step.hpp"
#include "reference/solvers/step_order.hpp"
#include "reference/solvers/sweep.hpp"

namespace ogc::reference {
namespace {

using compare::Index;
using compare::StepEvent;
using compare::StepEventKind;
using compare::Vec3;
using compare::Vec3f;

Vec3f single(const Vec3& a) { return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)}; }

class ReferenceStep {
 public:
  explicit ReferenceStep(const compare::StepIn& in)
      : in_(in),
        settings_(in.scene->settings),
        exclusions_(compare::exclusions(*in.scene)),
        moves_(exclusions_.groups, settings_.contact_radius),
        volumes_(*in.scene, *in.topology),
        is_volume_(compare::volume_flags(*in.scene)),
        start_(compare::to_single(in.scene->mesh.positions)),
        x_(start_) {}

  compare::StepOut run() {
    out_.rest = rest_state({in_.scene, in_.topology}).exact;
    out_.colour = colours_of(*in_.scene, out_.rest, exclusions_.groups);
    out_.orientation_start = q_ = start_orientations(*in_.scene, out_.rest);
    out_.segment_colour = segment_colours_of(out_.rest,
                                             compare::segment_groups(*in_.scene, compare::rod_segments(*in_.scene)));
    set_targets();
    for (std::size_t v = 0; v < x_.size(); ++v)
      if (is_volume_[v] && exclusions_.groups[v] >= 0) x_[v] = out_.target[v];
    out_.query_radius = static_cast<float>(step(in_, with_start()).query_radius);
    StepOrder order(settings_, compare::bounded_count(*in_.topology, exclusions_.groups));
    for (auto kind = order.next(); kind; kind = order.next()) {
      StepEvent event;
      event.kind = *kind;
      if (*kind == StepEventKind::detection)
        detect(event);
      else if (*kind == StepEventKind::guess)
        guess(event);
      else
        sweep(event);
      const bool is_deep = *kind == StepEventKind::sweep &&
                           depth_of(volume_contacts_, *in_.topology, x_, settings_.contact_radius) == Depth::deep;
      const bool is_round = *kind == StepEventKind::guess;
      order.took_place(event.cut,
                       lag_of(x_, previous_, out_.target, exclusions_.groups, settings_,
                              is_round ? moves_.stays() : std::vector<bool>{}),
                       is_deep);
      event.position = x_;
      out_.events.push_back(std::move(event));
    }
    out_.position = x_;
    out_.orientation = q_;
    out_.velocity.clear();
    for (const Vec3& v : step(in_, out_).velocity) out_.velocity.push_back(single(v));
    return std::move(out_);
  }

 private:
  /// Returns the answer so far, with positions at the start of the step.
  const compare::StepOut& with_start() {
    out_.position = start_;
    return out_;
  }

  void set_targets() {
    out_.target = start_;
    compare::InitialGuessIn question;
    const std::vector<Vec3f> velocity = compare::to_single(in_.scene->velocities);
    const Vec3f acceleration = compare::to_single({in_.scene->gravity})[0];
    for (std::size_t v = 0; v < start_.size(); ++v)
      question.cases.push_back(
          {start_[v], velocity[v], acceleration, static_cast<float>(settings_.time_step), start_[v], 0, 0});
    const compare::InitialGuessTruth guess = initial_guess(question);
    const std::vector<Vec3f> prescribed = step(in_, with_start()).prescribed_target;
    for (std::size_t v = 0; v < start_.size(); ++v) {
      if (exclusions_.groups[v] == -1) out_.target[v] = single(guess.target[v]);
      if (exclusions_.groups[v] > 0) out_.target[v] = prescribed[v];
    }
  }

  void detect(StepEvent& event) {
    std::vector<Vec3f> displacement;
    if (traits_of(settings_.bounds).divides)
      displacement = is_swept_ ? compare::displacements(previous_, x_) : compare::displacements(x_, out_.target);
    previous_ = x_;
    const compare::DetectIn question{in_.topology, exclusions_, x_, static_cast<float>(settings_.contact_radius),
                                     out_.query_radius};
    event.vertex_facet = detect_vertex_facet(question).exact;
    event.edge_edge = detect_edge_edge(question).exact;
    event.bound = bound({in_.topology, event.vertex_facet.d_min_vertex, event.edge_edge.d_min_edge,
                         event.vertex_facet.d_min_triangle, static_cast<float>(settings_.bounds_relaxation)})
                      .exact.bound;
    if (traits_of(settings_.bounds).has_planes) {
      const std::vector<std::uint8_t> is_fixed = compare::fixed_flags(exclusions_.groups);
      compare::PlaneOut held = pair_planes({in_.topology, exclusions_, x_, is_fixed, out_.query_radius,
                                            static_cast<float>(settings_.bounds_relaxation), displacement});
      event.bound = std::move(held.bound);
      event.planes = std::move(held.planes);
    }
    bound_ = event.bound;
    planes_ = event.planes;
    contacts_ = {event.vertex_facet.contacts, event.edge_edge.contacts};
    event.volumes = volumes_.contacts(x_);
    volume_contacts_ = event.volumes.contacts;
  }

  /// Returns whether v is scaled instead of sliding; for the guess loop, where x is X_prev.
  bool does_not_slide(std::size_t v) const { return exclusions_.groups[v] > 0 || !traits_of(settings_.bounds).slides; }

  /// Returns where v ends on its way to the proposal; adds a truncation to `cut`.
  Vec3f truncated(std::size_t v, const Vec3f& proposal, Index& cut) const {
    const auto planes = planes_.of(static_cast<Index>(v));
    const compare::TruncateIn question{
        {previous_[v]}, {proposal}, {bound_[v]}, half_spaces_of(planes, x_[v], does_not_slide(v))};
    const compare::TruncateTruth truth = truncate(question);
    if (truth.cut[0] == 0) return proposal;
    ++cut;
    return stored_in_region(truth.position[0], question, 0);
  }

  void guess(StepEvent& event) {
    const std::vector<Vec3f> proposals = held_targets();
    for (std::size_t v = 0; v < x_.size(); ++v) x_[v] = truncated(v, proposals[v], event.cut);
  }

  /// Returns where contacts let each vertex go.
  std::vector<Vec3f> held_targets() {
    const std::vector<GuessContact> contacts = guess_contacts(*in_.scene, *in_.topology, out_.rest,
                                                              contacts_.vertex_facet, contacts_.edge_edge);
    return rounded(moves_.round(contacts, widened(previous_), widened(out_.target)));
  }

  /// Turns frames as segments have turned from the start of the step to the end of the guess loop.
  void turn_frames() {
    if (q_.empty()) return;
    RodSystem rods(*in_.scene, out_.rest);
    rods.begin_step(widened(start_), 1);
    rods.turn(widened(x_));
    out_.turned = q_ = rods.orientations();
  }

  void sweep(StepEvent& event) {
    if (!is_swept_) turn_frames();
    is_swept_ = true;
    const std::vector<Vec3f> old = x_;
    const compare::SweepIn question{in_.scene,
                                    in_.topology,
                                    &out_.rest,
                                    out_.colour,
                                    old,
                                    start_,
                                    out_.target,
                                    previous_,
                                    bound_,
                                    contacts_.vertex_facet,
                                    contacts_.edge_edge,
                                    &planes_,
                                    volume_contacts_,
                                    out_.segment_colour,
                                    q_,
                                    out_.orientation_start};
    compare::SweepOut answer = reference_sweep(question, SweepStencils(question));
    x_ = std::move(answer.position);
    q_ = event.orientation = std::move(answer.orientation);
    event.cut = answer.cut;
  }

  const compare::StepIn& in_;
  const compare::Settings& settings_;
  bool is_swept_ = false;  ///< the guess loop is over
  compare::Exclusions exclusions_;
  HeldMoves moves_;
  SceneVolumes volumes_;
  std::vector<bool> is_volume_;  ///< by vertex
  std::vector<compare::VolumeContact> volume_contacts_;
  std::vector<Vec3f> start_, x_, previous_;
  std::vector<compare::Quaternion> q_;
  std::vector<float> bound_;
  compare::VertexPlanes planes_;
  ContactSets contacts_;
  compare::StepOut out_;
};

}  // namespace

compare::StepOut reference_step(const compare::StepIn& in) { return ReferenceStep(in).run(); }

}  // namespace ogc::reference
