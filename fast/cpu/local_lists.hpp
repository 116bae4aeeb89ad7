// Defines lists of one thread. A thread collects items in its own list and moves many at once to the common list.
// Otherwise each item would increase the common counter, and all threads would wait for the counter. Threads would also
// wait for the flags beside the counter in memory, which all threads read.
#pragma once

#include <algorithm>

#include "fast/kernels/collect_contacts.hpp"

namespace ogc::fast {

/// A list of one thread with room for `room` items, used in place of a common list.
template <class Item, int room>
class LocalList {
 public:
  /// Return items and counter. A functor adds to them in place of the common list.
  Item* items() { return items_; }
  int* count() { return &count_; }
  /// Checks whether `more` further items fit. Call it before adding them, because items beyond the room are counted but
  /// not stored.
  bool has_room_for(int more) const { return count_ + more <= room; }

  /// Moves all items to a common list, and adds their number to the common count. Passes items that do not fit to
  /// without_room(item).
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

/// Holds the pairs that one thread's searches note. Pairs without room in the common list are dropped, because their
/// detection has overflowed and is repeated.
class LocalNotes {
 public:
  explicit LocalNotes(const ListsView& common) : common_(common) {}
  LocalNotes(const LocalNotes&) = delete;
  LocalNotes& operator=(const LocalNotes&) = delete;
  ~LocalNotes() { flush(); }

  /// Returns the common lists, with this thread's notes in place of the common notes.
  ListsView view() {
    ListsView lists = common_;
    lists.noted = list_.items(), lists.noted_count = list_.count(), lists.noted_capacity = room;
    return lists;
  }
  /// Makes room for `more` further notes.
  void expect(int more) {
    if (!list_.has_room_for(more)) flush();
  }

 private:
  static constexpr int room = 512;  // 4 KiB

  // Adds nothing to a count that must not wrap around (ListsView::note); the detection has overflowed then.
  void flush() {
    if (atomic_load(common_.noted_count) >= ListRoom::most_counted) *list_.count() = 0;
    list_.flush(common_.noted, common_.noted_capacity, common_.noted_count, [](const NotedPair&) {});
  }

  ListsView common_;
  LocalList<NotedPair, room> list_;
};

/// Runs items begin … end − 1 of a loop in this thread.
template <class F>
void run_range(const F& f, int begin, int end) {
  for (int i = begin; i < end; ++i) f(i);
}

/// Collects contacts, at most one for each pair. If a contact has no room, it is subtracted from the counts of its
/// bucket and its vertices, so that FillBuckets does not look for it.
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
