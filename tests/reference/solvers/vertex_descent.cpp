// Tests whether a vertex's update lowers its incremental potential (method.md §4.2, §7.1). If normals and closest
// points stay and the activation of no contact is in its logarithmic branch, an update never raises the potential;
// otherwise an update rarely raises it.
#include <algorithm>
#include <cmath>
#include <random>

#include "reference/energies/closest_form.hpp"
#include "reference/energies/contact_activation.hpp"
#include "reference/solvers/detection.hpp"
#include "reference/solvers/potential_batches.hpp"
#include "reference/solvers/vertex_system.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::ContactActivation;
using reference::State, reference::Triple, reference::operator+, reference::operator-, reference::operator*;

namespace {

constexpr int updates = 20000;

struct Kind {
  std::string name;
  ContactActivation activation = ContactActivation::ogc;
  bool has_membrane = false, has_hinges = false, has_friction = false;
  bool is_parallel = false;  ///< whether the edges of both sheets are parallel up to 10⁻⁴ of their length
};

double norm(const Triple<double>& a) { return std::hypot(a[0], a[1], a[2]); }

/// Two sheets near the contact radius, the upper one free, and a state in the bounds of a detection.
struct Pile {
  compare::Scene scene;
  compare::Topology topology;
  State start, x, target;
  reference::Detected found;
  std::mt19937 random;

  double any(double size) { return std::uniform_real_distribution<double>(-size, size)(random); }
  double magnitude(double low, double high) {
    return std::pow(10, std::uniform_real_distribution<double>(low, high)(random));
  }

  Pile(const Kind& kind, unsigned seed) : random(seed) {
    compare::Material material;
    material.membrane = kind.has_membrane ? compare::MembraneModel::st_venant_kirchhoff : compare::MembraneModel::none;
    material.bending = kind.has_hinges ? compare::BendingModel::discrete_hinge : compare::BendingModel::none;
    material.contact_stiffness = magnitude(0, 4);
    material.lame_mu = material.lame_lambda = magnitude(1, 4);
    material.bending_stiffness = magnitude(-7, -3);
    material.friction = kind.has_friction ? std::abs(any(1)) : 0;
    add_sheet(scene, 4, 0.02, magnitude(-3.5, -2.31), false, material);
    add_sheet(scene, 3, 0.03, 0, true, material);
    const double jitter = kind.is_parallel ? 1e-7 : 2e-4;
    for (compare::Vec3& p : scene.mesh.positions) p = {p.x + any(jitter), p.y + any(jitter), p.z + any(jitter)};
    scene.settings.contact_activation = kind.activation;
    round_to_single(scene);
    topology = build_topology(scene);
    start = reference::widened(compare::to_single(scene.mesh.positions));
    found = reference::detect(scene, topology, rigid_groups(scene), reference::rounded(start), 8e-3F);
    x = target = start;
    for (std::size_t v = 0; v < 16; ++v) {
      const double bound = double{found.bound[v]};
      const Triple<double> move{any(bound), any(bound), any(bound)};
      x[v] = x[v] + (norm(move) > bound ? bound / norm(move) : 1) * move;
      target[v] = target[v] + Triple<double>{any(2e-3), any(2e-3) - 1e-3, any(2e-3)};
    }
  }
};

/// The effect of one vertex's update on its potential; friction, normals and closest points are those of the old state.
struct Change {
  double predicted = 0;  ///< change by the quadratic model, negative [J]
  double real = 0;       ///< change of the potential [J]
  double model = 0;      ///< change of inertia, contact and friction only, with fixed normals and closest points [J]
};

template <class Term, std::size_t N>
double change_of(const Term& term, const State& before, const State& after) {
  return term.energy(reference::gathered<N>(term.vertex, after)) -
         term.energy(reference::gathered<N>(term.vertex, before));
}

template <class Vertices>
bool has(const Vertices& vertex, compare::Index v) {
  return std::find(vertex.begin(), vertex.end(), v) != vertex.end();
}

double energy_of(const reference::ContactTerm& term, double distance) {
  return term.mollifier * reference::contact_activation(term.activation, distance, term.contact_radius, term.stiffness);
}

Change change_by(const reference::Potential& potential, compare::Index v, const State& before, const State& after) {
  const auto i = static_cast<std::size_t>(v);
  const Triple<double> from = before[i] - potential.target()[i], to = after[i] - potential.target()[i];
  Change change;
  change.real = 0.5 * potential.inertia(i) * reference::dot(to - from, to + from);
  change.model = change.real;
  for (const auto& term : potential.elements<reference::TriangleKind>().terms())
    if (has(term.vertex, v)) change.real += change_of<reference::MembraneTerm, 3>(term, before, after);
  for (const auto& term : potential.elements<reference::HingeKind>().terms())
    if (has(term.vertex, v)) change.real += change_of<reference::HingeTerm, 4>(term, before, after);
  for (const reference::ContactTerm& term : potential.contacts()) {
    if (!has(term.vertex, v)) continue;
    const auto a = reference::contact_corners(term.sides, term.vertex, before),
               b = reference::contact_corners(term.sides, term.vertex, after);
    const reference::ClosestForm form = reference::closest_form(term.sides, a);
    const Triple<double> apart = reference::separation(form.weight, a);
    const double d = norm(apart), moved = reference::dot((1 / d) * apart, reference::separation(form.weight, b)),
                 end = norm(reference::separation(reference::closest_form(term.sides, b).weight, b));
    change.real += energy_of(term, end) - energy_of(term, d);
    change.model += energy_of(term, moved) - energy_of(term, d);
    if (const auto friction = potential.friction_at(term, a)) {
      const double slid = friction->energy(b) - friction->energy(a);
      change.real += slid;
      change.model += slid;
    }
  }
  return change;
}

/// Counts over all updates.
struct Count {
  int all = 0, rises = 0, large = 0;  ///< large: rises by more than a tenth of the model's decrease
  int bent = 0;                       ///< updates that truncation moves to a point where the model is higher
  double worst = 0;                   ///< largest rise as a share of the model's decrease
  std::vector<double> shares{};

