#include "coverage/fleet/trace.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "coverage/fleet/drives.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kSamePlace_m = 1e-6;
/// Nearer than this to the start, the first leg begins straight above it, as in lift_to_first.
constexpr double kAboveStart_m = 1e-3;

class Tracer {
 public:
  Tracer(const Plan& plan, const Task& task, const FlightModel& model)
      : plan_(plan), charger_(task.charger), model_(model), robot_m_(model.ground(task.charger.start_m)) {}

  Trace run(const Vec3& start_m) {
    const Vec3 site = model_.ground(start_m);
    take_off({{site, robot_m_}, 0.0, plan_.take_off_s, {}, {}}, site);
    const Vec3& first = plan_.legs.front().entry_m;
    if ((site - first).head<2>().norm() >= kAboveStart_m) fly_way(Vec3(site.x(), site.y(), first.z()), first);
    for (std::size_t i = 0; i < plan_.legs.size(); ++i) {
      out_.stretch_of_leg.push_back(out_.stretches.size() - 1);
      fly_to(plan_.legs[i].entry_m);
      fly_to(plan_.legs[i].exit_m);
      if (i + 1 < plan_.legs.size()) transfer(plan_.legs[i], plan_.legs[i + 1]);
    }
    land();
    out_.end_m = at_m_;
    out_.end_s = time_s_;
    go_home();
    return std::move(out_);
  }

 private:
  void take_off(Stretch stretch, const Vec3& site) {
    at_m_ = site;
    time_s_ = stretch.take_off_s;
    stretch.drive.from_m = robot_m_;
    stretch.drive.free_s = time_s_;
    before_.reset();
    out_.stretches.push_back(std::move(stretch));
  }
  void add(const Vec3& to, double duration_s) {
    out_.stretches.back().pieces.push_back({at_m_, to, time_s_, time_s_ + duration_s, false});
    at_m_ = to;
    time_s_ += duration_s;
  }
  void fly_to(const Vec3& place) {
    const Vec3 along = place - at_m_;
    if (along.norm() < kSamePlace_m) return;
    const bool is_level = along.head<2>().norm() > kSamePlace_m;
    if (before_) {
      const double angle = std::atan2(before_->cross(along).norm(), before_->dot(along));
      const bool was_level = before_->head<2>().norm() > kSamePlace_m;
      if (is_level != was_level || angle > model_.limits().turn_max_rad + 1e-9)
        add(at_m_, planner::kStopToTurn_s);
    }
    add(place, is_level ? model_.level(at_m_, place).time_s : model_.vertical(at_m_.z(), place.z()).time_s);
    before_ = along;
  }
  void fly_way(const Vec3& from, const Vec3& to) {
    for (const Vec3& corner : model_.way(from, to)) fly_to(corner);
  }
  void land() { fly_to(Vec3(at_m_.x(), at_m_.y(), std::min(at_m_.z(), model_.ground(at_m_).z()))); }

  /// Adds a drive that ends at a time, and moves on where the robot is.
  void drive(const std::vector<Vec3>& bends_m, const Vec3& to_m, double arrives_s) {
    std::vector<TimedPiece>& pieces = out_.stretches.back().drive.pieces;
    std::vector<TimedPiece> driven = drive_of(charger_, model_, robot_m_, bends_m, to_m, 0.0);
    const double leaves_s = driven.empty() ? arrives_s : arrives_s - driven.back().end_s;
    if (!pieces.empty() && leaves_s > pieces.back().end_s)
      pieces.push_back({robot_m_, robot_m_, pieces.back().end_s, leaves_s, true});
    for (TimedPiece& piece : driven) {
      piece.start_s += leaves_s;
      piece.end_s += leaves_s;
      pieces.push_back(piece);
    }
    robot_m_ = to_m;
  }
  void go_home() {
    Drive& last = out_.stretches.back().drive;
    last.until_s = std::numeric_limits<double>::infinity();
    if (plan_.robot_home_s > 0.0)
      drive(plan_.home_bends_m, model_.ground(charger_.start_m), plan_.robot_home_s);
  }
  void drive_to(std::size_t index) {
    const Rendezvous& meeting = plan_.rendezvous[index];
    if (depot_visits_ < plan_.depot_visits.size() && plan_.depot_visits[depot_visits_].before == index) {
      const DepotVisit& visit = plan_.depot_visits[depot_visits_++];
      drive(visit.bends_m, model_.ground(charger_.start_m), visit.arrives_s);
    }
    drive(meeting.robot_bends_m, meeting.site_m, meeting.robot_arrives_s);
    out_.stretches.back().drive.until_s = time_s_;
  }

