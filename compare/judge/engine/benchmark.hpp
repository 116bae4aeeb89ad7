// A question to ask again and again.
#pragma once

#include <cstdint>
#include <functional>

namespace ogc::compare {

/// Made once, then asked as often as a clock wants.
struct BenchmarkCall {
  std::function<void()> ask;  ///< throws the answer away; owns what the question looks at
  std::int64_t items = 0;     ///< cases, or vertices of a mesh
};

}  // namespace ogc::compare
