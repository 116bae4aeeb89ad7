// The interface of a backend. A stage (fast/stages/*.hpp) is the order of work: a template with the backend as
// parameter. A kernel (fast/kernels/*.hpp) is the mathematics: a functor over plain pointers. A backend supplies
// memory, loops and a few collectives:
//
//   template <class T> using Buffer;     a resident array; movable; T is trivially copyable
//     Buffer(); T* data(); const T* data() const; std::size_t size() const;
//         data() is null until the buffer has had an item
//     void resize(std::size_t n);        host only, outside a step; keeps no content; never shrinks the allocation
//     void upload(const T*, std::size_t n); void download(T*, std::size_t n) const; void fill_zero();
//         host only, outside a step
//
//   template <class T> using Shared;     a Buffer that the host fills before a frame, or reads after it
//   bool has_free_branches               whether `when` and `repeat` cost no more than a launch
//   int device() const                   number of the CUDA device with the memory; −1: it is the host's
//
//   for_each(int n, F f)
//         calls f(i) for 0 ≤ i < n in any order; no result may depend on the order. If F has `ahead`: f(i, f.ahead(i));
//         `ahead` must not read what this or the previous launch writes
//   for_each_group<W>(int n, F f)
//         the same; on a device W threads run f(i, lanes) together for each i and share the functions of `lanes`
//         (OneLane in fast/kernels/team.hpp); the thread for which lanes.leader() holds writes
//   for_each_counted(const int* n, int capacity, F f)
//         the same with a count on the device, *n ≤ capacity
//   for_both(int m, F f, const int* n, int capacity, G g)
//         for_each(m, f) and for_each_counted(n, capacity, g) in any order, in one launch on a device; neither reads
//         what the other writes. If G has `load`, a device may call g(i, g.load(i)); `load` must not read what this
//         launch writes
//   for_each_team<W>(Teams teams, F f, Start start)
//         calls f(i, team) for 0 ≤ i < teams.count. f calls team.sum<Accumulator>(parts...) once, with F::parts parts,
//         in the order of fast/kernels/team.hpp, so only W can change a bit. The thread for which team.leader() holds
//         has the total and writes it. Instead of the sum, all teams of a launch may call team.leave(). With
//         Start::overlapping, f may begin before the previous launch ends. So that launch must not write what f reads
//         before team.sum, or what the parts `load`; it may write what `add` and `term` read
//   for_each_row(int n, const int* offsets, const float* values, F f)
//         calls f(i, least, after) for each row values[offsets[i]] … values[offsets[i + 1] − 1], in any order. least:
//         the smallest number; after: the number with F::rank ≤ 31 others before it in ascending order; infinite if
//         there is none
//   search(Searches first, Searches second)
//         runs two kinds of searches (fast/kernels/search.hpp) side by side
//   exclusive_scans(const Scan& first, const Scan& second)
//         writes n + 1 sums of n numbers each, the total last; neither scan reads what the other writes
//   sort_pairs(std::uint64_t* keys, int* values, int n, KeyBits bits = {})
//         sorts by these bits of the keys: stable, ascending
//   when(F decide, const int* flag, Body body)
//         runs decide(0), then, if *flag is not 0, the work that body() enqueues; not nested
//   repeat(F decide, const int* flag, Body body, G decide_again)
//         runs decide(0); as long as *flag is not 0, runs the work that body() enqueues and decide_again(0)
//   at_once(Aside aside, Body body)
//         runs the work of aside() and of body(), in any order; neither work writes what the other reads; aside()
//         enqueues loops (for_each, …) and scans only; body() may contain another at_once
//   Recording recording;
//         a recorded body, empty at first; clear() it if the body enqueues other calls
//   replay(recording, int times, Body body, const int* goes_on)
//         enqueues body()'s work `times` times. A device backend runs body() on the host once, records it as a graph,
//         and launches the graph, also in later calls. It records again if a Buffer has moved or the recording has been
//         cleared. So the body must enqueue the same calls with the same arguments every time; step numbers are counted
//         on the device. The body must have no effect once *goes_on (on the backend) is 0; a backend may then leave out
//         the other repetitions
//   meetings(), join(Hall& hall, int own), meet(int n, F send, G end)
//         only of a backend that may be one of several parts (fast/stages/parts.hpp). meetings(): the number of
//         meetings so far, on the backend. join: host only, once; waits for the other parts. meet: calls send(i) for
//         0 ≤ i < n, which may write into the memory of other parts; waits until every part has done so; calls end(0);
//         counts the meeting. All parts call it equally often, in the same order
//   replay_milliseconds()
//         returns the time of each repetition of all replays since the last call [ms]; after synchronize
//   synchronize()                        host only, once per frame
//   synchronize_device()                 host only; waits for the work of everybody on the device, not of this backend
//                                        alone
//
// Calls are enqueued in order and may return before the work is done. Only synchronize… and the Buffer copies wait.
// Functors get raw pointers and values, never a Buffer. Atomics are those of fast/kernels/arithmetic/atomic.hpp; their
// result does not depend on the order.
#pragma once

#include "fast/kernels/arithmetic/qualifiers.hpp"

namespace ogc::fast {

/// Writes out[i] = in[0] + … + in[i − 1] for 0 ≤ i ≤ count; `out` may be `in`.
struct Scan {
  const int* in;  ///< on the backend
  int* out;       ///< on the backend, count + 1 sums
  int count;
};

/// The bits of a key by which a sort compares: `begin` to `end` − 1. A device takes one pass for each eight bits.
struct KeyBits {
  int begin = 0, end = 64;
};

/// The teams of a launch: a number of teams, or those of one part.
struct Teams {
  int count;  ///< number of teams
  int whole;  ///< teams of this launch and of the same launch in other parts; decides which kernel a device runs

  Teams(int all) : count(all), whole(all) {}  // NOLINT: a number of teams is meant
  Teams(int own, int all) : count(own), whole(all) {}
};

/// Tells whether a launch begins after the end of the previous launch, or may begin earlier.
enum class Start { after_previous, overlapping };

}  // namespace ogc::fast
