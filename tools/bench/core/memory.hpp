#pragma once

namespace swallowtail::bench {

/// Most memory that this process came to hold since the making of this, above what it held then, MiB. Memory
/// that was freed before is given back first, so that it does not hide what is taken. Of the whole process:
/// make sense of it where one thing runs at a time.
class PeakMemory {
 public:
  PeakMemory();
  /// Not a number where the system does not tell (no /proc).
  double taken_mb() const;

 private:
  double before_mb_ = 0.0;
};

}  // namespace swallowtail::bench
