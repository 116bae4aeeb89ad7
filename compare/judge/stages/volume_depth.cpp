// Makes the traits of stage volume_depth. The verdict treats each part of a volume separately.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/engine/features.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/engine/topology_json.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"
#include "compare/judge/stages/volumes/solid_cases.hpp"
#include "compare/judge/stages/volumes/volume_cases.hpp"
#include "compare/problem/tetrahedra.hpp"

namespace ogc::compare {

namespace {

std::string print(const VolumeContact& c, const Topology& topology) {
  return std::string(c.inside != 0 ? "inside at " : "outside at ") + face_name(c.face, topology) + ", triangle " +
         std::to_string(c.triangle);
}

/// Returns the key by which contacts are sorted.
auto key_of(const VolumeContact& c) { return std::tuple(c.point, c.inside, c.triangle, c.face); }

/// Returns whether triangles around a vertex certainly pass through one another. Then the vertex has no outer side. Two
/// triangles that share no edge do so if their arcs cross on a sphere about the vertex. Let a and b be the vectors from
/// the vertex to the ends of one arc, c and d those of the other. The planes of the arcs meet along
/// (a × b) × (c × d) = c det(a, b, d) − d det(a, b, c) = b det(c, d, a) − a det(c, d, b). The arcs cross if this
/// vector, or its negative, lies between a and b and between c and d: the signs of the determinants decide it.
bool is_folded_around(Index v, const Topology& topology, std::span<const Vec3f> positions) {
  const auto away = [&](Index w) {
    const Vec3f &p = positions[at(w)], &q = positions[at(v)];
    return Vec3{double{p.x} - q.x, double{p.y} - q.y, double{p.z} - q.z};
  };
  const auto norm = [](const Vec3& a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); };
  // Each of the six products is rounded at most five times, and each of its three factors once, to 2⁻⁵³ of its size.
  // The sizes add up to at most ‖a‖₁ ‖b‖₁ ‖c‖₁, so that the error is at most 8 · 2⁻⁵³ of it.
  const auto sign = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double value = a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
    return std::abs(value) <= 0x1p-50 * norm(a) * norm(b) * norm(c) ? 0 : value > 0 ? 1 : -1;
  };
  std::vector<std::array<Index, 2>> arcs;
  for (const Index t : topology.vertex_triangles[at(v)]) {
    const Triangle& corner = topology.triangles[at(t)];
    const std::size_t k = corner[0] == v ? 0 : corner[1] == v ? 1 : 2;
    arcs.push_back({corner[(k + 1) % 3], corner[(k + 2) % 3]});
  }
  for (std::size_t i = 0; i < arcs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (std::ranges::find_first_of(arcs[i], arcs[j]) != arcs[i].end()) continue;
      const Vec3 a = away(arcs[i][0]), b = away(arcs[i][1]), c = away(arcs[j][0]), d = away(arcs[j][1]);
      const int abc = sign(a, b, c), abd = sign(a, b, d), cda = sign(c, d, a), cdb = sign(c, d, b);
      if (abc != 0 && abd == -abc && cdb == abc && cda == -abc) return true;
    }
  return false;
}

std::string point_name(std::size_t i) { return "point " + std::to_string(i) + ": "; }

/// Compares the contacts between one point and one part with the accepted ones.
class PartVerdict {
 public:
  PartVerdict(std::size_t point, const VolumePartTruth& truth, std::vector<VolumeContact> mine,
              const VolumeDepthCase& asked, Tally& tally)
      : point_(point),
        truth_(truth),
        mine_(std::move(mine)),
        asked_(asked),
        topology_(*asked.topology),
        tally_(tally) {}

  /// Least and largest number of sheets without a way that the answer may report.
  struct Unresolved {
    std::size_t least = 0, most = 0;
  };
  Unresolved unresolved;

  void judge() {
    if (truth_.is_solid) return judge_solid();
    const bool inside = std::ranges::any_of(mine_, [](const VolumeContact& c) { return c.inside != 0; });
    if (inside)
      judge_inside();
    else
      judge_outside();
  }

 private:
  void mismatch(const std::string& what) { tally_.mismatch(point_name(point_) + what); }

