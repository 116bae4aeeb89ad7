// Each decision of the list with a skin at its threshold; that its pairs give the bits of a search is held by
// tests/fast/stages/skin.cpp.
#include "fast/kernels/skin.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

float above(float x) { return std::nextafter(x, infinite); }

/// One detection's choice, with the largest margin 1 and room for 10 pairs.
SkinState chosen(SkinState state, float drift, float extent = 0, float query_radius = 4, int overflow = 0,
                 float largest_margin = 1) {
  state.drift = float_bits(drift), state.extent = float_bits(extent);
  SkinView view;
  view.state = &state, view.largest_margin = largest_margin, view.capacity = 10;
  ChooseSkinMode{view, &query_radius, &overflow}(0);
  return state;
}

/// After a first search at which nothing was known.
SkinState anchored() {
  SkinState state;
  state.has_anchor = 1, state.listed_radius = 4, state.margin = 0.125F, state.searches = 1;
  return state;
}

/// After a list with margin m, which nothing has used.
SkinState listed(float margin = 0.5F) {
  SkinState state = anchored();
  state.mode = SkinMode::list, state.has_list = 1, state.margin = margin, state.count = 7, state.listings = 1;
  return state;
}

}  // namespace

TEST_CASE("skin: the first detection searches, remembers where it was, and chooses the least margin", "[unit]") {
  const SkinState first = chosen({}, 3, 100, 4);
  CHECK(first.mode == SkinMode::search);
  CHECK(first.has_anchor == 1);
  CHECK(first.has_list == 0);
  CHECK(first.searches == 1);
  CHECK(first.listings == 0);
  CHECK(first.listed_radius == 4);
  CHECK(first.count == 0);
  CHECK((first.drift == 0 && first.extent == 0));
}

TEST_CASE(
    "skin: where nothing has moved the next detection lists, with an eighth of the largest margin or what the "
    "coordinates need",
    "[unit]") {
  const SkinState list = chosen(anchored(), 0);
  CHECK(list.mode == SkinMode::list);
  CHECK(list.has_list == 1);
  CHECK(list.listings == 1);
  CHECK(list.searches == 1);
  CHECK(list.margin == 0.125F);
  CHECK(list.count == 0);
  CHECK(chosen(anchored(), 0, 1024).margin == 0.25F);  // X / 4096
  CHECK(chosen(anchored(), 0, 4096).mode == SkinMode::list);
  CHECK(chosen(anchored(), 0, above(4096)).mode == SkinMode::search);
  CHECK(chosen(anchored(), 0, 0, 4, 0, 0).mode == SkinMode::search);  // no margin at all
}

TEST_CASE("skin: the margin is for six detections of this displacement, and no list is made that three could not use",
          "[unit]") {
  CHECK(chosen(anchored(), 0x7p-8F).margin == Approx(6 * 32.0F / 7 * 0x7p-8F));
  CHECK(chosen(anchored(), 0x7p-8F).mode == SkinMode::list);
  CHECK(chosen(anchored(), 0.07F).margin == 1);                // six would take more than the largest
  CHECK(chosen(anchored(), 0.07F).mode == SkinMode::list);     // three: 0.96
  CHECK(chosen(anchored(), 0.074F).mode == SkinMode::search);  // 1.015
  CHECK(chosen(anchored(), 0.074F).has_list == 0);
  CHECK(chosen(anchored(), 0.074F).searches == 2);
}

TEST_CASE(
    "skin: a list is looked at again up to 7/32 of its margin, half a margin more of r_q, its room and its "
    "coordinates, and not beyond",
    "[unit]") {
  const auto mode = [](SkinState state, float drift, float extent = 0, float query_radius = 4) {
    return chosen(state, drift, extent, query_radius).mode;
  };
  const float drift = 0x7p-6F;  // 7/32 of 1/2
  CHECK(mode(listed(), 0) == SkinMode::recheck);
  CHECK(mode(listed(), drift) == SkinMode::recheck);
  CHECK(mode(listed(), above(drift)) != SkinMode::recheck);
  CHECK(mode(listed(), 0, 0, 4.25F) == SkinMode::recheck);
  CHECK(mode(listed(), 0, 0, above(4.25F)) != SkinMode::recheck);
  CHECK(mode(listed(), 0, 2048) == SkinMode::recheck);
  CHECK(mode(listed(), 0, above(2048)) != SkinMode::recheck);
  SkinState full = listed();
  full.count = 10;
  CHECK(mode(full, 0) == SkinMode::recheck);
  full.count = 11;
  CHECK(mode(full, 0) != SkinMode::recheck);
  SkinState none = listed();
  none.has_list = 0;
  CHECK(mode(none, 0) != SkinMode::recheck);
}

