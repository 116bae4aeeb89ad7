#include "fast/stages/sweep.hpp"

#include <cstring>
#include <random>

#include "fast/cpu/backend.hpp"
#include "fast/kernels/certificate.hpp"
#include "fast/stages/detection.hpp"
#include "fast/stages/step_detection.hpp"
#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

std::vector<PaddedVec> padded_of(const std::vector<Vec>& positions, int copies = 1) {
  std::vector<PaddedVec> padded;
  for (int k = 0; k < copies; ++k) {
    for (const Vec& x : positions) padded.emplace_back(x);
  }
  return padded;
}

// Holds two crumpled sheets, 0.6 r apart, with contacts of every kind. Start positions differ a little, so that damping
// and friction act.
struct Fixture {
  compare::Scene scene;
  compare::Topology topology;
  RestState rest;
  Colouring colouring;
  CpuBackend backend;
  std::vector<Vec> x, start, target, fresh, previous;
  std::vector<PaddedVec> padded, padded_start;  // x twice, and start
  std::vector<float> bound;
  StepControl control;
  std::unique_ptr<Detection<CpuBackend>> detection;
  std::unique_ptr<Sweep<CpuBackend>> sweep;

  /// `rough`: distance of vertices from the grids of their sheets [m]. `turn`: angle between the two grids.
  Fixture(bool second_fixed, int lanes, double friction = 0.3, double rough = 1e-3, double turn = 0) {
    compare::Material material;
    material.membrane_damping = 1e-3, material.bending_damping = 1e-3, material.bending_stiffness = 1e-5;
    material.friction = friction;
    scene = empty_scene();
    scene.settings.lanes = lanes;
    scene.settings.contact_radius = 0.02;
    add_sheet(scene, 9, 0.1, 0.012, false, material);
    add_sheet(scene, 8, 0.1, 0, second_fixed, material);
    for (std::size_t v = 0; v < 81; ++v) scene.mesh.positions[v].z += turn * scene.mesh.positions[v].x;
    compare::round_to_single(scene);
    topology = compare::build_topology(scene);
    rest = build_rest_state(scene, topology);
    colouring = colour_vertices(rest);
    std::mt19937 random(51);
    std::normal_distribution<double> normal;
    for (const compare::Vec3& p : scene.mesh.positions) {
      x.push_back(narrow(D3{p.x, p.y, p.z} + rough * D3{normal(random), normal(random), normal(random)}));
      start.push_back(narrow(wide(x.back()) + 2e-4 * D3{normal(random), normal(random), normal(random)}));
      target.push_back(narrow(wide(x.back()) + 2e-3 * D3{normal(random), normal(random), normal(random)}));
    }
    fresh = previous = x;
    bound.assign(x.size(), 1.0f);
    control.active = 1;
    control.query_radius = 0.03f;
    detection = std::make_unique<Detection<CpuBackend>>(backend, topology, compare::rigid_groups(scene));
    sweep = std::make_unique<Sweep<CpuBackend>>(backend, rest, colouring, topology, scene);
    detection->number_rows(sweep->row_places());
    detection->detect(x.data(), 0.02f, &control.query_radius, 0.45f);
    for (int grown = 0; grown < 8 && *detection->overflow() != 0; ++grown) {
      detection->grow();
      detection->detect(x.data(), 0.02f, &control.query_radius, 0.45f);
    }
    REQUIRE(*detection->overflow() == 0);
    sweep->reserve_contacts(detection->capacity());
    sweep->resolve_contacts(detection->view(), x.data());
  }

  SweepView view() {
    padded = padded_of(x, 2);
    padded_start = padded_of(start);
    SweepView v;
    sweep->begin(start.data());
    sweep->complete(v);
    v.start = {padded_start.data()};
    v.target = target.data();
    v.regions = {previous.data(), bound.data()};
    v.old = padded.data();
    v.to_fresh = static_cast<int>(x.size());
    v.position = fresh.data();
    v.control = &control;
    v.contact_radius = 0.02f;
    v.friction_limit = 1e-4f;
    return v;
  }
};

/// Makes a sweep's contact stream by a detection's launches, without a step's other work in these launches.
struct MadeStream {
  std::vector<Vec> previous;
  StepControl control;

