#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <tuple>

#include "qos/cyclone/bus.hpp"
#include "qos/fastdds/bus.hpp"
#include "tests/contract/bus/probe.hpp"
#include "tests/interop/process.hpp"
#include "tests/unit/idl/samples.hpp"

// Writers of either vendor in processes of their own; readers of both vendors here. Domains 70 to 89.
namespace swallowtail {
namespace {

using Clock = std::chrono::steady_clock;
using testing::Extent;
using testing::make_sample;
using testing::Probe;
using testing::Process;

constexpr std::chrono::seconds kPatience{10};

std::uint32_t next_domain() {
  static std::uint32_t last = 69;
  return ++last;
}

std::unique_ptr<Process> start_peer(const std::string& vendor, std::uint32_t domain, const std::string& role,
                                    const std::string& argument = {}) {
  std::vector<std::string> command = {std::string(SWALLOWTAIL_BINARY_DIR) + "/tests/interop_peer", vendor,
                                      std::to_string(domain), role};
  if (!argument.empty()) command.push_back(argument);
  return std::make_unique<Process>(command);
}

double since_ms(Clock::time_point start, Clock::time_point end = Clock::now()) {
  return std::chrono::duration<double, std::milli>(end - start).count();
}

/// A bus of each vendor.
struct Readers {
  explicit Readers(std::uint32_t domain) {
    auto fast_bus = make_fast_bus({.domain = domain, .participant_name = "reader"});
    auto cyclone_bus = make_cyclone_bus({.domain = domain, .participant_name = "reader"});
    EXPECT_TRUE(fast_bus.ok() && cyclone_bus.ok());
    fast = std::move(*fast_bus);
    cyclone = std::move(*cyclone_bus);
  }
  std::unique_ptr<Bus> fast;
  std::unique_ptr<Bus> cyclone;
};

class FromVendor : public ::testing::TestWithParam<std::string> {};

template <class... Ts>
std::tuple<Probe<Ts>...> probes_of(std::tuple<Ts...>);

TEST_P(FromVendor, EveryTopicArrivesAtItsBounds) {
  const std::uint32_t domain = next_domain();
  decltype(probes_of(testing::AllTypes{})) at_fast;
  decltype(probes_of(testing::AllTypes{})) at_cyclone;
  const Readers readers(domain);
  testing::for_each_type([&](auto type) {
    using T = decltype(type);
    ASSERT_TRUE(readers.fast->subscribe<T>(std::get<Probe<T>>(at_fast).handlers()).ok());
    ASSERT_TRUE(readers.cyclone->subscribe<T>(std::get<Probe<T>>(at_cyclone).handlers()).ok());
  });
  const auto peer = start_peer(GetParam(), domain, "samples");
  ASSERT_TRUE(peer->wait_for_line("ready", kPatience));
  testing::for_each_type([&](auto type) {
    using T = decltype(type);
    for (auto* probe : {&std::get<Probe<T>>(at_fast), &std::get<Probe<T>>(at_cyclone)}) {
      const bool is_fast = probe == &std::get<Probe<T>>(at_fast);
      for (const Extent extent : {Extent::kEmpty, Extent::kRandom, Extent::kFull}) {
        const T expected = make_sample<T>(extent, 42 + static_cast<std::uint64_t>(extent));
        ASSERT_TRUE(probe->wait(
            [&](const auto& samples, const auto&) {
              return std::find(samples.begin(), samples.end(), expected) != samples.end();
            },
            kPatience))
            << TopicOf<T>::qos.name << " " << static_cast<int>(extent) << " at "
            << (is_fast ? "Fast" : "Cyclone");
      }
    }
  });
  EXPECT_TRUE(readers.fast->statistics().rejected.empty());
  EXPECT_TRUE(readers.cyclone->statistics().rejected.empty());
  EXPECT_EQ(readers.fast->statistics().incompatible_qos, 0u);
  EXPECT_EQ(readers.cyclone->statistics().incompatible_qos, 0u);
  EXPECT_EQ(peer->finish(), 0);
}

TEST_P(FromVendor, LateJoinersGetAThousandObstaclesAndTheirDisposes) {
  const std::uint32_t domain = next_domain();
  constexpr std::uint32_t kCount = 1000;
  const auto peer = start_peer(GetParam(), domain, "obstacles", std::to_string(kCount));
  ASSERT_TRUE(peer->wait_for_line("ready", kPatience));
  Probe<data::Obstacle> at_fast;
  Probe<data::Obstacle> at_cyclone;
  const auto start = Clock::now();
  const Readers readers(domain);
  ASSERT_TRUE(readers.fast->subscribe<data::Obstacle>(at_fast.handlers()).ok());
  ASSERT_TRUE(readers.cyclone->subscribe<data::Obstacle>(at_cyclone.handlers()).ok());
  for (auto* probe : {&at_fast, &at_cyclone}) {
    EXPECT_TRUE(probe->wait_for_samples(kCount, kPatience)) << probe->samples().size();
    std::vector<bool> seen(kCount + 1);
    for (const auto& sample : probe->samples()) seen.at(sample.obstacle_id) = true;
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), kCount);
    const auto times = probe->times();
    if (!times.empty()) {
      std::printf("late joiner, %s writer, %s reader: first %.0f ms, last %.0f ms\n", GetParam().c_str(),
                  probe == &at_fast ? "fast" : "cyclone", since_ms(start, times.front()),
                  since_ms(start, times.back()));
    }
  }
  peer->write_line("dispose 901 905");
  for (auto* probe : {&at_fast, &at_cyclone}) {
    for (std::uint32_t id = 901; id <= 905; ++id)
      EXPECT_TRUE(probe->wait_for_gone({id, 0, 0}, kPatience)) << id;
    EXPECT_EQ(probe->gone().size(), 5u);
  }
  EXPECT_EQ(peer->finish(), 0);
}

