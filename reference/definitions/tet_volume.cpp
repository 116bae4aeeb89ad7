// `Walk` keeps a number for each tetrahedron: the smallest parameter of the segment at which a path from the start can
// be in the tetrahedron. The segment meets a tetrahedron in one interval. So a path that can be in the tetrahedron at t
// can be there at every later parameter of the interval.
#include "reference/definitions/tet_volume.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <string>

#include "compare/problem/error.hpp"
#include "reference/definitions/tet_checks.hpp"
#include "reference/definitions/tet_walk.hpp"

namespace ogc::reference {
namespace {

using compare::at;

/// Returns adjacent doubles that enclose an exact number ≥ 0. If the number is a double, returns this double twice.
std::array<double, 2> enclosing(const Rational& square) {
  double low = CGAL::to_interval(square).first;
  for (double next = std::nextafter(low, HUGE_VAL); Rational(next) <= square; next = std::nextafter(low, HUGE_VAL))
    low = next;
  return {low, Rational(low) == square ? low : std::nextafter(low, HUGE_VAL)};
}

/// Returns the largest double whose square is not above an exact number ≥ 0.
double root_below(const Rational& square) {
  double root = std::sqrt(CGAL::to_interval(square).second);
  while (Rational(root) * Rational(root) > square) root = std::nextafter(root, 0.0);
  return root;
}

/// Returns for each corner of `one` whether it is also a corner of `other`.
std::array<bool, 4> shared(const Tetrahedron& one, const Tetrahedron& other) {
  std::array<bool, 4> marked{};
  for (std::size_t k = 0; k < 4; ++k) marked[k] = std::ranges::find(other, one[k]) != other.end();
  return marked;
}

/// Returns the corners with positive weight at x, sorted: the simplex whose interior holds x; empty if the tetrahedron
/// does not hold x.
std::vector<Index> carrier(std::span<const Vec3f> positions, const Tetrahedron& tetrahedron, const RationalPoint& x) {
  const auto w = weights(corners_of(positions, tetrahedron), x);
  std::vector<Index> vertices;
  for (std::size_t k = 0; k < 4; ++k) {
    if (w[k] < 0) return {};
    if (w[k] > 0) vertices.push_back(tetrahedron[k]);
  }
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

/// Finds the tetrahedra that a path along one segment can reach.
class Walk {
 public:
  Walk(std::span<const Vec3f> positions, std::span<const Tetrahedron> tetrahedra,
       std::span<const std::vector<Index>> tetrahedra_of)
      : positions_(positions), tetrahedra_(tetrahedra), tetrahedra_of_(tetrahedra_of) {}

  bool reaches(Index from, Index goal, const RationalPoint& start, const RationalPoint& end) {
    earliest_ = {{from, Rational(0)}};
    std::deque<Index> waiting{from};
    while (!waiting.empty() && !earliest_.contains(goal)) {
      const Index t = waiting.front();
      waiting.pop_front();
      leave(t, Crossing(corners_of(positions_, tetrahedra_[at(t)]), start, end), waiting);
    }
    return earliest_.contains(goal);
  }

 private:
  void leave(Index t, const Crossing& crossing, std::deque<Index>& waiting) {
    const Rational entered = earliest_.at(t);
    for (const Index v : tetrahedra_[at(t)]) {
      for (const Index next : tetrahedra_of_[at(v)]) {
        const auto gate = next == t ? std::nullopt : crossing.within(shared(tetrahedra_[at(t)], tetrahedra_[at(next)]));
        if (!gate || gate->high < entered) continue;
        const Rational through = std::max(entered, gate->low);
        const auto known = earliest_.find(next);
        if (known != earliest_.end() && known->second <= through) continue;
        earliest_[next] = through;
        waiting.push_back(next);
      }
    }
  }

  std::span<const Vec3f> positions_;
  std::span<const Tetrahedron> tetrahedra_;
  std::span<const std::vector<Index>> tetrahedra_of_;
  std::map<Index, Rational> earliest_;
};

}  // namespace

struct TetVolume::Candidate {
  RationalPoint end;
  Rational square;
};

TetVolume::TetVolume(std::span<const Vec3f> positions, std::span<const Tetrahedron> tetrahedra)
    : positions_(positions), tetrahedra_(tetrahedra), tetrahedra_of_(positions.size()) {
  check_shape(positions, tetrahedra);
  for (std::size_t i = 0; i < tetrahedra.size(); ++i)
    for (const Index v : tetrahedra[i]) tetrahedra_of_[at(v)].push_back(static_cast<Index>(i));
  boundary_ = checked_boundary(positions, tetrahedra, tetrahedra_of_);
}

bool TetVolume::has_vertex(Index tetrahedron, Index vertex) const {
  return std::ranges::find(tetrahedra_[at(tetrahedron)], vertex) != tetrahedra_[at(tetrahedron)].end();
}

std::vector<std::vector<Index>> TetVolume::sheets(const Vec3f& x) const {
  std::map<std::vector<Index>, std::vector<Index>> by_carrier;
  for (std::size_t i = 0; i < tetrahedra_.size(); ++i) {
    const std::vector<Index> vertices = carrier(positions_, tetrahedra_[i], rational(x));
    if (!vertices.empty()) by_carrier[vertices].push_back(static_cast<Index>(i));
  }
  std::vector<std::vector<Index>> sheets;
  for (auto& [vertices, tetrahedra] : by_carrier) sheets.push_back(std::move(tetrahedra));
  std::sort(sheets.begin(), sheets.end());
  return sheets;
}

std::vector<TetVolume::Candidate> TetVolume::candidates(const Vec3f& x, Index tetrahedron) const {
  const bool known = tetrahedron >= 0 && at(tetrahedron) < tetrahedra_.size();
  if (!known || carrier(positions_, tetrahedra_[at(tetrahedron)], rational(x)).empty())
    throw compare::InputError("shortest path: tetrahedron " + std::to_string(tetrahedron) +
                              " does not hold the point; take one that `sheets` names");
  std::vector<Candidate> all;
  for (const BoundaryTriangle& side : boundary_) {
    const auto corner = [&](std::size_t k) { return rational(positions_[at(side.vertices[k])]); };
    const RationalPoint end = closest_point({corner(0), corner(1), corner(2)}, rational(x));
    all.push_back({end, squared_distance(end, rational(x))});
  }
  return all;
}

BoundaryPath TetVolume::path(Index triangle, const Candidate& candidate, bool valid) const {
  const auto& [end, square] = candidate;
  return {triangle,
          valid,
          {CGAL::to_double(end.x), CGAL::to_double(end.y), CGAL::to_double(end.z)},
          root_below(square),
          enclosing(square)};
}

std::vector<BoundaryPath> TetVolume::boundary_paths(const Vec3f& x, Index tetrahedron) const {
  const std::vector<Candidate> all = candidates(x, tetrahedron);
  Walk walk(positions_, tetrahedra_, tetrahedra_of_);
  std::vector<BoundaryPath> paths;
  for (std::size_t i = 0; i < all.size(); ++i)
    paths.push_back(path(static_cast<Index>(i), all[i],
                         walk.reaches(tetrahedron, boundary_[i].tetrahedron, rational(x), all[i].end)));
  return paths;
}

BoundaryDepth TetVolume::shortest_path_to_boundary(const Vec3f& x, Index tetrahedron) const {
  const std::vector<Candidate> all = candidates(x, tetrahedron);
  std::vector<Index> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return all[at(a)].square < all[at(b)].square; });
  Walk walk(positions_, tetrahedra_, tetrahedra_of_);
  BoundaryDepth depth;
  std::vector<Index> refused;
  for (const Index i : order) {
    if (!depth.equally_near.empty() && all[at(i)].square > all[at(depth.equally_near[0])].square) break;
    (walk.reaches(tetrahedron, boundary_[at(i)].tetrahedron, rational(x), all[at(i)].end) ? depth.equally_near
                                                                                          : refused)
        .push_back(i);
  }
  const Candidate& nearest = all[at(depth.equally_near.at(0))];
  depth.path = path(depth.equally_near[0], nearest, true);
  depth.refused = static_cast<std::size_t>(
      std::count_if(refused.begin(), refused.end(), [&](Index i) { return all[at(i)].square < nearest.square; }));
  return depth;
}

}  // namespace ogc::reference
