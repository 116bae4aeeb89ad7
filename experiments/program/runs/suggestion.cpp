// Suggests settings for a mesh. One function for each number solves an equation or inequality and rounds the solution
// to the safe side.
#include "experiments/program/runs/suggestion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "compare/oracle/smallest_distances.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/material_table.hpp"
#include "experiments/program/output.hpp"

namespace ogc::experiments {

namespace {

using compare::Vec3;

constexpr double gravity = 9.81;  ///< [m/s²]
/// Edge length divided by the suggested r. The paper's cloths have an r between a fifth of an edge (twist) and a whole
/// edge.
constexpr double edges_a_radius = 4;
/// Edge length divided by the smallest r. Thinner contacts are below the resolution of any mesh.
constexpr double least_edges_a_radius = 20;
/// Largest r_q divided by r, because lists of candidates grow with the square of r_q.
constexpr double most_radii = 16;
constexpr double weights_held = 10;         ///< number of layers whose weight presses a contact to half of its radius
constexpr double detections_a_step = 4;     ///< largest number of detections in a step at the speed of the fall
constexpr double longest_step = 1.0 / 100;  ///< longest step of the paper's scenes [s]
constexpr double fewest_iterations = 10, most_iterations = 100;
/// Largest accepted error of the extension under weight, relative to the converged extension.
constexpr double most_excess = 0.01;
/// Factor on the exponent of method.md §7.7. Measured rates are 0.9 to 1.2 times that exponent, because modes are not
/// quite smooth, and a sweep goes colour by colour, not row by row (tests/experiments/program/runs/suggestion.cpp).
constexpr double least_rate = 0.9;
/// Number of sweeps per step that a resting stack needs for each layer: `sweeps_a_layer_and_radius` · g h²/r, at most
/// `most_sweeps_a_layer`. A step begins after all layers have fallen by g h², and each sweep transmits the ground's
/// support upwards. Stacks of 10 to 50 aligned sheets were run with g h² from r/64 to r/4. With 16 in place of 20 the
/// sheets keep their gaps; with 12 the stack is compressed until it trembles. If a layer falls by r or more, contacts
/// stop it at the start of the step. Then 8 sweeps per layer suffice (tests/experiments/stacks.cpp).
constexpr double sweeps_a_layer_and_radius = 20, most_sweeps_a_layer = 8;

struct Measures {
  double edge = 0;  ///< representative edge length [m]
  std::string edge_name;
  double gap = 0;        ///< smallest distance of primitives without a common vertex [m]; infinite if there is no pair
  double mass = 0;       ///< mean mass of a vertex; for a solid, of a surface vertex [kg]
  double speed = 0;      ///< speed at the end of the fall [m/s]
  double layers = 1;     ///< mean number of layers over the covered area
  double stiffness = 0;  ///< q of stiffness_by_mass [1/s²]
  double slowest = 0;    ///< ω² of slowest_stretch, for the mesh hung by one end [1/s²]
};

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

double area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
  return std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x) / 2;
}

/// Returns the area of all triangles as seen from above, divided by the area of their bounding rectangle; at least 1.
double layers_of(const compare::Mesh& mesh) {
  const auto flat = [&](compare::Index v) {
    const Vec3& p = mesh.positions[static_cast<std::size_t>(v)];
    return Vec3{p.x, 0, p.z};
  };
  Vec3 low = flat(0), high = low;
  double seen = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    seen += area(flat(a), flat(b), flat(c));
    for (const compare::Index v : {a, b, c}) {
      low = {std::min(low.x, flat(v).x), 0, std::min(low.z, flat(v).z)};
      high = {std::max(high.x, flat(v).x), 0, std::max(high.z, flat(v).z)};
    }
  }
  const double around = (high.x - low.x) * (high.z - low.z);
  return seen > around && around > 0 ? seen / around : 1;
}

double volume(const Vec3& o, const Vec3& p, const Vec3& q, const Vec3& r) {
  const Vec3 u{p.x - o.x, p.y - o.y, p.z - o.z}, v{q.x - o.x, q.y - o.y, q.z - o.z}, w{r.x - o.x, r.y - o.y, r.z - o.z};
  return std::abs(u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) + u.z * (v.x * w.y - v.y * w.x)) / 6;
}

