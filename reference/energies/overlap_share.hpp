// Computes e_k of nearly parallel edges without triangles (compare/stages/contact_force.hpp), over any number type.
#pragma once

#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// Returns x clamped to [0, 1], with the derivatives of the unclamped x. So the derivatives are valid on at least one
/// side of 0 and 1.
template <class T>
T within_unit(const T& x) {
  const double value = plain(x);
  return value < 0 ? x - T(value) : value > 1 ? (x - T(value)) + T(1.0) : x;
}

/// Returns the overlap of edges e and f, projected on e, divided by the length of the shorter edge. `between` is the
/// vector from the start of e to the start of f.
template <class T>
T overlap_share(const Triple<T>& e, const Triple<T>& f, const Triple<T>& between) {
  using std::sqrt;
  const T ee = dot(e, e), ff = dot(f, f);
  const T start = within_unit(T(dot(between, e) / ee)), end = within_unit(T(dot(between + f, e) / ee));
  const T part = plain(start) < plain(end) ? end - start : start - end;
  return plain(ff) < plain(ee) ? T(part * sqrt(ee / ff)) : part;
}

}  // namespace ogc::reference
