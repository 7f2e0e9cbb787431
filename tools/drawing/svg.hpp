#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swallowtail::report {

using Points = std::vector<std::pair<double, double>>;

/// Text that may stand in XML.
std::string escaped(const std::string& text);

/// A short number: at most `decimals` of them, no trailing zeros.
std::string number(double value, int decimals = 2);

/// A picture that is written from back to front. Coordinates are pixels, y down. `style` is a list of
/// presentation attributes, such as `fill="none" stroke="#222"`.
class Svg {
 public:
  Svg(double width_px, double height_px, const std::string& title);

  void line(double x0, double y0, double x1, double y1, const std::string& style);
  void polyline(const Points& points, const std::string& style);
  /// Closed rings under the even-odd rule.
  void rings(const std::vector<Points>& rings, const std::string& style, const std::string& tooltip = {});
  void circle(double x, double y, double radius, const std::string& style, const std::string& tooltip = {});
  void rect(double x, double y, double width, double height, const std::string& style);
  void text(double x, double y, const std::string& words, const std::string& style = {});

  /// The whole document.
  std::string finish() const;

  double width_px() const { return width_px_; }
  double height_px() const { return height_px_; }

 private:
  double width_px_;
  double height_px_;
  std::string body_;
  std::string title_;
};

}  // namespace swallowtail::report
