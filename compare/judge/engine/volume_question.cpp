#include "compare/judge/engine/volume_question.hpp"

#include <algorithm>
#include <tuple>

namespace ogc::compare {
namespace {

std::size_t place(Index i) { return static_cast<std::size_t>(i); }

/// Returns the index of a number in an ascending list; −1 if the list lacks it.
Index find(const std::vector<Index>& ascending, Index number) {
  const auto found = std::ranges::lower_bound(ascending, number);
  return found != ascending.end() && *found == number ? static_cast<Index>(found - ascending.begin()) : -1;
}

VolumeContact rounded(const VolumeAnswer& answer, Index vertex) {
  const auto single = [](double x) { return static_cast<float>(x); };
  VolumeContact contact = answer.contact;
  contact.point = vertex;
  for (std::size_t k = 0; k < 3; ++k) contact.weights[k] = single(answer.weights[k]);
  contact.direction = {single(answer.direction.x), single(answer.direction.y), single(answer.direction.z)};
  contact.depth = single(answer.depth);
  return contact;
}

}  // namespace

VolumeQuestion::VolumeQuestion(const Scene& scene, const Topology& topology)
    : topology_(topology),
      surface_(volume_surface(scene)),
      own_(std::make_shared<const Topology>(surface_.topology)),
      asking_(volume_askers(scene, topology)),
      contact_radius_(static_cast<float>(scene.settings.contact_radius)) {
  const std::vector<bool> is_volume = volume_flags(scene);
  for (const Index v : asking_) asking_as_.push_back(is_volume[place(v)] ? v : -1);
}

VolumeDepthCase VolumeQuestion::at(std::span<const Vec3f> positions) const {
  VolumeDepthCase asked{own_, {positions.begin(), positions.end()}, contact_radius_, {}, surface_.tetrahedra};
  for (const Index v : asking_) asked.points.push_back(positions[place(v)]);
  asked.own = asking_as_;
  asked.cavities = surface_.cavities;
  return asked;
}

VolumeDepthTruth VolumeQuestion::truth(const VolumeDepthCase& asked, const Authority& authority) {
  return authority.volume_depth({asked.topology.get(), asked.positions, asked.contact_radius, asked.points,
                                 asked.tetrahedra, asked.own, asked.cavities});
}

std::vector<VolumeContact> VolumeQuestion::exact(const VolumeDepthCase& asked, const Authority& authority) const {
  const VolumeDepthTruth truth = VolumeQuestion::truth(asked, authority);
  std::vector<VolumeContact> contacts;
  const auto take = [&](const VolumeAnswer& answer, std::size_t i) {
    VolumeContact contact = rounded(answer, asking_[i]);
    contact.triangle = surface_.triangles[place(contact.triangle)];
    contact.face = scene_face(surface_, topology_, contact.face);
    contacts.push_back(contact);
  };
  for (std::size_t i = 0; i < truth.parts.size(); ++i) {
    for (const VolumePartTruth& part : truth.parts[i])
      for (const VolumeAnswer* answer : exact_answers(part)) take(*answer, i);
  }
  std::ranges::sort(contacts, {},
                    [](const VolumeContact& c) { return std::tuple(c.point, c.inside, c.triangle, c.face); });
  return contacts;
}

std::optional<VolumeDepthOut> VolumeQuestion::answer_of(const VolumeDepthOut& in_scene, std::string& problem) const {
  VolumeDepthOut own;
  for (VolumeContact contact : in_scene.contacts) {
    const auto refuse = [&](const std::string& what) {
      problem = "a contact of vertex " + std::to_string(contact.point) + " with a volume is of " + what;
      return std::nullopt;
    };
    const Index point = find(asking_, contact.point), triangle = find(surface_.triangles, contact.triangle);
    if (point < 0) return refuse("a vertex that asks none");
    if (triangle < 0) return refuse("a triangle of none");
    contact.point = point;
    contact.triangle = triangle;
    if (contact.face.kind == FaceKind::triangle) contact.face.index = find(surface_.triangles, contact.face.index);
    if (contact.face.kind == FaceKind::edge) {
      if (contact.face.index < 0 || place(contact.face.index) >= topology_.edges.size())
        return refuse("an edge that does not exist");
      const Edge& ends = topology_.edges[place(contact.face.index)];
      contact.face.index = find_edge(surface_.topology, ends[0], ends[1]);
    }
    if (contact.face.index < 0) return refuse("a face of none");
    own.contacts.push_back(contact);
  }
  for (const Index vertex : in_scene.unresolved) {
    own.unresolved.push_back(find(asking_, vertex));
    if (own.unresolved.back() >= 0) continue;
    problem = "vertex " + std::to_string(vertex) + " has an unresolved sheet and asks no volume";
    return std::nullopt;
  }
  return own;
}

}  // namespace ogc::compare