TEST_CASE("skin: looking again leaves list and anchor as they are, and bounds today's smallest distances", "[unit]") {
  SkinState before = listed();
  before.rechecks = 5, before.rechecks_of_list = 2, before.patience = 3, before.wait = 1;
  const SkinState now = chosen(before, 0.0625F);
  REQUIRE(now.mode == SkinMode::recheck);
  CHECK(now.bound == 2 * 0.0625F + 0.5F / 16);
  CHECK(now.rechecks == 6);
  CHECK(now.rechecks_of_list == 3);
  CHECK(now.margin == 0.5F);
  CHECK(now.listed_radius == 4);
  CHECK(now.count == 7);
  CHECK((now.patience == 3 && now.wait == 1));
  CHECK((now.searches == 1 && now.listings == 1));
  CHECK((now.drift == 0 && now.extent == 0));
}

TEST_CASE("skin: after lists that nothing used, twice as many searches and one go by without one, 63 at most",
          "[unit]") {
  int patience = 0;
  for (const int next : {1, 3, 7, 15, 31, 63, 63}) {
    SkinState unused = listed();
    unused.patience = patience;
    SkinState now = chosen(unused, 0.0F, 0, 100);  // r_q has grown: no use for the list
    CHECK(now.patience == next);
    CHECK(now.mode == SkinMode::search);
    CHECK(now.wait == next - 1);
    patience = next;
  }
  SkinState used = listed();
  used.patience = 7, used.rechecks_of_list = 1;
  const SkinState again = chosen(used, 0.0F, 0, 100);
  CHECK(again.patience == 0);
  CHECK(again.wait == 0);
  CHECK(again.mode == SkinMode::list);
  CHECK(again.rechecks_of_list == 0);
  CHECK(again.listed_radius == 100);
  SkinState waiting = anchored();
  waiting.wait = 2, waiting.patience = 3;
  for (const SkinMode mode : {SkinMode::search, SkinMode::search, SkinMode::list}) {
    waiting = chosen(waiting, 0);
    CHECK(waiting.mode == mode);
    CHECK(waiting.patience == 3);
  }
  CHECK(waiting.wait == 0);
}

TEST_CASE("skin: the longest list is remembered, for the room of the next", "[unit]") {
  SkinState state = listed();
  state.count = 11, state.most = 9;
  CHECK(chosen(state, 0).most == 11);
  state.most = 20;
  CHECK(chosen(state, 0).most == 20);
  state.has_list = 0, state.most = 9;
  CHECK(chosen(state, 0).most == 9);
}

TEST_CASE("skin: once a list of contacts has overflowed nothing is chosen or measured", "[unit]") {
  const SkinState state = chosen(listed(), 0, 0, 4, 1);
  CHECK(state.mode == SkinMode::list);
  CHECK(state.rechecks == 0);
  SkinState still = listed();
  SkinView view;
  view.state = &still;
  const Vec moved{1, 2, 3};
  Vec anchor{};
  view.anchor = &anchor;
  const int overflow = 1;
  MeasureDrift{view, &moved, &overflow}(0);
  CHECK((still.drift == 0 && still.extent == 0));
}