  static const VolumeAnswer* find(const std::vector<VolumeAnswer>& answers, const VolumeContact& c) {
    const auto found = std::ranges::find_if(
        answers, [&](const VolumeAnswer& a) { return a.contact.triangle == c.triangle && a.contact.face == c.face; });
    return found == answers.end() ? nullptr : &*found;
  }

  std::string exactly() const {
    return truth_.inside ? "exact " + print(truth_.held.front().contact, topology_) : "exact outside";
  }

  static bool accepts(const VolumeSheetTruth& sheet, const VolumeContact& c) {
    return find(sheet.accepted, c) != nullptr;
  }

  /// Checks that
  /// - each contact belongs to a sheet,
  /// - each sheet that certainly exists and has a way has a contact,
  /// - there are not more contacts than sheets.
  void judge_solid() {
    const bool inside = std::ranges::any_of(mine_, [](const VolumeContact& c) { return c.inside != 0; });
    if (inside != truth_.inside) tally_.answered_not_exactly();
    std::size_t most = 0;
    for (const VolumeSheetTruth& sheet : truth_.sheets) {
      const std::size_t sheets = sheet.is_certain ? 1 : static_cast<std::size_t>(std::max(1, sheet.exact));
      most += sheets;
      const bool has_contact = std::ranges::any_of(
          mine_, [&](const VolumeContact& c) { return c.inside != 0 && accepts(sheet, c); });
      if (sheet.may_be_unresolved) unresolved.most += sheets;
      if (!sheet.is_certain || has_contact) continue;
      ++unresolved.least;
      if (sheet.may_be_unresolved) continue;
      return mismatch("a sheet that holds it has no contact, or none that is accepted; exact " +
                      print(sheet.accepted.front().contact, topology_));
    }
    std::size_t held = 0;
    for (const VolumeContact& c : mine_) {
      if (c.inside == 0) {
        if (inside || !truth_.may_be_outside)
          return mismatch(print(c, topology_) + ", and some sheet of this part holds it");
        continue;
      }
      ++held;
      const VolumeAnswer* accepted = nullptr;
      bool is_exact = false;
      for (const VolumeSheetTruth& sheet : truth_.sheets) {
        const VolumeAnswer* found = find(sheet.accepted, c);
        if (found == nullptr) continue;
        accepted = found;
        is_exact = is_exact || found - sheet.accepted.data() < sheet.exact_contacts;
      }
      if (accepted == nullptr) return mismatch(print(c, topology_) + " is the contact of no sheet");
      if (!is_exact) tally_.answered_not_exactly();
      judge_numbers(c, *accepted);
    }
    if (held > most) return mismatch("has more contacts than sheets hold it");
    if (!inside && truth_.may_be_outside) judge_outside();
  }

  void judge_inside() {
    if (mine_.size() != 1) return mismatch("a part that holds the point has one contact, not several side by side");
    const VolumeAnswer* accepted = truth_.may_be_inside ? find(truth_.held, mine_[0]) : nullptr;
    if (accepted == nullptr) return mismatch(print(mine_[0], topology_) + " is not accepted; " + exactly());
    if (!truth_.inside || accepted != truth_.held.data()) tally_.answered_not_exactly();
    judge_numbers(mine_[0], *accepted);
  }

  void judge_outside() {
    if (!truth_.may_be_outside) return mismatch("is not inside of any part, which it is; " + exactly());
    if (truth_.inside) tally_.answered_not_exactly();
    if (truth_.needs_contact && mine_.empty()) return mismatch("is nearer than r and has no contact (covering)");
    for (std::size_t k = 0; k < truth_.touching.size(); ++k) {
      const VolumeContact& contact = truth_.touching[k].contact;
      const bool answered = std::ranges::any_of(
          mine_, [&](const VolumeContact& c) { return c.triangle == contact.triangle && c.face == contact.face; });
      if (truth_.is_certain[k] != 0 && !answered && !has_no_side(contact.face))
        mismatch(print(contact, topology_) + " is missing");
      if (!truth_.inside && answered != (truth_.is_exact[k] != 0)) tally_.answered_not_exactly();
    }
    for (const VolumeContact& contact : mine_) {
      if (const VolumeAnswer* accepted = find(truth_.touching, contact))
        judge_numbers(contact, *accepted);
      else if (has_no_side(contact.face))
        judge_at_fold(contact);
      else
        mismatch(print(contact, topology_) + " is no contact");
    }
  }

