#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gtest/gtest.h>

#include <vector>

#include "planner/base/rng.hpp"
#include "qos/fastdds/type.hpp"
#include "tests/unit/idl/samples.hpp"

// Bytes as they may come from the network into deserialiser, codec and validator: none may crash, and what
// passes must be valid. (Cyclone DDS checks bytes against the type before any of our code runs;
// tests/interop/refusal_test.cpp sends it the same.)
namespace swallowtail {
namespace {

using testing::Extent;

template <class T>
std::vector<unsigned char> bytes_of(const T& sample) {
  typename fast::WireOf<T>::Wire wire;
  codec::fast::to_wire(sample, wire);
  fast::Type<T> type;
  eprosima::fastrtps::rtps::SerializedPayload_t payload(type.getSerializedSizeProvider(&wire)());
  EXPECT_TRUE(type.serialize(&wire, &payload));
  return {payload.data, payload.data + payload.length};
}

/// What the receiving side makes of the bytes; true when a sample came of them.
template <class T>
bool receive(std::vector<unsigned char>& bytes) {
  fast::Type<T> type;
  typename fast::WireOf<T>::Wire wire;
  eprosima::fastrtps::rtps::SerializedPayload_t payload;
  payload.data = bytes.data();
  payload.length = static_cast<std::uint32_t>(bytes.size());
  payload.max_size = payload.length;
  const bool read = type.deserialize(&payload, &wire);
  payload.data = nullptr;  // not its to free
  T value;
  return read && !codec::fast::to_data(wire, value) && !data::validate(value);
}

TEST(FuzzFastCodec, RandomBytes) {
  testing::for_each_type([](auto type) {
    using T = decltype(type);
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
      Rng rng(seed);
      std::vector<unsigned char> bytes(rng.below(2000));
      for (auto& byte : bytes) byte = static_cast<unsigned char>(rng());
      if (bytes.size() > 4) bytes[0] = 0, bytes[1] = static_cast<unsigned char>(rng.below(2));
      (void)receive<T>(bytes);
    }
  });
}

TEST(FuzzFastCodec, DamagedSamples) {
  testing::for_each_type([](auto type) {
    using T = decltype(type);
    auto whole = bytes_of(testing::make_sample<T>(Extent::kRandom, 3));
    ASSERT_TRUE(receive<T>(whole));
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
      Rng rng(seed);
      auto bytes = whole;
      for (std::uint64_t hits = 1 + rng.below(4); hits > 0; --hits) {
        bytes[rng.below(bytes.size())] = static_cast<unsigned char>(rng());
      }
      if (rng.below(4) == 0) bytes.resize(rng.below(bytes.size()) + 1);
      (void)receive<T>(bytes);
    }
  });
}

}  // namespace
}  // namespace swallowtail