TEST_CASE(
    "skin: the displacement is rounded up, the largest coordinate is of any axis and sign, and what is no number is "
    "infinite",
    "[unit]") {
  const auto measured = [](const Vec& from, const Vec& to, bool has_anchor) {
    SkinState state;
    state.has_anchor = has_anchor;
    SkinView view;
    view.state = &state;
    Vec anchor = from;
    view.anchor = &anchor;
    const int overflow = 0;
    MeasureDrift{view, &to, &overflow}(0);
    return std::pair(float_from_bits(state.drift), float_from_bits(state.extent));
  };
  CHECK(measured({0, 0, 0}, {3, 4, 0}, true) == std::pair(5.0F, 4.0F));
  CHECK(measured({1, 1, 1}, {1, -2, 1}, true) == std::pair(3.0F, 2.0F));
  CHECK(measured({0, 0, -7}, {0, 0, -7}, true) == std::pair(0.0F, 7.0F));
  CHECK(measured({0, 0, 0}, {-9, 4, 0}, false) == std::pair(0.0F, 9.0F));
  const float root = measured({0, 0, 0}, {1, 1, 0}, true).first;
  CHECK(double{root} >= std::sqrt(2.0));
  CHECK(double{std::nextafter(root, 0.0F)} < std::sqrt(2.0));
  const float none = std::numeric_limits<float>::quiet_NaN();
  CHECK(measured({0, 0, 0}, {none, 0, 0}, true).first == infinite);
  SkinState state;
  state.has_anchor = 1, state.drift = float_bits(6), state.extent = float_bits(2);
  SkinView view;
  view.state = &state;
  Vec anchor{}, to{3, 4, 0};
  view.anchor = &anchor;
  const int overflow = 0;
  MeasureDrift{view, &to, &overflow}(0);
  CHECK(float_from_bits(state.drift) == 6);  // of another vertex
  CHECK(float_from_bits(state.extent) == 4);
}

TEST_CASE("skin: pairs are counted beyond the room and not written there; margins and bounds are of their modes",
          "[unit]") {
  std::vector<NotedPair> pairs(3);
  SkinState state = listed();
  state.count = 0, state.bound = 0.25F;
  SkinView view;
  view.state = &state, view.pairs = pairs.data(), view.capacity = 2;
  for (int k = 1; k <= 3; ++k) view.keep({k, k + 10});
  CHECK(state.count == 3);
  CHECK((pairs[0].first == 1 && pairs[1].second == 12 && pairs[2].second == 0));
  CHECK(view.search_margin() == 0.5F);
  CHECK_FALSE(view.rechecks());
  CHECK(needs_trees(&state));
  state.mode = SkinMode::search;
  CHECK(view.search_margin() == 0);
  CHECK(needs_trees(&state));
  state.mode = SkinMode::recheck;
  CHECK(view.search_margin() == 0);
  CHECK(view.rechecks());
  CHECK_FALSE(needs_trees(&state));
  CHECK(needs_trees(nullptr));
  CHECK(view.bound(1) == 1.25F);
  CHECK(view.bound(std::nextafter(4.0F, 0.0F)) > 4);
  CHECK(view.bound(4) == infinite);  // as far as the search looked
}

TEST_CASE("skin: a search keeps where vertices were, a list also their smallest distances, a second look nothing",
          "[unit]") {
  for (const SkinMode mode : {SkinMode::search, SkinMode::list, SkinMode::recheck}) {
    SkinState state = listed();
    state.mode = mode;
    const std::vector<Vec> positions{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    const std::vector<float> d_min{1, 2, 3};
    std::vector<Vec> anchor(3);
    std::vector<float> vertex(3), edge(3), triangle(3);
    SkinView view;
    view.state = &state, view.anchor = anchor.data(), view.vertex = vertex.data(), view.edge = edge.data(),
    view.triangle = triangle.data();
    SurfaceView surface{};
    surface.vertex_count = 1, surface.edge_count = 2, surface.triangle_count = 2;
    for (int i = 0; i < 3; ++i)
      KeepAnchor{view, surface, positions.data(), d_min.data(), d_min.data(), d_min.data()}(i);
    const bool is_kept = mode != SkinMode::recheck, is_list = mode == SkinMode::list;
    CHECK(anchor[0].x == (is_kept ? 1 : 0));
    CHECK(anchor[1].x == 0);
    CHECK(vertex == (is_list ? std::vector<float>{1, 0, 0} : std::vector<float>(3)));
    CHECK(edge == (is_list ? std::vector<float>{1, 2, 0} : std::vector<float>(3)));
    CHECK(triangle == (is_list ? std::vector<float>{1, 2, 0} : std::vector<float>(3)));
  }
}
