#include "qos/participant/percentiles.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail {

Percentiles::Percentiles(std::size_t capacity)
    : ring_(std::max<std::size_t>(capacity, 1)), sorted_(std::max<std::size_t>(capacity, 1)) {}

void Percentiles::add(double value) {
  if (!std::isfinite(value)) return;
  const std::lock_guard lock(mutex_);
  ring_[next_] = value;
  next_ = (next_ + 1) % ring_.size();
  held_ = std::min(held_ + 1, ring_.size());
  max_ = count_ == 0 ? value : std::max(max_, value);
  ++count_;
}

Percentiles::Summary Percentiles::summary() const {
  const std::lock_guard lock(mutex_);
  if (held_ == 0) return {};
  const auto first = sorted_.begin();
  const auto last = std::copy_n(ring_.begin(), held_, first);
  const auto at_share = [&](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(held_))) - 1;
    std::nth_element(first, first + rank, last);
    return *(first + rank);
  };
  return {.p50 = at_share(0.50), .p99 = at_share(0.99), .max = max_, .count = count_};
}

}  // namespace swallowtail
