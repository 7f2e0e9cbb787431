#include "coverage/field/detail/rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "coverage/field/detail/simplify.hpp"

namespace swallowtail::coverage::detail {
namespace {

constexpr int kRounds = 4;
/// Borders are taken as straight where they deviate by no more than this share of the width.
constexpr double kStraight = 0.24;
constexpr double kRounding = 1e-9;

/// A line that may be flown between two limits, to see something of the rest.
struct Candidate {
  Line line;
  Interval limits;
};

/// What a candidate is good for: the stretch of it that sees most for its cost.
struct Gain {
  double rate = 0.0;  ///< area seen per metre of cost
  double area_m2 = 0.0;
  Interval stretch;
};

struct Part {
  Polygon polygon;
  Vec2 middle_m = Vec2::Zero();
  double radius_m = 0.0;
  double area_m2 = 0.0;
};

Part part_of(Polygon polygon) {
  Part out;
  const Box box = bounds_of(polygon.outline);
  out.middle_m = (box.lo + box.hi) / 2.0;
  out.radius_m = (box.hi - box.lo).norm() / 2.0;
  out.area_m2 = coverage::area_m2(polygon);
  out.polygon = std::move(polygon);
  return out;
}

class RestSearch {
 public:
  RestSearch(const Polygon& field, const Shape& rest, const RestParams& params)
      : field_(field), params_(params) {
    for (Polygon& polygon : rest.parts()) add_part(std::move(polygon));
  }

  RestCover run() {
    for (int round = 0; round < kRounds && left_m2_ > params_.allowed_m2; ++round) {
      candidates_.clear();
      if (round == 0) add_along_borders();
      for (const Part& part : parts_) add_along_axes(part);
      choose();
    }
    return {std::move(chosen_), left_m2_};
  }

 private:
  void add_part(Polygon polygon) {
    Part part = part_of(std::move(polygon));
    left_m2_ += part.area_m2;
    parts_.push_back(std::move(part));
  }
  /// The stretches of the line inside the field that touch the part of it between the limits.
  void add_line(const Line& line, const Interval& about) {
    for (const Interval& inside : inside_of(field_, line)) {
      if (inside.to >= about.from && inside.from <= about.to) candidates_.push_back({line, inside});
    }
  }
  void add_along_borders() {
    add_along_border(field_.outline);
    for (const Ring& hole : field_.holes) add_along_border(hole);
  }
  void add_along_border(const Ring& ring);
  void add_along_axes(const Part& part);
  Gain gain_of(const Candidate& candidate) const;
  void choose();
  void see(const Segment& segment);

  const Polygon& field_;
  RestParams params_;
  std::vector<Part> parts_;
  double left_m2_ = 0.0;
  std::vector<Candidate> candidates_;
  std::vector<Segment> chosen_;
};

/// Beside each straight stretch of the border, inside: as far from it as its outermost point is still seen,
/// as near to it as the line stays inside, and between.
void RestSearch::add_along_border(const Ring& ring) {
  const double half = params_.width_m / 2.0;
  const std::vector<std::size_t> corners = corners_of(ring, kStraight * params_.width_m);
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const Vec2& a = ring[corners[k] % ring.size()];
    const Vec2& b = ring[corners[k + 1] % ring.size()];
    const double length = (b - a).norm();
    if (length < kRounding) continue;
    const Line border = line_through(a, b);
    double most = 0.0;
    double least = 0.0;
    for (std::size_t i = corners[k]; i <= corners[k + 1]; ++i) {
      const double left = border.left_of(ring[i % ring.size()]);
      most = std::max(most, left);
      least = std::min(least, left);
    }
    const Vec2 inwards(-border.along.y(), border.along.x());
    const double farthest = half + least - kInside_m;
    const double nearest = std::min(most + kInside_m, farthest);
    for (const double offset : {farthest, (nearest + farthest) / 2.0, nearest})
      add_line({border.origin_m + inwards * offset, border.along}, {0.0, length});
  }
}

/// Through the part's middle along its principal axis and along its longest edge, as many side by side as it
/// is wide.
void RestSearch::add_along_axes(const Part& part) {
  const Ring& ring = part.polygon.outline;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : ring) mean += p / static_cast<double>(ring.size());
  Vec2 longest = Vec2::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 edge = ring[(i + 1) % ring.size()] - ring[i];
    spread += (ring[i] - mean) * (ring[i] - mean).transpose();
    if (edge.norm() > longest.norm()) longest = edge;
  }
  const double turn = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  for (const Vec2& along : {Vec2(std::cos(turn), std::sin(turn)), Vec2(longest.normalized())}) {
    const Line axis{part.middle_m, along};
    Interval across{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    Interval extent = across;
    for (const Vec2& p : ring) {
      across = {std::min(across.from, axis.left_of(p)), std::max(across.to, axis.left_of(p))};
      extent = {std::min(extent.from, axis.along_of(p)), std::max(extent.to, axis.along_of(p))};
    }
    const double wide = across.to - across.from;
    const int count = std::clamp(static_cast<int>(std::ceil(wide / params_.width_m - 1e-6)), 1, 64);
    for (int i = 0; i < count; ++i) {
      const double offset = across.from + wide * (i + 0.5) / count;
      add_line({part.middle_m + Vec2(-along.y(), along.x()) * offset, along}, extent);
    }
  }
}

