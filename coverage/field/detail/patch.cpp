#include "coverage/field/detail/patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace swallowtail::coverage::detail {
namespace {

constexpr double kRounding_m = 1e-6;
/// Smaller patches are nothing.
constexpr double kNothing_m2 = 1e-5;
constexpr double kSlab_m = 1e-9;

void measure(Patch& patch) {
  Vec2 lo = patch.corners[0];
  Vec2 hi = lo;
  double twice = 0.0;
  for (std::size_t i = 1; i < patch.size; ++i) {
    lo = lo.cwiseMin(patch.corners[i]);
    hi = hi.cwiseMax(patch.corners[i]);
    if (i + 1 < patch.size)
      twice += cross(patch.corners[i] - patch.corners[0], patch.corners[i + 1] - patch.corners[0]);
  }
  patch.middle_m = (lo + hi) / 2.0;
  patch.radius_m = (hi - lo).norm() / 2.0;
  patch.area_m2 = twice / 2.0;
}

/// Rounding may make a patch a little concave, so that a line crosses it more than twice.
void add(const Vec2& corner, Patch& patch) {
  if (patch.size < Patch::kMostCorners) patch.corners[patch.size++] = corner;
}

/// Cuts a patch in two; either may come out empty.
void split(const Patch& patch, const HalfPlane& plane, Patch& inside, Patch& outside) {
  inside.size = 0;
  outside.size = 0;
  double before = plane.normal.dot(patch.corners[patch.size - 1]) - plane.limit;
  for (std::size_t i = 0, j = patch.size - 1; i < patch.size; j = i++) {
    const double here = plane.normal.dot(patch.corners[i]) - plane.limit;
    if ((before > 0.0) != (here > 0.0)) {
      const Vec2 at = patch.corners[j] + (patch.corners[i] - patch.corners[j]) * (before / (before - here));
      add(at, inside);
      add(at, outside);
    }
    add(patch.corners[i], here > 0.0 ? outside : inside);
    before = here;
  }
}

/// Wholly on one side of the plane by its circle: −1 inside, 1 outside, 0 not told.
int side_of(const Patch& patch, const HalfPlane& plane) {
  const double middle = plane.normal.dot(patch.middle_m) - plane.limit;
  if (middle >= patch.radius_m) return 1;
  return middle <= -patch.radius_m ? -1 : 0;
}

/// A patch of so many corners that the four cuts of a band might overflow it is first halved.
bool is_full(const Patch& patch) { return patch.size + 5 >= Patch::kMostCorners; }

std::pair<Patch, Patch> halves(const Patch& patch) {
  Patch a = patch;
  Patch b;
  const std::size_t half = patch.size / 2;
  a.size = half + 1;
  b.corners[b.size++] = patch.corners[0];
  for (std::size_t i = half; i < patch.size; ++i) b.corners[b.size++] = patch.corners[i];
  measure(a);
  measure(b);
  return {a, b};
}

void keep(Patch patch, std::vector<Patch>& out) {
  if (patch.size < 3) return;
  measure(patch);
  if (patch.area_m2 > kNothing_m2) out.push_back(patch);
}

bool is_beyond(const Patch& patch, const HalfPlane& plane) {
  const int side = side_of(patch, plane);
  if (side != 0) return side > 0;
  for (std::size_t i = 0; i < patch.size; ++i) {
    if (plane.normal.dot(patch.corners[i]) < plane.limit) return false;
  }
  return true;
}

bool is_beyond(const Patch& patch, const Planes& planes) {
  return std::any_of(planes.begin(), planes.end(),
                     [&](const HalfPlane& plane) { return is_beyond(patch, plane); });
}

void subtract_one(const Planes& planes, const Patch& patch, std::vector<Patch>& out) {
  if (is_beyond(patch, planes)) {
    out.push_back(patch);
    return;
  }
  if (is_full(patch)) {
    const auto [a, b] = halves(patch);
    subtract_one(planes, a, out);
    subtract_one(planes, b, out);
    return;
  }
  const std::size_t before = out.size();
  Patch left = patch;
  Patch inside;
  Patch outside;
  for (const HalfPlane& plane : planes) {
    if (side_of(patch, plane) < 0) continue;
    split(left, plane, inside, outside);
    keep(outside, out);
    if (inside.size < 3) {
      // Only near a corner of the band: the patch stays whole.
      out.resize(before);
      out.push_back(patch);
      return;
    }
    std::swap(left, inside);
  }
}

/// Whether a band's two directions leave no gap between it and the other.
bool overlaps_along(const Band& a, const Band& b) {
  const Vec2 from = b.line.at(b.along.from);
  const Vec2 to = b.line.at(b.along.to);
  const double turn = a.line.along.dot(b.line.along);
  const double across = std::abs(a.line.along.x() * b.line.along.y() - a.line.along.y() * b.line.along.x());
  const double end = b.half_width_m * across;
  const double side = b.half_width_m * std::abs(turn);
  const auto [low, high] = std::minmax({a.line.along_of(from), a.line.along_of(to)});
  if (high + end < a.along.from || low - end > a.along.to) return false;
  const auto [right, left] = std::minmax({a.line.left_of(from), a.line.left_of(to)});
  return left + side > -a.half_width_m && right - side < a.half_width_m;
}

/// A patch's corners along and across a band.
struct Turned {
  std::array<Vec2, Patch::kMostCorners> corners;
  std::size_t size = 0;
};

/// Keeps what lies where sign · coordinate ≤ limit.
template <int kAxis>
void clip(Turned& patch, double sign, double limit) {
  if (patch.size < 3) return;
  Turned kept;
  const auto add = [&kept](const Vec2& corner) {
    if (kept.size < Patch::kMostCorners) kept.corners[kept.size++] = corner;
  };
  Vec2 last = patch.corners[patch.size - 1];
  double before = sign * last[kAxis] - limit;
  for (std::size_t i = 0; i < patch.size; ++i) {
    const Vec2& at = patch.corners[i];
    const double here = sign * at[kAxis] - limit;
    if ((before > 0.0) != (here > 0.0)) add(last + (at - last) * (before / (before - here)));
    if (here <= 0.0) add(at);
    last = at;
    before = here;
  }
  patch = kept;
}

/// Edges of all rings that cross a height, by where they cross it.
struct Crossing {
  double x = 0.0;
  std::size_t edge = 0;
};

}  // namespace