  bool has_no_side(Face face) const {
    return face.kind == FaceKind::vertex && is_folded_around(face.index, topology_, asked_.positions);
  }

  /// Judges a contact at a vertex without an outer side. It may be there or not, but its numbers are the vertex's.
  void judge_at_fold(const VolumeContact& c) {
    tally_.answered_not_exactly();
    const Vec3f &x = asked_.points[point_], &v = asked_.positions[at(c.face.index)];
    const Vec3 away{double{x.x} - v.x, double{x.y} - v.y, double{x.z} - v.z};
    const double d = std::hypot(away.x, away.y, away.z), r = asked_.contact_radius;
    // The distance is rounded a few times to 2⁻⁵³ of itself.
    if (d > r * (1 + 0x1p-50)) return mismatch(print(c, topology_) + " is not nearer than r");
    if (c.triangle != topology_.vertex_triangles[at(c.face.index)].front())
      return mismatch(print(c, topology_) + " does not name the lowest-numbered triangle");
    const Triangle& corners = topology_.triangles[at(c.triangle)];
    VolumeAnswer exact;
    exact.depth = r - d, exact.depth_scale = d + r;
    for (std::size_t k = 0; k < 3; ++k) exact.weights[k] = corners[k] == c.face.index ? 1 : 0;
    exact.weight_scale = 1;
    if (d > 0) exact.direction = {away.x / d, away.y / d, away.z / d};
    exact.direction_scale = d > 0 ? 1 : std::numeric_limits<double>::infinity();
    judge_numbers(c, exact);
  }

  void judge_numbers(const VolumeContact& c, const VolumeAnswer& exact) {
    const auto where = [&] { return point_name(point_) + print(c, topology_); };
    tally_.error(0, in_units(std::abs(c.depth - exact.depth), exact.depth_scale),
                 [&] { return where() + text(": depth %.9g, exact %.9g", c.depth, exact.depth); });
    double worst = 0;
    for (std::size_t k = 0; k < 3; ++k) worst = std::max(worst, std::abs(c.weights[k] - exact.weights[k]));
    tally_.error(1, in_units(worst, exact.weight_scale),
                 [&] { return where() + text(": weights off by %.9g of scale %.9g", worst, exact.weight_scale); });
    const double turned = std::hypot(c.direction.x - exact.direction.x, c.direction.y - exact.direction.y,
                                     c.direction.z - exact.direction.z);
    tally_.error(2, std::isinf(exact.direction_scale) ? 0 : in_units(turned, exact.direction_scale), [&] {
      return where() + text(": direction off by %.9g of scale %.9g", turned, exact.direction_scale);
    });
  }

  std::size_t point_;
  const VolumePartTruth& truth_;
  std::vector<VolumeContact> mine_;
  const VolumeDepthCase& asked_;
  const Topology& topology_;
  Tally& tally_;
};

/// Checks whether the list is sorted, without duplicates, and names points and triangles that exist.
bool is_list(const std::vector<VolumeContact>& contacts, std::size_t points, const Topology& topology, Tally& tally) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const VolumeContact& c = contacts[i];
    if (c.point < 0 || at(c.point) >= points || c.triangle < 0 || at(c.triangle) >= topology.triangles.size()) {
      tally.mismatch("contact " + std::to_string(i) + " is of a point or a triangle that does not exist");
      return false;
    }
    if (i > 0 && !(key_of(contacts[i - 1]) < key_of(c))) {
      tally.mismatch("contact " + std::to_string(i) + " stands out of order, or twice");
      return false;
    }
  }
  return true;
}

std::uint64_t marked(const std::vector<std::uint8_t>& flags) {
  return static_cast<std::uint64_t>(std::ranges::count(flags, std::uint8_t{1}));
}

WrongForm depth_told(std::string name, std::string meaning, void (*change)(VolumeAnswer&, float)) {
  return told(std::move(name), std::move(meaning), &Authority::volume_depth,
              [change](const VolumeDepthIn& in, VolumeDepthTruth& truth) {
                for (auto& parts : truth.parts)
                  for (VolumePartTruth& part : parts) {
                    std::vector<std::vector<VolumeAnswer>*> all{&part.held, &part.touching};
                    for (VolumeSheetTruth& sheet : part.sheets) all.push_back(&sheet.accepted);
                    for (auto* answers : all)
                      for (VolumeAnswer& answer : *answers) change(answer, in.contact_radius);
                  }
              });
}