  template <class Backend>
  StepLaunches launches(Detection<Backend>& detection, Sweep<Backend>& sweep, const std::vector<Vec>& at) {
    previous = at;
    const ContactView view = detection.view();
    return {{at.data(), {previous.data(), view.bound}, previous.data(), &control},
            {&control, detection.overflow()},
            sweep.contact_rows(view, detection.overflow()),
            sweep.slots(),
            sweep.resolve_contact(view, at.data())};
  }
};

bool same_bits(const std::vector<Vec>& a, const std::vector<Vec>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec)) == 0;
}

}  // namespace

namespace {

struct Totals {
  D3 force, torque;
  double size = 0;
};

Totals totals(Fixture& f) {
  const SweepView view = f.view();
  Totals sum;
  for (std::size_t slot = 0; slot < f.colouring.order.size(); ++slot) {
    const SweepVertex vertex = view.vertices[slot];
    const Vec own = f.x[static_cast<std::size_t>(vertex.vertex)];
    const D3 push = wide(GatherSurfaces{}(view, static_cast<int>(slot), vertex, own, SerialTeam<4>{}).force);
    sum.force += push;
    sum.torque += cross(wide(own), push);
    sum.size += length(push);
  }
  return sum;
}

// Each force has about 30 terms of about the force's size, with errors of some tens of 2⁻²⁴ each (see the tests of the
// energies).
constexpr double relative_error = 300 * 0x1p-24;

}  // namespace

TEST_CASE("all forces of a state add up to nothing: membrane, bending, damping, contact and friction", "[property]") {
  Fixture f(false, 4);
  REQUIRE(*f.detection->view().vertex_facet_count > 50);
  REQUIRE(*f.detection->view().edge_edge_count > 50);
  const Totals sum = totals(f);
  CHECK(sum.size > 0.01);
  CHECK(length(sum.force) <= relative_error * sum.size);
}

TEST_CASE("without friction, which acts across the gap, all torques add up to nothing too", "[property]") {
  Fixture f(false, 4, 0);
  const Totals sum = totals(f);
  CHECK(length(sum.force) <= relative_error * sum.size);
  CHECK(length(sum.torque) <= relative_error * sum.size * 0.1);
}

TEST_CASE("an iteration reads lower colours from the fresh buffer and all others from the old one", "[property]") {
  for (const bool second_fixed : {false, true}) {
    Fixture f(second_fixed, 8);
    const SweepView view = f.view();
    f.sweep->iterate(view);
    const std::vector<Vec> answer = f.fresh;
    // Solves each vertex by the rule. Before each colour, copies the positions written so far; the vertices of the
    // colour read this copy.
    std::vector<Vec> now = f.x;
    for (int c = 0; c < f.colouring.count; ++c) {
      std::vector<Vec> seen = now, out = now;
      for (int i = f.colouring.begin[static_cast<std::size_t>(c)];
           i < f.colouring.begin[static_cast<std::size_t>(c) + 1]; ++i) {
        SweepView naive = view;
        std::vector<PaddedVec> both = padded_of(seen, 2);
        naive.old = both.data();
        const SweepVertex vertex = view.vertices[i];
        const auto v = static_cast<std::size_t>(vertex.vertex);
        ForceAndBlock total = GatherSurfaces{}(naive, i, vertex, seen[v], SerialTeam<8>{});
        add_inertia(vertex.inertia, seen[v], f.target[v], total);
        out[v] = seen[v] + solve_symmetric(total.block, total.force, 1.0f / vertex.inertia);
      }
      now = out;
    }
    CHECK(same_bits(answer, now));
  }
}

TEST_CASE("what a sweep writes for others to read is what it gathers from itself", "[unit]") {
  Fixture f(true, 8);
  f.sweep->iterate(f.view());
  for (const int v : f.colouring.order) {
    const auto i = static_cast<std::size_t>(v);
    REQUIRE(same_bits({f.padded[f.x.size() + i]}, {f.fresh[i]}));
    REQUIRE(same_bits({f.padded[i]}, {f.x[i]}));
  }
}

TEST_CASE("the width of the sums changes only the last bits of an iteration, and the same width gives the same bits",
          "[property]") {
  Fixture a(false, 2), b(false, 16), c(false, 16);
  for (Fixture* f : {&a, &b, &c}) f->sweep->iterate(f->view());
  CHECK(same_bits(b.fresh, c.fresh));
  double worst = 0;
  for (std::size_t v = 0; v < a.x.size(); ++v) worst = std::max(worst, length(a.fresh[v] - b.fresh[v]));
  CHECK(worst > 0);
  CHECK(worst <= 1e-6);
}

