// Guards the moves of a solver outside this project: the solver proposes where vertices go, the guard returns how far
// they may go so that no faces meet, neither there nor on the way.
//
// What is proved. The guard keeps a state, first the positions at its construction. Around the state of its last
// detection (X_prev) each vertex has a convex region, and no two faces meet while all vertices are in their regions
// (method.md §5.1, §5.6). `step` moves each vertex from the guard's state to a point of its region. Both ends of this
// straight way are in the region, so the whole way is. So every state, and every straight way from one state to the
// next, is free of intersections, whatever positions and moves the caller passes, in exact arithmetic on the stored
// numbers. Two conditions remain with the caller:
//
// - The positions at construction and those of `reset` must be free of intersections. The guard does not check this.
//   `ogc audit` does. If two faces touch there, nothing is proved of them.
// - The caller uses the returned positions as they are. If the caller moves on from others, the way to these is the
//   caller's; the guard still holds its own state, and the next step begins there.
//
// "Meet" is defined for pairs of a vertex and a triangle, and of two edges, that share no vertex and are not excluded
// by the mesh (method.md §2.3). No vertex is fixed or prescribed: the caller's moves decide, and a move of 0 from the
// guard's state keeps a vertex where it is.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "compare/problem/bounds.hpp"
#include "fast/contact_view.hpp"
#include "fast/contestant.hpp"
#include "fast/mesh.hpp"

namespace ogc::fast {

/// Parameters of a guard; they never change.
struct GuardOptions {
  /// r ≥ least_radius: range of the contacts that `contacts` lists [m]. The truncation does not depend on it. 0 acts as
  /// least_radius.
  float contact_radius = 0;
  /// r_q ≥ r, from least_radius to most_query_radius: range of the search [m]. No vertex moves farther than γ_p r_q
  /// between two detections.
  float query_radius = 0;
  compare::Bounds bounds = compare::Bounds::ball;  ///< `ball` (Eq. 21) or `planes` (method.md §5.6)
  float bounds_relaxation = 0.45F;                 ///< γ_p in (0, 0.5): share of a gap that each of its sides may take
  /// γ_e in [0, 1]. A step begins with a detection if the steps since the last detection cut at least max(1, γ_e K)
  /// vertices, K the number of vertices of the mesh. A vertex counts once for each step that cut it. So a single vertex
  /// that a bound holds causes a detection after γ_e K steps at the latest.
  double detection_fraction = 0.01;
};

/// What a step did. p is a vertex's proposal, s the guard's state before the step and x the state after it. A vertex is
/// cut if x ≠ p. Sums are over all vertices.
struct GuardReport {
  compare::Index cut = 0;  ///< number of vertices that were cut
  /// number of vertices whose proposal is not finite: they stay, count as cut, and enter no sum; only `step_resident`
  /// accepts such proposals
  compare::Index not_finite = 0;
  bool detected = false;  ///< whether the step began with a detection
  double asked = 0;       ///< Σ ‖p − s‖ [m]
  double lost = 0;        ///< Σ ‖p − x‖ over Σ ‖p − s‖ [1]; 0 if nothing was asked
  /// The parts of `lost` along and across the normal n of what cut the vertex: Σ |n·(p − x)| and Σ ‖(I − n nᵀ)(p − x)‖,
  /// each over Σ ‖p − s‖ [1]. They add up as squares, vertex by vertex, so they do not add up to `lost`. n is the
  /// normal of the half-space that p violates most. If p violates no half-space, the ball cut the vertex, and n is the
  /// direction from X_prev to p. A ball scales the way from X_prev to p, so what it takes is along n up to rounding,
  /// although it may be tangential to the neighbour from which the ball keeps the vertex. `ogc run --ledger` measures
  /// that (reference/ledger.md).
  double lost_normal = 0, lost_tangential = 0;
  /// vertex with the largest ‖p − x‖, compared in single precision; the lowest-numbered of equals; −1 if there is none
  compare::Index most_restricted = -1;
  float most_lost = 0;  ///< its ‖p − x‖ [m]
};

/// Does the work of a Guard on one backend, for checked input.
class GuardEngine {
 public:
  virtual ~GuardEngine() = default;
  /// Implement the functions of Guard with the same names.
  virtual void reset(std::span<const compare::Vec3f> positions) = 0;
  virtual void reset_resident(const compare::Vec3f* positions) = 0;
  virtual void detect() = 0;
  virtual GuardReport step(std::span<const compare::Vec3f> positions, std::span<const compare::Vec3f> moves,
                           std::span<compare::Vec3f> out) = 0;
  virtual GuardReport step_resident(const compare::Vec3f* positions, const compare::Vec3f* moves,
                                    compare::Vec3f* out) = 0;
  virtual std::vector<compare::Vec3f> positions() = 0;
  virtual const compare::Vec3f* positions_resident() const = 0;
  virtual int device_number() const = 0;
  virtual void wait_for_device() = 0;
  virtual ContactView contacts() = 0;
  virtual const compare::Vec3f* detected_at_resident() const = 0;
};

/// Keeps one mesh free of intersections. Only one thread at a time may use it.
///
/// Functions whose names end in `_resident` take and return pointers to the backend's memory (device memory for
/// Backend::cuda), one vector for each vertex. Coordinates are not checked. Such a function works on a stream that
/// synchronises with the legacy default stream, so the caller's work on a non-blocking stream must be complete before
/// the call. What the function writes is complete on return, and it has read its arguments by then. Throws
/// compare::InputError if the device cannot read an argument.
class Guard {
 public:
  /// Detects at `positions` [m], which must be free of intersections; no test can show later that they were not. Throws
  /// compare::InputError if the number of positions is not the mesh's, a coordinate is not finite or beyond
  /// most_coordinate, or an option is out of range; the message names the argument, the vertex and the value. Throws
  /// compare::ResourceError if `contestant(backend)` throws it, or if memory is used up.
  Guard(Mesh mesh, std::span<const compare::Vec3f> positions, const GuardOptions& options,
        Backend backend = Backend::cpu);

