// Errors that leave the libraries; `ogc` turns them into exit statuses.
#pragma once

#include <stdexcept>
#include <string>

namespace ogc::compare {

/// Reports wrong usage or bad input. The message tells what is wrong, where (file, path or element) and how to correct
/// it. Exit status 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reports that memory, disk space or a device is missing or used up. Exit status 3.
struct ResourceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ogc::compare
