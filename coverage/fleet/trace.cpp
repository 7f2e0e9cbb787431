#include "coverage/fleet/trace.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace swallowtail::coverage {
namespace {

constexpr double kSamePlace_m = 1e-6;
/// Nearer than this to the start, the first leg begins straight above it, as in lift_to_first.
constexpr double kAboveStart_m = 1e-3;

class Tracer {
 public:
  Tracer(const Plan& plan, const FlightModel& model) : plan_(plan), model_(model) {}

  Trace run(const Vec3& start_m) {
    const Vec3 site = model_.ground(start_m);
    take_off({{site}, 0.0, plan_.take_off_s, {}}, site);
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
    return std::move(out_);
  }

 private:
  void take_off(Stretch stretch, const Vec3& site) {
    at_m_ = site;
    time_s_ = stretch.take_off_s;
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

  void meet() {
    const Rendezvous& meeting = plan_.rendezvous[meetings_++];
    land();
    Stretch next;
    next.stands_m.push_back(meeting.site_m);
    if (meeting.carry) next.stands_m.push_back(meeting.carry_to_m);
    next.stands_from_s = std::min(meeting.robot_arrives_s, time_s_);
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
  const FlightModel& model_;
  Trace out_;
  Vec3 at_m_ = Vec3::Zero();
  double time_s_ = 0.0;
  std::optional<Vec3> before_;
  std::size_t meetings_ = 0;
};

}  // namespace

Trace trace_of(const Plan& plan, const Vec3& start_m, const FlightModel& model) {
  return Tracer(plan, model).run(start_m);
}

}  // namespace swallowtail::coverage
