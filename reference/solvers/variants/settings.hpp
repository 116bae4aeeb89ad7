// Settings with which ablations change the reference's solvers. They are not part of the method; with their defaults
// reference_vbd is the method.
#pragma once

#include "compare/problem/settings.hpp"

namespace ogc::reference {

/// Selects the contacts that a detection lists (contact_sets.hpp).
enum class ContactSet {
  /// each closest face whose block contains the contact point of the other side; each contact once (Alg. 1 and 2)
  ogc,
  pairs,  ///< the closest faces of each pair of primitives within r, as in IPC; blocks are not tested
  /// for each vertex the closest point of each other body, as with the gradient of an unsigned distance field
  distance
};
/// Selects the vertices that are updated together (colouring.hpp).
enum class Colouring {
  turned,   ///< greedy colours, shifted by k in the k-th component
  greedy,   ///< greedy colours in the order of the mesh
  random,   ///< greedy colours in an order drawn with the scene's seed
  vertex,   ///< one vertex at a time
  together  ///< all vertices at once (Jacobi)
};
/// Selects the factor of a contact's stiffness in a vertex's block; w is the vertex's weight in the contact points.
enum class ContactBlocks {
  majorised,  ///< |w| Σ |w_u|; the sum is over the contact's vertices that are updated together
  own         ///< w²
};
/// Returns whether the factor of a vertex's block includes the weights of the vertices that are updated together with
/// it.
constexpr bool majorises(ContactBlocks blocks) {
  switch (blocks) {
    case ContactBlocks::majorised: return true;
    case ContactBlocks::own: return false;
  }
  return true;
}
/// Selects when positions are truncated to their bounds.
enum class CutAfter {
  update,    ///< after each update, so that later updates read the truncated position
  iteration  ///< all vertices together, after the iteration
};
/// Returns whether each update truncates its vertex.
constexpr bool cuts_updates(CutAfter cut) {
  switch (cut) {
    case CutAfter::update: return true;
    case CutAfter::iteration: return false;
  }
  return true;
}

/// The values of reference_contact_set, reference_vbd_colours, reference_vbd_contact_blocks and
/// reference_vbd_cut_after.
struct Variants {
  ContactSet contact_set = ContactSet::ogc;                 ///< for all solvers of the reference
  Colouring colours = Colouring::turned;                    ///< for sweeps
  ContactBlocks contact_blocks = ContactBlocks::majorised;  ///< for sweeps
  CutAfter cut_after = CutAfter::update;                    ///< for sweeps
};

/// Reads the variants from the problem's settings.
Variants variants_of(const compare::Settings& settings);

}  // namespace ogc::reference
