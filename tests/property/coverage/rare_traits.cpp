#include "tests/property/coverage/rare_traits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/property/coverage/random_task.hpp"
#include "tests/support/cover_oracle.hpp"

namespace swallowtail::coverage::test {
namespace {

Vec2 spun(const Vec2& p, double angle_rad) {
  return {p.x() * std::cos(angle_rad) - p.y() * std::sin(angle_rad),
          p.x() * std::sin(angle_rad) + p.y() * std::cos(angle_rad)};
}

/// Blocks of even ground with cliffs between them.
planner::Terrain random_cliffs(Rng& rng) {
  planner::TerrainGrid grid;
  grid.origin_m = Vec2(-200.0, -200.0);
  grid.cell_size_m = rng.uniform(3.0, 8.0);
  grid.cols = static_cast<int>(700.0 / grid.cell_size_m);
  grid.rows = static_cast<int>(400.0 / grid.cell_size_m);
  const int block = 2 + static_cast<int>(rng.below(8));
  const double rise_m = rng.uniform(2.0, 20.0);
  const double rough_m = rng.uniform(0.0, 1.0);
  const int across = grid.cols / block + 1;
  std::vector<double> levels;
  for (int i = 0; i < across * (grid.rows / block + 1); ++i)
    levels.push_back(rise_m * static_cast<double>(rng.below(3)));
  for (int row = 0; row < grid.rows; ++row) {
    for (int col = 0; col < grid.cols; ++col) {
      const double level = levels[static_cast<std::size_t>(row / block * across + col / block)];
      grid.elevation_m.push_back(static_cast<float>(level + rough_m * rng.uniform()));
    }
  }
  return *planner::Terrain::from_grid(std::move(grid));
}

Ring box_ring(const Vec2& centre, double length_m, double width_m, double turn_rad) {
  Ring out;
  for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
    out.push_back(centre + spun(Vec2(x * length_m / 2.0, y * width_m / 2.0), turn_rad));
  return out;
}

/// A jagged line across a box parts it in two fields that share it.
void add_neighbours(Rng& rng, Task& task) {
  const double length_m = rng.uniform(40.0, 90.0);
  const double width_m = rng.uniform(30.0, 80.0);
  const double turn_rad = rng.uniform(0.0, 3.0);
  std::vector<Vec2> parting;
  const int corners = 2 + static_cast<int>(rng.below(4));
  for (int i = 0; i < corners; ++i)
    parting.emplace_back(rng.uniform(-0.2, 0.2) * length_m, width_m * (i / (corners - 1.0) - 0.5));
  Ring left{{-length_m / 2.0, width_m / 2.0}, {-length_m / 2.0, -width_m / 2.0}};
  Ring right{{length_m / 2.0, -width_m / 2.0}, {length_m / 2.0, width_m / 2.0}};
  left.insert(left.end(), parting.begin(), parting.end());
  right.insert(right.end(), parting.rbegin(), parting.rend());
  task.fields.resize(1);
  task.fields.push_back(task.fields.front());
  task.fields[1].id = 2;
  task.fields[1].height_m = rng.uniform(8.0, 40.0);
  task.fields[0].polygon = {left, {}};
  task.fields[1].polygon = {right, {}};
  for (Field& field : task.fields) {
    for (Vec2& p : field.polygon.outline) p = spun(p, turn_rad);
  }
}

/// The first field's hole becomes a field, whole or drawn in.
void fill_hole(Rng& rng, Task& task) {
  Field& outer = task.fields.front();
  outer.polygon = {
      box_ring(Vec2::Zero(), rng.uniform(60.0, 100.0), rng.uniform(60.0, 100.0), rng.uniform(0.0, 3.0)), {}};
  const double half_m = rng.uniform(9.0, 20.0);
  const double turn_rad = rng.uniform(0.0, 3.0);
  outer.polygon.holes = {box_ring(Vec2::Zero(), 2.0 * half_m, 2.0 * half_m, turn_rad)};
  const double share = rng.uniform() < 0.5 ? 1.0 : rng.uniform(0.6, 1.0);
  task.fields.resize(1);
  task.fields.push_back({2,
                         "inner",
                         {box_ring(Vec2::Zero(), 2.0 * share * half_m, 2.0 * share * half_m, turn_rad), {}},
                         rng.uniform(8.0, 40.0)});
}

/// Long and narrower than the sensor sees, as often as not.
void add_strip(Rng& rng, Task& task) {
  const Vec2 centre(rng.uniform(-60.0, 200.0), rng.uniform(-90.0, -60.0));
  task.fields.push_back(
      {static_cast<std::uint32_t>(task.fields.size() + 1),
       "strip",
       {box_ring(centre, rng.uniform(12.0, 120.0), rng.uniform(1.0, 25.0), rng.uniform(0.0, 3.0)), {}},
       rng.uniform(8.0, 40.0)});
}

/// Turned round, with points repeated and on straight edges; the same ground.
void make_untidy(Rng& rng, Ring& ring) {
  Ring out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& next = ring[(i + 1) % ring.size()];
    out.push_back(ring[i]);
    if (rng.uniform() < 0.3) out.push_back(ring[i]);
    if (rng.uniform() < 0.3) out.push_back(ring[i] + rng.uniform() * (next - ring[i]));
  }
  if (rng.uniform() < 0.5) out.push_back(out.front());
  if (rng.uniform() < 0.5) std::reverse(out.begin(), out.end());
  ring = std::move(out);
}

/// Small holes round the middle.
void add_holes(Rng& rng, Polygon& polygon) {
  Vec2 centre = Vec2::Zero();
  for (const Vec2& p : polygon.outline) centre += p / static_cast<double>(polygon.outline.size());
  polygon.holes.clear();
  const int count = 2 + static_cast<int>(rng.below(3));
  for (int i = 0; i < count; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / count + rng.uniform(0.0, 0.5);
    polygon.holes.push_back(box_ring(centre + spun(Vec2(9.0, 0.0), angle_rad), rng.uniform(0.5, 6.0),
                                     rng.uniform(0.5, 6.0), rng.uniform(0.0, 3.0)));
  }
}

bool is_in_no_fly(const Polygon& area, const Vec2& place) {
  test_support::Ground ground;
  const auto add = [&](const Ring& ring) {
    ground.rings.emplace_back();
    for (const Vec2& p : ring) ground.rings.back().emplace_back(p.x(), p.y());
  };
  add(area.outline);
  for (const Ring& hole : area.holes) add(hole);
  return test_support::is_on(ground, {place.x(), place.y()});
}

bool is_barred(const Task& task, const Vec2& place) {
  const bool forbidden =
      std::ranges::any_of(task.no_fly, [&](const Polygon& area) { return is_in_no_fly(area, place); });
  return forbidden || std::ranges::any_of(task.fields, [&](const Field& field) {
           return std::ranges::any_of(field.polygon.holes, [&](const Ring& hole) {
             return is_in_no_fly({hole, {}}, place);
           });
         });
}

/// Anywhere, on a corner of a field, or where the other starts.
Vec3 random_start(Rng& rng, const Task& task, const Vec3& otherwise) {
  const double kind = rng.uniform();
  Vec2 place(rng.uniform(-60.0, 200.0), rng.uniform(-60.0, 60.0));
  if (kind < 0.3) {
    const Ring& outline = task.fields.front().polygon.outline;
    place = outline[rng.below(outline.size())];
  } else if (kind < 0.5) {
    place = otherwise.head<2>();
  }
  return is_barred(task, place) ? Vec3(-100.0, -100.0, 0.0) : Vec3(place.x(), place.y(), 0.0);
}

void draw_rules(Rng& rng, Task& task) {
  const double kind = rng.uniform();
  if (kind < 0.2) {
    task.rules.overlap = rng.uniform(0.05, 0.5);
  } else if (kind < 0.5) {
    task.rules.headland = kind < 0.35 ? Headland::kSkip : Headland::kFly;
    task.rules.headland_m = rng.uniform(0.5, 15.0);
  } else if (kind < 0.7) {
    task.rules.beyond = Beyond::kSlantedBorders;
  } else if (kind < 0.8) {
    task.rules.ceiling_m = rng.uniform(20.0, 50.0);
  }
  if (rng.uniform() < 0.2) task.sweep_rad = rng.uniform(-4.0, 4.0);
  if (rng.uniform() < 0.3) task.height_band_m = rng.uniform(0.0, 20.0);
  if (rng.uniform() < 0.3) task.neighbours = 1 + static_cast<int>(rng.below(9));
}

}  // namespace

