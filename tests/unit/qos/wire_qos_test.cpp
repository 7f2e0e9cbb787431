#include <dds/dds.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "qos/cyclone/bus.hpp"
#include "qos/cyclone/participant.hpp"
#include "qos/fastdds/bus.hpp"
#include "qos/topics.hpp"
#include "tests/unit/idl/samples.hpp"

// What endpoints of both vendors announce on the wire, as a third participant sees it, against
// qos/topics.hpp. Domains 101 and 102.
namespace swallowtail {
namespace {

/// What one endpoint announces, in the table's terms.
struct Announced {
  std::string type;
  bool is_keyed = false;
  dds_reliability_kind_t reliability{};
  dds_durability_kind_t durability{};
  dds_ownership_kind_t ownership{};
  dds_liveliness_kind_t liveliness{};
  dds_duration_t lease = 0;
  dds_duration_t deadline = 0;
  dds_duration_t lifespan = 0;
};

Announced announced_by(const dds_builtintopic_endpoint_t& endpoint) {
  Announced result{.type = endpoint.type_name};
  // Entity kinds 02 and 07 are keyed, 03 and 04 are not.
  const auto kind = endpoint.key.v[15] & 0x0f;
  result.is_keyed = kind == 2 || kind == 7;
  dds_qget_reliability(endpoint.qos, &result.reliability, nullptr);
  dds_qget_durability(endpoint.qos, &result.durability);
  if (!dds_qget_ownership(endpoint.qos, &result.ownership)) result.ownership = DDS_OWNERSHIP_SHARED;
  if (!dds_qget_liveliness(endpoint.qos, &result.liveliness, &result.lease)) result.lease = DDS_INFINITY;
  if (!dds_qget_deadline(endpoint.qos, &result.deadline)) result.deadline = DDS_INFINITY;
  if (!dds_qget_lifespan(endpoint.qos, &result.lifespan)) result.lifespan = DDS_INFINITY;
  return result;
}

std::map<std::string, Announced> collect(dds_entity_t participant, dds_entity_t builtin_topic) {
  const dds_entity_t reader = dds_create_reader(participant, builtin_topic, nullptr, nullptr);
  std::map<std::string, Announced> found;
  for (int i = 0; i < 800 && found.size() < kTopics.size(); ++i) {
    void* samples[1] = {nullptr};
    dds_sample_info_t info;
    while (dds_take(reader, samples, &info, 1, 1) > 0) {
      const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(samples[0]);
      const bool is_ours =
          info.valid_data && std::string_view(endpoint.type_name).starts_with("swallowtail::");
      if (is_ours) found[endpoint.topic_name] = announced_by(endpoint);
      dds_return_loan(reader, samples, 1);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  dds_delete(reader);
  return found;
}

void expect_equal(const std::map<std::string, Announced>& found, bool are_writers) {
  ASSERT_EQ(found.size(), kTopics.size());
  const auto time = [](int ms) { return ms > 0 ? DDS_MSECS(ms) : DDS_INFINITY; };
  for (const TopicQos& row : kTopics) {
    ASSERT_TRUE(found.contains(row.name)) << row.name;
    const Announced& is = found.at(row.name);
    EXPECT_EQ(is.type, row.type_name);
    EXPECT_EQ(is.is_keyed, row.key_fields > 0) << row.name;
    EXPECT_EQ(is.reliability == DDS_RELIABILITY_RELIABLE, row.reliability == Reliability::kReliable)
        << row.name;
    EXPECT_EQ(is.durability, row.durability == Durability::kVolatile ? DDS_DURABILITY_VOLATILE
                                                                     : DDS_DURABILITY_TRANSIENT_LOCAL)
        << row.name;
    EXPECT_EQ(is.ownership == DDS_OWNERSHIP_EXCLUSIVE, row.ownership == Ownership::kExclusive) << row.name;
    // Times travel as seconds and 2^-32 fractions: within a microsecond.
    EXPECT_NEAR(static_cast<double>(is.lease), static_cast<double>(time(row.lease_ms)), 1e3) << row.name;
    if (row.lease_ms > 0) {
      EXPECT_EQ(is.liveliness, DDS_LIVELINESS_MANUAL_BY_TOPIC) << row.name;
    }
    const int deadline_ms = are_writers ? row.deadline_offered_ms : row.deadline_requested_ms;
    EXPECT_NEAR(static_cast<double>(is.deadline), static_cast<double>(time(deadline_ms)), 1e3) << row.name;
    if (are_writers) {
      EXPECT_NEAR(static_cast<double>(is.lifespan), static_cast<double>(time(row.lifespan_ms)), 1e3)
          << row.name;
    }
  }
}

class WireQos : public ::testing::TestWithParam<bool> {};

TEST_P(WireQos, IsThatOfTheTable) {
  const std::uint32_t domain = GetParam() ? 101 : 102;
  auto observer = cyclone::Participant::create({.domain = domain});
  ASSERT_TRUE(observer.ok());
  auto bus = GetParam() ? make_fast_bus({.domain = domain}) : make_cyclone_bus({.domain = domain});
  ASSERT_TRUE(bus.ok());
  std::vector<std::shared_ptr<void>> publishers;
  testing::for_each_type([&](auto type) {
    using T = decltype(type);
    auto publisher = (*bus)->publisher<T>();
    ASSERT_TRUE(publisher.ok());
    publishers.emplace_back(std::shared_ptr<Publisher<T>>(std::move(*publisher)));
    ASSERT_TRUE((*bus)->subscribe<T>({.on_sample = [](const T&) {}}).ok());
  });
  expect_equal(collect((*observer)->get(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION), true);
  expect_equal(collect((*observer)->get(), DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION), false);
}

INSTANTIATE_TEST_SUITE_P(Vendors, WireQos, ::testing::Bool(),
                         [](const auto& run) { return std::string(run.param ? "Fast" : "Cyclone"); });

}  // namespace
}  // namespace swallowtail