bool may_meet(const Band& a, const Band& b) { return overlaps_along(a, b) && overlaps_along(b, a); }

Planes planes_of(const Band& band) {
  const Vec2& along = band.line.along;
  const Vec2 left(-along.y(), along.x());
  const double at = along.dot(band.line.origin_m);
  const double side = left.dot(band.line.origin_m);
  return {HalfPlane{left, side + band.half_width_m}, HalfPlane{-left, -side + band.half_width_m},
          HalfPlane{along, at + band.along.to}, HalfPlane{-along, -at - band.along.from}};
}

Band band_of(const Segment& segment, double width_m) {
  return {line_through(segment.from_m, segment.to_m),
          {-kInside_m, segment.length_m() + kInside_m},
          width_m / 2.0};
}

std::vector<Patch> patches_of(const Polygon& polygon) {
  std::vector<std::pair<Vec2, Vec2>> edges;
  std::vector<double> heights;
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      heights.push_back(ring[i].y());
      edges.emplace_back(ring[j].y() < ring[i].y() ? std::pair(ring[j], ring[i])
                                                   : std::pair(ring[i], ring[j]));
    }
  };
  add(polygon.outline);
  for (const Ring& hole : polygon.holes) add(hole);
  std::sort(heights.begin(), heights.end());
  const auto x_at = [&](std::size_t edge, double y) {
    const auto& [low, high] = edges[edge];
    return low.x() + (high.x() - low.x()) * (y - low.y()) / (high.y() - low.y());
  };
  std::vector<Patch> out;
  // A trapezoid goes on as long as the same two edges bound it.
  std::map<std::pair<std::size_t, std::size_t>, double> open;
  const auto close = [&](const std::pair<std::size_t, std::size_t>& sides, double low, double high) {
    Patch patch;
    patch.size = 4;
    patch.corners[0] = {x_at(sides.first, low), low};
    patch.corners[1] = {x_at(sides.second, low), low};
    patch.corners[2] = {x_at(sides.second, high), high};
    patch.corners[3] = {x_at(sides.first, high), high};
    keep(patch, out);
  };
  double last = heights.front();
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    if (heights[k + 1] - heights[k] < kSlab_m) continue;
    const double middle = (heights[k] + heights[k + 1]) / 2.0;
    std::vector<Crossing> crossings;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (edges[e].first.y() <= middle && edges[e].second.y() > middle)
        crossings.push_back({x_at(e, middle), e});
    }
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    std::map<std::pair<std::size_t, std::size_t>, double> now;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const std::pair sides(crossings[i].edge, crossings[i + 1].edge);
      const auto before = open.find(sides);
      now[sides] = before != open.end() ? before->second : heights[k];
      if (before != open.end()) open.erase(before);
    }
    for (const auto& [sides, from] : open) close(sides, from, heights[k]);
    open = std::move(now);
    last = heights[k + 1];
  }
  for (const auto& [sides, from] : open) close(sides, from, last);
  return out;
}

