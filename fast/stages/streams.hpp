// Holds the streams of elements in the order of the sweep, by kind, and the elements' data at the start of a step.
// Streams are made once on the host and stay on the backend.
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "fast/kernels/sums/step_sums.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/rest_state.hpp"

namespace ogc::fast {

/// The stream of a kind on the host.
template <class Kind>
struct HostStream {
  std::vector<Row> rows;  ///< by slot; empty if there is no element
  std::vector<typename Kind::Incidence> incidences;
  std::vector<typename Kind::Beside> beside;  ///< by incidence; empty if no model of the scene reads it
};

/// Makes the stream of a kind. A vertex's elements are in ascending order. If an element contains a vertex twice, the
/// vertex's roles in it ascend, too.
template <class Kind>
HostStream<Kind> host_stream(const RestState& rest, const Colouring& colouring) {
  const AtRest<Kind>& all = at_rest<Kind>(rest);
  HostStream<Kind> stream;
  if (all.elements().empty()) return stream;
  std::vector<std::vector<std::pair<int, int>>> around(rest.mass.size());  // element, role
  int number = 0;
  for (const auto& element : all.elements()) {
    for (int role = 0; role < Kind::count(element); ++role)
      around[as_index(Kind::vertices(element)[role])].emplace_back(number, role);
    ++number;
  }
  const bool has_beside = all.reads_beside(rest);
  for (const int v : colouring.order) {
    const auto& own = around[as_index(v)];
    stream.rows.push_back({static_cast<int>(stream.incidences.size()), static_cast<int>(own.size())});
    for (const auto& [element, role] : own) {
      const ColourOrder encoded{colouring.colour.data(), colouring.colour[as_index(v)]};
      stream.incidences.push_back(Kind::seen(all.elements()[as_index(element)], element, role, encoded));
      if (has_beside) stream.beside.push_back(all.beside(element, role));
    }
  }
  return stream;
}

/// Copies the rows of a kind into the vertices, if its row_in_vertex is ≥ 0.
template <class Kind>
void put_rows(const HostStream<Kind>& stream, std::vector<SweepVertex>& vertices) {
  if constexpr (Kind::row_in_vertex >= 0) {
    for (std::size_t slot = 0; slot < stream.rows.size(); ++slot)
      vertices[slot].rows[Kind::row_in_vertex] = stream.rows[slot];
  }
}

/// Returns the free vertices by slot. Vertices store the rows of kinds with row_in_vertex ≥ 0.
template <class... All>
std::vector<SweepVertex> sweep_vertices(KindList<All...>, const RestState& rest, const Colouring& colouring,
                                        double time_step, const HostStream<All>&... streams) {
  std::vector<SweepVertex> vertices;
  for (const int v : colouring.order) {
    SweepVertex vertex;
    vertex.vertex = v;
    vertex.body = rest.body[as_index(v)];
    vertex.inertia = static_cast<float>(static_cast<double>(rest.mass[as_index(v)]) / (time_step * time_step));
    vertices.push_back(vertex);
  }
  (put_rows<All>(streams, vertices), ...);
  return vertices;
}

/// The resident elements and stream of a kind.
template <class Backend, class Kind>
class Stream {
 public:
  Stream(const RestState& rest, const HostStream<Kind>& host) {
    const AtRest<Kind>& all = at_rest<Kind>(rest);
    upload(rest_, all.elements());
    upload(rest_beside_, all.rest_beside());
    upload(by_body_, all.by_body(rest));
    if (Kind::row_in_vertex < 0) upload(rows_, host.rows);
    upload(incidences_, host.incidences);
    upload(beside_, host.beside);
    bool damps = false;
    for (int i = 0; i < count() && !damps; ++i) damps = all.damps(rest, i);
    if (has_start && damps) start_.resize(rest_.size());
  }

  int count() const { return static_cast<int>(rest_.size()); }  ///< elements

  /// Computes the elements' state at xᵗ (Kind::Start), which damping reads, if any element is damped. `start`: xᵗ, on
  /// the backend.
  void begin(Backend& backend, const Vec* start) {
    if constexpr (has_start) {
      if (start_.size() > 0) backend.for_each(count(), BeginElement<Kind>{rest_.data(), start, start_.data()});
    }
  }
  /// Puts the stream into a view.
  void complete(SweepView& view) const {
    auto& stream = Kind::stream(view);
    stream.incidences = incidences_.data();
    if constexpr (Kind::row_in_vertex < 0) stream.rows = rows_.data();
    if constexpr (requires { stream.beside; }) stream.beside = beside_.data();
    if constexpr (has_start) stream.start = start_.data();
    if constexpr (requires { stream.by_body; }) stream.by_body = by_body_.data();
  }
  /// Fills in what the elements' energy reads, except materials, models and positions.
  void complete(ElementsView<Kind>& elements) const {
    elements.rest = rest_.data();
    elements.beside = rest_beside_.data();
    elements.by_body = by_body_.data();
    elements.count = count();
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  static constexpr bool has_start = !std::is_same_v<typename Kind::Start, NoData>;

  template <class T>
  static void upload(Buffer<T>& buffer, const std::vector<T>& items) {
    buffer.upload(items.data(), items.size());
  }

  Buffer<typename Kind::Rest> rest_;
  Buffer<typename Kind::RestBeside> rest_beside_;
  Buffer<typename Kind::ByBody> by_body_;
  Buffer<Row> rows_;
  Buffer<typename Kind::Incidence> incidences_;
  Buffer<typename Kind::Beside> beside_;
  Buffer<typename Kind::Start> start_;
};

/// Holds the streams of all kinds, and the vertices in the order of the sweep.
template <class Backend, class List>
class Streams;
template <class Backend, class... All>
class Streams<Backend, KindList<All...>> : Stream<Backend, All>... {
 public:
  Streams(const RestState& rest, const Colouring& colouring, double time_step)
      : Streams(rest, colouring, time_step, host_stream<All>(rest, colouring)...) {}

  /// Returns the number of free vertices.
  int slots() const { return static_cast<int>(vertices_.size()); }
  /// Returns the free vertices by slot, on the backend.
  const SweepVertex* vertices() const { return vertices_.data(); }

  /// Calls Stream::begin of each kind.
  void begin(Backend& backend, const Vec* start) { (Stream<Backend, All>::begin(backend, start), ...); }
  /// Puts the streams of all kinds into a view.
  void complete(SweepView& view) const {
    view.vertices = vertices_.data();
    (Stream<Backend, All>::complete(view), ...);
  }
  /// Returns the elements of all kinds at `position` (on the backend).
  AllElements<KindList<All...>> elements(const SurfaceMaterial* materials, const SurfaceModels* models,
                                         const Vec* position) const {
    AllElements<KindList<All...>> all;
    (complete<All>(all, materials, models, position), ...);
    return all;
  }

 private:
  Streams(const RestState& rest, const Colouring& colouring, double time_step, const HostStream<All>&... host)
      : Stream<Backend, All>(rest, host)... {
    const std::vector<SweepVertex> vertices = sweep_vertices(KindList<All...>{}, rest, colouring, time_step, host...);
    vertices_.upload(vertices.data(), vertices.size());
  }

  template <class Kind>
  void complete(ElementsView<Kind>& elements, const SurfaceMaterial* materials, const SurfaceModels* models,
                const Vec* position) const {
    elements.materials = materials;
    elements.models = models;
    elements.position = position;
    Stream<Backend, Kind>::complete(elements);
  }

  typename Backend::template Buffer<SweepVertex> vertices_;
};

}  // namespace ogc::fast
