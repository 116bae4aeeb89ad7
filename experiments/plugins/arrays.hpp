// Holds what all stages of a plug-in share on the judge's side: a topology as arrays, and arrays that come back as
// vectors and contacts.
#pragma once

#include <cstring>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "compare/stages/volume_depth.hpp"
#include "experiments/plugins/process.hpp"

namespace ogc::experiments {

/// Returns the sizes of a question whose cases stand alone.
QuestionSizes sizes_of(std::size_t cases);
/// Returns the sizes of a question about a mesh.
QuestionSizes sizes_of(const compare::Topology& topology);

/// Returns the arrays of ogc_topology, in its order.
std::vector<Bytes> inputs_of(const compare::Topology& topology);

/// Returns, by vertex, whether it is inside a solid; also if there is no solid.
std::vector<std::uint8_t> inside_solid(const compare::Topology& topology);

/// Returns a row for each of `count` vertices, all empty if there are no partners.
compare::CompressedRows rows_by_vertex(const compare::CompressedRows* partners, std::size_t count);

/// Turns outputs into vectors, one after another.
class Outputs {
 public:
  explicit Outputs(const PluginProcess::Answer& answer) : answer_(answer) {}
  /// Copies the next outputs, each into a vector of its element.
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

/// Returns a contact as the plug-in wrote it. All three throw compare::ContestantFailure for a kind of face that does
/// not exist.
compare::VertexFacetContact contact_of(const ogc_vertex_facet_contact& c);
/// Returns both halves of a contact with a volume as one.
compare::VolumeContact contact_of(const ogc_volume_contact& c, const ogc_volume_numbers& numbers);
/// Returns the contact in the judge's type.
compare::EdgeEdgeContact contact_of(const ogc_edge_edge_contact& c);

}  // namespace ogc::experiments
