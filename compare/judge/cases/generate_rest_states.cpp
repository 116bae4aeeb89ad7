// Makes cases of rest_state: one to three bodies of random materials, or a few hinges. The meshes are those of the
// detections' generators, without faces that `validate` refuses. The start is the rest shape at twice the size, so that
// rest data computed from the start are wrong.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "compare/judge/cases/any_models.hpp"
#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/mesh_builder.hpp"
#include "compare/judge/cases/rest_cases.hpp"
#include "compare/judge/cases/solid_block.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/validate.hpp"
#include "compare/problem/validate_mesh.hpp"
#include "compare/problem/zero_area.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

/// Takes the legal part of a mesh. Enlarges a tiny mesh 2¹⁰ times and reduces a vast one to an eighth, so that edges
/// are legal (up to 2²⁰ m) also at the start, where the mesh is twice as large. Coordinates that are too small become
/// 0. Faces that are too short, flat or repeated are left out; so are vertices that then have no face.
class Cleaner {
 public:
  explicit Cleaner(const MeshCase& mesh) : mesh_(mesh) {
    // Enlarges meshes of about 2⁻¹⁸ m. Otherwise many of their coordinates would become 0, which flattens or folds
    // triangles.
    float largest = 0;
    for (const Vec3f& p : mesh.positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const float scale = largest < 0x1p-10f ? 0x1p10f : largest > 0x1p17f ? 0.125f : 1.0f;
    for (const Vec3f& p : mesh.positions) points_.push_back({kept(scale * p.x), kept(scale * p.y), kept(scale * p.z)});
  }

  Mesh clean() {
    for (const Triangle& t : mesh_.topology->triangles) add_triangle(t);
    for (std::size_t e = 0; e < mesh_.topology->edges.size(); ++e)
      if (mesh_.topology->edge_triangles[e].empty()) add_loose_edge(mesh_.topology->edges[e]);
    return std::move(clean_);
  }

 private:
  static double kept(float x) { return std::abs(x) < least_length ? 0 : double{x}; }

  bool is_long_enough(Index a, Index b) const {
    const Vec3 &p = points_[at(a)], &q = points_[at(b)];
    return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) >= 2 * least_length;
  }

  void add_triangle(Triangle t) {
    Triangle sorted = t;
    std::ranges::sort(sorted);
    if (!is_long_enough(t[0], t[1]) || !is_long_enough(t[1], t[2]) || !is_long_enough(t[2], t[0])) return;
    if (has_zero_area(points_[at(t[0])], points_[at(t[1])], points_[at(t[2])]) || !faces_.insert(sorted).second) return;
    for (Index& v : t) v = number_of(v);
    clean_.triangles.push_back(t);
    for (std::size_t k = 0; k < 3; ++k) edges_.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  }

  void add_loose_edge(const Edge& e) {
    if (!is_long_enough(e[0], e[1])) return;
    const Index a = number_of(e[0]), b = number_of(e[1]);
    const Edge edge{std::min(a, b), std::max(a, b)};
    if (edges_.insert(edge).second) clean_.loose_edges.push_back(edge);
  }

  Index number_of(Index v) {
    numbers_.resize(points_.size(), -1);
    if (numbers_[at(v)] < 0) {
      numbers_[at(v)] = static_cast<Index>(clean_.positions.size());
      clean_.positions.push_back(points_[at(v)]);
    }
    return numbers_[at(v)];
  }

  const MeshCase& mesh_;
  std::vector<Vec3> points_;
  std::vector<Index> numbers_;
  std::set<Triangle> faces_;
  std::set<Edge> edges_;
  Mesh clean_;
};

