#include "reference/solvers/sweep.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "compare/problem/volumes.hpp"
#include "reference/geometry/margin.hpp"
#include "reference/geometry/truncate.hpp"
#include "reference/solvers/rods/segment_questions.hpp"
#include "reference/solvers/vertex_update.hpp"

namespace ogc::reference {
namespace {

using compare::Index;

std::span<const compare::VertexPlane> planes_of(const compare::SweepIn& in, Index v) {
  return in.planes != nullptr ? in.planes->of(v) : std::span<const compare::VertexPlane>{};
}

bool is_scaled(const compare::SweepIn& in) { return !traits_of(in.scene->settings.bounds).slides; }

/// Returns the start of the path on which a position outside the half-spaces is moved back: X_prev if cut vertices do
/// not slide (BoundsTraits::slides), otherwise the old position.
const compare::Vec3f& start_of_way(const compare::SweepIn& in, std::size_t i) {
  return is_scaled(in) ? in.previous[i] : in.old[i];
}

VertexUpdate free_vertex(const compare::SweepIn& in, const compare::SweepOut& answer, const SweepStencils& stencils,
                         Index v, bool is_held_to_way) {
  const auto i = static_cast<std::size_t>(v);
  const double step = in.scene->settings.time_step;
  const FreeVertex vertex{
      in.old[i],        in.target[i],  in.previous[i], in.bound[i], in.rest->mass[i] / (step * step),
      planes_of(in, v), is_held_to_way};
  return update_of(terms_of_vertex(in, stencils, SweepPositions(in, answer, v), v), vertex, answer.position[i]);
}

/// Truncates the target y of a prescribed vertex, as a case of the stage truncate.
VertexUpdate prescribed_vertex(const compare::SweepIn& in, std::size_t i) {
  const compare::TruncateIn question{{in.previous[i]},
                                     {in.target[i]},
                                     {in.bound[i]},
                                     half_spaces_of(planes_of(in, static_cast<Index>(i)), start_of_way(in, i), true)};
  const compare::TruncateTruth truth = truncate(question);
  const bool cut = truth.cut[0] != 0, grey = truth.grey[0] != 0;
  const compare::Vec3f& p = in.previous[i];
  const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) + in.bound[i];
  const double to_ball = cut || grey ? compare::truncate_position_tolerance * compare::unit_roundoff * size : 0,
               accepted = question.half_spaces.offsets.empty() ? to_ball : truth.accepted[0];
  return {truth.position[0], accepted, grey, grey ? Cut::doubtful : cut ? Cut::yes : Cut::no};
}

}  // namespace

compare::SweepTruth sweep(const compare::SweepIn& in, const compare::SweepOut& answer) {
  const std::size_t count = in.old.size();
  const SweepStencils stencils(in);
  const std::vector<Index> groups = rigid_groups(*in.scene);
  const std::vector<bool> is_volume = compare::volume_flags(*in.scene);
  std::vector<VertexUpdate> updates(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    if (in.colour[i] >= 0)
      updates[i] = free_vertex(in, answer, stencils, static_cast<Index>(i), is_scaled(in));
    else if (groups[i] > 0 && !is_volume[i])
      updates[i] = prescribed_vertex(in, i);
    else
      updates[i].position = {in.old[i].x, in.old[i].y, in.old[i].z};
  });
  compare::SweepTruth truth;
  for (const VertexUpdate& update : updates) {
    truth.position.push_back(update.position);
    truth.accepted.push_back(update.accepted);
    truth.grey.push_back(update.grey);
    truth.cut += update.cut == Cut::yes;
    truth.cut_doubtful += update.cut == Cut::doubtful;
  }
  add_orientations(in, answer, truth);
  return truth;
}

namespace {

/// Returns the position of an update in single precision, inside its region. If cut vertices do not slide
/// (BoundsTraits::slides), the path from X_prev to the position is first cut at the half-spaces.
compare::Vec3f stored(const compare::Vec3& position, const compare::SweepIn& in, std::size_t v) {
  const compare::TruncateIn region{{in.previous[v]},
                                   {in.old[v]},
                                   {in.bound[v]},
                                   half_spaces_of(planes_of(in, static_cast<Index>(v)), start_of_way(in, v), true)};
  if (!is_scaled(in)) return stored_in_region(position, region, 0);
  compare::TruncateIn way = region;
  way.position = {stored_within(position, in.previous[v], in.bound[v])};
  const compare::TruncateTruth truth = truncate(way);
  return truth.cut[0] != 0 ? stored_in_region(truth.position[0], way, 0) : way.position[0];
}

}  // namespace

compare::SweepOut reference_sweep(const compare::SweepIn& in, const SweepStencils& stencils) {
  compare::SweepOut out{{in.old.begin(), in.old.end()}, 0, {}};
  const auto store = [&](std::size_t v, const VertexUpdate& update) {
    out.position[v] = stored(update.position, in, v);
    out.cut += update.cut == Cut::yes;
  };
  const std::vector<Index> groups = rigid_groups(*in.scene);
  const std::vector<bool> is_volume = compare::volume_flags(*in.scene);
  std::vector<std::vector<Index>> classes;
  for (std::size_t v = 0; v < in.old.size(); ++v) {
    if (in.colour[v] < 0 && groups[v] > 0 && !is_volume[v]) store(v, prescribed_vertex(in, v));
    if (in.colour[v] < 0) continue;
    const auto colour = static_cast<std::size_t>(in.colour[v]);
    classes.resize(std::max(classes.size(), colour + 1));
    classes[colour].push_back(static_cast<Index>(v));
  }
  set_orientations(in, out);
  for (const std::vector<Index>& members : classes) {
    std::vector<VertexUpdate> updates(members.size());
    tbb::parallel_for(std::size_t{0}, members.size(),
                      [&](std::size_t k) { updates[k] = free_vertex(in, out, stencils, members[k], false); });
    for (std::size_t k = 0; k < members.size(); ++k) store(static_cast<std::size_t>(members[k]), updates[k]);
  }
  return out;
}

}  // namespace ogc::reference
