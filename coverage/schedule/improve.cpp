#include "coverage/schedule/improve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::coverage {
namespace {

constexpr double kBetter_s = 1e-6;

class LocalSearch {
 public:
  LocalSearch(std::span<const SubCell> cells, std::vector<Visit> visits, const ScheduleStart& start,
              StopPlanner& stops, LinkCache& links, const StopCondition& stop, std::size_t first_free)
      : cells_(cells),
        visits_(std::move(visits)),
        start_(start),
        stops_(stops),
        links_(links),
        stop_(stop),
        first_free_(first_free) {
    end_s_ = evaluate(visits_);
    tolerance_s_ = 2.0 * planner::kStopToTurn_s;
  }

  ImproveReport run() {
    for (bool improved = true; improved && !stopped();) {
      improved = sweep_moves();
    }
    return {visits_, end_s_, evaluations_};
  }

 private:
  bool stopped() const { return stop_.reached(evaluations_, 0); }

  std::vector<RouteLeg> route(const std::vector<Visit>& visits) const {
    std::vector<RouteLeg> out;
    out.reserve(visits.size());
    for (const Visit& v : visits) out.push_back(route_leg(cells_[v.sub_cell], v));
    return out;
  }
  double evaluate(const std::vector<Visit>& visits) {
    ++evaluations_;
    return stops_.end_of(route(visits), start_, end_s_);
  }
  static Visit turned(Visit v) { return {v.sub_cell, !v.from_beta}; }
  /// Flight between two visits; none: from the start, and nothing after the last.
  double hop(const Visit* a, const Visit* b) {
    if (b == nullptr) return 0.0;
    const RouteLeg to = route_leg(cells_[b->sub_cell], *b);
    if (a == nullptr)
      return (to.flown.entry_m - start_.position_m).head<2>().norm() /
             links_.model().limits().cruise_speed_mps;
    const RouteLeg from = route_leg(cells_[a->sub_cell], *a);
    return links_.get(from.id, from.flown, to.id, to.flown).hop.time_s;
  }
  const Visit* at(std::size_t i) const { return i < visits_.size() ? &visits_[i] : nullptr; }
  const Visit* before(std::size_t i) const { return i == 0 ? nullptr : &visits_[i - 1]; }

  bool accept(const std::vector<Visit>& candidate) {
    if (stopped()) return false;
    const double end = evaluate(candidate);
    if (!(end < end_s_ - kBetter_s)) return false;
    visits_ = candidate;
    end_s_ = end;
    return true;
  }
  /// Turns the stretch i … j round: only its two outer hops change.
  bool try_reversal(std::size_t i, std::size_t j) {
    const Visit first = turned(visits_[j]);
    const Visit last = turned(visits_[i]);
    const double gain =
        hop(before(i), at(i)) + hop(at(j), at(j + 1)) - hop(before(i), &first) - hop(&last, at(j + 1));
    if (gain < -tolerance_s_) return false;
    std::vector<Visit> candidate = visits_;
    std::reverse(candidate.begin() + static_cast<std::ptrdiff_t>(i),
                 candidate.begin() + static_cast<std::ptrdiff_t>(j) + 1);
    for (std::size_t k = i; k <= j; ++k) candidate[k].from_beta = !candidate[k].from_beta;
    return accept(candidate);
  }
  /// Takes `count` visits at i and puts them between `to` − 1 and `to` (positions before the removal, outside
  /// the chain).
  bool try_move(std::size_t i, std::size_t count, std::size_t to, bool turn) {
    const Visit first = turn ? turned(visits_[i + count - 1]) : visits_[i];
    const Visit last = turn ? turned(visits_[i]) : visits_[i + count - 1];
    const double gain = hop(before(i), at(i)) + hop(at(i + count - 1), at(i + count)) +
                        hop(before(to), at(to)) - hop(before(i), at(i + count)) - hop(before(to), &first) -
                        hop(&last, at(to));
    if (gain < -tolerance_s_) return false;
    const auto place = [](std::vector<Visit>& v, std::size_t k) {
      return v.begin() + static_cast<std::ptrdiff_t>(k);
    };
    std::vector<Visit> candidate = visits_;
    std::vector<Visit> chain(place(candidate, i), place(candidate, i + count));
    candidate.erase(place(candidate, i), place(candidate, i + count));
    if (turn) {
      std::reverse(chain.begin(), chain.end());
      for (Visit& v : chain) v.from_beta = !v.from_beta;
    }
    candidate.insert(place(candidate, to > i ? to - count : to), chain.begin(), chain.end());
    return accept(candidate);
  }
  bool sweep_moves();

  std::span<const SubCell> cells_;
  std::vector<Visit> visits_;
  const ScheduleStart& start_;
  StopPlanner& stops_;
  LinkCache& links_;
  const StopCondition& stop_;
  std::size_t first_free_;
  double end_s_ = std::numeric_limits<double>::infinity();
  double tolerance_s_ = 0.0;
  std::uint64_t evaluations_ = 0;
};

bool LocalSearch::sweep_moves() {
  bool improved = false;
  const std::size_t n = visits_.size();
  for (std::size_t i = first_free_; i < n && !stopped(); ++i) {
    for (std::size_t j = i; j < n && !stopped(); ++j) improved |= try_reversal(i, j);
    for (std::size_t count = 1; count <= 3 && i + count <= n; ++count) {
      for (std::size_t to = first_free_; to <= n && !stopped(); ++to) {
        if (to >= i && to <= i + count) continue;
        improved |= try_move(i, count, to, false) || try_move(i, count, to, true);
      }
    }
  }
  return improved;
}

}  // namespace

ImproveReport improve_order(std::span<const SubCell> sub_cells, std::vector<Visit> visits,
                            const ScheduleStart& start, StopPlanner& stops, LinkCache& links,
                            const StopCondition& stop, std::size_t first_free) {
  if (visits.empty()) return {std::move(visits), start.time_s, 0};
  return LocalSearch(sub_cells, std::move(visits), start, stops, links, stop, first_free).run();
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
