#include "compare/judge/report/svg.hpp"

#include <cstdio>

namespace ogc::compare {

namespace {

/// Prints a length in pixels with two decimals.
std::string pixels(double x) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.2f", x);
  return buffer;
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

Svg::Svg(double width, double height)
    : text_("<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", pixels(width)) +
            attribute("height", pixels(height)) + attribute("viewBox", "0 0 " + pixels(width) + " " + pixels(height)) +
            ">\n") {}

void Svg::title(const std::string& text) { text_ += "<title>" + escaped(text) + "</title>\n"; }

void Svg::polygon(const std::vector<At>& corners, const char* style) {
  std::string points;
  for (const At& p : corners) points += (points.empty() ? "" : " ") + pixels(p[0]) + "," + pixels(p[1]);
  text_ += "<polygon" + attribute("points", points) + attribute("style", style) + "/>\n";
}

void Svg::line(At from, At to, const char* style) {
  text_ += "<line" + attribute("x1", pixels(from[0])) + attribute("y1", pixels(from[1])) +
           attribute("x2", pixels(to[0])) + attribute("y2", pixels(to[1])) + attribute("style", style) + "/>\n";
}

void Svg::circle(At centre, double radius, const char* style) {
  text_ += "<circle" + attribute("cx", pixels(centre[0])) + attribute("cy", pixels(centre[1])) +
           attribute("r", pixels(radius)) + attribute("style", style) + "/>\n";
}

void Svg::rectangle(At corner, double width, double height, const char* style) {
  text_ += "<rect" + attribute("x", pixels(corner[0])) + attribute("y", pixels(corner[1])) +
           attribute("width", pixels(width)) + attribute("height", pixels(height)) + attribute("style", style) + "/>\n";
}

void Svg::text(At at, const std::string& words, const char* style) {
  text_ += "<text" + attribute("x", pixels(at[0])) + attribute("y", pixels(at[1])) + attribute("style", style) + ">" +
           escaped(words) + "</text>\n";
}

}  // namespace ogc::compare
