// Runs worlds' programs in one host thread, one world after the other. Tests of recording, control flow and growth need
// no device then, and the memory of a world is known before a device has it.
#pragma once

#include <chrono>
#include <cstring>
#include <type_traits>

#include "fast/cpu/least.hpp"
#include "fast/cpu/packed_gaps.hpp"
#include "fast/kernels/sweep/sums.hpp"
#include "fast/kernels/team.hpp"
#include "fast/worlds/backend.hpp"

namespace ogc::fast {

/// A block of one thread.
struct HostBlock {
  static int thread() { return 0; }
  static int threads() { return 1; }
  static void barrier() {}
  template <class F>
  static const F& reread(const F& f) {
    return f;
  }

  template <int W, class F>
  void team_loop(int n, const F& f) const {
    for (int i = 0; i < n; ++i) f(i, SerialTeam<W>{});
  }
  template <int W, class F>
  void group_loop(int n, const F& f) const {
    for (int i = 0; i < n; ++i) f(i);
  }
  template <class F>
  void row_loop(int n, const int* offsets, const float* values, const F& f) const {
    for (int i = 0; i < n; ++i) {
      const auto least = least_of_row<F::rank>(values, offsets[i], offsets[i + 1]);
      f(i, least[0], least[F::rank]);
    }
  }
  template <class Query>
  void search(const Searches<Query>& searches) const {
    if (searches.query.is_off()) return;
    for (int i = 0; i < searches.count; ++i) {
      Search search = searches.begin(i);
      for_each_near(searches.tree, search.box, search.from, search.limit, [&](const Offer& offer) {
        if (!searches.query.is_pair(search, offer)) return;
        const float limit = searches.query.meet(search, offer.primitive, offer.gap);
        if (limit < search.limit) search.limit = limit;
      });
    }
  }
  void scan(const Scan& scan) const {
    int total = 0;
    for (int i = 0; i < scan.count; ++i) {
      const int item = scan.in[i];
      scan.out[i] = total;
      total += item;
    }
    scan.out[scan.count] = total;
  }
};

/// A memory of the host, for Pool.
struct HostMemory {
  static void* allocate(std::size_t bytes) { return ::operator new (bytes, std::align_val_t{256}); }
  static void free(void* memory) noexcept { ::operator delete (memory, std::align_val_t{256}); }
  static void fill_zero(void* memory, std::size_t bytes) { std::memset(memory, 0, bytes); }
  static void copy_in(void* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
  static void copy_out(void* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
};

/// Runs worlds in one host thread.
struct HostPlace {
  using Data = HostMemory;
  using Shared = HostMemory;
  using Sums = HostSums;

  template <class Operation>
  static Code code() {
    return [](const void* arguments, void*) { (*static_cast<const Operation*>(arguments))(HostBlock{}); };
  }

  static int device() { return -1; }
  static void synchronize() {}

  static void run_program(const std::byte* program, int size) {
    for (int at = 0; at < size;) {
      const auto& instruction = *reinterpret_cast<const Instruction*>(program + at);
      const int next = at + instruction.size;
      switch (instruction.kind) {
        case Instruction::Kind::call:
          instruction.code(program + at + sizeof(Instruction), nullptr);
          at = next;
          break;
        case Instruction::Kind::go_unless: at = *instruction.flag == 0 ? instruction.target : next; break;
        case Instruction::Kind::go_if: at = *instruction.flag != 0 ? instruction.target : next; break;
      }
    }
  }

  static double run(const WorldJob* jobs, int count) {
    const auto begin = std::chrono::steady_clock::now();
    for (int w = 0; w < count; ++w)
      for (int s = 0; s < jobs[w].count; ++s) {
        const Segment& segment = jobs[w].segments[s];
        for (int k = 0; k < segment.times && (segment.goes_on == nullptr || *segment.goes_on != 0); ++k)
          run_program(segment.program, segment.size);
      }
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  }
};

}  // namespace ogc::fast
