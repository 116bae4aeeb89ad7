// Runs ContactForces (fast/contact_forces.hpp) on one backend: copies positions into aligned vectors, makes the rows of
// contacts, sums energies and forces, and waits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "fast/contact_forces.hpp"
#include "fast/kernels/rest_state.hpp"
#include "fast/kernels/sums/contact_sums.hpp"
#include "fast/probes/download.hpp"
#include "fast/stages/reduce.hpp"

namespace ogc::fast {

/// Returns ‖ē‖² by edge; 0 for an edge without triangles.
inline std::vector<float> rest_squared_of(const compare::Topology& topology, std::span<const compare::Vec3f> rest) {
  const auto at = [rest](compare::Index v) {
    const compare::Vec3f& x = rest[static_cast<std::size_t>(v)];
    return compare::Vec3{x.x, x.y, x.z};
  };
  std::vector<float> squared;
  squared.reserve(topology.edges.size());
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const RestVector edge = rest_difference(at(topology.edges[e][1]), at(topology.edges[e][0]));
    squared.push_back(topology.edge_triangles[e].empty() ? 0.0F : static_cast<float>(rest_dot(edge, edge)));
  }
  return squared;
}

/// Runs the sums of contacts of one mesh on one backend.
template <class Backend>
class BackendContactForceEngine : public ContactForceEngine {
 public:
  /// Mesh, rest positions, options and colours are read here only; `backend` must outlive the engine.
  BackendContactForceEngine(Backend& backend, const Mesh& mesh, std::span<const compare::Vec3f> rest,
                            const ContactForceOptions& options, std::span<const compare::Index> colours)
      : backend_(backend), options_(options), vertices_(mesh.vertex_count()), sums_(backend, vertices_) {
    std::vector<int> colour(colours.begin(), colours.end()), every(count());
    std::iota(every.begin(), every.end(), 0);
    if (colour.empty()) colour = every;
    std::vector<SweepVertex> slots(count());
    for (std::size_t v = 0; v < count(); ++v) slots[v].vertex = every[v];
    const ContactMaterial materials[] = {{options.contact_stiffness, options.friction}, {options.contact_stiffness, 0}};
    const std::vector<float> rest_squared = rest_squared_of(mesh.topology(), rest);
    colour_.upload(colour.data(), colour.size());
    slots_.upload(slots.data(), slots.size());
    materials_.upload(materials, 2);
    rest_squared_.upload(rest_squared.data(), rest_squared.size());
    body_.resize(count());
    body_.fill_zero();
    rows_.resize(count());
    for (Buffer<PaddedVec>* by_vertex : {&padded_, &padded_start_}) by_vertex->resize(count());
    totals_.resize(contact_columns);
  }

  ContactForceSums evaluate(const FoundContacts& contacts, std::span<const compare::Vec3f> positions,
                            const Sliding& sliding) override {
    positions_.upload(as_vec(positions.data()), count());
    const bool slides = !sliding.start.empty();
    if (slides) start_.upload(as_vec(sliding.start.data()), count());
    for (Buffer<Vec>* by_vertex : {&force_, &friction_}) by_vertex->resize(count());
    block_.resize(count());
    ContactForceSums sums;
    sums.energy = sum(contacts, positions_.data(), slides ? start_.data() : nullptr, sliding.time_step,
                      {force_.data(), friction_.data(), block_.data()});
    sums.force.resize(count());
    sums.friction.resize(count());
    sums.block.resize(count());
    force_.download(reinterpret_cast<Vec*>(sums.force.data()), count());
    friction_.download(reinterpret_cast<Vec*>(sums.friction.data()), count());
    block_.download(reinterpret_cast<Symmetric3*>(sums.block.data()), count());
    return sums;
  }

  ContactEnergy evaluate_resident(const FoundContacts& contacts, const compare::Vec3f* positions,
                                  const SlidingResident& sliding, const ContactForceArrays& out) override {
    return sum(contacts, as_vec(positions), as_vec(sliding.start), sliding.time_step,
               {reinterpret_cast<Vec*>(out.force), reinterpret_cast<Vec*>(out.friction),
                reinterpret_cast<Symmetric3*>(out.block)});
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  static_assert(sizeof(Symmetric3) == sizeof(ContactBlock));

  /// Receives the results, on the backend; null: left out.
  struct Out {
    Vec *force, *friction;
    Symmetric3* block;
  };

  static const Vec* as_vec(const compare::Vec3f* a) { return reinterpret_cast<const Vec*>(a); }
  std::size_t count() const { return static_cast<std::size_t>(vertices_); }

  /// Sums energies, forces and blocks, and waits. All pointers are to the backend; without `start` there is no
  /// friction.
  ContactEnergy sum(const FoundContacts& contacts, const Vec* positions, const Vec* start, double time_step,
                    const Out& out) {
    if (vertices_ == 0) return {};
    const ContactView& view = contacts.view;
    // With a body count of 0, the material of a pair is that of its second body. All vertices are in body 0.
    const ContactTables tables{body_.data(), materials_.data() + (start == nullptr ? 1 : 0), 0, rest_squared_.data(),
                               as_vec(contacts.detected_at)};
    const AnyActivation activation{options_.contact_activation};
    backend_.for_each(vertices_, PadPositions{positions, start, padded_.data(), padded_start_.data()});
    if (out.force != nullptr || out.friction != nullptr || out.block != nullptr) {
      backend_.for_each(vertices_, CopyContactRows{view.rows, view.incidence_offsets, nullptr, slots_.data(),
                                                    rows_.data()});
      SweepShared at;
      at.old = padded_.data();
      at.start = {padded_start_.data()};
      at.contact_radius = options_.contact_radius;
      at.friction_limit = static_cast<float>(options_.friction_velocity * time_step);
      backend_.template for_each_team<8>(vertices_,
                                         SumContacts{.resolve = {view, tables, colour_.data(), nullptr},
                                                     .rows = rows_.data(),
                                                     .at = at,
                                                     .activation = activation,
                                                     .force = out.force,
                                                     .friction = out.friction,
                                                     .block = out.block},
                                         Start::after_previous);
    }
    sums_.template add<0, contact_columns>(
        ContactEnergies{{view, tables, positions, activation, options_.contact_radius},
                        {view, tables, positions, activation, options_.contact_radius}},
        0, Nothing{});
    sums_.total(totals_.data(), 0, Nothing{}, 0, Nothing{});
    backend_.synchronize();
    double totals[contact_columns];
    totals_.download(totals, contact_columns);
    return {totals[contact_vertex_facet], totals[contact_edge_edge]};
  }

  Backend& backend_;
  ContactForceOptions options_;
  int vertices_;
  Reduction<Backend, contact_columns> sums_;
  Buffer<int> colour_, body_;                ///< by vertex
  Buffer<SweepVertex> slots_;                ///< by vertex, which is its own slot
  Buffer<ContactMaterial> materials_;        ///< with friction, without friction
  Buffer<float> rest_squared_;               ///< by edge [m²]
  Buffer<ContactRow> rows_;                  ///< by vertex
  Buffer<PaddedVec> padded_, padded_start_;  ///< by vertex: x, xᵗ [m]
  Buffer<Vec> positions_, start_;            ///< by vertex, of the host's caller [m]
  Buffer<Vec> force_, friction_;             ///< by vertex, for the host [N]
  Buffer<Symmetric3> block_;                 ///< by vertex, for the host [N/m]
  Buffer<double> totals_;                    ///< by ContactColumn [J]
};

}  // namespace ogc::fast