  void add(const Change& change) {
    ++all;
    if (!(change.predicted < 0)) {
      bent += change.predicted > 0;
      return;
    }
    const double share = change.real / -change.predicted;
    if (!(share > 1e-9)) return;
    ++rises;
    large += share > 0.1;
    worst = std::max(worst, share);
    shares.push_back(share);
  }
  double median() {
    if (shares.empty()) return 0;
    std::nth_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2), shares.end());
    return shares[shares.size() / 2];
  }
};

/// Calls `sink(change)` for each free vertex's update at the pile's state.
template <class Sink>
void update_each(Pile& pile, bool is_truncated, Sink sink) {
  reference::Potential potential(pile.scene, pile.topology);
  potential.begin_step(pile.start, pile.target);
  potential.set_contacts(pile.found.sets, pile.start);
  reference::VertexSystems systems(potential, reference::ContactBlocks::own);
  const std::vector<compare::Index> colour(pile.x.size(), 0);
  for (compare::Index v = 0; v < 16; ++v) {
    const auto i = static_cast<std::size_t>(v);
    const reference::VertexSystem system = systems.at(v, {pile.x, pile.x, colour});
    const Triple<double> step = solved(system, system.force);
    State after = pile.x;
    after[i] = after[i] + step;
    const Triple<double> away = after[i] - pile.start[i];
    const double bound = double{pile.found.bound[i]};
    if (is_truncated && norm(away) > bound) after[i] = pile.start[i] + (bound / norm(away)) * away;
    const Triple<double> taken = after[i] - pile.x[i];
    const auto& b = system.block;
    const double bent = b[0] * taken[0] * taken[0] + b[3] * taken[1] * taken[1] + b[5] * taken[2] * taken[2] +
                        2 * (b[1] * taken[0] * taken[1] + b[2] * taken[0] * taken[2] + b[4] * taken[1] * taken[2]);
    Change change = change_by(potential, v, pile.x, after);
    change.predicted = 0.5 * bent - reference::dot(system.force, taken);
    sink(change);
  }
}

}  // namespace

TEST_CASE("the quadratic stage lies below its parabola from every distance on, beyond r, too", "[property]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0, 3);
  using Once = reference::Derivative<double, 1>;
  for (const ContactActivation activation : {ContactActivation::ogc, ContactActivation::quadratic})
    for (int i = 0; i < 100000; ++i) {
      const bool has_stages = activation == ContactActivation::ogc;
      const double r = 1, k = 2, least = has_stages ? 0.5 : 0;
      const double d = least + any(random), to = least + any(random), change = to - d;
      const Once at = reference::contact_activation(activation, Once(d, 0), r, k);
      const double end = reference::contact_activation(activation, to, r, k);
      REQUIRE(end <= at.value + at.slope[0] * change + 0.5 * k * change * change + 1e-15);
    }
}

TEST_CASE("an update whose normals and closest points stay lowers inertia, quadratic contact and friction",
          "[property]") {
  const Kind kind{.name = "quadratic", .activation = ContactActivation::quadratic, .has_friction = true};
  int moved = 0;
  for (unsigned seed = 0; moved < updates; ++seed) {
    Pile pile(kind, seed);
    update_each(pile, false, [&](const Change& change) {
      ++moved;
      REQUIRE(change.predicted <= 0);
      REQUIRE(change.model <= change.predicted + 1e-14);  // energies of some joules are rounded
    });
  }
}

TEST_CASE("where normals and closest points move, an update seldom raises the potential of its vertex", "[property]") {
  const std::vector<Kind> kinds{
      {.name = "quadratic", .activation = ContactActivation::quadratic},
      {.name = "ogc"},
      {.name = "ogc, friction", .has_friction = true},
      {.name = "quadratic, nearly parallel edges", .activation = ContactActivation::quadratic, .is_parallel = true},
      {.name = "ogc, nearly parallel edges", .is_parallel = true},
      {.name = "ogc, membranes", .has_membrane = true},
      {.name = "ogc, hinges", .has_hinges = true},
      {.name = "all", .has_membrane = true, .has_hinges = true, .has_friction = true}};
  for (const Kind& kind : kinds) {
    Count count;
    for (unsigned seed = 0; count.all < updates / 10; ++seed) {
      Pile pile(kind, 1000 + seed);
      update_each(pile, true, [&](const Change& change) { count.add(change); });
    }
    INFO(kind.name << ": of " << count.all << " updates " << count.rises << " raise the potential, " << count.large
                   << " by more than a tenth of what they promise to lower it by; the median by " << count.median()
                   << ", the most by " << count.worst << " of it");
    WARN(kind.name << ": " << count.all << ' ' << count.bent << ' ' << count.rises << ' ' << count.large << ' '
                   << count.median() << ' ' << count.worst);
    CHECK(count.all > 0);
  }
}
