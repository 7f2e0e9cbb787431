#include <algorithm>
#include <cmath>
#include <string>

#include "coverage/maintain/plan_keeper.hpp"

/// How PlanKeeper follows what of the legs is flown.
namespace swallowtail::coverage {
namespace {

constexpr double kGapOverlap_m = 0.5;
constexpr std::size_t kMostPassedOver = 32;  ///< legs that are watched besides the one under way

}  // namespace

void PlanKeeper::finish_leg(std::size_t leg) {
  if (!track_ || tracked_leg_ != leg) return;
  const Leg flown = plan_.legs[leg];
  const double length = track_->length_m();
  const std::vector<Gap> gaps = track_->gaps();
  for (const Gap& gap : gaps) {
    int& tries = tries_[flown.sub_cell_id];
    if (tries >= params_.gap_tries || length < 1e-6) {
      unflown_m_ += gap.to_m - gap.from_m;
      given_up_ = std::to_string(std::lround(std::ceil(unflown_m_))) +
                  " m of strips given up, the last of sub-cell " + std::to_string(flown.sub_cell_id) +
                  " after " + std::to_string(tries + 1) + " tries";
      gives_up_ = true;
      continue;
    }
    const Vec3 along = (flown.exit_m - flown.entry_m) / length;
    Leg piece = flown;
    piece.sub_cell_id = next_id_++;
    piece.entry_m = flown.entry_m + along * std::max(0.0, gap.from_m - kGapOverlap_m);
    piece.exit_m = flown.entry_m + along * std::min(length, gap.to_m + kGapOverlap_m);
    piece.transfer = Transfer::kFF;
    tries_[piece.sub_cell_id] = tries + 1;
    gaps_.push_back(piece);
  }
  if (!gaps.empty()) plan_.legs[leg] = flown_part(flown, gaps);
}

/// The longest stretch of a leg that was left out in part; nothing of it is covered where that has no end at
/// the leg's exit, and the way on or down begins there.
Leg PlanKeeper::flown_part(Leg leg, const std::vector<Gap>& gaps) const {
  const double length = track_->length_m();
  const bool is_exit_free = leg.transfer == Transfer::kFF && leg.transfer_m.empty();
  Gap longest;
  double from_m = 0.0;
  for (std::size_t i = 0; i <= gaps.size(); ++i) {
    const bool is_last = i == gaps.size();
    const double to_m = is_last ? length : gaps[i].from_m;
    if ((is_last || is_exit_free) && to_m - from_m > longest.to_m - longest.from_m) longest = {from_m, to_m};
    if (!is_last) from_m = gaps[i].to_m;
  }
  if (!(longest.to_m - longest.from_m > 1e-6)) {
    leg.kind = LegKind::kReposition;
    leg.entry_m = leg.exit_m;
    return leg;
  }
  const Vec3 along = (leg.exit_m - leg.entry_m) / length;
  if (longest.to_m < length) leg.exit_m = leg.entry_m + along * longest.to_m;
  leg.entry_m += along * longest.from_m;
  return leg;
}

TrackParams PlanKeeper::track_params() const {
  return {0.5, std::max(0.5, task_.height_tolerance_m), 0.5, task_.vehicle.cruise_speed_mps};
}

/// The next leg was never under way, and is longer than what can be flown in that time: nothing of it is.
void PlanKeeper::miss_leg(double duration_s) {
  const Leg& leg = plan_.legs[plan_.legs_done];
  const double most_m = task_.vehicle.cruise_speed_mps * duration_s + kGapOverlap_m;
  if (leg.kind != LegKind::kCover || (leg.exit_m - leg.entry_m).norm() <= most_m) return;
  track_.emplace(leg, track_params());
  track_->miss();
  tracked_leg_ = plan_.legs_done;
}

/// A leg is watched while it is flown, and while a later one is: the planner passes over legs where something
/// stands.
void PlanKeeper::watch(const AircraftView& vehicle) {
  const TrackParams params = track_params();
  const std::size_t past =
      std::min({vehicle.leg_index + 1, plan_.legs.size(), plan_.legs_done + kMostPassedOver});
  for (std::size_t i = plan_.legs_done; i < past; ++i) {
    if (plan_.legs[i].kind != LegKind::kCover) continue;
    if (i == plan_.legs_done) {
      if (!track_ || tracked_leg_ != i) track_.emplace(plan_.legs[i], params);
      tracked_leg_ = i;
      track_->add(vehicle.time_s, vehicle.position_m, vehicle.covering);
    } else {
      later_.try_emplace(i, plan_.legs[i], params)
          .first->second.add(vehicle.time_s, vehicle.position_m, vehicle.covering);
    }
  }
}

void PlanKeeper::follow_progress(const std::optional<AircraftView>& before, const AircraftView& vehicle) {
  const std::size_t done = std::min(vehicle.legs_done, plan_.legs.size());
  while (plan_.legs_done < done) {
    if (track_ && tracked_leg_ == plan_.legs_done) {
      track_->add(vehicle.time_s, vehicle.position_m, vehicle.covering);
    } else if (before) {
      miss_leg(vehicle.time_s - before->time_s);
    }
    finish_leg(plan_.legs_done);
    ++plan_.legs_done;
    track_.reset();
    if (const auto begun = later_.find(plan_.legs_done); begun != later_.end()) {
      track_ = begun->second;
      tracked_leg_ = plan_.legs_done;
    }
    later_.erase(later_.begin(), later_.upper_bound(plan_.legs_done));
  }
  // A meeting before a leg that is flown is over, whether it was kept or not.
  std::erase_if(plan_.rendezvous,
                [&](const Rendezvous& meeting) { return legs_before(meeting.id) < plan_.legs_done; });
  if (!vehicle.on_ground()) watch(vehicle);
}

}  // namespace swallowtail::coverage
