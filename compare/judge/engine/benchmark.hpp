// Holds a question that can be asked again and again.
#pragma once

#include <cstdint>
#include <functional>

namespace ogc::compare {

/// A call for a clock: the question is made once and asked as often as needed.
struct BenchmarkCall {
  std::function<void()> ask;  ///< discards the answer; owns what the question points to
  std::int64_t items = 0;     ///< number of cases, or of vertices of a mesh
};

}  // namespace ogc::compare