void add_rare_ground(Rng& rng, ReplayTask& out) {
  Task& task = out.task;
  if (rng.uniform() < 0.15) out.terrain = random_cliffs(rng);
  const double kind = rng.uniform();
  if (kind < 0.15) {
    add_neighbours(rng, task);
  } else if (kind < 0.3) {
    fill_hole(rng, task);
  } else if (kind < 0.4) {
    add_holes(rng, task.fields.front().polygon);
  }
  if (rng.uniform() < 0.15) add_strip(rng, task);
  if (rng.uniform() < 0.2) {
    for (Field& field : task.fields) {
      make_untidy(rng, field.polygon.outline);
      for (Ring& hole : field.polygon.holes) make_untidy(rng, hole);
    }
  }
  if (rng.uniform() < 0.25) {
    for (int i = 1 + static_cast<int>(rng.below(3)); i > 0; --i)
      task.no_fly.push_back(random_polygon(rng, Vec2(rng.uniform(-60.0, 200.0), rng.uniform(-60.0, 60.0)),
                                           rng.uniform(3.0, 30.0)));
  }
}

void add_rare_wishes(Rng& rng, ReplayTask& out) {
  Task& task = out.task;
  if (rng.uniform() < 0.5) draw_rules(rng, task);
  if (rng.uniform() < 0.2) task.start_m = random_start(rng, task, task.charger.start_m);
  if (rng.uniform() < 0.2) task.charger.start_m = random_start(rng, task, task.start_m);
  if (is_barred(task, task.start_m.head<2>())) task.start_m = Vec3(-100.0, -100.0, 0.0);
  if (rng.uniform() < 0.15) {
    task.vehicle.radius_m = rng.uniform(0.0, 1.5);
    task.vehicle.margin_m = rng.uniform(0.1, 4.0);
  }
  if (rng.uniform() < 0.15) task.vehicle.turn_max_rad = rng.uniform() < 0.5 ? 0.0 : std::numbers::pi;
  if (rng.uniform() < 0.1) task.battery.charge_s_per_unit = 0.0;
  if (rng.uniform() < 0.1) task.battery.reserve = 0.0;
  if (rng.uniform() < 0.1) task.battery.capacity = rng.uniform(25.0, 60.0);
  if (rng.uniform() < 0.05) task.battery.model.descent_per_s = 0.0;
  if (rng.uniform() < 0.05) task.battery.model.hover_per_s = 0.0;
  if (rng.uniform() < 0.1) task.charger.speed_mps = std::pow(10.0, rng.uniform(-1.5, 1.5));
}

}  // namespace swallowtail::coverage::test
