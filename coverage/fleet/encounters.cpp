#include "coverage/fleet/encounters.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "coverage/energy/battery.hpp"

namespace swallowtail::coverage {
namespace {

/// Straight at an even speed, or standing.
struct Motion {
  Vec2 from_m = Vec2::Zero();
  Vec2 to_m = Vec2::Zero();
  double start_s = 0.0;
  double end_s = 0.0;
  bool drives = false;

  Vec2 at(double time_s) const {
    const double length_s = end_s - start_s;
    if (!(length_s > 0.0) || !drives) return drives ? to_m : from_m;
    return from_m + (to_m - from_m) * ((time_s - start_s) / length_s);
  }
};

class Track {
 public:
  explicit Track(const Member& member) : at_m_(member.task.charger.start_m.head<2>()) {
    const Charger& charger = member.task.charger;
    const Vec3 depot_m = charger.start_m;
    auto visit = member.plan.depot_visits.begin();
    for (std::size_t i = 0; i < member.plan.rendezvous.size(); ++i) {
      const Rendezvous& meeting = member.plan.rendezvous[i];
      if (visit != member.plan.depot_visits.end() && visit->before == i) {
        drive(visit->bends_m, depot_m, charger);
        stand(visit->leaves_s);
        ++visit;
      }
      drive(meeting.robot_bends_m, meeting.site_m, charger);
      if (meeting.carry) {
        stand(meeting.land_s + charger.landing_s);
        drive(meeting.carry_bends_m, meeting.carry_to_m, charger);
      }
      stand(meeting.depart_s);
    }
    stand(std::numeric_limits<double>::infinity());
  }
  const std::vector<Motion>& motions() const { return motions_; }

 private:
  void stand(double until_s) {
    if (until_s <= time_s_) return;
    motions_.push_back({at_m_, at_m_, time_s_, until_s, false});
    time_s_ = until_s;
  }
  void drive(const std::vector<Vec3>& bends_m, const Vec3& to_m, const Charger& charger) {
    std::vector<Vec2> way{at_m_};
    for (const Vec3& bend : bends_m) way.emplace_back(bend.head<2>());
    way.emplace_back(to_m.head<2>());
    double length_m = 0.0;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) length_m += (way[i + 1] - way[i]).norm();
    const double drive_time_s = drive_s(charger, at_m_, way.back());
    for (std::size_t i = 0; i + 1 < way.size() && length_m > 0.0; ++i) {
      const double piece_s = drive_time_s * (way[i + 1] - way[i]).norm() / length_m;
      motions_.push_back({way[i], way[i + 1], time_s_, time_s_ + piece_s, true});
      time_s_ += piece_s;
    }
    at_m_ = way.back();
  }

  std::vector<Motion> motions_;
  Vec2 at_m_;
  double time_s_ = 0.0;
};

/// When two motions are nearest while both last; nothing when they do not overlap.
std::optional<double> nearest_s(const Motion& a, const Motion& b) {
  const double from_s = std::max(a.start_s, b.start_s);
  const double to_s = std::min(a.end_s, b.end_s);
  if (!(to_s > from_s)) return std::nullopt;
  // One of them drives, so that both ends are finite.
  const Vec2 apart = a.at(from_s) - b.at(from_s);
  const Vec2 moves = a.at(to_s) - b.at(to_s) - apart;
  const double squared = moves.squaredNorm();
  const double share = squared > 0.0 ? std::clamp(-apart.dot(moves) / squared, 0.0, 1.0) : 0.0;
  return from_s + share * (to_s - from_s);
}

}  // namespace

std::vector<Encounter> encounters_of(std::span<const Member> members, double apart_m) {
  std::vector<Track> tracks;
  for (const Member& member : members) tracks.emplace_back(member);
  std::vector<Encounter> out;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    for (std::size_t j = i + 1; j < tracks.size(); ++j) {
      Encounter nearest{i, j, 0.0, apart_m, Vec2::Zero()};
      for (const Motion& a : tracks[i].motions()) {
        for (const Motion& b : tracks[j].motions()) {
          if (!a.drives && !b.drives) continue;
          const auto time_s = nearest_s(a, b);
          if (!time_s) continue;
          const double distance_m = (a.at(*time_s) - b.at(*time_s)).norm();
          if (distance_m < nearest.distance_m) nearest = {i, j, *time_s, distance_m, a.at(*time_s)};
        }
      }
      if (nearest.distance_m < apart_m) out.push_back(nearest);
    }
  }
  return out;
}

}  // namespace swallowtail::coverage
