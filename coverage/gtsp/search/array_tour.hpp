#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace swallowtail::gtsp::search {

/// A closed tour in an array: one vertex of each cluster, in order. Changes are written down, so that any
/// number of the latest can be taken back.
class ArrayTour {
 public:
  /// cluster_of: by vertex; must outlive the tour.
  ArrayTour(std::vector<int> vertices, const std::vector<int>& cluster_of)
      : vertices_(std::move(vertices)), cluster_of_(cluster_of.data()), position_(vertices_.size()) {
    for (int p = 0; p < size(); ++p) position_[at(cluster_of_[vertex(p)])] = p;
  }

  int size() const { return static_cast<int>(vertices_.size()); }
  int vertex(int p) const { return vertices_[at(p)]; }
  int position(int cluster) const { return position_[at(cluster)]; }
  int position_of(int v) const { return position(cluster_of_[v]); }
  int next(int p) const { return p + 1 < size() ? p + 1 : 0; }
  int previous(int p) const { return p > 0 ? p - 1 : size() - 1; }
  const std::vector<int>& vertices() const { return vertices_; }

  /// Another vertex of the same cluster at position p.
  void set(int p, int v) {
    changes_.push_back({vertex(p), -1 - p});
    vertices_[at(p)] = v;
  }

  /// Turns round the positions first … last (cyclic), exactly these.
  void turn(int first, int last) {
    changes_.push_back({first, last});
    swap_ends(first, last);
  }

  /// Turns round the positions first … last or all others, whichever are fewer: as a cycle without a sense
  /// the tour becomes the same.
  void turn_shorter(int first, int last) {
    int length = last - first + 1;
    if (length <= 0) length += size();
    if (2 * length <= size()) {
      turn(first, last);
    } else {
      turn(next(last), previous(first));
    }
  }

  /// Swaps the neighbouring stretches first … middle and middle+1 … last (cyclic); keeps their senses. Moves
  /// the two shortest of the three stretches there are.
  void swap_stretches(int first, int middle, int last);

  void forget_changes() { changes_.clear(); }
  std::size_t change_count() const { return changes_.size(); }
  /// Takes the latest changes back until `count` are left.
  void take_back(std::size_t count = 0) {
    for (; changes_.size() > count; changes_.pop_back()) {
      const Change& c = changes_.back();
      if (c.last < 0) {
        vertices_[at(-1 - c.last)] = c.first;
      } else {
        swap_ends(c.first, c.last);
      }
    }
  }

 private:
  struct Change {
    int first;  ///< position; of a set: the vertex before
    int last;   ///< position; of a set: −1 − position
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void put(int p, int v) {
    vertices_[at(p)] = v;
    position_[at(cluster_of_[v])] = p;
  }
  void swap_ends(int first, int last) {
    int length = last - first + 1;
    if (length <= 0) length += size();
    for (int swaps = length / 2; swaps > 0; --swaps) {
      const int a = vertex(first);
      put(first, vertex(last));
      put(last, a);
      first = next(first);
      last = previous(last);
    }
  }

  std::vector<int> vertices_;
  const int* cluster_of_;
  std::vector<int> position_;
  std::vector<Change> changes_;
};

inline void ArrayTour::swap_stretches(int first, int middle, int last) {
  const auto length = [&](int from, int to) { return to >= from ? to - from + 1 : to - from + 1 + size(); };
  const int a = length(first, middle);
  const int b = length(next(middle), last);
  const int c = size() - a - b;
  int begin = first;
  int left = a;
  int right = b;
  if (a >= b && a >= c) {
    begin = next(middle);
    left = b;
    right = c;
  } else if (b >= a && b >= c) {
    begin = next(last);
    left = c;
    right = a;
  }
  if (left == 0 || right == 0) return;
  const auto shifted = [&](int p, int by) { return p + by < size() ? p + by : p + by - size(); };
  const int end = shifted(begin, left + right - 1);
  turn(begin, shifted(begin, left - 1));
  turn(shifted(begin, left), end);
  turn(begin, end);
}

}  // namespace swallowtail::gtsp::search
