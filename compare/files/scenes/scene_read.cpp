// Reads the document in one pass: bodies load their meshes as they are read, motions select from them, and every
// problem is collected.
#include <algorithm>
#include <cctype>
#include <limits>
#include <memory>
#include <optional>

#include "compare/files/bytes.hpp"
#include "compare/files/json_reader.hpp"
#include "compare/files/meshes/mesh_files.hpp"
#include "compare/files/scenes/keyframes.hpp"
#include "compare/files/scenes/orientations.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/problem/dust.hpp"
#include "compare/problem/element_names.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/local_origin.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/ranges.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {
namespace {

void read_choice(const JsonNode& node, const SettingInfo& info, Settings& settings) {
  std::string name = setting_text(settings, info);
  node.read(name);
  if (std::find(info.choices.begin(), info.choices.end(), name) == info.choices.end())
    return node.fail("is '" + shown(name) + "'", "give " + describe_range(info));
  set_setting(settings, info.name, name);
}

void read_settings(const JsonNode& node, Settings& settings) {
  JsonObject object(node);
  for (const SettingInfo& info : setting_table()) {
    object.optional(std::string(info.name), [&](const JsonNode& value) {
      if (kind_of(info) == SettingKind::choice) return read_choice(value, info, settings);
      double number = get_setting(settings, info);
      if (kind_of(info) == SettingKind::whole) {
        auto whole = static_cast<std::int64_t>(number);
        value.read(whole);
        number = static_cast<double>(whole);
      } else {
        value.read(number);
      }
      set_setting(settings, info, number);
      if (!in_range(info, number)) value.fail("is " + shortest(number), "give " + describe_range(info));
    });
  }
  object.finish();
}

template <class Model>
void read_model(const JsonNode& node, std::span<const std::string_view> names, Model& model,
                std::string_view what = "model") {
  std::string name(name_of(model));
  node.read(name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return node.fail(unknown_name(what, name, names), "");
  model = static_cast<Model>(found - names.begin());
}

/// Returns a number within [least, most]; NaN for a wrong type, whose problem is noted.
double read_between(const JsonNode& node, double least, double most, const char* what) {
  double value = std::numeric_limits<double>::quiet_NaN();
  node.read(value);
  if (node.value().is_number() && !(value >= least && value <= most))
    node.fail("is " + shortest(value),
              "give a number from " + shortest(least) + " to " + shortest(most) + " (" + what + ")");
  return value;
}

/// Reads E and ν, which replace both Lamé constants.
void read_elasticity(JsonObject& object, Material& material) {
  std::optional<double> modulus, ratio;
  object.optional("solid_young", [&](const JsonNode& node) {
    for (const char* lame : {"solid_mu", "solid_lambda"})
      if (object.has(lame)) node.fail(std::string("stands beside '") + lame + "'", "give Lamé constants, or E and ν");
    if (!object.has("solid_poisson")) node.fail("stands without 'solid_poisson'", "give both, or Lamé constants");
    modulus = read_between(node, least_young, most_young, "Young's modulus of tetrahedra [Pa]");
  });
  object.optional("solid_poisson", [&](const JsonNode& node) {
    if (!object.has("solid_young")) node.fail("stands without 'solid_young'", "give both, or Lamé constants");
    ratio = read_between(node, 0, most_poisson, "Poisson's ratio of tetrahedra");
  });
  if (!modulus || !ratio) return;
  set_elasticity(material, {*modulus, *ratio});
}

RodMaterial read_rod(const JsonNode& node) {
  RodMaterial rod;
  JsonObject object(node);
  for (const RodInfo& info : rod_table()) {
    object.optional(std::string(info.name), [&](const JsonNode& value) {
      double& number = rod.*info.field;
      value.read(number);
      if (!in_range(info, number)) value.fail("is " + shortest(number), "give " + describe_range(info));
    });
  }
  object.finish();
  return rod;
}

void read_material(const JsonNode& node, Material& material) {
  JsonObject object(node);
  object.optional("rod", [&](const JsonNode& value) { material.rod = read_rod(value); });
  read_elasticity(object, material);
  for (const MaterialInfo& info : material_table()) {
    object.optional(std::string(info.name), [&](const JsonNode& value) {
      double& number = material.*info.field;
      value.read(number);
      if (!in_range(info, number)) value.fail("is " + shortest(number), "give " + describe_range(info));
    });
  }
  object.optional("membrane",
                  [&](const JsonNode& value) { read_model(value, choice_names<MembraneModel>, material.membrane); });
  object.optional("bending",
                  [&](const JsonNode& value) { read_model(value, choice_names<BendingModel>, material.bending); });
  object.finish();
}

void refuse_reserved(const JsonNode& node, const std::string& what) {
  node.fail("asks for " + what + ", which this ogc does not simulate yet", "leave it out, or use a newer ogc");
}

/// Returns the file's name without folder and extension, with '_' for characters that names may not have.
std::string name_of_file(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-'; }, '_');
  return name;
}

class SceneReader {
 public:
  explicit SceneReader(const std::filesystem::path& file)
      : folder_(file.parent_path()),
        name_(file.string()),
        json_(parse_json(read_bytes(file), name_)),
        root_(json_, name_, "", problems_) {}

  SceneFile read() {
    check_version();
    JsonObject object(root_);
    object.required("format_version", [](const JsonNode&) {});
    scene_.name = name_of_file(name_);
    object.optional_value("name", scene_.name);
    object.optional_value("gravity", scene_.gravity);
    object.optional("settings", [&](const JsonNode& node) { read_settings(node, scene_.settings); });
    object.required("bodies",
                    [&](const JsonNode& node) { each(node, [&](const JsonNode& body) { read_body(body); }); });
    note(describe(clear_dust(scene_)));
    note(describe_origin(scene_.mesh.positions, local_origin(scene_.mesh.positions),
                         "rounding to single precision bends edges; move the scene's meshes near 0"));
    object.optional("motions",
                    [&](const JsonNode& node) { each(node, [&](const JsonNode& motion) { read_motion(motion); }); });
    for_each_of<SceneLists>([&]<class List, std::size_t>() {
      object.optional(List::key, [&](const JsonNode& node) {
        each(node, [&](const JsonNode& element) { read_element<List>(element); });
      });
    });
    object.optional("excluded_pairs",
                    [&](const JsonNode& node) { each(node, [&](const JsonNode& pairs) { read_excluded(pairs); }); });
    object.optional("body_pairs", [&](const JsonNode& node) {
      each(node, [](const JsonNode& pair) { refuse_reserved(pair, "materials of pairs of bodies"); });
    });
    object.finish();
    stop_at_problems();
    round_to_single(scene_);
    problems_ = validate(scene_, 10, ElementNames(scene_, sources_));
    for (Problem& problem : problems_) problem.where = name_ + ": " + problem.where;
    stop_at_problems();
    return {std::move(scene_), std::move(sources_), std::move(notes_)};
  }

 private:
  // Runs first, because other problems mean nothing if the file has another format.
  void check_version() const {
    if (!json_.is_object() || !json_.contains("format_version")) return;
    const JsonNode node = root_.child("format_version");
    std::int64_t version = 0;
    node.read(version);
    if (version > scene_format_version) {
      node.fail("scene format " + std::to_string(version) + " is newer than " + std::to_string(scene_format_version) +
                    ", the newest that this ogc reads",
                "use a newer ogc");
    } else if (version < 1 && node.value().is_number_integer()) {
      node.fail("there is no scene format " + std::to_string(version), "give " + std::to_string(scene_format_version));
    }
    stop_at_problems();
  }

  void stop_at_problems() const {
    if (!problems_.empty()) throw InputError(describe(problems_));
  }

  void note(const std::string& text) {
    if (!text.empty()) notes_.push_back(name_ + ": " + text);
  }

  template <class Use>
  void each(const JsonNode& array, const Use& use) {
    if (!array.expect_array()) return;
    for (std::size_t i = 0; i < array.size(); ++i) use(array.child(i));
  }

  // Reads the mesh file that a node names. Returns nullopt and notes the problem if the file can't be read.
  std::optional<PolygonMesh> read_polygons(const JsonNode& node) {
    std::string text;
    node.read(text);
    if (!node.value().is_string()) return std::nullopt;
    try {
      return read_polygon_mesh(folder_ / text);
    } catch (const InputError& error) {
      node.fail(error.what(), "");
      return std::nullopt;
    }
  }

  // The content of a body's mesh file, and the mesh made from it. Files of the rest shape and of velocities must have
  // the same faces and number of vertices.
  struct BodyMesh {
    PolygonMesh polygons;
    LoadedMesh loaded;
  };

  // Reads and validates a body's mesh. Returns nullopt and notes the problems if it can't be used.
  std::optional<BodyMesh> read_body_mesh(const JsonNode& node) {
    std::optional<PolygonMesh> polygons = read_polygons(node);
    if (!polygons) return std::nullopt;
    try {
      BodyMesh body{*polygons, make_mesh(*polygons, {.rounded = true})};
      if (!is_valid(node, body.loaded)) return std::nullopt;
      notes_.insert(notes_.end(), body.loaded.notes.begin(), body.loaded.notes.end());
      return body;
    } catch (const InputError& error) {
      node.fail(error.what(), "");
      return std::nullopt;
    }
  }

  bool is_valid(const JsonNode& node, const LoadedMesh& loaded) {
    const std::vector<Problem> found = validate(loaded.mesh, 10, ElementNames(loaded.source));
    for (const Problem& problem : found) {
      problems_.push_back({node.where() + " (" + node.value().get<std::string>() + "): " + problem.where, problem.what,
                           problem.remedy});
    }
    return found.empty();
  }

  // Reads a second mesh file for the same vertices. Returns its positions, which are rest positions or velocities.
  std::vector<Vec3> read_like(const JsonNode& node, const BodyMesh& mesh) {
    std::optional<PolygonMesh> other = read_polygons(node);
    if (!other) return {};
    const PolygonMesh& own = mesh.polygons;
    bool same = other->positions.size() == own.positions.size() && other->corners == own.corners &&
                other->face_ends == own.face_ends;
    for_each_of<MeshLists>([&]<class List, std::size_t>() { same = same && (*other).*List::list == own.*List::list; });
    if (!same) {
      node.fail("has other vertices, faces, edges or tetrahedra than the body's mesh", "write both from one mesh");
      return {};
    }
    const std::vector<Index>& numbers = mesh.loaded.source.vertices;
    if (numbers.empty()) return std::move(other->positions);
    std::vector<Vec3> values;
    for (const Index v : numbers) values.push_back(other->positions[static_cast<std::size_t>(v)]);
    return values;
  }

  void read_body(const JsonNode& node) {
    JsonObject object(node);
    Body body;
    std::optional<BodyMesh> mesh;
    std::vector<Vec3> rest, velocities;
    object.optional_value("name", body.name);
    object.optional_value("fixed", body.fixed);
    object.optional("body_contact", [&](const JsonNode& value) {
      read_model(value, choice_names<BodyContact>, body.contact, "body contact");
    });
    object.optional("orientations", [&](const JsonNode& value) { read_orientations_file(value); });
    object.optional("material", [&](const JsonNode& value) { read_material(value, body.material); });
    object.required("mesh", [&](const JsonNode& value) {
      if (!object.has("name") && value.value().is_string()) body.name = name_of_file(value.value().get<std::string>());
      mesh = read_body_mesh(value);
    });
    object.optional("rest_mesh", [&](const JsonNode& value) {
      if (mesh) rest = read_like(value, *mesh);
    });
    object.optional("velocity", [&](const JsonNode& value) {
      Vec3 velocity;
      value.read(velocity);
      if (mesh) velocities.assign(mesh->loaded.mesh.positions.size(), velocity);
    });
    object.optional("velocities", [&](const JsonNode& value) {
      if (object.has("velocity")) value.fail("stands beside 'velocity'", "keep one of them");
      if (mesh) velocities = read_like(value, *mesh);
    });
    object.finish();
    const auto first = static_cast<std::ptrdiff_t>(scene_.mesh.positions.size());
    sources_.push_back(mesh ? std::make_shared<const MeshSource>(mesh->loaded.source) : nullptr);
    append_body(scene_, std::move(body), mesh ? mesh->loaded.mesh : Mesh{});
    std::copy(rest.begin(), rest.end(), scene_.rest_positions.begin() + first);
    std::copy(velocities.begin(), velocities.end(), scene_.velocities.begin() + first);
  }

  void read_motion(const JsonNode& node) {
    JsonObject object(node);
    PrescribedMotion motion;
    object.required_value("name", motion.name);
    object.required("vertices", [&](const JsonNode& value) {
      each(value, [&](const JsonNode& selection) { read_selection(selection, motion.vertices); });
    });
    object.optional_value("centre", motion.centre);
    object.optional_value("axis", motion.axis);
    object.optional_value("angular_velocity", motion.angular_velocity);
    object.optional_value("velocity", motion.velocity);
    object.optional_value("start", motion.start);
    object.optional_value("end", motion.end);
    object.optional("keyframes", [&](const JsonNode& value) { motion.keyframes = read_keyframes_file(value); });
    object.finish();
    scene_.motions.push_back(std::move(motion));
  }

  template <class List>
  void read_element(const JsonNode& node) {
    JsonObject object(node);
    auto& element = (scene_.*List::list).emplace_back();
    for (const auto& field : List::fields) {
      const auto read = [&](const JsonNode& value) {
        if (field.vertex != nullptr) element.*field.vertex = read_end(value);
        if (field.number != nullptr) value.read(element.*field.number);
      };
      field.is_required ? object.required(field.name, read) : object.optional(field.name, read);
    }
    object.finish();
  }

  void read_orientations_file(const JsonNode& node) {
    std::string text;
    node.read(text);
    if (!node.value().is_string()) return;
    try {
      const std::vector<Quaternion> read = read_orientations(folder_ / text);
      scene_.orientations.insert(scene_.orientations.end(), read.begin(), read.end());
    } catch (const InputError& error) {
      node.fail(error.what(), "");
    }
  }

  Keyframes read_keyframes_file(const JsonNode& node) {
    std::string text;
    node.read(text);
    if (!node.value().is_string()) return {};
    try {
      return read_keyframes(folder_ / text);
    } catch (const InputError& error) {
      node.fail(error.what(), "");
      return {};
    }
  }

  void read_excluded(const JsonNode& node) {
    JsonObject object(node);
    std::array<const Body*, 2> bodies{};
    object.required("bodies", [&](const JsonNode& value) {
      if (!expect_two(value)) return;
      for (std::size_t k = 0; k < 2; ++k) bodies[k] = find_body(value.child(k));
    });
    object.required("vertices", [&](const JsonNode& value) {
      each(value, [&](const JsonNode& pair) {
        if (!expect_two(pair)) return;
        std::vector<Index> vertices;
        for (std::size_t k = 0; k < 2; ++k) select_index(pair.child(k), bodies[k], vertices);
        if (vertices.size() == 2) scene_.excluded_pairs.push_back({vertices[0], vertices[1]});
      });
    });
    object.finish();
  }

  static bool expect_two(const JsonNode& node) {
    if (!node.expect_array()) return false;
    if (node.size() == 2) return true;
    node.fail("has " + std::to_string(node.size()) + " entries", "give two");
    return false;
  }

  // Reads a vertex, given by a body and an index within the body. Returns −1 and notes a problem if there is no such
  // vertex.
  Index read_end(const JsonNode& node) {
    JsonObject object(node);
    const Body* body = nullptr;
    std::vector<Index> vertices;
    object.required("body", [&](const JsonNode& value) { body = find_body(value); });
    object.required("index", [&](const JsonNode& value) { select_index(value, body, vertices); });
    object.finish();
    return vertices.empty() ? -1 : vertices.front();
  }

  const Body* find_body(const JsonNode& node) {
    std::string name;
    node.read(name);
    std::vector<std::string_view> names;
    for (const Body& body : scene_.bodies) {
      if (body.name == name) return &body;
      names.push_back(body.name);
    }
    if (node.value().is_string()) node.fail(unknown_name("body", name, names), "");
    return nullptr;
  }

  // Reads a selection: all vertices of a body, the vertices in a box, or listed vertices, whose indices count within
  // the body. Boxes refer to the positions in the mesh file, without dust.
  void read_selection(const JsonNode& node, std::vector<Index>& vertices) {
    JsonObject object(node);
    const Body* body = nullptr;
    object.required("body", [&](const JsonNode& value) { body = find_body(value); });
    if (object.has("box") && object.has("indices")) node.fail("has both 'box' and 'indices'", "keep one of them");
    object.optional("box", [&](const JsonNode& value) { select_box(value, body, vertices); });
    object.optional("indices", [&](const JsonNode& value) {
      each(value, [&](const JsonNode& index) { select_index(index, body, vertices); });
    });
    object.finish();
    if (body == nullptr || object.has("box") || object.has("indices")) return;
    for (Index i = 0; i < body->vertex_count; ++i) vertices.push_back(body->first_vertex + i);
  }

  void select_box(const JsonNode& node, const Body* body, std::vector<Index>& vertices) {
    JsonObject object(node);
    Vec3 low, high;
    object.required_value("minimum", low);
    object.required_value("maximum", high);
    object.finish();
    if (body == nullptr || body->vertex_count == 0) return;
    const std::size_t before = vertices.size();
    for (Index v = body->first_vertex; v < body->first_vertex + body->vertex_count; ++v) {
      const Vec3& x = scene_.mesh.positions[static_cast<std::size_t>(v)];
      if (x.x >= low.x && x.x <= high.x && x.y >= low.y && x.y <= high.y && x.z >= low.z && x.z <= high.z)
        vertices.push_back(v);
    }
    if (vertices.size() == before) node.fail("holds no vertex of body '" + body->name + "'", "widen the box [m]");
  }

  void select_index(const JsonNode& node, const Body* body, std::vector<Index>& vertices) {
    Index i = -1;
    node.read(i);
    if (i < 0 || body == nullptr || body->vertex_count == 0) return;
    const MeshSource& source = *sources_[static_cast<std::size_t>(body - scene_.bodies.data())];
    const std::vector<Index>& numbers = source.vertices;
    if (!numbers.empty() && source.shares_vertices) {
      const auto found = std::ranges::lower_bound(numbers, i);
      if (found != numbers.end() && *found == i)
        return vertices.push_back(body->first_vertex + static_cast<Index>(found - numbers.begin()));
      return node.fail("is " + std::to_string(i) + ", which no face or edge of " + source.file + " uses",
                       "name a vertex of the body");
    }
    if (i < body->vertex_count) return vertices.push_back(body->first_vertex + i);
    node.fail("is " + std::to_string(i),
              "body '" + body->name + "' has vertices 0 to " + std::to_string(body->vertex_count - 1));
  }

  std::filesystem::path folder_;
  std::string name_;
  Json json_;
  std::vector<Problem> problems_;
  JsonNode root_;
  Scene scene_;
  MeshSources sources_;
  std::vector<std::string> notes_;
};

}  // namespace

SceneFile load_scene_file(const std::filesystem::path& file) { return SceneReader(file).read(); }

Scene read_scene(const std::filesystem::path& file) { return load_scene_file(file).scene; }

}  // namespace ogc::compare
