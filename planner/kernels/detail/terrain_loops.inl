// The batch kernel's walks over a raster: eight hops in step, one square further each at a time. Included
// after batch_loops.inl. The scalar twin is planner/world/detail/raster_pyramid.cpp.

/// A hop in each lane in grid coordinates: column, row, height.
struct LaneWay {
  Real start[2], step[2], inverse[2];
  Real z, climb;
  Real at(int axis, const Real& t) const { return start[axis] + step[axis] * t; }
  Real height(const Real& t) const { return z + climb * t; }
};

inline LaneWay way_of(const GroundView& ground, const LanePoint& from, const LanePoint& to) {
  const RealPoint a = load(from);
  const RealPoint b = load(to);
  const Real per_metre = broadcast(ground.per_metre);
  LaneWay way;
  way.start[0] = (a.x - broadcast(ground.origin_x_m)) * per_metre;
  way.start[1] = (a.y - broadcast(ground.origin_y_m)) * per_metre;
  way.step[0] = (b.x - broadcast(ground.origin_x_m)) * per_metre - way.start[0];
  way.step[1] = (b.y - broadcast(ground.origin_y_m)) * per_metre - way.start[1];
  for (int axis = 0; axis < 2; ++axis) {
    const Mask stands = absolute(way.step[axis]) < broadcast(1e-200);
    way.inverse[axis] =
        select(stands, broadcast(0.0), broadcast(1.0) / select(stands, broadcast(1.0), way.step[axis]));
  }
  way.z = a.z;
  way.climb = b.z - a.z;
  return way;
}

/// Lanes whose both ends lie over the raster; comparisons that a number that is none does not pass.
inline Mask over_raster(const GroundView& ground, const LaneWay& way) {
  const Real zero = broadcast(0.0);
  const Real last[2] = {broadcast(ground.cols - 1.0), broadcast(ground.rows - 1.0)};
  Mask inside = (way.z - way.z == zero) & (way.climb - way.climb == zero);
  for (int axis = 0; axis < 2; ++axis) {
    const Real end = way.start[axis] + way.step[axis];
    inside = inside & (way.start[axis] >= zero) & (way.start[axis] <= last[axis]) & (end >= zero) &
             (end <= last[axis]);
  }
  return inside;
}

/// One square further in each lane at a time; see RasterPyramid::Way::march.
struct LaneMarch {
  Real place[2], direction[2], left[2], next[2], interval[2];
  Real t;
  Mask active;

  LaneMarch(const LaneWay& way, double cells, const int (&counts)[2], const Real& t0, const Real& t1,
            const Mask& lanes)
      : t(t0), active(lanes) {
    const Real zero = broadcast(0.0);
    const Real one = broadcast(1.0);
    for (int axis = 0; axis < 2; ++axis) {
      const auto square = [&](const Real& time) {
        const Real at = select(lanes, way.at(axis, time) * broadcast(1.0 / cells), zero);
        return whole(smallest(largest(at, zero), broadcast(counts[axis] - 1.0)));
      };
      place[axis] = square(t0);
      const Real end = square(t1);
      direction[axis] = select(end < place[axis], -one, one);
      left[axis] = absolute(end - place[axis]);
      const Real line = (place[axis] + select(end < place[axis], zero, one)) * broadcast(cells);
      const Mask crosses = left[axis] > zero;
      next[axis] = select(crosses, (line - way.start[axis]) * way.inverse[axis], broadcast(kNever));
      interval[axis] = broadcast(cells) * absolute(way.inverse[axis]);
    }
  }

  Real steps() const { return left[0] + left[1]; }
  Real index(int cols) const { return place[1] * broadcast(cols) + place[0]; }
  /// When the square is left.
  Real exit(const Real& t1) const {
    const Real line = smallest(smallest(next[0], next[1]), t1);
    return select(steps() > broadcast(0.0), largest(t, line), t1);
  }
  void advance(const Real& t_out) {
    const Real zero = broadcast(0.0);
    active = active & (steps() > zero);
    const Mask by_row = active & (next[1] < next[0]);
    const Mask by_col = active & !(next[1] < next[0]);
    const Mask by[2] = {by_col, by_row};
    t = select(active, t_out, t);
    for (int axis = 0; axis < 2; ++axis) {
      place[axis] += select(by[axis], direction[axis], zero);
      left[axis] -= select(by[axis], broadcast(1.0), zero);
      const Real after = select(left[axis] > zero, next[axis] + interval[axis], broadcast(kNever));
      next[axis] = select(by[axis], after, next[axis]);
    }
  }