TEST_CASE("positions are truncated before they are written, and each cut vertex counts once an iteration",
          "[property]") {
  Fixture f(false, 4);
  std::fill(f.bound.begin(), f.bound.end(), 1e-5f);
  f.sweep->iterate(f.view());
  int cut = 0;
  for (std::size_t v = 0; v < f.x.size(); ++v) {
    REQUIRE_FALSE(is_outside(Ball{f.previous[v], f.bound[v]}, f.fresh[v]));
    if (length(f.fresh[v] - f.previous[v]) > 0.9e-5) ++cut;
  }
  CHECK(f.control.cut > 10);
  CHECK(f.control.cut <= static_cast<int>(f.x.size()));
  CHECK(f.control.cut <= cut + 1);
}

TEST_CASE("a proposal that is not finite is not written and is counted", "[unit]") {
  Fixture f(false, 4);
  f.target[7] = {NAN, 0, 0};
  f.sweep->iterate(f.view());
  CHECK(f.control.not_finite == 1);
  CHECK(same_bits({f.fresh[7]}, {f.x[7]}));
}

TEST_CASE("a failed detection leaves the stream as it was", "[unit]") {
  Fixture f(false, 4);
  f.sweep->iterate(f.view());
  const std::vector<Vec> expected = f.fresh;
  Detection<CpuBackend> full(f.backend, f.topology, compare::rigid_groups(f.scene), 1);
  MadeStream made;
  full.detect(f.start.data(), 0.02F, &f.control.query_radius, 0.45F, made.launches(full, *f.sweep, f.start));
  REQUIRE(*full.overflow() != 0);
  CHECK((made.control.status & compare::step_list_grew) != 0);
  f.fresh = f.x;
  f.sweep->iterate(f.view());
  CHECK(same_bits(f.fresh, expected));
}

TEST_CASE("the stream made within a detection is that of its contacts", "[property]") {
  Fixture f(false, 4);
  f.sweep->iterate(f.view());
  const std::vector<Vec> expected = f.fresh;
  Sweep<CpuBackend> other(f.backend, f.rest, f.colouring, f.topology, f.scene);
  other.reserve_contacts(f.detection->capacity());
  other.begin(f.start.data());
  MadeStream made;
  f.detection->detect(f.x.data(), 0.02F, &f.control.query_radius, 0.45F, made.launches(*f.detection, other, f.x));
  CHECK(made.control.detections == 1);
  CHECK(same_bits(made.previous, f.x));
  f.fresh = f.x;
  SweepView with = f.view();
  other.complete(with);
  f.sweep->iterate(with);
  CHECK(same_bits(f.fresh, expected));
}

TEST_CASE("the contact rows of consecutive slots follow each other, for each kind", "[unit]") {
  Fixture f(true, 4);
  const SweepView view = f.view();
  const ContactView contacts = f.detection->view();
  int vertex_facet = 0, edge_edge = contacts.incidence_offsets[contacts.rows.vertex_count], filled = 0;
  for (int slot = 0; slot < f.sweep->slots(); ++slot) {
    const ContactRow row = view.contact_rows[slot];
    REQUIRE(row.vertex_facet.begin == vertex_facet);
    REQUIRE(row.edge_edge.begin == edge_edge);
    vertex_facet += row.vertex_facet.count, edge_edge += row.edge_edge.count;
    filled += row.vertex_facet.count > 0 && row.edge_edge.count > 0 ? 1 : 0;
  }
  CHECK(filled > f.sweep->slots() / 2);
  // The rows of fixed vertices follow.
  CHECK(vertex_facet < contacts.incidence_offsets[contacts.rows.vertex_count]);
  CHECK(edge_edge < contacts.incidence_offsets[contacts.rows.count()]);
}

TEST_CASE("where models are the usual ones, the sum of any scene has the bits of that of surfaces", "[property]") {
  Fixture f(false, 4);
  const SweepView view = f.view();
  for (std::size_t slot = 0; slot < f.colouring.order.size(); ++slot) {
    const SweepVertex vertex = view.vertices[slot];
    const Vec own = f.x[static_cast<std::size_t>(vertex.vertex)];
    const ForceAndBlock all = GatherAll{}(view, static_cast<int>(slot), vertex, own, SerialTeam<4>{});
    const ForceAndBlock expected = GatherSurfaces{}(view, static_cast<int>(slot), vertex, own, SerialTeam<4>{});
    CHECK(std::memcmp(&all, &expected, sizeof all) == 0);
  }
}

