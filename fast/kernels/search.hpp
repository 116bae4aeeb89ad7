// Defines a search of a tree. A CPU thread runs one search and handles four candidates at a time
// (fast/cpu/packed_search.hpp). A warp runs several searches together (fast/cuda/search.cuh).
//
// A Query is what all searches of one kind have in common:
//   bool is_off() const                                 returns whether nothing is searched
//   Search begin(int i) const                           returns the i-th search
//   bool is_pair(const Search&, const Offer&)           returns whether the distance of the primitive must be
//                                                       computed; cheap, in single precision
//   float meet(const Search&, int primitive, float gap) computes the distance; returns a new limit for the search
// A search may also offer primitives beyond the limit, in any order. No result may depend on this.
#pragma once

#include "fast/kernels/bvh.hpp"

namespace ogc::fast {

/// Describes a search for all primitives, at place `from` or later, whose box is near `box`: the squared gap is at most
/// `limit`, or at most the gap limit of the primitive's own reach.
struct alignas(16) Search {  // aligned, so that few instructions read it whole
  Box box;                   ///< box of the vertex or edge that searches [m]
  int owner = -1;            ///< number of the vertex or edge that searches
  int from = 0;              ///< first place in the tree's order whose primitive is offered
  float limit = 0;           ///< squared gap [m²]; falls as distances are found
  float reach = 0;           ///< for an edge: gap limit of the edge's reach [m²]
};

/// Holds `count` searches in one tree.
template <class Query>
struct Searches {
  TreeView tree;  ///< refitted at the positions that the query reads
  int count;      ///< number of searches
  Query query;
  /// The searches are those of part `own` of several parts, which take runs of `run` searches in turn.
  int own = 0, parts = 1, run = 1;

  /// Returns the i-th search.
  OGC_HD Search begin(int i) const { return query.begin(((i / run) * parts + own) * run + i % run); }

  /// Returns those of all searches that part `p` of `n` makes. A run is long, because neighbours open the same nodes
  /// and lower each other's smallest distances; each part has many runs, because long searches are neighbours, too.
  Searches of_part(int n, int p) const {
    constexpr int runs_of_part = 64, longest_run = 1024;
    Searches of = *this;
    of.own = p, of.parts = n, of.run = count / (runs_of_part * n);
    of.run = of.run < 1 ? 1 : of.run < longest_run ? of.run : longest_run;
    const int runs = (count + of.run - 1) / of.run, own_runs = (runs - p + n - 1) / n;
    const bool has_last = own_runs > 0 && (runs - 1) % n == p;
    of.count = own_runs * of.run - (has_last ? runs * of.run - count : 0);
    return of;
  }
};

}  // namespace ogc::fast
