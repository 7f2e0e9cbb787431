#include "coverage/gtsp/detail/incumbents.hpp"

#include <algorithm>

namespace swallowtail::gtsp::detail {
namespace {

double cost_of(const Instance& instance, const std::vector<int>& tour, TourKind kind) {
  double sum = 0.0;
  for (std::size_t i = 1; i < tour.size(); ++i) sum += instance.cost(tour[i - 1], tour[i]);
  if (kind == TourKind::kClosed && tour.size() > 1) sum += instance.cost(tour.back(), tour.front());
  return sum;
}

}  // namespace

Found found_from(const Instance& instance, const Anchor& anchor, const std::vector<int>& order,
                 const std::function<int(int)>& original, TourKind kind) {
  std::vector<int> rest;
  rest.reserve(order.size());
  for (const int v : order) rest.push_back(original(v));
  const auto at_anchor = std::find(rest.begin(), rest.end(), instance.vertex_count());
  if (at_anchor != rest.end()) {
    std::rotate(rest.begin(), at_anchor, rest.end());
    rest.erase(rest.begin());
  }
  Found found{expanded(anchor, rest), 0.0};
  found.cost = cost_of(instance, found.tour, kind);
  return found;
}

Incumbents::Incumbents(const Options& options)
    : options_(options), begin_s_(options.stop.clock != nullptr ? options.stop.clock->now_s() : 0.0) {}

double Incumbents::now_s() const {
  return options_.stop.clock != nullptr ? options_.stop.clock->now_s() - begin_s_ : 0.0;
}

void Incumbents::offer(const Found& found, std::uint64_t iteration) {
  const std::lock_guard lock(mutex_);
  if (!(found.cost < best_)) return;
  best_ = found.cost;
  history_.push_back({now_s(), found.cost});
  if (options_.on_incumbent)
    options_.on_incumbent({found.tour, found.cost, iteration, history_.back().wall_s});
}

std::vector<HistoryEntry> Incumbents::history() const {
  const std::lock_guard lock(mutex_);
  return history_;
}

}  // namespace swallowtail::gtsp::detail
