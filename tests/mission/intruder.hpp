#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "idl/data/types.hpp"

namespace swallowtail::testing {

/// A participant that must refuse a sample, the topic and the reason it must give.
using Refusal = std::tuple<std::uint32_t, std::string, std::string>;

/// Writes what no participant may act on, most of it in the name of the mission's own vehicle, task and
/// robot.
class Intruder {
 public:
  explicit Intruder(std::uint32_t domain);
  ~Intruder();

  /// Writes one sample of every kind but the next.
  void write_all();

  /// A battery of the mission's vehicle, sound in itself, with more than the task allows.
  void write_battery_above_the_task();

  /// All of a mission's readers know of the writers, so the recorder's do too.
  bool is_heard_by_the_recorder() const;

  /// Who must count what.
  static std::vector<Refusal> expected();

 private:
  struct Writers;
  std::unique_ptr<Writers> writers_;
};

}  // namespace swallowtail::testing