Gain RestSearch::gain_of(const Candidate& candidate) const {
  const double half = params_.width_m / 2.0;
  std::vector<BandPart> seen;
  for (const Part& part : parts_) {
    if (std::abs(candidate.line.left_of(part.middle_m)) > half + part.radius_m) continue;
    const double at = candidate.line.along_of(part.middle_m);
    if (at + part.radius_m < candidate.limits.from || at - part.radius_m > candidate.limits.to) continue;
    const Interval within{candidate.limits.from - kInside_m, candidate.limits.to + kInside_m};
    const BandPart band = part_in_band(part.polygon, candidate.line, within, half);
    if (band.area_m2 > kRounding) seen.push_back(band);
  }
  std::sort(seen.begin(), seen.end(),
            [](const BandPart& a, const BandPart& b) { return a.extent.from < b.extent.from; });
  Gain best;
  Gain run;
  const auto end_run = [&] {
    run.rate = run.area_m2 / (params_.piece_cost_m + run.stretch.to - run.stretch.from);
    if (run.rate > best.rate) best = run;
  };
  for (const BandPart& band : seen) {
    const bool apart = run.area_m2 > 0.0 && band.extent.from - run.stretch.to > params_.piece_cost_m;
    if (apart) end_run();
    if (apart || run.area_m2 <= 0.0) run = {0.0, 0.0, band.extent};
    run.area_m2 += band.area_m2;
    run.stretch.to = std::max(run.stretch.to, band.extent.to);
  }
  if (run.area_m2 > 0.0) end_run();
  best.stretch.from = std::max(best.stretch.from, candidate.limits.from);
  best.stretch.to = std::min(best.stretch.to, candidate.limits.to);
  return best;
}

/// Lazy greedy: a gain only shrinks as others are chosen, so that the front of the queue is brought up to
/// date before it is taken.
void RestSearch::choose() {
  using Entry = std::pair<double, std::size_t>;
  const auto later = [](const Entry& a, const Entry& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::priority_queue<Entry, std::vector<Entry>, decltype(later)> queue(later);
  const double least_m2 = std::max(kRounding, params_.allowed_m2 * 1e-3);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Gain gain = gain_of(candidates_[i]);
    if (gain.area_m2 > least_m2) queue.emplace(gain.rate, i);
  }
  while (!queue.empty() && left_m2_ > params_.allowed_m2) {
    const Entry front = queue.top();
    queue.pop();
    const Gain gain = gain_of(candidates_[front.second]);
    if (gain.area_m2 <= least_m2 || gain.stretch.to - gain.stretch.from < kInside_m) continue;
    if (gain.rate < front.first * (1.0 - 1e-9)) {
      queue.emplace(gain.rate, front.second);
      continue;
    }
    see(candidates_[front.second].line.piece(gain.stretch));
    queue.emplace(gain.rate, front.second);  // its other stretches
  }
}

void RestSearch::see(const Segment& segment) {
  chosen_.push_back(segment);
  const Ring patch = seen_from(segment, params_.width_m);
  const Vec2 middle = (segment.from_m + segment.to_m) / 2.0;
  const double reach = std::hypot(segment.length_m(), params_.width_m) / 2.0 + kInside_m;
  const Shape seen = Shape::of(Polygon{patch, {}});
  std::vector<Part> before;
  before.swap(parts_);
  left_m2_ = 0.0;
  for (Part& part : before) {
    if ((part.middle_m - middle).norm() > reach + part.radius_m) {
      left_m2_ += part.area_m2;
      parts_.push_back(std::move(part));
      continue;
    }
    for (Polygon& polygon : Shape::of(part.polygon).minus(seen).parts()) add_part(std::move(polygon));
  }
}

}  // namespace

RestCover cover_rest(const Polygon& polygon, const Shape& rest, const RestParams& params) {
  return RestSearch(polygon, rest, params).run();
}

}  // namespace swallowtail::coverage::detail
