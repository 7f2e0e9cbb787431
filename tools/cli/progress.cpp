#include "tools/cli/progress.hpp"

#include <chrono>
#include <utility>

#include <fmt/core.h>

namespace swallowtail::cli {
namespace {

constexpr int kSilent_s = 2;

}  // namespace

Progress::Progress(std::string what, Show show) : what_(std::move(what)) {
  if (show == Show::kYes) thread_ = std::thread([this] { run(); });
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Progress::update(std::string state) {
  const std::lock_guard lock(mutex_);
  state_ = std::move(state);
}

void Progress::run() {
  std::unique_lock lock(mutex_);
  for (int second = 1;; ++second) {
    if (changed_.wait_for(lock, std::chrono::seconds(1), [this] { return ended_; })) return;
    if (second > kSilent_s)
      fmt::print(stderr, "{}: {} s{}{}\n", what_, second, state_.empty() ? "" : ", ", state_);
  }
}

}  // namespace swallowtail::cli
