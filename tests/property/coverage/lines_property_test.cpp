#include <algorithm>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "coverage/field/detail/line_cover.hpp"
#include "coverage/field/detail/line_gain.hpp"
#include "coverage/field/detail/line_tour.hpp"
#include "planner/base/rng.hpp"
#include "tools/bench/cover/holed_field.hpp"

namespace swallowtail::coverage::detail {
namespace {

constexpr double kPieceCost_m = 18.0;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// What a property is about: a field and chance.
struct Scene {
  Polygon field;
  Rng rng;
  double width_m = 10.0;
};

Scene scene() {
  const auto seed = *rc::gen::inRange<std::uint64_t>(1, 100'000);
  bench::HoledFieldParams params;
  params.holes = *rc::gen::inRange(0, 8);
  params.hole_corners = params.holes * 4;
  const double width_m = *rc::gen::element(3.0, 5.0, 10.0, 20.0);
  return {clean(bench::holed_field(seed, params))->front(), Rng(seed), width_m};
}

Segment random_segment(Rng& rng) {
  return {{rng.uniform(-60, 60), rng.uniform(-60, 60)}, {rng.uniform(-60, 60), rng.uniform(-60, 60)}};
}

RC_GTEST_PROP(LineGain, RememberedIsTheSameAsReckonedAnew, ()) {
  Scene at = scene();
  OpenGround open(patches_of(at.field));
  const Segment segment = random_segment(at.rng);
  const Line line = line_through(segment.from_m, segment.to_m);
  const Interval limits{0.0, segment.length_m()};
  LineInView remembered(line, limits, at.width_m);
  for (int i = 0; i < 12; ++i) {
    open.subtract(band_of(random_segment(at.rng), at.width_m));
    if (at.rng.uniform() < 0.3) continue;  // several changes at once
    remembered.look(open);
    LineInView anew(line, limits, at.width_m);
    anew.look(open);
    for (const bool alone : {true, false}) {
      const double part_m = segment.length_m() / 3.0;
      const LineGain a = alone ? remembered.flown(kPieceCost_m) : remembered.drawn_on(part_m);
      const LineGain b = alone ? anew.flown(kPieceCost_m) : anew.drawn_on(part_m);
      RC_ASSERT(a.rate == b.rate);
      RC_ASSERT(a.stretch.from == b.stretch.from);
      RC_ASSERT(a.stretch.to == b.stretch.to);
    }
  }
}

RC_GTEST_PROP(LineCover, APieceIsNeededForAllThatItAloneSees, ()) {
  Scene at = scene();
  const Ground ground(at.field, at.width_m);
  std::vector<PiecePtr> pieces;
  for (int i = 0; i < 12; ++i) pieces.push_back(ground.piece_of(random_segment(at.rng), i));
  const double may_lose_m2 = at.rng.uniform(0.0, 50.0);
  for (const PiecePtr& piece : pieces) {
    const std::vector<Patch> alone = seen_alone(*piece, pieces);
    const Needed needed = needed_of(*piece, pieces, may_lose_m2);
    const double alone_m2 = area_m2(alone);
    RC_ASSERT(needed.is_nothing == (alone_m2 <= may_lose_m2));
    if (needed.is_nothing) {
      RC_ASSERT(std::abs(needed.alone_m2 - alone_m2) < 1e-6);
      continue;
    }
    Interval all{kFar, -kFar};
    for (const Patch& patch : alone) {
      for (std::size_t i = 0; i < patch.size; ++i) {
        const double along = piece->band.line.along_of(patch.corners[i]);
        all = {std::min(all.from, along), std::max(all.to, along)};
      }
    }
    RC_ASSERT(std::abs(needed.stretch.from - all.from) < 1e-9);
    RC_ASSERT(std::abs(needed.stretch.to - all.to) < 1e-9);
  }
}

double cost_anew(const LineTour& tour, const LinkCosts& costs) {
  double cost = 0.0;
  for (std::size_t i = 0; i < tour.legs().size(); ++i) {
    cost += (tour.legs()[i].exit_m - tour.legs()[i].entry_m).norm();
    if (i + 1 < tour.legs().size()) cost += costs.link_m(tour.legs()[i], tour.legs()[i + 1]);
  }
  return cost;
}

RC_GTEST_PROP(LineTour, KeepsItsCostAndItsLines, ()) {
  Scene at = scene();
  const LinkCosts costs(at.field, {8.0, 1.05});
  LineTour tour(costs);
  std::vector<int> lines;
  int next = 0;
  for (int i = 0; i < 60; ++i) {
    const double what = lines.size() < 3 ? 0.0 : at.rng.uniform();
    if (what < 0.5) {
      lines.push_back(next);
      tour.insert(next++, random_segment(at.rng));
    } else if (what < 0.7) {
      const std::size_t gone = at.rng.below(lines.size());
      tour.remove(lines[gone]);
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(gone));
    } else if (what < 0.9) {
      tour.replace(lines[at.rng.below(lines.size())], random_segment(at.rng));
    } else {
      const double before_m = tour.cost_m();
      tour.improve();
      RC_ASSERT(tour.cost_m() <= before_m + 1e-6);
    }
    RC_ASSERT(std::abs(tour.cost_m() - cost_anew(tour, costs)) < 1e-6);
    std::vector<int> flown;
    for (const TourLeg& leg : tour.legs()) flown.push_back(leg.line);
    std::sort(flown.begin(), flown.end());
    std::vector<int> all = lines;
    std::sort(all.begin(), all.end());
    RC_ASSERT(flown == all);
  }
}

}  // namespace
}  // namespace swallowtail::coverage::detail
