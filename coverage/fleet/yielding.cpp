#include <algorithm>
#include <cmath>

#include "coverage/fleet/separation.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kStep_s = 1.0;
constexpr double kTouch_s = Times::kTouch_s;

/// A place to wait in, and how long it is free.
class Place {
 public:
  Place(const TimedPiece& own, std::span<const TimedPiece> others, const Separation& separation,
        std::size_t steps)
      : own_(own), until_s_(steps, kInfinity) {
    for (const TimedPiece& other : others) {
      if (!boxes_meet(own, other, separation)) continue;
      const Times taken =
          close_times(standing(own.from_m, other.start_s, other.end_s), 0.0, other, separation);
      if (taken.last()) take(taken);
    }
  }
  /// From its begin so many steps late to its end so much later.
  bool is_free(std::size_t step, double to_late_s) const { return own_.end_s + to_late_s <= until_s_[step]; }

 private:
  void take(const Times& taken) {
    for (std::size_t step = 0; step < until_s_.size(); ++step) {
      const double from_s = own_.start_s + kStep_s * static_cast<double>(step);
      if (taken.to_s <= from_s + kTouch_s) return;
      until_s_[step] = std::min(until_s_[step], std::max(from_s, taken.from_s) + kTouch_s);
    }
  }

  TimedPiece own_;
  std::vector<double> until_s_;
};

/// How many steps late a chain of pieces meets others.
class Shifts {
 public:
  Shifts(std::span<const TimedPiece> own, std::span<const TimedPiece> others, const Separation& separation,
         std::size_t steps)
      : shut_(steps, 0) {
    for (const TimedPiece& piece : own) {
      for (const TimedPiece& other : others) {
        if (boxes_meet(piece, other, separation)) shut(piece, other, separation);
      }
    }
  }
  bool is_free(std::size_t step) const { return step < shut_.size() && shut_[step] == 0; }

 private:
  void shut(const TimedPiece& own, const TimedPiece& other, const Separation& separation) {
    Times near{own.start_s, own.end_s};
    if (other.from_m == other.to_m) {
      // Near one that stands it is at the same times of its own, however late.
      TimedPiece always = other;
      always.start_s = own.start_s;
      always.end_s = own.end_s;
      near = close_times(own, 0.0, always, separation);
      if (!near.last()) return;
    }
    const double first = std::floor((other.start_s - near.to_s) / kStep_s);
    const double last = std::ceil((other.end_s - near.from_s) / kStep_s);
    if (!(last >= 0.0)) return;
    const auto from = static_cast<std::size_t>(std::max(0.0, first));
    const auto to = std::min(shut_.size(), static_cast<std::size_t>(std::min(last, 1e9)) + 1);
    for (std::size_t step = from; step < to; ++step) {
      if (shut_[step] == 0 && conflict(own, kStep_s * static_cast<double>(step), other, separation))
        shut_[step] = 1;
    }
  }

  std::vector<char> shut_;
};

class Yielding {
 public:
  Yielding(const Trace& mover, std::span<const Trace> others, const Separation& separation, double most_s)
      : mover_(mover),
        steps_(static_cast<std::size_t>(std::ceil(most_s / kStep_s)) + 1),
        shifts_(mover.stretches.size(), 0),
        waits_(mover.stretches.size(), 0),
        failed_(mover.stretches.size() + 1, std::vector<char>(steps_, 0)) {
    std::vector<TimedPiece> all;
    for (const Trace& other : others) {
      const std::vector<TimedPiece> pieces = pieces_of(other);
      all.insert(all.end(), pieces.begin(), pieces.end());
    }
    for (const Stretch& stretch : mover.stretches) {
      stands_.emplace_back();
      for (const Vec3& stand : stretch.stands_m)
        stands_.back().emplace_back(standing(stand, stretch.stands_from_s, stretch.take_off_s), all,
                                    separation, steps_);
      const Drive& drive = stretch.drive;
      flights_.emplace_back(stretch.pieces, all, separation, steps_);
      before_drives_.emplace_back(drive.stand_before(), all, separation, steps_);
      drives_.emplace_back(drive.pieces, all, separation, steps_);
      after_drives_.emplace_back(drive.pieces.empty() ? drive.stand_before() : drive.stand_after(), all,
                                 separation, steps_);
    }
    end_.emplace_back(standing(mover.end_m, mover.end_s, kInfinity), all, separation, steps_);
  }

