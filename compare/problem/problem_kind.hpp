// Keeps the messages of `validate` short: a mesh with a million bad triangles gets ten messages and a count.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compare/problem/validate.hpp"

namespace ogc::compare {

/// Lists the first `limit` problems of one kind; the destructor adds the number of further problems.
class ProblemKind {
 public:
  ProblemKind(std::vector<Problem>& problems, std::size_t limit, std::string what, std::string remedy)
      : problems_(problems), limit_(limit), what_(std::move(what)), remedy_(std::move(remedy)) {}
  ProblemKind(const ProblemKind&) = delete;
  ProblemKind& operator=(const ProblemKind&) = delete;
  ~ProblemKind() {
    if (count_ > limit_) problems_.push_back({std::to_string(count_ - limit_) + " more", what_, remedy_});
  }
  /// Adds one problem, at `where`.
  void add(const std::string& where, const std::string& detail = {}) {
    if (++count_ <= limit_) problems_.push_back({where, detail.empty() ? what_ : what_ + ": " + detail, remedy_});
  }
  std::size_t count() const { return count_; }  ///< number of all problems, listed or not

 private:
  std::vector<Problem>& problems_;
  std::size_t limit_, count_ = 0;
  std::string what_, remedy_;
};

/// Returns "triangle 17".
inline std::string numbered(const std::string& kind, std::size_t i) { return kind + " " + std::to_string(i); }

}  // namespace ogc::compare
