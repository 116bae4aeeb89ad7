// A thread keeps what it finds in a list of its own and moves it to the common one many at a time: all threads would
// wait for one counter that each of them raises for each thing found, and beside it lie flags that all of them read.
#pragma once

#include <algorithm>

#include "fast/kernels/collect_contacts.hpp"

namespace ogc::fast {

/// A list of one thread, with room for so many, that takes the place of a common one.
template <class Item, int room>
class LocalList {
 public:
  /// In place of the common list and its counter, for functors that add to these.
  Item* items() { return items_; }
  int* count() { return &count_; }
  /// Whether so many more fit; asked before they are added, since beyond its room a list only counts.
  bool has_room_for(int more) const { return count_ + more <= room; }

  /// Moves all to a common list, which counts also those that find no room; these are left to without_room(item).
  template <class Without>
  void flush(Item* common, int capacity, int* common_count, Without without_room) {
    if (count_ == 0) return;
    const int first = atomic_add(common_count, count_), fitting = std::clamp(capacity - first, 0, count_);
    std::copy_n(items_, fitting, common + first);
    std::for_each(items_ + fitting, items_ + count_, without_room);
    count_ = 0;
  }

 private:
  Item items_[room];
  int count_ = 0;
};

/// Pairs that the searches of one thread note. Those of a detection without room for all are not used.
class LocalNotes {
 public:
  explicit LocalNotes(const ListsView& common) : common_(common) {}
  LocalNotes(const LocalNotes&) = delete;
  LocalNotes& operator=(const LocalNotes&) = delete;
  ~LocalNotes() { flush(); }

  /// The common lists with this list of notes.
  ListsView view() {
    ListsView lists = common_;
    lists.noted = list_.items(), lists.noted_count = list_.count(), lists.noted_capacity = room;
    return lists;
  }
  /// Before as many more are noted at most.
  void expect(int more) {
    if (!list_.has_room_for(more)) flush();
  }

 private:
  static constexpr int room = 512;  // 4 KiB

  void flush() {
    list_.flush(common_.noted, common_.noted_capacity, common_.noted_count, [](const NotedPair&) {});
  }

  ListsView common_;
  LocalList<NotedPair, room> list_;
};

/// The items of a loop that one thread runs.
template <class F>
void run_range(const F& f, int begin, int end) {
  for (int i = begin; i < end; ++i) f(i);
}

/// Each pair is one contact at most. A contact without room is not counted for its bucket and its vertices, as
/// FillBuckets would look for it there.
inline void run_range(const CollectContacts& f, int begin, int end) {
  constexpr int room = 256;  // 4 KiB
  const ListsView& common = f.lists;
  LocalList<EnteredContact, room> list;
  CollectContacts local = f;
  local.lists.entered = list.items(), local.lists.contact_count = list.count(), local.lists.capacity = room;
  const ContactFaces faces{f.edge_edge.surface};
  for (int first = begin; first < end; first += room) {
    for (int i = first; i < std::min(first + room, end); ++i) local(i);
    list.flush(common.entered, common.capacity, common.contact_count, [&](const EnteredContact& contact) {
      common.count(contact.bucket, faces.vertices(contact.bucket, contact.second), -1);
    });
  }
}

}  // namespace ogc::fast