Material material_of(Random& random) {
  Material material;
  material.density = random.one_in(4) ? double{random.pattern()} : random.magnitude(-2, 1);
  material.membrane = random.one_in(6) ? MembraneModel::none : MembraneModel::st_venant_kirchhoff;
  material.bending = random.one_in(6) ? BendingModel::none : BendingModel::discrete_hinge;
  material.bending_stiffness = random.one_in(4) ? 0 : random.magnitude(-9, 3);
  material.contact_stiffness = random.one_in(4) ? 100 : random.magnitude(-2, 8);
  material.friction = random.one_in(4) ? 0 : random.magnitude(-3, 1);
  material.solid_density = random.one_in(4) ? double{random.pattern()} : random.magnitude(1, 4);
  return material;
}

/// Prescribes the vertices without mass. In one of three bodies also prescribes a quarter of the other vertices.
void hold(Random& random, Scene& scene, const Body& body) {
  std::vector<bool> has_triangle(at(body.vertex_count));
  for (Index t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t)
    for (const Index v : scene.mesh.triangles[at(t)]) has_triangle[at(v - body.first_vertex)] = true;
  PrescribedMotion motion;
  motion.name = "held_" + body.name;
  const bool some_more = random.one_in(3);
  for (Index v = 0; v < body.vertex_count; ++v)
    if (!has_triangle[at(v)] || (some_more && random.one_in(4))) motion.vertices.push_back(body.first_vertex + v);
  if (!motion.vertices.empty()) scene.motions.push_back(std::move(motion));
}

void add_body(Random& random, Scene& scene, const MeshCase& mesh) {
  const Mesh clean = Cleaner(mesh).clean();
  if (clean.positions.empty()) return;
  Body body;
  body.name = "body_" + std::to_string(scene.bodies.size());
  body.fixed = random.one_in(4);
  body.material = material_of(random);
  const std::size_t number = append_body(scene, body, clean);
  if (!body.fixed) hold(random, scene, scene.bodies[number]);
}

CaseData finished(Scene scene) {
  for (Vec3& p : scene.mesh.positions) p = scaled(p, 2);
  scene.name = "rest";
  round_to_single(scene);
  RestStateCase c;
  c.topology = std::make_shared<Topology>(build_topology(scene));
  c.scene = std::make_shared<Scene>(std::move(scene));
  return c;
}

constexpr std::string_view soup = "soup", cloth = "cloth", any_bits = "bits", lattice = "lattice",
                           sheets = "ladder.sheets", fold = "ladder.fold", fan = "ladder.fan", book = "ladder.book",
                           strands = "ladder.strands";

/// Makes bodies from meshes of the detections' generator `family`.
template <const auto& family>
CaseData of(Random& random) {
  Scene scene;
  const int bodies = 1 + random.below(3);
  while (static_cast<int>(scene.bodies.size()) < bodies)
    add_body(random, scene, case_of<MeshCase>(find_generator(Stage::detect_vertex_facet, family).make(random)));
  return finished(std::move(scene));
}

/// Takes random bits for coordinates, as far as they give legal triangles, and for materials.
CaseData bits(Random& random) {
  RestStateCase test = case_of<RestStateCase>(of<any_bits>(random));
  Scene scene = *test.scene;
  for (Body& body : scene.bodies) {
    body.material.friction = random.pattern(0x1p-20f, 0x1p10f);
    for (double Material::*number : {&Material::density, &Material::bending_stiffness, &Material::contact_stiffness})
      body.material.*number = random.pattern();
  }
  test.scene = std::make_shared<Scene>(std::move(scene));
  return test;
}

/// Heights of the two triangles in edge lengths, and the angle between the triangles.
struct HingeShape {
  double height_a, height_b, angle;
};

/// Puts six hinges at the same position, each with vertices of its own; half of the cases have a rotation.
template <class Shape>
CaseData hinges(Random& random, Shape shape_of) {
  MeshBuilder builder;
  for (int k = 0; k < 6; ++k) {
    const HingeShape shape = shape_of();
    const double length = random.between(0.5, 1.5);
    const Index a = builder.add({}), b = builder.add({length, 0, 0});
    const Index c = builder.add({random.between(-0.3, 1.3) * length, shape.height_a * length, 0});
    const double height = shape.height_b * length;
    const Index d = builder.add(
        {random.between(-0.3, 1.3) * length, -height * std::cos(shape.angle), height * std::sin(shape.angle)});
    builder.triangles.push_back({a, b, c});
    builder.triangles.push_back({b, a, d});
  }
  constexpr double rotated = 1e-12;
  Scene scene;
  while (scene.bodies.empty()) add_body(random, scene, finish(random, builder, {random.one_in(2) ? rotated : 0, 0}));
  return finished(std::move(scene));
}

