// Lays out the columns of contact sets in one piece of memory, so that they take one allocation and one copy.
#include "fast/contact_columns.hpp"

#include <algorithm>
#include <utility>

namespace ogc::fast {
namespace {

/// Columns begin at multiples of this, as allocations of a device do: consumers of arrays may rely on it [bytes].
constexpr std::size_t alignment = 256;

class HostMemory : public ColumnMemory {
 public:
  HostMemory(const ColumnMemory& from, std::size_t count) : bytes_(std::make_unique<std::byte[]>(count)) {
    from.download(bytes_.get(), count);
  }
  const std::byte* data() const override { return bytes_.get(); }
  void download(std::byte* to, std::size_t count) const override { std::copy_n(bytes_.get(), count, to); }

 private:
  std::unique_ptr<std::byte[]> bytes_;
};

/// Calls visit(column, rows) for each column, in the order of the memory.
template <class Columns, class Visit>
void for_each_column(Columns& columns, const ColumnLengths& lengths, Visit visit) {
  visit(columns.d_min_vertex, lengths.vertices);
  visit(columns.bound, lengths.vertices);
  visit(columns.d_min_edge, lengths.edges);
  visit(columns.d_min_triangle, lengths.triangles);
  visit(columns.vertex_facet, lengths.vertex_facet);
  visit(columns.edge_edge, lengths.edge_edge);
  visit(columns.vertex_facet_kind, lengths.vertex_facet);
  visit(columns.edge_edge_kind, lengths.edge_edge);
}

template <class T>
std::size_t size_of(std::span<const T>, std::size_t rows) {
  return (rows * sizeof(T) + alignment - 1) / alignment * alignment;
}

}  // namespace

std::size_t ColumnLengths::bytes() const {
  std::size_t bytes = 0;
  const ContactColumns none;
  for_each_column(none, *this, [&](auto column, std::size_t rows) { bytes += size_of(column, rows); });
  return bytes;
}

ContactColumns::ContactColumns(std::shared_ptr<const ColumnMemory> of, const ColumnLengths& lengths)
    : memory(std::move(of)) {
  const std::byte* place = memory->data();
  for_each_column(*this, lengths, [&]<class T>(std::span<const T>& column, std::size_t rows) {
    column = {reinterpret_cast<const T*>(place), rows};
    place += size_of(column, rows);
  });
}

ContactColumns ContactColumns::copied_to_host() const {
  if (device == on_host) return *this;
  const ColumnLengths lengths{bound.size(), d_min_edge.size(), d_min_triangle.size(), vertex_facet.size(),
                              edge_edge.size()};
  ContactColumns copy(std::make_shared<HostMemory>(*memory, lengths.bytes()), lengths);
  copy.smallest_distance = smallest_distance;
  return copy;
}

}  // namespace ogc::fast