/// Returns the mass [kg]: ρ A for cloth, ρ V for a solid.
double mass_of(const compare::Mesh& mesh, const compare::Material& material) {
  const auto at = [&](compare::Index v) { return mesh.positions[static_cast<std::size_t>(v)]; };
  double mass = 0;
  if (mesh.tetrahedra.empty()) {
    for (const auto& [a, b, c] : mesh.triangles) mass += material.density * area(at(a), at(b), at(c));
    return mass;
  }
  for (const auto& [a, b, c, d] : mesh.tetrahedra) mass += material.solid_density * volume(at(a), at(b), at(c), at(d));
  return mass;
}

std::size_t surface_vertices(const compare::Topology& topology) {
  std::size_t count = 0;
  for (compare::Index v = 0; v < topology.vertex_count; ++v) count += topology.on_surface(v);
  return count;
}

/// Returns Σ size ‖∇N‖² over the linear shape functions N of a simplex. ‖∇N‖ = face/(dimension · size), where `face` is
/// the size of the face opposite to the corner.
template <std::size_t n>
double gradients(double size, const std::array<double, n>& opposite) {
  constexpr double dimension = n - 1;
  double sum = 0;
  for (const double face : opposite) sum += face * face / (dimension * dimension * size);
  return sum;
}

/// Returns a vertex's stiffness divided by its mass, with fixed neighbours, averaged over directions [1/s²]: q = Σ size
/// ‖∇N‖² (μ + (λ + μ)/dimension) / mass, with the Lamé constants μ and λ. Stiffness and mass are summed over all
/// vertices before the division, because sweeps average a smooth mode in this way.
double stiffness_by_mass(const compare::Mesh& mesh, const compare::Material& material) {
  const auto at = [&](compare::Index v) { return mesh.positions[static_cast<std::size_t>(v)]; };
  const auto over = [](double mu, double lambda, double dimension) { return mu + (lambda + mu) / dimension; };
  double sum = 0;
  for (const auto& [i, j, k, l] : mesh.tetrahedra) {
    const Vec3 a = at(i), b = at(j), c = at(k), d = at(l);
    sum += gradients<4>(volume(a, b, c, d), {area(b, c, d), area(a, c, d), area(a, b, d), area(a, b, c)});
  }
  if (!mesh.tetrahedra.empty())
    return over(material.solid_mu, material.solid_lambda, 3) * sum / mass_of(mesh, material);
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = at(i), b = at(j), c = at(k);
    sum += gradients<3>(area(a, b, c), {distance(b, c), distance(a, c), distance(a, b)});
  }
  return over(material.lame_mu, material.lame_lambda, 2) * sum / mass_of(mesh, material);
}

/// Returns ω² of the slowest stretch of a strip with one fixed end [1/s²]: ω = π/(2L) √(E/ρ). L is the mesh's largest
/// extent along an axis. E is Young's modulus, for cloth in plane stress.
double slowest_stretch(const compare::Mesh& mesh, const compare::Material& material) {
  Vec3 low = mesh.positions[0], high = low;
  for (const Vec3& p : mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double longest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const double mu = material.lame_mu, lambda = material.lame_lambda;
  const double by_density = mesh.tetrahedra.empty() ? 4 * mu * (lambda + mu) / (lambda + 2 * mu) / material.density
                                                    : elasticity_of(material).young / material.solid_density;
  return std::pow(std::numbers::pi / (2 * longest), 2) * by_density;
}

Measures measure(const compare::Mesh& mesh, const compare::Material& material, double fall) {
  const auto at = [&](compare::Index v) { return mesh.positions[static_cast<std::size_t>(v)]; };
  const compare::Topology topology = compare::build_topology(mesh);
  std::vector<double> lengths;
  for (const auto& [a, b] : topology.edges) lengths.push_back(distance(at(a), at(b)));
  // If a tenth of the edges is far shorter than the others, as at the rim of a can, the length of these edges counts.
  std::ranges::sort(lengths);
  const double middle = lengths[lengths.size() / 2], shortest = 2 * lengths[lengths.size() / 10];
  const compare::SmallestDistances gaps = compare::smallest_distances(topology, mesh.positions);
  return {std::min(middle, shortest),
          middle <= shortest ? "the median edge" : "twice what a tenth of the edges is below",
          std::min(gaps.vertex_triangle, gaps.edge_edge),
          mass_of(mesh, material) / static_cast<double>(surface_vertices(topology)),
          std::sqrt(2 * gravity * std::max(0.0, fall)),
          mesh.tetrahedra.empty() ? layers_of(mesh) : 1,
          stiffness_by_mass(mesh, material),
          slowest_stretch(mesh, material)};
}

/// Returns `value` rounded down to two significant digits.
double two_digits(double value) {
  const double units = std::pow(10, 1 - std::floor(std::log10(value)));
  return std::floor(value * units) / units;
}

/// Returns the smallest number of the form 1, 2 or 5 times a power of ten that is at least `value`.
double round_number_above(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power) return step * power;
  return 10 * power;
}

