// Panels are cut from developable surfaces, so that rest shapes are exact. If vertices of several panels have the same
// position, each of them is stitched to all others. All pairs of faces that touch at the start then lie between
// stitched vertices.
#include "experiments/scenes/dress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/problem/error.hpp"
#include "experiments/scenes/driven_contact.hpp"
#include "experiments/scenes/mannequin.hpp"
#include "experiments/scenes/materials.hpp"
#include "experiments/scenes/shapes.hpp"

namespace ogc::experiments {
namespace {

using compare::at, compare::Index;
using compare::Mesh;
using compare::Scene;
using compare::Vec3;

constexpr Index quarters = 4;                                              // panels around the body
constexpr double stitch_stiffness = 1000;                                  // [N/m]
constexpr double chest_radius = 0.145;                                     // [m]
constexpr double shoulders = 1.30, waist = 1.00, hips = 0.80, hem = 0.60;  // heights [m]
constexpr double hips_radius = 0.24, hem_radius = 0.30;                    // [m]

compare::Material wool() {
  constexpr double thickness = 0.328e-3, youngs_modulus = 76e3, poisson = 0.071, bending_share = 0.1;
  constexpr double tension = youngs_modulus * thickness;  // E·t [N/m]
  compare::Material material = driven_surface();
  material.density = 543.29 * thickness;
  material.membrane = compare::MembraneModel::stable_neo_hookean;
  material.lame_mu = tension / (2 * (1 + poisson));
  material.lame_lambda = tension * poisson / (1 - poisson * poisson);
  material.bending = compare::BendingModel::discrete_hinge;
  material.bending_stiffness = bending_share * tension * thickness * thickness / (12 * (1 - poisson * poisson));
  material.membrane_damping = material.bending_damping = 2e-6;
  return material;
}

void set_up(Scene& scene, double contact_radius, std::int64_t steps) {
  scene.name = "dress";
  scene.settings.time_step = 1.0 / 200;
  scene.settings.steps = steps;
  scene.settings.iterations = 20;
  scene.settings.contact_radius = contact_radius;
}

/// Appends a panel with its positions on the body's surface (start) and on the table (rest). Returns its first vertex.
Index append_panel(Scene& scene, const std::string& name, const Mesh& worn, const std::vector<Vec3>& flat) {
  const std::size_t body = append_body(scene, {.name = name, .material = wool()}, worn);
  const Index first = scene.bodies[body].first_vertex;
  std::copy(flat.begin(), flat.end(), scene.rest_positions.begin() + first);
  return first;
}

void stitch(Scene& scene, Index first, Index second, Index third = -1, double ratio = 0) {
  add_stitch(scene, first, second, third, ratio, stitch_stiffness);
}

/// Returns a point of a flattened piece of a cone or cylinder. The point is `down` [m] below the edge of radius
/// `upper`, and `turn` [rad] around the axis. `slant`: length of the piece from edge to edge.
Vec3 laid_flat(double upper, double lower, double slant, double down, double turn) {
  const double widening = (lower - upper) / slant;
  if (widening == 0) return {upper * turn, down, 0};
  const double from_apex = upper / widening + down, angle = widening * turn;
  return {from_apex * std::sin(angle), from_apex * std::cos(angle), 0};
}

/// Holds the point of the upper band to which a vertex of the lower band's upper edge is stitched. The point divides
/// the line from position `second` to `second` + 1 around the body (see Band) at `ratio`.
struct StitchPoint {
  Index second;
  double ratio;
};

/// Builds four panels around the body, from one height down to another. A `slot` is a position around the body, counted
/// from +z to +x over all panels. Where two panels meet, a slot has two vertices.
class Band {
 public:
  Band(const char* name, std::array<Index, 2> cells, std::array<double, 2> heights, std::array<double, 2> radii)
      : name_(name), rows_(cells[0]), columns_(cells[1]), heights_(heights), radii_(radii) {}

