#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/property/coverage/replay_task.hpp"

/// Plans that hold are spoilt one way after another, and each must be caught by the replay.
namespace swallowtail::coverage::test {

/// Spoils a plan, or makes the task one that it is not for; false where there is nothing to spoil.
using Spoil = std::function<bool(Plan&, Task&)>;

struct Planned {
  std::uint64_t seed = 0;
  ReplayTask random;
  Plan plan;
};

/// Made once for all tests.
const std::vector<Planned>& plans();
/// The same over open ground, with a robot whose own battery does for the greatest charge and little more.
const std::vector<Planned>& plans_with_weak_robots();

/// Spoils up to five plans and expects each to be caught.
void expect_caught(const Spoil& spoil, const std::string& fault, const std::vector<Planned>& sound = plans());

}  // namespace swallowtail::coverage::test
