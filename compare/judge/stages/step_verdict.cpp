// Judges a step. Each event is judged by its own stage, starting from the answer's state before the event, so that the
// message names the first wrong event. The first wrong event ends the case, because later events may be too wrong to
// make legal questions.
#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/judge/engine/exact_sum.hpp"
#include "compare/judge/engine/rods/step_frames.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/engine/volume_question.hpp"
#include "compare/judge/stages/mesh_case.hpp"
#include "compare/judge/stages/verdict.hpp"
#include "compare/stages/rest_state.hpp"

namespace ogc::compare {

namespace {

const char* event_name(StepEventKind kind) {
  constexpr const char* names[] = {"detection", "guess", "sweep"};
  return names[std::min(2, static_cast<int>(kind))];
}

std::string where_of(const StepOut& out, std::size_t event) {
  return "event " + std::to_string(event) + ", " + event_name(out.events[event].kind);
}

class StepVerdict {
 public:
  StepVerdict(const TestCase& test, const StepIn& in, const StepTruth& truth, const StepOut& out,
              const Authority& authority, Tally& tally)
      : test_(test),
        in_(in),
        truth_(truth),
        out_(out),
        authority_(authority),
        tally_(tally),
        groups_(rigid_groups(*in.scene)),
        partners_(exclusions(*in.scene).partners),
        volumes_(*in.scene, *in.topology),
        start_(to_single(in.scene->mesh.positions)),
        at_(start_),
        wrong_before_(tally.mismatched) {
    // A driven volume is at its target from the start of the time step on.
    const std::vector<bool> is_volume = volume_flags(*in.scene);
    for (std::size_t v = 0; v < at_.size(); ++v)
      if (is_volume[v] && groups_[v] > 0) at_[v] = truth.prescribed_target[v];
  }

  void judge() {
    judge_parts();
    tally_.count(start_.size() * out_.events.size(), decisions_, grey_);
  }

 private:
  bool right() const { return tally_.mismatched == wrong_before_; }

  void judge_parts() {
    part("rest", Stage::rest_state, [&](Tally& own) {
      judge_rest_state(test_, authority_.rest_state({in_.scene, in_.topology}), out_.rest, own);
    });
    if (!right()) return;
    judge_colours();
    judge_start_frames();
    judge_targets();
    tally_.error(0, in_units(std::abs(out_.query_radius - truth_.query_radius), truth_.query_radius_scale),
                 [&] { return text("%.9g, exact %.17g", out_.query_radius, truth_.query_radius); });
    if (right()) judge_events();
    if (right()) judge_end();
  }

  std::string where(std::size_t i) const { return where_of(out_, i); }
  static std::string vertex(std::size_t v) { return ": vertex " + std::to_string(v); }

  /// Judges one part of an event by its own stage, and adds the counts.
  template <class Judge>
  void part(const std::string& prefix, Stage stage, Judge judge) {
    Tally own(stage);
    judge(own);
    const GeneratorTally total = own.total();
    decisions_ += total.decisions;
    grey_ += total.grey;
    tally_.answered_not_exactly(total.not_exact);
    for (const Mismatch& item : own.mismatches)
      tally_.mismatch(prefix + " (stage " + std::string(stage_name(stage)) + "): " + item.message);
  }

