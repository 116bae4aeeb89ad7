// The smallest distance of contacts that act, which a row of a scene with rods reports: d_min of a segment is mostly
// the length of the one between it and the next but one.
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/rods/metrics.hpp"

namespace ogc::fast {

/// for_each_counted over the records of one kind.
template <class Record>
struct LowerContactDistance {
  const Record* records;  ///< of the last detection
  ContactTables tables;
  const Vec* position;    ///< x by vertex [m]
  float contact_radius;   ///< r [m]
  RodExtremes* extremes;  ///< on the backend

  OGC_HD void operator()(int i) const {
    const ContactIncidence contact = contact_of(tables, records[i]);
    if (!(contact.stiffness > 0)) return;
    Vec x[4];
    for (int k = 0; k < 4; ++k) x[k] = position[contact.index[k]];
    const ContactShape shape = contact_shape(weighted_sum(contact_weights(contact.kind, x), x), contact_radius);
    if (shape.acts) atomic_min(&extremes->contact, shape.distance);
  }
};

}  // namespace ogc::fast
