#include "coverage/schedule/descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/path/path.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kBetter_s = 1e-6;
constexpr std::size_t kNear = 10;
constexpr std::size_t kLongestChain = 3;
/// A longer stretch is put elsewhere only when the flight gets shorter by it: looking at it takes long.
constexpr std::size_t kLongStretch = 40;

Visit turned(const Visit& v) { return {v.sub_cell, !v.from_beta}; }
std::size_t entry_site(const Visit& v) { return 2 * v.sub_cell + (v.from_beta ? 1 : 0); }
std::size_t exit_site(const Visit& v) { return 2 * v.sub_cell + (v.from_beta ? 0 : 1); }

}  // namespace

Descent::Descent(std::span<const SubCell> cells, std::vector<Visit> visits, const ScheduleStart& start,
                 LinkCache& links, const ImproveParams& params)
    : cells_(cells),
      visits_(std::move(visits)),
      start_(start),
      links_(links),
      params_(params),
      position_(cells.size(), 0),
      is_touched_(cells.size(), 0) {
  const NearSites near(cells);
  for (std::size_t site = 0; site < 2 * cells.size(); ++site) near_.push_back(near.of(site, kNear));
  for (std::size_t i = 0; i < visits_.size(); ++i) position_[visits_[i].sub_cell] = i;
  for (std::size_t i = 0; i < visits_.size(); ++i) touch(i);
  if (params_.aim == Aim::kSchedule) {
    tolerance_s_ = 2.0 * planner::kStopToTurn_s;
    value_.emplace(links, params_.stops, start);
    const std::span<const RouteLeg> legs = route(visits_);
    value_->set({legs.begin(), legs.end()});
    ++evaluations_;
  }
  objective_s_ = value_ ? value_->end_s() : flight_s(0, visits_.size());
}

/// To, between and from the visits first … past − 1.
double Descent::flight_s(std::size_t first, std::size_t past) {
  double sum = 0.0;
  for (std::size_t i = first; i <= past; ++i) sum += hop_s(before(i), at(i));
  return sum;
}

std::span<const RouteLeg> Descent::route(std::span<const Visit> visits) {
  route_.clear();
  for (const Visit& v : visits) route_.push_back(route_leg(cells_[v.sub_cell], v));
  return route_;
}

/// Flight between two visits; none: from the start, and nothing after the last.
double Descent::hop_s(const Visit* from, const Visit* to) {
  if (to == nullptr) return 0.0;
  if (from == nullptr) return least_hop_s(from, to);
  const RouteLeg before = route_leg(cells_[from->sub_cell], *from);
  const RouteLeg after = route_leg(cells_[to->sub_cell], *to);
  return links_.get(before.id, before.flown, after.id, after.flown).hop.time_s;
}

double Descent::least_hop_s(const Visit* from, const Visit* to) const {
  if (to == nullptr) return 0.0;
  const Vec3 a = from == nullptr ? start_.position_m : flown(cells_[from->sub_cell], from->from_beta).exit_m;
  const Vec3 b = flown(cells_[to->sub_cell], to->from_beta).entry_m;
  return (b - a).head<2>().norm() / links_.model().limits().cruise_speed_mps;
}

void Descent::touch(std::size_t position) {
  if (position >= visits_.size() || position < params_.first_free) return;
  const std::size_t cell = visits_[position].sub_cell;
  if (is_touched_[cell] != 0) return;
  is_touched_[cell] = 1;
  touched_.push_back(cell);
}

void Descent::forget_touched() {
  for (const std::size_t cell : touched_) is_touched_[cell] = 0;
  touched_.clear();
}

void Descent::write(std::size_t first, std::span<const Visit> visits) {
  const std::size_t past = first + visits.size();
  std::copy(visits.begin(), visits.end(), visits_.begin() + static_cast<std::ptrdiff_t>(first));
  for (std::size_t i = first; i < past; ++i) position_[visits_[i].sub_cell] = i;
  if (changed_first_ == changed_past_) {
    changed_first_ = first;
    changed_past_ = past;
  }
  changed_first_ = std::min(changed_first_, first);
  changed_past_ = std::max(changed_past_, past);
  touch(first - 1);
  touch(first);
  touch(past - 1);
  touch(past);
}

