#include <algorithm>
#include <iterator>

#include "charger/charging/charging.hpp"

/// How Charging keeps its own battery: what ways take, and trips to the depot.
namespace swallowtail::charger {
namespace {

/// Of the capacity: a trip to the depot that brings less is not made.
constexpr double kWorthShare = 0.05;

double length_m(const Vec3& from_m, const std::vector<Vec3>& bends_m, const Vec3& to_m) {
  double out = 0.0;
  Vec3 last = from_m;
  for (const Vec3& bend : bends_m) {
    out += (bend - last).head<2>().norm();
    last = bend;
  }
  return out + (to_m - last).head<2>().norm();
}

}  // namespace

double Charging::speed_on(const Way& way) const {
  return way.speed_mps > 0.0 ? std::min(way.speed_mps, orders_.speed_mps) : orders_.speed_mps;
}

double Charging::way_s(const Way& way, double length_m) const { return length_m / speed_on(way); }

void Charging::drive(const Way& way, const Vec3& target_m, double duration_s) {
  const double speed = speed_on(way);
  drive_.follow(way.bends_m, target_m, speed, duration_s);
  own_.drive(duration_s * drive_.speed_mps() / speed);
}

/// On from here to where the meeting ends, and home from there. Only with a battery of its own.
double Charging::for_the_way_home(const Meeting& meeting) const {
  const Vec3& end_m = meeting.carry_to_m.value_or(meeting.site_m);
  double time_s = way_s(meeting.home, length_m(end_m, meeting.home.bends_m, orders_.start_m));
  if (meeting.carry_to_m)
    time_s += way_s({{}, meeting.carry_speed_mps}, drive_.left_m(meeting.carry_way_m, end_m));
  return own_.for_driving(time_s);
}

/// To go to the meeting from here, to keep it, and to drive home.
double Charging::needs(const Meeting& meeting) const {
  const Vec3& end_m = meeting.carry_to_m.value_or(meeting.site_m);
  const double there_s = way_s({{}, meeting.way_speed_mps}, drive_.left_m(meeting.way_m, meeting.site_m));
  const double home_s = way_s(meeting.home, length_m(end_m, meeting.home.bends_m, orders_.start_m));
  return own_.for_driving(there_s + home_s) + meeting.uses;
}

bool Charging::must_fetch_before(const Meeting& meeting) const {
  if (needs(meeting) <= own_.to_spare()) return false;
  const double home_s = way_s(home_, drive_.left_m(home_.bends_m, orders_.start_m));
  return own_.energy() < (1.0 - kWorthShare) * own_.capacity() - 2.0 * own_.for_driving(home_s);
}

bool Charging::has_an_errand(const Meeting& next) {
  if (next.is_depot) return true;
  if (own_.is_limited() && sets_out_anew_)
    errand_ = must_fetch_before(next) ? Errand::kToDepot : Errand::kNone;
  sets_out_anew_ = false;
  return errand_ == Errand::kToDepot;
}

/// Without the vehicle.
void Charging::fetch(const Way& way, double duration_s) {
  if (drive_.stands_at(orders_.start_m)) {
    drive_.stop();
    errand_ = Errand::kRefilling;
    refilled_s_ = state_.time_s + own_.refill_s();
    state_.activity = Activity::kRefilling;
    return;
  }
  if (is_held_up()) return;
  drive(way, orders_.start_m, duration_s);
  state_.activity = Activity::kDriving;
}

void Charging::refill_when_due() {
  if (errand_ != Errand::kRefilling || state_.time_s < refilled_s_) return;
  own_.refill();
  errand_ = Errand::kNone;
  depot_done_ = state_.meeting_id;
  home_ = {};
  sets_out_anew_ = true;
}

/// Where it has no more to give, and new energy would let it give more than its ways take.
void Charging::begin_errand_on_board(const Inputs& inputs) {
  if (!own_.is_limited() || state_.charge_rate > 0.0 || !inputs.battery) return;
  const double brings = own_.usable() - 2.0 * for_the_way_home(current_);
  if (brings < kWorthShare * own_.capacity()) return;
  errand_ = Errand::kToDepot;
  errand_from_m_ = drive_.position_m();
}

void Charging::run_errand_on_board(double duration_s) {
  state_.charge_rate = 0.0;
  if (errand_ == Errand::kRefilling) {
    state_.activity = Activity::kRefilling;
    if (state_.time_s < refilled_s_) return;
    own_.refill();
    errand_ = Errand::kBack;
  }
  if (errand_ == Errand::kToDepot && drive_.stands_at(orders_.start_m)) {
    errand_ = Errand::kRefilling;
    refilled_s_ = state_.time_s + own_.refill_s();
    return;
  }
  if (errand_ == Errand::kBack && drive_.stands_at(errand_from_m_)) {
    errand_ = Errand::kNone;
    return;
  }
  if (is_held_up()) return;
  Way way = current_.home;
  if (errand_ == Errand::kBack) {
    std::reverse(way.bends_m.begin(), way.bends_m.end());
    if (!way.bends_m.empty()) way.bends_m.insert(way.bends_m.begin(), orders_.start_m);
  }
  drive(way, errand_ == Errand::kBack ? errand_from_m_ : orders_.start_m, duration_s);
  state_.activity = Activity::kCarrying;
}

void Charging::suffer_losses() {
  std::erase_if(losses_, [this](const Loss& loss) {
    if (loss.at_s > state_.time_s) return false;
    own_.lose(loss.energy);
    return true;
  });
}

}  // namespace swallowtail::charger
