// Plants faults of the sweep: mistakes of published solvers in the order of reading and writing, and missing terms of a
// vertex.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "compare/problem/volumes.hpp"
#include "reference/geometry/truncate.hpp"
#include "reference/solvers/potential_batches.hpp"
#include "reference/solvers/sweep.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

/// Holds a copy of the sweep's input that can be changed.
struct SweepCopy {
  SweepIn in;
  Scene scene;
  std::vector<Index> colour;
  std::vector<Vec3f> start, target;
  std::vector<float> bound;
  std::vector<VolumeContact> volumes;
  std::vector<VertexFacetContact> vertex_facet;

  explicit SweepCopy(const SweepIn& from)
      : in(from),
        scene(*from.scene),
        colour(from.colour.begin(), from.colour.end()),
        start(from.start.begin(), from.start.end()),
        target(from.target.begin(), from.target.end()),
        bound(from.bound.begin(), from.bound.end()),
        volumes(from.volumes.begin(), from.volumes.end()),
        vertex_facet(from.vertex_facet.begin(), from.vertex_facet.end()) {
    in.scene = &scene;
    in.colour = colour;
    in.start = start;
    in.target = target;
    in.bound = bound;
    in.volumes = volumes;
    in.vertex_facet = vertex_facet;
  }
  SweepCopy(const SweepCopy&) = delete;
  SweepCopy& operator=(const SweepCopy&) = delete;
};

/// Returns a fault that sweeps a wrong input correctly: `change(copy)` changes a copy of the input.
Fault asked_wrongly(const std::string& name, const std::function<void(SweepCopy&)>& change) {
  return {"sweep: " + name, Stage::sweep, [change](Contestant& contestant, const Authority&) {
            contestant.sweep = [right = contestant.sweep, change](const SweepIn& in) {
              SweepCopy other(in);
              change(other);
              return right(other.in);
            };
          }};
}

/// Returns a fault that sweeps correctly, but over stencils changed by `change(stencils)`.
Fault gathered_wrongly(const std::string& name, const std::function<void(reference::SweepStencils&)>& change) {
  return {"sweep: " + name, Stage::sweep, [change](Contestant& contestant, const Authority&) {
            contestant.sweep = [change](const SweepIn& in) {
              reference::SweepStencils stencils(in);
              change(stencils);
              return reference::reference_sweep(in, stencils);
            };
          }};
}

/// Gives each vertex its own colour, ordered by colour and number. So a vertex also reads the new positions of earlier
/// vertices of its colour.
void order_within_colours(SweepCopy& copy) {
  std::vector<std::size_t> order(copy.colour.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::vector<Index> before = copy.colour;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return before[a] < before[b]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    if (before[order[i]] >= 0) copy.colour[order[i]] = static_cast<Index>(i);
}

void forget_one_inertia(SweepCopy& copy) {
  const auto free = std::find_if(copy.colour.begin(), copy.colour.end(), [](Index c) { return c >= 0; });
  if (free == copy.colour.end()) return;
  const auto v = static_cast<std::size_t>(free - copy.colour.begin());
  copy.target[v] = copy.in.old[v];
}

/// Returns a fault that truncates positions after the iteration, as Algorithm 3 is printed.
Fault truncated_late() {
  return {"sweep: truncation after the iteration", Stage::sweep, [](Contestant& contestant, const Authority&) {
            contestant.sweep = [right = contestant.sweep](const SweepIn& in) {
              SweepCopy other(in);
              std::fill(other.bound.begin(), other.bound.end(), std::numeric_limits<float>::max());
              SweepOut out = right(other.in);
              for (std::size_t v = 0; v < in.old.size(); ++v) {
                const Vec3f &x = out.position[v], &p = in.previous[v];
                const double step[]{double{x.x} - p.x, double{x.y} - p.y, double{x.z} - p.z};
                const double length = std::hypot(step[0], step[1], step[2]);
                if (length <= in.bound[v]) continue;
                ++out.cut;
                const double s = in.bound[v] / length;
                out.position[v] = reference::stored_within({p.x + s * step[0], p.y + s * step[1], p.z + s * step[2]}, p,
                                                           in.bound[v]);
              }
              return out;
            };
          }};
}

/// Applies the force of a vertex–facet contact only to the contact's vertex, not to the facet's corners.
void forget_facets(reference::SweepStencils& stencils) {
  for (auto& contacts : stencils.vertex_facet)
    std::erase_if(contacts, [](const auto& contact) { return contact.second > 0; });
}

/// Returns a fault of contacts with volumes, which cases of the generator "volume" reveal.
Fault about_volumes(const std::string& name, const std::function<void(SweepCopy&)>& change) {
  Fault fault = asked_wrongly(name, change);
  fault.generator = "volume";
  return fault;
}

/// Marks a fault of free volumes, which cases of the generator "free_volume" reveal.
Fault about_free_volumes(Fault fault) {
  fault.generator = "free_volume";
  return fault;
}

/// Leaves out the force that contacts with volumes exert on the corners of the volumes' triangles.
void forget_corners(reference::SweepStencils& stencils) {
  for (auto& own : stencils.volumes) std::erase_if(own, [](const auto& element) { return element.second > 0; });
}

/// Sets xᵗ of the volumes' vertices to their positions before the sweep, which hides the motion of volumes.
void forget_motion_of_volumes(SweepCopy& copy) {
  const std::vector<bool> is_volume = volume_flags(copy.scene);
  for (std::size_t v = 0; v < is_volume.size(); ++v)
    if (is_volume[v]) copy.start[v] = copy.in.old[v];
}

}  // namespace

std::vector<Fault> sweep_faults() {
  return {
      asked_wrongly("one contact dropped",
                    [](SweepCopy& copy) {
                      if (!copy.in.vertex_facet.empty())
                        copy.in.vertex_facet = copy.in.vertex_facet.first(copy.in.vertex_facet.size() - 1);
                    }),
      asked_wrongly("contacts read fresh within a colour", order_within_colours),
      asked_wrongly("inertia missing on one vertex", forget_one_inertia),
      gathered_wrongly("contact forces on one side only", forget_facets),
      spoiled("sweep: one cut not counted", &Contestant::sweep,
              [](const SweepIn&, SweepOut& out) { out.cut = std::max(0, out.cut - 1); }),
      truncated_late(),
      about_volumes(
          "one contact of a vertex with volumes alone",
          [](SweepCopy& copy) {
            const auto same = [](const VolumeContact& a, const VolumeContact& b) { return a.point == b.point; };
            copy.volumes.erase(std::unique(copy.volumes.begin(), copy.volumes.end(), same), copy.volumes.end());
            copy.in.volumes = copy.volumes;
          }),
      about_volumes("volumes do not carry along", forget_motion_of_volumes),
      about_free_volumes(gathered_wrongly("what presses a free volume is not pressed back", forget_corners)),
  };
}

}  // namespace ogc::tests
