#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "coverage/field/polygon.hpp"
#include "planner/base/result.hpp"

/// What of GEOS the field library uses, as values. GEOS' own types stay in geos.cpp.
namespace swallowtail::coverage::detail {

/// What GEOS finds wrong with a polygon, and where.
struct Fault {
  std::string what;  ///< in GEOS' words
  Vec2 place_m = Vec2::Zero();
};
/// Nothing when the polygon is valid.
std::optional<Fault> find_fault(const Polygon& polygon);

/// An area of any number of connected parts; immutable, cheap to copy. Operations that GEOS fails on give an
/// area that is not ok(), and so does everything made of it.
class Shape {
 public:
  Shape();  ///< empty
  static Shape of(const Polygon& polygon);
  /// Where an operation puts the corners it makes. Off the grid GEOS now and then loses whole parts, and does
  /// not say so, where slanted edges all but coincide (github.com/locationtech/jts/issues/1000): operations
  /// that are fed such edges belong on it [HOBBY]. On it no part is lost, but corners move by up to kGrid_m,
  /// so that edges that met without a gap may leave slivers that wide.
  enum class Vertices { kAnywhere, kOnGrid };
  static constexpr double kGrid_m = 1e-6;
  /// Their union; a single polygon as it is.
  static Shape of(std::span<const Polygon> polygons, Vertices vertices = Vertices::kAnywhere);
  /// The union of rings without holes.
  static Shape of(std::span<const Ring> rings, Vertices vertices = Vertices::kAnywhere);
  /// A valid area made of a polygon that crosses or touches itself; holes that overlap become one.
  static Shape repaired(const Polygon& polygon);

  bool ok() const { return geometry_ != nullptr; }
  bool is_empty() const;
  double area_m2() const;
  /// Parts of positive area, outlines counter-clockwise or not as GEOS left them.
  std::vector<Polygon> parts() const;

  Shape minus(const Shape& other, Vertices vertices = Vertices::kAnywhere) const;
  Shape within(const Shape& other, Vertices vertices = Vertices::kAnywhere) const;
  Shape within(const Box& box) const;
  Shape joined(const Shape& other) const;
  enum class Corners { kSharp, kRound };
  /// What lies at least so far inside the border; negative: widened. Where the border's corners point into
  /// what is left, sharp ones stay corners (mitred), round ones lie on an arc to 0.2 % of the distance.
  Shape inset(double distance_m, Corners corners = Corners::kSharp) const;

 private:
  struct Geometry;
  explicit Shape(std::shared_ptr<const Geometry> geometry) : geometry_(std::move(geometry)) {}
  std::shared_ptr<const Geometry> geometry_;
};

}  // namespace swallowtail::coverage::detail
