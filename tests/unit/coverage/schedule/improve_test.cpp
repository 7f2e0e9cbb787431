#include "coverage/schedule/improve.hpp"

#include <gtest/gtest.h>

#include "planner/base/rng.hpp"

namespace swallowtail::coverage {
namespace {

/// Short cells at many heights, for a vehicle that climbs far slower than it descends.
std::vector<SubCell> uneven_cells(Rng& rng) {
  std::vector<SubCell> cells;
  for (std::size_t i = 0; i < 40; ++i) {
    SubCell cell;
    cell.height_m = rng.uniform(5.0, 60.0);
    cell.alpha_m = Vec3(rng.uniform(0.0, 100.0), rng.uniform(0.0, 100.0), cell.height_m);
    cell.beta_m = cell.alpha_m + Vec3(rng.uniform(-20.0, 20.0), rng.uniform(-20.0, 20.0), 0.0);
    cells.push_back(cell);
  }
  return cells;
}

double flight_s(const std::vector<SubCell>& cells, const std::vector<Visit>& visits, LinkCache& links,
                const FlightModel& model, const ScheduleStart& start) {
  const Vec3 first = route_leg(cells[visits[0].sub_cell], visits[0]).flown.entry_m;
  double sum = (first - start.position_m).head<2>().norm() / model.limits().cruise_speed_mps;
  for (std::size_t i = 0; i + 1 < visits.size(); ++i) {
    const RouteLeg from = route_leg(cells[visits[i].sub_cell], visits[i]);
    const RouteLeg to = route_leg(cells[visits[i + 1].sub_cell], visits[i + 1]);
    sum += links.get(from.id, from.flown, to.id, to.flown).hop.time_s;
  }
  return sum;
}

TEST(ImproveOrder, CountsFlightBothWaysWhereUpTakesLongerThanDown) {
  const planner::Terrain ground = planner::Terrain::flat(0.0);
  planner::VehicleLimits limits;
  limits.climb_speed_mps = 0.5;
  limits.descent_speed_mps = 8.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const std::vector<SubCell> cells = uneven_cells(rng);
    const FlightModel model(limits, {}, ground);
    LinkCache links(model, {});
    const ScheduleStart start;
    const std::vector<Visit> before = boustrophedon_order(cells, start.position_m);
    ImproveParams params;
    params.aim = Aim::kFlight;
    const ImproveReport found = improve_order(cells, before, start, links, params);
    EXPECT_NEAR(found.end_s, flight_s(cells, found.visits, links, model, start), 1e-6);
    EXPECT_LE(found.end_s, flight_s(cells, before, links, model, start) + 1e-9);
  }
}

}  // namespace
}  // namespace swallowtail::coverage
