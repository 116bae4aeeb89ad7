// Makes states for stage plane, in units of one edge length. General states come from the generators of the detections,
// with pairs within r_q. Ladders approach gaps of a few ulp, collapsed triangles and far origins, for which pairs have
// no plane. Other states have vertices with more pairs than a vertex can have planes, or fixed vertices on one side or
// both sides of a pair.
#include <algorithm>
#include <array>
#include <string_view>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/mesh_builder.hpp"
#include "compare/judge/cases/solid_block.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/tetrahedra.hpp"
#include "compare/stages/plane.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

float relaxation(Random& random) {
  constexpr std::array<float, 5> usual{0.45f, 0.45f, 0.25f, 0.49f, 1.0f / 3};
  return random.one_in(2) ? random.pick(std::span<const float>(usual)) : static_cast<float>(random.between(0.01, 0.49));
}

PlaneCase with_planes(Random& random, const MeshCase& mesh, float query_radius) {
  return {mesh.topology,
          mesh.rigid_groups,
          mesh.positions,
          query_radius,
          relaxation(random),
          mesh.partners,
          fixed_flags(mesh.rigid_groups)};
}

/// Makes a case from the detections' generator of this name. The r of the generated state becomes r_q, because a larger
/// r_q would give too many pairs.
CaseData of_detection(Random& random, std::string_view generator) {
  for (const Generator& row : detect_generators()) {
    if (row.name != generator) continue;
    const MeshCase mesh = case_of<MeshCase>(row.make(random));
    return with_planes(random, mesh, mesh.contact_radius);
  }
  throw InputError("detection has no generator '" + std::string(generator) + "'");
}

CaseData soup(Random& random) { return of_detection(random, "soup"); }
CaseData cloth(Random& random) { return of_detection(random, "cloth"); }
CaseData few(Random& random) { return of_detection(random, "few"); }
CaseData bits(Random& random) { return of_detection(random, "bits"); }
CaseData lattice(Random& random) { return of_detection(random, "lattice"); }
CaseData sheets(Random& random) { return of_detection(random, "ladder.sheets"); }
CaseData stack(Random& random) { return of_detection(random, "ladder.stack"); }
CaseData needles(Random& random) { return of_detection(random, "ladder.needles"); }
CaseData parallel(Random& random) { return of_detection(random, "ladder.parallel"); }
CaseData strands(Random& random) { return of_detection(random, "ladder.strands"); }
CaseData seams(Random& random) { return of_detection(random, "ladder.seams"); }
CaseData groups(Random& random) { return of_detection(random, "ladder.groups"); }

/// Turns the mesh into a case. `query_radius` is r_q in edge lengths.
CaseData finished(Random& random, const MeshBuilder& builder, double query_radius, double jitter) {
  const MeshCase mesh = finish(random, builder, {jitter, query_radius});
  return with_planes(random, mesh, mesh.contact_radius);
}

/// Makes two patches at distances down to 0. The second patch may be shifted, rotated or tilted.
CaseData gap(Random& random) {
  MeshBuilder builder;
  const double height = std::abs(random.rung()), turn = random.one_in(2) ? 0.8 : 1;
  builder.grid(1 + random.below(2), 1, {}, {1, 0, 0}, {0, 1, 0});
  const double shift = random.one_in(3) ? 0 : random.between(-1, 1);
  const double tilt = random.one_in(2) ? 0 : random.between(0, 1);
  builder.grid(1, 1, {shift, 0.3 * shift, height}, {turn, std::sqrt(1 - turn * turn), tilt},
               {-std::sqrt(1 - turn * turn), turn, 0});
  return finished(random, builder, random.between(0.1, 1), random.one_in(2) ? 0 : std::abs(random.rung()));
}

/// Makes triangles without area and edges without length, among triangles and edges of usual size.
CaseData collapsed(Random& random) {
  MeshBuilder builder;
  const double apart = random.magnitude(-3, 0);
  for (int i = 3 + random.below(6); i > 0; --i) {
    const Vec3 a = in_box(random, 0, 1.5), along = in_box(random, -1, 1);
    const Vec3 b = random.one_in(4) ? a : sum(a, along);
    const Vec3 c = random.one_in(2) ? sum(a, scaled(along, random.one_in(3) ? 1 : random.between(-0.5, 1.5)))
                                    : sum(b, scaled(in_box(random, -1, 1), random.one_in(2) ? random.rung() : 1));
    const Index first = builder.add(a);
    builder.add(b);
    builder.add(c);
    builder.triangles.push_back({first, first + 1, first + 2});
    if (random.one_in(3)) builder.loose_edges.push_back({builder.add(sum(a, scaled(along, apart))), first + 1});
  }
  for (Edge& e : builder.loose_edges) e = {std::min(e[0], e[1]), std::max(e[0], e[1])};
  return finished(random, builder, random.between(0.1, 1), 0);
}