void Descent::put(std::size_t first, std::span<const Visit> visits) {
  if (value_) {
    value_->replace(first, route(visits));
    write(first, visits);
    objective_s_ = value_->end_s();
    return;
  }
  const double was = flight_s(first, first + visits.size());
  write(first, visits);
  objective_s_ += flight_s(first, first + visits.size()) - was;
}

bool Descent::is_worth_it(double gain_s, std::size_t length) const {
  if (!value_) return gain_s > kBetter_s;
  return gain_s > (length > kLongStretch ? kBetter_s : -tolerance_s_);
}

/// candidate_ in place of the visits from `first` on, if that is better.
bool Descent::accept(std::size_t first, double gain_s) {
  if (value_) {
    if (stopped()) return false;
    ++evaluations_;
    const std::span<const RouteLeg> legs = route(candidate_);
    const double end = value_->end_with(first, legs, objective_s_ - kBetter_s);
    if (!std::isfinite(end)) return false;
    value_->replace(first, legs);
    objective_s_ = value_->end_s();
  } else {
    objective_s_ -= gain_s;
  }
  write(first, candidate_);
  return true;
}

/// Less flight between the visits of a stretch, its ends included, once it is turned round: wind, climbs and
/// descents make a hop differ from its way back. A schedule is judged as a whole instead.
double Descent::turning_gain_s(std::size_t first, std::size_t last) {
  double gain = 0.0;
  for (std::size_t i = first; i < last && !value_; ++i) {
    const Visit from = turned(visits_[i + 1]);
    const Visit to = turned(visits_[i]);
    gain += hop_s(at(i), at(i + 1)) - hop_s(&from, &to);
  }
  return gain;
}

