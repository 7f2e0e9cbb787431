#include "planner/replan/route_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/replan/corridor_search.hpp"

namespace swallowtail::planner {
namespace {

/// How far before and after a blockage a detour leaves and rejoins, in clearances, by attempt.
constexpr std::array kReaches{1.0, 4.0, 12.0, 40.0};
/// The same for a stop to wait.
constexpr std::array kStandOffs{0.5, 2.0, 6.0, 20.0, 60.0};
constexpr double kWaitStep_s = 1.0;
/// Waits are longer than the stop that a turn needs.
constexpr double kShortestWait_s = 1.5;
/// What counts as free keeps this share of the clearance more.
constexpr double kFreeMargin = 0.02;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Before the landing's vertical part, if the route ends with one.
double latest_rejoin_s(const TimedPath& path) {
  double latest_s = path.back().time_s;
  for (std::size_t i = path.size() - 1; i > 0 && path[i].phase == Phase::kLanding; --i)
    latest_s = path[i - 1].time_s;
  return latest_s;
}

DetourEnds detour_ends(const TimedRoute& timed, double leave_s, double rejoin_s) {
  DetourEnds ends;
  ends.from_m = position_at(timed.path, leave_s);
  ends.to_m = position_at(timed.path, rejoin_s);
  ends.from_time_s = leave_s;
  if (leave_s > timed.path.front().time_s) {
    const std::size_t i = timed.segment_at(leave_s);
    ends.before = timed.path[i].position_m - timed.path[i - 1].position_m;
  }
  const std::size_t j = timed.segment_at(rejoin_s);
  ends.after = timed.path[j].position_m - timed.path[j - 1].position_m;
  return ends;
}

/// Waypoints that lie on each other are one.
std::vector<Vec3> distinct(const std::vector<Vec3>& waypoints, double apart_m) {
  std::vector<Vec3> corners;
  for (const Vec3& p : waypoints) {
    if (corners.empty() || (p - corners.back()).norm() > apart_m) corners.push_back(p);
  }
  return corners;
}

bool is_ground_phase(Phase phase) { return phase == Phase::kTakeOff || phase == Phase::kLanding; }

}  // namespace

RouteRepair::RouteRepair(std::shared_ptr<const World> world, const ClearanceQuery& query,
                         const VehicleLimits& limits, const Replanner::Params& params,
                         const StopCondition& stop, const TimedPath& previous)
    : world_(std::move(world)),
      query_(query),
      limits_(limits),
      params_(params),
      stop_(stop),
      previous_(previous),
      field_(world_, limits) {
  field_.set_slope_share(slope_share_);
}

std::optional<Violation> RouteRepair::first_violation(const TimedPath& path, std::size_t from,
                                                      std::size_t to) const {
  const TimedPath part(path.begin() + static_cast<std::ptrdiff_t>(from),
                       path.begin() + static_cast<std::ptrdiff_t>(std::min(to + 1, path.size())));
  const Certificate certificate = certify(part, query_, limits_);
  if (certificate.certified) return std::nullopt;
  if (certificate.violations.empty()) return Violation{};
  Violation first = certificate.violations.front();
  for (const Violation& v : certificate.violations) {
    if (v.segment < first.segment) first = v;
  }
  first.segment += from;
  return first;
}

double RouteRepair::step_s() const {
  return std::max(0.25 * limits_.clearance_m(), 0.05) / limits_.cruise_speed_mps;
}

bool RouteRepair::point_blocked(const TimedRoute& timed, double time_s, double margin_m) const {
  const Vec3 p = position_at(timed.path, time_s);
  const TimedWaypoint& segment = timed.path[timed.segment_at(time_s)];
  if (!is_ground_phase(segment.phase) && field_.terrain_violation_m(p, p) > 0.0) return true;
  for (std::size_t i = 0; i < field_.size(); ++i) {
    if (!field_.near(i, p, time_s, p, time_s, margin_m)) continue;
    if (field_.approach(i, p, time_s, p, time_s).signed_distance_m < field_.required_m(i) + margin_m)
      return true;
  }
  return false;
}

Blockage RouteRepair::find_blockage(const TimedRoute& timed, const Violation& violation) const {
  const TimedPath& path = timed.path;
  const std::size_t segment = std::min(std::max<std::size_t>(violation.segment, 1), path.size() - 1);
  const TimedWaypoint& a = path[segment - 1];
  const TimedWaypoint& b = path[segment];
  Blockage blockage;
  blockage.obstacle_id = violation.kind == ViolationKind::kObstacle ? violation.obstacle_id : 0;
  blockage.on_cover = b.phase == Phase::kCover;
  double blocked_s = std::clamp(violation.time_s, a.time_s, b.time_s);
  // The certifier tells the worst of a segment; another obstacle may come before it.
  for (std::size_t i = 0; i < field_.size(); ++i) {
    if (field_.violation_m(i, a.position_m, a.time_s, b.position_m, b.time_s) <= 0.0) continue;
    const Approach approach = field_.approach(i, a.position_m, a.time_s, b.position_m, b.time_s);
    const double nearest_s = a.time_s + approach.fraction * (b.time_s - a.time_s);
    if (field_.id(i) != blockage.obstacle_id && nearest_s >= blocked_s) continue;
    blocked_s = std::min(blocked_s, nearest_s);
    blockage.obstacle_id = field_.id(i);
    blockage.moves = field_.moves(i) || std::isfinite(field_.solids()[i].valid_until_s);
  }
  const double margin_m = kFreeMargin * limits_.clearance_m();
  double begins_s = blocked_s;
  while (begins_s > path.front().time_s && point_blocked(timed, begins_s, margin_m)) begins_s -= step_s();
  double ends_s = blocked_s;
  const double end_s = timed.end_time_s();
  while (ends_s <= end_s && point_blocked(timed, ends_s, margin_m)) ends_s += step_s();
  blockage.begins_s = std::max(begins_s, path.front().time_s);
  blockage.ends_s = ends_s > end_s ? kInfinity : ends_s;
  return blockage;
}

std::optional<RouteRepair::Candidate> RouteRepair::judge(const TimedRoute& timed,
                                                         const Splice& change) const {
  Candidate candidate{splice(timed, change, limits_), 0.0, change.wait_s};
  const Spliced& spliced = candidate.spliced;
  const std::size_t first = std::min(frontier_, spliced.leave_index);
  const std::size_t from = first > 0 ? first - 1 : 0;
  if (first_violation(spliced.timed.path, from, spliced.rejoin_index)) return std::nullopt;
  candidate.rejoin_s = spliced.timed.path[spliced.rejoin_index].time_s;
  return candidate;
}

bool RouteRepair::stretch_clear_after(const TimedRoute& timed, double from_s, double to_s,
                                      double wait_s) const {
  const Vec3 hold = position_at(timed.path, from_s);
  if (field_.violation_m(hold, from_s, hold, from_s + wait_s) > 0.0) return false;
  Vec3 at = hold;
  double at_s = from_s;
  for (std::size_t i = timed.segment_at(from_s); i < timed.path.size() && at_s < to_s; ++i) {
    const double until_s = std::min(timed.path[i].time_s, to_s);
    const Vec3 until = position_at(timed.path, until_s);
    if (field_.violation_m(at, at_s + wait_s, until, until_s + wait_s) > 0.0) return false;
    at = until;
    at_s = until_s;
  }
  return true;
}

std::optional<RouteRepair::Candidate> RouteRepair::try_wait(const TimedRoute& timed, const Blockage& blockage,
                                                            double earliest_s) {
  if (!blockage.moves) return std::nullopt;
  const double to_s = std::isinf(blockage.ends_s) ? timed.end_time_s() : blockage.ends_s;
  std::optional<Candidate> best;
  for (const double stand_off : kStandOffs) {
    const double back_s = stand_off * limits_.clearance_m() / limits_.cruise_speed_mps;
    const double leave_s = std::max(earliest_s, blockage.begins_s - back_s);
    for (double wait_s = kShortestWait_s; wait_s <= params_.max_wait_s; wait_s += kWaitStep_s) {
      ++evaluations_;
      if (best && wait_s >= best->waited_s) break;
      if (!stretch_clear_after(timed, leave_s, to_s, wait_s)) continue;
      std::optional<Candidate> candidate = judge(timed, {leave_s, to_s, wait_s, true, {}});
      if (candidate) best = std::move(candidate);
      if (candidate || stop_.reached(evaluations_, 0)) break;
    }
    if (leave_s <= earliest_s || stop_.reached(evaluations_, 0)) break;
  }
  return best;
}

std::vector<Vec3> RouteRepair::previous_way(const Vec3& from, const Vec3& to) const {
  const double near = 0.5 * (to - from).norm();
  std::size_t first = previous_.size();
  std::size_t last = previous_.size();
  double best_from = near;
  double best_to = near;
  for (std::size_t i = 0; i < previous_.size(); ++i) {
    const double to_from = (previous_[i].position_m - from).norm();
    const double to_to = (previous_[i].position_m - to).norm();
    if (to_from < best_from) {
      best_from = to_from;
      first = i;
    }
    if (to_to < best_to) {
      best_to = to_to;
      last = i;
    }
  }
  std::vector<Vec3> corners;
  if (first >= previous_.size() || last >= previous_.size() || last < first || last - first > 64)
    return corners;
  for (std::size_t i = first; i <= last; ++i) corners.push_back(previous_[i].position_m);
  return corners;
}

std::optional<RouteRepair::Candidate> RouteRepair::try_detour(const TimedRoute& timed,
                                                              const Blockage& blockage, double earliest_s,
                                                              int attempt) {
  if (std::isinf(blockage.ends_s)) return std::nullopt;
  const double reach = kReaches[static_cast<std::size_t>(attempt)] * (blockage.on_cover ? 1.0 : 3.0);
  const double reach_s = reach * limits_.clearance_m() / limits_.cruise_speed_mps;
  const double leave_s = std::max(earliest_s, blockage.begins_s - reach_s);
  const double latest_s = latest_rejoin_s(timed.path);
  double rejoin_s = std::min(latest_s, blockage.ends_s + reach_s);
  while (rejoin_s < latest_s && point_blocked(timed, rejoin_s, kFreeMargin * limits_.clearance_m()))
    rejoin_s += step_s();
  rejoin_s = std::min(rejoin_s, latest_s);
  if (rejoin_s <= leave_s) return std::nullopt;
  const DetourEnds ends = detour_ends(timed, leave_s, rejoin_s);
  if ((ends.to_m - ends.from_m).norm() < 0.1 * limits_.clearance_m()) return std::nullopt;

  const DetourProblem problem(field_, limits_, ends, params_.detour_waypoints, DetourObjective::kTime);
  const CorridorParams search{
      .population = params_.population, .iterations_per_round = 12, .max_rounds = 3, .idle_rounds = 0};
  std::vector<std::vector<Vec3>> guesses;
  if (std::vector<Vec3> way = previous_way(ends.from_m, ends.to_m); !way.empty()) {
    guesses.push_back(resample(ends.from_m, std::move(way), ends.to_m, params_.detour_waypoints));
  }
  StopCondition stop = stop_;
  if (stop.max_evaluations != std::numeric_limits<std::uint64_t>::max()) {
    stop.max_evaluations -= std::min(stop.max_evaluations, evaluations_);
  }
  const std::uint64_t seed = params_.seed + 7919ULL * static_cast<std::uint64_t>(detours_ + waits_) +
                             static_cast<std::uint64_t>(attempt);
  std::optional<Candidate> best;
  const auto accept = [&](const Corridor& corridor, std::uint64_t) {
    const std::vector<Vec3> corners = distinct(corridor.waypoints, 1e-3 * problem.distance_m());
    std::optional<Candidate> candidate = judge(timed, {leave_s, rejoin_s, 0.0, false, corners});
    if (!candidate) return false;
    if (!best || candidate->rejoin_s < best->rejoin_s) best = std::move(candidate);
    return true;
  };
  Result<CorridorReport> found = search_corridor(problem, search, stop, seed, guesses, accept);
  if (found) evaluations_ += found->evaluations;
  return best;
}

bool RouteRepair::repair_stretch(TimedRoute& timed, const Violation& violation) {
  const Blockage blockage = find_blockage(timed, violation);
  double airborne_s = timed.path.front().time_s;
  for (std::size_t i = 1; i < timed.path.size() && timed.path[i].phase == Phase::kTakeOff; ++i) {
    airborne_s = timed.path[i].time_s;
  }
  double earliest_s = std::max(timed.path[frontier_].time_s, airborne_s);
  const bool in_take_off = blockage.begins_s < earliest_s && frontier_ == 0;
  std::optional<Candidate> waiting =
      try_wait(timed, blockage, in_take_off ? timed.path.front().time_s : earliest_s);
  std::optional<Candidate> detour;
  const bool wants_detour = !waiting || !blockage.on_cover;
  for (int attempt = 0; wants_detour && !detour && attempt < static_cast<int>(kReaches.size()); ++attempt) {
    if (stop_.reached(evaluations_, 0)) break;
    // After two attempts the ground is taken to be as steep as it gets anywhere.
    if (attempt == 2 && !world_->terrain().is_flat()) field_.set_slope_share(1.0);
    detour = try_detour(timed, blockage, earliest_s, attempt);
    // Where the way on from the last repair is shut, that repair itself is replaced.
    earliest_s = airborne_s;
  }
  field_.set_slope_share(slope_share_);
  if (!waiting && !detour) {
    goal_is_blocked_ = std::isinf(blockage.ends_s);
    out_of_time_ = stop_.reached(evaluations_, 0);
    return false;
  }
  // Both are compared by how much later the rest of the route is flown.
  const auto delay_s = [&](const Candidate& c) { return c.spliced.timed.end_time_s() - timed.end_time_s(); };
  const bool waits = waiting && (!detour || delay_s(*waiting) <= delay_s(*detour));
  Candidate& chosen = waits ? *waiting : *detour;
  if (waits) {
    ++waits_;
    waited_s_ += chosen.waited_s;
    waited_for_ = blockage.obstacle_id;
  } else {
    ++detours_;
    skipped_cover_m_ += chosen.spliced.skipped_cover_m;
  }
  frontier_ = chosen.spliced.rejoin_index;
  timed = std::move(chosen.spliced.timed);
  return true;
}

bool RouteRepair::repair(TimedRoute& timed) {
  frontier_ = 0;
  for (int stretch = 0; stretch <= Replanner::kMaxStretches; ++stretch) {
    const std::size_t from = frontier_ > 0 ? frontier_ - 1 : 0;
    const std::optional<Violation> violation = first_violation(timed.path, from, timed.path.size() - 1);
    if (!violation) return true;
    blocked_ = *violation;
    const bool repairable =
        violation->kind == ViolationKind::kObstacle || violation->kind == ViolationKind::kTerrain;
    if (!repairable || stretch == Replanner::kMaxStretches) return false;
    if (stop_.reached(evaluations_, 0)) {
      out_of_time_ = true;
      return false;
    }
    if (!repair_stretch(timed, *violation)) return false;
  }
  return false;
}

std::string RouteRepair::summary() const {
  std::string text;
  if (detours_ > 0) text = std::to_string(detours_) + (detours_ == 1 ? " detour" : " detours");
  if (waits_ > 0) {
    text += text.empty() ? "" : ", ";
    text += "waits " + std::to_string(static_cast<int>(std::ceil(waited_s_))) + " s for obstacle " +
            std::to_string(waited_for_);
  }
  if (skipped_cover_m_ > 0.0) {
    text += ", skips " + std::to_string(static_cast<int>(std::ceil(skipped_cover_m_))) + " m of strips";
  }
  return text;
}

}  // namespace swallowtail::planner
