#include "coverage/schedule/graph.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace swallowtail::coverage {
namespace {

constexpr double kNoBattery = 1e9;

double site_distance(const SubCell& a, const SubCell& b) {
  return std::min({(a.alpha_m - b.alpha_m).norm(), (a.alpha_m - b.beta_m).norm(),
                   (a.beta_m - b.alpha_m).norm(), (a.beta_m - b.beta_m).norm()});
}

/// Which sub-cells are linked, as a symmetric relation.
class Neighbourhood {
 public:
  Neighbourhood(std::span<const SubCell> cells, double height_band_m, int neighbours)
      : size_(cells.size()), linked_(size_ * size_, 0) {
    by_distance_.resize(size_);
    for (std::size_t i = 0; i < size_; ++i) {
      std::vector<std::pair<double, std::size_t>> order;
      for (std::size_t j = 0; j < size_; ++j) {
        if (j == i) continue;
        if (std::abs(cells[i].alpha_m.z() - cells[j].alpha_m.z()) <= height_band_m + 1e-6)
          linked_[i * size_ + j] = 1;
        order.emplace_back(site_distance(cells[i], cells[j]), j);
      }
      std::sort(order.begin(), order.end());
      for (const auto& [distance, j] : order) by_distance_[i].push_back(j);
    }
    widen_to(neighbours);
    while (!is_connected()) widen_to(std::max(neighbours_ + 1, neighbours_ * 3 / 2));
  }

  bool linked(std::size_t i, std::size_t j) const { return linked_[i * size_ + j] != 0; }
  int neighbours() const { return neighbours_; }

 private:
  void widen_to(int neighbours) {
    neighbours_ = neighbours;
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t count = std::min(by_distance_[i].size(), static_cast<std::size_t>(neighbours));
      for (std::size_t n = 0; n < count; ++n) {
        linked_[i * size_ + by_distance_[i][n]] = 1;
        linked_[by_distance_[i][n] * size_ + i] = 1;
      }
    }
  }

  bool is_connected() const {
    std::vector<char> seen(size_, 0);
    std::vector<std::size_t> open{0};
    seen[0] = 1;
    std::size_t reached = 1;
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      for (std::size_t j = 0; j < size_; ++j) {
        if (seen[j] != 0 || !linked(i, j)) continue;
        seen[j] = 1;
        ++reached;
        open.push_back(j);
      }
    }
    return reached == size_;
  }

  std::size_t size_;
  int neighbours_ = 0;
  std::vector<char> linked_;
  std::vector<std::vector<std::size_t>> by_distance_;
};

/// Lists the arcs. Vertex of (sub-cell i, entry side s, level l of 1 … k): 1 + (2i + s)·k + l − 1.
class ArcBuilder {
 public:
  ArcBuilder(std::span<const SubCell> cells, const ScheduleStart& start, const GraphParams& params,
             LinkCache& links)
      : cells_(cells), start_(start), params_(params), links_(links), factor_(params.stops.energy_factor) {
    const Battery& battery = params.stops.battery;
    const bool counts = params.levels > 1;
    terms_ = {counts ? battery.capacity : kNoBattery,
              battery.reserve,
              battery.charging(),
              params.stops.charger.take_off_s,
              params.stops.charger.landing_s,
              counts ? factor_ : 0.0};
    for (const SubCell& cell : cells_) {
      cover_.push_back(links_.model().level(cell.alpha_m, cell.beta_m));
      // Either end counts: over terrain one may stand higher.
      landing_[0].push_back(links_.model().landing(cell.beta_m));
      landing_[1].push_back(links_.model().landing(cell.alpha_m));
    }
  }

  Status add_all(const Neighbourhood& near);
  std::vector<std::size_t> take_rows() { return std::move(first_arc_); }
  std::vector<gtsp::Arc> take_arcs() { return std::move(arcs_); }