/// Limits `value` to the range that the program accepts.
SuggestedNumber within(double minimum, double maximum, SuggestedNumber suggested) {
  const double value = std::clamp(suggested.value, minimum, maximum);
  if (value != suggested.value)
    suggested.reason += "; " + number(value) + " is the " + (value == minimum ? "smallest" : "largest") + " there is";
  return {value, suggested.reason};
}

SuggestedNumber within_setting(const std::string& name, SuggestedNumber suggested) {
  const auto info = std::ranges::find(compare::setting_table(), name, &compare::SettingInfo::name);
  return within(info->minimum, info->maximum, std::move(suggested));
}

SuggestedNumber within_stiffnesses(SuggestedNumber suggested) {
  const auto info = std::ranges::find(compare::material_table(), "contact_stiffness", &compare::MaterialInfo::name);
  return within(info->minimum, info->maximum, std::move(suggested));
}

SuggestedNumber radius_of(const Measures& mesh) {
  const double wanted = mesh.edge / edges_a_radius, least = mesh.edge / least_edges_a_radius;
  const std::string edge = mesh.edge_name + ", " + number(mesh.edge) + " m";
  if (mesh.gap >= wanted)
    return {two_digits(wanted),
            "a quarter of " + edge + "; nothing that shares no vertex is nearer (" + number(mesh.gap) + " m)"};
  if (mesh.gap > least)
    return {two_digits(mesh.gap),
            "the smallest gap, so that nothing is in contact at the start; it is below a quarter of " + edge};
  return {two_digits(least), "a twentieth of " + edge + ": the smallest gap, " + number(mesh.gap) +
                                 " m, is below it, and what is nearer than r at the start is pushed apart"};
}

SuggestedNumber query_radius_of(const Measures& mesh, double contact_radius) {
  const double least = compare::Settings{}.detection_radius_cap * contact_radius;
  const double value = std::clamp(two_digits(mesh.edge), least, most_radii * contact_radius);
  return {value,
          "about one edge, from 4 r to 16 r: a vertex may move γ_p r_q before contacts are detected again, and the "
          "lists stay short"};
}

SuggestedNumber stiffness_of(const Measures& mesh, double contact_radius) {
  const double weights = std::max(weights_held, std::ceil(mesh.layers));
  const double held = weights * mesh.mass * gravity / (contact_radius / 2);
  const double stopped = mesh.mass * mesh.speed * mesh.speed / (contact_radius * contact_radius / 4);
  const std::string vertex = "a vertex of " + number(mesh.mass) + " kg ";
  if (held >= stopped)
    return {round_number_above(held), vertex + "with " + number(weights) +
                                          " others on it is held at half of r: k_c r/2 ≥ " + number(weights) + " m g"};
  return {round_number_above(stopped), vertex + "at " + number(mesh.speed) +
                                           " m/s, the end of the fall, is stopped within half of r: k_c (r/2)² ≥ m v²"};
}

double layer_sweeps(const Measures& mesh, double contact_radius, double step) {
  const double fallen = gravity * step * step / contact_radius;
  return mesh.layers * std::min(sweeps_a_layer_and_radius * fallen, most_sweeps_a_layer);
}

SuggestedNumber time_step_of(const Measures& mesh, double contact_radius, double query_radius) {
  const double way = detections_a_step * compare::Settings{}.bounds_relaxation * query_radius;
  const double settled = std::sqrt(most_iterations * contact_radius /
                                   (sweeps_a_layer_and_radius * gravity * mesh.layers));
  if (layer_sweeps(mesh, contact_radius, longest_step) > most_iterations && mesh.speed * settled <= way)
    return {1 / round_number_above(1 / settled),
            number(mesh.layers) + " layers lie on one another: sweeps carry the ground's support up layer by layer, " +
                "and " + number(most_iterations) + " must do for what all of them fall in a step, g h²"};
  if (mesh.speed * longest_step <= way)
    return {longest_step, "the paper's; at " + number(mesh.speed) + " m/s a step is shorter than 4 γ_p r_q"};
  return {1 / round_number_above(mesh.speed / way),
          "at " + number(mesh.speed) +
              " m/s, the end of the fall, a step is not longer than 4 γ_p r_q, what four detections let a vertex move"};
}

