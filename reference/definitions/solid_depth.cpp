// A *way* is the straight segment from x to a boundary point. A way is certain if no rounding error changes whether it
// exists.
//
// The grey zone: let δ be the coordinates of a tetrahedron and x, and w a weight of a point in this tetrahedron. A
// relative error of 16 · 2⁻²⁴ in δ changes w by 16 · 2⁻²⁴ Σ|∂w/∂δ||δ|. The terms of w have degree three, so Σ|∂w/∂δ||δ|
// is at most three times the sum of their moduli. If a way ends in a triangle's interior, the triangle's normal adds an
// error to the end (normal_scale).
//
// Within this error a segment may pass a nearby triangle, edge or vertex on either side of it. A way is certain if none
// of these is on the body's boundary: whichever tetrahedra rounding selects, the way reaches its end.
//
// Weights in double are known to 2⁻⁴⁶ of the moduli of their terms, which is negligible beside 16 · 2⁻²⁴. Rational
// numbers decide whether a way exists exactly, among the tetrahedra that the way may reach.
#include "reference/definitions/solid_depth.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>

#include "compare/problem/tetrahedra.hpp"
#include "reference/definitions/closed_surface.hpp"
#include "reference/definitions/part_contacts.hpp"

namespace ogc::reference {

using compare::Triangle;
using compare::Vec3;
using compare::VolumePartTruth;
using compare::VolumeSheetTruth;

namespace {

using compare::at;

Vec3 difference(const Vec3f& a, const Vec3f& b) { return {double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z}; }
Vec3 sum(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 moduli(const Vec3& a) { return {std::abs(a.x), std::abs(a.y), std::abs(a.z)}; }
double inner(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 normal(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Returns a × b with every term replaced by its modulus.
Vec3 normal_moduli(const Vec3& a, const Vec3& b) {
  const Vec3 p = moduli(a), q = moduli(b);
  return {p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x};
}

/// Factor of the grey zone for a sum m of terms of degree three in the coordinates δ: Σ|∂m/∂δ||δ| is at most three
/// times the sum of the terms' moduli.
constexpr double grey_part = 3 * compare::grey_factor;

bool has(const Tetrahedron& t, Index v) { return std::ranges::find(t, v) != t.end(); }

Triangle sorted(Triangle t) {
  std::ranges::sort(t);
  return t;
}

/// An interval of a segment's parameter; empty if low > high.
struct Piece {
  double low = 0, high = 1;

  /// Reduces the interval to the parameters s with from + s (to − from) ≥ least.
  void keep(double from, double to, double least) {
    const double slope = to - from;
    if (slope == 0) {
      if (from < least) high = -1;
      return;
    }
    const double root = (least - from) / slope;
    if (slope > 0)
      low = std::max(low, root);
    else
      high = std::min(high, root);
  }
};

}  // namespace

Solid::Solid(const Complex& mesh, std::span<const Tetrahedron> tetrahedra)
    : tetrahedra_(tetrahedra),
      component_(compare::joined_components(mesh.topology, tetrahedra)),
      tetrahedra_of_(at(mesh.topology.vertex_count)),
      behind_(tetrahedra.size(), {-1, -1, -1, -1}),
      owner_(mesh.topology.triangles.size(), -1) {
  std::map<Triangle, std::pair<Index, std::size_t>> open;
  for (std::size_t i = 0; i < tetrahedra.size(); ++i) {
    const auto t = static_cast<Index>(i);
    for (const Index v : tetrahedra[i]) tetrahedra_of_[at(v)].push_back(t);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [entry, is_new] = open.try_emplace(sorted(side(t, k)), t, k);
      if (is_new) continue;
      const auto [other, corner] = entry->second;
      behind_[i][k] = other, behind_[at(other)][corner] = t;
      open.erase(entry);
    }
    const auto corners = corners_of(mesh.positions, tetrahedra[i]);
    sign_.push_back(CGAL::sign(weights(corners, corners[0])[0]));
    const auto edge = [&](std::size_t k) { return difference(mesh.at(tetrahedra[i][k]), mesh.at(tetrahedra[i][0])); };
    const double volume = inner(edge(1), normal(edge(2), edge(3)));
    doubtful_.push_back(std::abs(volume) <= grey_part * inner(moduli(edge(1)), normal_moduli(edge(2), edge(3))));
  }
  for (std::size_t k = 0; k < owner_.size(); ++k) {
    const auto found = open.find(sorted(mesh.topology.triangles[k]));
    if (found != open.end()) owner_[k] = found->second.first;
  }
}

bool Solid::is_closed(Index t, std::size_t corner) const {
  const Index other = behind_[at(t)][corner];
  return other < 0 || !is_positive(other) || is_doubtful(other);
}

Triangle Solid::side(Index t, std::size_t corner) const {
  constexpr std::array<std::array<std::size_t, 3>, 4> outward{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  const Tetrahedron& own = tetrahedra_[at(t)];
  return {own[outward[corner][0]], own[outward[corner][1]], own[outward[corner][2]]};
}

struct SolidPart::Passage {
  std::array<double, 4> start{}, end{}, grey{};

  /// Returns the part of the segment that may be in the tetrahedron.
  Piece inside() const {
    Piece piece;
    for (std::size_t k = 0; k < 4; ++k) piece.keep(start[k], end[k], -grey[k]);
    return piece;
  }
  /// Reduces `piece` to its part that may be on the triangle opposite to corner k.
  void keep_on(std::size_t k, Piece& piece) const { piece.keep(-start[k], -end[k], -grey[k]); }
};

SolidPart::Passage SolidPart::passage(Index t, const Vec3& offset, double condition) const {
  Passage passage;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [a, b, c] = solid_.side(t, k);
    const Vec3 e = difference(mesh_.at(b), mesh_.at(a)), f = difference(mesh_.at(c), mesh_.at(a)), n = normal(e, f),
               from = difference(x_, mesh_.at(a));
    passage.start[k] = -inner(from, n);
    passage.end[k] = -inner(sum(from, offset), n);
    passage.grey[k] = grey_part * condition * inner(sum(moduli(from), moduli(offset)), normal_moduli(e, f));
  }
  return passage;
}

std::vector<SolidPart::Group> SolidPart::groups(Index component) const {
  struct Holder {
    Index tetrahedron;
    Passage passage;
    std::vector<Index> carrier;  ///< corners whose weights are certainly positive
  };
  std::vector<Holder> holders;
  for (std::size_t i = 0; i < solid_.tetrahedra().size(); ++i) {
    const Tetrahedron& corners = solid_.tetrahedra()[i];
    const auto t = static_cast<Index>(i);
    if (solid_.component(corners[0]) != component || has(corners, own_)) continue;
    if (!solid_.is_positive(t) && !solid_.is_doubtful(t)) continue;
    Holder holder{t, passage(t, {}, 1), {}};
    bool holds = true;
    for (std::size_t k = 0; k < 4; ++k) {
      holds = holds && holder.passage.start[k] >= -holder.passage.grey[k];
      if (holder.passage.start[k] > holder.passage.grey[k]) holder.carrier.push_back(corners[k]);
    }
    if (holds) holders.push_back(std::move(holder));
  }
  const auto meet = [&](const Holder& a, const Holder& b) {
    const auto all_of = [&](const Holder& p, const Holder& q) {
      return std::ranges::all_of(p.carrier, [&](Index v) { return has(solid_.tetrahedra()[at(q.tetrahedron)], v); });
    };
    return all_of(a, b) && all_of(b, a);
  };
  std::vector<Group> groups;
  std::vector<std::uint8_t> taken(holders.size());
  for (std::size_t first = 0; first < holders.size(); ++first) {
    if (taken[first] != 0) continue;
    Group group;
    std::vector<std::size_t> open{first};
    taken[first] = 1;
    std::map<std::vector<Index>, std::vector<Index>> exact;  // key: the simplex whose interior holds x
    for (std::size_t next = 0; next < open.size(); ++next) {
      const Holder& holder = holders[open[next]];
      const Index t = holder.tetrahedron;
      group.tetrahedra.push_back(t);
      for (std::size_t k = 0; k < 4; ++k)
        if (holder.passage.start[k] <= holder.passage.grey[k] && solid_.is_closed(t, k)) group.is_certain = false;
      if (solid_.is_doubtful(t)) group.is_certain = false;
      const auto w = weights(corners_of(mesh_.positions, solid_.tetrahedra()[at(t)]), rational(x_));
      if (solid_.is_positive(t) && std::ranges::all_of(w, [](const Rational& weight) { return weight >= 0; })) {
        std::vector<Index> carrier;
        for (std::size_t k = 0; k < 4; ++k)
          if (w[k] > 0) carrier.push_back(solid_.tetrahedra()[at(t)][k]);
        std::ranges::sort(carrier);
        exact[carrier].push_back(t);
      }
      for (std::size_t other = 0; other < holders.size(); ++other) {
        if (taken[other] != 0 || !meet(holder, holders[other])) continue;
        taken[other] = 1;
        open.push_back(other);
      }
    }
    for (auto& [carrier, tetrahedra] : exact) group.sheets.push_back(std::move(tetrahedra));
    group.is_certain = group.is_certain && group.sheets.size() == 1;
    groups.push_back(std::move(group));
  }
  return groups;
}

Vec3 SolidPart::foot(Face face) const {
  const PartContact contact = part_contact(mesh_, face, x_, radius_, true);
  const Triangle& corners = mesh_.triangle(contact.triangle);
  Vec3 offset;
  for (std::size_t k = 0; k < 3; ++k) {
    const double w = std::clamp(contact.weights[k], 0.0, 1.0);
    const Vec3 to = difference(mesh_.at(corners[k]), x_);
    offset = sum(offset, {w * to.x, w * to.y, w * to.z});
  }
  return offset;
}

SolidPart::Way SolidPart::way(const Group& group, Face face, double condition) const {
  const auto ends = mesh_.vertices(face);
  const Vec3 offset = foot(face);
  std::map<Index, Passage> passages;
  const auto passage_of = [&](Index t) -> const Passage& {
    const auto known = passages.find(t);
    return known != passages.end() ? known->second : passages.emplace(t, passage(t, offset, condition)).first->second;
  };
  std::map<Index, double> earliest;
  std::deque<Index> waiting;
  for (const Index t : group.tetrahedra) earliest[t] = 0, waiting.push_back(t);
  Way way{false, true, {}};
  while (!waiting.empty()) {
    const Index t = waiting.front();
    waiting.pop_front();
    const Passage& own = passage_of(t);
    const double entered = earliest.at(t);
    for (const Index v : solid_.tetrahedra()[at(t)]) {
      for (const Index next : solid_.tetrahedra_of(v)) {
        if (next == t || (!solid_.is_positive(next) && !solid_.is_doubtful(next))) continue;
        Piece gate = own.inside();
        for (std::size_t k = 0; k < 4; ++k)
          if (!has(solid_.tetrahedra()[at(next)], solid_.tetrahedra()[at(t)][k])) own.keep_on(k, gate);
        if (gate.low > gate.high || gate.high < entered) continue;
        const double through = std::max(entered, gate.low);
        const auto known = earliest.find(next);
        if (known != earliest.end() && known->second <= through) continue;
        earliest[next] = through;
        waiting.push_back(next);
      }
    }
  }
  for (const auto& [t, entered] : earliest) {
    way.reached.push_back(t);
    const Tetrahedron& corners = solid_.tetrahedra()[at(t)];
    way.possible = way.possible || std::ranges::all_of(ends.span(), [&](Index v) { return has(corners, v); });
    if (solid_.is_doubtful(t)) way.certain = false;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!solid_.is_closed(t, k)) continue;
      const Triangle side = solid_.side(t, k);
      const auto on_side = [&](Index v) { return std::ranges::find(side, v) != side.end(); };
      // The way may touch the boundary only at its end.
      if (std::ranges::all_of(ends.span(), on_side) && passage_of(t).start[k] > passage_of(t).grey[k]) continue;
      Piece touching = passage_of(t).inside();
      passage_of(t).keep_on(k, touching);
      if (touching.low <= touching.high && touching.high >= entered) way.certain = false;
    }
  }
  return way;
}

/// Returns whether the way to the face exists in exact numbers. `way` must be possible, and the face must hold the
/// triangle's closest point to x.
bool SolidPart::is_exact_way(const std::vector<Index>& sheet, const Way& way, Face face, Index triangle) const {
  const auto corner = [&](std::size_t k) { return rational(mesh_.at(mesh_.triangle(triangle)[k])); };
  const RationalPoint start = rational(x_), end = closest_point({corner(0), corner(1), corner(2)}, start);
  const auto ends = mesh_.vertices(face);
  std::map<Index, Rational> earliest;
  std::deque<Index> waiting;
  for (const Index t : sheet) earliest[t] = 0, waiting.push_back(t);
  while (!waiting.empty()) {
    const Index t = waiting.front();
    waiting.pop_front();
    const Tetrahedron& own = solid_.tetrahedra()[at(t)];
    if (std::ranges::all_of(ends.span(), [&](Index v) { return has(own, v); })) return true;
    const Crossing crossing(corners_of(mesh_.positions, own), start, end);
    const Rational entered = earliest.at(t);
    for (const Index next : way.reached) {
      if (next == t || !solid_.is_positive(next)) continue;
      std::array<bool, 4> shared{};
      for (std::size_t k = 0; k < 4; ++k) shared[k] = has(solid_.tetrahedra()[at(next)], own[k]);
      if (std::ranges::count(shared, true) == 0) continue;
      const auto gate = crossing.within(shared);
      if (!gate || gate->high < entered) continue;
      const Rational through = std::max(entered, gate->low);
      const auto known = earliest.find(next);
      if (known != earliest.end() && known->second <= through) continue;
      earliest[next] = through;
      waiting.push_back(next);
    }
  }
  return false;
}

VolumeSheetTruth SolidPart::sheets_of(const Group& group, const std::vector<Index>& triangles) {
  std::vector<Index> order;
  for (const Index t : triangles) {
    const Index owner = solid_.owner(t);
    if (solid_.is_positive(owner) || solid_.is_doubtful(owner)) order.push_back(t);
  }
  const auto low = [&](Index t) { return faces_.distance[at(t)] - doubt(t); };
  std::ranges::sort(order, {}, low);
  struct Offered {
    Face face;
    double low;
  };
  struct NearestFace {
    std::optional<Face> face;
    Margin gap;
  };
  std::vector<Offered> offered;
  std::vector<NearestFace> exact(group.sheets.size());
  double reach = INFINITY;  // upper limit of the length of the shortest way
  std::map<Face, Way> ways;
  for (const Index t : order) {
    if (low(t) > reach) break;
    const Face own_face = closest_face_of(mesh_, t, x_);
    for (int f = 0; f < 7; ++f) {
      const Face face = face_of(t, f);
      if ((faces_.accepted[at(t)] >> f & 1) == 0 || contains(face, own_)) continue;
      const auto [entry, is_new] = ways.try_emplace(face);
      if (is_new) entry->second = way(group, face, face.kind == FaceKind::triangle ? normal_scale(t) : 1);
      if (!entry->second.possible) continue;
      offered.push_back({face, low(t)});
      bool is_exact = false;
      for (std::size_t s = 0; s < exact.size() && face == own_face && solid_.is_positive(solid_.owner(t)); ++s) {
        if (!is_exact_way(group.sheets[s], entry->second, face, t)) continue;
        is_exact = true;
        const Margin gap = face_gap(mesh_, face, x_, 0);
        const int order_of = exact[s].face ? compare_distances(gap, exact[s].gap) : -1;
        if (order_of < 0 || (order_of == 0 && face < *exact[s].face)) exact[s] = {face, gap};
      }
      if (is_exact && entry->second.certain && group.is_certain && !solid_.is_doubtful(solid_.owner(t)))
        reach = std::min(reach, faces_.distance[at(t)] + doubt(t));
    }
  }
  VolumeSheetTruth truth;
  truth.exact = static_cast<int>(group.sheets.size());
  truth.is_certain = group.is_certain;
  truth.may_be_unresolved = reach == INFINITY;
  std::vector<Face> faces;
  for (const NearestFace& nearest : exact) {
    if (!nearest.face) {
      ++truth.exact_unresolved;
    } else if (std::ranges::find(faces, *nearest.face) == faces.end()) {
      faces.push_back(*nearest.face);
    }
  }
  truth.exact_contacts = static_cast<int>(faces.size());
  for (const Offered& candidate : offered)
    if (candidate.low <= reach && std::ranges::find(faces, candidate.face) == faces.end())
      faces.push_back(candidate.face);
  for (const Face face : faces) truth.accepted.push_back(answer(face, true));
  grey = grey || !group.is_certain || truth.accepted.size() > 1 || (truth.may_be_unresolved && !faces.empty());
  return truth;
}

/// Returns whether some triangle around the face belongs to a tetrahedron whose volume is not certainly positive.
bool SolidPart::is_vague(Face face) const {
  return std::ranges::any_of(around(face), [&](Index t) {
    return !solid_.is_positive(solid_.owner(t)) || solid_.is_doubtful(solid_.owner(t));
  });
}

VolumePartTruth SolidPart::part(const std::vector<Index>& triangles) {
  VolumePartTruth truth;
  truth.is_solid = true;
  truth.may_be_outside = true;
  for (const Group& group : groups(solid_.component(mesh_.triangle(triangles.front())[0]))) {
    truth.inside = truth.inside || !group.sheets.empty();
    truth.may_be_inside = true;
    truth.may_be_outside = truth.may_be_outside && !group.is_certain;
    truth.sheets.push_back(sheets_of(group, triangles));
  }
  if (!truth.may_be_outside) return truth;
  const auto [least, candidates] = nearest_of(triangles);
  const Face nearest = exactly_nearest(candidates);
  const bool faces_in = !begins_outside(mesh_, nearest, x_), on_surface = is_on_surface(candidates);
  touch(triangles, nearest, faces_in, truth);
  for (const Face face : possible_faces(candidates, nearest, least))
    if ((!faces_in || on_surface) && !contains(face, own_)) add_touching(face, truth);
  for (const VolumeSheetTruth& sheet : truth.sheets)
    for (const compare::VolumeAnswer& answer : sheet.accepted) add_touching(answer.contact.face, truth);
  const MarginAnswer reach = examine(face_gap(mesh_, nearest, x_, radius_));
  truth.needs_contact = own_ < 0 && truth.sheets.empty() && !is_vague(nearest) && reach.sign < 0 && !reach.grey &&
                        !faces_in && !on_surface;
  near = near || reach.near || truth.may_be_inside;
  return truth;
}

}  // namespace ogc::reference
