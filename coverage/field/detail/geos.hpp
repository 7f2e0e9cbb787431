#pragma once

#include <vector>

#include "coverage/field/polygon.hpp"
#include "planner/base/result.hpp"

/// What of GEOS the field library uses, as values. GEOS' own types stay in geos.cpp.
namespace swallowtail::coverage::detail {

/// Errors (kBadInput): GEOS' reason why the polygon is not valid, and where.
Status check_validity(const Polygon& polygon);

/// The connected parts of the polygon within the box; parts of no area are left out. Errors (kInternal): GEOS
/// failed.
Result<std::vector<Polygon>> clip(const Polygon& polygon, const Box& box);

/// A polygon that is clipped many times: converted once.
class Clipper {
 public:
  explicit Clipper(const Polygon& polygon);
  ~Clipper();
  Clipper(const Clipper&) = delete;
  Clipper& operator=(const Clipper&) = delete;
  Result<std::vector<Polygon>> clip(const Box& box) const;

 private:
  struct Impl;
  Impl* impl_;
};

struct UnionArea {
  double inside_m2 = 0.0;   ///< of the union of the patches within the polygon
  double outside_m2 = 0.0;  ///< of the rest of the union
};
/// Errors (kInternal): GEOS failed.
Result<UnionArea> union_area(const Polygon& polygon, const std::vector<Ring>& patches);

}  // namespace swallowtail::coverage::detail