  static constexpr double kNever = 1e300;
};

/// Height above ground on the way through one cell, as RasterPyramid::Piece.
struct LanePiece {
  Real span, h_in, h_out, bend;
};

/// Calls take(LanePiece, active) for the cells between t0 and t1 in the lanes asked for.
template <class Take>
inline void walk_cells(const GroundView& ground, const LaneWay& way, const Real& t0, const Real& t1,
                       const Mask& lanes, const Take& take) {
  const int counts[2] = {ground.cols - 1, ground.rows - 1};
  LaneMarch march(way, 1.0, counts, t0, t1, lanes);
  const Real turn = -way.step[0] * way.step[1];
  Real h_in = broadcast(0.0);
  for (bool first = true; any(march.active); first = false) {
    const Real index = march.index(ground.cols);
    const Real sw = gather(ground.elevation_m, index);
    const Real se = gather(ground.elevation_m + 1, index);
    const Real nw = gather(ground.elevation_m + ground.cols, index);
    const Real ne = gather(ground.elevation_m + ground.cols + 1, index);
    const auto height = [&](const Real& t) {
      const Real fu = way.at(0, t) - march.place[0];
      const Real fv = way.at(1, t) - march.place[1];
      const Real south = sw + fu * (se - sw);
      const Real north = nw + fu * (ne - nw);
      return way.height(t) - (south + fv * (north - south));
    };
    if (first) h_in = height(march.t);
    const Real t_out = march.exit(t1);
    const Real h_out = height(t_out);
    const Real span = t_out - march.t;
    take(LanePiece{span, h_in, h_out, turn * span * span * (sw - se - nw + ne)}, march.active);
    h_in = h_out;
    march.advance(t_out);
  }
}

inline Real least_of(const LanePiece& piece) {
  const Real zero = broadcast(0.0);
  const Real slope = piece.h_out - piece.h_in - piece.bend;
  const Mask dips = (piece.bend > zero) & (slope < zero) & (slope + broadcast(2.0) * piece.bend > zero);
  const Real bend = select(dips, piece.bend, broadcast(1.0));
  const Real vertex = piece.h_in - slope * slope / (broadcast(4.0) * bend);
  return select(dips, vertex, smallest(piece.h_in, piece.h_out));
}

/// Share of the way through the cell that lies at or below the ground, as RasterPyramid::Piece.
inline Real share_below(const LanePiece& piece) {
  const Real zero = broadcast(0.0);
  const Real one = broadcast(1.0);
  const auto clipped = [&](const Real& s) { return smallest(largest(s, zero), one); };
  const Real slope = piece.h_out - piece.h_in - piece.bend;
  const Mask level = slope == zero;
  const Real crossing = clipped(-piece.h_in / select(level, one, slope));
  const Real linear = select(level, select(piece.h_in <= zero, one, zero),
                             select(slope > zero, crossing, one - crossing));
  const Real discriminant = slope * slope - broadcast(4.0) * piece.h_in * piece.bend;
  const Mask cuts = discriminant > zero;
  const Real half = root(select(cuts, discriminant, one));
  const Real q = broadcast(-0.5) * (slope + select(slope < zero, -half, half));
  const Mask straight = piece.bend == zero;
  const Real far = q / select(straight, one, piece.bend);
  const Real near = piece.h_in / select(cuts, q, one);
  const Real between = clipped(largest(far, near)) - clipped(smallest(far, near));
  const Mask sags = piece.bend > zero;
  const Real curved =
      select(cuts, select(sags, between, one - between), select(sags, zero, one));
  return select(straight, linear, curved);
}

/// The blocks that hops cross, step by step.
struct LaneCrossings {
  static constexpr int kMost = 128;
  Real t_out[kMost];
  /// What a block promises: one below the threshold of next_open is still to be looked at. kNever: it has
  /// been, or is not crossed.
  Real bound[kMost];
  int count = 0;

  /// The next step from `from` on that promises less than `threshold`; count if there is none.
  int next_open(int lane, int from, double threshold) const {
    while (from < count && !(bound[from][lane] < threshold)) ++from;
    return from;
  }
};

