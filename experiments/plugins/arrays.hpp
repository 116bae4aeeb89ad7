// Converts between the judge's types and a plug-in's arrays: topologies as inputs, outputs as vectors and contacts.
#pragma once

#include <cstring>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "compare/stages/volume_depth.hpp"
#include "experiments/plugins/process.hpp"

namespace ogc::experiments {

/// Returns the sizes of a question that consists of independent cases.
QuestionSizes sizes_of(std::size_t cases);
/// Returns the sizes of a question about a mesh.
QuestionSizes sizes_of(const compare::Topology& topology);

/// Returns the arrays of ogc_topology, in its order.
std::vector<Bytes> inputs_of(const compare::Topology& topology);

/// Returns for each vertex whether it is inside a solid. The array has full length even without a solid.
std::vector<std::uint8_t> inside_solid(const compare::Topology& topology);

/// Returns the rows of `partners`, one per vertex, or `count` empty rows if it is null.
compare::CompressedRows rows_by_vertex(const compare::CompressedRows* partners, std::size_t count);

/// Copies outputs into vectors, one after another.
class Outputs {
 public:
  explicit Outputs(const PluginProcess::Answer& answer) : answer_(answer) {}
  /// Copies the next outputs into the given vectors, one output each.
  template <class... Items>
  void to(Items&... items) {
    (next(items), ...);
  }

 private:
  template <class T>
  void next(std::vector<T>& items) {
    const auto& bytes = answer_.outputs[next_++];
    items.resize(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(items.data()), bytes.data(), items.size() * sizeof(T));
  }

  const PluginProcess::Answer& answer_;
  std::size_t next_ = 0;
};

/// Converts a contact. All three overloads throw compare::ContestantFailure if the contact names an unknown kind of
/// face.
compare::VertexFacetContact contact_of(const ogc_vertex_facet_contact& c);
/// Joins the two structures of a contact with a volume.
compare::VolumeContact contact_of(const ogc_volume_contact& c, const ogc_volume_numbers& numbers);
compare::EdgeEdgeContact contact_of(const ogc_edge_edge_contact& c);

}  // namespace ogc::experiments
