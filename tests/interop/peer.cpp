// The other process of an interoperation test: a bus of one vendor that plays a role until its standard input
// ends.
//   interop_peer fast|cyclone DOMAIN samples              every type, empty, random and full
//   interop_peer fast|cyclone DOMAIN obstacles COUNT      that many instances; then a line "dispose FIRST
//   LAST" disposes some interop_peer fast|cyclone DOMAIN plan STRENGTH        path plans of vehicle 1 every
//   20 ms, their revision the strength
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "qos/cyclone/bus.hpp"
#include "qos/fastdds/bus.hpp"
#include "qos/topics.hpp"
#include "tests/unit/idl/samples.hpp"

namespace swallowtail {
namespace {

using testing::Extent;
using testing::make_sample;

void say(const char* line) {
  std::puts(line);
  std::fflush(stdout);
}

void require(const Status& status) {
  if (status.ok()) return;
  std::fprintf(stderr, "interop_peer: %s\n", status.error().message.c_str());
  std::exit(1);
}

template <class T>
std::unique_ptr<Publisher<T>> open(Bus& bus, std::int32_t strength = 10) {
  auto publisher = bus.publisher<T>({.ownership_strength = strength});
  if (!publisher.ok()) require(publisher.error());
  return std::move(*publisher);
}

/// Calls `work` every `period` until standard input ends; `line` gets what comes from there.
void play(std::chrono::milliseconds period, const std::function<void()>& work,
          const std::function<void(const std::string&)>& line = {}) {
  while (true) {
    work();
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    if (poll(&input, 1, static_cast<int>(period.count())) <= 0) continue;
    std::string text;
    if (!std::getline(std::cin, text)) return;
    if (line) line(text);
  }
}

void play_samples(Bus& bus) {
  std::vector<std::function<void()>> publish;
  testing::for_each_type([&](auto type) {
    using T = decltype(type);
    const std::shared_ptr<Publisher<T>> publisher = open<T>(bus);
    // Latched samples are written once, the others again and again; of a topic without a key only the last is
    // kept.
    for (const Extent extent : {Extent::kEmpty, Extent::kRandom, Extent::kFull}) {
      const T sample = make_sample<T>(extent, 42 + static_cast<std::uint64_t>(extent));
      require(publisher->publish(sample));
      if (TopicOf<T>::qos.durability == Durability::kTransientLocal) {
        publish.emplace_back([publisher] { publisher->assert_liveliness(); });
      } else {
        publish.emplace_back([publisher, sample] { require(publisher->publish(sample)); });
      }
    }
  });
  say("ready");
  play(std::chrono::milliseconds(50), [&] {
    for (const auto& f : publish) {
      f();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // so that a reader of depth 1 sees each
    }
  });
}

void play_obstacles(Bus& bus, std::uint32_t count) {
  const auto publisher = open<data::Obstacle>(bus);
  auto obstacle = make_sample<data::Obstacle>(Extent::kEmpty, 42);
  for (std::uint32_t id = 1; id <= count; ++id) {
    obstacle.obstacle_id = id;
    require(publisher->publish(obstacle));
  }
  say("ready");
  play(
      std::chrono::milliseconds(100), [] {},
      [&](const std::string& line) {
        std::uint32_t first = 0;
        std::uint32_t last = 0;
        if (std::sscanf(line.c_str(), "dispose %u %u", &first, &last) != 2) return;
        for (obstacle.obstacle_id = first; obstacle.obstacle_id <= last; ++obstacle.obstacle_id) {
          require(publisher->dispose(obstacle));
        }
      });
}

void play_plan(Bus& bus, std::int32_t strength) {
  const auto publisher = open<data::PathPlan>(bus, strength);
  auto plan = make_sample<data::PathPlan>(Extent::kEmpty, 42);
  plan.vehicle_id = 1;
  plan.revision = static_cast<std::uint32_t>(strength);
  say("ready");
  play(std::chrono::milliseconds(20), [&] { require(publisher->publish(plan)); });
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 3) return 2;
  const BusOptions options{.domain = static_cast<std::uint32_t>(std::stoul(arguments[1])),
                           .participant_name = "peer"};
  auto bus = arguments[0] == "fast" ? make_fast_bus(options) : make_cyclone_bus(options);
  if (!bus.ok()) require(bus.error());
  const std::string& role = arguments[2];
  if (role == "samples") play_samples(**bus);
  if (role == "obstacles") play_obstacles(**bus, static_cast<std::uint32_t>(std::stoul(arguments.at(3))));
  if (role == "plan") play_plan(**bus, std::stoi(arguments.at(3)));
  return 0;
}

}  // namespace
}  // namespace swallowtail

int main(int argc, char** argv) { return swallowtail::run({argv + 1, argv + argc}); }
