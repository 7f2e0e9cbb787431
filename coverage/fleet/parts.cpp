#include "coverage/fleet/parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coverage/schedule/order.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGain_s = 1e-6;
constexpr std::size_t kTried = 24;             ///< moves per round whose schedules are worked out
constexpr std::size_t kEstimates = 2'000'000;  ///< moves per round that are looked at

/// Legs of schedules that may be worked out for exchanges.
double budget_of(gtsp::Mode mode) {
  switch (mode) {
    case gtsp::Mode::kFast:
      return 1e6;
    case gtsp::Mode::kDefault:
      return 1e7;
    case gtsp::Mode::kSlow:
      return 1e8;
  }
  return 1e6;
}

using Visits = std::vector<Visit>;

/// A chain of the busiest that goes elsewhere.
struct Move {
  double longest_s = 0.0;  ///< of the two, estimated
  std::size_t first = 0;
  std::size_t count = 0;
  std::size_t to = 0;
  std::size_t at = 0;
  bool is_turned = false;
};

class Sharing {
 public:
  Sharing(std::span<const SubCell> cells, std::span<const ScheduleStart> starts, const Task& task,
          const PlanOptions& options, LinkCache& links)
      : cells_(cells),
        starts_(starts),
        task_(task),
        options_(options),
        links_(links),
        stops_(links, stop_params(task, options)),
        budget_(budget_of(options.mode)) {}

  Result<Parts> run(std::span<const Visit> order);

 private:
  bool is_over() const { return options_.stop.reached(0, 0) || spent_ > budget_; }
  double end_of(const Visits& visits, std::size_t part, double cutoff_s = kInfinity);
  void judge();
  void cut(std::span<const Visit> order);
  void deal(std::span<const Visit> order);
  void balance();
  bool shift(std::size_t from, std::size_t to, std::size_t count);
  void improve(std::size_t part);
  bool exchange();
  bool apply(const Move& move);
  double hop_s(const Visit& from, const Visit& to) const;
  double link_s(std::size_t part, const Visits& visits, std::size_t at, const Visit& to) const;
  std::vector<Move> moves_from(std::size_t part) const;
  void add_insertion(std::size_t from, Move move, double gain_s, double chain_s,
                     std::vector<Move>& out) const;

  std::span<const SubCell> cells_;
  std::span<const ScheduleStart> starts_;
  const Task& task_;
  const PlanOptions& options_;
  LinkCache& links_;
  StopPlanner stops_;
  double budget_;
  double spent_ = 0.0;
  Parts parts_;
};

double Sharing::end_of(const Visits& visits, std::size_t part, double cutoff_s) {
  std::vector<RouteLeg> route;
  for (const Visit& visit : visits) route.push_back(route_leg(cells_[visit.sub_cell], visit));
  spent_ += static_cast<double>(route.size());
  return stops_.end_of(route, starts_[part], cutoff_s);
}

void Sharing::judge() {
  parts_.end_s.clear();
  for (std::size_t k = 0; k < starts_.size(); ++k) parts_.end_s.push_back(end_of(parts_.visits[k], k));
}

void Sharing::cut(std::span<const Visit> order) {
  const std::size_t n = starts_.size();
  parts_.visits.assign(n, {});
  for (std::size_t k = 0; k < n; ++k) {
    const auto from = order.begin() + static_cast<std::ptrdiff_t>(k * order.size() / n);
    const auto to = order.begin() + static_cast<std::ptrdiff_t>((k + 1) * order.size() / n);
    parts_.visits[k].assign(from, to);
  }
  judge();
}

void Sharing::deal(std::span<const Visit> order) {
  const std::size_t n = starts_.size();
  parts_.visits.assign(n, {});
  for (std::size_t i = 0; i < order.size(); ++i) parts_.visits[i % n].push_back(order[i]);
  judge();
}

/// Gives visits at the border of a part to the part beside it.
bool Sharing::shift(std::size_t from, std::size_t to, std::size_t count) {
  if (parts_.visits[from].size() <= count) return false;
  Visits given = parts_.visits[from];
  Visits taken = parts_.visits[to];
  const auto many = static_cast<std::ptrdiff_t>(count);
  if (to < from) {
    taken.insert(taken.end(), given.begin(), given.begin() + many);
    given.erase(given.begin(), given.begin() + many);
  } else {
    taken.insert(taken.begin(), given.end() - many, given.end());
    given.erase(given.end() - many, given.end());
  }
  const double most_s = std::max(parts_.end_s[from], parts_.end_s[to]);
  const double taken_s = end_of(taken, to, most_s - kGain_s);
  if (!(taken_s < most_s - kGain_s)) return false;
  const double given_s = end_of(given, from);
  if (!(given_s < most_s - kGain_s)) return false;
  parts_.visits[from] = std::move(given);
  parts_.visits[to] = std::move(taken);
  parts_.end_s[from] = given_s;
  parts_.end_s[to] = taken_s;
  return true;
}