/// Makes layers of fans whose hubs and rims have hundreds of pairs each, many of them at the same distance.
CaseData crowd(Random& random) {
  MeshBuilder builder;
  const int layers = 2 + random.below(3), rim = 12 + random.below(30);
  const double apart = random.magnitude(-3, -0.7);
  for (int k = 0; k < layers; ++k) builder.fan(rim, {0, 0, k * apart}, random.one_in(2), 0.2 * random.unit());
  return finished(random, builder, apart * random.between(1.05, layers), random.one_in(3) ? 0 : 0.3 * apart);
}

/// Puts a sheet above another one. In the lower sheet all, some or no vertices are fixed; in the upper sheet some or
/// none.
CaseData fixed(Random& random) {
  MeshBuilder builder;
  const double height = random.one_in(3) ? std::abs(random.rung()) : random.magnitude(-2, 0);
  builder.grid(1 + random.below(3), 1 + random.below(3), {}, {1, 0, 0}, {0, 1, 0});
  builder.group(0, random.one_in(4) ? -1 : 0);
  const auto first = static_cast<Index>(builder.points.size());
  builder.grid(1 + random.below(3), 1 + random.below(2), {0.3, 0.2, height}, {1, 0, 0}, {0, 1, 0});
  builder.group(first, -1);
  const bool is_mixed = random.one_in(2);
  for (Index& group : builder.groups)
    if (is_mixed && random.one_in(3)) group = random.below(3) - 1;
  return finished(random, builder, random.between(0.2, 1), random.one_in(3) ? 0 : std::abs(random.rung()));
}

/// Puts a corner of a small triangle into the corner of three walls, a rung from each wall.
CaseData corner(Random& random) {
  MeshBuilder builder;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<Vec3, 3> wall{Vec3{-0.2, -0.3, 0}, Vec3{3, 0, 0}, Vec3{0, 3, 0}};
    for (Vec3& p : wall) p = axis == 0 ? p : axis == 1 ? Vec3{0, p.x, p.y} : Vec3{p.y, 0, p.x};
    const Index first = builder.add(wall[0]);
    builder.add(wall[1]);
    builder.add(wall[2]);
    builder.triangles.push_back({first, first + 1, first + 2});
  }
  builder.group(0, random.one_in(2) ? 0 : -1);
  const auto near = [&] { return std::max(std::abs(random.rung()), 1e-7); };
  const Vec3 tip{near(), near(), near()};
  const Index first = builder.add(tip);
  builder.add(sum(tip, in_box(random, 0.2, 1)));
  builder.add(sum(tip, in_box(random, 0.2, 1)));
  builder.group(first, -1);
  builder.triangles.push_back({first, first + 1, first + 2});
  return finished(random, builder, random.between(0.2, 1), 0);
}

/// Puts sheets far from the origin, so that the gap between them is at most a few ulp of a coordinate. Coordinates are
/// at most 2¹⁰, so that they stay legal after the largest scaling.
CaseData far(Random& random) {
  MeshBuilder builder;
  const double height = random.magnitude(-4, -2);
  builder.grid(1 + random.below(2), 1, {}, {1, 0, 0}, {0, 1, 0});
  builder.grid(1, 1, {random.between(-0.5, 0.5), 0.3, height}, {0.8, 0.6, 0}, {-0.6, 0.8, 0});
  const Vec3 shift = scaled(in_box(random, -1, 1), std::min(0x1p10, height * std::pow(2, 16 + random.below(9))));
  for (Vec3& p : builder.points) p = sum(p, shift);
  return finished(random, builder, random.between(0.1, 1), 0);
}

/// Makes a block with an interior vertex below a sheet.
CaseData solid(Random& random) {
  Mesh block = jittered_block(random, 1, random.between(0.3, 1));
  block.triangles = boundary_triangles(block.tetrahedra);
  const auto above = static_cast<Index>(block.positions.size());
  const double height = random.magnitude(-2, 0);
  for (const Vec3& p : {Vec3{0, 0, 2}, Vec3{2, 0.5, 2}, Vec3{0.5, 2, 2}})
    block.positions.push_back(sum(p, {0, 0, height}));
  block.triangles.push_back({above, above + 1, above + 2});
  permute(random, block.positions);
  MeshCase mesh;
  mesh.topology = std::make_shared<Topology>(build_topology(block));
  mesh.positions = to_single(block.positions);
  mesh.rigid_groups.assign(mesh.positions.size(), -1);
  return with_planes(random, mesh, static_cast<float>(random.magnitude(-2, 0)));
}

