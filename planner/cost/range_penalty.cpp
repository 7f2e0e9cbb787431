#include "planner/cost/range_penalty.hpp"

namespace swallowtail::planner {

void RangePenalty::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  for (std::size_t i = 0; i < paths.hops(); ++i) {
    const Lanes excess = paths.hop(i).length - operating_range_m_;
    values += (excess > 0.0).select(1.0 + excess, 0.0);
  }
}

}  // namespace swallowtail::planner
