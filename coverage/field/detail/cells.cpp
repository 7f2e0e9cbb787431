#include "coverage/field/detail/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "coverage/field/detail/geos.hpp"

namespace swallowtail::coverage::detail {
namespace {

constexpr double kSameDirection_rad = 0.06;
constexpr std::size_t kMaxDirections = 10;
constexpr std::size_t kMaxCells = 400;
constexpr std::size_t kStarts = 2;
constexpr int kMaxSweeps = 20;
constexpr double kJoined_m = 0.05;
/// Of the length of a border between cells of different directions: half a strip of overlap, and lines that
/// end there aslant.
constexpr double kBorderCost = 0.5;
constexpr double kBetter_m = 1e-6;

/// Where the line on through a vertex splits off a cell: the vertex is the lowest or highest of a hole or
/// notch, strips running along x.
bool is_critical(const Vec2& before, const Vec2& at, const Vec2& after) {
  const Vec2 in = at - before;
  const Vec2 out = after - at;
  const bool reflex = in.x() * out.y() - in.y() * out.x() < 0.0;
  const bool extremal = (before.y() - at.y()) * (after.y() - at.y()) >= 0.0;
  return reflex && extremal;
}

void add_cuts(const Polygon& turned, const Ring& ring, std::vector<std::pair<Vec2, Vec2>>& out) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& at = ring[i];
    if (!is_critical(ring[(i + ring.size() - 1) % ring.size()], at, ring[(i + 1) % ring.size()])) continue;
    const Line line{at, Vec2(1.0, 0.0)};
    for (const Interval& inside : inside_of(turned, line)) {
      const bool touches = inside.from <= 2.0 * kInside_m && inside.to >= -2.0 * kInside_m;
      // Over the border at both ends, so that the cut meets it whatever is rounded.
      if (touches)
        out.emplace_back(line.at(inside.from - 2.0 * kInside_m), line.at(inside.to + 2.0 * kInside_m));
    }
  }
}

/// A line's stretch in one cell.
struct Stretch {
  std::size_t cell = 0;
  Interval along;
};

/// Lines of one direction over all cells.
struct Sweep {
  double angle_rad = 0.0;
  std::vector<Line> lines;
  std::vector<std::vector<Stretch>> stretches;  ///< of each line, in order
  std::vector<std::vector<std::size_t>> lines_of_cell;
};

class Labelling {
 public:
  Labelling(const Polygon& polygon, std::vector<Polygon> cells, const SweepParams& params)
      : polygon_(polygon), cells_(std::move(cells)), params_(params) {
    choose_directions();
    for (const double angle : angles_) sweeps_.push_back(sweep_of(angle));
    find_borders();
  }

  CellLines run();

 private:
  void choose_directions();
  Sweep sweep_of(double angle_rad) const;
  void find_borders();
  double line_cost(std::size_t direction, std::size_t line, const std::vector<std::size_t>& label) const;
  double cell_cost(std::size_t cell, std::size_t direction, const std::vector<std::size_t>& label) const;
  double total_cost(const std::vector<std::size_t>& label) const;
  void descend(std::vector<std::size_t>& label) const;
  CellLines lines_of(const std::vector<std::size_t>& label) const;

  const Polygon& polygon_;
  std::vector<Polygon> cells_;
  SweepParams params_;
  std::vector<double> angles_;
  std::vector<Sweep> sweeps_;
  struct Border {
    std::size_t other;
    double length_m;
  };
  std::vector<std::vector<Border>> borders_;
};

void Labelling::choose_directions() {
  const auto add = [&](double angle) {
    const bool known = std::any_of(angles_.begin(), angles_.end(), [&](double a) {
      const double apart = std::abs(a - angle);
      return std::min(apart, std::numbers::pi - apart) < kSameDirection_rad;
    });
    if (!known && angles_.size() < kMaxDirections) angles_.push_back(angle);
  };
  for (const double angle : best_sweeps_rad(polygon_, params_, 3)) add(angle);
  std::vector<std::size_t> order(cells_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return area_m2(cells_[a]) > area_m2(cells_[b]); });
  for (const std::size_t cell : order) {
    for (const double angle : best_sweeps_rad(cells_[cell], params_, 1)) add(angle);
  }
}

