#include "planner/swarm/hypervolume.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace swallowtail::swarm {
namespace {

constexpr std::size_t kMaxObjectives = 4;
using Point = std::array<double, kMaxObjectives>;

/// The plane below a staircase: corners sorted by x ascending, y descending, none dominating another.
class Staircase {
 public:
  Staircase(double reference_x, double reference_y) : reference_x_(reference_x), reference_y_(reference_y) {}
  void clear() {
    corners_.clear();
    area_ = 0.0;
  }
  double area() const { return area_; }

  void add(double x, double y) {
    auto after = std::upper_bound(corners_.begin(), corners_.end(), x,
                                  [](double v, const Corner& corner) { return v < corner.x; });
    if (after != corners_.begin() && std::prev(after)->y <= y) return;
    auto first = after;
    if (first != corners_.begin() && std::prev(first)->x == x) --first;
    double height = first == corners_.begin() ? reference_y_ : std::prev(first)->y;
    double from = x;
    auto last = first;
    // What the new corner adds, step by step up to the first old corner below it.
    while (last != corners_.end() && last->y >= y) {
      area_ += (last->x - from) * (height - y);
      from = last->x;
      height = last->y;
      ++last;
    }
    area_ += ((last == corners_.end() ? reference_x_ : last->x) - from) * (height - y);
    if (first == last) {
      corners_.insert(first, {x, y});
    } else {
      *first = {x, y};
      corners_.erase(first + 1, last);
    }
  }

 private:
  struct Corner {
    double x;
    double y;
  };
  double reference_x_;
  double reference_y_;
  double area_ = 0.0;
  std::vector<Corner> corners_;
};

double volume_2(const std::vector<Point>& points, Staircase& staircase) {
  staircase.clear();
  for (const Point& p : points) staircase.add(p[0], p[1]);
  return staircase.area();
}

/// Sweeps over the third objective, by which the points are sorted.
double volume_3(const std::vector<Point>& points, const Point& reference, Staircase& staircase) {
  staircase.clear();
  double volume = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    staircase.add(points[i][0], points[i][1]);
    const double next = i + 1 < points.size() ? points[i + 1][2] : reference[2];
    volume += staircase.area() * (next - points[i][2]);
  }
  return volume;
}

/// Sweeps over the fourth objective; the volume in the first three grows by what each point adds to it alone:
/// its box less what the others cover of it. `by_third` holds those seen, sorted by the third objective.
double volume_4(std::vector<Point>& points, const Point& reference, Staircase& staircase) {
  std::vector<Point> by_third;
  std::vector<Point> clipped;
  by_third.reserve(points.size());
  double volume = 0.0;
  double slice = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    clipped.clear();
    bool covered = false;
    for (const Point& q : by_third) {
      clipped.push_back({std::max(p[0], q[0]), std::max(p[1], q[1]), std::max(p[2], q[2]), 0.0});
      covered = covered || (q[0] <= p[0] && q[1] <= p[1] && q[2] <= p[2]);
    }
    if (!covered) {
      const double box = (reference[0] - p[0]) * (reference[1] - p[1]) * (reference[2] - p[2]);
      slice += box - volume_3(clipped, reference, staircase);
      std::erase_if(by_third, [&p](const Point& q) { return p[0] <= q[0] && p[1] <= q[1] && p[2] <= q[2]; });
      by_third.insert(std::upper_bound(by_third.begin(), by_third.end(), p,
                                       [](const Point& a, const Point& b) { return a[2] < b[2]; }),
                      p);
    }
    volume += slice * ((i + 1 < points.size() ? points[i + 1][3] : reference[3]) - p[3]);
  }
  return volume;
}

double volume(std::vector<Point>& points, const Point& reference, std::size_t objectives) {
  const std::size_t last = objectives - 1;
  std::sort(points.begin(), points.end(),
            [last](const Point& a, const Point& b) { return a[last] < b[last]; });
  if (points.empty()) return 0.0;
  if (objectives == 1) return reference[0] - points.front()[0];
  Staircase staircase(reference[0], reference[1]);
  if (objectives == 2) return volume_2(points, staircase);
  if (objectives == 3) return volume_3(points, reference, staircase);
  return volume_4(points, reference, staircase);
}

Point point_of(const Eigen::Ref<const Eigen::VectorXd>& v) {
  Point p{};
  std::copy(v.begin(), v.end(), p.begin());
  return p;
}

}  // namespace

double hypervolume(const Eigen::Ref<const Eigen::MatrixXd>& objectives, const Eigen::VectorXd& reference) {
  std::vector<Point> points;
  points.reserve(static_cast<std::size_t>(objectives.cols()));
  for (Eigen::Index i = 0; i < objectives.cols(); ++i) {
    if ((objectives.col(i).array() < reference.array()).all()) points.push_back(point_of(objectives.col(i)));
  }
  return volume(points, point_of(reference), static_cast<std::size_t>(reference.size()));
}

Eigen::VectorXd hypervolume_contributions(const Eigen::Ref<const Eigen::MatrixXd>& objectives,
                                          const Eigen::VectorXd& reference) {
  const auto m = static_cast<std::size_t>(reference.size());
  const Point corner = point_of(reference);
  Eigen::VectorXd contributions = Eigen::VectorXd::Zero(objectives.cols());
  std::vector<Point> clipped;
  for (Eigen::Index i = 0; i < objectives.cols(); ++i) {
    const auto p = objectives.col(i);
    if (!(p.array() < reference.array()).all()) continue;
    // What the others cover of this point's box; all of it where one dominates the point.
    clipped.clear();
    for (Eigen::Index j = 0; j < objectives.cols(); ++j) {
      const auto q = objectives.col(j).cwiseMax(p);
      if (j != i && (q.array() < reference.array()).all()) clipped.push_back(point_of(q));
    }
    contributions[i] = std::max(0.0, (reference - p).prod() - volume(clipped, corner, m));
  }
  return contributions;
}

}  // namespace swallowtail::swarm