INSTANTIATE_TEST_SUITE_P(Vendors, FromVendor, ::testing::Values("fast", "cyclone"),
                         [](const auto& vendor) { return vendor.param; });

class Failover : public ::testing::TestWithParam<std::tuple<std::string, std::string, int>> {
 protected:
  bool wait_for_last(Probe<data::PathPlan>& probe, std::uint32_t revision) {
    return probe.wait([&](const auto& samples,
                          const auto&) { return !samples.empty() && samples.back().revision == revision; },
                      kPatience);
  }
};

TEST_P(Failover, TheWeakerOwnerTakesOverAtReadersOfBothVendors) {
  const auto& [strong_vendor, weak_vendor, signal] = GetParam();
  const std::uint32_t domain = next_domain();
  Probe<data::PathPlan> at_fast;
  Probe<data::PathPlan> at_cyclone;
  const Readers readers(domain);
  ASSERT_TRUE(readers.fast->subscribe<data::PathPlan>(at_fast.handlers()).ok());
  ASSERT_TRUE(readers.cyclone->subscribe<data::PathPlan>(at_cyclone.handlers()).ok());
  const auto strong = start_peer(strong_vendor, domain, "plan", "10");
  ASSERT_TRUE(strong->wait_for_line("ready", kPatience));
  ASSERT_TRUE(wait_for_last(at_fast, 10));
  ASSERT_TRUE(wait_for_last(at_cyclone, 10));
  const auto weak = start_peer(weak_vendor, domain, "plan", "5");
  ASSERT_TRUE(weak->wait_for_line("ready", kPatience));
  // Nothing here may hear the weaker one: let it match within the time of the stronger one's next 60 samples
  // (1.2 s). had, so wait long enough for a match by counting the strong one's samples.
  const auto settled = [&](Probe<data::PathPlan>& probe) {
    const std::size_t now = probe.samples().size();
    return probe.wait_for_samples(now + 60, kPatience);
  };
  ASSERT_TRUE(settled(at_fast));
  for (auto* probe : {&at_fast, &at_cyclone}) {
    for (const auto& plan : probe->samples()) ASSERT_EQ(plan.revision, 10u) << "the weaker one was heard";
    probe->clear();
  }
  const auto start = Clock::now();
  strong->send(signal);
  for (auto* probe : {&at_fast, &at_cyclone}) {
    ASSERT_TRUE(wait_for_last(*probe, 5)) << (probe == &at_fast ? "fast" : "cyclone");
    const auto samples = probe->samples();
    const auto times = probe->times();
    const auto first =
        std::find_if(samples.begin(), samples.end(), [](const auto& p) { return p.revision == 5; });
    const double took_ms = since_ms(start, times[static_cast<std::size_t>(first - samples.begin())]);
    std::printf("failover %s -> %s by %s at a %s reader: %.0f ms\n", strong_vendor.c_str(),
                weak_vendor.c_str(), signal == SIGKILL ? "SIGKILL" : "SIGSTOP",
                probe == &at_fast ? "fast" : "cyclone", took_ms);
    EXPECT_LE(took_ms, 1200.0);
  }
  if (signal == SIGSTOP) {
    strong->send(SIGCONT);
    EXPECT_TRUE(wait_for_last(at_fast, 10)) << "the stronger one is back";
    EXPECT_TRUE(wait_for_last(at_cyclone, 10)) << "the stronger one is back";
  }
}

INSTANTIATE_TEST_SUITE_P(Vendors, Failover,
                         ::testing::Combine(::testing::Values("fast", "cyclone"),
                                            ::testing::Values("fast", "cyclone"),
                                            ::testing::Values(SIGKILL, SIGSTOP)),
                         [](const auto& run) {
                           return std::get<0>(run.param) + "_" + std::get<1>(run.param) + "_" +
                                  (std::get<2>(run.param) == SIGKILL ? "killed" : "frozen");
                         });

}  // namespace
}  // namespace swallowtail
