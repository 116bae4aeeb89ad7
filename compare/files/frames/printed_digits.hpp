// Finds the precision to which a text file prints its coordinates. Vertices that are nearer to each other than this
// precision may be copies of one point.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace ogc::compare {

/// The digits of a file's coordinates.
struct PrintedDigits {
  int digits = 0;             ///< number of significant digits, or of decimals
  bool are_decimals = false;  ///< "%.6f" prints decimals, "%.9g" significant digits
  double unit = 0;            ///< value of the last digit of the largest coordinate [m]
};

/// Returns the digits of an OBJ, ascii PLY, OFF, ascii STL, VTP, VTU, VTK, Gmsh or Medit file. Returns nothing for
/// binary numbers and for numbers with all digits of a double. Also returns nothing if the numbers have no common
/// number of digits, or fewer than 6 significant digits and fewer than 4 decimals, as typed numbers do. Throws
/// InputError if the file can't be opened.
std::optional<PrintedDigits> printed_digits(const std::filesystem::path& file);

}  // namespace ogc::compare
