// Lists the scenes and their sizes at each scale.
#include "experiments/scenes/registry.hpp"

#include <array>
#include <vector>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "experiments/scenes/activation_drop.hpp"
#include "experiments/scenes/cloth_on_sphere.hpp"
#include "experiments/scenes/dress.hpp"
#include "experiments/scenes/fifty_layers.hpp"
#include "experiments/scenes/knot.hpp"
#include "experiments/scenes/large_radius_twist.hpp"
#include "experiments/scenes/mat_twist.hpp"
#include "experiments/scenes/one_iteration_drop.hpp"
#include "experiments/scenes/robot_shirt.hpp"
#include "experiments/scenes/three_cloths_on_sphere.hpp"
#include "experiments/scenes/turning_rod.hpp"
#include "experiments/scenes/twist.hpp"
#include "experiments/scenes/yarn.hpp"

namespace ogc::experiments {
namespace {

compare::Scene cloth_on_sphere_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return cloth_on_sphere({.vertices_a_side = 16, .sphere_subdivisions = 2, .steps = 30});
    case Scale::small: return cloth_on_sphere({.vertices_a_side = 40, .sphere_subdivisions = 3, .steps = 80});
    case Scale::paper: break;
  }
  return cloth_on_sphere();
}

/// Returns the scene of `sizes` with fewer and coarser layers and a coarser cylinder. The contact radius and the shift
/// are proportional to the spacing.
compare::Scene fewer_layers(FiftyLayersSizes sizes, compare::Index layers, compare::Index vertices_a_side,
                            CylinderCells cylinder, std::int64_t steps) {
  const double coarser = static_cast<double>(sizes.vertices_a_side - 1) / (vertices_a_side - 1);
  sizes.layers = layers;
  sizes.vertices_a_side = vertices_a_side;
  sizes.contact_radius *= coarser;
  sizes.shift *= coarser;
  sizes.cylinder = cylinder;
  sizes.steps = steps;
  return fifty_layers(sizes);
}

compare::Scene fifty_layers_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return fewer_layers({}, 3, 10, {16, 6, 2}, 110);
    case Scale::small: return fewer_layers({}, 10, 28, {24, 9, 3}, 1200);
    case Scale::paper: break;
  }
  return fifty_layers();
}

compare::Scene fifty_layers_1m_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return fewer_layers(fifty_layers_1m_sizes(), 3, 11, {16, 6, 2}, 100);
    case Scale::small: return fewer_layers(fifty_layers_1m_sizes(), 12, 36, {32, 11, 4}, 1200);
    case Scale::paper: break;
  }
  return fifty_layers(fifty_layers_1m_sizes());
}

compare::Scene two_hundred_layers_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return fewer_layers(two_hundred_layers_sizes(), 12, 10, {16, 6, 2}, 110);
    case Scale::small: return fewer_layers(two_hundred_layers_sizes(), 40, 20, {24, 9, 3}, 1200);
    case Scale::paper: break;
  }
  return fifty_layers(two_hundred_layers_sizes());
}

compare::Scene three_cloths_at(Scale scale) {
  switch (scale) {
    case Scale::smoke:
      return three_cloths_on_sphere({.vertices_a_side = 12, .sphere_subdivisions = 2, .steps = 24, .iterations = 40});
    case Scale::small: return three_cloths_on_sphere({.vertices_a_side = 28, .sphere_subdivisions = 3, .steps = 40});
    case Scale::paper: break;
  }
  return three_cloths_on_sphere();
}

compare::Scene activation_drop_at(Scale scale) {
  switch (scale) {
    case Scale::smoke:
      return activation_drop({.vertices_a_side = 12, .sphere_subdivisions = 2, .steps = 30, .iterations = 40});
    case Scale::small: return activation_drop({.vertices_a_side = 28, .sphere_subdivisions = 3, .steps = 38});
    case Scale::paper: break;
  }
  return activation_drop();
}

compare::Scene dress_at(Scale scale) {
  switch (scale) {
    case Scale::smoke:
      return dress(
          {.bodice = {8, 6}, .hips = {6, 7}, .hem = {5, 10}, .strap = 10, .body_spacing = 0.0743, .steps = 60});
    case Scale::small:
      return dress({.bodice = {20, 15}, .hips = {14, 19}, .hem = {13, 24}, .strap = 25, .body_spacing = 0.0297});
    case Scale::paper: break;
  }
  return dress();
}

/// Returns the dress of the data set. It has a single size, so that scales differ only in the number of steps.
compare::Scene dress_of(Scale scale, const std::filesystem::path& data) {
  switch (scale) {
    case Scale::smoke: return dress(read_dress_data(data), 6);
    case Scale::small: return dress(read_dress_data(data), 60);
    case Scale::paper: break;
  }
  return dress(read_dress_data(data));
}

compare::Scene knot_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return knot({.rows = 400, .columns = 5, .hold_steps = 12, .steps = 30});
    case Scale::small: return knot({.rows = 1200, .columns = 10, .hold_steps = 150, .steps = 1350});
    case Scale::paper: break;
  }
  return knot();
}

compare::Scene large_radius_twist_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return large_radius_twist({.vertices_a_side = 16, .steps = 150});  // contacts begin at step 117
    case Scale::small: return large_radius_twist({.vertices_a_side = 60, .steps = 1200});
    case Scale::paper: break;
  }
  return large_radius_twist();
}

compare::Scene mat_twist_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return mat_twist({.along = 16, .across = 15, .steps = 360});
    case Scale::small: return mat_twist({.along = 40, .across = 40, .steps = 960});
    case Scale::paper: break;
  }
  return mat_twist();
}

