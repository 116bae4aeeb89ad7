// Takes cases from real states, the frames of a run folder. Detection gets whole frames. Other stages get stencils
// drawn from elements of the rest state and from contacts of the frame. An authority computes what a run folder does
// not hold: rest data, distances, contacts.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/random.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "compare/stages/rest_state.hpp"

namespace ogc::compare {

/// Holds frames of a run, spread evenly, with the first and the last one. Also holds the scene's topology, groups, r
/// and the cap of r_q. There are up to 100 frames, and fewer for large meshes (16 for 262,144 vertices or more).
class States {
 public:
  /// Gets rest data from the authority. Throws InputError if the folder is no run or holds no frame.
  States(const std::filesystem::path& folder, const Authority& authority);
  /// Returns why the run has no cases for the stage; empty if it has some.
  std::string missing(Stage stage) const;
  /// Returns case `index` of a stage, taken from frame index mod frames. Cases made from contacts (activation,
  /// contact_force, friction_force) skip frames without contacts. Throws InputError that says what is missing.
  CaseData make(Stage stage, std::uint64_t index, Random& random) const;
  const std::string& folder() const { return folder_; }

  const Topology& topology() const { return *topology_; }
  const Scene& scene() const { return *scene_; }  ///< rounded
  /// Returns the authority's rest data.
  const RestStateOut& rest() const { return rest_; }
  bool has_contact() const { return frame_with_contact(0).has_value(); }

  /// Returns the frame for a case of this index; `contact_frame` skips frames without contacts.
  std::size_t frame(std::uint64_t index) const { return index % states_.size(); }
  std::size_t contact_frame(std::uint64_t index) const { return *frame_with_contact(frame(index)); }

  /// Return cases of a whole frame. The detection case has r_q between r and its cap (method.md §5.3); the block case
  /// has random questions.
  MeshCase whole(std::size_t frame, Random& random) const;
  PlaneCase plane(std::size_t frame, Random& random) const;
  BlockCase block(std::size_t frame, Random& random) const;
  RestStateCase rest_state() const { return {scene_, topology_}; }
  /// Returns the smallest distances of the frame, which the authority computes once.
  BoundCase bound(std::size_t frame) const;
  /// Returns the state of the first sweep in the step that follows the frame.
  SweepCase sweep(std::size_t frame, Random& random) const;
  /// Returns the step that follows the frame; prescribed motions continue at the time of the frame.
  StepCase step(std::size_t frame) const;
  /// Return a vertex and a triangle, or two edges, in contact or near each other.
  ClosestFaceCase vertex_triangle(std::size_t frame, Random& random) const;
  ClosestPointsCase edge_edge(std::size_t frame, Random& random) const;
  /// Returns a contact of the frame. Its vertices are where the frame has them, or have moved at the frame's velocities
  /// for up to a step.
  FrictionForceCase contact(std::size_t frame, Random& random) const;
  /// Returns the distance of a contact of the frame, but at least 2⁻²³ r (compare/stages/contact_force.hpp).
  ActivationCase contact_distance(std::size_t frame, Random& random) const;
  /// `moved_vertex` returns a vertex on its way from this frame to the next one. `guessed_vertex` returns a vertex at
  /// the start of the step after the frame.
  TruncateCase moved_vertex(std::size_t frame, Random& random) const;
  InitialGuessCase guessed_vertex(std::size_t frame, Random& random) const;
  /// Return an element with its rest data. Its vertices are where the frame's velocities take them in one step.
  MembraneCase triangle(std::size_t frame, Random& random) const;
  BendingCase hinge(std::size_t frame, Random& random) const;
  SpringCase spring(std::size_t frame, Random& random) const;
  TetrahedronCase tetrahedron(std::size_t frame, Random& random) const;

 private:
  /// A frame. Its vertices are sorted by cells of about one edge length, so that neighbours are found.
  struct State {
    std::vector<Vec3f> positions;
    std::vector<float> bounds;
    std::vector<Vec3f> velocities;
    std::vector<Quaternion> orientations;  // of the rods' segments
    std::int64_t step = 0;
    std::vector<std::pair<std::uint64_t, Index>> cells;
  };
  /// The contact sets of a frame, in canonical order.
  struct Contacts {
    std::vector<VertexFacetContact> vertex_facet;
    std::vector<EdgeEdgeContact> edge_edge;
    std::size_t size() const { return vertex_facet.size() + edge_edge.size(); }
  };
  /// Returns the orientations of the frame; identities if the frame has none.
  std::vector<Quaternion> orientations_of(const State& state) const;
  /// Returns the frame's contacts, which the authority computes once.
  const Contacts& contacts(std::size_t frame) const;
  /// Returns `frame` if it has a contact, otherwise the next frame, cyclically, that has one; none if the run has no
  /// contacts.
  std::optional<std::size_t> frame_with_contact(std::size_t frame) const;
  std::uint64_t cell(const Vec3f& position) const;
  /// Returns another vertex in the cell of v or in an adjacent cell; v itself if there is none.
  Index neighbour(const State& state, Index v, Random& random) const;
  /// Return the vertices of a pair: a vertex and the corners of a triangle, or the ends of two edges, the
  /// lower-numbered edge first. If the frame has contacts, half of the pairs are in contact; all other pairs are near
  /// each other.
  std::array<Index, 4> vertex_and_triangle(std::size_t frame, Random& random) const;
  std::array<Index, 4> pair_of_edges(std::size_t frame, Random& random) const;
  /// Returns where the vertex is after the fraction `part` of a step at its velocity.
  Vec3f moved(const State& state, Index v, double part = 1) const;
  MeetingMaterial meeting(Index v, Index w) const;

  std::string folder_;
  Authority authority_;
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const Topology> topology_;
  std::vector<Index> groups_, body_;
  CompressedRows partners_;
  RestStateOut rest_;
  float contact_radius_ = 0, detection_radius_cap_ = 1, bounds_relaxation_ = 0.45f;
  double cell_size_ = 1;
  std::vector<State> states_;
  /// by frame; the first thread that needs an entry computes it
  mutable std::vector<std::optional<BoundCase>> smallest_distances_;
  mutable std::vector<std::optional<Contacts>> contacts_;
  mutable std::mutex filling_;
};

}  // namespace ogc::compare