  /// Accepts any colouring in which free vertices of one stencil have different colours.
  void judge_colours() {
    const auto& colour = out_.colour;
    for (std::size_t v = 0; v < colour.size(); ++v)
      if ((groups_[v] == -1) != (colour[v] >= 0) || colour[v] < -1)
        tally_.mismatch("colour" + vertex(v) + " has " + std::to_string(colour[v]));
    const auto apart = [&](const auto& vertices) {
      for (std::size_t i = 0; i < vertices.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
          if (vertices[i] >= 0 && vertices[k] >= 0 && colour[vertices[i]] >= 0 &&
              colour[vertices[i]] == colour[vertices[k]])
            tally_.mismatch("colour" + vertex(static_cast<std::size_t>(vertices[i])) + " shares that of vertex " +
                            std::to_string(vertices[k]));
    };
    if (!right()) return;
    for_each_of<ElementKinds>([&]<class Kind, std::size_t>() {
      for (const auto& element : Kind::elements(*in_.scene, out_.rest)) apart(Kind::vertices(element));
    });
    if (const std::string wrong = wrong_segment_colour(*in_.scene, out_); !wrong.empty()) tally_.mismatch(wrong);
  }

  /// Judges the frames that rotated, as cases of stage initial_guess (InitialGuessIn::turns). `wrong` says what is
  /// wrong with the other frames; empty if nothing is.
  void judge_frames(const std::string& when, const TurnedFrames& frames, const std::string& wrong) {
    if (!wrong.empty()) tally_.mismatch(when + ": " + wrong);
    if (frames.in.turns.empty()) return;
    part(when, Stage::initial_guess, [&](Tally& own) {
      judge_turns({&test_, 1}, frames.in, authority_.initial_guess(frames.in), frames.out, own);
    });
  }

  void judge_start_frames() {
    if (const std::string wrong = wrong_orientation_count(*in_.scene, out_); !wrong.empty())
      return tally_.mismatch(wrong);
    if (!right()) return;
    std::string wrong;
    const TurnedFrames frames = start_frames(in_, out_, wrong);
    judge_frames("start", frames, wrong);
  }

  void judge_turned_frames() {
    std::string wrong;
    const TurnedFrames frames = turned_frames(in_, out_, at_, wrong);
    judge_frames("after the guess", frames, wrong);
    q_ = out_.turned;
  }

  void judge_targets() {
    const Scene& scene = *in_.scene;
    const std::vector<Vec3f> velocity = to_single(scene.velocities);
    const Vec3f acceleration = to_single({scene.gravity})[0];
    InitialGuessIn question;
    for (std::size_t v = 0; v < start_.size(); ++v) {
      InitialGuessCase c;
      c.start = c.previous = start_[v];
      c.velocity = velocity[v];
      c.acceleration = acceleration;
      c.time_step = static_cast<float>(scene.settings.time_step);
      question.cases.push_back(c);
    }
    const InitialGuessTruth exact = authority_.initial_guess(question);
    for (std::size_t v = 0; v < start_.size(); ++v) {
      const Vec3f& y = out_.target[v];
      if (groups_[v] != -1) {
        if (!(y == (groups_[v] == 0 ? start_[v] : truth_.prescribed_target[v])))
          tally_.mismatch("target" + vertex(v) + " is not where its motion leads");
        continue;
      }
      const Vec3& x = exact.target[v];
      const double error = std::max({std::abs(y.x - x.x), std::abs(y.y - x.y), std::abs(y.z - x.z)});
      tally_.error(1, in_units(error, exact.target_scale[v]), [&] {
        return "target" + vertex(v) + text(" is %.4g m off, of %.4g", error, exact.target_scale[v]);
      });
    }
  }

  void judge_events() {
    const std::size_t common = std::min(truth_.events.size(), out_.events.size());
    for (std::size_t i = 0; i < common && right(); ++i) {
      const StepEvent& event = out_.events[i];
      if (event.kind != truth_.events[i]) {
        const std::string after = i > 0 ? std::to_string(out_.events[i - 1].cut) + " vertices having been cut"
                                        : "at the start";
        tally_.mismatch(where(i) + ": a " + event_name(truth_.events[i]) + " is due, " + after);
        return;
      }
      switch (event.kind) {
        case StepEventKind::detection: judge_detection(i); break;
        case StepEventKind::guess: judge_guess(i); break;
        case StepEventKind::sweep: judge_iteration(i); break;
      }
      at_ = event.position;
    }
    if (right() && out_.events.size() != truth_.events.size())
      tally_.mismatch("events: " + std::to_string(out_.events.size()) + " instead of " +
                      std::to_string(truth_.events.size()));
  }

  /// Checks that X_prev is x, that contact sets and smallest distances belong to X_prev, and that bounds follow from
  /// the answer's distances.
  void judge_detection(std::size_t i) {
    const StepEvent& event = out_.events[i];
    if (policy().divides) {
      const bool is_after_sweep = i > 0 && out_.events[i - 1].kind == StepEventKind::sweep;
      displacement_ = is_after_sweep ? displacements(detection_->position, at_) : displacements(at_, out_.target);
    }
    detection_ = &event;
    for (std::size_t v = 0; v < at_.size(); ++v)
      if (!(event.position[v] == at_[v]))
        tally_.mismatch(where(i) + vertex(v) + " has an X_prev that is not its position");
    if (!right()) return;
    const TestCase mesh{test_.name,
                        MeshCase{case_of<StepCase>(test_.data).topology, groups_, event.position,
                                 static_cast<float>(in_.scene->settings.contact_radius), out_.query_radius, partners_}};
    const DetectIn question = detect_question(case_of<MeshCase>(mesh.data));
    part(where(i), Stage::detect_vertex_facet, [&](Tally& own) {
      const DetectVertexFacetTruth truth = authority_.detect_vertex_facet(question);
      judge_detect_vertex_facet(
          mesh, truth, policy().has_planes ? with_distances(event.vertex_facet, truth) : event.vertex_facet, own);
    });
    part(where(i), Stage::detect_edge_edge, [&](Tally& own) {
      const DetectEdgeEdgeTruth truth = authority_.detect_edge_edge(question);
      judge_detect_edge_edge(mesh, truth,
                             policy().has_planes ? with_distances(event.edge_edge, truth) : event.edge_edge, own);
    });
    judge_volumes(i);
    if (!right()) return;
    if (policy().has_planes) return judge_planes(i, question);
    const BoundIn bounds{in_.topology, event.vertex_facet.d_min_vertex, event.edge_edge.d_min_edge,
                         event.vertex_facet.d_min_triangle, static_cast<float>(in_.scene->settings.bounds_relaxation)};
    part(where(i), Stage::bound, [&](Tally& own) { judge_bound(test_, authority_.bound(bounds), {event.bound}, own); });
  }

  /// Judges the contacts, at X_prev, between volumes and vertices that they may push.
  void judge_volumes(std::size_t i) {
    const StepEvent& event = out_.events[i];
    if (!volumes_.has_any()) {
      if (!event.volumes.contacts.empty())
        tally_.mismatch(where(i) + " has contacts with volumes, of which there are none");
      return;
    }
    const TestCase asked{test_.name, volumes_.at(event.position)};
    std::string problem;
    const std::optional<VolumeDepthOut> own = volumes_.answer_of(event.volumes, problem);
    if (!own) return tally_.mismatch(where(i) + ": " + problem);
    const auto& question = case_of<VolumeDepthCase>(asked.data);
    part(where(i), Stage::volume_depth,
         [&](Tally& tally) { judge_volume_depth(asked, VolumeQuestion::truth(question, authority_), *own, tally); });
  }

  BoundsTraits policy() const { return traits_of(in_.scene->settings.bounds); }

  /// Returns the answer with the truth's smallest distances, because a contestant with planes need not give any.
  static DetectVertexFacetOut with_distances(DetectVertexFacetOut out, const DetectVertexFacetTruth& truth) {
    out.d_min_vertex = truth.exact.d_min_vertex;
    out.d_min_triangle = truth.exact.d_min_triangle;
    return out;
  }
  static DetectEdgeEdgeOut with_distances(DetectEdgeEdgeOut out, const DetectEdgeEdgeTruth& truth) {
    out.d_min_edge = truth.exact.d_min_edge;
    return out;
  }

  void judge_planes(std::size_t i, const DetectIn& detection) {
    const StepEvent& event = out_.events[i];
    const std::vector<std::uint8_t> is_fixed = fixed_flags(groups_);
    const PlaneIn question{in_.topology,      detection.exclusions,
                           event.position,    is_fixed,
                           out_.query_radius, static_cast<float>(in_.scene->settings.bounds_relaxation),
                           displacement_};
    const PlaneOut answer{event.planes, event.bound};
    part(where(i), Stage::plane, [&](Tally& own) {
      if (can_judge_plane(test_, question, answer, own))
        judge_plane(test_, question, authority_.plane(question, answer), answer, own);
    });
  }

  static std::string name_of(const PrimitivePair& pair) {
    const bool is_facet = pair.kind == PrimitivePair::Kind::vertex_triangle;
    return (is_facet ? "vertex " : "edges ") + std::to_string(pair.first) + (is_facet ? " and triangle " : " and ") +
           std::to_string(pair.second);
  }

  /// Numbers of vertices that a guess certainly cut, and may have cut.
  struct Cuts {
    Index certain = 0, doubtful = 0;
  };

  /// Judges the positions after a round of the guess loop. A vertex with contacts must be where its contacts let it
  /// move, truncated. Any other vertex must be at y, truncated. This vertex counts as cut if it is not exactly at y,
  /// because truncation changes only positions beyond the bound.
  void judge_guess(std::size_t i) {
    const StepEvent& event = out_.events[i];
    const std::span<const HeldMove> moves = i < truth_.moves.size() ? std::span<const HeldMove>(truth_.moves[i])
                                                                    : std::span<const HeldMove>{};
    Cuts cuts;
    for (std::size_t v = 0; v < at_.size(); ++v) {
      if (!moves.empty() && moves[v].touches != 0) {
        if (groups_[v] == -1)
          judge_held(i, v, moves[v], cuts);
        else
          judge_staying(i, v, moves[v]);
        if (groups_[v] == -1 || moves[v].grey == 0 || event.position[v] == at_[v]) continue;
      }
      const bool is_cut = !(event.position[v] == out_.target[v]);
      cuts.certain += is_cut;
      // in the guess loop H is the inertia term alone, which half_spaces_of sets
      const auto planes = detection_->planes.of(static_cast<Index>(v));
      const TruncateIn question{{at_[v]},
                                {out_.target[v]},
                                {detection_->bound[v]},
                                half_spaces_of(planes, at_[v], groups_[v] > 0 || !policy().slides)};
      part(where(i) + vertex(v), Stage::truncate, [&](Tally& own) {
        judge_truncate({&test_, 1}, question, authority_.truncate(question), {{event.position[v]}, {is_cut}}, own);
      });
    }
    if (event.cut < cuts.certain || event.cut > cuts.certain + cuts.doubtful)
      tally_.mismatch(where(i) + ": " + std::to_string(event.cut) + " vertices counted as cut, exact " +
                      std::to_string(cuts.certain) + " and " + std::to_string(cuts.doubtful) + " in doubt");
  }

  /// Judges a prescribed vertex in contact, which must not move from the second round on.
  void judge_staying(std::size_t i, std::size_t v, const HeldMove& held) {
    ++decisions_;
    grey_ += held.grey;
    if (held.grey == 0 && !(out_.events[i].position[v] == at_[v]))
      tally_.mismatch(where(i) + vertex(v) + " is prescribed, touches, and did not stay");
  }

  /// Checks exactly whether the stored position lies in the region of the last detection.
  bool is_in_region(std::size_t v, const Vec3f& x) const {
    if (!obeys_bound(x, at_[v], detection_->bound[v])) return false;
    return std::ranges::all_of(detection_->planes.of(static_cast<Index>(v)), [&](const VertexPlane& plane) {
      return obeys_half_space(x, {plane.normal, plane.offset});
    });
  }

  /// Returns by how much X_prev + `move` is inside of the region [m]; negative outside.
  double clearance(std::size_t v, const Vec3& move) const {
    double least = double{detection_->bound[v]} - std::hypot(move.x, move.y, move.z);
    for (const VertexPlane& plane : detection_->planes.of(static_cast<Index>(v))) {
      const Vec3f &n = plane.normal, &p = at_[v];
      least = std::min(least, plane.offset - n.x * (p.x + move.x) - n.y * (p.y + move.y) - n.z * (p.z + move.z));
    }
    return least;
  }

  /// Returns the distance [m] from x to the segment X_prev + s m, s in [first, last].
  double off_way(std::size_t v, const Vec3f& x, const Vec3& m, double first, double last) const {
    const Vec3f& p = at_[v];
    const Vec3 d{double{x.x} - p.x, double{x.y} - p.y, double{x.z} - p.z};
    const double squared = m.x * m.x + m.y * m.y + m.z * m.z, along = d.x * m.x + d.y * m.y + d.z * m.z;
    const double s = squared > 0 ? std::clamp(along / squared, first, last) : last;
    return std::hypot(d.x - s * m.x, d.y - s * m.y, d.z - s * m.z);
  }

  /// Judges a free vertex with contacts, which must be at the truncated X_prev + m. Truncation to a ball increases no
  /// distance, so the error limit of m also holds for the truncated move. If a region has half-spaces and vertices
  /// slide, a cut vertex may be at any point of the region. If they do not slide, a cut vertex is on the segment from
  /// X_prev to X_prev + m.
  void judge_held(std::size_t i, std::size_t v, const HeldMove& held, Cuts& cuts) {
    const Vec3f &x = out_.events[i].position[v], &p = at_[v];
    ++decisions_;
    grey_ += held.grey;
    if (!is_finite(x) || !is_in_region(v, x)) return tally_.mismatch(where(i) + vertex(v) + " is not in its region");
    const Vec3& m = held.move;
    const double length = std::hypot(m.x, m.y, m.z), bound = detection_->bound[v],
                 size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) + std::min(bound, length),
                 accepted = held.accepted + truncate_position_tolerance * unit_roundoff * size, room = clearance(v, m);
    cuts.certain += room < -accepted;
    cuts.doubtful += std::abs(room) <= accepted;
    const bool is_free = room > accepted, has_half_spaces = !detection_->planes.of(static_cast<Index>(v)).empty();
    if (has_half_spaces && !is_free && policy().slides) return;
    const double share = length > bound ? bound / length : 1;
    const double error = off_way(v, x, m, has_half_spaces && !is_free ? 0 : share, share);
    // For a vertex at the origin that does not move, the error and what is accepted are both 0.
    tally_.error(3, error > 0 ? error / accepted : 0, [&] {
      return where(i) + vertex(v) +
             text(", which touches, is %.4g m from where contacts let it go, %.4g accepted", error, accepted);
    });
  }

