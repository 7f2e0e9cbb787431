// Signed distances of points and segments to convex solids, for a number type Real with a truth type Mask
// and the functions select, any, largest, smallest, absolute, root, broadcast. Included inside a namespace
// that defines these: once for double, and once for each width of vector registers, whose code must be
// compiled for the machine it is meant for.

struct RealPoint {
  Real x, y, z;
};

/// Signed distance at a point of a segment (negative inside) and its slope along it.
struct Profile {
  Real distance;
  Real slope;
};

/// A segment in the frame of a solid: p + s·d, s in [0, 1].
struct Ray {
  RealPoint p, d;
  RealPoint at(const Real& s) const { return {p.x + s * d.x, p.y + s * d.y, p.z + s * d.z}; }
};

/// 0 where the divisor is 0.
inline Real divide(const Real& a, const Real& b) {
  const Real zero = broadcast(0.0);
  return select(b > zero, a / select(b > zero, b, broadcast(1.0)), zero);
}

/// Least point of s ↦ |p + s·d| on the segment.
inline Real nearest_on(const RealPoint& p, const RealPoint& d, const Real& inverse_square) {
  const Real s = -(p.x * d.x + p.y * d.y + p.z * d.z) * inverse_square;
  return smallest(largest(s, broadcast(0.0)), broadcast(1.0));
}

/// Beyond the edge of a rectangle the nearest point is its corner, beyond one side that side; inside, the
/// nearer side counts. u, v: excess over the half widths; du, dv: their slopes.
inline Profile rectangle_profile(const Real& u, const Real& v, const Real& du, const Real& dv) {
  const Real zero = broadcast(0.0);
  const Real pu = largest(u, zero);
  const Real pv = largest(v, zero);
  const Real away = root(pu * pu + pv * pv);
  const Mask outside = away > zero;
  return {select(outside, away, largest(u, v)),
          select(outside, divide(pu * du + pv * dv, away), select(u > v, du, dv))};
}

inline Profile profile(const CylinderShape& c, const Ray& ray, const Real& s) {
  const RealPoint x = ray.at(s);
  const Real rho = root(x.x * x.x + x.y * x.y);
  const Real drho = divide(x.x * ray.d.x + x.y * ray.d.y, rho);
  const Real half = broadcast(0.5 * c.height_m);
  const Real z = x.z - half;
  const Real dz = select(z < broadcast(0.0), -ray.d.z, ray.d.z);
  return rectangle_profile(rho - broadcast(c.radius_m), absolute(z) - half, drho, dz);
}

/// In the half plane (ρ, z) the cone is the triangle (0, 0), (R, 0), (0, H).
inline Profile profile(const ConeShape& c, const Ray& ray, const Real& s) {
  const Real zero = broadcast(0.0);
  const RealPoint x = ray.at(s);
  const Real square = x.x * x.x + x.y * x.y;
  const Real rho = root(square);
  const Real rho_drho = x.x * ray.d.x + x.y * ray.d.y;
  const Real drho = divide(rho_drho, rho);
  const Real over_rim = rho - broadcast(c.radius_m);
  const Real nr = broadcast(c.height_m / c.slant_m);
  const Real nz = broadcast(c.radius_m / c.slant_m);
  const Real over_side = nr * over_rim + nz * x.z;
  const Real up_side = nr * x.z - nz * over_rim;
  const Real below_apex = x.z - broadcast(c.height_m);
  const Mask outside = over_side > zero;
  const Mask apex = outside & (up_side > broadcast(c.slant_m));
  const Mask rim = (x.z < zero) | (outside & (up_side < zero));
  const Real beyond_rim = largest(over_rim, zero);
  const Real away = root(select(apex, square + below_apex * below_apex, beyond_rim * beyond_rim + x.z * x.z));
  const Real slope = select(apex, rho_drho + below_apex * ray.d.z, beyond_rim * drho + x.z * ray.d.z);
  const Mask pointed = apex | rim;
  const Mask base = -x.z > over_side;
  return {select(pointed, away, largest(-x.z, over_side)),
          select(pointed, divide(slope, away), select(base, -ray.d.z, nr * drho + nz * ray.d.z))};
}

