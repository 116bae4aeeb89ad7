#include "compare/judge/engine/shrink.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>

#include "compare/judge/cases/legal.hpp"
#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/judge.hpp"

namespace ogc::compare {

namespace {

/// Returns x rounded to nearest with this number of binary digits.
float with_digits(float x, int digits) {
  int exponent = 0;
  const double fraction = std::frexp(double{x}, &exponent);
  return static_cast<float>(std::ldexp(std::nearbyint(std::ldexp(fraction, digits)), exponent - digits));
}

constexpr std::array digit_counts{1, 2, 3, 5, 8, 12, 16, 20};

class Shrinker {
 public:
  Shrinker(const TestCase& test, const std::function<bool(const TestCase&)>& fails, const ShrinkOptions& options)
      : traits_(traits_of(test.name.stage)),
        best_(test),
        fails_(fails),
        options_(options),
        was_legal_(problem_of(test).empty()) {}

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

  /// Keeps the candidate if it still fails.
  bool attempt(const CaseData& data) {
    if (out_of_budget()) return false;
    ++tries_;
    TestCase candidate{best_.name, data};
    if ((was_legal_ && !problem_of(candidate).empty()) || !fails_(candidate)) return false;
    best_ = std::move(candidate);
    return true;
  }

  /// Drops chunks of primitives: first halves of the list, then ever smaller chunks, at last single primitives. Returns
  /// whether any primitive was dropped and budget is left.
  bool drop_primitives() {
    const Topology* mesh = traits_.mesh(best_.data);
    if (mesh == nullptr) return false;
    Primitives primitives(*mesh);
    const std::size_t before = primitives.size();
    for (std::size_t chunk = (before + 1) / 2; chunk > 0; chunk /= 2) {
      for (std::size_t first = 0; first < primitives.size() && primitives.size() > 1;) {
        const Primitives kept = primitives.without(first, first + chunk);
        if (kept.size() > 0 && attempt(traits_.part(best_.data, MeshPart(*traits_.mesh(best_.data), kept))))
          primitives = Primitives(*traits_.mesh(best_.data));
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
      const std::size_t count = (is_length ? traits_.numbers(data).lengths : traits_.numbers(data).coordinates).size();
      for (std::size_t i = 0; i < count; ++i) simplify(i, is_length);
    }
  }

  /// Moves the first point to the origin. Differences are rounded, so the failure may disappear.
  void move_to_origin() {
    CaseData data = best_.data;
    const ShortenedNumbers numbers = traits_.numbers(data);
    if (numbers.coordinates.empty()) return;
    const std::array<float, 3> origin{*numbers.coordinates[0], *numbers.coordinates[1], *numbers.coordinates[2]};
    for (std::size_t i = 0; i < numbers.coordinates.size(); ++i) *numbers.coordinates[i] -= origin[i % 3];
    attempt(data);
  }

  void simplify(std::size_t i, bool is_length) {
    const auto set = [&](float x) {
      CaseData data = best_.data;
      *(is_length ? traits_.numbers(data).lengths : traits_.numbers(data).coordinates)[i] = x;
      return attempt(data);
    };
    CaseData data = best_.data;
    const float x = *(is_length ? traits_.numbers(data).lengths : traits_.numbers(data).coordinates)[i];
    if (x == 0 || !std::isfinite(x)) return;
    if (!is_length && set(0)) return;
    for (const int digits : digit_counts) {
      const float simple = with_digits(x, digits);
      if (simple == x || set(simple)) return;
    }
  }

  const StageTraits& traits_;
  TestCase best_;
  const std::function<bool(const TestCase&)>& fails_;
  const ShrinkOptions& options_;
  bool was_legal_;  ///< A saved case of another version may be illegal; then illegal candidates are tried, too.
  std::size_t tries_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Returns the kind of a mismatch: its text before the colon without numbers, and whether something is missing or
/// excessive.
std::string kind_of(const std::string& message) {
  std::string kind;
  for (const char c : message.substr(0, message.find(':')))
    if (c < '0' || c > '9') kind += c;
  for (const char* word : {" is missing", " is no contact", " is above"})
    if (message.find(word) != std::string::npos) kind += word;
  return kind;
}

}  // namespace

Primitives::Primitives(const Topology& topology) : triangles(topology.triangles) {
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    if (topology.edge_triangles[e].empty()) loose_edges.push_back(topology.edges[e]);
}

Primitives Primitives::without(std::size_t first, std::size_t last) const {
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

MeshPart::MeshPart(const Topology& whole, const Primitives& kept) {
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

CompressedRows MeshPart::partners(const CompressedRows& of_whole) const {
  std::vector<std::array<Index, 2>> pairs;
  // Vertices are in ascending order.
  const auto number = [&](Index v) {
    const auto found = std::lower_bound(vertices.begin(), vertices.end(), v);
    return found != vertices.end() && *found == v ? static_cast<Index>(found - vertices.begin()) : -1;
  };
  for (const auto& [a, b] : pairs_of(of_whole))
    if (number(a) >= 0 && number(b) >= 0) pairs.push_back({number(a), number(b)});
  return partner_rows(vertices.size(), pairs);
}

std::size_t primitive_count(const TestCase& test) {
  const Topology* mesh = traits_of(test.name.stage).mesh(test.data);
  return mesh == nullptr ? 0 : Primitives(*mesh).size();
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
