#include "coverage/maintain/live_plan.hpp"

#include <algorithm>
#include <utility>

namespace swallowtail::coverage {

LivePlan live_plan(const Plan& plan) {
  LivePlan out;
  out.legs = plan.legs;
  out.approach_m = plan.approach_m;
  out.rendezvous = plan.rendezvous;
  out.end_s = plan.makespan_s;
  out.area_m2 = plan.area_m2;
  out.lacks = lacking_field(plan.fields);
  if (!out.lacks.empty()) out.reason = out.lacks;
  return out;
}

std::string lacking_field(const std::vector<FieldReport>& fields) {
  const auto lacking = std::ranges::find_if(
      fields, [](const FieldReport& field) { return field.status != FieldStatus::kPlanned; });
  if (lacking == fields.end()) return {};
  const char* fate = lacking->status == FieldStatus::kRefused ? " refused: " : " covered in part: ";
  return "field " + std::to_string(lacking->id) + fate + lacking->reason;
}

void set_approach(LivePlan& plan, std::vector<Vec3> bends_m) {
  std::vector<Vec3>& way = plan.legs_done == 0 ? plan.approach_m : plan.legs[plan.legs_done - 1].transfer_m;
  way = std::move(bends_m);
}

bool same_sortie(const std::vector<Leg>& a, const std::vector<Leg>& b, std::size_t leg) {
  const auto same = [](const Leg& l, const Leg& m) {
    return l.kind == m.kind && l.entry_m == m.entry_m && l.exit_m == m.exit_m && l.transfer == m.transfer &&
           l.transfer_m == m.transfer_m;
  };
  for (std::size_t i = leg > 0 ? leg - 1 : 0; i < std::max(a.size(), b.size()); ++i) {
    if (i >= a.size() || i >= b.size() || !same(a[i], b[i])) return false;
    if (i >= leg && a[i].transfer != Transfer::kFF) return true;
  }
  return true;
}

void shift_times(LivePlan& plan, std::size_t first_leg, double delay_s) {
  for (std::size_t i = first_leg; i < plan.legs.size(); ++i) {
    plan.legs[i].start_s = std::max(0.0, plan.legs[i].start_s + delay_s);
    plan.legs[i].end_s = std::max(plan.legs[i].start_s, plan.legs[i].end_s + delay_s);
  }
  for (Rendezvous& meeting : plan.rendezvous) {
    for (double* time : {&meeting.robot_arrives_s, &meeting.land_s, &meeting.arrive_by_s, &meeting.depart_s})
      *time = std::max(0.0, *time + delay_s);
  }
  plan.end_s += delay_s;
}

}  // namespace swallowtail::coverage
