// Defines a search of a tree. One thread carries it out, four candidates at a time (fast/cpu/packed_search.hpp), or a
// warp carries out several together (fast/cuda/search.cuh).
//
// A Query is what the searches of one kind have in common:
//   bool is_off() const                                 nothing is to be searched
//   Search begin(int i) const                           the i-th search
//   bool is_pair(const Search&, const Offer&)           whether the primitive needs its distance taken; cheap, in
//                                                       single precision
//   float meet(const Search&, int primitive, float gap) takes the distance; returns a new limit for the search
// A search may offer primitives beyond the limit, too, in any order: no answer may depend on it.
#pragma once

#include "fast/kernels/bvh.hpp"

namespace ogc::fast {

/// Looks for all primitives at a place ≥ `from` whose box lies within the squared gap `limit` of `box`, or within their
/// own reach.
struct alignas(16) Search {  // read whole, by few instructions
  Box box;                   ///< of the vertex or edge that searches [m]
  int owner = -1;            ///< number of the vertex or edge that searches
  int from = 0;              ///< first place in the tree's order whose primitive is offered
  float limit = 0;           ///< squared [m²]; falls as distances are taken
  float reach = 0;           ///< of an edge: gap limit of its own reach [m²]
};

/// Holds `count` searches in one tree.
template <class Query>
struct Searches {
  TreeView tree;  ///< refitted at the positions that the query reads
  int count;      ///< number of searches; Query::begin numbers them
  Query query;
};

}  // namespace ogc::fast
