#include "coverage/field/detail/geos.hpp"

#define GEOS_USE_ONLY_R_API
#include <geos_c.h>

#include <string>
#include <utility>

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
using Owned = std::unique_ptr<GEOSGeometry, Destroy>;

constexpr double kMitreLimit = 5.0;
/// Of a quarter turn.
constexpr int kArcPieces = 16;

GEOSGeometry* make_ring(const Ring& ring) {
  const auto size = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context(), size + 1, 2);
  for (unsigned i = 0; i <= size; ++i) {
    const Vec2& p = ring[i % size];
    GEOSCoordSeq_setXY_r(context(), sequence, i, p.x(), p.y());
  }
  return GEOSGeom_createLinearRing_r(context(), sequence);
}

GEOSGeometry* make_polygon(const Polygon& polygon) {
  std::vector<GEOSGeometry*> holes;
  for (const Ring& hole : polygon.holes) {
    if (GEOSGeometry* ring = make_ring(hole)) holes.push_back(ring);
  }
  GEOSGeometry* outline = make_ring(polygon.outline);
  if (outline == nullptr) {
    for (GEOSGeometry* hole : holes) GEOSGeom_destroy_r(context(), hole);
    return nullptr;
  }
  return GEOSGeom_createPolygon_r(context(), outline, holes.data(), static_cast<unsigned>(holes.size()));
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
  const int type = GEOSGeomTypeId_r(context(), geometry);
  if (type == GEOS_POLYGON) {
    if (GEOSisEmpty_r(context(), geometry) != 0) return;
    Polygon polygon;
    polygon.outline = read_ring(GEOSGetExteriorRing_r(context(), geometry));
    const int holes = GEOSGetNumInteriorRings_r(context(), geometry);
    for (int i = 0; i < holes; ++i)
      polygon.holes.push_back(read_ring(GEOSGetInteriorRingN_r(context(), geometry, i)));
    if (polygon.outline.size() >= 3) out.push_back(std::move(polygon));
    return;
  }
  if (type < GEOS_MULTIPOINT) return;  // a point or a line has no area
  const int parts = GEOSGetNumGeometries_r(context(), geometry);
  for (int i = 0; i < parts; ++i) read_polygons(GEOSGetGeometryN_r(context(), geometry, i), out);
}

}  // namespace

struct Shape::Geometry {
  explicit Geometry(GEOSGeometry* g) : owned(g) {}
  const GEOSGeometry* get() const { return owned.get(); }
  Owned owned;

  static Shape wrap(GEOSGeometry* g) {
    return g == nullptr ? Shape(std::shared_ptr<const Geometry>()) : Shape(std::make_shared<Geometry>(g));
  }
  static Shape unite(std::vector<GEOSGeometry*> parts, Vertices vertices) {
    std::erase(parts, nullptr);
    const Owned all(GEOSGeom_createCollection_r(context(), GEOS_GEOMETRYCOLLECTION, parts.data(),
                                                static_cast<unsigned>(parts.size())));
    if (!all) return wrap(nullptr);
    return wrap(vertices == Vertices::kOnGrid ? GEOSUnaryUnionPrec_r(context(), all.get(), kGrid_m)
                                              : GEOSUnaryUnion_r(context(), all.get()));
  }
};

std::optional<Fault> find_fault(const Polygon& polygon) {
  const Owned geometry(make_polygon(polygon));
  if (!geometry) return Fault{"the rings cannot be built", polygon.outline.front()};
  char* reason = nullptr;
  GEOSGeometry* place = nullptr;
  const char valid = GEOSisValidDetail_r(context(), geometry.get(), 0, &reason, &place);
  const Owned owned_place(place);
  Fault out{reason == nullptr ? "" : reason, polygon.outline.front()};
  if (reason != nullptr) GEOSFree_r(context(), reason);
  if (valid == 1) return std::nullopt;
  if (place != nullptr) {
    GEOSGeomGetX_r(context(), place, &out.place_m.x());
    GEOSGeomGetY_r(context(), place, &out.place_m.y());
  }
  return out;
}

