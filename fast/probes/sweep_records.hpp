// Converts the question of a sweep, on the host, to what the resident sweep reads.
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

/// Holds the contacts of a question as a detection would leave them.
struct ContactRecords {
  std::vector<VertexFacetRecord> vertex_facet;  ///< by record
  std::vector<EdgeEdgeRecord> edge_edge;        ///< by record
  std::vector<int> offsets;                     ///< of the incidences by vertex, vertex_count + 1
};

/// Returns the contacts of a question.
ContactRecords contact_records(const compare::SweepIn& in);

/// Returns the contacts with volumes of a question by row, with the materials of `rest`.
std::vector<std::vector<VolumeIncidence>> volume_rows(const compare::SweepIn& in, const RestState& rest,
                                                      const AskerRows& asked);

/// Returns the order of a sweep whose colours are given; −1: not free.
Colouring colouring_of(std::span<const compare::Index> colour);

}  // namespace ogc::fast