  void judge_iteration(std::size_t i) {
    const StepEvent& event = out_.events[i];
    if (!std::exchange(is_swept_, true)) judge_turned_frames();
    const SweepIn question{in_.scene,
                           in_.topology,
                           &out_.rest,
                           out_.colour,
                           at_,
                           start_,
                           out_.target,
                           detection_->position,
                           detection_->bound,
                           detection_->vertex_facet.contacts,
                           detection_->edge_edge.contacts,
                           policy().has_planes ? &detection_->planes : nullptr,
                           detection_->volumes.contacts,
                           out_.segment_colour,
                           q_,
                           out_.orientation_start};
    const SweepOut answer{event.position, event.cut, event.orientation};
    part(where(i), Stage::sweep, [&](Tally& own) {
      if (can_judge_sweep(test_, question, answer, own))
        judge_sweep(test_, question, authority_.sweep(question, answer), answer, own);
    });
    q_ = event.orientation;
  }

  void judge_end() {
    if (out_.orientation != q_) tally_.mismatch("end: orientations are not those that the last sweep left");
    for (std::size_t v = 0; v < start_.size(); ++v) {
      if (!(out_.position[v] == at_[v])) tally_.mismatch("end" + vertex(v) + " is not where the last event left it");
      const Vec3f& a = out_.velocity[v];
      const Vec3& b = truth_.velocity[v];
      const double error = std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
      tally_.error(2, in_units(error, truth_.velocity_scale[v]), [&] {
        return "end" + vertex(v) + text(" has a velocity %.4g m/s off, of %.4g", error, std::hypot(b.x, b.y, b.z));
      });
    }
  }

