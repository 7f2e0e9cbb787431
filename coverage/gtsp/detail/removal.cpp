#include "coverage/gtsp/detail/removal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::gtsp::detail {
namespace {

constexpr int kMaxString = 10;

/// 0 … n − 1, the smaller the likelier.
int skewed(Rng& rng, int n, double power) { return static_cast<int>(std::pow(rng.uniform(), power) * n); }

}  // namespace

int Remover::seed(const WorkTour& tour) {
  int p = static_cast<int>(rng_.below(static_cast<std::uint64_t>(tour.size())));
  if (tour.score.missing == 0 || rng_.below(4) == 0) return p;
  while (!std::isinf(tour.edge_at(p))) p = tour.next(p);
  return rng_.below(2) == 0 ? p : tour.next(p);
}

void Remover::mark(const WorkTour& tour, int p) {
  if (is_marked_[at(p)] != 0) return;
  is_marked_[at(p)] = 1;
  removed_.push_back(cluster_at(tour, p));
}

void Remover::remove(const WorkTour& from, int count, RemovalRule rule, WorkTour& to) {
  for (int p = 0; p < from.size(); ++p) position_[at(cluster_at(from, p))] = p;
  is_marked_.assign(at(from.size()), 0);
  removed_.clear();
  count = std::clamp(count, 0, from.size() - 2);
  switch (rule) {
    case RemovalRule::kStrings:
      mark_strings(from, count);
      break;
    case RemovalRule::kSegment:
      mark_segment(from, count);
      break;
    case RemovalRule::kNear:
      mark_near(from, count);
      break;
    case RemovalRule::kWorst:
      mark_worst(from, count);
      break;
    case RemovalRule::kRandom:
      mark_random(from, count);
      break;
  }
  copy_rest(from, to);
}

void Remover::mark_string(const WorkTour& tour, int p, int length, int count) {
  int q = p - static_cast<int>(rng_.below(static_cast<std::uint64_t>(length)));
  if (q < 0) q += tour.size();
  for (int i = 0; i < length && static_cast<int>(removed_.size()) < count; ++i, q = tour.next(q))
    mark(tour, q);
}

void Remover::mark_strings(const WorkTour& tour, int count) {
  const int centre = seed(tour);
  const int longest = std::min(kMaxString, count);
  if (longest < 1) return;
  const auto length = [&] { return 1 + static_cast<int>(rng_.below(static_cast<std::uint64_t>(longest))); };
  mark_string(tour, centre, length(), count);
  for (const int c : reduced_.neighbours(cluster_at(tour, centre))) {
    if (static_cast<int>(removed_.size()) >= count) return;
    if (is_marked_[at(position_[at(c)])] == 0) mark_string(tour, position_[at(c)], length(), count);
  }
}

void Remover::mark_segment(const WorkTour& tour, int count) {
  int p = seed(tour);
  for (int i = 0; i < count; ++i, p = tour.next(p)) mark(tour, p);
}

void Remover::mark_near(const WorkTour& tour, int count) {
  if (count < 1) return;
  const int centre = seed(tour);
  mark(tour, centre);
  const auto& near = reduced_.neighbours(cluster_at(tour, centre));
  for (int tries = 0; static_cast<int>(removed_.size()) < count && tries < 3 * count; ++tries) {
    const int reach = std::min(static_cast<int>(near.size()), 2 * count);
    mark(tour, position_[at(near[at(skewed(rng_, reach, 2.0))])]);
  }
}

void Remover::mark_worst(const WorkTour& tour, int count) {
  by_gain_.clear();
  for (int p = 0; p < tour.size(); ++p) {
    const float direct = reduced_.cost(tour.at(tour.previous(p)), tour.at(tour.next(p)));
    const float around = tour.edge_at(tour.previous(p)) + tour.edge_at(p);
    const float gain = std::isinf(around) ? std::numeric_limits<float>::max() : around - direct;
    by_gain_.emplace_back(-gain * static_cast<float>(rng_.uniform()), p);
  }
  std::nth_element(by_gain_.begin(), by_gain_.begin() + count, by_gain_.end());
  for (int i = 0; i < count; ++i) mark(tour, by_gain_[at(i)].second);
}

void Remover::mark_random(const WorkTour& tour, int count) {
  for (int i = 0; i < count; ++i)
    mark(tour, static_cast<int>(rng_.below(static_cast<std::uint64_t>(tour.size()))));
}

void Remover::copy_rest(const WorkTour& from, WorkTour& to) {
  to.order.clear();
  to.edge.clear();
  to.score = from.score;
  bool is_gap = false;
  for (int p = 0; p < from.size(); ++p) {
    if (is_marked_[at(p)] != 0) {
      to.score.subtract(from.edge_at(p));
      is_gap = true;
      continue;
    }
    if (is_gap && !to.order.empty()) {
      to.score.subtract(to.edge.back());
      to.edge.back() = reduced_.cost(to.order.back(), from.at(p));
      to.score.add(to.edge.back());
    }
    is_gap = false;
    to.order.push_back(from.at(p));
    to.edge.push_back(from.edge_at(p));
  }
  const bool is_open_seam = is_marked_.front() != 0 || is_marked_.back() != 0;
  if (!is_open_seam) return;
  to.score.subtract(to.edge.back());
  to.edge.back() = reduced_.cost(to.order.back(), to.order.front());
  to.score.add(to.edge.back());
}

}  // namespace swallowtail::gtsp::detail