  /// Appends the band. Its upper edge lies on the straight lines between neighbouring vertices of the lower edge of
  /// `above`.
  void append(Scene& scene, const Band* above) {
    const Mesh cut{{}, cross_diagonals(rows_ + 1, columns_ + 1), {}};
    for (Index panel = 0; panel < quarters; ++panel) {
      Mesh worn = cut;
      std::vector<Vec3> flat;
      const double slant = std::hypot(heights_[0] - heights_[1], radii_[1] - radii_[0]);
      for (Index i = 0; i <= rows_; ++i) {
        for (Index j = 0; j <= columns_; ++j) {
          worn.positions.push_back(i == 0 && above ? above->between(scene, place_above(*above, panel * columns_ + j))
                                                   : on_cone(i, panel * columns_ + j));
          flat.push_back(
              laid_flat(radii_[0], radii_[1], slant, slant * i / rows_, std::numbers::pi / 2 * j / columns_));
        }
      }
      first_.push_back(append_panel(scene, name_ + std::to_string(panel + 1), worn, flat));
    }
    for (Index panel = 0; panel < quarters; ++panel) {
      for (Index i = 0; i <= rows_; ++i)
        stitch(scene, vertex(panel, i, columns_), vertex((panel + 1) % quarters, i, 0));
    }
    if (above) stitch_to(scene, *above);
  }

  Index slots() const { return quarters * columns_; }
  /// Returns the vertices of a row at position `slot` around the body: one, or two where panels meet.
  std::vector<Index> vertices_at(Index row, Index slot) const {
    const Index panel = slot / columns_ % quarters, column = slot % columns_;
    if (column > 0) return {vertex(panel, row, column)};
    return {vertex(panel, row, 0), vertex((panel + quarters - 1) % quarters, row, columns_)};
  }

 private:
  Index vertex(Index panel, Index row, Index column) const { return first_[at(panel)] + row * (columns_ + 1) + column; }

  Vec3 on_cone(Index row, Index slot) const {
    const double share = static_cast<double>(row) / rows_, radius = radii_[0] + share * (radii_[1] - radii_[0]);
    const double angle = 2 * std::numbers::pi * (slot % slots()) / slots();
    return tidy(
        {radius * std::sin(angle), heights_[0] + share * (heights_[1] - heights_[0]), radius * std::cos(angle)});
  }

  StitchPoint place_above(const Band& above, Index slot) const {
    const Index whole = slot * above.columns_ / columns_, rest = slot * above.columns_ % columns_;
    return {whole, static_cast<double>(rest) / columns_};
  }

  Vec3 between(const Scene& scene, const StitchPoint& place) const {
    const Vec3 &a = scene.mesh.positions[at(vertices_at(rows_, place.second)[0])],
               &b = scene.mesh.positions[at(vertices_at(rows_, place.second + 1)[0])];
    if (place.ratio == 0) return a;
    return tidy({a.x + place.ratio * (b.x - a.x), a.y, a.z + place.ratio * (b.z - a.z)});
  }

  void stitch_to(Scene& scene, const Band& above) const {
    for (Index slot = 0; slot < slots(); ++slot) {
      const auto [second, ratio] = place_above(above, slot);
      for (const Index v : vertices_at(0, slot)) {
        if (ratio == 0) {
          for (const Index u : above.vertices_at(above.rows_, second)) stitch(scene, v, u);
        } else {
          const Index panel = second / above.columns_, column = second % above.columns_;
          stitch(scene, v, above.vertex(panel, above.rows_, column), above.vertex(panel, above.rows_, column + 1),
                 ratio);
        }
      }
    }
  }

