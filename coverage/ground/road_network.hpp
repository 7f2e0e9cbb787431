#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "coverage/ground/ground_travel.hpp"
#include "planner/base/result.hpp"

namespace swallowtail::coverage {

struct RoadParams {
  std::vector<std::vector<Vec2>>
      lines;               ///< lines meet where vertices do, within join_m; a mere crossing is a bridge
  double speed_mps = 1.6;  ///< on the road
  double off_road_speed_mps = 0.0;  ///< between a place and the road; 0: it does not leave the road
  double off_road_max_m = 200.0;    ///< no place farther from the road is reached
  double join_m = 0.5;
};
inline constexpr std::size_t kMaxRoadVertices = 20'000;
/// A place this near to the road is on it.
inline constexpr double kOnRoad_m = 2.0;
/// Errors name the line and the rule: at least one line, two vertices each, finite, not too many; speeds.
Status validate(const RoadParams& params);

/// Along roads: from a place straight to the nearest point of any road, by shortest ways [DIJKSTRA] to the
/// one nearest to the other place, and straight to it. With an off-road speed a robot may also drive straight
/// from place to place over at most off_road_max_m, when that is quicker; wherever it is on such a way, it
/// has ways from there.
class RoadNetwork : public GroundTravel {
 public:
  static Result<std::shared_ptr<const RoadNetwork>> make(const RoadParams& params);

  double drive_s(const Vec2& from, const Vec2& to) const override;
  std::vector<Vec2> bends(const Vec2& from, const Vec2& to) const override;

 private:
  struct Road {
    int from = 0;
    int to = 0;
    double length_m = 0.0;
  };
  /// Where a place meets the road.
  struct Access {
    int road = -1;           ///< none within reach, from the middle of a straight way either
    bool is_within = false;  ///< off_road_max_m of it
    double along_m = 0.0;
    double away_s = 0.0;
    Vec2 point_m = Vec2::Zero();
  };
  /// A way from access to access: by which ends of their roads; −1: along one road.
  struct OnRoad {
    double length_m = 0.0;
    int first = -1;
    int last = -1;
  };

  explicit RoadNetwork(const RoadParams& params);
  int node_at(const Vec2& place);
  const Access& access(const Vec2& place) const;
  const std::vector<double>& distances_from(int node) const;
  OnRoad on_road(const Access& from, const Access& to) const;
  double straight_s(const Vec2& from, const Vec2& to) const;

  RoadParams params_;
  std::vector<Vec2> nodes_;
  std::vector<Road> roads_;
  std::vector<std::vector<int>> roads_of_;  ///< by node
  std::map<std::pair<long, long>, std::vector<int>> raster_;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<double, double>, Access> accesses_;
  mutable std::map<int, std::vector<double>> distances_;
};

}  // namespace swallowtail::coverage
