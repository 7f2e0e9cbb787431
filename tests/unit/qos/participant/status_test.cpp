#include "qos/participant/status.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "qos/memory/bus.hpp"

namespace swallowtail {
namespace {

using data::Health;

class StatusPublisherTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(other_->subscribe<data::ParticipantStatus>(
        {.on_sample = [this](const data::ParticipantStatus& status) { seen_.push_back(status); }}));
    status_ =
        StatusPublisher::make(*bus_, clock_, {.participant_id = 9, .name = std::string(40, 'n')}).value();
  }

  ManualClock clock_;
  MemoryNetwork network_;
  std::unique_ptr<Bus> bus_ = network_.make_bus();
  std::unique_ptr<Bus> other_ = network_.make_bus();
  std::vector<data::ParticipantStatus> seen_;
  std::unique_ptr<StatusPublisher> status_;
};

TEST_F(StatusPublisherTest, PublishesAtItsPeriod) {
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(status_->step());
    clock_.advance(0.01);
  }
  EXPECT_NEAR(static_cast<double>(seen_.size()), 20.0, 1.0) << "2 Hz over 10 s";
  EXPECT_EQ(seen_.front().participant_id, 9U);
  EXPECT_EQ(seen_.front().health, Health::kStarting);
  EXPECT_EQ(seen_.front().name.size(), 32U) << "the contract's bound";
}

TEST_F(StatusPublisherTest, TellsAChangeOfHealthAtOnceAndNothingTwice) {
  ASSERT_TRUE(status_->step());
  clock_.advance(0.01);
  status_->set_health(Health::kReady, std::string(300, 'm'));
  ASSERT_TRUE(status_->step());
  ASSERT_EQ(seen_.size(), 2U);
  EXPECT_EQ(seen_[1].health, Health::kReady);
  EXPECT_EQ(seen_[1].message.size(), 256U);
  clock_.advance(0.01);
  status_->set_health(Health::kReady, "a new message alone waits for its turn");
  ASSERT_TRUE(status_->step());
  EXPECT_EQ(seen_.size(), 2U);
  clock_.advance(0.5);
  ASSERT_TRUE(status_->step());
  EXPECT_EQ(seen_.size(), 3U);
}

TEST_F(StatusPublisherTest, SaysWhatTheBusAndTheParticipantCounted) {
  bus_->count_rejection("PathPlan", "stale start");
  bus_->count_rejection("PathPlan", "stale start");
  status_->count_replan();
  for (int i = 1; i <= 100; ++i) status_->add_latency_ms(i);
  ASSERT_TRUE(status_->step());
  const data::ParticipantStatus& status = seen_.back();
  ASSERT_EQ(status.rejected.size(), 1U);
  EXPECT_EQ(status.rejected[0].reason, "stale start");
  EXPECT_EQ(status.rejected[0].count, 2U);
  EXPECT_EQ(status.replans, 1U);
  EXPECT_EQ(status.latency_p50_ms, 50.0);
  EXPECT_EQ(status.latency_p99_ms, 99.0);
  EXPECT_EQ(status.latency_max_ms, 100.0);
}

}  // namespace
}  // namespace swallowtail
