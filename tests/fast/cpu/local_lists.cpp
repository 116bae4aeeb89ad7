#include "fast/cpu/local_lists.hpp"

#include <algorithm>
#include <vector>

#include "fast/cpu/backend.hpp"
#include "fast/stages/lists.hpp"
#include "fast/stages/surface.hpp"
#include "tests/catch.hpp"
#include "tests/fast/meshes.hpp"

using namespace ogc;
using namespace ogc::fast;

TEST_CASE(
    "a list of one thread moves to the common one in order, and what finds no room there is counted and handed back",
    "[unit]") {
  std::vector<int> common(5, -1), left;
  int count = 3;
  LocalList<int, 4> list;
  for (int k = 0; k < 4; ++k) list.items()[(*list.count())++] = 10 + k;
  CHECK(!list.has_room_for(1));
  list.flush(common.data(), 5, &count, [&](int item) { left.push_back(item); });
  CHECK(common == std::vector<int>{-1, -1, -1, 10, 11});
  CHECK(left == std::vector<int>{12, 13});
  CHECK(count == 7);
  CHECK(list.has_room_for(4));
  list.flush(common.data(), 5, &count, [](int) { FAIL("an empty list has nothing to move"); });
  CHECK(count == 7);
}

TEST_CASE("pairs that a thread notes reach the common list, however many they are", "[property]") {
  constexpr int pairs = 5000;
  for (const int capacity : {pairs, 700, 0}) {
    std::vector<NotedPair> noted(pairs, {-7, -7});
    int count = 0;
    ListsView common;
    common.noted = noted.data(), common.noted_capacity = capacity, common.noted_count = &count;
    {
      LocalNotes notes(common);
      const ListsView local = notes.view();
      for (int k = 0; k < pairs; ++k) {
        notes.expect(1);
        local.note({k, k + 1}, k % 2 == 0);
      }
    }
    CHECK(count == pairs);
    int wrong = 0;
    for (int k = 0; k < pairs; ++k) {
      const NotedPair& pair = noted[static_cast<std::size_t>(k)];
      const int second = k % 2 == 0 ? ~(k + 1) : k + 1;
      wrong += k < capacity ? pair.first != k || pair.second != second : pair.first != -7;
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("contacts that find no room are counted, but not for their buckets and vertices", "[unit]") {
  constexpr int room = 50;
  tests::TestMesh mesh;
  for (const float height : {0.0F, 0.1F}) mesh.add(tests::sheet(9, 1.0F, height));
  const compare::Topology topology = mesh.topology();
  std::vector<PaddedVec> padded;
  for (const compare::Vec3f& x : mesh.positions) padded.emplace_back(Vec{x.x, x.y, x.z});
  CpuBackend backend;
  Surface<CpuBackend> surface(topology, {});
  const SurfaceView view = surface.view();
  Lists<CpuBackend> all(view, room);
  const ListsView lists = all.view();
  for (int t = 0; t < view.triangle_count; ++t) {
    const int* corner = view.facets[t].corner;
    for (int v = 0; v < view.vertex_count; ++v) {
      if (std::count(corner, corner + 3, v) == 0) lists.note({~v, t}, false);
    }
  }
  REQUIRE(*lists.noted_count <= lists.noted_capacity);
  backend.for_each_counted(lists.noted_count, lists.noted_capacity,
                           CollectContacts{{view, {padded.data()}, 0.3F}, {view, {padded.data()}, 0.3F}, lists});
  CHECK(*lists.contact_count == static_cast<int>(lists.slot_mask) + 1);  // all slots are taken
  CHECK(*lists.without_slot > room);
  std::vector<int> records(static_cast<std::size_t>(lists.buckets)),
      incidences(static_cast<std::size_t>(lists.rows.count()));
  for (int i = 0; i < room; ++i) {
    const EnteredContact& contact = lists.entered[i];
    ++records[static_cast<std::size_t>(contact.bucket)];
    for (const int v : ContactFaces{view}.vertices(contact.bucket, contact.second).role) {
      if (v >= 0) ++incidences[static_cast<std::size_t>(lists.rows(v, contact.bucket >= view.vertex_count))];
    }
  }
  CHECK(std::equal(records.begin(), records.end(), lists.record_counts));
  CHECK(std::equal(incidences.begin(), incidences.end(), lists.incidence_counts));
}