/// Moves the borders of a cut order, by large steps first.
void Sharing::balance() {
  const std::size_t n = starts_.size();
  for (std::size_t step = std::max<std::size_t>(1, cells_.size() / (4 * n)); step > 0; step /= 2) {
    bool moved = true;
    while (moved && !is_over()) {
      moved = false;
      for (std::size_t k = 0; k < n; ++k) {
        if (k > 0) moved = shift(k, k - 1, step) || moved;
        if (k + 1 < n) moved = shift(k, k + 1, step) || moved;
      }
    }
  }
}

/// Each part as a task of its own.
void Sharing::improve(std::size_t part) {
  Visits& visits = parts_.visits[part];
  ImproveParams params;
  params.stops = stop_params(task_, options_);
  params.stop = options_.stop;
  params.stop.max_evaluations = std::min<std::uint64_t>(params.stop.max_evaluations, 20'000);
  params.kicks = visits.size();
  params.seed = options_.seed;
  ImproveReport improved = improve_order(cells_, visits, starts_[part], links_, params);
  if (improved.end_s < parts_.end_s[part] - kGain_s) {
    visits = std::move(improved.visits);
    parts_.end_s[part] = end_of(visits, part);
  }
  std::vector<SubCell> own;
  std::vector<std::size_t> index;
  for (const Visit& visit : visits) index.push_back(visit.sub_cell);
  std::ranges::sort(index);
  for (const std::size_t i : index) own.push_back(cells_[i]);
  Result<Order> order = find_order(own, starts_[part], task_, options_, links_);
  if (!order) return;
  for (Visit& visit : order->visits) visit.sub_cell = index[visit.sub_cell];
  const double end_s = end_of(order->visits, part);
  if (end_s < parts_.end_s[part] - kGain_s) {
    visits = std::move(order->visits);
    parts_.end_s[part] = end_s;
  }
}

/// Straight, at cruise speed: an estimate only.
double Sharing::hop_s(const Visit& from, const Visit& to) const {
  const Vec3 a = flown(cells_[from.sub_cell], from.from_beta).exit_m;
  const Vec3 b = flown(cells_[to.sub_cell], to.from_beta).entry_m;
  return (b - a).norm() / task_.vehicle.cruise_speed_mps;
}

/// To a visit from the one at `at` − 1, or from the start.
double Sharing::link_s(std::size_t part, const Visits& visits, std::size_t at, const Visit& to) const {
  if (at > 0) return hop_s(visits[at - 1], to);
  const Vec3 entry = flown(cells_[to.sub_cell], to.from_beta).entry_m;
  return (entry - starts_[part].position_m).head<2>().norm() / task_.vehicle.cruise_speed_mps;
}

void Sharing::add_insertion(std::size_t from, Move move, double gain_s, double chain_s,
                            std::vector<Move>& out) const {
  const Visits& source = parts_.visits[from];
  const Visits& target = parts_.visits[move.to];
  const auto begin = source.begin() + static_cast<std::ptrdiff_t>(move.first);
  const Visits forth(begin, begin + static_cast<std::ptrdiff_t>(move.count));
  const Visits back = turned(forth);
  double least_s = kInfinity;
  for (std::size_t at = 0; at <= target.size(); ++at) {
    const double before_s = at < target.size() ? link_s(move.to, target, at, target[at]) : 0.0;
    for (const Visits* chain : {&forth, &back}) {
      double added_s = link_s(move.to, target, at, chain->front()) - before_s;
      if (at < target.size()) added_s += hop_s(chain->back(), target[at]);
      if (added_s >= least_s) continue;
      least_s = added_s;
      move.at = at;
      move.is_turned = chain == &back;
    }
  }
  move.longest_s = std::max(parts_.end_s[from] - gain_s, parts_.end_s[move.to] + chain_s + least_s);
  if (move.longest_s < parts_.end_s[from] - kGain_s) out.push_back(move);
}

std::vector<Move> Sharing::moves_from(std::size_t part) const {
  const Visits& visits = parts_.visits[part];
  std::vector<Move> out;
  std::vector<std::size_t> counts{1, 2, 3};
  for (std::size_t count = 4; count <= visits.size() / 2; count += count / 2) counts.push_back(count);
  const std::size_t looks = visits.size() * counts.size() * 2 * cells_.size();
  const std::size_t stride = 1 + looks / kEstimates;
  const double per_flown = parts_.end_s[part] / std::max(1e-9, parts_.end_s[part] - starts_[part].time_s);
  for (const std::size_t count : counts) {
    if (count >= visits.size()) continue;
    double chain_s = 0.0;
    for (std::size_t first = 0; first + count <= visits.size(); first += stride) {
      chain_s = 0.0;
      for (std::size_t i = first; i < first + count; ++i) {
        chain_s += cells_[visits[i].sub_cell].length_m() / task_.vehicle.cruise_speed_mps;
        if (i > first) chain_s += hop_s(visits[i - 1], visits[i]);
      }
      const std::size_t past = first + count;
      double gain_s = chain_s + link_s(part, visits, first, visits[first]);
      if (past < visits.size())
        gain_s += hop_s(visits[past - 1], visits[past]) - link_s(part, visits, first, visits[past]);
      for (std::size_t to = 0; to < starts_.size(); ++to) {
        if (to == part || parts_.end_s[to] >= parts_.end_s[part]) continue;
        add_insertion(part, {0.0, first, count, to, 0, false}, gain_s * per_flown, chain_s * per_flown, out);
      }
    }
  }
  std::ranges::stable_sort(out, {}, &Move::longest_s);
  return out;
}

bool Sharing::apply(const Move& move) {
  const auto busiest =
      static_cast<std::size_t>(std::ranges::max_element(parts_.end_s) - parts_.end_s.begin());
  Visits given = parts_.visits[busiest];
  Visits taken = parts_.visits[move.to];
  const auto begin = given.begin() + static_cast<std::ptrdiff_t>(move.first);
  Visits chain(begin, begin + static_cast<std::ptrdiff_t>(move.count));
  given.erase(begin, begin + static_cast<std::ptrdiff_t>(move.count));
  if (move.is_turned) chain = turned(chain);
  taken.insert(taken.begin() + static_cast<std::ptrdiff_t>(move.at), chain.begin(), chain.end());
  const double below_s = parts_.end_s[busiest] - kGain_s;
  const double taken_s = end_of(taken, move.to, below_s);
  if (!(taken_s < below_s)) return false;
  const double given_s = end_of(given, busiest, below_s);
  if (!(given_s < below_s)) return false;
  parts_.visits[busiest] = std::move(given);
  parts_.visits[move.to] = std::move(taken);
  parts_.end_s[busiest] = given_s;
  parts_.end_s[move.to] = taken_s;
  return true;
}

/// Until no move from the busiest helps. True when one did.
bool Sharing::exchange() {
  bool any = false;
  bool moved = true;
  while (moved && !is_over()) {
    moved = false;
    const auto busiest =
        static_cast<std::size_t>(std::ranges::max_element(parts_.end_s) - parts_.end_s.begin());
    const std::vector<Move> moves = moves_from(busiest);
    for (std::size_t i = 0; i < std::min(kTried, moves.size()) && !moved; ++i) moved = apply(moves[i]);
    any = any || moved;
  }
  return any;
}

Result<Parts> Sharing::run(std::span<const Visit> order) {
  cut(order);
  balance();
  if (!std::isfinite(parts_.longest_s())) deal(order);
  for (std::size_t k = 0; k < starts_.size(); ++k) improve(k);
  if (!std::isfinite(parts_.longest_s())) {
    return infeasible(
        "The sub-cells cannot be shared out among " + std::to_string(starts_.size()) +
        " aircraft: one of them would not reach any of its own with its battery from the start.");
  }
  Parts best = parts_;
  while (exchange()) {
    for (std::size_t k = 0; k < starts_.size(); ++k) improve(k);
    if (parts_.longest_s() < best.longest_s() - kGain_s) best = parts_;
    if (is_over()) break;
  }
  return best;
}

}  // namespace

std::vector<Visit> turned(std::span<const Visit> visits) {
  std::vector<Visit> out(visits.rbegin(), visits.rend());
  for (Visit& visit : out) visit.from_beta = !visit.from_beta;
  return out;
}

double Parts::longest_s() const { return *std::ranges::max_element(end_s); }

Result<Parts> share_out(std::span<const SubCell> sub_cells, std::span<const Visit> order,
                        std::span<const ScheduleStart> starts, const Task& task, const PlanOptions& options,
                        LinkCache& links) {
  return Sharing(sub_cells, starts, task, options, links).run(order);
}

}  // namespace swallowtail::coverage
