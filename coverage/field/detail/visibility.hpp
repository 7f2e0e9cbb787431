#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "coverage/field/detail/free_ground.hpp"
#include "coverage/field/detail/point_grid.hpp"
#include "coverage/field/detail/shades.hpp"

namespace swallowtail::coverage::detail {

/// Where ways may bend: a place beside a corner of what is not crossed.
struct Bend {
  Vec2 at_m = Vec2::Zero();
  double push_m = 0.0;  ///< from the corner
  /// From the corner along its edges, unit length. Ways that bend here leave both on the same side; zero
  /// where the edges are too short, beside the push, to say so.
  Vec2 back = Vec2::Zero();
  Vec2 on = Vec2::Zero();
};

/// Beside the corners of rings where the free ground spans more than half a turn; rings of many vertices are
/// straightened by at most the tolerance before.
std::vector<Bend> bends_of(const std::vector<Ring>& rings, double tolerance_m);

/// Shortest ways over free ground that bend at given places only [LOZANO-PEREZ]. What sees what is found out
/// as it is needed: from each place in rings of doubling radius, as far as the shortest way wanted may lead
/// [DIJKSTRA]; that and the searches are kept. What it answers does not depend on what it was asked before.
class Visibility {
 public:
  /// Borrows the ground.
  Visibility(const FreeGround& ground, std::vector<Bend> bends);

  /// Where the way bends, in order; nothing when there is none.
  std::optional<std::vector<Vec2>> way(const Vec2& from, const Vec2& to);
  std::size_t size() const { return bends_.size(); }

 private:
  struct Seen {
    int bend = 0;
    double distance_m = 0.0;
  };
  /// What a place sees, ring by ring.
  struct View {
    std::vector<Seen> seen;
    std::vector<std::size_t> past;  ///< of each ring, in `seen`
    double reach_m = 0.0;
    bool is_whole = false;
    Horizon horizon;
  };
  /// A ring of a bend's view (or of the place's own: −1) that the search has come to.
  struct Ahead {
    double distance_m = 0.0;
    int bend = -1;
    std::size_t ring = 0;
    auto operator<=>(const Ahead&) const = default;
  };
  struct Search {
    View view;
    std::vector<double> distance_m;
    std::vector<int> before;  ///< −1: the place itself
    std::priority_queue<Ahead, std::vector<Ahead>, std::greater<>> ahead;
  };

  Search& search_from(const Vec2& place);
  void go_on(Search& search, const Vec2& place, double to_m);
  void look_farther(View& view, const Vec2& place, int bend) const;
  bool may_link(const Vec2& place, int from, int to) const;
  double ring_reach_m(std::size_t ring) const;

  const FreeGround* ground_;
  std::vector<Bend> bends_;
  std::vector<View> views_;  ///< by bend
  std::map<std::pair<double, double>, Search> searches_;
  PointGrid grid_;
  Shades shades_;
  double first_reach_m_;
};

}  // namespace swallowtail::coverage::detail
