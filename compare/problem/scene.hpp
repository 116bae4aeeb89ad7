// Holds a scene: everything that a contestant needs to know, as plain data in double. `round_to_single` rounds each
// number to single precision, so that contestants in single and in double precision answer the same question (method.md
// §2.5).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "compare/problem/element_names.hpp"
#include "compare/problem/exclusions.hpp"
#include "compare/problem/mesh.hpp"
#include "compare/problem/settings.hpp"
#include "compare/problem/tetrahedra.hpp"

namespace ogc::compare {

enum class MembraneModel { none, st_venant_kirchhoff, stable_neo_hookean };  ///< method.md §4.6
enum class BendingModel { none, discrete_hinge, isometric_quadratic };       ///< method.md §4.7

/// How a body meets other bodies: as a surface with two sides that nothing passes through, or as a volume, which other
/// bodies may enter and which pushes them out (§3.9).
enum class BodyContact { surface, volume };
/// Returns whether other bodies may enter the body.
constexpr bool is_volume(BodyContact contact) {
  switch (contact) {
    case BodyContact::surface: return false;
    case BodyContact::volume: return true;
  }
  return false;
}

/// Constants of a rod, that is, of the loose edges of a body, its *segments* (compare/rods.md).
struct RodMaterial {
  double density = 1e-3;   ///< ρ, mass per rest length [kg/m]
  double stretch = 0.1;    ///< k_s = EA, of stretch and shear [N]
  double bend = 2e-7;      ///< k_b = EI = GJ, of bend and twist [N m²]
  double damping = 0;      ///< k_d of both energies; damping resists changes of strain since the start of a step [s]
  double diameter = 3e-3;  ///< for drawing only; no force uses it [m]
  friend bool operator==(const RodMaterial&, const RodMaterial&) = default;
};

/// Holds the constants of one body: of its surface (method.md §4.5 to §4.10), of its tetrahedra (method.md §8) and of
/// its loose edges if it is a rod.
struct Material {
  double density = 0.2;                                        ///< mass per rest area [kg/m²]
  MembraneModel membrane = MembraneModel::stable_neo_hookean;  ///< energy of triangles
  double lame_mu = 10, lame_lambda = 10;                       ///< plane-stress Lamé constants times thickness [N/m]
  BendingModel bending = BendingModel::discrete_hinge;         ///< energy of hinges
  /// k_b [J]. The energy is k_b/2 · 3‖e‖²/(A₀+A₁) · (θ−θ₀)², in the isometric model k_b/2 · 3/(A₀+A₁) ‖Σ K_i x_i‖².
  double bending_stiffness = 5e-7;
  double membrane_damping = 0;                ///< k_d of ψ_d = (k_d/h) ψ(G − Gᵗ) [s]
  double bending_damping = 0;                 ///< the same for θ − θᵗ [s]
  double contact_stiffness = 100;             ///< k_c [N/m]; two surfaces meet with the harmonic mean
  double friction = 0.2;                      ///< μ_c [1]; two surfaces meet with the arithmetic mean
  double solid_density = 1000;                ///< ρ, mass per rest volume [kg/m³]
  double solid_mu = 1e4, solid_lambda = 1e4;  ///< Lamé constants of the volume [Pa]
  double solid_damping = 0;                   ///< k_d of ψ_d = (k_d/h) ϕ(G − Gᵗ) of the volume [s]
  std::optional<RodMaterial> rod{};           ///< of the loose edges; without it they have neither mass nor energies
  friend bool operator==(const Material&, const Material&) = default;
};

/// A contiguous range of vertices, triangles and tetrahedra with one material. A fixed body never moves and needs no
/// energies. The triangles of a body with tetrahedra are their boundary (compare/problem/tetrahedra.hpp): they meet
/// other surfaces, but have neither mass nor energies of their own.
struct Body {
  std::string name;                                               ///< for messages and files
  Index first_vertex = 0, vertex_count = 0;                       ///< its vertices are consecutive
  Index first_triangle = 0, triangle_count = 0;                   ///< its triangles are consecutive
  bool fixed = false;                                             ///< an obstacle that never moves
  Material material;                                              ///< one material for the whole body
  Index first_tetrahedron = 0, tetrahedron_count = 0;             ///< its tetrahedra are consecutive
  BodyContact contact = BodyContact::surface;                     ///< how it meets others
  bool is_solid() const { return tetrahedron_count > 0; }         ///< whether it has tetrahedra
  bool is_volume() const { return compare::is_volume(contact); }  ///< whether others may enter it
  friend bool operator==(const Body&, const Body&) = default;
};

struct MeshCheck;
struct Problem;

// The structs below describe the lists of elements that a mesh has; MeshLists collects them. Bookkeeping, validation,
// mesh files and scene files fold over MeshLists. Each struct has these members:
//
//     name, key       are for messages; the key, a plural, also for files
//     list            points to the elements
//     named           returns the name of an element in messages, with its place in the file
//     first, count    point to a body's range; without them the elements of a body are those on its vertices
//     boundary        returns the surface of elements with volume, which replaces a body's triangles
//     check           reports bad elements; check_rest reports elements with bad rest shapes
//     msh_type        is Gmsh's number for the type of elements with volume
//     numbers, lines  point to the places of elements with volume in their file (MeshSource)

/// The triangles of a mesh.
struct TrianglesOfMesh {
  static constexpr const char *name = "triangle", *key = "triangles";                  ///< for messages and files
  static constexpr auto list = &Mesh::triangles;                                       ///< points to the elements
  static constexpr auto named = &ElementNames::triangle;                               ///< names an element in messages
  static constexpr auto first = &Body::first_triangle, count = &Body::triangle_count;  ///< range of a body
};

/// The edges that belong to no triangle.
struct LooseEdgesOfMesh {
  static constexpr const char *name = "loose edge", *key = "loose_edges";  ///< for messages and files
  static constexpr auto list = &Mesh::loose_edges;                         ///< points to the elements
  static constexpr auto named = &ElementNames::loose_edge;                 ///< names an element in messages
};

/// The tetrahedra of a mesh.
struct TetrahedraOfMesh {
  static constexpr const char *name = "tetrahedron", *key = "tetrahedra";  ///< for messages and files
  static constexpr auto list = &Mesh::tetrahedra;                          ///< points to the elements
  static constexpr auto named = &ElementNames::tetrahedron;                ///< names an element in messages
  static constexpr auto first = &Body::first_tetrahedron, count = &Body::tetrahedron_count;  ///< range of a body
  static constexpr auto boundary = &boundary_triangles;                                      ///< returns their surface
  static constexpr int msh_type = 4;                             ///< Gmsh's number for four-node tetrahedra
  static constexpr auto numbers = &MeshSource::tetrahedra;       ///< their numbers in the file
  static constexpr auto lines = &MeshSource::tetrahedron_lines;  ///< their lines in the file
  /// Reports faces of more than two tetrahedra, and faces whose two tetrahedra lie on the same side of the face.
  static void check(const MeshCheck& check);
  /// Reports tetrahedra that are inverted at their rest positions, decided exactly, or flat: without volume, or with so
  /// little that their rest data are beyond the limits of compare/stages/tetrahedron.hpp. Positions are numbers of
  /// single precision.
  static void check_rest(const MeshCheck& check, const std::vector<Vec3>& rest_positions);
};

/// All lists of elements that a mesh has. The triangles come first; they contain the surface of the tetrahedra.
using MeshLists = std::tuple<TrianglesOfMesh, LooseEdgesOfMesh, TetrahedraOfMesh>;

/// Is true for lists of elements in which each body has a range.
template <class List>
concept HasRange = requires {
  List::first;
};
/// Is true for lists of elements with volume.
template <class List>
concept HasVolume = requires {
  List::boundary;
};
/// An element of a list.
template <class List>
using ElementOf = std::remove_cvref_t<decltype((std::declval<Mesh>().*List::list)[0])>;

/// Calls visit.operator()<Type, number>() for each type of the tuple `All`; `number` is the type's index.
template <class All, class Visit>
constexpr void for_each_of(Visit visit) {
  [&]<std::size_t... number>(std::index_sequence<number...>) {
    (visit.template operator()<std::tuple_element_t<number, All>, number>(), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<All>>());
}

/// Returns whether a mesh has elements with volume.
bool has_volume(const Mesh& mesh);
/// Returns the boundary of a mesh's elements with volume, or its triangles if it has none.
std::vector<Triangle> surface_triangles(const Mesh& mesh);

/// Holds positions at given times. Between two times vertices move along straight lines; before the first and after the
/// last they rest.
struct Keyframes {
  std::vector<double> times;     ///< ascending [s]; empty or at least two
  std::vector<Vec3f> positions;  ///< [m]; frame by frame, the vertices of each in the order of the motion
  bool is_rigid = false;         ///< axis and ω of the motion give its rotation; no file sets it
  bool empty() const { return times.empty(); }  ///< whether there are no keyframes
  friend bool operator==(const Keyframes&, const Keyframes&) = default;
};

/// Prescribed motion of a set of vertices. Without keyframes it is rigid: x(t) = R(ω (t − t₀)) (x(0) − c) + c + u (t −
/// t₀) for t₀ = start ≤ t ≤ end, at rest before and after. R rotates by the right-hand rule about `axis` through
/// `centre`. The vertices of a motion form one group: pairs within the group are no contacts, even if keyframes deform
/// it.
struct PrescribedMotion {
  std::string name;              ///< for messages and files
  std::vector<Index> vertices;   ///< vertices that it moves
  Vec3 centre{}, axis{1, 0, 0};  ///< [m]; direction of the axis: not zero, its length does not matter
  double angular_velocity = 0;   ///< ω [rad/s]
  Vec3 velocity{};               ///< u [m/s]
  double start = 0, end = 1e30;  ///< [s]
  Keyframes keyframes;           ///< replaces the rigid motion unless empty
  friend bool operator==(const PrescribedMotion&, const PrescribedMotion&) = default;
};

/// A spring between vertex `first` and either vertex `second` or a point of the line from `second` to `third`. The
/// vertices may be of different bodies. Its energy is k/2 (l − l₀)², and the energy of its damping is k_d/h · k/2 (l −
/// lᵗ)², with l = ‖x_first − (1 − s) x_second − s x_third‖. A spring is no edge of the mesh and takes no part in
/// contact. A stitch has l₀ = 0. Faces at both ends of a spring are excluded from contact only if
/// `Scene::excluded_pairs` has these vertices.
struct Spring {
  Index first = -1, second = -1;  ///< vertices, distinct
  double stiffness = 0;           ///< k [N/m]
  double rest_length = 0;         ///< l₀ [m]
  double damping = 0;             ///< k_d [s]
  Index third = -1;               ///< −1: none, and s = 0
  double ratio = 0;               ///< s [1], from 0 to 1
  friend bool operator==(const Spring&, const Spring&) = default;
};

/// Holds a problem as every contestant gets it.
struct Scene {
  std::string name;                       ///< for messages and files
  Mesh mesh;                              ///< start positions X⁰ [m] of all bodies
  std::vector<Vec3> rest_positions;       ///< [m]; same length as mesh.positions
  std::vector<Vec3> velocities;           ///< V⁰ [m/s]; same length
  std::vector<Body> bodies;               ///< cover all vertices, triangles and tetrahedra, in order
  std::vector<PrescribedMotion> motions;  ///< of vertices that no force moves
  std::vector<Spring> springs;            ///< between vertices, or a vertex and an edge
  /// pairs of vertices; a pair of faces is excluded if one face contains the first vertex and the other face the second
  /// (stitched primitives, §5.1.3)
  std::vector<std::array<Index, 2>> excluded_pairs;
  Vec3 gravity{0, -9.81, 0};  ///< [m/s²]
  Settings settings;
  /// start orientations of all segments, in the order of rod_segments (compare/problem/rods.hpp). If empty,
  /// orientations at rest are used, each rotated by the smallest rotation to the start direction of its segment
  std::vector<Quaternion> orientations{};
  friend bool operator==(const Scene&, const Scene&) = default;
};

/// Type of a pointer to a member of an element. It avoids `Value Element::*` in templates, which nvcc writes with
/// parentheses that g++ warns of.
template <class Element, class Value>
using MemberOf = std::type_identity_t<Value Element::*>;

/// One field of an element that a scene lists: a vertex or a number. Files have the fields in this order.
template <class Element>
struct ElementField {
  const char* name;                              ///< its key in files
  const char* meaning;                           ///< text for the schema, with the unit; empty for a vertex
  MemberOf<Element, Index> vertex = nullptr;     ///< either this
  MemberOf<Element, double> number = nullptr;    ///< or this, at least 0
  bool is_required = false;                      ///< whether a file must give it
  MemberOf<Element, Index> goes_with = nullptr;  ///< member with a vertex; files omit the field if this vertex is −1
  std::optional<double> maximum = {};            ///< largest value of a number, for the schema
};

// The structs below describe the elements that a scene lists beside its mesh: key, list, fields and a check. SceneLists
// collects them.

/// The springs of a scene.
struct SpringsOfScene {
  static constexpr const char *key = "springs",  ///< for files
      *meaning = "between a vertex and another, or a point between two others; no part of contact";
  static constexpr auto list = &Scene::springs;  ///< points to the elements
  /// In the order of files.
  static constexpr std::array fields{
      ElementField<Spring>{.name = "first", .meaning = "", .vertex = &Spring::first, .is_required = true},
      ElementField<Spring>{.name = "second", .meaning = "", .vertex = &Spring::second, .is_required = true},
      ElementField<Spring>{.name = "stiffness", .meaning = "[N/m]", .number = &Spring::stiffness, .is_required = true},
      ElementField<Spring>{.name = "rest_length", .meaning = "[m]; default 0", .number = &Spring::rest_length},
      ElementField<Spring>{
          .name = "damping", .meaning = "stiffness-proportional [s]; default 0", .number = &Spring::damping},
      ElementField<Spring>{.name = "third", .meaning = "", .vertex = &Spring::third, .goes_with = &Spring::third},
      ElementField<Spring>{
          .name = "ratio",
          .meaning = "s of the point (1 − s) second + s third that the spring holds instead of second [1]; default 0",
          .number = &Spring::ratio,
          .goes_with = &Spring::third,
          .maximum = 1}};
  /// Lists springs that do not join two different vertices, or have a number out of range.
  static void check(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names, std::size_t limit);
};

/// All lists of elements that a scene has beside its mesh.
using SceneLists = std::tuple<SpringsOfScene>;
/// Returns whether files have this field for this element.
template <class Element>
bool has_field(const Element& element, const ElementField<Element>& field) {
  return field.goes_with == nullptr || element.*field.goes_with >= 0;
}

/// Appends the mesh as a body at rest in its rest shape and returns the body's number. `body` gives name, material and
/// whether it is fixed; its ranges are set here. If the mesh has tetrahedra, their boundary replaces its triangles.
std::size_t append_body(Scene& scene, Body body, const Mesh& mesh);

/// Rounds every number that a stage gets (positions, rest data, velocities, materials, gravity, settings) to the
/// nearest single-precision value, in place. Motions stay in double, because stages get only their targets.
void round_to_single(Scene& scene);

/// Adds the spring of a stitch from vertex `first` to the point (1 − ratio) x_second + ratio x_third. Excludes the
/// pairs of `first` with each of the other two vertices from contact.
void add_stitch(Scene& scene, Index first, Index second, Index third, double ratio, double stiffness);

/// Returns the group of each vertex: -1: free; 0: fixed; k ≥ 1: in the k-th prescribed motion. Length: vertex count.
std::vector<Index> rigid_groups(const Scene& scene);

/// Returns K, the number of vertices that may move and have a bound: those of the surface that are not fixed. `groups`
/// is the result of rigid_groups.
Index bounded_count(const Topology& topology, std::span<const Index> groups);

/// Returns the pairs that are excluded from contact, d_min and audit, by rigid_groups and excluded_pairs.
Exclusions exclusions(const Scene& scene);

/// Returns the target of each vertex of `motion` at time `t` [s], computed in double and rounded once to single; in the
/// order of motion.vertices.
std::vector<Vec3f> prescribed_targets(const Scene& scene, const PrescribedMotion& motion, double t);

/// Returns the body of each vertex; -1 if no body covers it. Length: vertex count.
std::vector<Index> body_of_vertex(const Scene& scene);

/// Builds the topology of the scene's mesh; vertices of volumes are off the surface.
Topology build_topology(const Scene& scene);

/// Rounds positions to single precision, the precision of stages' inputs.
std::vector<Vec3f> to_single(const std::vector<Vec3>& positions);
/// Widens positions without loss.
std::vector<Vec3> to_double(const std::vector<Vec3f>& positions);

}  // namespace ogc::compare
