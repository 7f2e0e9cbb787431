#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "coverage/field/polygon.hpp"
#include "coverage/ground/ground_travel.hpp"
#include "planner/base/result.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::coverage {

struct RoughGroundParams {
  Vec2 lo_m = Vec2::Zero();  ///< the ground that the robot may use
  Vec2 hi_m = Vec2::Zero();
  double cell_m = 2.0;  ///< of the raster that ways are looked for on; wider where there would be too many
  double speed_mps = 1.6;
  double slope_max_rad = 0.35;
  std::vector<Polygon> forbidden;  ///< clean
};
inline constexpr int kMaxGroundCells = 40'000;
Status validate(const RoughGroundParams& params);

/// Over open ground that is neither too steep nor forbidden: shortest ways [DIJKSTRA] over a raster of cells,
/// from centre to centre in sixteen directions, at most 2.8 % longer than straight ones. A cell that holds
/// any ground too steep (by an upper bound of its slope) or touches a forbidden polygon is not entered, nor
/// is a corner between two such cells cut: the answer errs to the safe side by less than a cell.
class RoughGround : public GroundTravel {
 public:
  static Result<std::shared_ptr<const RoughGround>> make(const RoughGroundParams& params,
                                                         const planner::Terrain& terrain);

  double drive_s(const Vec2& from, const Vec2& to) const override;
  std::vector<Vec2> bends(const Vec2& from, const Vec2& to) const override;
  double cell_m() const { return params_.cell_m; }

 private:
  RoughGround(const RoughGroundParams& params, const planner::Terrain& terrain);
  int cell_at(const Vec2& place) const;  ///< −1: outside, or not to be entered
  Vec2 centre(int cell) const;
  bool is_open(int row, int col) const;
  bool may_move(int row, int col, int rows, int cols) const;
  const std::vector<float>& distances_from(int cell) const;

  RoughGroundParams params_;
  int rows_ = 0;
  int cols_ = 0;
  std::vector<char> open_;
  mutable std::mutex mutex_;
  mutable std::map<int, std::vector<float>> distances_;  ///< metres, by the cell they are from
};

}  // namespace swallowtail::coverage