  std::optional<Delays> run() {
    if (!place(0, 0)) return std::nullopt;
    Delays out;
    for (const std::size_t shift : shifts_) out.stretch_s.push_back(kStep_s * static_cast<double>(shift));
    for (const std::size_t wait : waits_) out.robot_s.push_back(kStep_s * static_cast<double>(wait));
    return out;
  }

 private:
  /// The least wait of the robot with which it meets nobody.
  bool drive(std::size_t k, std::size_t shift) {
    const double shift_s = kStep_s * static_cast<double>(shift);
    const double slack_s = mover_.stretches[k].drive.slack_s();
    for (std::size_t wait = 0; shift + wait < steps_; ++wait) {
      const double wait_s = kStep_s * static_cast<double>(wait);
      if (wait > 0 && wait_s > slack_s) return false;
      if (!before_drives_[k].is_free(shift, shift_s + wait_s)) return false;
      if (!drives_[k].is_free(shift + wait) || !after_drives_[k].is_free(shift + wait, shift_s)) continue;
      waits_[k] = wait;
      return true;
    }
    return false;
  }

  /// Stretches from `k` on, the one before `before` steps late.
  bool place(std::size_t k, std::size_t before) {
    if (failed_[k][before] != 0) return false;
    if (k == shifts_.size()) {
      if (end_.front().is_free(before, kStep_s * static_cast<double>(before))) return true;
      failed_[k][before] = 1;
      return false;
    }
    std::size_t shift = before;
    for (; shift < steps_; ++shift) {
      const double shift_s = kStep_s * static_cast<double>(shift);
      const bool may_wait =
          std::ranges::all_of(stands_[k], [&](const Place& stand) { return stand.is_free(before, shift_s); });
      if (!may_wait) break;
      if (!flights_[k].is_free(shift) || failed_[k + 1][shift] != 0 || !drive(k, shift) ||
          !place(k + 1, shift))
        continue;
      shifts_[k] = shift;
      return true;
    }
    // Nor from any step waited through: nothing else comes after it.
    for (std::size_t step = before; step < std::max(shift, before + 1); ++step) failed_[k][step] = 1;
    return false;
  }

  const Trace& mover_;
  std::size_t steps_;
  std::vector<std::size_t> shifts_;
  std::vector<std::size_t> waits_;
  std::vector<std::vector<char>> failed_;
  std::vector<std::vector<Place>> stands_;
  std::vector<Shifts> flights_;
  std::vector<Place> before_drives_;
  std::vector<Shifts> drives_;
  std::vector<Place> after_drives_;
  std::vector<Place> end_;
};

}  // namespace

std::optional<Delays> delays_of(const Trace& mover, std::span<const Trace> others,
                                const Separation& separation, double most_s) {
  return Yielding(mover, others, separation, most_s).run();
}

void delay(Plan& plan, const Trace& trace, const Delays& delays) {
  const std::vector<double>& stretch_s = delays.stretch_s;
  for (std::size_t i = 0; i < plan.legs.size(); ++i) {
    plan.legs[i].start_s += stretch_s[trace.stretch_of_leg[i]];
    plan.legs[i].end_s += stretch_s[trace.stretch_of_leg[i]];
  }
  for (std::size_t i = 0; i < plan.rendezvous.size(); ++i) {
    Rendezvous& meeting = plan.rendezvous[i];
    meeting.robot_arrives_s += stretch_s[i] + delays.robot_s[i];
    meeting.land_s += stretch_s[i];
    meeting.arrive_by_s += stretch_s[i];
    meeting.depart_s += stretch_s[i + 1];
  }
  for (DepotVisit& visit : plan.depot_visits) {
    visit.arrives_s += stretch_s[visit.before] + delays.robot_s[visit.before];
    visit.leaves_s += stretch_s[visit.before] + delays.robot_s[visit.before];
  }
  if (plan.robot_home_s > 0.0) plan.robot_home_s += stretch_s.back() + delays.robot_s.back();
  plan.take_off_s += stretch_s.front();
  plan.makespan_s += stretch_s.back();
  plan.cost = plan.makespan_s;
}

}  // namespace swallowtail::coverage