inline Profile profile(const BoxShape& b, const Ray& ray, const Real& s) {
  const Real zero = broadcast(0.0);
  const RealPoint x = ray.at(s);
  const Real ux = absolute(x.x) - broadcast(b.half_m[0]);
  const Real uy = absolute(x.y) - broadcast(b.half_m[1]);
  const Real uz = absolute(x.z) - broadcast(b.half_m[2]);
  const Real dx = select(x.x < zero, -ray.d.x, ray.d.x);
  const Real dy = select(x.y < zero, -ray.d.y, ray.d.y);
  const Real dz = select(x.z < zero, -ray.d.z, ray.d.z);
  const Real px = largest(ux, zero);
  const Real py = largest(uy, zero);
  const Real pz = largest(uz, zero);
  const Real away = root(px * px + py * py + pz * pz);
  const Mask outside = away > zero;
  const Real level = largest(ux, uy);
  return {select(outside, away, largest(level, uz)),
          select(outside, divide(px * dx + py * dy + pz * dz, away),
                 select(uz > level, dz, select(uy > ux, dy, dx)))};
}

inline Profile profile(const MeshShape& m, const Ray& ray, const Real& s) {
  const RealPoint x = ray.at(s);
  Profile best{broadcast(-1e300), broadcast(0.0)};
  for (std::size_t k = 0; k < m.count; ++k) {
    const double* n = m.directions + 3 * k;
    const Real nx = broadcast(n[0]);
    const Real ny = broadcast(n[1]);
    const Real nz = broadcast(n[2]);
    const Real distance = nx * x.x + ny * x.y + nz * x.z - broadcast(m.supports[k]);
    const Mask greater = distance > best.distance;
    best.slope = select(greater, nx * ray.d.x + ny * ray.d.y + nz * ray.d.z, best.slope);
    best.distance = select(greater, distance, best.distance);
  }
  return best;
}

/// Where a segment comes nearest to a solid (deepest inside it), and how near.
struct Nearest {
  Real distance;
  Real fraction;
};

/// The signed distance to a convex solid is convex along the segment: its slope changes sign once. The place
/// is bracketed; the tangents at the bracket's ends bound the least distance from below, so the search knows
/// its error and stops a lane at `tolerance`, or where the distance is shown to be no less than `enough`.
/// Proposals in turn: where the tangents cross (exact at a kink), where the slope would be 0 if it were
/// linear (quick where it is smooth), the middle (halves whatever happens).
template <class Shape>
inline Nearest nearest_to(const Shape& shape, const Ray& ray, const Real& tolerance, const Real& enough) {
  constexpr int kMaxProbes = 90;
  const Real zero = broadcast(0.0);
  Real lo = zero;
  Real hi = broadcast(1.0);
  Profile at_lo = profile(shape, ray, lo);
  Profile at_hi = profile(shape, ray, hi);
  const Mask first = !(at_hi.distance < at_lo.distance);
  Nearest best{select(first, at_lo.distance, at_hi.distance), select(first, lo, hi)};
  Mask open = (at_lo.slope < zero) & (at_hi.slope > zero);
  for (int probe = 0; probe < kMaxProbes; ++probe) {
    const Real width = hi - lo;
    const Real bend = select(open, at_hi.slope - at_lo.slope, broadcast(1.0));
    const Real crossing = (at_lo.distance - at_hi.distance + at_hi.slope * width) / bend;
    const Real bound = at_lo.distance + at_lo.slope * crossing;
    open = open & (best.distance - bound > tolerance) & (bound < enough);
    if (!any(open)) break;
    Real step = broadcast(0.5) * width;
    if (probe % 3 == 0) step = crossing;
    if (probe % 3 == 1) step = -width * at_lo.slope / bend;
    const Real s = lo + largest(zero, smallest(step, width));
    const Profile here = profile(shape, ray, s);
    const Mask better = open & (here.distance < best.distance);
    best.distance = select(better, here.distance, best.distance);
    best.fraction = select(better, s, best.fraction);
    const Mask falls = open & (here.slope < zero);
    const Mask rises = open & (here.slope > zero);
    open = falls | rises;
    lo = select(falls, s, lo);
    at_lo.distance = select(falls, here.distance, at_lo.distance);
    at_lo.slope = select(falls, here.slope, at_lo.slope);
    hi = select(rises, s, hi);
    at_hi.distance = select(rises, here.distance, at_hi.distance);
    at_hi.slope = select(rises, here.slope, at_hi.slope);
  }
  return best;
}