Shape::Shape() : Shape(Geometry::wrap(GEOSGeom_createEmptyPolygon_r(context()))) {}

Shape Shape::of(const Polygon& polygon) { return Geometry::wrap(make_polygon(polygon)); }

Shape Shape::of(std::span<const Polygon> polygons, Vertices vertices) {
  if (polygons.size() == 1) return of(polygons.front());
  std::vector<GEOSGeometry*> parts;
  for (const Polygon& polygon : polygons) parts.push_back(make_polygon(polygon));
  return Geometry::unite(std::move(parts), vertices);
}

Shape Shape::of(std::span<const Ring> rings, Vertices vertices) {
  std::vector<GEOSGeometry*> parts;
  for (const Ring& ring : rings) parts.push_back(make_polygon({ring, {}}));
  return Geometry::unite(std::move(parts), vertices);
}

Shape Shape::repaired(const Polygon& polygon) {
  const Owned raw(make_polygon(polygon));
  if (!raw) return Geometry::wrap(nullptr);
  GEOSMakeValidParams* params = GEOSMakeValidParams_create_r(context());
  GEOSMakeValidParams_setMethod_r(context(), params, GEOS_MAKE_VALID_STRUCTURE);
  GEOSMakeValidParams_setKeepCollapsed_r(context(), params, 0);
  GEOSGeometry* valid = GEOSMakeValidWithParams_r(context(), raw.get(), params);
  GEOSMakeValidParams_destroy_r(context(), params);
  return Geometry::wrap(valid);
}

bool Shape::is_empty() const { return !ok() || GEOSisEmpty_r(context(), geometry_->get()) != 0; }

double Shape::area_m2() const {
  double area = 0.0;
  if (ok()) GEOSArea_r(context(), geometry_->get(), &area);
  return area;
}

std::vector<Polygon> Shape::parts() const {
  std::vector<Polygon> out;
  if (ok()) read_polygons(geometry_->get(), out);
  return out;
}

Shape Shape::minus(const Shape& other, Vertices vertices) const {
  if (!ok() || !other.ok()) return Geometry::wrap(nullptr);
  const GEOSGeometry* a = geometry_->get();
  const GEOSGeometry* b = other.geometry_->get();
  return Geometry::wrap(vertices == Vertices::kOnGrid ? GEOSDifferencePrec_r(context(), a, b, kGrid_m)
                                                      : GEOSDifference_r(context(), a, b));
}

Shape Shape::within(const Shape& other, Vertices vertices) const {
  if (!ok() || !other.ok()) return Geometry::wrap(nullptr);
  const GEOSGeometry* a = geometry_->get();
  const GEOSGeometry* b = other.geometry_->get();
  return Geometry::wrap(vertices == Vertices::kOnGrid ? GEOSIntersectionPrec_r(context(), a, b, kGrid_m)
                                                      : GEOSIntersection_r(context(), a, b));
}

Shape Shape::within(const Box& box) const {
  const Owned rectangle(
      GEOSGeom_createRectangle_r(context(), box.lo.x(), box.lo.y(), box.hi.x(), box.hi.y()));
  return Geometry::wrap(ok() && rectangle ? GEOSIntersection_r(context(), geometry_->get(), rectangle.get())
                                          : nullptr);
}

Shape Shape::joined(const Shape& other) const {
  return Geometry::wrap(ok() && other.ok() ? GEOSUnion_r(context(), geometry_->get(), other.geometry_->get())
                                           : nullptr);
}

Shape Shape::inset(double distance_m, Corners corners) const {
  const int join = corners == Corners::kRound ? GEOSBUF_JOIN_ROUND : GEOSBUF_JOIN_MITRE;
  return Geometry::wrap(ok() ? GEOSBufferWithStyle_r(context(), geometry_->get(), -distance_m, kArcPieces,
                                                     GEOSBUF_CAP_FLAT, join, kMitreLimit)
                             : nullptr);
}

}  // namespace swallowtail::coverage::detail