  void meet() {
    land();
    drive_to(meetings_);
    const Rendezvous& meeting = plan_.rendezvous[meetings_++];
    Stretch next;
    next.stands_m.push_back(meeting.site_m);
    if (meeting.carry) {
      next.stands_m.push_back(meeting.carry_to_m);
      const double docked_s = std::max(meeting.robot_arrives_s, time_s_) + charger_.landing_s;
      const std::vector<TimedPiece> carried =
          drive_of(charger_, model_, meeting.site_m, meeting.carry_bends_m, meeting.carry_to_m, docked_s);
      std::vector<TimedPiece>& pieces = out_.stretches.back().pieces;
      pieces.insert(pieces.end(), carried.begin(), carried.end());
      robot_m_ = meeting.carry_to_m;
    }
    next.stands_from_s = time_s_;
    next.take_off_s = meeting.depart_s;
    take_off(std::move(next), meeting.carry ? meeting.carry_to_m : meeting.site_m);
  }

  void transfer(const Leg& leg, const Leg& next) {
    const Transfer type = leg.transfer;
    const bool lands_first = type == Transfer::kFDUF || type == Transfer::kFDUFDU || type == Transfer::kFDTU;
    if (lands_first) meet();
    if (type == Transfer::kFDTU) return;
    Vec3 from = leg.exit_m;
    if (lands_first) from.z() = next.entry_m.z();
    fly_way(from, next.entry_m);
    if (type == Transfer::kFFDU || type == Transfer::kFDUFDU) meet();
  }

  const Plan& plan_;
  const Charger& charger_;
  const FlightModel& model_;
  Vec3 robot_m_;
  Trace out_;
  Vec3 at_m_ = Vec3::Zero();
  double time_s_ = 0.0;
  std::optional<Vec3> before_;
  std::size_t meetings_ = 0;
  std::size_t depot_visits_ = 0;
};

}  // namespace

TimedPiece standing(const Vec3& at_m, double from_s, double to_s) { return {at_m, at_m, from_s, to_s, true}; }

TimedPiece Drive::stand_before() const {
  return standing(from_m, free_s, pieces.empty() ? until_s : pieces.front().start_s);
}
TimedPiece Drive::stand_after() const { return standing(pieces.back().to_m, pieces.back().end_s, until_s); }

std::vector<TimedPiece> pieces_of(const Trace& trace) {
  std::vector<TimedPiece> out;
  for (const Stretch& stretch : trace.stretches) {
    for (const Vec3& stand : stretch.stands_m)
      out.push_back(standing(stand, stretch.stands_from_s, stretch.take_off_s));
    out.insert(out.end(), stretch.pieces.begin(), stretch.pieces.end());
    out.push_back(stretch.drive.stand_before());
    if (stretch.drive.pieces.empty()) continue;
    out.insert(out.end(), stretch.drive.pieces.begin(), stretch.drive.pieces.end());
    out.push_back(stretch.drive.stand_after());
  }
  out.push_back(standing(trace.end_m, trace.end_s, std::numeric_limits<double>::infinity()));
  return out;
}

Trace trace_of(const Plan& plan, const Task& task, const FlightModel& model) {
  return Tracer(plan, task, model).run(task.start_m);
}

}  // namespace swallowtail::coverage