std::vector<Patch> within(const std::vector<Patch>& patches, const Band& band) {
  const Planes planes = planes_of(band);
  std::vector<Patch> out;
  for (const Patch& patch : patches) {
    if (!may_meet(band, patch) || is_beyond(patch, planes)) continue;
    Patch now = patch;
    Patch inside;
    Patch outside;
    for (const HalfPlane& plane : planes) {
      if (now.size < 3) break;
      split(now, plane, inside, outside);
      now = inside;
    }
    keep(now, out);
  }
  return out;
}

void add_remains(const Patch& patch, std::span<const Planes* const> bands, std::vector<Patch>& out) {
  for (std::size_t i = 0; i < bands.size(); ++i) {
    if (is_beyond(patch, *bands[i])) continue;
    std::vector<Patch> parts;
    subtract_one(*bands[i], patch, parts);
    for (const Patch& part : parts) add_remains(part, bands.subspan(i + 1), out);
    return;
  }
  out.push_back(patch);
}

OpenGround::OpenGround(std::vector<Patch> patches) : patches_(std::move(patches)), open_(patches_.size(), 1) {
  if (patches_.empty()) return;
  Box box{patches_.front().middle_m, patches_.front().middle_m};
  for (const Patch& patch : patches_) {
    box.lo = box.lo.cwiseMin(patch.middle_m);
    box.hi = box.hi.cwiseMax(patch.middle_m);
  }
  all_.middle_m = (box.lo + box.hi) / 2.0;
  for (const Patch& patch : patches_) {
    all_.radius_m =
        std::max(all_.radius_m, (patch.middle_m - all_.middle_m).norm() + patch.radius_m + kRounding_m);
  }
}

void OpenGround::subtract(const Band& band) {
  const Planes planes = planes_of(band);
  const std::size_t count = patches_.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (open_[i] == 0 || is_beyond(patches_[i], planes)) continue;
    open_[i] = 0;
    const Patch patch = patches_[i];
    subtract_one(planes, patch, patches_);
  }
  open_.resize(patches_.size(), 1);
}

double OpenGround::area_m2() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < patches_.size(); ++i) sum += open_[i] != 0 ? patches_[i].area_m2 : 0.0;
  return sum;
}

double OpenGround::area_near(const Band& band) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < patches_.size(); ++i)
    sum += open_[i] != 0 && detail::may_meet(band, patches_[i]) ? patches_[i].area_m2 : 0.0;
  return sum;
}

BandPart part_in_band(const Patch& patch, const Band& band) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  BandPart out{0.0, {kFar, -kFar}};
  if (!may_meet(band, patch)) return out;
  Turned turned;
  Vec2 lo(kFar, kFar);
  Vec2 hi(-kFar, -kFar);
  for (std::size_t i = 0; i < patch.size; ++i) {
    const Vec2 at(band.line.along_of(patch.corners[i]), band.line.left_of(patch.corners[i]));
    turned.corners[i] = at;
    lo = lo.cwiseMin(at);
    hi = hi.cwiseMax(at);
  }
  turned.size = patch.size;
  if (hi.y() > band.half_width_m) clip<1>(turned, 1.0, band.half_width_m);
  if (lo.y() < -band.half_width_m) clip<1>(turned, -1.0, band.half_width_m);
  if (hi.x() > band.along.to) clip<0>(turned, 1.0, band.along.to);
  if (lo.x() < band.along.from) clip<0>(turned, -1.0, -band.along.from);
  if (turned.size < 3) return out;
  double twice = 0.0;
  for (std::size_t i = 0; i < turned.size; ++i) {
    const Vec2& at = turned.corners[i];
    out.extent = {std::min(out.extent.from, at.x()), std::max(out.extent.to, at.x())};
    if (i > 0 && i + 1 < turned.size)
      twice += cross(at - turned.corners[0], turned.corners[i + 1] - turned.corners[0]);
  }
  out.area_m2 = twice / 2.0;
  return out;
}

double area_m2(const std::vector<Patch>& patches) {
  double sum = 0.0;
  for (const Patch& patch : patches) sum += patch.area_m2;
  return sum;
}

}  // namespace swallowtail::coverage::detail
