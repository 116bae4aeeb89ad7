// The little of SVG that pictures of cases and the page of a report need. It escapes text.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace ogc::compare {

/// & < > " as entities.
std::string escaped(const std::string& text);

/// A picture under construction; y downwards, lengths in pixels, `style` as in CSS.
class Svg {
 public:
  using At = std::array<double, 2>;
  Svg(double width, double height);
  /// Elements, one after another; `style` is CSS, lengths are pixels.
  void title(const std::string& text);
  void polygon(const std::vector<At>& corners, const char* style);
  void line(At from, At to, const char* style);
  void circle(At centre, double radius, const char* style);
  void rectangle(At corner, double width, double height, const char* style);
  void text(At at, const std::string& words, const char* style);
  /// The whole, to stand in a file of its own or in a page.
  std::string finish() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

}  // namespace ogc::compare
