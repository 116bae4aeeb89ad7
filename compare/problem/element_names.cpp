#include "compare/problem/element_names.hpp"

#include <algorithm>
#include <limits>

#include "compare/problem/scene.hpp"

namespace ogc::compare {
namespace {

/// Returns the number that element i of the mesh has in the file.
Index file_number(const std::vector<Index>& numbers, Index i) { return at(i) < numbers.size() ? numbers[at(i)] : i; }

/// Returns "line 7" or "lines 4, 5", the lines of the elements; empty if the file has no lines.
std::string lines(const std::vector<std::size_t>& lines, std::initializer_list<Index> elements) {
  std::string text;
  for (const Index i : elements) {
    if (at(i) >= lines.size()) return {};
    text += (text.empty() ? "" : ", ") + std::to_string(lines[at(i)]);
  }
  return (elements.size() == 1 ? "line " : "lines ") + text;
}

/// Returns where an element is in its file: its line. If `body` names a body of a scene, the file's name comes first,
/// because a scene may have several files.
std::string file_and_line(const std::string& body, const MeshSource& source, const std::string& line) {
  if (body.empty()) return line;
  return source.file + (line.empty() ? "" : ", " + line);
}

}  // namespace

ElementNames::ElementNames(MeshSource source) {
  bodies_.push_back(
      {{}, 0, std::numeric_limits<Index>::max(), 0, 0, 0, std::make_shared<const MeshSource>(std::move(source))});
}

ElementNames::ElementNames(const Scene& scene, const MeshSources& sources) {
  Index edges = 0;
  for (const Body& body : scene.bodies) {
    const Index last = body.first_vertex + body.vertex_count - 1;
    bodies_.push_back({body.name, body.first_vertex, last, body.first_triangle, edges, body.first_tetrahedron,
                       bodies_.size() < sources.size() ? sources[bodies_.size()] : nullptr});
    const auto is_own = [&](const Edge& e) { return e[0] >= body.first_vertex && e[0] <= last; };
    edges += static_cast<Index>(std::ranges::count_if(scene.mesh.loose_edges, is_own));
  }
}

const ElementNames::NamedBody& ElementNames::body_at(Index vertex) const {
  static const NamedBody none;
  const auto after = std::ranges::upper_bound(bodies_, vertex, {}, &NamedBody::first_vertex);
  return after == bodies_.begin() || (after - 1)->last_vertex < vertex ? none : *(after - 1);
}

// A body without triangles has the same first triangle as the next body. upper_bound finds the last body with this
// first triangle, which is the only one that has triangles.
const ElementNames::NamedBody& ElementNames::body_of_triangle(Index t) const {
  static const NamedBody none;
  const auto after = std::ranges::upper_bound(bodies_, t, {}, &NamedBody::first_triangle);
  return after == bodies_.begin() ? none : *(after - 1);
}

std::string ElementNames::name(const std::string& kind, const NamedBody& body,
                               const std::vector<std::string>& details) const {
  std::string text = kind + (body.name.empty() ? "" : " of body '" + body.name + "'"), list;
  for (const std::string& detail : details) {
    if (!detail.empty()) list += (list.empty() ? "" : "; ") + detail;
  }
  return list.empty() ? text : text + " (" + list + ")";
}

std::string ElementNames::vertex(Index v) const {
  const NamedBody& body = body_at(v);
  const Index local = v - body.first_vertex;
  const std::string in_scene = local == v ? "" : std::to_string(v) + " in the scene";
  if (body.source == nullptr) return name("vertex " + std::to_string(local), body, {in_scene});
  const MeshSource& source = *body.source;
  if (!source.shares_vertices) {
    const Index face = file_number(source.first_faces, local);
    return name("a vertex of face " + std::to_string(face + source.first), body,
                {file_and_line(body.name, source, {}), in_scene});
  }
  const Index number = file_number(source.vertices, local);
  return name("vertex " + std::to_string(number + source.first), body,
              {file_and_line(body.name, source, lines(source.vertex_lines, {number})), in_scene});
}

std::string ElementNames::vertices(std::span<const Index> list) const {
  std::string text;
  for (const Index v : list) {
    const NamedBody& body = body_at(v);
    if (body.source != nullptr && !body.source->shares_vertices) return {};
    const Index local = v - body.first_vertex;
    const Index number = body.source == nullptr ? local
                                                : file_number(body.source->vertices, local) + body.source->first;
    text += (text.empty() ? list.size() == 1 ? "vertex " : "vertices " : ", ") + std::to_string(number);
  }
  return text;
}

std::string ElementNames::triangle(Index t, const Triangle& corners) const {
  const NamedBody& body = body_of_triangle(t);
  const Index local = t - body.first_triangle;
  const std::string in_scene = local == t ? "" : std::to_string(t) + " in the scene";
  if (body.source == nullptr) return name("triangle " + std::to_string(local), body, {vertices(corners), in_scene});
  if (!body.source->tetrahedra.empty())  // the faces of tetrahedra are derived, so the file has no numbers for them
    return name("boundary triangle", body, {vertices(corners), file_and_line(body.name, *body.source, {}), in_scene});
  const Index number = file_number(body.source->faces, local);
  return name(
      "face " + std::to_string(number + body.source->first), body,
      {vertices(corners), file_and_line(body.name, *body.source, lines(body.source->face_lines, {number})), in_scene});
}

std::string ElementNames::tetrahedron(Index t, const Tetrahedron& corners) const {
  static const NamedBody none;
  // Several bodies may have the same first tetrahedron; the last of them has tetrahedra (see body_of_triangle).
  const auto after = std::ranges::upper_bound(bodies_, t, {}, &NamedBody::first_tetrahedron);
  const NamedBody& body = after == bodies_.begin() ? none : *(after - 1);
  const Index local = t - body.first_tetrahedron;
  const std::string in_scene = local == t ? "" : std::to_string(t) + " in the scene";
  if (body.source == nullptr) return name("tetrahedron " + std::to_string(local), body, {vertices(corners), in_scene});
  const MeshSource& source = *body.source;
  return name(
      "tetrahedron " + std::to_string(file_number(source.tetrahedra, local) + source.first), body,
      {vertices(corners), file_and_line(body.name, source, lines(source.tetrahedron_lines, {local})), in_scene});
}

std::string ElementNames::edge(const Edge& ends) const {
  const NamedBody& body = body_at(ends[0]);
  if (body.source == nullptr) return name("edge", body, {vertices(ends)});
  const auto number = [&](Index v) { return file_number(body.source->vertices, v - body.first_vertex); };
  if (!body.source->shares_vertices) return name("edge", body, {"from " + vertex(ends[0]) + " to " + vertex(ends[1])});
  return name("edge", body,
              {vertices(ends), file_and_line(body.name, *body.source,
                                             lines(body.source->vertex_lines, {number(ends[0]), number(ends[1])}))});
}

std::string ElementNames::loose_edge(Index e, const Edge& ends) const {
  const NamedBody& body = body_at(ends[0]);
  const Index local = e < body.first_edge ? e : e - body.first_edge;
  const std::string in_scene = local == e ? "" : std::to_string(e) + " in the scene";
  if (body.source == nullptr) return name("loose edge " + std::to_string(local), body, {vertices(ends), in_scene});
  return name(
      "loose edge " + std::to_string(local + body.source->first), body,
      {vertices(ends), file_and_line(body.name, *body.source, lines(body.source->edge_lines, {local})), in_scene});
}

}  // namespace ogc::compare