compare::Scene one_iteration_drop_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return one_iteration_drop({.vertices_a_side = 16, .sphere_subdivisions = 2, .steps = 150});
    case Scale::small: return one_iteration_drop({.vertices_a_side = 40, .sphere_subdivisions = 3, .steps = 600});
    case Scale::paper: break;
  }
  return one_iteration_drop();
}

compare::Scene robot_shirt_at(Scale scale) {
  switch (scale) {
    case Scale::smoke:
      return robot_shirt({.across = 12,
                          .length = 22,
                          .sleeve_rows = 5,
                          .sleeve_columns = 5,
                          .neck_columns = 2,
                          .front_neck = 2,
                          .back_neck = 1,
                          .steps = 240});
    case Scale::small:
      return robot_shirt({.across = 28,
                          .length = 52,
                          .sleeve_rows = 10,
                          .sleeve_columns = 13,
                          .neck_columns = 5,
                          .front_neck = 4,
                          .back_neck = 1,
                          .steps = 1800});
    case Scale::paper: break;
  }
  return robot_shirt();
}

compare::Scene turning_rod_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return turning_rod({.segments = 25, .steps = 100});
    case Scale::small: return turning_rod({.segments = 50});
    case Scale::paper: break;
  }
  return turning_rod();
}

compare::Scene twist_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return twist({.vertices_a_side = 20, .steps = 720});  // contacts begin at step 513
    case Scale::small: return twist({.vertices_a_side = 40, .steps = 2400});
    case Scale::paper: break;
  }
  return twist();
}

/// Stores a frame every 20 steps, so that a short run has several frames.
compare::Scene with_frames(compare::Scene scene) {
  scene.settings.frame_steps = 20;
  return scene;
}

/// Returns the scene with fewer loops of the same spacing. The rate of strain is the paper's at `small`, and ten times
/// as large at `smoke`.
compare::Scene yarn_stretch_at(Scale scale) {
  switch (scale) {
    case Scale::smoke:
      return with_frames(yarn_stretch({.rows = 4, .loops = 4, .rest_steps = 50, .steps = 100, .pull = 0.25}));
    case Scale::small: return yarn_stretch({.rows = 10, .loops = 8, .pull = 0.0625});
    case Scale::paper: break;
  }
  return yarn_stretch();
}

compare::Scene yarn_twist_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return with_frames(yarn_twist({.rows = 4, .loops = 4, .steps = 100}));
    case Scale::small: return yarn_twist({.rows = 10, .loops = 8, .steps = 7500, .turns = 1});
    case Scale::paper: break;
  }
  return yarn_twist();
}

constexpr std::array<SceneInfo, 16> scene_table{{
    {"activation_drop", "Fig. 21", "a square cloth falls onto a sphere and the ground, solved to convergence",
     activation_drop_at},
    {"cloth_on_sphere", "Fig. 18", "a square cloth falls off-centre onto a fixed sphere", cloth_on_sphere_at},
    {"dress", "Fig. 13",
     "a dress of 14 stitched panels on a walking body; --set data=DIR: Codimensional IPC's dress and dancer", dress_at,
     dress_of},
    {"fifty_layers", "Fig. 10, 1", "fifty square cloths fall off-centre onto a fixed cylinder", fifty_layers_at},
    {"fifty_layers_1m", "Table 1", "the same with a million vertices", fifty_layers_1m_at},
    {"knot", "Fig. 11, 1", "a long strip with four overhand knots, pulled at both ends", knot_at},
    {"large_radius_twist", "Fig. 2", "half a turn of a cloth whose contact radius is as large as its edges",
     large_radius_twist_at},
    {"mat_twist", "Fig. 19", "a thin solid mat of tetrahedra twisted by its two ends", mat_twist_at},
    {"one_iteration_drop", "Fig. 20", "a square cloth falls onto a small sphere, one iteration a step",
     one_iteration_drop_at},
    {"robot_shirt", "Fig. 14", "two grippers lift, shake and fold a T-shirt", robot_shirt_at},
    {"three_cloths_on_sphere", "Fig. 17", "three square cloths, one above the other, fall onto a fixed sphere",
     three_cloths_at},
    {"turning_rod", "rods.md", "a free straight rod that turns about its middle", turning_rod_at},
    {"twist", "Fig. 12", "a square cloth twisted by its two ends until it coils", twist_at},
    {"two_hundred_layers", "Divide and Truncate", "two hundred square cloths fall off-centre onto a fixed cylinder",
     two_hundred_layers_at},
    {"yarn_stretch", "Fig. 15", "a plain knit of one yarn, pulled apart at two of its edges", yarn_stretch_at},
    {"yarn_twist", "Fig. 16", "a plain knit of one yarn, twisted between two of its edges", yarn_twist_at},
}};

constexpr std::array<std::string_view, 3> scale_names{"smoke", "small", "paper"};

}  // namespace

std::span<const SceneInfo> scenes() { return scene_table; }

compare::Scene make_scene(std::string_view name, Scale scale, const std::filesystem::path& data) {
  std::vector<std::string_view> names;
  for (const SceneInfo& info : scene_table) {
    names.push_back(info.name);
    if (info.name != name) continue;
    if (!data.empty() && !info.generate_of)
      throw compare::InputError("data=" + data.string() + ": " + std::string(name) +
                                " is made of no files; leave it out");
    compare::Scene scene = data.empty() ? info.generate(scale) : info.generate_of(scale, data);
    compare::round_to_single(scene);
    return scene;
  }
  throw compare::InputError(compare::unknown_name("scene", name, names) + "; or name a scene file (.json)");
}

Scale parse_scale(std::string_view text) {
  for (std::size_t i = 0; i < scale_names.size(); ++i) {
    if (scale_names[i] == text) return static_cast<Scale>(i);
  }
  throw compare::InputError(compare::unknown_name("scale", text, scale_names));
}

}  // namespace ogc::experiments
