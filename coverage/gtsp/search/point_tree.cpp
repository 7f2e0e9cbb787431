#include "coverage/gtsp/search/point_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::gtsp::search {
namespace {

constexpr int kLeaf = 8;

void take(const PointTree::Found& one, std::size_t most, std::vector<PointTree::Found>& found) {
  const auto same =
      std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.cluster == one.cluster; });
  if (same != found.end()) {
    if (same->distance2 <= one.distance2) return;
    found.erase(same);
  } else if (found.size() == most) {
    if (found.back().distance2 <= one.distance2) return;
    found.pop_back();
  }
  const auto place = std::upper_bound(found.begin(), found.end(), one,
                                      [](const auto& a, const auto& b) { return a.distance2 < b.distance2; });
  found.insert(place, one);
}

}  // namespace

PointTree::PointTree(const Problem& problem) : problem_(problem) {
  const bool is_sphere = problem.metric() == Metric::kGeo || problem.metric() == Metric::kGeom;
  for (const Point& p : problem.points()) {
    place_.push_back(is_sphere
                         ? Place{std::cos(p.x) * std::cos(p.y), std::cos(p.x) * std::sin(p.y), std::sin(p.x)}
                         : Place{p.x, p.y, 0.0});
    order_.push_back(static_cast<int>(order_.size()));
  }
  axis_.assign(order_.size(), -1);
  build(0, static_cast<int>(order_.size()));
}

int PointTree::widest_axis(int begin, int end) const {
  Place low;
  Place high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (int i = begin; i < end; ++i) {
    const Place& p = place_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  int widest = 0;
  for (int k = 1; k < 3; ++k) {
    const auto a = static_cast<std::size_t>(k);
    const auto b = static_cast<std::size_t>(widest);
    if (high[a] - low[a] > high[b] - low[b]) widest = k;
  }
  return widest;
}

void PointTree::build(int begin, int end) {
  if (end - begin <= kLeaf) return;
  const int axis = widest_axis(begin, end);
  const int middle = begin + (end - begin) / 2;
  const auto coordinate = [&](int v) {
    return place_[static_cast<std::size_t>(v)][static_cast<std::size_t>(axis)];
  };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
    return coordinate(a) != coordinate(b) ? coordinate(a) < coordinate(b) : a < b;
  });
  axis_[static_cast<std::size_t>(middle)] = static_cast<signed char>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

void PointTree::look(int begin, int end, const Question& question, std::vector<Found>& found) const {
  const auto visit = [&](int i) {
    const int v = order_[static_cast<std::size_t>(i)];
    const int cluster = problem_.cluster_of(v);
    if (cluster == question.own_cluster) return;
    const Place& p = place_[static_cast<std::size_t>(v)];
    double distance2 = 0.0;
    for (std::size_t k = 0; k < 3; ++k) distance2 += (p[k] - question.from[k]) * (p[k] - question.from[k]);
    take({distance2, v, cluster}, question.most, found);
  };
  if (end - begin <= kLeaf) {
    for (int i = begin; i < end; ++i) visit(i);
    return;
  }
  const int middle = begin + (end - begin) / 2;
  const auto axis = static_cast<std::size_t>(axis_[static_cast<std::size_t>(middle)]);
  const double side =
      question.from[axis] - place_[static_cast<std::size_t>(order_[static_cast<std::size_t>(middle)])][axis];
  const auto look_left = [&] { look(begin, middle, question, found); };
  const auto look_right = [&] { look(middle + 1, end, question, found); };
  side < 0.0 ? look_left() : look_right();
  visit(middle);
  if (found.size() == question.most && side * side > found.back().distance2) return;
  side < 0.0 ? look_right() : look_left();
}

const std::vector<int>& PointTree::nearest_of_clusters(int v, std::size_t most, Search& search) const {
  search.found.clear();
  const Question question{place_[static_cast<std::size_t>(v)], problem_.cluster_of(v), most};
  look(0, static_cast<int>(order_.size()), question, search.found);
  search.answer.clear();
  for (const Found& f : search.found) search.answer.push_back(f.vertex);
  return search.answer;
}

}  // namespace swallowtail::gtsp::search
