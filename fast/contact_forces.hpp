// Computes energy, forces and blocks of contacts and friction for a solver outside this project, from the contacts of a
// ContactFinder (fast/contact_sets.hpp) or a Guard (fast/guard.hpp). The numbers are those that the sweep of `vbd`
// gathers (compare/method.md §4.2–§4.4, compare/stages/contact_force.hpp and friction_force.hpp), by the same kernels:
//
//   energy    E = Σ e_k g(d) over all contacts; friction has no energy
//   force     on vertex v: Σ −e_k g'(d) w n, with friction also Σ −μ λ f₁(‖u‖)/‖u‖ w u
//   block     of vertex v: Σ e_k g''(d) |w| Σ |w_u| n nᵀ, with friction also Σ μ λ f₁(‖u‖)/‖u‖ |w| Σ |w_u| (I − n nᵀ)
//
// Each contact of the sets counts once, however many pairs of primitives generate it. Two near vertices v and w may be
// the contacts (v, w), (w, v) and {v, w}; then all three count. d, n and the weights w are those of the closest points
// at the positions of the call, not at the detection. e_k is 1, except between two edge interiors; there it comes from
// the positions of the detection and the rest lengths, and stays until the next detection (§4.3). Σ |w_u| is over the
// vertices of the contact that are updated together with v, v included. A contact that the positions have left (d ≥ r)
// has no energy and no force, but its block has its value at r (§4.2). A contact that the positions enter later is
// missing until the next detection; a detection with query radius r_q ≥ r lists contacts with d < r only.
//
// Three things differ from a simulation. All contacts have one k_c and one μ, where a simulation takes the means of two
// bodies (§4.5). Contacts with volumes are not included. Every vertex has forces, also those that a solver holds.
//
// The force is −∂E/∂x, except that e_k counts as constant, and where the closest points of nearly parallel edges jump.
// Blocks are positive semidefinite. All sums have a fixed order, so the same input gives the same bits, on the CPU with
// any number of threads.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "compare/problem/settings.hpp"
#include "fast/contact_view.hpp"
#include "fast/contestant.hpp"
#include "fast/mesh.hpp"

namespace ogc::fast {

/// Parameters of contacts and friction; they never change.
struct ContactForceOptions {
  float contact_radius = 0;         ///< r > 0, that of the detections [m]
  float contact_stiffness = 0;      ///< k_c > 0 of all contacts [N/m]
  float friction = 0;               ///< μ ≥ 0 of all contacts [1]
  double friction_velocity = 0.01;  ///< ε_v > 0: slower sliding has less friction than μ λ [m/s]
  compare::ContactActivation contact_activation = compare::ContactActivation::ogc;  ///< g (method.md §4.2)
};

/// Holds contacts and the positions at which they were found.
struct FoundContacts {
  ContactView view;  ///< of a finder or a guard with the same mesh and backend, still valid
  /// X_prev by vertex [m]: what ContactFinder::find_resident was called with, or Guard::detected_at_resident; in the
  /// backend's memory
  const compare::Vec3f* detected_at = nullptr;
};

/// The motion that friction resists. Without a start there is no friction.
template <class Positions>
struct SlidingOf {
  Positions start{};     ///< xᵗ, positions at the start of the step, by vertex [m]
  double time_step = 0;  ///< h > 0 [s]
};
using Sliding = SlidingOf<std::span<const compare::Vec3f>>;
using SlidingResident = SlidingOf<const compare::Vec3f*>;

/// Energies of contacts [J].
struct ContactEnergy {
  double vertex_facet = 0, edge_edge = 0;  ///< sums over the contacts of each kind
  double total() const { return vertex_facet + edge_edge; }
};

/// A symmetric 3×3 matrix: xx, xy, xz, yy, yz, zz, as in compare::ForceOut.
using ContactBlock = std::array<float, 6>;

/// Holds the results on the host, by vertex.
struct ContactForceSums {
  ContactEnergy energy;
  std::vector<compare::Vec3f> force;     ///< of contacts and friction together [N]
  std::vector<compare::Vec3f> friction;  ///< of friction alone [N]; zeros without friction
  std::vector<ContactBlock> block;       ///< of contacts and friction together [N/m]
};

/// Names arrays in the backend's memory, by vertex, that receive results. Those that are null are left out.
struct ContactForceArrays {
  compare::Vec3f* force = nullptr;     ///< as in ContactForceSums [N]
  compare::Vec3f* friction = nullptr;  ///< as in ContactForceSums [N]
  ContactBlock* block = nullptr;       ///< as in ContactForceSums [N/m]
};

/// Does the work of ContactForces on one backend, for checked input.
class ContactForceEngine {
 public:
  virtual ~ContactForceEngine() = default;
  /// Implement the functions of ContactForces with the same names.
  virtual ContactForceSums evaluate(const FoundContacts& contacts, std::span<const compare::Vec3f> positions,
                                    const Sliding& sliding) = 0;
  virtual ContactEnergy evaluate_resident(const FoundContacts& contacts, const compare::Vec3f* positions,
                                          const SlidingResident& sliding, const ContactForceArrays& out) = 0;
};

/// Computes energy, forces and blocks of the contacts of one mesh. Only one thread at a time may use it.
class ContactForces {
 public:
  /// `rest`: positions whose edges have the rest lengths ē of the mollifier [m]; only edges of triangles have one.
  /// `colours`: numbers ≥ 0 by vertex; vertices with the same number are updated together, which enlarges their blocks.
  /// If empty, each vertex is updated alone, and blocks have w². If all numbers are equal, all vertices are updated at
  /// once (Jacobi). Throws compare::InputError if the numbers of positions or colours are not the mesh's, a coordinate
  /// is not finite, a colour is negative, or an option is out of range; the message names the argument, the vertex and
  /// the value. Throws compare::ResourceError if `contestant(backend)` throws it, or if memory is used up.
  ContactForces(Mesh mesh, std::span<const compare::Vec3f> rest, const ContactForceOptions& options,
                Backend backend = Backend::cpu, std::span<const compare::Index> colours = {});

  /// Return mesh and options.
  const Mesh& mesh() const { return mesh_; }
  const ContactForceOptions& options() const { return options_; }

  /// Returns energy, forces and blocks at `positions` [m]; positions and results are on the host. Throws
  /// compare::InputError if there are no contacts of a detection, the number of positions or start positions is not the
  /// mesh's, a coordinate is not finite, or start positions are given and h is out of range.
  ContactForceSums evaluate(const FoundContacts& contacts, std::span<const compare::Vec3f> positions,
                            const Sliding& sliding = {});

  /// Does the same with positions and results in the backend's memory (device memory for Backend::cuda). Returns the
  /// energy. Results are complete on return; they must not overlap what is read. Streams are those of Guard.
  /// Coordinates are not checked. Throws compare::InputError if there are no contacts of a detection, h is out of
  /// range, or the device cannot read an argument.
  ContactEnergy evaluate_resident(const FoundContacts& contacts, const compare::Vec3f* positions,
                                  const SlidingResident& sliding, const ContactForceArrays& out);

 private:
  Mesh mesh_;
  ContactForceOptions options_;
  std::unique_ptr<ContactForceEngine> engine_;
};

}  // namespace ogc::fast
