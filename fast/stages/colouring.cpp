// This host code has its own file, compiled by g++ alone. nvcc lays out the captures of a lambda in another order than
// g++. If both compile an inline function, the linker keeps one copy. So an inline function with a capturing lambda
// must not be in a header that both compile.
#include "fast/stages/colouring.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <queue>
#include <utility>

namespace ogc::fast {

namespace {

// Returns the rows, each ascending and without repetition.
compare::CompressedRows sorted_rows(std::vector<std::vector<int>> neighbours) {
  compare::CompressedRows rows;
  for (auto& row : neighbours) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    rows.items.insert(rows.items.end(), row.begin(), row.end());
    rows.offsets.push_back(static_cast<compare::Index>(rows.items.size()));
  }
  return rows;
}

}  // namespace

compare::CompressedRows conflict_graph(const RestState& rest) {
  std::vector<std::vector<int>> neighbours(rest.mobility.size());
  const auto connect = [&](const int* vertices, int n) {
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) {
        const auto va = static_cast<std::size_t>(vertices[a]), vb = static_cast<std::size_t>(vertices[b]);
        if (a != b && rest.mobility[va] == Mobility::free && rest.mobility[vb] == Mobility::free)
          neighbours[va].push_back(vertices[b]);
      }
    }
  };
  Kinds::for_each([&]<class Kind>(Kind) {
    for (const auto& element : at_rest<Kind>(rest).elements()) connect(Kind::vertices(element), Kind::count(element));
  });
  return sorted_rows(std::move(neighbours));
}

namespace {

constexpr int uncoloured = -1;

// Returns the smallest colour that no neighbour has.
int smallest_free_colour(const compare::CompressedRows& graph, const std::vector<int>& colour, std::size_t v,
                         std::vector<int>& seen, int stamp) {
  for (const int u : graph[v]) {
    const int c = colour[static_cast<std::size_t>(u)];
    if (c == uncoloured) continue;
    if (c >= static_cast<int>(seen.size())) seen.resize(static_cast<std::size_t>(c) + 1, -1);
    seen[static_cast<std::size_t>(c)] = stamp;
  }
  int c = 0;
  while (c < static_cast<int>(seen.size()) && seen[static_cast<std::size_t>(c)] == stamp) ++c;
  return c;
}

// Colours greedily in the given order. Returns the number of colours.
int colour_in_order(const compare::CompressedRows& graph, const std::vector<int>& order, std::vector<int>& colour) {
  std::fill(colour.begin(), colour.end(), uncoloured);
  std::vector<int> seen;
  int count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto v = static_cast<std::size_t>(order[i]);
    colour[v] = smallest_free_colour(graph, colour, v, seen, static_cast<int>(i));
    count = std::max(count, colour[v] + 1);
  }
  return count;
}

// Colours by DSATUR and returns the order in which it coloured. The next vertex is the one with most colours among its
// neighbours, then with most neighbours, then with the lowest number.
std::vector<int> saturation_order(const compare::CompressedRows& graph, const std::vector<int>& vertices,
                                  std::vector<int>& colour) {
  using Entry = std::array<int, 3>;
  std::vector<std::uint64_t> shown(colour.size(), 0);
  std::priority_queue<Entry> queue;
  for (const int v : vertices) queue.push({0, static_cast<int>(graph[static_cast<std::size_t>(v)].size()), -v});
  std::fill(colour.begin(), colour.end(), uncoloured);
  std::vector<int> order, seen;
  while (!queue.empty()) {
    const auto [saturation, degree, minus_v] = queue.top();
    queue.pop();
    const auto v = static_cast<std::size_t>(-minus_v);
    if (colour[v] != uncoloured || saturation != __builtin_popcountll(shown[v])) continue;
    colour[v] = smallest_free_colour(graph, colour, v, seen, static_cast<int>(order.size()));
    order.push_back(static_cast<int>(v));
    for (const int u : graph[v]) {
      const auto n = static_cast<std::size_t>(u);
      const std::uint64_t bit = std::uint64_t{1} << std::min(colour[v], 63);
      if (colour[n] != uncoloured || (shown[n] & bit) != 0) continue;
      shown[n] |= bit;
      queue.push({__builtin_popcountll(shown[n]), static_cast<int>(graph[n].size()), -u});
    }
  }
  return order;
}