 private:
  int vertex(std::size_t cell, int side, int level) const {
    return 1 + static_cast<int>(2 * cell + static_cast<std::size_t>(side)) * params_.levels + level - 1;
  }
  double energy_of(int level) const { return params_.stops.battery.capacity * level / params_.levels; }
  /// The least level with which the sub-cell can be entered, flown and left for the ground; levels + 1: none.
  int least_level(std::size_t cell, int side) const {
    if (params_.levels == 1) return 1;
    const double needs =
        params_.stops.battery.reserve + (cover_[cell].energy + landing_[side][cell].energy) * factor_;
    return std::max(1, static_cast<int>(std::ceil(needs / energy_of(1) - 1e-9)));
  }
  void add_from_start();
  /// Where an arc may lead, and the way there.
  struct Target {
    std::size_t cell = 0;
    int side = 0;
    int least_level = 1;
    LegLink link;
  };
  std::vector<Target> targets(std::size_t i, int side, const Neighbourhood& near);
  void add_row(std::size_t i, int level, const std::vector<Target>& targets);
  void end_row() { first_arc_.push_back(arcs_.size()); }

  std::span<const SubCell> cells_;
  const ScheduleStart& start_;
  const GraphParams& params_;
  LinkCache& links_;
  double factor_;
  TransferTerms terms_;
  std::vector<FlightCost> cover_;
  std::vector<FlightCost> landing_[2];
  std::vector<std::size_t> first_arc_{0};
  std::vector<gtsp::Arc> arcs_;
};

void ArcBuilder::add_from_start() {
  const FlightModel& model = links_.model();
  for (std::size_t j = 0; j < cells_.size(); ++j) {
    for (int side = 0; side < 2; ++side) {
      const FlownLeg leg = flown(cells_[j], side == 1);
      const FlightCost lift =
          start_.kind == StartKind::kAir
              ? model.transfer(start_.position_m, leg.entry_m, {start_.direction, leg.direction()})
              : model.take_off_to(start_.position_m, leg.entry_m, leg.direction());
      const int least = least_level(j, side);
      const double arrives = start_.energy - lift.energy * factor_;
      const int reached =
          params_.levels == 1
              ? 1
              : std::min(params_.levels, static_cast<int>(std::floor(arrives / energy_of(1) + 1e-9)));
      if (reached >= least) arcs_.push_back({vertex(j, side, reached), lift.time_s + cover_[j].time_s});
      if (start_.kind != StartKind::kDocked || params_.levels == 1) continue;
      for (int level = std::max(reached + 1, least); level <= params_.levels; ++level) {
        const double needs = energy_of(level) + lift.energy * factor_;
        if (needs > terms_.capacity) break;
        arcs_.push_back({vertex(j, side, level),
                         terms_.charging.seconds(start_.energy, needs) + lift.time_s + cover_[j].time_s});
      }
    }
  }
  end_row();
}

/// By cell, then by side, as vertices are numbered.
std::vector<ArcBuilder::Target> ArcBuilder::targets(std::size_t i, int side, const Neighbourhood& near) {
  std::vector<Target> out;
  const RouteLeg from = route_leg(cells_[i], {i, side == 1});
  for (std::size_t j = 0; j < cells_.size(); ++j) {
    if (i == j || !near.linked(i, j)) continue;
    for (int side_j = 0; side_j < 2; ++side_j) {
      const RouteLeg to = route_leg(cells_[j], {j, side_j == 1});
      out.push_back({j, side_j, least_level(j, side_j), links_.get(from.id, from.flown, to.id, to.flown)});
    }
  }
  return out;
}

