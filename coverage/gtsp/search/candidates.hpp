#pragma once

#include <span>
#include <vector>

#include "coverage/gtsp/search/point_tree.hpp"
#include "coverage/gtsp/search/problem.hpp"

namespace swallowtail::gtsp::search {

/// For each vertex the vertices of other clusters near to it, nearest first: of each of the nearest clusters
/// the vertex nearest to it. Out of a vertex and into it are told apart unless costs are symmetric. A
/// vertex's list is made when first asked for: most vertices never are. Not to be shared by threads.
class Candidates {
 public:
  /// The tree is used, and must be there, when the problem has points.
  Candidates(const Problem& problem, const PointTree* tree, int most);

  std::span<const Near> out_of(int v) { return of(out_, v, Direction::kOut); }
  std::span<const Near> into(int v) {
    return problem_.is_symmetric() ? out_of(v) : of(into_, v, Direction::kInto);
  }

 private:
  enum class Direction { kOut, kInto };
  struct Lists {
    std::vector<Near> near;  ///< vertex × most_
    std::vector<char> is_made;
  };

  std::span<const Near> of(Lists& lists, int v, Direction direction) {
    const auto i = static_cast<std::size_t>(v);
    if (lists.is_made[i] == 0) make(lists, v, direction);
    return {lists.near.data() + i * most_, most_};
  }
  void make(Lists& lists, int v, Direction direction);
  void look_at_matrix(int v, Direction direction);
  void look_at_lists(int v, Direction direction);
  void look_at_points(int v);
  void resize(Lists& lists) const;

  const Problem& problem_;
  const PointTree* tree_;
  std::size_t most_;
  Lists out_;
  Lists into_;
  PointTree::Search search_;
  std::vector<Near> found_;
};

}  // namespace swallowtail::gtsp::search
