// The errors that cross the edge of the program; `ogc` turns them into exit statuses.
#pragma once

#include <stdexcept>
#include <string>

namespace ogc::compare {

/// Wrong usage or bad input: what, where (file, path or element) and what to do about it. Exit status 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Memory, disk or device that ran out or is missing. Exit status 3.
struct ResourceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ogc::compare