/// Adds a random displacement of each free vertex, from 10⁻⁴ to 10² r_q. Displacements decide only where in a gap its
/// planes lie, so they may be larger than the gap.
CaseData divided(Random& random, const CaseData& data) {
  auto test = case_of<PlaneCase>(data);
  const double size = test.query_radius * random.magnitude(-4, 2), common = random.one_in(3) ? size : 0;
  const Vec3 together = scaled(in_box(random, -1, 1), common);
  const bool is_sparse = random.one_in(4);
  for (std::size_t v = 0; v < test.positions.size(); ++v) {
    Vec3 w = sum(together, scaled(in_box(random, -1, 1), size));
    if (is_sparse && random.one_in(2)) w = {};
    if (test.is_fixed[v] != 0) w = {};
    test.displacement.push_back({static_cast<float>(w.x), static_cast<float>(w.y), static_cast<float>(w.z)});
  }
  return test;
}

/// Makes a generic state with displacements. A plane divides each gap in proportion to the displacements of both sides.
CaseData approach(Random& random) {
  constexpr std::array<CaseData (*)(Random&), 4> states{soup, cloth, few, groups};
  return divided(random, random.pick(std::span<CaseData (*const)(Random&)>(states))(random));
}
/// Makes a state with displacements, and with pairs that are close, collapsed, crowded or fixed.
CaseData close_approach(Random& random) {
  constexpr std::array<CaseData (*)(Random&), 5> states{gap, collapsed, crowd, fixed, corner};
  return divided(random, random.pick(std::span<CaseData (*const)(Random&)>(states))(random));
}

/// Puts two sheets one above the other, so that the normal n is a coordinate axis. The vertices of each sheet stay, or
/// move along the line between the first vertices of the sheets, towards the other sheet or away. Some vertices also
/// get a random motion, which may be far larger.
CaseData along_normal(Random& random) {
  MeshBuilder builder;
  builder.grid(1, 1, {}, {1, 0, 0}, {0, 1, 0});
  const auto second = builder.points.size();
  builder.grid(1, 1, {random.between(-0.4, 0.4), 0.3, random.magnitude(-4, -0.5)}, {1, 0, 0}, {0, 1, 0});
  const MeshCase mesh = finish(random, builder, {0, random.between(0.2, 1)});
  PlaneCase test = with_planes(random, mesh, mesh.contact_radius);
  const Vec3f &a = mesh.positions[0], &b = mesh.positions[second];
  Vec3 up{double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z};
  const auto across = [&] {
    return random.one_in(2) ? Vec3{} : scaled(in_box(random, -1, 1), random.magnitude(-3, 2));
  };
  const double first_speed = random.one_in(4) ? 0 : random.rung(), second_speed = random.one_in(4) ? 0 : random.rung();
  for (std::size_t v = 0; v < test.positions.size(); ++v) {
    const double spread = random.one_in(2) ? 1 : random.unit();
    const Vec3 w = sum(scaled(up, spread * (v < second ? first_speed : second_speed)), across());
    test.displacement.push_back(test.is_fixed[v] != 0
                                    ? Vec3f{}
                                    : Vec3f{static_cast<float>(w.x), static_cast<float>(w.y), static_cast<float>(w.z)});
  }
  return test;
}

constexpr std::array<Generator, 23> table{{{"soup", 20, true, soup},
                                           {"cloth", 20, true, cloth},
                                           {"few", 4, true, few},
                                           {"bits", 10, false, bits},
                                           {"dust", 6, false, soup},
                                           {"lattice", 12, false, lattice},
                                           {"ladder.sheets", 6, false, sheets},
                                           {"ladder.stack", 6, false, stack},
                                           {"ladder.needles", 6, false, needles},
                                           {"ladder.parallel", 6, false, parallel},
                                           {"ladder.strands", 4, false, strands},
                                           {"ladder.seams", 4, false, seams},
                                           {"ladder.groups", 4, false, groups},
                                           {"ladder.gap", 12, false, gap},
                                           {"ladder.collapsed", 10, false, collapsed},
                                           {"ladder.crowd", 12, false, crowd},
                                           {"ladder.fixed", 10, false, fixed},
                                           {"ladder.corner", 8, false, corner},
                                           {"ladder.far", 8, false, far},
                                           {"approach", 8, true, approach, 0, std::nullopt, false, true},
                                           {"ladder.approach", 8, false, close_approach, 0, std::nullopt, false, true},
                                           {"ladder.speeds", 8, false, along_normal, 0, std::nullopt, false, true},
                                           {"solid", 4, false, solid, 0, Stage::tetrahedron}}};

}  // namespace

std::span<const Generator> plane_generators() { return table; }

}  // namespace ogc::compare