std::vector<WrongForm> volume_depth_forms() {
  return {depth_told("radius_missing_inside", "depth ‖x − c‖ inside, without r",
                     [](VolumeAnswer& a, float r) {
                       if (a.contact.inside != 0) a.depth -= r;
                     }),
          depth_told("distance_for_depth", "‖x − c‖ outside, where r − ‖x − c‖ is the depth",
                     [](VolumeAnswer& a, float r) {
                       if (a.contact.inside == 0) a.depth = r - a.depth;
                     }),
          depth_told("direction_flipped", "−n for n",
                     [](VolumeAnswer& a, float) {
                       a.direction = {-a.direction.x, -a.direction.y, -a.direction.z};
                     }),
          asked("radius_doubled", "2 r for r", &Authority::volume_depth,
                [](VolumeDepthIn& in) { in.contact_radius *= 2; })};
}

}  // namespace

void judge_volume_depth(const TestCase& test, const VolumeDepthTruth& truth, const VolumeDepthOut& out, Tally& tally) {
  const auto& asked = case_of<VolumeDepthCase>(test.data);
  const Topology& topology = *asked.topology;
  tally.begin(test.name);
  const std::size_t points = asked.points.size();
  tally.count(points, points * topology.triangles.size(), marked(truth.grey), marked(truth.near));
  if (!is_list(out.contacts, points, topology, tally)) return;
  if (!std::ranges::is_sorted(out.unresolved) ||
      (!out.unresolved.empty() && (out.unresolved.front() < 0 || at(out.unresolved.back()) >= points)))
    return tally.mismatch("sheets without a way are of points that do not exist, or out of order");
  const std::vector<Index> component = joined_components(topology, asked.tetrahedra, asked.cavities);
  const auto part_of = [&](const VolumeContact& c) { return component[at(topology.triangles[at(c.triangle)][0])]; };
  std::size_t next = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t first = next;
    std::size_t least = 0, most = 0;  // numbers of sheets without a way
    while (next < out.contacts.size() && at(out.contacts[next].point) == i) ++next;
    for (const VolumePartTruth& part : truth.parts[i]) {
      std::vector<VolumeContact> mine;
      for (std::size_t k = first; k < next; ++k)
        if (part_of(out.contacts[k]) == part.component) mine.push_back(out.contacts[k]);
      PartVerdict verdict(i, part, std::move(mine), asked, tally);
      verdict.judge();
      least += verdict.unresolved.least, most += verdict.unresolved.most;
    }
    const auto lost = static_cast<std::size_t>(std::ranges::count(out.unresolved, static_cast<Index>(i)));
    if (lost < least || lost > most)
      tally.mismatch(point_name(i) + std::to_string(lost) + " sheets without a way; accepted " + std::to_string(least) +
                     " to " + std::to_string(most));
  }
}

namespace {

struct VolumeDepth : MeshStage<VolumeDepth, &Contestant::volume_depth, &Authority::volume_depth>,
                     TakenWhole,
                     Numbered,
                     OwnCases,
                     ParametersOfCase<VolumeDepth>,
                     InEveryRun {
  using Case = VolumeDepthCase;
  static constexpr StageInfo info{.name = "volume_depth",
                                  .question = "parts of a volume that hold a point or are near, depth and direction",
                                  .unit = "point",
                                  .reference = "reference/definitions/volume_depth.cpp",
                                  .kind = CaseKind::mesh,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"depth", "u cond", volume_depth_tolerance},
                                      MetricInfo{"weights", "u cond", volume_weight_tolerance},
                                      MetricInfo{"direction", "u cond", volume_direction_tolerance}};
  static constexpr std::array parameters{ranges::contact_radius};
  static float* parameter(Case& c, std::string_view) { return &c.contact_radius; }