/// Approaches an angle of 0.
CaseData flat(Random& random) {
  return hinges(random, [&] { return HingeShape{random.between(0.1, 1.5), random.between(0.1, 1.5), random.rung()}; });
}

/// Approaches angles of ±π, where the sign jumps.
CaseData crease(Random& random) {
  return hinges(random, [&] {
    return HingeShape{random.between(0.1, 1.5), random.between(0.1, 1.5), std::numbers::pi + random.rung()};
  });
}

/// Approaches triangles of height 0, as far as single precision and the shortest legal coordinate allow.
CaseData needle(Random& random) {
  const auto height = [&] {
    return random.one_in(3) ? random.between(0.1, 1.5) : std::pow(10.0, -1 - random.below(10));
  };
  return hinges(random, [&] {
    return HingeShape{height(), height(), random.one_in(3) ? random.rung() : random.between(-3, 3)};
  });
}

/// Makes a block of tetrahedra, `height` times as high and with vertices moved a little, beside a sheet.
CaseData block_beside_sheet(Random& random, double height) {
  Scene scene;
  Body body;
  body.name = "solid";
  body.material = material_of(random);
  append_body(scene, body, jittered_block(random, random.magnitude(-2, 0), height));
  if (random.one_in(3)) hold(random, scene, scene.bodies.back());
  add_body(random, scene, case_of<MeshCase>(find_generator(Stage::detect_vertex_facet, cloth).make(random)));
  return finished(std::move(scene));
}

CaseData solid(Random& random) { return block_beside_sheet(random, random.between(0.3, 3)); }

/// Makes tetrahedra with nearly no thickness.
CaseData sliver(Random& random) { return block_beside_sheet(random, std::pow(10.0, -random.below(6))); }

/// Adds a rod of this plan as another body, after a symmetry of the cube and, in half of the cases, a rotation.
void add_rod(Random& random, Scene& scene, const RodPlan& plan, double scale) {
  Mesh mesh = rod_mesh(random, plan);
  permute(random, mesh.positions);
  if (random.one_in(2)) rotate(random, mesh.positions);
  for (Vec3& p : mesh.positions) p = scaled(p, scale);
  Body body;
  body.name = "rod_" + std::to_string(scene.bodies.size());
  body.fixed = random.one_in(6);
  body.material = material_of(random);
  make_rod(random, body, random.magnitude(-2, 3), scale, random.magnitude(-6, 0));
  append_body(scene, body, mesh);
}

/// Makes chains, rings and branches, alone or beside a sheet. Consecutive edges may have opposite directions.
CaseData rods(Random& random) {
  Scene scene;
  if (random.one_in(3))
    add_body(random, scene, case_of<MeshCase>(find_generator(Stage::detect_vertex_facet, cloth).make(random)));
  for (int k = 0, count = 1 + random.below(2); k < count; ++k)
    add_rod(random, scene, some_rod(random), random.one_in(4) ? std::ldexp(1.0, random.below(36) - 18) : 1);
  return finished(std::move(scene));
}

/// Makes rods in which each segment nearly continues or nearly reverses the previous segment. Later a random symmetry
/// of the cube maps some directions to near −e₃.
CaseData turned_rods(Random& random) {
  // Least angle between a segment and the reverse of the segment before; exact reversal is refused. Rounding moves ends
  // by 2⁻²⁴ of a few lengths, so it cannot reduce this angle to 0.
  constexpr double least_turn = 0x1p-18;
  Scene scene;
  RodPlan plan{.segments = 2 + random.below(4), .jitter = 0};
  const double rung = random.rung();
  plan.bend = random.one_in(2) ? std::numbers::pi - (std::abs(rung) < least_turn ? least_turn : rung) : rung;
  add_rod(random, scene, plan, 1);
  return finished(std::move(scene));
}

