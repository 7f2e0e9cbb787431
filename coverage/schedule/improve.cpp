#include "coverage/schedule/improve.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "coverage/schedule/descent.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::coverage {
namespace {

constexpr std::size_t kLongestKicked = 12;

/// Two stretches that change places, somewhere in the order.
void kick(Descent& descent, std::size_t first_free, Rng& rng) {
  const std::vector<Visit>& visits = descent.visits();
  const std::size_t free = visits.size() - first_free;
  const std::size_t most = std::min(kLongestKicked, free / 2);
  const std::size_t left = 1 + rng.below(most);
  const std::size_t right = 1 + rng.below(most);
  const std::size_t first = first_free + rng.below(free - left - right + 1);
  std::vector<Visit> swapped(visits.begin() + static_cast<std::ptrdiff_t>(first),
                             visits.begin() + static_cast<std::ptrdiff_t>(first + left + right));
  std::rotate(swapped.begin(), swapped.begin() + static_cast<std::ptrdiff_t>(left), swapped.end());
  descent.put(first, swapped);
}

/// The same battery, charged at its mean rate throughout.
Battery charged_evenly(Battery battery) {
  const double from = battery.reserve;
  battery.charge_s_per_unit = battery.charging().seconds(from, battery.capacity) / (battery.capacity - from);
  battery.taper_from = 1.0;
  return battery;
}

ImproveReport search(std::span<const SubCell> sub_cells, std::vector<Visit> visits,
                     const ScheduleStart& start, LinkCache& links, const ImproveParams& params) {
  if (visits.size() <= params.first_free) return {std::move(visits), start.time_s, 0};
  Descent descent(sub_cells, std::move(visits), start, links, params);
  descent.run();
  Rng rng(params.seed);
  std::vector<Visit> best = descent.visits();
  double least_s = descent.objective_s();
  const bool can_kick = best.size() >= params.first_free + 2;
  for (std::uint64_t i = 0; can_kick && i < params.kicks && !descent.stopped(); ++i) {
    descent.mark();
    kick(descent, params.first_free, rng);
    descent.run();
    const auto [first, past] = descent.changed();
    const auto stretch = [first = first, past = past](auto& of) {
      return std::span(of).subspan(first, past - first);
    };
    if (descent.objective_s() <= least_s) {
      least_s = descent.objective_s();
      std::ranges::copy(stretch(descent.visits()), stretch(best).begin());
    } else {
      descent.put(first, stretch(best));
      descent.forget_touched();
    }
  }
  return {std::move(best), least_s, descent.evaluations()};
}

}  // namespace

ImproveReport improve_order(std::span<const SubCell> sub_cells, std::vector<Visit> visits,
                            const ScheduleStart& start, LinkCache& links, const ImproveParams& params) {
  if (params.aim == Aim::kFlight || params.stops.battery.charging().is_linear())
    return search(sub_cells, std::move(visits), start, links, params);
  // OrderValue knows one charging rate: what it finds is judged by the true curve.
  ImproveParams even = params;
  even.stops.battery = charged_evenly(params.stops.battery);
  ImproveReport found = search(sub_cells, visits, start, links, even);
  StopPlanner exact(links, params.stops);
  const auto end_s = [&](const std::vector<Visit>& order) {
    std::vector<RouteLeg> route;
    for (const Visit& visit : order) route.push_back(route_leg(sub_cells[visit.sub_cell], visit));
    return exact.end_of(route, start);
  };
  const double before_s = end_s(visits);
  found.end_s = end_s(found.visits);
  found.evaluations += 2;
  if (found.end_s <= before_s) return found;
  return {std::move(visits), before_s, found.evaluations};
}

std::vector<Visit> boustrophedon_order(std::span<const SubCell> sub_cells, const Vec3& from_m) {
  // Sub-cells come strip by strip; the nearest field's first or last is taken, then the field is swept to its
  // other end.
  struct Block {
    std::size_t first;
    std::size_t past;
  };
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < sub_cells.size(); ++i) {
    if (blocks.empty() || sub_cells[blocks.back().first].field_id != sub_cells[i].field_id)
      blocks.push_back({i, i});
    blocks.back().past = i + 1;
  }
  std::vector<Visit> out;
  Vec3 at = from_m;
  while (!blocks.empty()) {
    std::size_t best = 0;
    bool backwards = false;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      for (const bool last : {false, true}) {
        const SubCell& cell = sub_cells[last ? blocks[b].past - 1 : blocks[b].first];
        const double distance =
            std::min((cell.alpha_m - at).head<2>().norm(), (cell.beta_m - at).head<2>().norm());
        if (distance < least) {
          least = distance;
          best = b;
          backwards = last;
        }
      }
    }
    const Block block = blocks[best];
    blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(best));
    for (std::size_t k = 0; k < block.past - block.first; ++k) {
      const std::size_t i = backwards ? block.past - 1 - k : block.first + k;
      const bool from_beta = (sub_cells[i].beta_m - at).norm() < (sub_cells[i].alpha_m - at).norm();
      out.push_back({i, from_beta});
      at = flown(sub_cells[i], from_beta).exit_m;
    }
  }
  return out;
}

}  // namespace swallowtail::coverage
