// Errors that leave the libraries; `ogc` turns them into exit statuses.
#pragma once

#include <stdexcept>
#include <string>

namespace ogc::compare {

/// Reports wrong usage or bad input: what, where (file, path or element) and what to do about it. Exit status 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reports memory, disk or a device that ran out or is missing. Exit status 3.
struct ResourceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ogc::compare