Sweep Labelling::sweep_of(double angle_rad) const {
  Sweep out;
  out.angle_rad = angle_rad;
  out.lines_of_cell.resize(cells_.size());
  const Polygon turned = rotated(polygon_, -angle_rad);
  const Box box = bounds_of(turned.outline);
  const double extent = box.hi.y() - box.lo.y();
  const int count = strip_count(extent, params_.spacing_m);
  const Vec2 along(std::cos(angle_rad), std::sin(angle_rad));
  for (int s = 0; s < count; ++s) {
    const Vec2 origin = rotated(Vec2(0.0, box.lo.y() + (s + 0.5) * extent / count), angle_rad);
    out.lines.push_back({origin, along});
    std::vector<Stretch> stretches;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      bool crosses = false;
      for (const Interval& inside : inside_of(cells_[c], out.lines.back())) {
        stretches.push_back({c, inside});
        crosses = true;
      }
      if (crosses) out.lines_of_cell[c].push_back(out.lines.size() - 1);
    }
    std::sort(stretches.begin(), stretches.end(),
              [](const Stretch& a, const Stretch& b) { return a.along.from < b.along.from; });
    out.stretches.push_back(std::move(stretches));
  }
  return out;
}

/// Cells meet along cuts, which all run one way: edges of two cells on one line.
void Labelling::find_borders() {
  borders_.resize(cells_.size());
  const auto common = [](const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    if ((b - a).norm() < kJoined_m) return 0.0;
    const Line line = line_through(a, b);
    if (std::abs(line.left_of(c)) > kJoined_m || std::abs(line.left_of(d)) > kJoined_m) return 0.0;
    const double from = std::max(0.0, std::min(line.along_of(c), line.along_of(d)));
    const double to = std::min((b - a).norm(), std::max(line.along_of(c), line.along_of(d)));
    return std::max(0.0, to - from);
  };
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    for (std::size_t j = i + 1; j < cells_.size(); ++j) {
      double length = 0.0;
      const Ring& a = cells_[i].outline;
      const Ring& b = cells_[j].outline;
      for (std::size_t p = 0; p < a.size(); ++p) {
        for (std::size_t q = 0; q < b.size(); ++q)
          length += common(a[p], a[(p + 1) % a.size()], b[q], b[(q + 1) % b.size()]);
      }
      if (length <= kJoined_m) continue;
      borders_[i].push_back({j, length});
      borders_[j].push_back({i, length});
    }
  }
}

double Labelling::line_cost(std::size_t direction, std::size_t line,
                            const std::vector<std::size_t>& label) const {
  double cost = 0.0;
  double end = -std::numeric_limits<double>::infinity();
  for (const Stretch& stretch : sweeps_[direction].stretches[line]) {
    if (label[stretch.cell] != direction) continue;
    if (stretch.along.from - end > kJoined_m) cost += params_.piece_cost_m;
    cost += stretch.along.to - stretch.along.from;
    end = stretch.along.to;
  }
  return cost;
}

/// What depends on the cell when it is flown in the direction.
double Labelling::cell_cost(std::size_t cell, std::size_t direction,
                            const std::vector<std::size_t>& label) const {
  double cost = 0.0;
  for (const std::size_t line : sweeps_[direction].lines_of_cell[cell])
    cost += line_cost(direction, line, label);
  for (const Border& border : borders_[cell]) {
    if (label[border.other] != direction) cost += kBorderCost * border.length_m;
  }
  return cost;
}

double Labelling::total_cost(const std::vector<std::size_t>& label) const {
  double cost = 0.0;
  for (std::size_t d = 0; d < sweeps_.size(); ++d) {
    for (std::size_t line = 0; line < sweeps_[d].lines.size(); ++line) cost += line_cost(d, line, label);
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    for (const Border& border : borders_[c]) {
      if (border.other > c && label[border.other] != label[c]) cost += kBorderCost * border.length_m;
    }
  }
  return cost;
}

