#include "compare/judge/shrink.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>

#include "compare/judge/judge.hpp"
#include "compare/judge/legal.hpp"

namespace ogc::compare {

namespace {

/// x with so many binary digits, rounded to nearest.
float with_digits(float x, int digits) {
  int exponent = 0;
  const double fraction = std::frexp(double{x}, &exponent);
  return static_cast<float>(std::ldexp(std::nearbyint(std::ldexp(fraction, digits)), exponent - digits));
}

constexpr std::array digit_counts{1, 2, 3, 5, 8, 12, 16, 20};

/// Triangles and loose edges of a mesh, in one list.
struct Primitives {
  std::vector<Triangle> triangles;
  std::vector<Edge> loose_edges;

  explicit Primitives(const Topology& topology) : triangles(topology.triangles) {
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      if (topology.edge_triangles[e].empty()) loose_edges.push_back(topology.edges[e]);
  }
  std::size_t size() const { return triangles.size() + loose_edges.size(); }
  /// Without those from `first` to `last`.
  Primitives without(std::size_t first, std::size_t last) const {
    Primitives kept = *this;
    kept.triangles.clear();
    kept.loose_edges.clear();
    for (std::size_t i = 0; i < size(); ++i) {
      if (first <= i && i < last) continue;
      if (i < triangles.size())
        kept.triangles.push_back(triangles[i]);
      else
        kept.loose_edges.push_back(loose_edges[i - triangles.size()]);
    }
    return kept;
  }
};

/// A mesh of some primitives of another one: its vertices are those that they hold, in order.
struct Part {
  std::shared_ptr<const Topology> topology;
  std::vector<Index> vertices;         ///< number in the other mesh
  std::vector<std::size_t> edges;      ///< likewise
  std::vector<std::size_t> triangles;  ///< likewise; empty where all are dropped

  Part(const Topology& whole, const Primitives& kept) {
    std::vector<Index> number(static_cast<std::size_t>(whole.vertex_count), -1);
    for (const Triangle& t : kept.triangles)
      for (const Index v : t) number[static_cast<std::size_t>(v)] = 0;
    for (const Edge& e : kept.loose_edges)
      for (const Index v : e) number[static_cast<std::size_t>(v)] = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) continue;
      number[v] = static_cast<Index>(vertices.size());
      vertices.push_back(static_cast<Index>(v));
    }
    std::vector<Triangle> corners;
    std::vector<Edge> loose;
    for (const Triangle& t : kept.triangles) corners.push_back({number[t[0]], number[t[1]], number[t[2]]});
    for (const Edge& e : kept.loose_edges) loose.push_back({number[e[0]], number[e[1]]});
    topology = std::make_shared<Topology>(build_topology(static_cast<Index>(vertices.size()), corners, loose));
    for (const Edge& e : topology->edges)
      edges.push_back(static_cast<std::size_t>(find_edge(whole, vertices[e[0]], vertices[e[1]])));
    for (const Triangle& t : kept.triangles)
      triangles.push_back(static_cast<std::size_t>(std::find(whole.triangles.begin(), whole.triangles.end(), t) -
                                                   whole.triangles.begin()));
  }
};

template <class T, class Numbers>
std::vector<T> picked(const std::vector<T>& items, const Numbers& numbers) {
  std::vector<T> chosen;
  for (const auto i : numbers) chosen.push_back(items[static_cast<std::size_t>(i)]);
  return chosen;
}

/// `vertices` ascending.
CompressedRows partners_of(const CompressedRows& partners, const std::vector<Index>& vertices) {
  std::vector<std::array<Index, 2>> pairs;
  const auto number = [&](Index v) {
    const auto found = std::lower_bound(vertices.begin(), vertices.end(), v);
    return found != vertices.end() && *found == v ? static_cast<Index>(found - vertices.begin()) : -1;
  };
  for (const auto& [a, b] : pairs_of(partners))
    if (number(a) >= 0 && number(b) >= 0) pairs.push_back({number(a), number(b)});
  return partner_rows(vertices.size(), pairs);
}

CaseData part_of(const MeshCase& c, const Primitives& kept) {
  const Part part(*c.topology, kept);
  return MeshCase{
      part.topology,  picked(c.rigid_groups, part.vertices), picked(c.positions, part.vertices), c.contact_radius,
      c.query_radius, partners_of(c.partners, part.vertices)};
}

CaseData part_of(const BoundCase& c, const Primitives& kept) {
  const Part part(*c.topology, kept);
  return BoundCase{part.topology, picked(c.d_min_vertex, part.vertices), picked(c.d_min_edge, part.edges),
                   picked(c.d_min_triangle, part.triangles), c.bound_relaxation};
}

/// The numbers of a case that may be simplified; where it has points, they come first, as x y z.
struct Numbers {
  std::vector<float*> coordinates, lengths;  ///< lengths stay above 0
  void point(Vec3f& p) {
    for (float* x : {&p.x, &p.y, &p.z}) coordinates.push_back(x);
  }
  void operator()(ClosestFaceCase& c) {
    point(c.point);
    for (Vec3f& p : c.triangle) point(p);
  }
  void operator()(ClosestPointsCase& c) {
    for (auto* edge : {&c.first, &c.second})
      for (Vec3f& p : *edge) point(p);
  }
  void operator()(MeshCase& c) {
    for (Vec3f& p : c.positions) point(p);
    lengths = {&c.contact_radius, &c.query_radius};
  }
  void operator()(BoundCase& c) {
    for (auto* distances : {&c.d_min_vertex, &c.d_min_edge, &c.d_min_triangle})
      for (float& d : *distances) lengths.push_back(&d);
  }
  template <class Other>
  void operator()(Other&) {}
};

