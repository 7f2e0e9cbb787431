#include "coverage/field/detail/line_cover.hpp"

#include <algorithm>
#include <limits>

namespace swallowtail::coverage::detail {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

std::vector<const Planes*> bands_over(const Piece& piece, const std::vector<PiecePtr>& others) {
  std::vector<const Planes*> out;
  for (const PiecePtr& other : others) {
    if (other.get() != &piece && meet(*other, piece)) out.push_back(&other->planes);
  }
  return out;
}

Interval extent_of(const Patch& patch, const Line& line) {
  Interval out{kFar, -kFar};
  for (std::size_t i = 0; i < patch.size; ++i) {
    const double at = line.along_of(patch.corners[i]);
    out = {std::min(out.from, at), std::max(out.to, at)};
  }
  return out;
}

/// What a piece alone sees, patch by patch as it is asked for.
class SeenAlone {
 public:
  SeenAlone(const Piece& piece, const std::vector<PiecePtr>& others)
      : piece_(piece), bands_(bands_over(piece, others)), taken_(piece.seen.size(), 0) {}

  void take(std::size_t patch) {
    if (taken_[patch] != 0) return;
    taken_[patch] = 1;
    left_.clear();
    add_remains(piece_.seen[patch], bands_, left_);
    for (const Patch& part : left_) {
      const Interval at = extent_of(part, piece_.band.line);
      extent_ = {std::min(extent_.from, at.from), std::max(extent_.to, at.to)};
      area_m2_ += part.area_m2;
    }
  }
  const Interval& extent() const { return extent_; }
  double area_m2() const { return area_m2_; }

 private:
  const Piece& piece_;
  std::vector<const Planes*> bands_;
  std::vector<char> taken_;
  std::vector<Patch> left_;
  Interval extent_{kFar, -kFar};
  double area_m2_ = 0.0;
};

}  // namespace

bool meet(const Piece& a, const Piece& b) {
  return a.box.lo.x() < b.box.hi.x() && b.box.lo.x() < a.box.hi.x() && a.box.lo.y() < b.box.hi.y() &&
         b.box.lo.y() < a.box.hi.y() && may_meet(a.band, b.band);
}

double apart_m(const Segment& a, const Segment& b) {
  const auto to = [](const Segment& s, const Vec2& p) {
    const Vec2 along = s.to_m - s.from_m;
    const double t = std::clamp((p - s.from_m).dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
    return (p - s.from_m - t * along).norm();
  };
  return std::min({to(a, b.from_m), to(a, b.to_m), to(b, a.from_m), to(b, a.to_m)});
}

PiecePtr Ground::piece_of(const Segment& segment, int number) const {
  return piece_over(patches_, segment, number);
}

PiecePtr Ground::part_of(const Piece& piece, const Interval& stretch) const {
  return piece_over(piece.seen, piece.band.line.piece(stretch, piece.segment.strip), piece.number);
}

PiecePtr Ground::piece_over(const std::vector<Patch>& patches, const Segment& segment, int number) const {
  auto out = std::make_shared<Piece>();
  out->number = number;
  out->segment = segment;
  out->band = band_of(segment, width_m_);
  out->planes = planes_of(out->band);
  out->box = bounds_of(seen_from(segment, width_m_));
  out->seen = within(patches, out->band);
  for (const Patch& patch : out->seen) out->extents.push_back(extent_of(patch, out->band.line));
  return out;
}

std::vector<Patch> seen_alone(const Piece& piece, const std::vector<PiecePtr>& others) {
  const std::vector<const Planes*> bands = bands_over(piece, others);
  std::vector<Patch> out;
  for (const Patch& patch : piece.seen) add_remains(patch, bands, out);
  return out;
}

Needed needed_of(const Piece& piece, const std::vector<PiecePtr>& others, double may_lose_m2) {
  SeenAlone alone(piece, others);
  std::vector<std::size_t> order(piece.seen.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return piece.extents[a].from < piece.extents[b].from; });
  for (const std::size_t i : order) {
    if (piece.extents[i].from >= alone.extent().from) break;
    alone.take(i);
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return piece.extents[a].to > piece.extents[b].to; });
  for (const std::size_t i : order) {
    if (piece.extents[i].to <= alone.extent().to) break;
    alone.take(i);
  }
  for (std::size_t i = 0; i < order.size() && alone.area_m2() <= may_lose_m2; ++i) alone.take(i);
  return {alone.area_m2() <= may_lose_m2, alone.extent(), alone.area_m2()};
}

}  // namespace swallowtail::coverage::detail
