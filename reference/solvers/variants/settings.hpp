// What an ablation changes in the reference's solvers: choices that the method has made, and others in their place.
// They are no part of the method; reference_vbd at their defaults is the method.
#pragma once

#include "compare/problem/settings.hpp"

namespace ogc::reference {

/// Which contacts a detection lists (contact_sets.hpp).
enum class ContactSet {
  ogc,      ///< each face that is closest and whose block holds the other side, once (Alg. 1 and 2)
  pairs,    ///< one of each pair of primitives within r, as IPC has them, whatever blocks say
  distance  ///< of each vertex the closest point of each other body: the gradient of an unsigned distance field
};
/// Who is updated together (colouring.hpp).
enum class Colouring {
  turned,   ///< greedily, and turned by one in each component
  greedy,   ///< greedily, in the order of the mesh
  random,   ///< greedily, in an order drawn with the scene's seed
  vertex,   ///< one vertex at a time
  together  ///< all at once (Jacobi)
};
/// What a contact adds to a vertex's block.
enum class ContactBlocks {
  majorised,  ///< |w| Σ |w_u| over its vertices that are updated together
  own         ///< w²
};
/// Whether a vertex's block counts the others that are updated with it.
constexpr bool majorises(ContactBlocks blocks) {
  switch (blocks) {
    case ContactBlocks::majorised: return true;
    case ContactBlocks::own: return false;
  }
  return true;
}
/// When a position is cut to its bound.
enum class CutAfter {
  update,    ///< at once, so that others read where it is kept
  iteration  ///< all vertices together
};
/// Whether each update cuts its vertex.
constexpr bool cuts_updates(CutAfter cut) {
  switch (cut) {
    case CutAfter::update: return true;
    case CutAfter::iteration: return false;
  }
  return true;
}

/// The settings contact_set, colours, contact_blocks and cut_after.
struct Variants {
  ContactSet contact_set = ContactSet::ogc;                 ///< of all solvers of the reference
  Colouring colours = Colouring::turned;                    ///< of sweeps
  ContactBlocks contact_blocks = ContactBlocks::majorised;  ///< likewise
  CutAfter cut_after = CutAfter::update;                    ///< likewise
};

/// As the problem carries them.
Variants variants_of(const compare::Settings& settings);

}  // namespace ogc::reference