  /// Return mesh and options.
  const Mesh& mesh() const { return mesh_; }
  const GuardOptions& options() const { return options_; }

  /// Moves each vertex v to its proposal positions[v] + moves[v] [m], summed in single precision, or as near to it as
  /// its region allows, and writes the new state to `out` [m]. Detects first if it is due (GuardOptions). A proposal
  /// within the region is returned bit for bit. A ball stops a vertex on the way from X_prev to the proposal (Eq. 27);
  /// half-spaces let it slide (method.md §5.6). `positions` are usually the guard's state; if they are others, only the
  /// proposals change. `out` may be `positions` or `moves`. Throws compare::InputError if a length is not the number of
  /// vertices, or if a coordinate of an argument or of a proposal is not finite. Throws compare::ResourceError if a
  /// detection needs more memory than there is; the next step then begins with another one. In both cases the state is
  /// as before.
  GuardReport step(std::span<const compare::Vec3f> positions, std::span<const compare::Vec3f> moves,
                   std::span<compare::Vec3f> out);
  /// Does the same in the backend's memory.
  GuardReport step_resident(const compare::Vec3f* positions, const compare::Vec3f* moves, compare::Vec3f* out);

  /// Detects at the guard's state, which becomes X_prev: each vertex has the whole region about it again.
  void detect();

  /// Forgets the state and detects at `positions` [m], which must be free of intersections. Nothing is proved of the
  /// way from the old state. Throws as the constructor does.
  void reset(std::span<const compare::Vec3f> positions);
  /// Does the same with positions in the backend's memory, which must be finite.
  void reset_resident(const compare::Vec3f* positions);

  /// Returns the state [m].
  std::vector<compare::Vec3f> positions() const;
  /// Returns the state [m] in the backend's memory, valid until the next call that is not const. That call does not
  /// wait for what other streams still read: call `wait_for_device` before.
  const compare::Vec3f* positions_resident() const;
  /// Returns the number of the CUDA device with the memory; −1: it is the host's.
  int device_number() const;
  /// Waits for all work that the device has been given, of any stream.
  void wait_for_device();

  /// Returns contacts and bounds of the last detection, at X_prev, in the backend's memory; valid until the next
  /// detection. So a solver whose contact radius is r needs no other detection.
  ContactView contacts() const;
  /// Returns X_prev [m], the positions of the last detection, in the backend's memory; valid as long as `contacts`.
  const compare::Vec3f* detected_at_resident() const;

 private:
  Mesh mesh_;
  GuardOptions options_;
  std::unique_ptr<GuardEngine> engine_;
};

}  // namespace ogc::fast
