// Turns answers into bits, to compare them exactly; signs of zeros and payloads of NaNs count.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/stages/rest_state.hpp"
#include "compare/stages/step.hpp"

namespace ogc::compare {

/// Collects the bits of numbers in order.
class Bits {
 public:
  /// Adds a number, or a structure of numbers without padding.
  template <class T>
  void add(const T& value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  /// Adds an array: its length, then its entries.
  template <class T>
  void add(const std::vector<T>& values) {
    add(values.size());
    for (const T& value : values) add(value);
  }

  /// Adds a face member by member, because there is padding between members.
  void add(const Face& face) {
    add(face.kind);
    add(face.index);
  }
  /// Add answers member by member.
  void add(const VertexFacetContact& c) {
    add(c.vertex);
    add(c.face);
    add(c.owner);
  }
  void add(const EdgeEdgeContact& c) {
    add(c.first);
    add(c.second);
    add(c.first_edge);
    add(c.second_edge);
  }
  void add(const DetectVertexFacetOut& out) {
    add(out.contacts);
    add(out.d_min_vertex);
    add(out.d_min_triangle);
  }
  void add(const DetectEdgeEdgeOut& out) {
    add(out.contacts);
    add(out.d_min_edge);
  }
  void add(const VertexPlane& plane) {
    add(plane.pair.kind);
    add(plane.pair.first);
    add(plane.pair.second);
    add(plane.normal);
    add(plane.offset);
  }
  void add(const VolumeContact& c) {
    add(c.point);
    add(c.inside);
    add(c.triangle);
    add(c.face);
    add(c.weights);
    add(c.direction);
    add(c.depth);
  }
  void add(const PlaneOut& out) {
    add(out.planes.offsets);
    add(out.planes.items);
    add(out.bound);
  }
  void add(const RestStateOut& out) {
    add(out.mass);
    for_each_of<RestKinds>([&]<class Kind, std::size_t>() { add(out.*Kind::rest); });
    add(out.edge_length_squared);
    add(out.meetings);
  }
  void add(const SweepOut& out) {
    add(out.position);
    add(out.cut);
    add(out.orientation);
  }
  void add(const StepEvent& event) {
    add(event.kind);
    add(event.position);
    add(event.cut);
    add(event.vertex_facet);
    add(event.edge_edge);
    add(event.bound);
    add(event.planes.items);
    add(event.volumes.contacts);
    add(event.orientation);
  }
  void add(const StepOut& out) {
    add(out.colour);
    add(out.rest);
    add(out.query_radius);
    add(out.target);
    for (const StepEvent& event : out.events) add(event);
    add(out.position);
    add(out.velocity);
    add(out.segment_colour);
    add(out.turned);
    add(out.orientation);
  }

  /// Returns the bits collected so far and removes them.
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Returns the bits by case; entry i of each array belongs to case i.
template <class... Arrays>
std::vector<std::string> bits_by_case(std::size_t count, const Arrays&... arrays) {
  std::vector<Bits> bits(count);
  const auto add_entries = [&](const auto& array) {
    for (std::size_t i = 0; i < count && i < array.size(); ++i) bits[i].add(array[i]);
  };
  (add_entries(arrays), ...);
  std::vector<std::string> texts;
  for (Bits& one : bits) texts.push_back(one.take());
  return texts;
}

}  // namespace ogc::compare
