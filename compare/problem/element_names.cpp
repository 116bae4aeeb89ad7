#include "compare/problem/element_names.hpp"

#include <algorithm>
#include <limits>

#include "compare/problem/scene.hpp"

namespace ogc::compare {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// The number that the file has for the mesh's `i`.
Index file_number(const std::vector<Index>& numbers, Index i) { return at(i) < numbers.size() ? numbers[at(i)] : i; }

/// "line 7", "lines 4, 5"; empty where the file has none.
std::string lines(const std::vector<std::size_t>& lines, std::initializer_list<Index> elements) {
  std::string text;
  for (const Index i : elements) {
    if (at(i) >= lines.size()) return {};
    text += (text.empty() ? "" : ", ") + std::to_string(lines[at(i)]);
  }
  return (elements.size() == 1 ? "line " : "lines ") + text;
}

/// What a message says of a place in a file: its line; in a scene, whose bodies have several files, the file as well.
std::string place(const std::string& body, const MeshSource& source, const std::string& line) {
  if (body.empty()) return line;
  return source.file + (line.empty() ? "" : ", " + line);
}

}  // namespace

ElementNames::ElementNames(MeshSource source) {
  parts_.push_back(
      {{}, 0, std::numeric_limits<Index>::max(), 0, 0, 0, std::make_shared<const MeshSource>(std::move(source))});
}

ElementNames::ElementNames(const Scene& scene, const MeshSources& sources) {
  Index edges = 0;
  for (const Body& body : scene.bodies) {
    const Index last = body.first_vertex + body.vertex_count - 1;
    parts_.push_back({body.name, body.first_vertex, last, body.first_triangle, edges, body.first_tetrahedron,
                      parts_.size() < sources.size() ? sources[parts_.size()] : nullptr});
    const auto is_own = [&](const Edge& e) { return e[0] >= body.first_vertex && e[0] <= last; };
    edges += static_cast<Index>(std::ranges::count_if(scene.mesh.loose_edges, is_own));
  }
}

const ElementNames::Part& ElementNames::part_of(Index vertex) const {
  static const Part none;
  const auto after = std::ranges::upper_bound(parts_, vertex, {}, &Part::first_vertex);
  return after == parts_.begin() || (after - 1)->last_vertex < vertex ? none : *(after - 1);
}

// Of bodies without a triangle the next one has the same first triangle, and is the last of them.
const ElementNames::Part& ElementNames::part_of_triangle(Index t) const {
  static const Part none;
  const auto after = std::ranges::upper_bound(parts_, t, {}, &Part::first_triangle);
  return after == parts_.begin() ? none : *(after - 1);
}

std::string ElementNames::name(const std::string& kind, const Part& part,
                               const std::vector<std::string>& details) const {
  std::string text = kind + (part.body.empty() ? "" : " of body '" + part.body + "'"), list;
  for (const std::string& detail : details) {
    if (!detail.empty()) list += (list.empty() ? "" : "; ") + detail;
  }
  return list.empty() ? text : text + " (" + list + ")";
}

std::string ElementNames::vertex(Index v) const {
  const Part& part = part_of(v);
  const Index local = v - part.first_vertex;
  const std::string in_scene = local == v ? "" : std::to_string(v) + " in the scene";
  if (part.source == nullptr) return name("vertex " + std::to_string(local), part, {in_scene});
  const MeshSource& source = *part.source;
  if (!source.shares_vertices) {
    const Index face = file_number(source.first_faces, local);
    return name("a vertex of face " + std::to_string(face + source.first), part,
                {place(part.body, source, {}), in_scene});
  }
  const Index number = file_number(source.vertices, local);
  return name("vertex " + std::to_string(number + source.first), part,
              {place(part.body, source, lines(source.vertex_lines, {number})), in_scene});
}

std::string ElementNames::vertices(std::span<const Index> list) const {
  std::string text;
  for (const Index v : list) {
    const Part& part = part_of(v);
    if (part.source != nullptr && !part.source->shares_vertices) return {};
    const Index local = v - part.first_vertex;
    const Index number = part.source == nullptr ? local
                                                : file_number(part.source->vertices, local) + part.source->first;
    text += (text.empty() ? list.size() == 1 ? "vertex " : "vertices " : ", ") + std::to_string(number);
  }
  return text;
}

std::string ElementNames::triangle(Index t, const Triangle& corners) const {
  const Part& part = part_of_triangle(t);
  const Index local = t - part.first_triangle;
  const std::string in_scene = local == t ? "" : std::to_string(t) + " in the scene";
  if (part.source == nullptr) return name("triangle " + std::to_string(local), part, {vertices(corners), in_scene});
  if (!part.source->tetrahedra.empty())  // derived, the file has no number for it
    return name("boundary triangle", part, {vertices(corners), place(part.body, *part.source, {}), in_scene});
  const Index number = file_number(part.source->faces, local);
  return name("face " + std::to_string(number + part.source->first), part,
              {vertices(corners), place(part.body, *part.source, lines(part.source->face_lines, {number})), in_scene});
}

std::string ElementNames::tetrahedron(Index t, const Tetrahedron& corners) const {
  static const Part none;
  const auto after = std::ranges::upper_bound(parts_, t, {}, &Part::first_tetrahedron);  // as part_of_triangle
  const Part& part = after == parts_.begin() ? none : *(after - 1);
  const Index local = t - part.first_tetrahedron;
  const std::string in_scene = local == t ? "" : std::to_string(t) + " in the scene";
  if (part.source == nullptr) return name("tetrahedron " + std::to_string(local), part, {vertices(corners), in_scene});
  const MeshSource& source = *part.source;
  return name("tetrahedron " + std::to_string(file_number(source.tetrahedra, local) + source.first), part,
              {vertices(corners), place(part.body, source, lines(source.tetrahedron_lines, {local})), in_scene});
}

std::string ElementNames::edge(const Edge& ends) const {
  const Part& part = part_of(ends[0]);
  if (part.source == nullptr) return name("edge", part, {vertices(ends)});
  const auto number = [&](Index v) { return file_number(part.source->vertices, v - part.first_vertex); };
  if (!part.source->shares_vertices) return name("edge", part, {"from " + vertex(ends[0]) + " to " + vertex(ends[1])});
  return name("edge", part,
              {vertices(ends),
               place(part.body, *part.source, lines(part.source->vertex_lines, {number(ends[0]), number(ends[1])}))});
}

std::string ElementNames::loose_edge(Index e, const Edge& ends) const {
  const Part& part = part_of(ends[0]);
  const Index local = e < part.first_edge ? e : e - part.first_edge;
  const std::string in_scene = local == e ? "" : std::to_string(e) + " in the scene";
  if (part.source == nullptr) return name("loose edge " + std::to_string(local), part, {vertices(ends), in_scene});
  return name("loose edge " + std::to_string(local + part.source->first), part,
              {vertices(ends), place(part.body, *part.source, lines(part.source->edge_lines, {local})), in_scene});
}

}  // namespace ogc::compare
