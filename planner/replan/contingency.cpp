#include "planner/replan/contingency.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace swallowtail::planner {
namespace {

/// Shares of the hold asked for, tried in this order.
constexpr std::array kHoldShares{1.0, 0.35, 0.15};
/// Distances moved aside, in clearances.
constexpr std::array kAsideClearances{2.0, 5.0, 12.0, 30.0};
constexpr int kHeadings = 12;
constexpr int kStepsBack = 14;

class Finder {
 public:
  explicit Finder(const ContingencyRequest& request) : request_(request), start_(request.path.front()) {}

  Contingency find() {
    for (const double share : kHoldShares) {
      hold_s_ = share * request_.hold_s;
      if (fly_on() || hold_here() || move_aside()) return std::move(answer_);
    }
    land();
    return std::move(answer_);
  }

 private:
  bool take(TimedPath path, const char* what) {
    Certificate certificate = certify(path, request_.query, request_.limits);
    if (!certificate.certified) return false;
    answer_ = {true, std::move(path), std::move(certificate), what};
    return true;
  }

  TimedPath with_hold(TimedPath path) const {
    TimedWaypoint hold = path.back();
    hold.time_s += hold_s_;
    hold.phase = Phase::kHold;
    path.push_back(hold);
    return path;
  }

  TimedPath cut(double time_s) const {
    TimedPath path;
    for (const TimedWaypoint& w : request_.path) {
      if (w.time_s >= time_s) {
        path.push_back({time_s, position_at(request_.path, time_s), w.phase, w.leg_index});
        break;
      }
      path.push_back(w);
    }
    return path;
  }

  bool fly_on() {
    const double flown_s = request_.blocked_s - start_.time_s;
    double back_s = request_.limits.clearance_m() / request_.limits.cruise_speed_mps;
    for (int i = 0; i < kStepsBack && back_s < flown_s; ++i, back_s *= 1.6) {
      if (take(with_hold(cut(request_.blocked_s - back_s)), "flies on and holds")) return true;
    }
    return false;
  }

  bool hold_here() {
    return take(with_hold({{start_.time_s, start_.position_m, Phase::kHold, start_.leg_index}}),
                "holds here");
  }

  bool aside(const Vec3& offset) {
    const Bounds& bounds = request_.query.world().bounds();
    const Vec3 place = (start_.position_m + offset).cwiseMax(bounds.min_m).cwiseMin(bounds.max_m);
    const RoutePoint point{place, Phase::kTransfer, start_.leg_index, 0.0};
    return take(with_hold(time_route(start_.position_m, start_.time_s, {point}, request_.limits)),
                "moves aside and holds");
  }

  bool move_aside() {
    for (const double clearances : kAsideClearances) {
      const double distance = clearances * request_.limits.clearance_m();
      if (aside(Vec3(0, 0, distance))) return true;
      for (int k = 0; k < kHeadings; ++k) {
        const double heading = 2.0 * std::numbers::pi * k / kHeadings;
        if (aside(distance * Vec3(std::cos(heading), std::sin(heading), 0.0))) return true;
        if (aside(distance * Vec3(std::cos(heading), std::sin(heading), 0.6))) return true;
      }
      if (aside(Vec3(0, 0, -distance))) return true;
    }
    return false;
  }

  void land() {
    Vec3 ground = start_.position_m;
    ground.z() = request_.query.world().terrain().height_at(ground.x(), ground.y());
    if (ground.z() > start_.position_m.z()) return;
    const RoutePoint point{ground, Phase::kLanding, start_.leg_index, 0.0};
    take(time_route(start_.position_m, start_.time_s, {point}, request_.limits), "lands");
  }

  const ContingencyRequest& request_;
  TimedWaypoint start_;
  double hold_s_ = 0.0;
  Contingency answer_;
};

}  // namespace

Contingency find_contingency(const ContingencyRequest& request) { return Finder(request).find(); }

}  // namespace swallowtail::planner