  const TestCase& test_;
  const StepIn& in_;
  const StepTruth& truth_;
  const StepOut& out_;
  const Authority& authority_;
  Tally& tally_;
  std::vector<Index> groups_;
  CompressedRows partners_;
  VolumeQuestion volumes_;
  std::vector<Vec3f> start_;
  std::vector<Vec3f> at_;                 ///< x before the event
  std::vector<Quaternion> q_;             ///< orientations of segments before the event
  bool is_swept_ = false;                 ///< true after the guess loop
  const StepEvent* detection_ = nullptr;  ///< the last detection
  std::vector<Vec3f> displacement_;       ///< with bounds=dat: displacements that divide gaps at the detection
  std::uint64_t wrong_before_, decisions_ = 0, grey_ = 0;
};

}  // namespace

bool can_judge_step(const TestCase& test, const StepIn& in, const StepOut& out, Tally& tally) {
  tally.begin(test.name);
  const std::size_t wanted = in.scene->mesh.positions.size();
  bool right = true;
  const auto check = [&](std::size_t length, const std::string& what) {
    if (length == wanted) return;
    tally.mismatch(what + " has " + std::to_string(length) + " entries instead of " + std::to_string(wanted));
    right = false;
  };
  check(out.colour.size(), "colour");
  check(out.target.size(), "target");
  check(out.position.size(), "position");
  check(out.velocity.size(), "velocity");
  for (std::size_t i = 0; i < out.events.size(); ++i) {
    check(out.events[i].position.size(), where_of(out, i) + ": position");
    if (out.events[i].kind == StepEventKind::detection) check(out.events[i].bound.size(), where_of(out, i) + ": bound");
  }
  return right;
}

void judge_step(const TestCase& test, const StepIn& in, const StepTruth& truth, const StepOut& out,
                const Authority& authority, Tally& tally) {
  tally.begin(test.name);
  StepVerdict(test, in, truth, out, authority, tally).judge();
}

}  // namespace ogc::compare