namespace {

/// Counts the vertices whose sum in packs differs from that of SerialTeam.
template <int W>
int other_bits(const Fixture& f, const SweepView& view, const PackKernels& kernels) {
  int count = 0;
  for (std::size_t slot = 0; slot < f.colouring.order.size(); ++slot) {
    const SweepVertex vertex = view.vertices[slot];
    const Vec own = f.x[static_cast<std::size_t>(vertex.vertex)];
    const ForceAndBlock packed = GatherPacked{kernels}(view, static_cast<int>(slot), vertex, own, SerialTeam<W>{});
    const ForceAndBlock one_by_one = GatherAll{}(view, static_cast<int>(slot), vertex, own, SerialTeam<W>{});
    count += std::memcmp(&packed, &one_by_one, sizeof packed) == 0 ? 0 : 1;
  }
  return count;
}

std::vector<const PackKernels*> all_kernels() {
#ifdef __x86_64__
  if (has_avx2()) return {&pack_kernels_baseline, &pack_kernels_avx2};
#endif
  return {&pack_kernels_baseline};
}

int other_bits(Fixture& f) {
  const SweepView view = f.view();
  int count = 0;
  for (const PackKernels* k : all_kernels()) {
    count += other_bits<2>(f, view, *k) + other_bits<4>(f, view, *k) + other_bits<8>(f, view, *k) +
             other_bits<16>(f, view, *k);
  }
  return count;
}

}  // namespace

TEST_CASE("the sum of a vertex in packs has the bits of the lanes in turn, for every width", "[property]") {
  Fixture f(false, 4);
  REQUIRE(*f.detection->view().edge_edge_count > 50);
  CHECK(other_bits(f) == 0);
}

TEST_CASE("that holds without damping, and where triangles and edges have collapsed", "[property]") {
  Fixture f(false, 4);
  for (const int v : {5, 23, 40, 61}) {
    const auto i = static_cast<std::size_t>(v);
    f.x[i] = f.x[i + 1];                             // an edge without length
    f.x[i + 9] = 0.5f * (f.x[i + 10] + f.x[i + 8]);  // a triangle without area
  }
  CHECK(other_bits(f) == 0);
  for (SurfaceMaterial& material : f.rest.materials) material.membrane_damping = material.bending_damping = 0;
  f.sweep = std::make_unique<Sweep<CpuBackend>>(f.backend, f.rest, f.colouring, f.topology, f.scene);
  f.detection->number_rows(f.sweep->row_places());  // the same numbers; those of the old sweep are gone
  f.sweep->reserve_contacts(f.detection->capacity());
  f.sweep->resolve_contacts(f.detection->view(), f.x.data());
  CHECK(other_bits(f) == 0);
}

TEST_CASE("that holds for a contact on either side of the distance below which there is no normal", "[property]") {
  Fixture f(false, 4);
  const ContactView view = f.detection->view();
  const auto alone = [&](int k) { return view.vertex_facet[k].corner[2] >= 0; };
  int record = 0;
  while (record < *view.vertex_facet_count && !alone(record)) ++record;
  REQUIRE(record < *view.vertex_facet_count);
  const auto at = [&](int v) -> Vec& { return f.x[static_cast<std::size_t>(v)]; };
  const VertexFacetRecord& contact = view.vertex_facet[record];
  // the vertex is over the triangle at weights of a quarter, where all differences except the height are exact
  at(contact.corner[0]) = {0, 0, 0}, at(contact.corner[1]) = {1, 0, 0}, at(contact.corner[2]) = {0, 0, 1};
  for (const float squared : {0x1p-124F, 0x1.8p-126F, 0x1.8p-127F, 0x1.8p-128F, 0x1p-140F, 0.0F}) {
    at(contact.vertex) = {0.25F, std::sqrt(squared), 0.25F};
    CHECK(other_bits(f) == 0);
  }
}

