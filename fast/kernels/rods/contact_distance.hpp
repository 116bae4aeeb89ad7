// Computes the smallest distance among the contacts that exert a force, for the reports of scenes with rods. d_min is
// less useful there: usually it is the length of one segment, the distance of each segment from its second neighbour.
#pragma once

#include "fast/kernels/contact_stream.hpp"

namespace ogc::fast {

/// Returns the distance of the contact in record i if it exerts a force (0 < d < r); otherwise the largest float.
template <class Record>
struct ActiveDistance {
  const Record* records;  ///< from the last detection
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