void ArcBuilder::add_row(std::size_t i, int level, const std::vector<Target>& targets) {
  const double at_exit = params_.levels == 1 ? kNoBattery : energy_of(level) - cover_[i].energy * factor_;
  for (const Target& to : targets) {
    const double hop_s = to.link.hop.time_s;
    const double cover_s = cover_[to.cell].time_s;
    const int first = vertex(to.cell, to.side, 1);
    if (params_.levels == 1) {
      // Without a battery it may still be quicker to be carried nowhere: flying is the only transfer.
      arcs_.push_back({first, hop_s + cover_s});
      continue;
    }
    const double arrives = at_exit - to.link.hop.energy * factor_;
    const int flown_on = static_cast<int>(std::floor(arrives / energy_of(1) + 1e-9));
    if (flown_on >= to.least_level) arcs_.push_back({first + flown_on - 1, hop_s + cover_s});
    const TransferOptions options(to.link, at_exit, terms_);
    for (int next = std::max(flown_on + 1, to.least_level); next <= params_.levels; ++next) {
      const double transfer_s = options.least_s(energy_of(next));
      if (!std::isfinite(transfer_s)) break;  // a higher level asks for more still
      arcs_.push_back({first + next - 1, transfer_s + cover_s});
    }
  }
}

Status ArcBuilder::add_all(const Neighbourhood& near) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (least_level(i, 0) > params_.levels && least_level(i, 1) > params_.levels) {
      return infeasible("Sub-cell " + std::to_string(cells_[i].id) + " is too long for one battery.");
    }
  }
  add_from_start();
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    for (int side = 0; side < 2; ++side) {
      const std::vector<Target> to = targets(i, side, near);
      for (int level = 1; level <= params_.levels; ++level) {
        if (level >= least_level(i, side)) add_row(i, level, to);
        end_row();
      }
    }
  }
  return {};
}

}  // namespace

FlownLeg flown(const SubCell& cell, bool from_beta) {
  return from_beta ? FlownLeg{cell.beta_m, cell.alpha_m} : FlownLeg{cell.alpha_m, cell.beta_m};
}

RouteLeg route_leg(const SubCell& cell, const Visit& visit) {
  return {2 * cell.id + (visit.from_beta ? 1U : 0U), flown(cell, visit.from_beta)};
}

Result<LayeredGraph> LayeredGraph::build(std::span<const SubCell> cells, const ScheduleStart& start,
                                         const GraphParams& params, LinkCache& links) {
  const Neighbourhood near(cells, params.height_band_m, params.neighbours);
  ArcBuilder builder(cells, start, params, links);
  if (const Status status = builder.add_all(near); !status) return status.error();
  std::vector<gtsp::Arc> arcs = builder.take_arcs();
  const std::size_t arc_count = arcs.size();
  const int k = params.levels;
  const int vertices = 1 + 2 * k * static_cast<int>(cells.size());
  gtsp::Instance::Clusters clusters{{0}};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::vector<int> cluster(static_cast<std::size_t>(2 * k));
    std::iota(cluster.begin(), cluster.end(), 1 + static_cast<int>(i) * 2 * k);
    clusters.push_back(std::move(cluster));
  }
  Result<gtsp::Instance> instance =
      gtsp::Instance::from_rows(std::move(clusters), builder.take_rows(), std::move(arcs));
  if (!instance) return instance.error();
  return LayeredGraph(std::move(*instance), {vertices, arc_count, near.neighbours()}, k);
}

std::vector<Visit> LayeredGraph::decode(std::span<const int> tour) const {
  std::vector<Visit> out;
  for (const int vertex : tour) {
    if (vertex == 0) continue;
    const int site = (vertex - 1) / levels_;
    out.push_back({static_cast<std::size_t>(site / 2), site % 2 == 1});
  }
  return out;
}

std::vector<int> LayeredGraph::encode(std::span<const Visit> visits) const {
  std::vector<int> out{0};
  for (const Visit& visit : visits)
    out.push_back(1 + (2 * static_cast<int>(visit.sub_cell) + (visit.from_beta ? 1 : 0)) * levels_ + levels_ -
                  1);
  return out;
}

}  // namespace swallowtail::coverage
