// Tests the dress of Fig. 13: 14 panels that touch only at their stitches, and a walking body. Also tests the published
// data set if it is available.
#include "experiments/scenes/dress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "compare/oracle/audit.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"
#include "experiments/scenes/registry.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"
#include "tests/experiments/scenes/stitches.hpp"

using namespace ogc::compare;
using namespace ogc::experiments;
using namespace ogc::tests;

namespace {

Index free_vertices(const Scene& scene) { return scene.motions[0].vertices.front(); }  // the body comes last

/// A data set with two panels of one triangle each, stitched at an edge, and a body of one triangle that rises over
/// three frames.
struct SmallData {
  std::string stage =
      "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 0 0\nv 1 0 0\nv 0 0 -1\nvt 0 0\nvt 1 0\nvt 0 1\nvt 5 0\nvt 6 0\nvt 5 1\n"
      "g panel0\nf 1/1 2/2 3/3\ng panel1\nf 4/4 6/6 5/5\nseam 0 1\nstitch 3 0 1 0.000000e+000\nstitch 4 0 1 1\n";
  std::string drape =
      "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 0 0\nv 1 0 0\nv 0 0 -1\nv 0 -1 0\nv 1 -1 0\nv 0 -1 1\nf 1 2 3\nf 4 6 5\nf 7 8 "
      "9\n";
  std::array<std::string, 3> shells{"v 0 -0.25 0\nv 1 -0.25 0\nv 0 -0.25 1\nf 1 2 3\n",
                                    "v 0 -0.125 0\nv 1 -0.125 0\nv 0 -0.125 1\n", "v 0 0 0\nv 1 0 0\nv 0 0 1\n"};
  DressCounts counts{
      .vertices = 6, .triangles = 2, .panels = 2, .stitches = 2, .body_vertices = 3, .body_triangles = 1, .frames = 3};

