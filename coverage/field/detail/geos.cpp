#include "coverage/field/detail/geos.hpp"

#define GEOS_USE_ONLY_R_API
#include <geos_c.h>

#include <algorithm>
#include <memory>
#include <string>

namespace swallowtail::coverage::detail {
namespace {

/// GEOS' context of this thread; its messages are dropped, callers report what failed.
GEOSContextHandle_t context() {
  struct Finish {
    void operator()(GEOSContextHandle_t handle) const { GEOS_finish_r(handle); }
  };
  thread_local const std::unique_ptr<GEOSContextHandle_HS, Finish> handle(GEOS_init_r());
  return handle.get();
}

struct Destroy {
  void operator()(GEOSGeometry* g) const { GEOSGeom_destroy_r(context(), g); }
};
using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

GEOSGeometry* make_ring(const Ring& ring) {
  const auto size = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context(), size + 1, 2);
  for (unsigned i = 0; i <= size; ++i) {
    const Vec2& p = ring[i % size];
    GEOSCoordSeq_setXY_r(context(), sequence, i, p.x(), p.y());
  }
  return GEOSGeom_createLinearRing_r(context(), sequence);
}

Geometry make_polygon(const Polygon& polygon) {
  std::vector<GEOSGeometry*> holes;
  for (const Ring& hole : polygon.holes) holes.push_back(make_ring(hole));
  return Geometry(GEOSGeom_createPolygon_r(context(), make_ring(polygon.outline), holes.data(),
                                           static_cast<unsigned>(holes.size())));
}

Ring read_ring(const GEOSGeometry* ring) {
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context(), ring);
  unsigned size = 0;
  GEOSCoordSeq_getSize_r(context(), sequence, &size);
  Ring out;
  for (unsigned i = 0; i + 1 < size; ++i) {
    double x = 0.0;
    double y = 0.0;
    GEOSCoordSeq_getXY_r(context(), sequence, i, &x, &y);
    out.emplace_back(x, y);
  }
  return out;
}

void read_polygons(const GEOSGeometry* geometry, std::vector<Polygon>& out) {
  if (GEOSGeomTypeId_r(context(), geometry) == GEOS_POLYGON) {
    if (GEOSisEmpty_r(context(), geometry) != 0) return;
    Polygon polygon;
    polygon.outline = read_ring(GEOSGetExteriorRing_r(context(), geometry));
    const int holes = GEOSGetNumInteriorRings_r(context(), geometry);
    for (int i = 0; i < holes; ++i)
      polygon.holes.push_back(read_ring(GEOSGetInteriorRingN_r(context(), geometry, i)));
    if (polygon.outline.size() >= 3) out.push_back(std::move(polygon));
    return;
  }
  if (GEOSGeomTypeId_r(context(), geometry) < GEOS_MULTIPOINT) return;  // a point or a line has no area
  const int parts = GEOSGetNumGeometries_r(context(), geometry);
  for (int i = 0; i < parts; ++i) read_polygons(GEOSGetGeometryN_r(context(), geometry, i), out);
}

Geometry make_box(const Box& box) {
  return Geometry(GEOSGeom_createRectangle_r(context(), box.lo.x(), box.lo.y(), box.hi.x(), box.hi.y()));
}

double area_of(const GEOSGeometry* geometry) {
  double area = 0.0;
  GEOSArea_r(context(), geometry, &area);
  return area;
}

}  // namespace

Status check_validity(const Polygon& polygon) {
  const Geometry geometry = make_polygon(polygon);
  if (!geometry) return bad_input("The polygon cannot be built.");
  char* reason = nullptr;
  GEOSGeometry* place = nullptr;
  const char valid = GEOSisValidDetail_r(context(), geometry.get(), 0, &reason, &place);
  const Geometry owned_place(place);
  std::string text = reason == nullptr ? "" : reason;
  if (reason != nullptr) GEOSFree_r(context(), reason);
  if (valid == 1) return {};
  std::string where;
  double x = 0.0;
  double y = 0.0;
  if (place != nullptr && GEOSGeomGetX_r(context(), place, &x) == 1 &&
      GEOSGeomGetY_r(context(), place, &y) == 1) {
    where = " at (" + std::to_string(x) + ", " + std::to_string(y) + ") m";
  }
  return bad_input("The polygon is not valid: " + text + where + ".");
}

struct Clipper::Impl {
  Geometry geometry;
};

Clipper::Clipper(const Polygon& polygon) : impl_(new Impl{make_polygon(polygon)}) {}
Clipper::~Clipper() { delete impl_; }

Result<std::vector<Polygon>> Clipper::clip(const Box& box) const {
  const Geometry rectangle = make_box(box);
  const Geometry part(impl_->geometry ? GEOSIntersection_r(context(), impl_->geometry.get(), rectangle.get())
                                      : nullptr);
  if (!part) return internal_error("GEOS could not intersect the polygon with a strip.");
  std::vector<Polygon> out;
  read_polygons(part.get(), out);
  return out;
}

Result<std::vector<Polygon>> clip(const Polygon& polygon, const Box& box) {
  return Clipper(polygon).clip(box);
}

Result<UnionArea> union_area(const Polygon& polygon, const std::vector<Ring>& patches) {
  std::vector<GEOSGeometry*> parts;
  for (const Ring& patch : patches) parts.push_back(make_polygon({patch, {}}).release());
  const Geometry all(GEOSGeom_createCollection_r(context(), GEOS_MULTIPOLYGON, parts.data(),
                                                 static_cast<unsigned>(parts.size())));
  const Geometry joined(all ? GEOSUnaryUnion_r(context(), all.get()) : nullptr);
  const Geometry field = make_polygon(polygon);
  const Geometry inside(joined && field ? GEOSIntersection_r(context(), joined.get(), field.get()) : nullptr);
  if (!inside) return internal_error("GEOS could not unite the swaths of a field.");
  UnionArea out;
  out.inside_m2 = area_of(inside.get());
  out.outside_m2 = std::max(0.0, area_of(joined.get()) - out.inside_m2);
  return out;
}

}  // namespace swallowtail::coverage::detail
