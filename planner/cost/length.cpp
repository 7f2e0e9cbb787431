#include "planner/cost/length.hpp"

namespace swallowtail::planner {

void Length::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  for (std::size_t i = 0; i < paths.hops(); ++i) values += paths.hop(i).length;
  values /= unit_m_;
}

}  // namespace swallowtail::planner