Numbers numbers_of(CaseData& data) {
  Numbers numbers;
  std::visit([&](auto& c) { numbers(c); }, data);
  return numbers;
}

class Shrinker {
 public:
  Shrinker(const TestCase& test, const std::function<bool(const TestCase&)>& fails, const ShrinkOptions& options)
      : best_(test), fails_(fails), options_(options), was_legal_(problem_of(test.data).empty()) {}

  TestCase run() {
    while (drop_primitives()) {}
    simplify_numbers();
    return best_;
  }

 private:
  bool out_of_budget() const {
    return tries_ >= options_.tries ||
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() > options_.seconds;
  }

  /// Keeps the candidate where it fails, too.
  bool attempt(const CaseData& data) {
    if (out_of_budget()) return false;
    ++tries_;
    TestCase candidate{best_.name, data};
    if ((was_legal_ && !problem_of(candidate.data).empty()) || !fails_(candidate)) return false;
    best_ = std::move(candidate);
    return true;
  }

  /// Once through the list, from halves to single ones; whether anything went.
  bool drop_primitives() {
    bool dropped = false;
    if (auto* mesh = std::get_if<MeshCase>(&best_.data)) dropped = drop_from<MeshCase>(Primitives(*mesh->topology));
    if (auto* bound = std::get_if<BoundCase>(&best_.data)) dropped = drop_from<BoundCase>(Primitives(*bound->topology));
    return dropped;
  }

  template <class Case>
  bool drop_from(Primitives primitives) {
    const std::size_t before = primitives.size();
    for (std::size_t chunk = (before + 1) / 2; chunk > 0; chunk /= 2) {
      for (std::size_t first = 0; first < primitives.size() && primitives.size() > 1;) {
        const Primitives kept = primitives.without(first, first + chunk);
        if (kept.size() > 0 && attempt(part_of(std::get<Case>(best_.data), kept)))
          primitives = Primitives(*std::get<Case>(best_.data).topology);
        else
          first += chunk;
      }
    }
    return primitives.size() < before && !out_of_budget();
  }

  void simplify_numbers() {
    move_to_origin();
    for (const bool is_length : {true, false}) {
      CaseData data = best_.data;
      const std::size_t count = (is_length ? numbers_of(data).lengths : numbers_of(data).coordinates).size();
      for (std::size_t i = 0; i < count; ++i) simplify(i, is_length);
    }
  }

  /// First point to the origin; differences are rounded, so this may end the failure.
  void move_to_origin() {
    CaseData data = best_.data;
    const Numbers numbers = numbers_of(data);
    if (numbers.coordinates.empty()) return;
    const std::array<float, 3> origin{*numbers.coordinates[0], *numbers.coordinates[1], *numbers.coordinates[2]};
    for (std::size_t i = 0; i < numbers.coordinates.size(); ++i) *numbers.coordinates[i] -= origin[i % 3];
    attempt(data);
  }

  void simplify(std::size_t i, bool is_length) {
    const auto set = [&](float x) {
      CaseData data = best_.data;
      *(is_length ? numbers_of(data).lengths : numbers_of(data).coordinates)[i] = x;
      return attempt(data);
    };
    CaseData data = best_.data;
    const float x = *(is_length ? numbers_of(data).lengths : numbers_of(data).coordinates)[i];
    if (x == 0 || !std::isfinite(x)) return;
    if (!is_length && set(0)) return;
    for (const int digits : digit_counts) {
      const float simple = with_digits(x, digits);
      if (simple == x || set(simple)) return;
    }
  }

  TestCase best_;
  const std::function<bool(const TestCase&)>& fails_;
  const ShrinkOptions& options_;
  bool was_legal_;  ///< a saved case may be of another version's contract: then all is tried
  std::size_t tries_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

namespace {

/// What goes wrong, without the numbers that change with the case: what stands before the colon, and whether something
/// is missing or too much.
std::string kind_of(const std::string& message) {
  std::string kind;
  for (const char c : message.substr(0, message.find(':')))
    if (c < '0' || c > '9') kind += c;
  for (const char* word : {" is missing", " is no contact", " is above"})
    if (message.find(word) != std::string::npos) kind += word;
  return kind;
}

}  // namespace

std::size_t primitive_count(const CaseData& data) {
  if (const auto* mesh = std::get_if<MeshCase>(&data)) return Primitives(*mesh->topology).size();
  if (const auto* bound = std::get_if<BoundCase>(&data)) return Primitives(*bound->topology).size();
  return 0;
}

TestCase shrink(const TestCase& test, const std::function<bool(const TestCase&)>& fails, const ShrinkOptions& options) {
  return Shrinker(test, fails, options).run();
}

TestCase shrink_failure(const TestCase& test, const std::string& message, const Contestant& contestant,
                        const Authority& authority, const ShrinkOptions& options) {
  const std::string kind = kind_of(message);
  const auto fails = [&](const TestCase& candidate) {
    for (const StageReport& report : judge_cases({&candidate, 1}, contestant, authority))
      for (const Mismatch& mismatch : report.tally.mismatches)
        if (kind_of(mismatch.message) == kind) return true;
    return false;
  };
  return shrink(test, fails, options);
}

}  // namespace ogc::compare
