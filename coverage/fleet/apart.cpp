#include "coverage/fleet/apart.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

namespace swallowtail::coverage {
namespace {

/// Other orders are not looked for when waiting costs but a share of the makespan.
constexpr double kEnough = 1.01;

std::string number(double value) {
  std::string out = std::to_string(value);
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

/// Delays by rank: who comes first keeps its times. Nothing when one of them finds no time; its place in the
/// ranks is then in `stuck`.
std::optional<std::vector<Delays>> delays_in(const std::vector<std::size_t>& ranks,
                                             const std::vector<Member>& members,
                                             const std::vector<Trace>& traces, const Separation& separation,
                                             const FlightModel& model, std::size_t& stuck) {
  const double most_s = std::accumulate(traces.begin(), traces.end(), 0.0,
                                        [](double sum, const Trace& trace) { return sum + trace.end_s; });
  std::vector<Trace> placed;
  std::vector<Delays> out(members.size());
  for (std::size_t rank = 0; rank < ranks.size(); ++rank) {
    const std::size_t k = ranks[rank];
    const auto delays = delays_of(traces[k], placed, separation, most_s);
    if (!delays) {
      stuck = rank;
      return std::nullopt;
    }
    Plan plan = members[k].plan;
    delay(plan, traces[k], *delays);
    placed.push_back(trace_of(plan, members[k].task, model));
    out[k] = *delays;
  }
  return out;
}

/// Whether two teams end in each other's way: then no waiting helps.
bool end_apart(const std::vector<Trace>& traces, const Separation& separation) {
  const auto stays = [](const Trace& trace) {
    const Drive& last = trace.stretches.back().drive;
    return std::vector{trace.end_m, last.pieces.empty() ? last.from_m : last.pieces.back().to_m};
  };
  for (std::size_t i = 0; i < traces.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (const Vec3& one : stays(traces[i])) {
        for (const Vec3& other : stays(traces[j])) {
          if (conflict(standing(one, 0.0, 1.0), 0.0, standing(other, 0.0, 1.0), separation)) return false;
        }
      }
    }
  }
  return true;
}

/// What one order of ranks comes to.
struct Ranked {
  std::vector<Delays> delays;
  double end_s = 0.0;
};

double end_of(const std::vector<Trace>& traces, const std::vector<Delays>& delays, std::size_t k) {
  return traces[k].end_s + delays[k].stretch_s.back();
}

}  // namespace

void send_home(Member& member, const FlightModel& model) {
  Plan& plan = member.plan;
  if (plan.rendezvous.empty() || plan.robot_home_s > 0.0) return;
  const Charger& charger = member.task.charger;
  const Rendezvous& last = plan.rendezvous.back();
  const Vec3 from_m = last.carry ? last.carry_to_m : last.site_m;
  const double home_s = drive_s(charger, from_m, charger.start_m);
  if (!std::isfinite(home_s)) return;
  plan.robot_home_s = last.depart_s + home_s;
  if (!charger.travel) return;
  for (const Vec2& bend : charger.travel->bends(from_m.head<2>(), charger.start_m.head<2>()))
    plan.home_bends_m.push_back(model.ground(Vec3(bend.x(), bend.y(), 0.0)));
}

Status separate(std::vector<Member>& members, const Separation& separation, const FlightModel& model) {
  std::vector<Trace> traces;
  for (const Member& member : members) traces.push_back(trace_of(member.plan, member.task, model));
  std::vector<std::size_t> ranks(members.size());
  std::iota(ranks.begin(), ranks.end(), std::size_t{0});
  std::ranges::stable_sort(ranks, std::ranges::greater{}, [&](std::size_t k) { return traces[k].end_s; });
  const double undelayed_s = traces[ranks.front()].end_s;
  std::optional<Ranked> best;
  std::size_t stuck = 0;
  const std::size_t attempts = end_apart(traces, separation) ? 2 * members.size() : 0;
  for (std::size_t attempt = 0; attempt < attempts; ++attempt) {
    auto delays = delays_in(ranks, members, traces, separation, model, stuck);
    if (delays) {
      std::size_t last = 0;
      for (std::size_t rank = 1; rank < ranks.size(); ++rank) {
        if (end_of(traces, *delays, ranks[rank]) > end_of(traces, *delays, ranks[last])) last = rank;
      }
      const double end_s = end_of(traces, *delays, ranks[last]);
      if (!best || end_s < best->end_s) best = {std::move(*delays), end_s};
      if (last == 0 || best->end_s <= kEnough * undelayed_s) break;
      stuck = last;
    }
    const auto at = ranks.begin() + static_cast<std::ptrdiff_t>(stuck);
    std::rotate(ranks.begin(), at, at + 1);
  }
  if (!best) {
    return infeasible("No waiting on the ground keeps " + std::to_string(members.size()) +
                      " aircraft and their robots " + number(separation.horizontal_m) +
                      " m apart horizontally or " + number(separation.vertical_m) +
                      " m vertically: aircraft " + std::to_string(ranks.front() + 1) +
                      " finds no time. Fewer aircraft or smaller distances may do.");
  }
  for (std::size_t k = 0; k < members.size(); ++k) {
    delay(members[k].plan, traces[k], best->delays[k]);
    members[k].delay_s = best->delays[k].stretch_s.back();
  }
  return {};
}

bool are_apart(const std::vector<Member>& members, const Separation& separation, const FlightModel& model) {
  std::vector<Trace> traces;
  for (const Member& member : members) traces.push_back(trace_of(member.plan, member.task, model));
  for (std::size_t i = 0; i < traces.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (conflict(traces[i], traces[j], separation)) return false;
    }
  }
  return true;
}

}  // namespace swallowtail::coverage
