// Groups contacts that share a grey boundary into one decision: which of them stands, and whether none may stand.
#pragma once

#include <map>
#include <utility>
#include <vector>

namespace ogc::reference {

/// Doubtful contacts, named by keys, joined into groups by the boundaries that they share.
template <class Key>
class GreyGroups {
 public:
  /// Adds a doubtful contact. `absence`: on the other side of one of its boundaries no doubtful contact replaces it.
  void add(const Key& key, bool absence) {
    Entry& entry = entries_.try_emplace(key, Entry{key}).first->second;
    entry.absence = entry.absence || absence;
  }

  /// Joins two contacts one of which ends where the other begins; both must have been added when groups() is called.
  void join(const Key& a, const Key& b) { joins_.emplace_back(a, b); }

  /// Returns whether no contact is doubtful.
  bool empty() const { return entries_.empty(); }
  /// Returns whether this contact is doubtful.
  bool contains(const Key& key) const { return entries_.contains(key); }

  /// The contacts of one decision.
  struct Group {
    std::vector<Key> keys;  ///< any one of them is accepted
    bool absence = false;   ///< whether none of them is accepted, too
  };

  /// Returns the groups by their smallest key, keys ascending. Where a contact is joined to one that is not doubtful,
  /// its absence is accepted.
  std::vector<Group> groups() {
    for (const auto& [a, b] : joins_) unite(a, b);
    std::map<Key, Group> by_root;
    for (const auto& [key, entry] : entries_) {
      Group& group = by_root[root(key)];
      group.keys.push_back(key);
      group.absence = group.absence || entry.absence;
    }
    std::vector<Group> result;
    for (auto& [key, group] : by_root) result.push_back(std::move(group));
    return result;
  }

 private:
  struct Entry {
    Key parent;
    bool absence = false;
  };

  Key root(Key key) const {
    while (entries_.at(key).parent != key) key = entries_.at(key).parent;
    return key;
  }

  /// Makes the smaller root the parent, so that the groups do not depend on the order of the joins.
  void unite(const Key& a, const Key& b) {
    if (!contains(a) && !contains(b)) return;
    if (!contains(b)) return add(a, true);
    if (!contains(a)) return add(b, true);
    const Key first = root(a), second = root(b);
    if (first < second) entries_.at(second).parent = first;
    if (second < first) entries_.at(first).parent = second;
  }

  std::map<Key, Entry> entries_;
  std::vector<std::pair<Key, Key>> joins_;
};

}  // namespace ogc::reference