  std::string name_;
  Index rows_, columns_;
  std::array<double, 2> heights_, radii_;
  std::vector<Index> first_;  ///< first vertex by panel
};

/// Appends a strap: half a cone about an axis along x. The strap leads over the shoulder from the front of the bodice's
/// upper edge to its back. Each column of the strap's vertices begins and ends at a vertex of the bodice. `side`: −1 or
/// 1.
void append_strap(Scene& scene, const Band& bodice, Index cells, int side) {
  const Index around = bodice.slots();
  const auto slot_at = [&](double radians) {
    return static_cast<Index>(std::lround(around * radians / (2 * std::numbers::pi)));
  };
  const Index inner = slot_at(0.436), outer = std::max(inner + 1, slot_at(0.85)), columns = outer - inner;
  const auto front = [&](Index j) { return (around + side * (inner + j)) % around; };
  const auto back = [&](Index j) { return (around + around / 2 - side * (inner + j)) % around; };
  const auto edge = [&](Index slot) { return bodice.vertices_at(0, slot)[0]; };
  const auto angle = [&](Index j) { return 2 * std::numbers::pi * (inner + j) / around; };
  const double upper = chest_radius * std::cos(angle(0)), lower = chest_radius * std::cos(angle(columns));
  const double slant = std::hypot(upper - lower, chest_radius * (std::sin(angle(columns)) - std::sin(angle(0))));
  Mesh worn{{}, cross_diagonals(cells + 1, columns + 1), {}};
  std::vector<Vec3> flat;
  for (Index i = 0; i <= cells; ++i) {
    const double turn = std::numbers::pi * i / cells;
    for (Index j = 0; j <= columns; ++j) {
      const double radius = chest_radius * std::cos(angle(j));
      const Vec3 over = tidy(
          {side * chest_radius * std::sin(angle(j)), shoulders + radius * std::sin(turn), radius * std::cos(turn)});
      const bool is_end = i == 0 || i == cells;
      worn.positions.push_back(is_end ? scene.mesh.positions[at(edge(i == 0 ? front(j) : back(j)))] : over);
      flat.push_back(laid_flat(upper, lower, slant, slant * j / columns, turn));
    }
  }
  const Index first = append_panel(scene, side < 0 ? "strap_left" : "strap_right", worn, flat);
  for (Index j = 0; j <= columns; ++j) {
    stitch(scene, first + j, edge(front(j)));
    stitch(scene, first + cells * (columns + 1) + j, edge(back(j)));
  }
}

/// Sets lengths below 2⁻²⁰ m, which scenes may not have (method.md §2.4), to 0. Other lengths keep their published
/// values, so that different positions remain different.
Vec3 without_dust(const Vec3& v) {
  const auto swept = [](double x) { return std::abs(x) < 0x1p-20 ? 0 : x; };
  return {swept(v.x), swept(v.y), swept(v.z)};
}

/// Appends the triangles and vertices of panel `number` in their order. Sets `renumbered` to the index in the scene for
/// each vertex of the panel.
void append_panel(Scene& scene, const DressData& data, Index number, std::vector<Index>& renumbered) {
  const auto first = static_cast<Index>(scene.mesh.positions.size());
  std::vector<bool> is_in(data.pattern.size());
  for (std::size_t t = 0; t < data.panel_of_triangle.size(); ++t) {
    if (data.panel_of_triangle[t] != number) continue;
    for (const Index v : data.garment.triangles[t]) is_in[at(v)] = true;
  }
  Mesh worn;
  std::vector<Vec3> flat;
  for (std::size_t v = 0; v < is_in.size(); ++v) {
    if (!is_in[v]) continue;
    if (renumbered[v] >= 0)
      throw compare::InputError("stage.obj: vertex " + std::to_string(v + 1) +
                                " is of two panels; give one panel a vertex of its own");
    renumbered[v] = first + static_cast<Index>(worn.positions.size());
    worn.positions.push_back(without_dust(data.garment.positions[v]));
    flat.push_back(without_dust({data.pattern[v][0], data.pattern[v][1], 0}));
  }
  for (std::size_t t = 0; t < data.panel_of_triangle.size(); ++t) {
    const auto local = [&](Index v) { return renumbered[at(v)] - first; };
    const auto& [a, b, c] = data.garment.triangles[t];
    if (data.panel_of_triangle[t] == number) worn.triangles.push_back({local(a), local(b), local(c)});
  }
  append_panel(scene, "panel" + std::to_string(number), worn, flat);
}

void append_character(Scene& scene, const DressData& data) {
  constexpr double frame_seconds = 0.04;
  compare::PrescribedMotion motion;
  motion.name = "character";
  for (std::size_t v = 0; v < data.body.positions.size(); ++v)
    motion.vertices.push_back(static_cast<Index>(scene.mesh.positions.size() + v));
  for (std::size_t k = 0; k < data.motion.size(); ++k) {
    motion.keyframes.times.push_back(frame_seconds * static_cast<double>(k));
    std::vector<Vec3> frame = data.motion[k];
    std::ranges::transform(frame, frame.begin(), without_dust);
    const std::vector<compare::Vec3f> single = compare::to_single(frame);
    motion.keyframes.positions.insert(motion.keyframes.positions.end(), single.begin(), single.end());
    if (k == 0) append_body(scene, {.name = "body", .material = driven_surface()}, {frame, data.body.triangles, {}});
  }
  scene.motions.push_back(std::move(motion));
}

/// Excludes pairs of vertices that are stitched to the same vertex and start closer than `within` [m], for example
/// where seams meet. Stitches draw these vertices together, too. Neighbours in a panel are not excluded.
void exclude_junctions(Scene& scene, double within) {
  const compare::Topology topology = build_topology(scene);
  const compare::Exclusions direct = exclusions(scene);
  for (std::size_t v = 0; v < direct.partners.rows(); ++v) {
    const auto partners = direct.partners[v];
    for (auto a = partners.begin(); a != partners.end(); ++a) {
      for (auto b = a + 1; b != partners.end(); ++b) {
        const Vec3 &x = scene.mesh.positions[at(*a)], &y = scene.mesh.positions[at(*b)];
        const bool near = std::hypot(x.x - y.x, x.y - y.y, x.z - y.z) < within;
        if (near && find_edge(topology, *a, *b) < 0) scene.excluded_pairs.push_back({*a, *b});
      }
    }
  }
}

}  // namespace

Scene dress(const DressSizes& sizes) {
  Scene scene;
  const double radius = 2e-3 * 40 / sizes.bodice[0];
  set_up(scene, radius, sizes.steps);
  Band chest("bodice", sizes.bodice, {shoulders, waist}, {chest_radius, chest_radius}),
      skirt("hips", sizes.hips, {waist, hips}, {chest_radius, hips_radius}),
      lowest("hem", sizes.hem, {hips, hem}, {hips_radius, hem_radius});
  chest.append(scene, nullptr);
  skirt.append(scene, &chest);
  lowest.append(scene, &skirt);
  for (const int side : {-1, 1}) append_strap(scene, chest, sizes.strap, side);
  // radius of the largest ball about (0, 0.86 m, 0) inside the cone of the hips [m]
  constexpr double inside_hips = 0.191;
  append_mannequin(scene,
                   {.shoulders = shoulders,
                    .torso_radius = chest_radius - 1.5 * radius,
                    .pelvis_radius = inside_hips - 1.5 * radius,
                    .spacing = sizes.body_spacing},
                   driven_surface());
  for (const std::size_t b : driven_bodies(scene)) scene.bodies[b].contact = compare::BodyContact::volume;
  return scene;
}

Scene dress(const DressData& data, std::int64_t steps) {
  Scene scene;
  set_up(scene, 2e-3, steps);
  std::vector<Index> renumbered(data.pattern.size(), -1);
  const Index panels = *std::ranges::max_element(data.panel_of_triangle) + 1;
  for (Index number = 0; number < panels; ++number) append_panel(scene, data, number, renumbered);
  append_character(scene, data);
  for (const Stitch& s : data.stitches) {
    const Index first = renumbered[at(s.first)], second = renumbered[at(s.second)], third = renumbered[at(s.third)];
    stitch(scene, first, second, third, s.ratio);
    // A stitch to an end of an edge also excludes the other end, because in the published start the vertex meets the
    // edge.
    scene.excluded_pairs.push_back({first, s.ratio < 0.5 ? third : second});
  }
  exclude_junctions(scene, scene.settings.contact_radius);
  for (const std::size_t b : driven_bodies(scene)) scene.bodies[b].contact = compare::BodyContact::volume;
  return scene;
}

}  // namespace ogc::experiments