// Returns the vertices class by class. Classes are in reverse order on even passes, and smallest first on odd ones. A
// greedy colouring in this order never needs more colours.
std::vector<int> order_by_class(const std::vector<int>& vertices, const std::vector<int>& colour, int count, int pass) {
  std::vector<int> size(static_cast<std::size_t>(count)), rank(size.size());
  for (const int v : vertices) ++size[static_cast<std::size_t>(colour[static_cast<std::size_t>(v)])];
  std::iota(rank.begin(), rank.end(), 0);
  if (pass % 2 == 0) {
    std::reverse(rank.begin(), rank.end());
  } else {
    std::stable_sort(rank.begin(), rank.end(), [&](int a, int b) {
      return size[static_cast<std::size_t>(a)] > size[static_cast<std::size_t>(b)];
    });
  }
  std::vector<int> place(rank.size());
  for (std::size_t i = 0; i < rank.size(); ++i) place[static_cast<std::size_t>(rank[i])] = static_cast<int>(i);
  std::vector<int> order = vertices;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return place[static_cast<std::size_t>(colour[static_cast<std::size_t>(a)])] <
           place[static_cast<std::size_t>(colour[static_cast<std::size_t>(b)])];
  });
  return order;
}

// Returns a colour, neither `own` nor `banned`, that no neighbour of v has; −1 if there is none.
int other_colour(const compare::CompressedRows& graph, const std::vector<int>& colour, int v, int count, int own,
                 int banned) {
  std::uint64_t taken = 0;
  for (const int u : graph[static_cast<std::size_t>(v)])
    taken |= std::uint64_t{1} << std::min(colour[static_cast<std::size_t>(u)], 63);
  for (int c = 0; c < std::min(count, 63); ++c) {
    if (c != own && c != banned && (taken >> c & 1) == 0) return c;
  }
  return -1;
}

// Gives v the colour c if each neighbour with colour c can change to another colour. Otherwise leaves all colours as
// they were.
bool eject(const compare::CompressedRows& graph, std::vector<int>& colour, int v, int c, int count, int banned) {
  std::vector<int> moved;
  for (const int u : graph[static_cast<std::size_t>(v)]) {
    if (colour[static_cast<std::size_t>(u)] != c) continue;
    const int other = other_colour(graph, colour, u, count, c, banned);
    if (other < 0) {
      for (const int m : moved) colour[static_cast<std::size_t>(m)] = c;
      return false;
    }
    colour[static_cast<std::size_t>(u)] = other;
    moved.push_back(u);
  }
  colour[static_cast<std::size_t>(v)] = c;
  return true;
}

// Gives each vertex of the last class another colour, if at most its direct neighbours must change theirs, too. Returns
// whether the last class is empty now; false if it is the only class.
bool dissolve_last_class(const compare::CompressedRows& graph, const std::vector<int>& vertices, int count,
                         std::vector<int>& colour) {
  const int last = count - 1;
  bool empty = !vertices.empty();
  for (const int v : vertices) {
    int& own = colour[static_cast<std::size_t>(v)];
    if (own != last) continue;
    for (int c = 0; c < last && own == last; ++c) eject(graph, colour, v, c, count, last);
    empty = empty && own != last;
  }
  return empty;
}

// Moves vertices to smaller colour classes. A vertex changes only to a class that contains none of its neighbours and
// has at least two vertices fewer than the vertex's present class.
void balance(const compare::CompressedRows& graph, const std::vector<int>& vertices, int count,
             std::vector<int>& colour) {
  std::vector<int> size(static_cast<std::size_t>(count));
  for (const int v : vertices) ++size[static_cast<std::size_t>(colour[static_cast<std::size_t>(v)])];
  std::vector<int> taken(size.size(), -1);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto v = static_cast<std::size_t>(vertices[i]);
    for (const int u : graph[v])
      taken[static_cast<std::size_t>(colour[static_cast<std::size_t>(u)])] = static_cast<int>(i);
    int best = colour[v];
    for (int c = 0; c < count; ++c) {
      const auto k = static_cast<std::size_t>(c);
      if (taken[k] != static_cast<int>(i) && size[k] + (c == colour[v] ? 0 : 1) < size[static_cast<std::size_t>(best)])
        best = c;
    }
    --size[static_cast<std::size_t>(colour[v])];
    colour[v] = best;
    ++size[static_cast<std::size_t>(best)];
  }
}

// Colours greedily in `order`, then improves the colouring. Each pass colours class by class and tries to empty the
// last class, which a greedy colouring leaves smallest.
int improve(const compare::CompressedRows& graph, std::vector<int> order, int passes, std::vector<int>& colour) {
  int count = colour_in_order(graph, order, colour);
  for (int pass = 0; pass < passes; ++pass) {
    order = order_by_class(order, colour, count, pass);
    count = colour_in_order(graph, order, colour);
    while (dissolve_last_class(graph, order, count, colour)) --count;
  }
  return count;
}

