// The batch kernel's loops over obstacles. Included after signed_distance.inl, with Real a vector of kLanes.

/// A hop in each lane, and what every obstacle needs of it.
struct Hop {
  RealPoint a, d;
  Real inverse_square;  ///< 1 / |d|², 0 for a hop that goes nowhere
  Real length;
};

inline RealPoint load(const LanePoint& p) {
  return {load(p.x.data()), load(p.y.data()), load(p.z.data())};
}

inline Hop hop_of(const LanePoint& from, const LanePoint& to) {
  const RealPoint a = load(from);
  const RealPoint b = load(to);
  const RealPoint d{b.x - a.x, b.y - a.y, b.z - a.z};
  const Real square = d.x * d.x + d.y * d.y + d.z * d.z;
  return {a, d, divide(broadcast(1.0), square), root(square)};
}

/// Square of the distance from the hop to a place.
inline Real square_to(const Hop& hop, double to_x, double to_y, double to_z) {
  const RealPoint p{hop.a.x - broadcast(to_x), hop.a.y - broadcast(to_y), hop.a.z - broadcast(to_z)};
  const Real s = nearest_on(p, hop.d, hop.inverse_square);
  const Real x = p.x + s * hop.d.x;
  const Real y = p.y + s * hop.d.y;
  const Real z = p.z + s * hop.d.z;
  return x * x + y * y + z * z;
}

/// Square of the distance from the hop to the centre of the solid's ball.
inline Real ball_square(const Hop& hop, const FieldSolid& solid) {
  return square_to(hop, solid.position_m.x() + solid.ball_offset_m.x(),
                   solid.position_m.y() + solid.ball_offset_m.y(),
                   solid.position_m.z() + solid.ball_offset_m.z());
}

/// Calls visit(index) for every solid of the leaves that some lane may come nearer to than cap_m.
template <class Visit>
inline void for_each_in_reach(const SolidList& list, const Hop& hop, double cap_m, const Visit& visit) {
  std::size_t at = 0;
  while (at < list.nodes.size()) {
    const BallNode& node = list.nodes[at];
    // A tree of few is one leaf: asking the node would only cost.
    if (list.nodes.size() > 1) {
      const Real reach = broadcast((node.radius_m + cap_m) * (1.0 + BallTree::kRoundingOfReach)) +
                         broadcast(BallTree::kRoundingOfHop) * hop.length;
      const Real square = square_to(hop, node.centre_m.x(), node.centre_m.y(), node.centre_m.z());
      if (!any(square < reach * reach)) {
        at = node.next;
        continue;
      }
    }
    if (node.is_leaf) {
      for (std::size_t i = node.first; i < node.first + node.count; ++i) visit(i);
    }
    ++at;
  }
}

inline Ray ray_to(const Hop& hop, const FieldSolid& solid) {
  const Real c = broadcast(solid.cos_yaw);
  const Real s = broadcast(solid.sin_yaw);
  const Real x = hop.a.x - broadcast(solid.position_m.x());
  const Real y = hop.a.y - broadcast(solid.position_m.y());
  const Real z = hop.a.z - broadcast(solid.position_m.z());
  return {{c * x + s * y, c * y - s * x, z},
          {c * hop.d.x + s * hop.d.y, c * hop.d.y - s * hop.d.x, hop.d.z}};
}

/// Of a solid that is no sphere; `enough`: a distance from which on its value is of no interest.
inline Real solid_distance(const Hop& hop, const FieldSolid& solid, const double* supports, double enough) {
  const Ray ray = ray_to(hop, solid);
  const Real tolerance = broadcast(kDistanceTolerance) * (hop.length + broadcast(solid.ball_radius_m));
  switch (solid.kind) {
    case SolidKind::kCylinder:
      return nearest_to(cylinder_of(solid), ray, tolerance, broadcast(enough)).distance;
    case SolidKind::kCone:
      return nearest_to(cone_of(solid), ray, tolerance, broadcast(enough)).distance;
    case SolidKind::kBox:
      return nearest_to(box_of(solid), ray, tolerance, broadcast(enough)).distance;
    default:
      return nearest_to(mesh_of(solid, supports), ray, tolerance, broadcast(enough)).distance;
  }
}

void add_violation(const SolidList& list, const LanePoint& from, const LanePoint& to, Lanes& sum_m) {
  const Hop hop = hop_of(from, to);
  const Real zero = broadcast(0.0);
  Real sum = load(sum_m.data());
  for_each_in_reach(list, hop, 0.0, [&](std::size_t i) {
    const FieldSolid& solid = list.solids[i];
    const Real square = ball_square(hop, solid);
    const double reach = solid.ball_radius_m + solid.required_m;
    const Mask near = square < broadcast(reach * reach);
    if (!any(near)) return;
    const Real depth = solid.kind == SolidKind::kSphere
                           ? broadcast(reach) - root(square)
                           : broadcast(solid.required_m) -
                                 solid_distance(hop, solid, list.supports, solid.required_m);
    sum += select(near, largest(depth, zero), zero);
  });
  store(sum, sum_m.data());
}

std::size_t distances(const SolidList& list, const LanePoint& from, const LanePoint& to, double cap_m,
                      LaneDistance* out) {
  const Hop hop = hop_of(from, to);
  std::size_t count = 0;
  for_each_in_reach(list, hop, cap_m, [&](std::size_t i) {
    const FieldSolid& solid = list.solids[i];
    const Real square = ball_square(hop, solid);
    const double reach = solid.ball_radius_m + cap_m;
    if (!any(square < broadcast(reach * reach))) return;
    const Real distance =
        solid.kind == SolidKind::kSphere
            ? root(square) - broadcast(solid.radius_m)
            : solid_distance(hop, solid, list.supports, std::numeric_limits<double>::infinity());
    out[count].obstacle = i;
    store(distance, out[count].signed_distance_m.data());
    ++count;
  });
  return count;
}

void axis_distance(const FieldSolid& solid, const LanePoint& from, const LanePoint& to, Lanes& out_m) {
  const RealPoint a = load(from);
  const RealPoint b = load(to);
  const Real zero = broadcast(0.0);
  const RealPoint p{a.x - broadcast(solid.position_m.x()), a.y - broadcast(solid.position_m.y()), zero};
  const RealPoint d{b.x - a.x, b.y - a.y, zero};
  const Real s = nearest_on(p, d, divide(broadcast(1.0), d.x * d.x + d.y * d.y));
  const Real x = p.x + s * d.x;
  const Real y = p.y + s * d.y;
  store(root(x * x + y * y), out_m.data());
}

void add_length(const LanePoint& from, const LanePoint& to, Lanes& sum_m) {
  store(load(sum_m.data()) + hop_of(from, to).length, sum_m.data());
}
