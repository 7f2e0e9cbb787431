#include "planner/swarm/pareto_archive.hpp"

#include <algorithm>
#include <cmath>

#include "planner/base/checks.hpp"

namespace swallowtail::swarm {

bool dominates(const Eigen::Ref<const Eigen::VectorXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b) {
  bool better = false;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (a[i] > b[i]) return false;
    better = better || a[i] < b[i];
  }
  return better;
}

Status validate(const ArchiveParams& params) {
  if (params.capacity < 1 || params.capacity > 10000) {
    return bad_input("The archive's capacity is " + std::to_string(params.capacity) +
                     "; it must be 1 to 10000.");
  }
  if (params.divisions < 2 || params.divisions > 64) {
    return bad_input("The archive's divisions are " + std::to_string(params.divisions) +
                     "; they must be 2 to 64.");
  }
  if (!is_within(params.crowding, 0.0, 100.0)) {
    return bad_input("The archive's crowding is " + std::to_string(params.crowding) +
                     "; it must be 0 to 100.");
  }
  return {};
}

ParetoArchive::ParetoArchive(const ArchiveParams& params, Eigen::Index dimension, Eigen::Index objectives)
    : params_(params),
      decisions_(dimension, params.capacity + 1),
      objectives_(objectives, params.capacity + 1),
      cell_(static_cast<std::size_t>(params.capacity) + 1),
      members_in_cell_(static_cast<std::size_t>(params.capacity) + 1) {}

void ParetoArchive::remove(Eigen::Index i) {
  --size_;
  if (i != size_) {
    decisions_.col(i) = decisions_.col(size_);
    objectives_.col(i) = objectives_.col(size_);
  }
  cells_valid_ = false;
}

bool ParetoArchive::offer(const Eigen::Ref<const Eigen::VectorXd>& decision,
                          const Eigen::Ref<const Eigen::VectorXd>& objectives, Rng& rng) {
  if (!objectives.allFinite()) return false;
  for (Eigen::Index i = 0; i < size_; ++i) {
    if ((objectives_.col(i).array() <= objectives.array()).all()) return false;
  }
  for (Eigen::Index i = size_ - 1; i >= 0; --i) {
    if ((objectives.array() <= objectives_.col(i).array()).all()) remove(i);
  }
  decisions_.col(size_) = decision;
  objectives_.col(size_) = objectives;
  ++size_;
  cells_valid_ = false;
  if (size_ <= params_.capacity) return true;
  const Eigen::Index newest = size_ - 1;
  const Eigen::Index gone = draw(params_.crowding, rng);
  remove(gone);
  return gone != newest;
}

void ParetoArchive::update_cells() const {
  if (cells_valid_) return;
  const Eigen::Index m = objectives_.rows();
  std::fill_n(cell_.begin(), size_, 0);
  for (Eigen::Index o = 0; o < m; ++o) {
    const auto values = objectives_.row(o).head(size_);
    const double min = values.minCoeff();
    const double extent = values.maxCoeff() - min;
    const double epsilon = extent / (2.0 * (params_.divisions - 1));
    for (Eigen::Index i = 0; i < size_; ++i) {
      double c = 0.0;
      if (extent > 0.0) {
        c = std::floor(params_.divisions * (values[i] - (min - epsilon)) / (extent + 2.0 * epsilon));
      }
      const auto index = static_cast<std::uint64_t>(std::clamp(c, 0.0, params_.divisions - 1.0));
      auto& cell = cell_[static_cast<std::size_t>(i)];
      cell = cell * static_cast<std::uint64_t>(params_.divisions) + index;
    }
  }
  for (Eigen::Index i = 0; i < size_; ++i) {
    const auto at = static_cast<std::size_t>(i);
    members_in_cell_[at] = static_cast<int>(std::count(cell_.begin(), cell_.begin() + size_, cell_[at]));
  }
  cells_valid_ = true;
}

/// A member: its cell with weight e^{exponent·N}, evenly within the cell. Weights are taken relative to the
/// greatest, so that none overflows.
Eigen::Index ParetoArchive::draw(double exponent, Rng& rng) const {
  update_cells();
  const auto n = static_cast<std::size_t>(size_);
  double greatest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) greatest = std::max(greatest, exponent * members_in_cell_[i]);
  const auto weight = [&](std::size_t i) {
    return std::exp(exponent * members_in_cell_[i] - greatest) / members_in_cell_[i];
  };
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += weight(i);
  double left = rng.uniform() * sum;
  for (std::size_t i = 0; i < n; ++i) {
    left -= weight(i);
    if (left < 0.0) return static_cast<Eigen::Index>(i);
  }
  return size_ - 1;
}

Eigen::Index ParetoArchive::draw_leader(Rng& rng) const { return draw(-params_.crowding, rng); }

}  // namespace swallowtail::swarm
