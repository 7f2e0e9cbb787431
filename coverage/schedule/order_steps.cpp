#include <algorithm>

#include "coverage/schedule/order_value.hpp"

/// How OrderValue keeps what is flown between the sites.
namespace swallowtail::coverage {

OrderValue::Step OrderValue::make_step(const RouteLeg& leg) const {
  Step out;
  out.cover = Cost(links_->model().level(leg.flown.entry_m, leg.flown.exit_m));
  out.entry_m = leg.flown.entry_m.head<2>();
  out.exit_m = leg.flown.exit_m.head<2>();
  return out;
}

void OrderValue::link(Step& from, const RouteLeg& from_leg, Step& to, const RouteLeg& to_leg) const {
  const LegLink& link = links_->get(from_leg.id, from_leg.flown, to_leg.id, to_leg.flown);
  from.hop = Cost(link.hop);
  from.land_at_exit = Cost(link.land_at_exit);
  from.land_at_next = Cost(link.land_at_entry);
  from.lift_at_exit = Cost(link.lift_from_exit);
  from.by_air = Cost(link.ground_to_ground);
  from.drive_s = link.drive_s;
  from.same_site = link.same_site;
  to.lift_at_entry = Cost(link.lift_at_entry);
}

void OrderValue::finish(Step& last, const RouteLeg& leg) const {
  last.land_at_exit = Cost(links_->model().landing(leg.flown.exit_m));
}

OrderValue::Cost OrderValue::start_lift(const RouteLeg& first) const {
  return Cost(lift_to_first(links_->model(), start_, first.flown));
}

/// The steps of a change, from the leg before it on, since its way to the next is another.
void OrderValue::lay(std::size_t first, std::span<const RouteLeg> legs) {
  const std::size_t past = first + legs.size();
  changed_first_ = first > 0 ? first - 1 : 0;
  changed_past_ = std::min(legs_.size(), past + 1);
  changed_.assign(steps_.begin() + static_cast<std::ptrdiff_t>(changed_first_),
                  steps_.begin() + static_cast<std::ptrdiff_t>(changed_past_));
  const auto leg = [&](std::size_t i) -> const RouteLeg& {
    return i >= first && i < past ? legs[i - first] : legs_[i];
  };
  const auto at = [&](std::size_t i) -> Step& { return changed_[i - changed_first_]; };
  for (std::size_t i = first; i < past; ++i) at(i) = make_step(leg(i));
  for (std::size_t i = changed_first_; i + 1 < changed_past_; ++i) link(at(i), leg(i), at(i + 1), leg(i + 1));
  if (past == legs_.size()) finish(at(past - 1), leg(past - 1));
  is_lift_changed_ = first == 0;
  if (is_lift_changed_) changed_lift_ = start_lift(legs.front());
}

void OrderValue::forget_change() {
  changed_first_ = changed_past_ = changed_node_ = changed_node_past_ = 0;
  is_lift_changed_ = false;
}

}  // namespace swallowtail::coverage