TEST_CASE("that holds for edges on either side of the limit below which two count as parallel", "[property]") {
  int below = 0, above = 0;
  for (int k = 0; k < 60; ++k) {  // few nearly parallel pairs pass the block test
    Fixture f(false, 4, 0.3, 2e-6, 0.72e-3 + k * 0.01e-3);
    const ContactView view = f.detection->view();
    for (int i = 0; i < *view.edge_edge_count; ++i) {
      const auto direction = [&](int edge) {
        const auto& ends = f.topology.edges[static_cast<std::size_t>(edge)];
        return wide(f.x[static_cast<std::size_t>(ends[1])]) - wide(f.x[static_cast<std::size_t>(ends[0])]);
      };
      const EdgeEdgeRecord& record = view.edge_edge[i];
      const D3 a = direction(record.first_edge), b = direction(record.second_edge), normal = cross(a, b);
      // closest_on_segments treats edges with a share below 1 as parallel
      const double share = dot(normal, normal) / (1e-6 * dot(a, a) * dot(b, b));
      below += share > 0.5 && share < 1;
      above += share > 1 && share < 2;
    }
    CHECK(other_bits(f) == 0);
  }
  CHECK(below > 20);
  CHECK(above > 3);
}

TEST_CASE(
    "the sum of a vertex with springs and of bodies with any models in packs has the bits of the lanes in turn, for "
    "every width",
    "[property]") {
  const auto membrane = GENERATE(compare::MembraneModel::st_venant_kirchhoff,
                                 compare::MembraneModel::stable_neo_hookean);
  const auto bending = GENERATE(compare::BendingModel::discrete_hinge, compare::BendingModel::isometric_quadratic);
  const auto damping = GENERATE(compare::DampingForm::strain, compare::DampingForm::per_vertex);
  Fixture f(false, 4);
  compare::Scene scene = f.scene;
  scene.bodies[0].material.membrane = membrane, scene.bodies[0].material.bending = bending;
  scene.settings.damping = damping;
  scene.springs = {{3, 140, 0.5, 0, 1e-3}, {3, 80, 0.5, 1e-3, 0}, {4, 90, 0.25, 0, 0}};
  for (compare::Index v = 91; v < 100; ++v) scene.springs.push_back({3, v, 0.1 * static_cast<double>(v), 0, 1e-4});
  const RestState rest = build_rest_state(scene, f.topology);
  Sweep<CpuBackend> sweep(f.backend, rest, f.colouring, f.topology, scene);
  sweep.reserve_contacts(f.detection->capacity());
  sweep.resolve_contacts(f.detection->view(), f.x.data());
  SweepView view = f.view();
  sweep.complete(view);
  for (const PackKernels* kernels : all_kernels()) {
    CHECK(other_bits<4>(f, view, *kernels) == 0);
    CHECK(other_bits<8>(f, view, *kernels) == 0);
    CHECK(other_bits<16>(f, view, *kernels) == 0);
  }
}

TEST_CASE("sums have as many lanes as a scene asks for, or else as its size does, a power of two", "[unit]") {
  CHECK(default_lanes(1) == 16);
  CHECK(default_lanes(20000) == 16);
  CHECK(default_lanes(20001) == 8);
  CHECK(default_lanes(300000) == 8);
  CHECK(default_lanes(300001) == 4);
  CHECK(default_lanes(1, true) == 2);
  CHECK(Fixture(false, 0).sweep->lanes() == 16);
  for (const int lanes : {2, 4, 8, 16}) CHECK(Fixture(false, lanes).sweep->lanes() == lanes);
}

TEST_CASE("a stencil that only one free vertex has is not forgotten", "[unit]") {
  compare::Scene scene = empty_scene();
  compare::Material material;
  material.bending = compare::BendingModel::isometric_quadratic;
  add_sheet(scene, 2, 0.1, 0, false, material);
  compare::PrescribedMotion motion;
  motion.vertices = {0, 1, 2};
  scene.motions.push_back(motion);
  scene.springs = {{3, 0, 1, 0, 0}};
  const compare::Topology topology = compare::build_topology(scene);
  const RestState rest = build_rest_state(scene, topology);
  REQUIRE(rest.hinges.size() == 1);
  CpuBackend backend;
  const Sweep<CpuBackend> sweep(backend, rest, colour_vertices(rest), topology, scene);
  SweepView view;
  sweep.complete(view);
  CHECK(view.hinges.beside != nullptr);
  CHECK(view.springs.rows != nullptr);
  scene.springs.clear();
  scene.bodies[0].material.bending = compare::BendingModel::discrete_hinge;
  const RestState plain = build_rest_state(scene, topology);
  const Sweep<CpuBackend> other(backend, plain, colour_vertices(plain), topology, scene);
  other.complete(view);
  CHECK(view.hinges.beside == nullptr);
  CHECK(view.springs.rows == nullptr);
}
