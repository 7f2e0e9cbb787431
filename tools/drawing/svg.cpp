#include "tools/drawing/svg.hpp"

#include <charconv>
#include <cmath>

namespace swallowtail::report {
namespace {

std::string coordinates(const Points& points) {
  std::string text;
  for (const auto& [x, y] : points) text += number(x, 1) + "," + number(y, 1) + " ";
  if (!text.empty()) text.pop_back();
  return text;
}

std::string closed(const std::string& element, const std::string& content, const std::string& tooltip) {
  if (tooltip.empty()) return "<" + element + content + "/>\n";
  return "<" + element + content + "><title>" + escaped(tooltip) + "</title></" + element + ">\n";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals).ptr;
  std::string text(buffer, end);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

Svg::Svg(double width_px, double height_px, const std::string& title)
    : width_px_(width_px), height_px_(height_px), title_(title) {}

void Svg::line(double x0, double y0, double x1, double y1, const std::string& style) {
  body_ += "<line x1=\"" + number(x0, 1) + "\" y1=\"" + number(y0, 1) + "\" x2=\"" + number(x1, 1) +
           "\" y2=\"" + number(y1, 1) + "\" " + style + "/>\n";
}

void Svg::polyline(const Points& points, const std::string& style) {
  if (points.size() < 2) return;
  body_ += "<polyline points=\"" + coordinates(points) + "\" fill=\"none\" " + style + "/>\n";
}

void Svg::rings(const std::vector<Points>& rings, const std::string& style, const std::string& tooltip) {
  std::string path;
  for (const auto& ring : rings) {
    if (ring.size() < 3) continue;
    path += "M" + coordinates(ring) + "Z";
  }
  if (path.empty()) return;
  body_ += closed("path", " d=\"" + path + "\" fill-rule=\"evenodd\" " + style, tooltip);
}

void Svg::circle(double x, double y, double radius, const std::string& style, const std::string& tooltip) {
  body_ += closed(
      "circle",
      " cx=\"" + number(x, 1) + "\" cy=\"" + number(y, 1) + "\" r=\"" + number(radius, 1) + "\" " + style,
      tooltip);
}

void Svg::rect(double x, double y, double width, double height, const std::string& style) {
  body_ += "<rect x=\"" + number(x, 1) + "\" y=\"" + number(y, 1) + "\" width=\"" + number(width, 1) +
           "\" height=\"" + number(height, 1) + "\" " + style + "/>\n";
}

void Svg::text(double x, double y, const std::string& words, const std::string& style) {
  body_ += "<text x=\"" + number(x, 1) + "\" y=\"" + number(y, 1) + "\" " + style + ">" + escaped(words) +
           "</text>\n";
}

std::string Svg::finish() const {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width_px_, 0) + " " +
         number(height_px_, 0) +
         "\" font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#1b2733\">\n<title>" +
         escaped(title_) + "</title>\n" + body_ + "</svg>\n";
}

}  // namespace swallowtail::report
