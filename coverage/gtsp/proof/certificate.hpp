#pragma once

#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"
#include "coverage/gtsp/detail/pruning.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::gtsp::proof {

struct CertificateParams {
  double upper_bound = kNoArc;       ///< cost of a known closed tour of the folded instance
  double work = 1e8;                 ///< elementary steps, a nanosecond or two each
  std::size_t max_states = 500'000;  ///< of the search for the best tour
};

/// What could be proved about closed tours of the folded instance.
struct Certificate {
  enum class Kind {
    kBound,    ///< no tour costs less than lower_bound, which is not more than the upper bound
    kOptimal,  ///< `order` is a tour of the least cost, lower_bound
    kProved,   ///< the known tour is one of the least cost
    kNoTour    ///< there is none at all
  };
  Kind kind = Kind::kBound;
  double lower_bound = 0.0;
  double rounding = 0.0;   ///< as detail::Bound::rounding
  std::vector<int> order;  ///< original vertices (vertex_count = anchor), closed
  double work = 0.0;
};

/// Bounds from below by walks with prices (WalkAscent) and, where that leaves few enough states open, finds
/// the best tour (LabelSearch). At least two clusters must be left to visit, none emptied. Needs O(n²) time
/// and one matrix of m·n doubles at least; see kMaxWalkCells.
Certificate certify(const Instance& instance, const detail::Anchor& anchor, const detail::Pruning& pruning,
                    const CertificateParams& params, const StopCondition& stop);

/// Vertices times clusters up to which certify() is worth calling.
inline constexpr double kMaxWalkCells = 6e6;

}  // namespace swallowtail::gtsp::proof
