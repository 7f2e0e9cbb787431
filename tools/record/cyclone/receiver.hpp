#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "planner/base/result.hpp"
#include "tools/record/session.hpp"

namespace swallowtail::record::cyclone {

/// A DDS participant with one raw reader per topic of the session, which puts all that arrives into it.
/// Samples are taken on the receiving thread as they come and handed on without a copy.
class Receiver {
 public:
  /// `session` must outlive the receiver.
  static Result<std::unique_ptr<Receiver>> open(std::uint32_t domain, Session& session);
  /// Nothing is recorded any more once this returns.
  ~Receiver();
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  /// Hands DDS's own counts of losses to the session.
  void update_counts();

 private:
  struct Topic;
  Receiver() = default;
  Status open_topic(Session& session, std::size_t index);

  std::int32_t participant_ = 0;
  std::vector<std::unique_ptr<Topic>> topics_;
};

}  // namespace swallowtail::record::cyclone