/// Holds two numbers of method.md §7.7: `block` is D, `mode` is 1 + h² ω².
struct Sweeping {
  double block, mode;
  Sweeping(const Measures& mesh, double step)
      : block(1 + step * step * mesh.stiffness), mode(1 + step * step * mesh.slowest) {}
  /// Returns the excess of the extension after this number of sweeps, as a share of the converged extension. `enough`:
  /// number of sweeps after which the excess is at most 1 %.
  double excess(double iterations) const { return mode / std::expm1(2 * iterations * mode / block); }
  double enough() const { return block / (2 * mode * least_rate) * std::log1p(mode / most_excess); }
};

/// Returns the longest time step up to `step` for which `iterations` sweeps leave an excess (see Sweeping) of at most 1
/// %. Bisection works because enough() grows with the step.
double step_for(const Measures& mesh, double iterations, double step) {
  double low = 0, high = step;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = (low + high) / 2;
    (Sweeping(mesh, middle).enough() <= iterations ? low : high) = middle;
  }
  return low;
}

/// Describes by how much a hanging mesh is still too long after the sweeps. If this exceeds the limit, also describes
/// what helps.
std::string hanging(const Measures& mesh, double iterations, double step) {
  const Sweeping sweeping(mesh, step);
  const std::string text = "hung by an end the mesh stretches about " + number(100 * sweeping.excess(iterations)) +
                           " % more than it should (method.md §7.7, D = " + number(sweeping.block) + ")";
  if (iterations >= sweeping.enough()) return text;
  return text + "; 1 % takes iterations=" + number(std::ceil(sweeping.enough())) +
         ", or time_step=" + number(two_digits(step_for(mesh, iterations, step)), 2);
}

SuggestedNumber iterations_of(const Measures& mesh, const Suggestion& found) {
  const double stiffness = found.contact_stiffness.value, step = found.time_step.value;
  const double contacts = 2 * step * std::sqrt(stiffness / mesh.mass);
  const double layers = layer_sweeps(mesh, found.contact_radius.value, step);
  const double hung = Sweeping(mesh, step).enough();
  const double wanted = 10 * std::ceil(std::max({hung, contacts, layers}) / 10),
               iterations = std::clamp(wanted, fewest_iterations, most_iterations);
  std::string why;
  if (layers > std::max({hung, contacts, fewest_iterations}))
    why = number(mesh.layers) + " layers lie on one another, and sweeps carry the ground's support up one by one; ";
  else if (contacts > std::max(hung, fewest_iterations))
    why = "twice h √(k_c/m) = " + number(contacts / 2) + ": a contact is so much stiffer than inertia; ";
  if (wanted > most_iterations) why += "at most 100, as a shorter step helps more; ";
  return {iterations, why + hanging(mesh, iterations, step)};
}

}  // namespace

Suggestion suggest(const compare::Mesh& mesh, const compare::Material& material, double fall) {
  if (mesh.triangles.empty())
    throw compare::InputError("the mesh has no triangle; settings of cloth follow from triangles");
  const Measures measures = measure(mesh, material, fall);
  Suggestion result;
  result.edge_length = measures.edge;
  result.contact_radius = within_setting("contact_radius", radius_of(measures));
  result.query_radius = query_radius_of(measures, result.contact_radius.value);
  result.contact_stiffness = within_stiffnesses(stiffness_of(measures, result.contact_radius.value));
  const double contact_radius = result.contact_radius.value;
  result.time_step = within_setting("time_step", time_step_of(measures, contact_radius, result.query_radius.value));
  result.iterations = iterations_of(measures, result);
  result.excess_extension = Sweeping(measures, result.time_step.value).excess(result.iterations.value);
  return result;
}

void apply(const Suggestion& suggestion, compare::Scene& scene) {
  scene.settings.contact_radius = suggestion.contact_radius.value;
  scene.settings.detection_radius_cap = suggestion.query_radius.value / suggestion.contact_radius.value;
  scene.settings.time_step = suggestion.time_step.value;
  scene.settings.iterations = static_cast<std::int64_t>(suggestion.iterations.value);
  for (compare::Body& body : scene.bodies) body.material.contact_stiffness = suggestion.contact_stiffness.value;
}

}  // namespace ogc::experiments
