#include "coverage/schedule/near_sites.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::coverage {
namespace {

constexpr double kSitesPerSquare = 2.0;
constexpr double kMostSquaresPerSide = 2000.0;

}  // namespace

NearSites::NearSites(std::span<const SubCell> cells) {
  for (const SubCell& cell : cells) {
    sites_m_.push_back(cell.alpha_m);
    sites_m_.push_back(cell.beta_m);
  }
  Vec2 lo = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 hi = -lo;
  for (const Vec3& site : sites_m_) {
    lo = lo.cwiseMin(site.head<2>());
    hi = hi.cwiseMax(site.head<2>());
  }
  corner_m_ = lo;
  const Vec2 extent = (hi - lo).cwiseMax(1.0);
  side_m_ =
      std::max(std::sqrt(extent.x() * extent.y() * kSitesPerSquare / static_cast<double>(sites_m_.size())),
               extent.maxCoeff() / kMostSquaresPerSide);
  columns_ = static_cast<std::size_t>(extent.x() / side_m_) + 1;
  rows_ = static_cast<std::size_t>(extent.y() / side_m_) + 1;
  first_.assign(columns_ * rows_ + 1, 0);
  const auto square = [this](const Vec3& p) { return row_of(p.y()) * columns_ + column_of(p.x()); };
  for (const Vec3& site : sites_m_) ++first_[square(site) + 1];
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) first_[i + 1] += first_[i];
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  listed_.resize(sites_m_.size());
  for (std::size_t i = 0; i < sites_m_.size(); ++i) listed_[next[square(sites_m_[i])]++] = i;
}

std::size_t NearSites::column_of(double x_m) const {
  return std::min(columns_ - 1, static_cast<std::size_t>((x_m - corner_m_.x()) / side_m_));
}

std::size_t NearSites::row_of(double y_m) const {
  return std::min(rows_ - 1, static_cast<std::size_t>((y_m - corner_m_.y()) / side_m_));
}

std::vector<NearSites::Near> NearSites::of(std::size_t site, std::size_t count) const {
  const Vec3& at = sites_m_[site];
  const std::size_t column = column_of(at.x());
  const std::size_t row = row_of(at.y());
  std::vector<Near> out;
  const auto look = [&](std::size_t c, std::size_t r) {
    const std::size_t square = r * columns_ + c;
    for (std::size_t k = first_[square]; k < first_[square + 1]; ++k) {
      const std::size_t other = listed_[k];
      if (other / 2 != site / 2) out.push_back({(sites_m_[other] - at).norm(), other});
    }
  };
  // Squares in rings around the site's own; what lies beyond ring i is farther than i sides.
  const std::size_t rings = std::max({column, columns_ - 1 - column, row, rows_ - 1 - row});
  for (std::size_t ring = 0; ring <= rings; ++ring) {
    const std::size_t left = column >= ring ? column - ring : 0;
    const std::size_t right = std::min(columns_ - 1, column + ring);
    const std::size_t low = row >= ring ? row - ring : 0;
    const std::size_t high = std::min(rows_ - 1, row + ring);
    for (std::size_t r = low; r <= high; ++r) {
      const bool whole = row - r == ring || r - row == ring;
      if (whole) {
        for (std::size_t c = left; c <= right; ++c) look(c, r);
        continue;
      }
      if (column >= ring) look(left, r);
      if (column + ring < columns_) look(right, r);
    }
    if (out.size() < count) continue;
    std::nth_element(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count) - 1, out.end());
    if (out[count - 1].distance_m <= static_cast<double>(ring) * side_m_) break;
  }
  std::sort(out.begin(), out.end());
  if (out.size() > count) out.resize(count);
  return out;
}

}  // namespace swallowtail::coverage
