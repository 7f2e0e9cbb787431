#include "coverage/field/detail/line_gain.hpp"

#include <algorithm>

namespace swallowtail::coverage::detail {
namespace {

/// Lines are drawn on by no less in the reckoning.
constexpr double kShortest_m = 0.02;

}  // namespace

LineInView::LineInView(const Line& line, const Interval& limits, double width_m)
    : band_{line, {limits.from - kInside_m, limits.to + kInside_m}, width_m / 2.0}, limits_(limits) {}

void LineInView::look(const OpenGround& ground) {
  const std::vector<Patch>& patches = ground.patches();
  std::erase_if(seen_, [&](const Seen& seen) { return !ground.is_open(seen.patch); });
  const std::size_t known = seen_.size();
  for (; looked_ < patches.size(); ++looked_) {
    if (!ground.is_open(looked_) || !may_meet(band_, patches[looked_])) continue;
    const BandPart part = part_in_band(patches[looked_], band_);
    if (part.area_m2 > 0.0) seen_.push_back({part.extent, part.area_m2, looked_});
  }
  if (seen_.size() == known) return;
  std::sort(seen_.begin(), seen_.end(), [](const Seen& a, const Seen& b) {
    return a.extent.from != b.extent.from ? a.extent.from < b.extent.from : a.patch < b.patch;
  });
}

LineGain LineInView::limited(LineGain gain) const {
  gain.stretch = {std::max(gain.stretch.from, limits_.from), std::min(gain.stretch.to, limits_.to)};
  return gain;
}

LineGain LineInView::flown(double piece_cost_m) const {
  LineGain best;
  double area = 0.0;
  Interval run;
  const auto end_run = [&] {
    const double rate = area / (piece_cost_m + run.to - run.from);
    if (area > 0.0 && rate > best.rate) best = {rate, run};
    area = 0.0;
  };
  for (const Seen& seen : seen_) {
    if (seen.extent.from - run.to > piece_cost_m) end_run();
    if (area <= 0.0) run = seen.extent;
    area += seen.area_m2;
    run.to = std::max(run.to, seen.extent.to);
  }
  end_run();
  return limited(best);
}

LineGain LineInView::drawn_on(double length_m) const {
  LineGain best;
  const auto look = [&](double area, double more_m, const Interval& stretch) {
    const double rate = area / std::max(more_m, kShortest_m);
    if (rate > best.rate) best = {rate, stretch};
  };
  double area = 0.0;
  double reach = length_m;
  for (const Seen& seen : seen_) {
    if (seen.extent.to <= length_m / 2.0) continue;
    area += seen.area_m2;
    reach = std::max(reach, seen.extent.to);
    look(area, reach - length_m, {0.0, reach});
  }
  area = 0.0;
  reach = 0.0;
  for (auto seen = seen_.rbegin(); seen != seen_.rend(); ++seen) {
    if (seen->extent.from >= length_m / 2.0) continue;
    area += seen->area_m2;
    reach = std::min(reach, seen->extent.from);
    look(area, -reach, {reach, length_m});
  }
  return limited(best);
}

}  // namespace swallowtail::coverage::detail