  static std::span<const Generator> generators() { return volume_depth_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    problem.vectors("a coordinate", c.positions);
    problem.vectors("a coordinate of a point", c.points);
    problem.number("a contact radius", c.contact_radius, least_length, most_length);
    problem.require(c.positions.size() == at(c.topology->vertex_count), "positions need one entry a vertex");
    const std::string why = volume_problem(*c.topology, c.positions);
    problem.require(why.empty(), why.c_str());
    for (const Edge& cavity : c.cavities)
      for (const Index v : cavity)
        problem.require(v >= 0 && v < c.topology->vertex_count, "a cavity needs a vertex of the volume on either side");
    const std::string solid = solid_problem(c);
    problem.require(solid.empty(), solid.c_str());
  }
  /// Moves only points, because a volume whose vertices move may fold. Clears `own`, because moved points are not
  /// vertices of the volume.
  static void mutate(Random& random, Case& c) {
    mutate_points(random, c.points);
    c.own.clear();
  }
  /// Returns the coordinates of all points that are not vertices of the volume.
  static std::vector<float*> coordinates(Case& c) {
    std::vector<float*> all;
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      if (!c.own.empty() && c.own[i] >= 0) continue;
      for (float* x : {&c.points[i].x, &c.points[i].y, &c.points[i].z}) all.push_back(x);
    }
    return all;
  }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return volume_of_state(states.whole(states.frame(index), random), random);
  }

  static Json write(const Case& c) {
    return {{"mesh", topology_to_json(*c.topology)},
            {"positions", points_to_json(c.positions)},
            {"contact_radius", hexadecimal(c.contact_radius)},
            {"points", points_to_json(c.points)},
            {"tetrahedra", c.tetrahedra},
            {"own", c.own},
            {"cavities", c.cavities}};
  }
  static Case read(const Json& data) {
    Case c{to_topology(data.at("mesh"), data.at("positions").size()), {}, number(data.at("contact_radius")), {}};
    for (const Json& p : data.at("positions")) c.positions.push_back(to_point(p));
    for (const Json& p : data.at("points")) c.points.push_back(to_point(p));
    if (data.contains("tetrahedra")) data.at("tetrahedra").get_to(c.tetrahedra);
    if (data.contains("own")) data.at("own").get_to(c.own);
    if (data.contains("cavities")) data.at("cavities").get_to(c.cavities);
    if (c.positions.size() != at(c.topology->vertex_count)) throw InputError("positions need one entry a vertex");
    return c;
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add(*c.topology, c.positions);
    for (const Vec3f& p : c.points) shape.dots.push_back(shape.add(p));
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    return joined(
        {scalar("contact_radius", "m", c.contact_radius)}, mesh_quantities(*c.topology),
        std::vector{compare::points("positions", "m", c.positions), compare::points("points", "m", c.points)});
  }

  static In question(const Case& c) {
    return {c.topology.get(), c.positions, c.contact_radius, c.points, c.tetrahedra, c.own, c.cavities};
  }
  static constexpr auto judge = judge_volume_depth;
  static void add(Bits& bits, const Out& out) {
    bits.add(out.contacts);
    bits.add(out.unresolved);
  }
  static std::int64_t items(const Case& c) { return static_cast<std::int64_t>(c.points.size()); }

  static std::vector<Quantity> outputs(const In& in, const Out& out) {
    std::vector<std::string> names;
    std::vector<float> depths;
    for (const VolumeContact& c : out.contacts) {
      names.push_back(point_name(at(c.point)) + print(c, *in.topology));
      depths.push_back(c.depth);
    }
    return {words("contacts", names), compare::numbers("depth", "m", depths)};
  }
  static std::vector<Quantity> outputs(const In& in, const Truth& truth) {
    std::vector<const VolumeAnswer*> all;
    for (const std::vector<VolumePartTruth>& parts : truth.parts)
      for (const VolumePartTruth& part : parts) {
        const std::vector<const VolumeAnswer*> exact = exact_answers(part);
        all.insert(all.end(), exact.begin(), exact.end());
      }
    std::ranges::sort(all, {}, [](const VolumeAnswer* a) { return key_of(a->contact); });
    std::vector<std::string> names;
    std::vector<double> depths;
    for (const VolumeAnswer* a : all) {
      names.push_back(point_name(at(a->contact.point)) + print(a->contact, *in.topology));
      depths.push_back(a->depth);
    }
    return {words("contacts", names), compare::numbers("depth", "m", depths)};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return volume_depth_forms(); }
};

}  // namespace

constinit const StageTraits stages::volume_depth = make_traits<VolumeDepth>();

}  // namespace ogc::compare
