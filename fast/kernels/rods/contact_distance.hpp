// Computes the smallest distance of contacts that act, for the rows of scenes with rods. d_min would not do: for a
// segment it is mostly the length of the segment between it and the next but one.
#pragma once

#include "fast/kernels/contact_stream.hpp"

namespace ogc::fast {

/// Returns the distance of a record's contact if the contact acts, else a larger number.
template <class Record>
struct ActiveDistance {
  const Record* records;  ///< of the last detection
  ContactTables tables;
  const Vec* position;   ///< x by vertex [m]
  float contact_radius;  ///< r [m]

  OGC_HD float operator()(int i) const {
    constexpr float none = 3.40282347e38f;
    const ContactIncidence contact = contact_of(tables, records[i]);
    if (!(contact.stiffness > 0)) return none;
    Vec x[4];
    for (int k = 0; k < 4; ++k) x[k] = position[contact.index[k]];
    const ContactShape shape = contact_shape(weighted_sum(contact_weights(contact.kind, x), x), contact_radius);
    return shape.acts ? shape.distance : none;
  }
};

}  // namespace ogc::fast
