// Binds meshes and contact sets. Texts are for help() and the stubs.
#include <cstdint>
#include <optional>
#include <string>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include "experiments/python/arrays.hpp"
#include "experiments/python/contacts.hpp"
#include "experiments/python/module.hpp"

namespace ogc::python {
namespace {

/// Returns `value` as a setting of single precision.
fast::ContactQuery query_of(double radius, double query_radius, double relaxation) {
  return {static_cast<float>(radius), static_cast<float>(query_radius), static_cast<float>(relaxation)};
}

fast::ContactColumns find_in(ContactFinder& finder, nb::handle x, const fast::ContactQuery& query) {
  const bool has_device = finder.backend() == fast::Backend::cuda;
  const Given<compare::Vec3f> positions = given_positions(x, "x", has_device ? Place::either : Place::host);
  const nb::gil_scoped_release release;
  return with_names_of_python([&] {
    return is_on_device(positions.array) ? finder.find_on_device(positions.items, query)
                                         : finder.find(positions.items, query);
  });
}

void init_mesh(Mesh* self, nb::handle triangles, nb::handle edges, nb::handle groups,
               std::optional<compare::Index> vertex_count) {
  const Given<compare::Triangle> given_faces = given_triangles(triangles, "triangles");
  Given<compare::Edge> given_edges;
  Given<compare::Index> given_groups;
  if (!edges.is_none()) given_edges = given<compare::Edge>(edges, {"edges", "int32", "(E, 2)", 2, 2});
  if (!groups.is_none()) given_groups = given<compare::Index>(groups, {"groups", "int32", "(V,)", 1});
  if (!vertex_count && !groups.is_none()) vertex_count = static_cast<compare::Index>(given_groups.items.size());
  const nb::gil_scoped_release release;
  new (self) Mesh(given_faces.items, given_edges.items, given_groups.items, vertex_count);
}

void bind_mesh(nb::module_& module) {
  nb::class_<Mesh>(module, "Mesh",
                   "A mesh that never changes; positions go to each call.\n\n"
                   "triangles: int32 (T, 3), vertex numbers. edges: int32 (E, 2), edges that belong to no triangle.\n"
                   "groups: int32 (V,); pairs whose vertices all have the same number ≥ 0 are no contacts.\n"
                   "vertex_count: V; without it the largest vertex number + 1, or the length of groups.\n\n"
                   "ValueError: an index is out of range or repeated. TypeError: an array of another dtype or shape.")
      .def("__init__", &init_mesh, nb::arg("triangles").none(), nb::arg("edges") = nb::none(),
           nb::arg("groups") = nb::none(), nb::arg("vertex_count") = nb::none(),
           nb::sig("def __init__(self, triangles: " OGC_GIVEN("int32", "(None, 3)") ", edges: " OGC_GIVEN(
               "int32",
               "(None, 2)") " | None = None, groups: " OGC_GIVEN("int32",
                                                                 "(None,)") " | None = None, "
                                                                            "vertex_count: int | None = None) -> None"))
      .def_prop_ro(
          "vertex_count", [](const Mesh& mesh) { return mesh.mesh().vertex_count(); },
          "V, also counts vertices that no face contains")
      .def_prop_ro(
          "triangles",
          [](nb::handle self) {
            const auto& rows = nb::cast<Mesh&>(self).mesh().topology().triangles;
            return lent<compare::Index, 3>(rows.data(), rows.size(), self);
          },
          nb::sig("def triangles(self) -> " OGC_LENT("int32", "(None, 3)")), "int32 (T, 3), read-only, as given")
      .def_prop_ro(
          "edges",
          [](nb::handle self) {
            const auto& rows = nb::cast<Mesh&>(self).mesh().topology().edges;
            return lent<compare::Index, 2>(rows.data(), rows.size(), self);
          },
          nb::sig("def edges(self) -> " OGC_LENT("int32", "(None, 2)")),
          "int32 (E, 2), read-only: all edges, of triangles and loose, smaller vertex first, ascending; contact sets "
          "number edges so")
      .def_prop_ro(
          "groups",
          [](nb::handle self) {
            const auto& rows = nb::cast<Mesh&>(self).mesh().exclusions().groups;
            return lent<compare::Index, 1>(rows.data(), rows.size(), self);
          },
          nb::sig("def groups(self) -> " OGC_LENT("int32", "(None,)")), "int32 (V,), read-only; empty without groups")
      .def("__repr__", [](const Mesh& mesh) {
        const compare::Topology& topology = mesh.mesh().topology();
        return "Mesh of " + std::to_string(topology.vertex_count) + " vertices, " +
               std::to_string(topology.edges.size()) + " edges, " + std::to_string(topology.triangles.size()) +
               " triangles";
      });
}

using Sets = fast::ContactColumns;

/// Binds rows of `columns` numbers.
template <auto field, class Number, std::size_t columns, class Class, class Signature>
void bind_rows(Class& bound, const char* name, const Signature& signature, const char* doc) {
  bound.def_prop_ro(
      name,
      [](nb::handle self) {
        const auto& sets = nb::cast<Sets&>(self);
        const auto& rows = sets.*field;
        return sets.device == Sets::on_host
                   ? lent<Number, columns>(rows.data(), rows.size(), self)
                   : lent_on_device<Number, columns>(rows.data(), rows.size(), self, sets.device);
      },
      signature, doc);
}

void bind_sets(nb::module_& module) {
  nb::class_<Sets> sets(
      module, "ContactSets",
      "Contact sets, smallest distances and bounds at one state, in memory that no later call writes to. Distances and "
      "bounds are never above the exact ones.\n\n"
      "Arrays lie where the positions did, and keep this object alive. On the host they are read-only NumPy arrays.\n"
      "On a device each has __dlpack__ and __dlpack_device__, for torch.from_dlpack, cupy.from_dlpack and others. Its\n"
      "numbers are complete, so any stream may read them without waiting. Who writes to them changes them for all.");
  bind_rows<&Sets::vertex_facet, compare::Index, 3>(
      sets, "vertex_facet", nb::sig("def vertex_facet(self) -> " OGC_LENT("int32", "(None, 3)")),
      "int32 (n, 3): vertex v, face a, owner, for each contact of F_OGC(v) (Eq. 12), by vertex, then face. a numbers a "
      "vertex, an edge of mesh.edges or a triangle, as vertex_facet_kind says; owner is the first triangle with a.");
  bind_rows<&Sets::vertex_facet_kind, std::uint8_t, 1>(
      sets, "vertex_facet_kind", nb::sig("def vertex_facet_kind(self) -> " OGC_LENT("uint8", "(None,)")),
      "uint8 (n,): kind of the face: 0 a vertex, 1 an edge, 2 a triangle");
  bind_rows<&Sets::edge_edge, compare::Index, 4>(
      sets, "edge_edge", nb::sig("def edge_edge(self) -> " OGC_LENT("int32", "(None, 4)")),
      "int32 (m, 4): faces p and q, and the edges that contain them, for each contact of E_OGC (Eq. 17). p and q "
      "number "
      "a vertex or an edge, as edge_edge_kind says.");
  bind_rows<&Sets::edge_edge_kind, std::uint8_t, 2>(
      sets, "edge_edge_kind", nb::sig("def edge_edge_kind(self) -> " OGC_LENT("uint8", "(None, 2)")),
      "uint8 (m, 2): kinds of p and q: 0 a vertex, 1 an edge");
  bind_rows<&Sets::bound, float, 1>(sets, "bound", nb::sig("def bound(self) -> " OGC_LENT("float32", "(None,)")),
                                    "float32 (V,): b_v, how far each vertex may move (Eq. 21) [m]");
  bind_rows<&Sets::d_min_vertex, float, 1>(sets, "distance_vertex",
                                           nb::sig("def distance_vertex(self) -> " OGC_LENT("float32", "(None,)")),
                                           "float32 (V,): smallest distance to a triangle without the vertex, at most "
                                           "r_q (Eq. 22) [m]");
  bind_rows<&Sets::d_min_edge, float, 1>(sets, "distance_edge",
                                         nb::sig("def distance_edge(self) -> " OGC_LENT("float32", "(None,)")),
                                         "float32 (E,): smallest distance to an edge without a common vertex, at most "
                                         "r_q (Eq. 24) [m]");
  bind_rows<&Sets::d_min_triangle, float, 1>(sets, "distance_triangle",
                                             nb::sig("def distance_triangle(self) -> " OGC_LENT("float32", "(None,)")),
                                             "float32 (T,): smallest distance to a vertex that is no corner, at most "
                                             "r_q (Eq. 26) [m]");
  sets.def_ro("smallest_distance", &Sets::smallest_distance, "smallest of all distances [m]; r_q if no pair is nearer");
  sets.def_prop_ro(
      "device",
      [](const Sets& found) { return found.device == Sets::on_host ? nb::none() : nb::object(nb::int_(found.device)); },
      nb::sig("def device(self) -> int | None"),
      "number of the CUDA device with the arrays; None: they are on the host");
  sets.def(
      "cpu",
      [](nb::handle self) -> nb::object {
        const auto& found = nb::cast<Sets&>(self);
        if (found.device == Sets::on_host) return nb::borrow(self);
        std::optional<Sets> copy;
        {
          const nb::gil_scoped_release release;
          copy = found.copied_to_host();
        }
        return nb::cast(std::move(*copy));
      },
      nb::sig("def cpu(self) -> ContactSets"), "Returns the same on the host: a copy, or this object if it is there.");
  sets.def("__repr__", [](const Sets& found) {
    return "ContactSets with " + std::to_string(found.vertex_facet.size()) + " vertex-facet and " +
           std::to_string(found.edge_edge.size()) + " edge-edge contacts" +
           (found.device == Sets::on_host ? "" : ", on device " + std::to_string(found.device));
  });
}

#define OGC_QUERY \
  "x: " OGC_GIVEN("float32", "(None, 3)") ", radius: float, query_radius: float, relaxation: float = 0.45"

constexpr const char* find_doc =
    "Finds the contact sets of a state.\n\n"
    "x: float32 (V, 3), positions [m], |x| ≤ 2^30, on the host or, for \"cuda\", also on a device. Results lie\n"
    "where x does. What its library has enqueued on its current stream is waited for (DLPack's stream); x may be\n"
    "overwritten on return. Coordinates on a device are not checked.\n"
    "radius: r ≥ 2^-40 [m]. query_radius: r_q from r to 2^20, range of the search [m].\n"
    "relaxation: γ_p of Eq. 21, in (0, 0.5). The same positions give the same bits. Other Python threads run "
    "meanwhile.\n\n"
    "TypeError: x has another dtype, shape, order or device; the message has the call that converts it.\n"
    "ValueError: x has not V rows, a coordinate is not finite or too large, or a radius is out of range.";

void bind_finder(nb::module_& module) {
  nb::class_<ContactFinder>(module, "ContactFinder",
                            "Finds contacts of one mesh again and again, and keeps its memory between calls.\n\n"
                            "backend: \"cpu\" or \"cuda\". RuntimeError: the backend is not there; the message says "
                            "why.")
      .def(
          "__init__",
          [](ContactFinder* self, const Mesh& mesh, std::string_view backend) {
            const fast::Backend chosen = usable_backend(backend);
            const nb::gil_scoped_release release;
            new (self) ContactFinder(mesh.mesh(), chosen);
          },
          nb::arg("mesh"), nb::arg("backend") = "cpu")
      .def(
          "find",
          [](ContactFinder& self, nb::handle x, double radius, double query_radius, double relaxation) {
            return find_in(self, x, query_of(radius, query_radius, relaxation));
          },
          nb::arg("x").none(), nb::arg("radius"), nb::arg("query_radius"), nb::arg("relaxation") = 0.45,
          nb::sig("def find(self, " OGC_QUERY ") -> ContactSets"), find_doc);
  module.def(
      "find_contacts",
      [](Mesh& mesh, nb::handle x, double radius, double query_radius, double relaxation, std::string_view backend) {
        const fast::Backend chosen = usable_backend(backend);
        ContactFinder* finder = nullptr;
        {
          const nb::gil_scoped_release release;
          finder = &mesh.finder(chosen);
        }
        return find_in(*finder, x, query_of(radius, query_radius, relaxation));
      },
      nb::arg("mesh"), nb::arg("x").none(), nb::arg("radius"), nb::arg("query_radius"), nb::arg("relaxation") = 0.45,
      nb::arg("backend") = "cpu",
      nb::sig("def find_contacts(mesh: Mesh, " OGC_QUERY ", backend: str = 'cpu') -> ContactSets"), find_doc);
}

}  // namespace

void bind_contacts(nb::module_& module) {
  bind_mesh(module);
  bind_sets(module);
  bind_finder(module);
  module.def(
      "backend_info",
      [](std::string_view backend) {
        const fast::BackendInfo info = backend_info(backend);
        nb::dict facts;
        facts["built"] = info.built;
        facts["usable"] = info.usable;
        facts["description"] = info.description;
        return facts;
      },
      nb::arg("backend"),
      "Returns whether a backend is built in and can run here: built, usable, description (\"2 threads\", the device, "
      "or the reason why it cannot run).");
}

}  // namespace ogc::python