/// Turns the stretch first … last round.
bool Descent::try_reversal(std::size_t first, std::size_t last) {
  if (first < params_.first_free || last >= visits_.size() || first > last) return false;
  const Visit head = turned(visits_[last]);
  const Visit tail = turned(visits_[first]);
  const double now = hop_s(before(first), at(first)) + hop_s(at(last), at(last + 1));
  if (!is_worth_it(now - least_hop_s(before(first), &head) - least_hop_s(&tail, at(last + 1)),
                   last - first + 1))
    return false;
  double gain = now - hop_s(before(first), &head) - hop_s(&tail, at(last + 1));
  if (!is_worth_it(gain, last - first + 1)) return false;
  gain += turning_gain_s(first, last);
  if (!is_worth_it(gain, last - first + 1)) return false;
  candidate_.assign(visits_.begin() + static_cast<std::ptrdiff_t>(first),
                    visits_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  std::reverse(candidate_.begin(), candidate_.end());
  for (Visit& v : candidate_) v.from_beta = !v.from_beta;
  return accept(first, gain);
}

/// Takes `count` visits from `first` on and puts them between `to` − 1 and `to` (positions before the
/// removal, outside the chain).
bool Descent::try_move(std::size_t first, std::size_t count, std::size_t to, Turn turn) {
  if (first < params_.first_free || to < params_.first_free || first + count > visits_.size() ||
      to > visits_.size() || (to >= first && to <= first + count))
    return false;
  const std::size_t past = first + count;
  const Visit head = turn == Turn::kYes ? turned(visits_[past - 1]) : visits_[first];
  const Visit tail = turn == Turn::kYes ? turned(visits_[first]) : visits_[past - 1];
  const std::size_t begin = std::min(first, to);
  const std::size_t end = std::max(past, to);
  const double now =
      hop_s(before(first), at(first)) + hop_s(at(past - 1), at(past)) + hop_s(before(to), at(to));
  const double least =
      least_hop_s(before(first), at(past)) + least_hop_s(before(to), &head) + least_hop_s(&tail, at(to));
  if (!is_worth_it(now - least, end - begin)) return false;
  double gain = now - hop_s(before(first), at(past)) - hop_s(before(to), &head) - hop_s(&tail, at(to));
  if (turn == Turn::kYes) gain += turning_gain_s(first, past - 1);
  if (!is_worth_it(gain, end - begin)) return false;
  const auto place = [this](std::size_t i) { return visits_.begin() + static_cast<std::ptrdiff_t>(i); };
  candidate_.clear();
  if (to > first) candidate_.insert(candidate_.end(), place(past), place(to));
  const std::size_t chain = candidate_.size();
  candidate_.insert(candidate_.end(), place(first), place(past));
  if (turn == Turn::kYes) {
    std::reverse(candidate_.begin() + static_cast<std::ptrdiff_t>(chain), candidate_.end());
    for (std::size_t i = chain; i < candidate_.size(); ++i)
      candidate_[i].from_beta = !candidate_[i].from_beta;
  }
  if (to < first) candidate_.insert(candidate_.end(), place(to), place(first));
  if (!accept(begin, gain)) return false;
  // The places inside the stretch where visits have new neighbours.
  const std::size_t inner = to > first ? begin + chain : begin + count;
  touch(inner - 1);
  touch(inner);
  return true;
}

bool Descent::try_chains_from(std::size_t first, std::size_t to, Turn turn) {
  for (std::size_t count = 1; count <= kLongestChain; ++count) {
    if (try_move(first, count, to, turn)) return true;
  }
  return false;
}

bool Descent::try_chains_to(std::size_t last, std::size_t to, Turn turn) {
  for (std::size_t count = 1; count <= std::min(kLongestChain, last + 1); ++count) {
    if (try_move(last + 1 - count, count, to, turn)) return true;
  }
  return false;
}

/// Makes the site near this leg's exit what follows it.
bool Descent::improve_exit(std::size_t cell, const NearSites::Near& near) {
  const std::size_t p = position_[cell];
  const std::size_t q = position_[near.site / 2];
  if (near.site == entry_site(visits_[q]))
    return try_chains_from(q, p + 1, Turn::kNo) || try_chains_to(p, q, Turn::kNo);
  return (p < q ? try_reversal(p + 1, q) : try_reversal(q + 1, p)) || try_chains_to(q, p + 1, Turn::kYes) ||
         try_chains_to(p, q + 1, Turn::kYes);
}

/// Makes the site near this leg's entry what comes before it.
bool Descent::improve_entry(std::size_t cell, const NearSites::Near& near) {
  const std::size_t p = position_[cell];
  const std::size_t q = position_[near.site / 2];
  if (near.site == exit_site(visits_[q]))
    return try_chains_from(p, q + 1, Turn::kNo) || try_chains_to(q, p, Turn::kNo);
  return (p < q ? try_reversal(p, q - 1) : try_reversal(q, p - 1)) || try_chains_from(p, q, Turn::kYes) ||
         try_chains_from(q, p, Turn::kYes);
}

/// Moves that need no neighbour: to the ends of the order.
bool Descent::improve_ends(std::size_t cell) {
  const std::size_t p = position_[cell];
  const std::size_t n = visits_.size();
  return try_reversal(p, p) || try_reversal(p, n - 1) || try_reversal(params_.first_free, p) ||
         try_chains_from(p, n, Turn::kNo) || try_chains_from(p, n, Turn::kYes) ||
         try_chains_from(p, params_.first_free, Turn::kNo) ||
         try_chains_from(p, params_.first_free, Turn::kYes);
}

bool Descent::improve_around(std::size_t cell) {
  for (const NearSites::Near& near : near_[exit_site(visits_[position_[cell]])]) {
    if (improve_exit(cell, near)) return true;
  }
  for (const NearSites::Near& near : near_[entry_site(visits_[position_[cell]])]) {
    if (improve_entry(cell, near)) return true;
  }
  return improve_ends(cell);
}

void Descent::run() {
  while (!touched_.empty()) {
    const std::size_t cell = touched_.front();
    touched_.pop_front();
    is_touched_[cell] = 0;
    while (!stopped() && improve_around(cell)) {
    }
    if (stopped()) return;
  }
}

}  // namespace swallowtail::coverage
