#include "coverage/maintain/strip_track.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::coverage {
namespace {

/// Positions further apart in time are joined only when the way between fits a straight flight.
constexpr double kJoined_s = 1.0;
constexpr double kStraightShare = 0.8;

}  // namespace

double StripTrack::along_m(const Vec3& position_m) const {
  const double length = length_m();
  if (length < 1e-9) return 0.0;
  return std::clamp((position_m - entry_m_).dot(exit_m_ - entry_m_) / length, 0.0, length);
}

bool StripTrack::on_line(const Vec3& position_m) const {
  const double s = along_m(position_m);
  const Vec3 nearest =
      length_m() < 1e-9 ? entry_m_ : Vec3(entry_m_ + (exit_m_ - entry_m_) * (s / length_m()));
  const Vec3 off = position_m - nearest;
  return off.head<2>().norm() <= params_.lateral_m + 1e-6 && std::abs(off.z()) <= params_.height_m + 1e-6;
}

void StripTrack::add(double time_s, const Vec3& position_m, bool covering) {
  const Sample now{time_s, along_m(position_m), on_line(position_m), covering};
  if (last_ && now.time_s <= last_->time_s) return;
  ++samples_;
  if (last_) largest_move_m_ = std::max(largest_move_m_, std::abs(now.along_m - last_->along_m));
  const double duration = last_ ? now.time_s - last_->time_s : 0.0;
  // Where it begins or ends to cover is known as finely as positions come.
  const bool begins_or_ends =
      last_ && last_->on_line && last_->covering != now.covering && duration <= kJoined_s;
  if (now.on_line && (now.covering || begins_or_ends)) {
    seen_ = true;
    Gap piece{now.along_m, now.along_m};
    // Backwards along the line is the way to its entry, not the leg.
    const bool onward = last_ && last_->on_line && now.along_m >= last_->along_m;
    if (onward && (begins_or_ends || last_->covering)) {
      const double step = now.along_m - last_->along_m;
      longest_step_m_ = std::max(longest_step_m_, step);
      if (duration <= kJoined_s || step >= kStraightShare * params_.speed_mps * duration)
        piece = {last_->along_m, now.along_m};
    }
    if (!flown_.empty() && piece.from_m <= flown_.back().to_m + 1e-9 &&
        piece.from_m >= flown_.back().from_m) {
      flown_.back().to_m = std::max(flown_.back().to_m, piece.to_m);
    } else {
      flown_.push_back(piece);
    }
  }
  last_ = now;
}

std::vector<Gap> StripTrack::merged() const {
  std::vector<Gap> sorted = flown_;
  std::sort(sorted.begin(), sorted.end(), [](const Gap& a, const Gap& b) { return a.from_m < b.from_m; });
  std::vector<Gap> out;
  for (const Gap& piece : sorted) {
    if (!out.empty() && piece.from_m <= out.back().to_m + 1e-9) {
      out.back().to_m = std::max(out.back().to_m, piece.to_m);
    } else {
      out.push_back(piece);
    }
  }
  return out;
}

std::vector<Gap> StripTrack::gaps() const {
  if (!seen_) {
    const bool watched = samples_ >= kWatched && largest_move_m_ < length_m() / 2.0;
    return watched ? std::vector<Gap>{{0.0, length_m()}} : std::vector<Gap>{};
  }
  const std::vector<Gap> flown = merged();
  const double end_slack = params_.gap_m + std::max(longest_step_m_, params_.speed_mps * 0.1);
  std::vector<Gap> out;
  if (flown.front().from_m > end_slack) out.push_back({0.0, flown.front().from_m});
  for (std::size_t i = 0; i + 1 < flown.size(); ++i) {
    if (flown[i + 1].from_m - flown[i].to_m > params_.gap_m)
      out.push_back({flown[i].to_m, flown[i + 1].from_m});
  }
  if (length_m() - flown.back().to_m > end_slack) out.push_back({flown.back().to_m, length_m()});
  return out;
}

double StripTrack::flown_from_entry_m() const {
  if (!seen_) return 0.0;
  const Gap first = merged().front();
  const double end_slack = params_.gap_m + std::max(longest_step_m_, params_.speed_mps * 0.1);
  return first.from_m <= end_slack ? first.to_m : 0.0;
}

}  // namespace swallowtail::coverage
