#include "tools/mission/check/swath.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/mission/check/areas.hpp"

namespace swallowtail::check {
namespace {

constexpr double kMaxCells = 4e6;

}  // namespace

bool Swath::is_asked_for(const Rules& rules, std::size_t field, const P2& centre) const {
  const Rings& rings = rules.fields[field].rings;
  if (!holds(rings, centre)) return false;
  if (rules.skipped_border_m > 0.0 && border_distance_m(rings, centre) < rules.skipped_border_m) return false;
  return std::none_of(rules.no_fly.begin(), rules.no_fly.end(),
                      [&](const Rings& area) { return holds(area, centre); });
}

Swath::Swath(const Rules& rules, double cell_m) : cell_m_(cell_m) {
  const std::vector<FieldArea>& fields = rules.fields;
  constexpr double kInf = std::numeric_limits<double>::infinity();
  P2 lo{kInf, kInf};
  P2 hi{-kInf, -kInf};
  for (const auto& field : fields) {
    for (const auto& ring : field.rings) {
      for (const P2& p : ring) {
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
      }
    }
  }
  if (!(hi.x > lo.x) || !(hi.y > lo.y)) return;
  cell_m_ = std::max(cell_m, std::sqrt((hi.x - lo.x) * (hi.y - lo.y) / kMaxCells));
  origin_ = lo;
  cols_ = static_cast<std::size_t>(std::ceil((hi.x - lo.x) / cell_m_));
  rows_ = static_cast<std::size_t>(std::ceil((hi.y - lo.y) / cell_m_));
  owner_.assign(rows_ * cols_, -1);
  swept_.assign(rows_ * cols_, false);
  for (std::size_t f = 0; f < fields.size(); ++f) {
    for (std::size_t r = 0; r < rows_; ++r) {
      for (std::size_t c = 0; c < cols_; ++c) {
        const P2 centre{lo.x + (static_cast<double>(c) + 0.5) * cell_m_,
                        lo.y + (static_cast<double>(r) + 0.5) * cell_m_};
        auto& owner = owner_[r * cols_ + c];
        if (owner < 0 && is_asked_for(rules, f, centre)) owner = static_cast<std::int16_t>(f);
      }
    }
  }
}

void Swath::sweep(const P2& a, const P2& b, double width_m, std::size_t field) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (rows_ == 0 || length < 1e-9) return;
  const P2 along{(b.x - a.x) / length, (b.y - a.y) / length};
  const double half = width_m / 2 + 1e-9;
  const auto index = [this](double v, double from, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp(std::floor((v - from) / cell_m_), 0.0, static_cast<double>(count - 1)));
  };
  const std::size_t c0 = index(std::min(a.x, b.x) - half, origin_.x, cols_);
  const std::size_t c1 = index(std::max(a.x, b.x) + half, origin_.x, cols_);
  const std::size_t r0 = index(std::min(a.y, b.y) - half, origin_.y, rows_);
  const std::size_t r1 = index(std::max(a.y, b.y) + half, origin_.y, rows_);
  for (std::size_t r = r0; r <= r1; ++r) {
    for (std::size_t c = c0; c <= c1; ++c) {
      if (owner_[r * cols_ + c] != static_cast<int>(field)) continue;
      const double dx = origin_.x + (static_cast<double>(c) + 0.5) * cell_m_ - a.x;
      const double dy = origin_.y + (static_cast<double>(r) + 0.5) * cell_m_ - a.y;
      const double s = dx * along.x + dy * along.y;
      const double across = std::abs(dx * along.y - dy * along.x);
      if (across <= half && s >= -1e-9 && s <= length + 1e-9) swept_[r * cols_ + c] = true;
    }
  }
}

double Swath::covered_percent() const {
  std::size_t all = 0;
  std::size_t done = 0;
  for (std::size_t i = 0; i < owner_.size(); ++i) {
    if (owner_[i] < 0) continue;
    ++all;
    done += swept_[i] ? 1 : 0;
  }
  return all == 0 ? 0.0 : 100.0 * static_cast<double>(done) / static_cast<double>(all);
}

}  // namespace swallowtail::check