void Labelling::descend(std::vector<std::size_t>& label) const {
  bool improved = true;
  for (int sweep = 0; improved && sweep < kMaxSweeps; ++sweep) {
    improved = false;
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      const std::size_t before = label[cell];
      // Lines of the old direction are cheaper without the cell, those of the new dearer with it.
      const auto change = [&](std::size_t direction) {
        label[cell] = before;
        const double old_with = cell_cost(cell, before, label);
        double new_without = 0.0;
        for (const std::size_t line : sweeps_[direction].lines_of_cell[cell])
          new_without += line_cost(direction, line, label);
        label[cell] = direction;
        double old_without = 0.0;
        for (const std::size_t line : sweeps_[before].lines_of_cell[cell])
          old_without += line_cost(before, line, label);
        return cell_cost(cell, direction, label) - new_without - (old_with - old_without);
      };
      std::size_t best = before;
      double least = -kBetter_m;
      for (std::size_t d = 0; d < sweeps_.size(); ++d) {
        if (d == before) continue;
        const double delta = change(d);
        if (delta >= least) continue;
        least = delta;
        best = d;
      }
      label[cell] = best;
      improved |= best != before;
    }
  }
}

CellLines Labelling::lines_of(const std::vector<std::size_t>& label) const {
  CellLines out;
  for (std::size_t d = 0; d < sweeps_.size(); ++d) {
    const Sweep& sweep = sweeps_[d];
    for (std::size_t k = 0; k < sweep.lines.size(); ++k) {
      const Line& line = sweep.lines[k];
      std::vector<Interval> runs;
      for (const Stretch& stretch : sweep.stretches[k]) {
        if (label[stretch.cell] != d) continue;
        // What hangs on the line within the cell, at a border that runs aslant.
        const BandPart band = part_in_band(cells_[stretch.cell], line, {-1e7, 1e7}, params_.spacing_m / 2.0);
        const Interval wanted{std::min(stretch.along.from, band.extent.from),
                              std::max(stretch.along.to, band.extent.to)};
        if (!runs.empty() && wanted.from - runs.back().to <= kJoined_m) {
          runs.back().to = std::max(runs.back().to, wanted.to);
        } else {
          runs.push_back(wanted);
        }
      }
      if (runs.empty()) continue;
      for (const Interval& inside : inside_of(polygon_, line)) {
        for (const Interval& run : runs) {
          const Interval piece{std::max(run.from, inside.from), std::min(run.to, inside.to)};
          if (piece.to - piece.from > kJoined_m) out.pieces.push_back(line.piece(piece, out.strips));
        }
      }
      ++out.strips;
    }
  }
  return out;
}

CellLines Labelling::run() {
  std::vector<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t start = 0; start < std::min(kStarts, sweeps_.size()); ++start) {
    std::vector<std::size_t> label(cells_.size(), start);
    descend(label);
    const double cost = total_cost(label);
    if (cost >= least - kBetter_m) continue;
    least = cost;
    best = std::move(label);
  }
  const bool single = std::all_of(best.begin(), best.end(), [&](std::size_t d) { return d == best.front(); });
  return single ? CellLines() : lines_of(best);
}

}  // namespace

std::vector<Polygon> boustrophedon_cells(const Polygon& polygon, double sweep_rad) {
  const Polygon turned = rotated(polygon, -sweep_rad);
  std::vector<std::pair<Vec2, Vec2>> cuts;
  add_cuts(turned, turned.outline, cuts);
  for (const Ring& hole : turned.holes) add_cuts(turned, hole, cuts);
  std::vector<Polygon> out;
  for (const Polygon& part : Shape::of(turned).cut_along(cuts)) out.push_back(rotated(part, sweep_rad));
  return out;
}

CellLines lines_by_cell(const Polygon& polygon, const SweepParams& params) {
  const std::vector<double> best = best_sweeps_rad(polygon, params, 1);
  if (best.empty()) return {};
  std::vector<Polygon> cells = boustrophedon_cells(polygon, best.front());
  if (cells.size() < 2 || cells.size() > kMaxCells) return {};
  return Labelling(polygon, std::move(cells), params).run();
}

}  // namespace swallowtail::coverage::detail
