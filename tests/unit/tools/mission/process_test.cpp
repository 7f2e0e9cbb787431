#include "tools/mission/run/process.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>

namespace swallowtail::mission {
namespace {

Process shell(const std::string& script) {
  auto process = Process::start("shell", {"/bin/sh", "-c", script});
  EXPECT_TRUE(process.ok());
  return std::move(process).value();
}

/// Waits until the child has written or ended.
std::string first_line(Process& process) {
  for (int i = 0; i < 200; ++i) {
    pollfd ready{process.out_fd(), POLLIN, 0};
    ::poll(&ready, 1, 50);
    const auto lines = process.take_lines();
    if (!lines.empty()) return lines.front();
  }
  return "nothing within ten seconds";
}

TEST(Process, GivesLinesAndExitCode) {
  Process process = shell("trap '' INT; echo one; echo oops >&2; exit 3");
  EXPECT_EQ(first_line(process), "one");
  EXPECT_EQ(process.stop(5.0), 3);
  EXPECT_EQ(process.last_errors(), "oops\n");
}

TEST(Process, StopsOnRequest) {
  Process process = shell("trap 'echo bye; exit 0' INT; echo ready; while :; do sleep 0.05; done");
  EXPECT_EQ(first_line(process), "ready");
  EXPECT_FALSE(process.poll().has_value());
  EXPECT_EQ(process.stop(10.0), 0);
}

TEST(Process, AsksOnce) {
  Process process =
      shell("trap 'echo asked' INT; echo ready; i=0; while [ $i -lt 40 ]; do sleep 0.02; i=$((i+1)); done");
  EXPECT_EQ(first_line(process), "ready");
  process.ask_to_stop();
  EXPECT_EQ(first_line(process), "asked");
  process.ask_to_stop();
  EXPECT_EQ(process.stop(10.0), 0);
  EXPECT_TRUE(process.take_lines().empty());
}

TEST(Process, KillsWhatDoesNotStop) {
  Process process = shell("trap '' INT; echo ready; while :; do sleep 0.05; done");
  EXPECT_EQ(first_line(process), "ready");
  EXPECT_EQ(process.stop(0.2), 128 + SIGKILL);
}

TEST(Process, DestructorLeavesNoChild) {
  pid_t pid = 0;
  {
    Process process = shell("echo ready; exec sleep 1000");
    EXPECT_EQ(first_line(process), "ready");
    pid = process.pid();
  }
  EXPECT_NE(::kill(pid, 0), 0);
}

TEST(Process, SaysWhenAProgramIsNotThere) {
  auto process = Process::start("ghost", {"/nonexistent/program"});
  ASSERT_TRUE(process.ok());
  for (int i = 0; i < 200 && !process->poll(); ++i) {
    pollfd closed{process->out_fd(), POLLIN, 0};
    ::poll(&closed, 1, 50);
  }
  EXPECT_EQ(process->stop(5.0), 127);
  EXPECT_NE(process->last_errors().find("cannot be started"), std::string::npos);
}

}  // namespace
}  // namespace swallowtail::mission