/// Fills in the crossings of the smallest blocks, promise(index, z_in, z_out, span, active) each; the lanes
/// that were followed to their end.
template <class Promise>
inline Mask cross_blocks(const GroundView& ground, const LaneWay& way, LaneCrossings& crossings,
                         const Promise& promise) {
  const Real one = broadcast(1.0);
  const int counts[2] = {ground.block_cols, ground.block_rows};
  const Mask lanes = over_raster(ground, way);
  LaneMarch march(way, ground.block_cells, counts, broadcast(0.0), one, lanes);
  const Mask followed = lanes & (march.steps() < broadcast(LaneCrossings::kMost));
  march.active = followed;
  Real z_in = way.z;
  for (; any(march.active); ++crossings.count) {
    const Real t_out = march.exit(one);
    const Real z_out = way.height(t_out);
    crossings.t_out[crossings.count] = t_out;
    crossings.bound[crossings.count] =
        select(march.active,
               promise(march.index(ground.block_cols), smallest(z_in, z_out), largest(z_in, z_out),
                       t_out - march.t, march.active),
               broadcast(LaneMarch::kNever));
    z_in = z_out;
    march.advance(t_out);
  }
  return followed;
}

/// Walks the cells of one block in each lane, steps[lane] (none where that is count), and marks it as looked
/// at. False if there was none.
template <class Take>
inline bool look_at(const GroundView& ground, const LaneWay& way, LaneCrossings& crossings,
                    const int (&steps)[kLanes], const Take& take) {
  Real t0 = broadcast(0.0);
  Real t1 = broadcast(0.0);
  Mask open{};
  for (int lane = 0; lane < kLanes; ++lane) {
    const int k = steps[lane];
    if (k == crossings.count) continue;
    if (k > 0) t0[lane] = crossings.t_out[k - 1][lane];
    t1[lane] = crossings.t_out[k][lane];
    crossings.bound[k][lane] = LaneMarch::kNever;
    open[lane] = -1;
  }
  if (!any(open)) return false;
  walk_cells(ground, way, t0, t1, open, take);
  return true;
}

inline unsigned bits_of(const Mask& lanes) {
  unsigned bits = 0;
  for (int lane = 0; lane < kLanes; ++lane) bits |= lanes[lane] != 0 ? 1U << lane : 0U;
  return bits;
}

unsigned least_height(const GroundView& ground, const LanePoint& from, const LanePoint& to, double cap_m,
                      Lanes& least_m) {
  const LaneWay way = way_of(ground, from, to);
  LaneCrossings crossings;
  Real least_bound = broadcast(LaneMarch::kNever);
  Real least_step = broadcast(0.0);
  const Mask followed = cross_blocks(
      ground, way, crossings,
      [&](const Real& index, const Real& z_low, const Real&, const Real&, const Mask& active) {
        const Real bound = z_low - gather(ground.block_max_m, index);
        const Mask less = active & (bound < least_bound);
        least_step = select(less, broadcast(crossings.count), least_step);
        least_bound = select(less, bound, least_bound);
        return bound;
      });
  // The most promising block of each lane first: what it shows rules out most others.
  int steps[kLanes];
  for (int lane = 0; lane < kLanes; ++lane)
    steps[lane] = least_bound[lane] < cap_m ? static_cast<int>(least_step[lane]) : crossings.count;
  Real best = broadcast(cap_m);
  int next[kLanes] = {};
  while (look_at(ground, way, crossings, steps, [&](const LanePiece& piece, const Mask& active) {
    best = select(active, smallest(best, least_of(piece)), best);
  })) {
    for (int lane = 0; lane < kLanes; ++lane) {
      if (steps[lane] == crossings.count) continue;
      steps[lane] = next[lane] = crossings.next_open(lane, next[lane], best[lane]);
    }
  }
  store(best, least_m.data());
  return bits_of(followed);
}

unsigned length_below(const GroundView& ground, const LanePoint& from, const LanePoint& to,
                      Lanes& length_m) {
  const Real zero = broadcast(0.0);
  const LaneWay way = way_of(ground, from, to);
  LaneCrossings crossings;
  Real share = zero;
  const Mask followed = cross_blocks(
      ground, way, crossings,
      [&](const Real& index, const Real& z_low, const Real& z_high, const Real& span, const Mask& active) {
        const Mask above = z_low > gather(ground.block_max_m, index);
        const Mask below = z_high < gather(ground.block_min_m, index);
        share += select(active & below, span, zero);
        return select(above | below, broadcast(LaneMarch::kNever), broadcast(-1.0));
      });
  int steps[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) steps[lane] = crossings.next_open(lane, 0, 0.0);
  while (look_at(ground, way, crossings, steps, [&](const LanePiece& piece, const Mask& active) {
    share += select(active, piece.span * share_below(piece), zero);
  })) {
    for (int lane = 0; lane < kLanes; ++lane) steps[lane] = crossings.next_open(lane, steps[lane], 0.0);
  }
  store(share * hop_of(from, to).length, length_m.data());
  return bits_of(followed);
}
