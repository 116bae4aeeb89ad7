// Converts the judge's case of a sweep to the data that the resident sweep reads, on the host.
#pragma once

#include <span>
#include <vector>

#include "compare/stages/sweep.hpp"
#include "fast/contact_view.hpp"
#include "fast/kernels/volumes/stream.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/rest_state.hpp"
#include "fast/stages/volume_parts.hpp"

namespace ogc::fast {

/// Holds the contacts of a case in the same arrays as a detection.
struct ContactRecords {
  std::vector<VertexFacetRecord> vertex_facet;  ///< by record
  std::vector<EdgeEdgeRecord> edge_edge;        ///< by record
  std::vector<int> offsets;                     ///< by row (RowNumbers): where it begins; one more number follows
};

/// Returns the contacts of a case. `places`: RowNumbers::place on the host.
ContactRecords contact_records(const compare::SweepIn& in, const std::vector<int>& places);

/// Returns, by row, the contacts between vertices of the case and volumes. `rest` has the materials.
std::vector<std::vector<VolumeIncidence>> volume_rows(const compare::SweepIn& in, const RestState& rest,
                                                      const AskerRows& asked);

/// Returns the colouring with these colours; −1: the vertex is not free.
Colouring colouring_of(std::span<const compare::Index> colour);

}  // namespace ogc::fast
