#pragma once

#include <array>
#include <vector>

#include "coverage/gtsp/search/problem.hpp"

namespace swallowtail::gtsp::search {

/// A k-d tree over a problem's points: in the plane, or on the unit sphere for latitudes and longitudes.
class PointTree {
 public:
  explicit PointTree(const Problem& problem);

  struct Found {
    double distance2;
    int vertex;
    int cluster;
  };
  /// What a search needs for itself; threads have one each.
  struct Search {
    std::vector<Found> found;  ///< nearest first, one a cluster
    std::vector<int> answer;
  };
  /// Of each of the `most` clusters nearest to v (its own not among them) the vertex nearest to it.
  const std::vector<int>& nearest_of_clusters(int v, std::size_t most, Search& search) const;

  /// All vertices; near ones mostly stand close together.
  const std::vector<int>& order() const { return order_; }

 private:
  using Place = std::array<double, 3>;
  struct Question {
    Place from;
    int own_cluster;
    std::size_t most;
  };

  void build(int begin, int end);
  void look(int begin, int end, const Question& question, std::vector<Found>& found) const;
  int widest_axis(int begin, int end) const;

  const Problem& problem_;
  std::vector<Place> place_;  ///< by vertex
  std::vector<int> order_;    ///< vertices; the middle of each range splits it
  std::vector<signed char> axis_;
};

}  // namespace swallowtail::gtsp::search
