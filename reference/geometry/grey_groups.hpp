// Joins contacts into one decision if rounding may replace one of them by another. Also finds whether an answer that
// lists no contact of a decision is accepted.
#pragma once

#include <map>
#include <utility>
#include <vector>

namespace ogc::reference {

/// Groups doubtful contacts that share a boundary. A key names a contact.
template <class Key>
class GreyGroups {
 public:
  /// Adds a doubtful contact. `absence`: whether rounding can remove the contact and put no other contact in its place.
  void add(const Key& key, bool absence) {
    Entry& entry = entries_.try_emplace(key, Entry{key}).first->second;
    entry.absence = entry.absence || absence;
  }

  /// Joins two contacts whose blocks share a grey boundary: rounding may replace one by the other. All doubtful
  /// contacts must have been added before groups() is called.
  void join(const Key& a, const Key& b) { joins_.emplace_back(a, b); }

  /// Returns whether no contact is doubtful.
  bool empty() const { return entries_.empty(); }
  /// Returns whether this contact is doubtful.
  bool contains(const Key& key) const { return entries_.contains(key); }

  /// The contacts of one decision.
  struct Group {
    std::vector<Key> keys;  ///< any one of them is accepted
    bool absence = false;   ///< whether an answer without any of them is accepted, too
  };

  /// Returns the groups in the order of their smallest keys; keys ascend. If rounding may replace a doubtful contact by
  /// a certain one, an answer without the doubtful contact is accepted.
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