/// Makes five small bodies with equal, extreme and zero contact stiffnesses and frictions. Each pair of bodies needs a
/// MeetingMaterial.
CaseData meetings(Random& random) {
  constexpr std::array<double, 6> stiffnesses{0, 0, 100, 100, 0x1p-30, 0x1p40},
      frictions{0, 0, 0.2f, 0.2f, 0x1p10, 0x1p-20};
  Scene scene;
  for (int b = 0; b < 5; ++b) {
    MeshBuilder builder;
    builder.grid(1, 1, {}, {1, 0, 0}, {0, 1, 0});
    add_body(random, scene, finish(random, builder, {}));
    Material& material = scene.bodies.back().material;
    material.contact_stiffness = random.one_in(3) ? double{random.pattern()}
                                                  : random.pick(std::span<const double>(stiffnesses));
    material.friction = random.one_in(3) ? random.unit() : random.pick(std::span<const double>(frictions));
  }
  return finished(std::move(scene));
}

template <CaseData (*make)(Random&)>
CaseData isometric(Random& random) {
  RestStateCase test = case_of<RestStateCase>(make(random));
  Scene scene = *test.scene;
  bend_otherwise(random, scene);
  test.scene = std::make_shared<Scene>(std::move(scene));
  return test;
}

constexpr std::array<Generator, 20> table{{{soup, 15, true, of<soup>},
                                           {cloth, 20, true, of<cloth>},
                                           {any_bits, 8, false, bits},
                                           {lattice, 12, false, of<lattice>},
                                           {sheets, 6, false, of<sheets>},
                                           {fold, 8, false, of<fold>},
                                           {fan, 6, false, of<fan>},
                                           {book, 6, false, of<book>},
                                           {strands, 4, false, of<strands>},
                                           {"ladder.flat", 6, false, flat},
                                           {"ladder.crease", 6, false, crease},
                                           {"ladder.needle", 8, false, needle},
                                           {"ladder.meetings", 3, false, meetings},
                                           {"isometric", 10, true, isometric<of<cloth>>},
                                           {"ladder.isometric_flat", 3, false, isometric<flat>},
                                           {"ladder.isometric_needle", 6, false, isometric<needle>},
                                           {"solid", 10, true, solid, 0, Stage::tetrahedron},
                                           {"ladder.sliver", 6, false, sliver, 0, Stage::tetrahedron},
                                           {"rods", 10, true, rods, 0, Stage::orientation},
                                           {"ladder.rods", 6, false, turned_rods, 0, Stage::orientation}}};

}  // namespace

std::string problems_of(const RestStateCase& c) {
  Scene scene = *c.scene;
  round_to_single(scene);
  if (!(scene == *c.scene)) return "the scene's numbers are not those of single precision";
  for (Body& body : scene.bodies)
    if (body.material.contact_stiffness == 0) body.material.contact_stiffness = 1;
  const std::vector<Problem> problems = validate(scene);
  if (!problems.empty()) return describe(problems);
  std::vector<bool> held(scene.mesh.positions.size());
  for (const PrescribedMotion& motion : scene.motions)
    for (const Index v : motion.vertices) held[at(v)] = true;
  for (const Body& body : scene.bodies)
    for (Index v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v)
      if (!body.fixed && !body.is_solid() && !held[at(v)] && c.topology->vertex_triangles[at(v)].empty() &&
          !(body.material.rod && !c.topology->vertex_edges[at(v)].empty()))
        return "vertex " + std::to_string(v) + " moves and has no triangle";
  return {};
}

std::span<const Generator> rest_state_generators() { return table; }

}  // namespace ogc::compare
