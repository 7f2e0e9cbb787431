#include "coverage/ground/road_network.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <string>
#include <utility>

#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

/// Half way straight from place to place it is so much farther off the road, in off_road_max_m.
constexpr double kStraightShare = 1.5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMost_m = 1e6;

double along_of(const Vec2& from, const Vec2& to, const Vec2& place) {
  const Vec2 way = to - from;
  const double square = way.squaredNorm();
  return square > 0.0 ? std::clamp((place - from).dot(way) / square, 0.0, 1.0) : 0.0;
}

}  // namespace

Status validate(const RoadParams& params) {
  if (!is_positive(params.speed_mps)) return bad_input("The robot's speed on the road must be positive.");
  if (!is_non_negative(params.off_road_speed_mps))
    return bad_input("The robot's speed off the road must not be negative.");
  if (params.off_road_speed_mps > params.speed_mps)
    return bad_input("The robot must not be faster off the road than on it.");
  if (!is_non_negative(params.off_road_max_m))
    return bad_input("How far the robot may leave the road must not be negative.");
  if (!is_positive(params.join_m)) return bad_input("The distance within which roads join must be positive.");
  if (params.lines.empty()) return bad_input("The road network has no line.");
  std::size_t vertices = 0;
  for (std::size_t i = 0; i < params.lines.size(); ++i) {
    const std::string name = "Road " + std::to_string(i + 1);
    if (params.lines[i].size() < 2) return bad_input(name + " has fewer than two vertices.");
    for (const Vec2& p : params.lines[i]) {
      if (!is_finite(p) || p.cwiseAbs().maxCoeff() > kMost_m)
        return bad_input(name + " has a vertex that is not finite, or farther off than 1000 km.");
    }
    vertices += params.lines[i].size();
  }
  if (vertices > kMaxRoadVertices) {
    return bad_input("The road network has " + std::to_string(vertices) + " vertices; at most " +
                     std::to_string(kMaxRoadVertices) + " are taken.");
  }
  return {};
}

Result<std::shared_ptr<const RoadNetwork>> RoadNetwork::make(const RoadParams& params) {
  if (const Status status = validate(params); !status) return status.error();
  std::shared_ptr<const RoadNetwork> out(new RoadNetwork(params));
  if (out->roads_.empty()) return bad_input("The road network's lines are all shorter than they join.");
  return out;
}

RoadNetwork::RoadNetwork(const RoadParams& params) : params_(params) {
  for (const std::vector<Vec2>& line : params_.lines) {
    int before = -1;
    for (const Vec2& place : line) {
      const int node = node_at(place);
      if (before >= 0 && node != before) {
        const int road = static_cast<int>(roads_.size());
        roads_.push_back(
            {before, node,
             (nodes_[static_cast<std::size_t>(node)] - nodes_[static_cast<std::size_t>(before)]).norm()});
        roads_of_[static_cast<std::size_t>(before)].push_back(road);
        roads_of_[static_cast<std::size_t>(node)].push_back(road);
      }
      before = node;
    }
  }
}

/// The node within join_m, or a new one.
int RoadNetwork::node_at(const Vec2& place) {
  const long col = std::lround(std::floor(place.x() / params_.join_m));
  const long row = std::lround(std::floor(place.y() / params_.join_m));
  for (long r = row - 1; r <= row + 1; ++r) {
    for (long c = col - 1; c <= col + 1; ++c) {
      const auto cell = raster_.find({r, c});
      if (cell == raster_.end()) continue;
      for (const int node : cell->second) {
        if ((nodes_[static_cast<std::size_t>(node)] - place).norm() <= params_.join_m) return node;
      }
    }
  }
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back(place);
  roads_of_.emplace_back();
  raster_[{row, col}].push_back(node);
  return node;
}

const RoadNetwork::Access& RoadNetwork::access(const Vec2& place) const {
  const auto [found, is_new] = accesses_.try_emplace({place.x(), place.y()});
  Access& out = found->second;
  if (!is_new) return out;
  double least = kInfinity;
  for (std::size_t i = 0; i < roads_.size(); ++i) {
    const Vec2& from = nodes_[static_cast<std::size_t>(roads_[i].from)];
    const Vec2& to = nodes_[static_cast<std::size_t>(roads_[i].to)];
    const double share = along_of(from, to, place);
    const Vec2 point = from + share * (to - from);
    const double away = (place - point).norm();
    if (away >= least) continue;
    least = away;
    out = {static_cast<int>(i), false, share * roads_[i].length_m, 0.0, point};
  }
  const bool leaves = least > kOnRoad_m;
  if (leaves && (params_.off_road_speed_mps <= 0.0 || least > kStraightShare * params_.off_road_max_m))
    out.road = -1;
  out.is_within = !leaves || least <= params_.off_road_max_m;
  out.away_s = least / (params_.off_road_speed_mps > 0.0 ? params_.off_road_speed_mps : params_.speed_mps);
  return out;
}

