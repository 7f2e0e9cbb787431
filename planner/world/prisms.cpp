#include "planner/world/prisms.hpp"

#include <geos_c.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace swallowtail::planner {
namespace {

using Part = std::vector<Vec2>;

/// GEOS' answers are read before its context ends.
class Geos {
 public:
  Geos() : handle_(GEOS_init_r()) {}
  ~Geos() { GEOS_finish_r(handle_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  struct Free {
    GEOSContextHandle_t handle;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
  };
  using Owned = std::unique_ptr<GEOSGeometry, Free>;
  Owned own(GEOSGeometry* geometry) const { return Owned(geometry, Free{handle_}); }

  Owned polygon(const Area& area) const {
    GEOSGeometry* outline = ring(area.outline);
    std::vector<GEOSGeometry*> holes;
    for (const Part& hole : area.holes) holes.push_back(ring(hole));
    const bool good = outline != nullptr &&
                      std::none_of(holes.begin(), holes.end(), [](const auto* hole) { return !hole; });
    if (good)
      return own(
          GEOSGeom_createPolygon_r(handle_, outline, holes.data(), static_cast<unsigned>(holes.size())));
    holes.push_back(outline);
    for (GEOSGeometry* part : holes) {
      if (part != nullptr) GEOSGeom_destroy_r(handle_, part);
    }
    return own(nullptr);
  }

  bool is_valid(const Owned& geometry) const {
    return geometry != nullptr && GEOSisValid_r(handle_, geometry.get()) == 1;
  }

  /// Counter-clockwise triangles of positive area; none where GEOS fails.
  std::vector<Part> triangles(const Owned& geometry) const {
    std::vector<Part> out;
    const Owned all = own(GEOSConstrainedDelaunayTriangulation_r(handle_, geometry.get()));
    const int count = all ? GEOSGetNumGeometries_r(handle_, all.get()) : 0;
    for (int i = 0; i < count; ++i) {
      const GEOSGeometry* one = GEOSGetGeometryN_r(handle_, all.get(), i);
      const GEOSCoordSequence* corners = GEOSGeom_getCoordSeq_r(handle_, GEOSGetExteriorRing_r(handle_, one));
      Part part(3);
      for (unsigned k = 0; k < 3; ++k) GEOSCoordSeq_getXY_r(handle_, corners, k, &part[k].x(), &part[k].y());
      const Vec2 u = part[1] - part[0];
      const Vec2 v = part[2] - part[0];
      const double twice_area = u.x() * v.y() - u.y() * v.x();
      if (twice_area < 0.0) std::swap(part[1], part[2]);
      if (twice_area != 0.0) out.push_back(std::move(part));
    }
    return out;
  }

 private:
  GEOSGeometry* ring(const Part& corners) const {
    if (corners.size() < 3) return nullptr;
    const auto count = static_cast<unsigned>(corners.size());
    GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(handle_, count + 1, 2);
    for (unsigned i = 0; i <= count; ++i)
      GEOSCoordSeq_setXY_r(handle_, sequence, i, corners[i % count].x(), corners[i % count].y());
    return GEOSGeom_createLinearRing_r(handle_, sequence);
  }

  GEOSContextHandle_t handle_;
};

bool is_left_turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a;
  const Vec2 v = c - b;
  return u.x() * v.y() - u.y() * v.x() >= 0.0;
}

bool is_convex(const Part& part) {
  const std::size_t n = part.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_left_turn(part[i], part[(i + 1) % n], part[(i + 2) % n])) return false;
  }
  return true;
}

/// Both along the edge that leaves `a` at corner i and comes back in `b` at corner j.
Part joined(const Part& a, std::size_t i, const Part& b, std::size_t j) {
  Part out;
  for (std::size_t k = 1; k <= a.size(); ++k) out.push_back(a[(i + k) % a.size()]);
  for (std::size_t k = 2; k < b.size(); ++k) out.push_back(b[(j + k) % b.size()]);
  return out;
}

/// Joins each part with neighbours while that stays convex.
class Joiner {
 public:
  explicit Joiner(std::vector<Part> parts) : parts_(std::move(parts)) {
    for (std::size_t i = 0; i < parts_.size(); ++i) enter(i);
  }

  std::vector<Part> run() && {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      while (!parts_[i].empty() && grow(i)) {
      }
    }
    std::erase_if(parts_, [](const Part& part) { return part.empty(); });
    return std::move(parts_);
  }

 private:
  using Corner = std::pair<double, double>;
  using Edge = std::pair<Corner, Corner>;
  static Corner corner(const Vec2& p) { return {p.x(), p.y()}; }
  static Edge edge(const Part& part, std::size_t i) {
    return {corner(part[i]), corner(part[(i + 1) % part.size()])};
  }

  void enter(std::size_t part) {
    for (std::size_t k = 0; k < parts_[part].size(); ++k) owner_[edge(parts_[part], k)] = {part, k};
  }

  bool grow(std::size_t i) {
    for (std::size_t k = 0; k < parts_[i].size(); ++k) {
      const Edge along = edge(parts_[i], k);
      const auto other = owner_.find({along.second, along.first});
      if (other == owner_.end()) continue;
      const auto [j, m] = other->second;
      if (j == i || parts_[i].size() + parts_[j].size() > kMaxPrismCorners + 2) continue;
      Part both = joined(parts_[i], k, parts_[j], m);
      if (!is_convex(both)) continue;
      owner_.erase(along);
      owner_.erase(other);
      parts_[j].clear();
      parts_[i] = std::move(both);
      enter(i);
      return true;
    }
    return false;
  }

  std::vector<Part> parts_;
  std::map<Edge, std::pair<std::size_t, std::size_t>> owner_;  ///< of each edge: part and corner
};

}  // namespace

Result<std::vector<std::vector<Vec2>>> convex_parts(const Area& area) {
  const Geos geos;
  const Geos::Owned polygon = geos.polygon(area);
  if (!geos.is_valid(polygon))
    return bad_input("The area with " + std::to_string(area.outline.size()) +
                     " corners is not a valid polygon.");
  std::vector<Part> triangles = geos.triangles(polygon);
  if (triangles.empty()) return bad_input("The area cannot be cut into triangles.");
  return Joiner(std::move(triangles)).run();
}

}  // namespace swallowtail::planner