// Returns the connected components of the graph in the order of their lowest vertices. The vertices of each component
// ascend.
std::vector<std::vector<int>> components(const compare::CompressedRows& graph, const std::vector<int>& vertices,
                                         std::size_t vertex_count) {
  std::vector<std::uint8_t> reached(vertex_count, 0);
  std::vector<std::vector<int>> found;
  for (const int first : vertices) {
    if (std::exchange(reached[static_cast<std::size_t>(first)], std::uint8_t{1}) != 0) continue;
    std::vector<int>& members = found.emplace_back(1, first);
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (const int u : graph[static_cast<std::size_t>(members[i])]) {
        if (std::exchange(reached[static_cast<std::size_t>(u)], std::uint8_t{1}) == 0) members.push_back(u);
      }
    }
    std::sort(members.begin(), members.end());
  }
  return found;
}

// Balances the colour classes of each component alone, so that equal components keep equal colours. Then adds k to the
// colours of the k-th component, modulo `count`. Otherwise facing vertices of identical cloths would move at once, each
// by the whole overlap of their contact (method.md §7.3).
void balance_and_turn(const compare::CompressedRows& graph, const std::vector<int>& vertices, int count,
                      std::vector<int>& colour) {
  int turn = 0;
  for (const std::vector<int>& members : components(graph, vertices, colour.size())) {
    for (int pass = 0; pass < 2; ++pass) balance(graph, members, count, colour);
    for (const int v : members) {
      int& own = colour[static_cast<std::size_t>(v)];
      own = (own + turn) % count;
    }
    turn = (turn + 1) % count;
  }
}

}  // namespace

int colouring_passes(std::size_t neighbours) {
  constexpr double visits = 2e7;
  return static_cast<int>(std::clamp(visits / (1.0 + static_cast<double>(neighbours)), 4.0, 100.0));
}

namespace {

// Colours `members`. The rows of the graph must contain members only.
Colouring coloured(const compare::CompressedRows& graph, const std::vector<int>& members) {
  const int passes = colouring_passes(graph.items.size());
  Colouring result;
  std::vector<int> colour(graph.rows(), uncoloured);
  for (const std::vector<int>& order : {members, saturation_order(graph, members, colour)}) {
    const int count = improve(graph, order, passes, colour);
    if (!result.colour.empty() && count >= result.count) continue;
    result.colour = colour;
    result.count = count;
  }
  balance_and_turn(graph, members, result.count, result.colour);
  result.order = members;
  std::stable_sort(result.order.begin(), result.order.end(), [&](int a, int b) {
    return result.colour[static_cast<std::size_t>(a)] < result.colour[static_cast<std::size_t>(b)];
  });
  for (int c = 0; c < result.count; ++c) {
    const auto above = [&](int v) { return result.colour[static_cast<std::size_t>(v)] > c; };
    result.begin.push_back(
        static_cast<int>(std::find_if(result.order.begin(), result.order.end(), above) - result.order.begin()));
  }
  return result;
}

}  // namespace

Colouring colour_vertices(const RestState& rest) {
  std::vector<int> vertices;
  for (std::size_t v = 0; v < rest.mobility.size(); ++v) {
    if (rest.mobility[v] == Mobility::free) vertices.push_back(static_cast<int>(v));
  }
  return coloured(conflict_graph(rest), vertices);
}

Colouring colour_segments(const RodsAtRest& rods) {
  std::vector<std::vector<int>> neighbours(rods.segments.size());
  std::vector<int> segments;
  const auto is_free = [&](int e) { return rods.motion[static_cast<std::size_t>(e)] == segment_free; };
  for (int e = 0; e < static_cast<int>(rods.segments.size()); ++e) {
    if (!is_free(e)) continue;
    segments.push_back(e);
    for (const int f : rods.neighbours[static_cast<std::size_t>(e)].number)
      if (f != e && is_free(f)) neighbours[static_cast<std::size_t>(e)].push_back(f);
  }
  return coloured(sorted_rows(std::move(neighbours)), segments);
}

std::vector<int> row_places_of(const Colouring& colouring) {
  std::vector<int> places(colouring.colour.size());
  int next = 0;
  for (const int v : colouring.order) places[static_cast<std::size_t>(v)] = next++;
  for (std::size_t v = 0; v < places.size(); ++v)
    if (colouring.colour[v] < 0) places[v] = next++;
  return places;
}

}  // namespace ogc::fast
