#include "tools/cli/cover_run.hpp"

#include <memory>
#include <utility>

#include "planner/base/clock.hpp"
#include "tools/cli/cover_check.hpp"

namespace swallowtail::cli {
namespace {

/// One task on its own clock; a plan that its checker refuses is no plan.
Covered cover_one(const coverage::Task& task, const planner::Terrain& terrain,
                  const coverage::PlanOptions& options) {
  Covered out;
  out.task = &task;
  const double begin_s = options.clock->now_s();
  auto plan = coverage::plan_coverage(task, terrain, options);
  out.wall_s = options.clock->now_s() - begin_s;
  if (!plan) {
    out.reason = plan.error().message;
    if (plan.error().code == Error::Code::kInfeasible)
      out.fields = coverage::cut_fields(task, terrain, options).reports;
    return out;
  }
  const std::vector<std::string> faults = check_cover(*plan, task);
  if (!faults.empty()) {
    out.reason = "The plan was refused by the checker: " + faults.front();
    return out;
  }
  out.plan = std::move(*plan);
  return out;
}

}  // namespace

std::vector<Covered> cover_task(const coverage::Task& task, const planner::Terrain& terrain,
                                const coverage::PlanOptions& options, const coverage::FleetOptions& fleet) {
  const double begin_s = options.clock->now_s();
  Covered alone = cover_one(task, terrain, options);
  if (!alone.plan || fleet.aircraft == 1) return {std::move(alone)};
  coverage::FleetOptions asked = fleet;
  asked.alone = &*alone.plan;
  const auto refused = [&](std::string reason) -> std::vector<Covered> {
    alone.fields = alone.plan->fields;
    alone.plan.reset();
    alone.reason = std::move(reason);
    return {std::move(alone)};
  };
  auto planned = coverage::plan_useful_fleet(task, terrain, options, asked);
  if (!planned) return refused(planned.error().message);
  if (!planned->note.empty()) planned->members.front().plan.notes.push_back(planned->note);
  std::vector<Covered> out;
  for (coverage::Member& member : planned->members) {
    const std::vector<std::string> faults = check_cover(member.plan, member.task);
    if (!faults.empty()) return refused("The plan was refused by the checker: " + faults.front());
    Covered one;
    one.own_task = std::make_shared<const coverage::Task>(std::move(member.task));
    one.task = one.own_task.get();
    one.plan = std::move(member.plan);
    one.aircraft = static_cast<int>(out.size()) + 1;
    one.delay_s = member.delay_s;
    one.alone_s = planned->alone_s;
    one.wall_s = options.clock->now_s() - begin_s;
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace swallowtail::cli
