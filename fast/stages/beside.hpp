// Runs two loops in one launch, because an extra launch costs a device more than the items of a short loop.
#pragma once

#include "fast/kernels/arithmetic/qualifiers.hpp"

namespace ogc::fast {

/// Calls f(i) for i < first and g(i) for i < second. The launch has count() items. Neither functor may read what the
/// other writes.
template <class F, class G>
struct Beside {
  int first;
  F f;
  int second;
  G g;

  OGC_HD int count() const { return first > second ? first : second; }
  OGC_HD void operator()(int i) const {
    if (i < first) f(i);
    if (i < second) g(i);
  }
};

/// An empty loop.
struct Nothing {
  OGC_HD void operator()(int) const {}
};

/// Runs both loops in one launch.
template <class Backend, class F, class G>
void for_each_beside(Backend& backend, int first, const F& f, int second, const G& g) {
  const Beside<F, G> both{first, f, second, g};
  backend.for_each(both.count(), both);
}

}  // namespace ogc::fast
