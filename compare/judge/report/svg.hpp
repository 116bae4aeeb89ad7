// Writes the few elements of SVG that pictures of cases and pages of reports need. Escapes text.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace ogc::compare {

/// Returns the text with & < > " as entities.
std::string escaped(const std::string& text);

/// Builds a picture; y points downwards, lengths are pixels, `style` is CSS.
class Svg {
 public:
  using At = std::array<double, 2>;
  Svg(double width, double height);
  /// Add elements, one after another; `style` is CSS, lengths are pixels.
  void title(const std::string& text);
  void polygon(const std::vector<At>& corners, const char* style);
  void line(At from, At to, const char* style);
  void circle(At centre, double radius, const char* style);
  void rectangle(At corner, double width, double height, const char* style);
  void text(At at, const std::string& words, const char* style);
  /// Returns the whole picture, for a file or for a page.
  std::string finish() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

}  // namespace ogc::compare