  DressData read(const TemporaryFolder& folder) const {
    std::filesystem::create_directories(folder / "dress_knife");
    folder.write("dress_knife/stage.obj", stage);
    folder.write("drape.obj", drape);
    for (std::size_t k = 0; k < shells.size(); ++k) {
      if (!shells[k].empty()) folder.write("shell" + std::to_string(k) + ".obj", shells[k]);
    }
    return read_dress_data(folder / "", counts);
  }
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

}  // namespace

TEST_CASE("dress has the paper's numbers, and the stand-in about the data set's size", "[unit]") {
  const Scene scene = make_scene("dress", Scale::paper);
  REQUIRE(scene.bodies.size() == 15);
  CHECK(free_vertices(scene) == 15702);
  CHECK(scene.bodies.back().first_triangle == 29472);
  CHECK(scene.bodies.back().name == "body");
  CHECK(scene.bodies.back().vertex_count == 12798);
  CHECK(scene.bodies.back().triangle_count == 25540);
  CHECK(scene.motions[0].vertices.size() == 12798);
  CHECK(scene.settings.contact_radius == static_cast<double>(2e-3f));
  CHECK(scene.settings.time_step == static_cast<double>(1.0f / 200));
  CHECK(scene.settings.iterations == 20);
  CHECK(scene.settings.detection_fraction == static_cast<double>(0.01f));
  CHECK(scene.bodies.back().is_volume());
  CHECK(std::ranges::count_if(scene.bodies, &Body::is_volume) == 1);
  CHECK(scene.settings.steps == 968);
  for (const Body& body : scene.bodies) {
    CHECK(body.material.contact_stiffness == 100);
    CHECK(body.material.friction == 0.5);
    CHECK(body.material.density > 0);
  }
  // The plane-stress constants were computed by hand from E·t = 76 kPa · 0.328 mm = 24.93 N/m and ν = 0.071. The area
  // density is 543.29 · 0.328e-3 kg/m².
  const Material& cloth = scene.bodies[0].material;
  CHECK(cloth.lame_mu == Approx(11.638).epsilon(1e-4));
  CHECK(cloth.lame_lambda == Approx(1.7790).epsilon(1e-4));
  CHECK(cloth.density == Approx(0.17820).epsilon(1e-4));
  CHECK(cloth.bending_stiffness == Approx(2.2463e-8).epsilon(1e-3));
}

TEST_CASE("dress: what meets at the start are direct stitch partners, which lie on each other", "[unit]") {
  for (const Scale scale : {Scale::smoke, Scale::small, Scale::paper}) {
    const Scene scene = make_scene("dress", scale);
    CHECK(largest_gap(scene) < 1e-6);
    const StitchedStart start = stitched_start(scene);
    CHECK(start.between_partners > 0);
    CHECK(start.others == 0);
  }
}

TEST_CASE("dress: at one place are stitches between all pairs of vertices", "[unit]") {
  const Scene scene = make_scene("dress", Scale::smoke);
  std::map<std::array<double, 3>, std::vector<Index>> places;
  for (Index v = 0; v < free_vertices(scene); ++v) {
    const Vec3& x = scene.mesh.positions[static_cast<std::size_t>(v)];
    places[{x.x, x.y, x.z}].push_back(v);
  }
  const Exclusions left_out = exclusions(scene);
  std::size_t most = 0;
  for (const auto& [place, vertices] : places) {
    most = std::max(most, vertices.size());
    for (const Index u : vertices) {
      for (const Index v : vertices)
        CHECK((u == v || std::ranges::count(left_out.partners[static_cast<std::size_t>(u)], v) == 1));
    }
  }
  CHECK(most == 4);  // where seams around the body and along it cross
}

TEST_CASE("dress: panels are cut so that only straps are strained at the start", "[unit]") {
  const Scene scene = make_scene("dress", Scale::paper);
  double straps = 0, others = 0;
  for (const Body& body : scene.bodies) {
    if (body.name == "body") continue;
    double& largest = body.name.starts_with("strap") ? straps : others;
    largest = std::max(largest, largest_edge_strain(scene, body));
  }
  CHECK(others < 3e-3);  // chords replace arcs of 3°
  CHECK(straps < 0.023);
}

TEST_CASE("dress: the body stands, then walks slower than 2 m/s", "[unit]") {
  const Scene scene = make_scene("dress", Scale::small);
  const std::vector<Vec3f> start = to_single(scene.mesh.positions);
  const std::vector<Vec3f> first = prescribed_targets(scene, scene.motions[0], 0);
  CHECK(std::equal(first.begin(), first.end(), start.begin() + free_vertices(scene)));
  CHECK(scene.motions[0].keyframes.times.back() == Approx(4.84));
  const double speed = largest_step(scene) / scene.settings.time_step;
  CHECK(speed < 2);
  CHECK(speed > 1);
}

TEST_CASE(
    "a data set becomes a scene: panels are bodies, stitches join them to edges, the character moves as its files say",
    "[unit]") {
  const TemporaryFolder folder;
  const DressData data = SmallData().read(folder);
  Scene scene = dress(data, 7);
  CHECK(scene.bodies.back().is_volume());
  scene.bodies.back().contact = BodyContact::surface;  // this body encloses no volume
  CHECK(describe(validate(scene)).empty());
  REQUIRE(scene.bodies.size() == 3);
  CHECK(scene.rest_positions[3] == Vec3{5, 0, 0});
  CHECK(scene.mesh.triangles[1] == Triangle{3, 5, 4});
  REQUIRE(scene.springs.size() == 2);
  CHECK(scene.springs[0] == Spring{3, 0, 1000});
  CHECK(scene.springs[1] == Spring{4, 1, 1000});
  // A stitch connects a vertex to an edge, so both ends of the edge are partners of the vertex. Two vertices stitched
  // to the same vertex are partners only if they are at the same place.
  const Exclusions left_out = exclusions(scene);
  for (const Index v : {3, 4})
    CHECK(std::ranges::equal(left_out.partners[static_cast<std::size_t>(v)], std::array{0, 1}));
  CHECK(stitched_start(scene).others == 0);
  // The body's frames in the data set begin 0.75 m above the body of the draped start. So the motion is moved down by
  // 0.75 m.
  const PrescribedMotion& motion = scene.motions[0];
  CHECK(prescribed_targets(scene, motion, 0)[0] == Vec3f{0, -1, 0});
  CHECK(prescribed_targets(scene, motion, 0.08)[2] == Vec3f{0, -0.75f, 1});
  CHECK(prescribed_targets(scene, motion, 1)[2] == Vec3f{0, -0.75f, 1});
  CHECK(prescribed_targets(scene, motion, 0.02)[1].y == Approx(-0.9375));
}

TEST_CASE("where seams of data meet, vertices stitched to the same one are no contacts, neighbours in a panel are",
          "[unit]") {
  SmallData files;
  // A third panel is added. One of its corners is 1 mm from a corner of the second panel, and both corners are stitched
  // to the same vertex.
  files.stage = replaced(files.stage, "g panel0", "v 0 0 0\nv 0 1 0\nv -1 0 0\nvt 9 0\nvt 9 1\nvt 8 0\ng panel0");
  files.stage += "g panel2\nf 7/7 8/8 9/9\nstitch 6 0 1 0\n";
  files.drape = replaced(files.drape, "v 0 -1 0\n", "v 0 0.001 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\n");
  files.drape = replaced(files.drape, "f 7 8 9\n", "f 7 8 9\nf 10 11 12\n");
  files.counts.vertices = 9;
  files.counts.triangles = files.counts.panels = files.counts.stitches = 3;
  const TemporaryFolder folder;
  const Exclusions left_out = exclusions(dress(files.read(folder), 1));
  const auto partners = [&](std::size_t v) {
    return std::vector<Index>(left_out.partners[v].begin(), left_out.partners[v].end());
  };
  CHECK(partners(3) == std::vector<Index>{0, 1, 6});
  CHECK(partners(6) == std::vector<Index>{0, 1, 3});
  CHECK(partners(0) == std::vector<Index>{3, 4, 6});
}

TEST_CASE("lengths of data below 2⁻²⁰ m become 0, all others stay", "[unit]") {
  SmallData files;
  files.drape = replaced(files.drape, "v 1 0 0\n", "v 1 -3e-7 2e-6\n");
  const TemporaryFolder folder;
  CHECK(dress(files.read(folder), 1).mesh.positions[1] == Vec3{1, 0, 2e-6});
}

TEST_CASE("bad data are refused by file", "[unit]") {
  const TemporaryFolder folder;
  SmallData files;
  const auto error = [&] {
    try {
      dress(files.read(folder), 1);
    } catch (const InputError& problem) {
      return std::string(problem.what());
    }
    return std::string("no error");
  };
  SECTION("stage.obj cut off") {
    files.stage.resize(files.stage.find("stitch 4"));
    CHECK_THAT(error(), ContainsSubstring("stage.obj: has 1 stitches instead of 2"));
  }
  SECTION("stage.obj cut off within a line") {
    files.stage.resize(files.stage.find("e+000"));
    files.stage.resize(files.stage.rfind(' '));
    CHECK_THAT(error(), ContainsSubstring("stage.obj: line 18: '' is no number"));
  }
  SECTION("a stitch to a vertex that does not exist") {
    files.stage = replaced(files.stage, "stitch 4 0 1 1", "stitch 4 0 6 1");
    CHECK_THAT(
        error(),
        ContainsSubstring("stage.obj: stitch 4 0 6 names a vertex that does not exist; they are numbered from 0 to 5"));
  }
  SECTION("a stitch to itself") {
    files.stage = replaced(files.stage, "stitch 4 0 1 1", "stitch 4 4 1 1");
    CHECK_THAT(error(), ContainsSubstring("stitch 4 4 1 does not join"));
  }
  SECTION("a face beyond the vertices") {
    files.stage = replaced(files.stage, "f 4/4 6/6 5/5", "f 4/4 7/7 5/5");
    CHECK_THAT(error(), ContainsSubstring("stage.obj: a face names vertex 7 of 6"));
  }
  SECTION("a pattern numbered otherwise") {
    files.stage = replaced(files.stage, "f 4/4 6/6 5/5", "f 4/4 6/5 5/6");
    CHECK_THAT(error(), ContainsSubstring("stage.obj: vertices and points of the pattern are numbered differently"));
  }
  SECTION("a vertex of two panels") {
    files.stage = replaced(files.stage, "f 4/4 6/6 5/5", "f 1/1 6/6 5/5");
    files.drape = replaced(files.drape, "f 4 6 5", "f 1 6 5");
    CHECK_THAT(error(), ContainsSubstring("vertex 1 is of two panels"));
  }
  SECTION("drape.obj of another garment") {
    files.drape = replaced(files.drape, "f 1 2 3", "f 1 3 2");
    CHECK_THAT(error(), ContainsSubstring("drape.obj: does not begin with the faces of stage.obj"));
  }
  SECTION("drape.obj without the body") {
    files.drape = replaced(files.drape, "f 7 8 9\n", "");
    CHECK_THAT(error(), ContainsSubstring("drape.obj: has 2 faces instead of 3"));
  }
  SECTION("a missing frame") {
    files.shells[1] = "";
    CHECK_THAT(error(), ContainsSubstring("shell1.obj: does not exist"));
  }
  SECTION("a frame of another body") {
    files.shells[2] = "v 0 0 0\n";
    CHECK_THAT(error(), ContainsSubstring("shell2.obj: has 1 vertices instead of 3"));
  }
  SECTION("a motion that begins elsewhere") {
    files.shells[0] = replaced(files.shells[0], "v 1 -0.25 0", "v 1 -0.25 0.001");
    CHECK_THAT(error(), ContainsSubstring("shell0.obj: vertex 2 is not where the body of drape.obj has it") ||
                            ContainsSubstring("shell0.obj: vertex 1 is not where"));
  }
}

TEST_CASE("ogc says which file of data=DIR is missing, and that other scenes have no data", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult missing = run_ogc("run dress --scale smoke --set data=" + (folder / "").string());
  CHECK(missing.status == 2);
  CHECK(contains(missing.err, {"stage.obj: does not exist"}));
  for (const char* arguments : {"run twist --scale smoke --set data=x", "scenes twist --write y --set data=x"}) {
    const ProgramResult other = run_ogc(arguments);
    CHECK(other.status == 2);
    CHECK(contains(other.err, {"data=x", "twist"}));
  }
  CHECK(run_ogc("run dress --scale smoke --set data=").status == 2);
  CHECK(run_ogc("scenes dress --write y --set iterations=3").status == 2);
}

// The environment variable OGC_DRESS_DATA is the folder with the files of Codimensional IPC, which are not part of this
// repository.
TEST_CASE("the data set as published: counts, intersections at the start, speed", "[unit]") {
  const char* folder = std::getenv("OGC_DRESS_DATA");
  if (!folder) {
    WARN("skipped: OGC_DRESS_DATA names no folder with Codimensional IPC's dress");
    return;
  }
  const Scene scene = make_scene("dress", Scale::paper, folder);
  CHECK(describe(validate(scene)).empty());
  REQUIRE(scene.bodies.size() == 15);
  CHECK(free_vertices(scene) == 15656);
  CHECK(scene.bodies.back().first_triangle == 29456);
  CHECK(scene.bodies.back().vertex_count == 12811);
  CHECK(scene.bodies.back().triangle_count == 25472);
  CHECK(scene.springs.size() == 851);
  CHECK(scene.settings.steps == 968);
  CHECK(largest_gap(scene) < 2.3e-4);
  const StitchedStart start = stitched_start(scene);
  // The decimal numbers of the files give 528 intersections; rounding to single precision adds three.
  CHECK(start.between_partners == 531);
  CHECK(start.others == 0);
  // The body has 499 intersections with itself. It is one rigid group, so it has no contacts with itself.
  Scene body = scene;
  CHECK(audit(build_topology(body), body.mesh.positions).count == 531 + 499);
  CHECK(largest_step(scene) / scene.settings.time_step == Approx(2.068).epsilon(1e-3));
}
