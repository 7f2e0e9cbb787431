#include "tools/cli/cover_files.hpp"

namespace swallowtail::cli {

std::vector<Vec3> approach_of(const Covered& one) {
  if (one.plan->legs.empty()) return {};
  std::vector<Vec3> out{one.task->start_m};
  out.insert(out.end(), one.plan->approach_m.begin(), one.plan->approach_m.end());
  out.push_back(one.plan->legs.front().entry_m);
  return out;
}

std::vector<Vec3> transfer_after(const coverage::Plan& plan, std::size_t leg) {
  std::vector<Vec3> out{plan.legs[leg].exit_m};
  out.insert(out.end(), plan.legs[leg].transfer_m.begin(), plan.legs[leg].transfer_m.end());
  out.push_back(plan.legs[leg + 1].entry_m);
  return out;
}

}  // namespace swallowtail::cli
