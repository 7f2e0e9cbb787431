#pragma once

#include "planner/cost/path_batch.hpp"

namespace swallowtail::planner {

/// One thing to be kept small about a path. The value of a lane depends on that lane alone, bit for bit, and
/// no memory is taken. Objectives are immutable, so threads may share them.
class Objective {
 public:
  virtual ~Objective() = default;
  /// As it stands in `planning.weights` and in the answer's cost terms.
  virtual const char* name() const = 0;
  /// Writes the eight values: finite and not negative for finite points.
  virtual void evaluate(const PathBatch& paths, Lanes& values) const = 0;
};

}  // namespace swallowtail::planner