const std::vector<double>& RoadNetwork::distances_from(int node) const {
  const auto [found, is_new] = distances_.try_emplace(node);
  std::vector<double>& out = found->second;
  if (!is_new) return out;
  out.assign(nodes_.size(), kInfinity);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  out[static_cast<std::size_t>(node)] = 0.0;
  open.emplace(0.0, node);
  while (!open.empty()) {
    const auto [distance, at] = open.top();
    open.pop();
    if (distance > out[static_cast<std::size_t>(at)]) continue;
    for (const int road : roads_of_[static_cast<std::size_t>(at)]) {
      const Road& r = roads_[static_cast<std::size_t>(road)];
      const int to = r.from == at ? r.to : r.from;
      const double there = distance + r.length_m;
      if (there >= out[static_cast<std::size_t>(to)]) continue;
      out[static_cast<std::size_t>(to)] = there;
      open.emplace(there, to);
    }
  }
  return out;
}

RoadNetwork::OnRoad RoadNetwork::on_road(const Access& from, const Access& to) const {
  OnRoad best{kInfinity, -1, -1};
  if (from.road == to.road) best.length_m = std::abs(from.along_m - to.along_m);
  const Road& a = roads_[static_cast<std::size_t>(from.road)];
  const Road& b = roads_[static_cast<std::size_t>(to.road)];
  for (const int first : {a.from, a.to}) {
    const double before = first == a.from ? from.along_m : a.length_m - from.along_m;
    const std::vector<double>& distances = distances_from(first);
    for (const int last : {b.from, b.to}) {
      const double after = last == b.from ? to.along_m : b.length_m - to.along_m;
      const double length = before + distances[static_cast<std::size_t>(last)] + after;
      if (length < best.length_m - 1e-9) best = {length, first, last};
    }
  }
  return best;
}

double RoadNetwork::straight_s(const Vec2& from, const Vec2& to) const {
  const double length = (to - from).norm();
  if (length < 1e-6) return 0.0;
  if (params_.off_road_speed_mps <= 0.0 || length > params_.off_road_max_m) return kInfinity;
  return length / params_.off_road_speed_mps;
}

double RoadNetwork::drive_s(const Vec2& from, const Vec2& to) const {
  const std::lock_guard lock(mutex_);
  const Access& begin = access(from);
  const Access& end = access(to);
  if (begin.road < 0 || end.road < 0 || !end.is_within) return kInfinity;
  const double by_road = begin.away_s + on_road(begin, end).length_m / params_.speed_mps + end.away_s;
  return std::min(by_road, straight_s(from, to));
}

std::vector<Vec2> RoadNetwork::bends(const Vec2& from, const Vec2& to) const {
  const std::lock_guard lock(mutex_);
  const Access& begin = access(from);
  const Access& end = access(to);
  if (begin.road < 0 || end.road < 0 || !end.is_within) return {};
  const OnRoad way = on_road(begin, end);
  const double by_road = begin.away_s + way.length_m / params_.speed_mps + end.away_s;
  if (!std::isfinite(by_road) || straight_s(from, to) <= by_road) return {};
  std::vector<Vec2> out{begin.point_m};
  if (way.first >= 0) {
    // From the last node back to the first, downhill over the distances from the first.
    const std::vector<double>& distances = distances_from(way.first);
    std::vector<Vec2> nodes;
    int at = way.last;
    nodes.push_back(nodes_[static_cast<std::size_t>(at)]);
    while (at != way.first) {
      for (const int road : roads_of_[static_cast<std::size_t>(at)]) {
        const Road& r = roads_[static_cast<std::size_t>(road)];
        const int before = r.from == at ? r.to : r.from;
        if (distances[static_cast<std::size_t>(before)] + r.length_m !=
            distances[static_cast<std::size_t>(at)])
          continue;
        at = before;
        break;
      }
      nodes.push_back(nodes_[static_cast<std::size_t>(at)]);
    }
    out.insert(out.end(), nodes.rbegin(), nodes.rend());
  }
  out.push_back(end.point_m);
  return out;
}

}  // namespace swallowtail::coverage
