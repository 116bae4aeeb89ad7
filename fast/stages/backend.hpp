// The interface of a backend. A stage (fast/stages/*.hpp) is the order of work, a template on the backend; a
// kernel (fast/kernels/*.hpp) is the mathematics, a functor over plain pointers. A backend brings memory, loops and a
// few collectives, and nothing else:
//
//   template <class T> using Buffer;     T trivially copyable; resident array; movable
//     Buffer(); T* data(); const T* data() const; std::size_t size() const;
//                                    data() is null until there was an item
//     void resize(std::size_t n);        host only, outside a step; keeps no content; never shrinks the allocation
//     void upload(const T*, std::size_t n); void download(T*, std::size_t n) const; void fill_zero();
//                                    host only, outside a step
//
//   for_each(int n, F f)                 f(i) for 0 ≤ i < n, in any order; no result may depend on the order. Or f(i,
//                                    f.ahead(i)), which reads nothing that this launch or the one before writes
//   for_each_counted(const int* n, int capacity, F f)
//                                    the same with a count that lives on the device, n ≤ capacity
//   for_both(int m, F f, const int* n, int capacity, G g)
//                                    for_each(m, f) and for_each_counted(n, capacity, g) side by side: neither reads
//                                    what the other writes; on a device it is one launch in place of two
//   for_each_team<W>(int n, F f, Start start)
//                                    f(i, team): team.sum<Accumulator>(parts...) once, with F::parts parts; the
//                                    order of its additions is that of fast/kernels/team.hpp, so only W can change a
//                                    bit; the thread where team.leader() holds has the total and writes it. Or all
//                                    teams of a launch leave (team.leave()) in place of the sum. Start::overlapping:
//                                    all that f reads before a Part's `add` is not written by the launch before
//   for_each_row(int n, const int* offsets, const float* values, F f)
//                                    f(i, least, after) for each row of numbers values[offsets[i]] …
//                                    values[offsets[i + 1] − 1], in any order: the smallest, and the one that
//                                    F::rank ≤ 31 others come before in ascending order; infinite where there is none
//   search(Searches first, Searches second)
//                                    two kinds of searches (fast/kernels/search.hpp) side by side
//   exclusive_scans(const Scan& first, const Scan& second)
//                                    of n numbers n + 1 sums each, the last is the total; neither reads what the
//                                    other writes
//   sort_pairs(std::uint64_t* keys, int* values, int n, KeyBits bits = {})
//                                    stable, ascending by these bits of the keys
//   when(F decide, const int* flag, Body body)
//                                    decide(0), then what body() enqueues if *flag is not 0 then; not nested
//   repeat(F decide, const int* flag, Body body, G decide_again)
//                                    decide(0), then while *flag is not 0 what body() enqueues and decide_again(0)
//   at_once(Aside aside, Body body)      what both enqueue, at once or one after the other: neither writes what the
//                                    other reads; aside() enqueues loops (for_each, …) alone; not nested
//   Recording recording;                 empty at first; recording.clear() after a change of what the body enqueues
//   replay(recording, int times, Body body)
//                                    enqueues body()'s work `times` times. A device backend runs body() on the host
//                                    once, records it as a graph and launches that, again in later calls, until a
//                                    Buffer has moved or the recording is cleared: the body enqueues the same calls
//                                    with the same arguments every time; step numbers are counted on the device
//   replay_milliseconds()                time of each repetition of all replays since it was asked last [ms]; after
//                                    synchronize
//   synchronize()                        host only, once a frame
//
// Calls are enqueued in order and may return before the work is done; nothing but synchronize and the Buffer copies
// waits. Functors get raw pointers and values, never a Buffer. Atomics: fast/kernels/arithmetic/atomic.hpp, whose
// result no order can change.
#pragma once

#include "fast/kernels/arithmetic/qualifiers.hpp"

namespace ogc::fast {

/// out[i] = in[0] + … + in[i − 1] for 0 ≤ i ≤ count; `out` may be `in`.
struct Scan {
  const int* in;  ///< on the backend
  int* out;       ///< on the backend, count + 1 sums
  int count;
};

/// Bits of a key that a sort looks at: from `begin` on, without `end`. A device takes a pass for each eight.
struct KeyBits {
  int begin = 0, end = 64;
};

/// Whether a launch begins when the one before it has ended, or may begin before.
enum class Start { after_previous, overlapping };

}  // namespace ogc::fast
