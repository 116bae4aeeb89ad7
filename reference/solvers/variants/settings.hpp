// Choices by which an ablation changes the reference's solvers. They are not part of the method; reference_vbd with the
// defaults is the method.
#pragma once

#include "compare/problem/settings.hpp"

namespace ogc::reference {

/// Selects the contacts that a detection lists (contact_sets.hpp).
enum class ContactSet {
  ogc,      ///< each closest face whose block holds the other side, once (Alg. 1 and 2)
  pairs,    ///< one for each pair of primitives within r, as in IPC, regardless of blocks
  distance  ///< the closest point of each other body, for each vertex: the gradient of an unsigned distance field
};
/// Selects the vertices that are updated together (colouring.hpp).
enum class Colouring {
  turned,   ///< greedy colours, shifted by k in the k-th component
  greedy,   ///< greedy colours in the order of the mesh
  random,   ///< greedy colours in an order drawn with the scene's seed
  vertex,   ///< one vertex at a time
  together  ///< all vertices at once (Jacobi)
};
/// Selects a contact's term of a vertex's block.
enum class ContactBlocks {
  majorised,  ///< w| Σ |w_u| over the contact's vertices that are updated together
  own         ///< w²
};
/// Returns whether a vertex's block includes the other vertices that are updated with it.
constexpr bool majorises(ContactBlocks blocks) {
  switch (blocks) {
    case ContactBlocks::majorised: return true;
    case ContactBlocks::own: return false;
  }
  return true;
}
/// Selects when a position is cut to its bound.
enum class CutAfter {
  update,    ///< at once, so that later updates read the cut position
  iteration  ///< all vertices together, after the iteration
};
/// Returns whether each update cuts its vertex.
constexpr bool cuts_updates(CutAfter cut) {
  switch (cut) {
    case CutAfter::update: return true;
    case CutAfter::iteration: return false;
  }
  return true;
}

/// Values of the settings reference_contact_set, reference_vbd_colours, reference_vbd_contact_blocks and
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
