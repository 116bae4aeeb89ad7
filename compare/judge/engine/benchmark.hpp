// Holds a question that can be repeated.
#pragma once

#include <cstdint>
#include <functional>

namespace ogc::compare {

/// A question that is made once and asked as often as a benchmark needs.
struct BenchmarkCall {
  std::function<void()> ask;  ///< discards the answer; owns the data of the question
  std::int64_t items = 0;     ///< number of cases, or of vertices of a mesh
};

}  // namespace ogc::compare
