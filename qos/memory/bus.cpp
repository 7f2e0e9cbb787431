#include "qos/memory/bus.hpp"

#include <functional>
#include <string>
#include <tuple>

#include "idl/data/validate.hpp"
#include "qos/counters.hpp"
#include "qos/endpoints.hpp"
#include "qos/memory/topic.hpp"
#include "qos/refused.hpp"

namespace swallowtail {

struct MemoryNetwork::State {
  std::tuple<memory::Topic<data::TerrainTile>, memory::Topic<data::Obstacle>,
             memory::Topic<data::VehicleState>, memory::Topic<data::BatteryState>,
             memory::Topic<data::CoverageTask>, memory::Topic<data::Goal>, memory::Topic<data::MissionClock>,
             memory::Topic<data::CoveragePlan>, memory::Topic<data::ChargerPlan>,
             memory::Topic<data::PathPlan>, memory::Topic<data::ChargerState>,
             memory::Topic<data::ParticipantStatus>>
      topics;

  template <class T>
  memory::Topic<T>& topic() {
    return std::get<memory::Topic<T>>(topics);
  }
};

namespace {

template <class T>
class MemoryPublisher final : public Publisher<T> {
 public:
  MemoryPublisher(std::shared_ptr<MemoryNetwork::State> state, std::int32_t strength)
      : state_(std::move(state)), id_(topic().add_writer(strength)) {}
  ~MemoryPublisher() override { topic().remove_writer(id_); }
  MemoryPublisher(const MemoryPublisher&) = delete;
  MemoryPublisher& operator=(const MemoryPublisher&) = delete;

  Status publish(const T& sample) override {
    if (const data::Refusal refusal = data::validate(sample)) return refused(TopicOf<T>::qos, *refusal);
    topic().publish(id_, sample);
    return {};
  }
  Status dispose(const T& last) override {
    if (const data::Refusal refusal = data::validate(last)) return refused(TopicOf<T>::qos, *refusal);
    topic().dispose(id_, last);
    return {};
  }
  void assert_liveliness() override {}

 private:
  memory::Topic<T>& topic() { return state_->template topic<T>(); }

  const std::shared_ptr<MemoryNetwork::State> state_;
  const int id_;
};

class MemoryBus final : public BusOfAllTopics<MemoryBus> {
 public:
  explicit MemoryBus(std::shared_ptr<MemoryNetwork::State> state) : state_(std::move(state)) {}
  ~MemoryBus() override {
    for (const auto& leave : leave_) leave();
  }
  MemoryBus(const MemoryBus&) = delete;
  MemoryBus& operator=(const MemoryBus&) = delete;

  template <class T>
  Result<std::unique_ptr<Publisher<T>>> open_publisher(const PublisherOptions& options) {
    return std::unique_ptr<Publisher<T>>(
        std::make_unique<MemoryPublisher<T>>(state_, options.ownership_strength));
  }

  template <class T>
  Status open_subscription(Handlers<T> handlers) {
    auto reader = std::make_shared<memory::Subscription<T>>(std::move(handlers), counters_);
    leave_.emplace_back([state = state_, reader] {
      state->template topic<T>().remove_reader(reader);
      reader->close();
    });
    state_->topic<T>().add_reader(reader);
    return {};
  }

  BusStatistics statistics() const override { return counters_->snapshot(); }
  void count_rejection(std::string_view topic, std::string_view reason) override {
    counters_->reject(topic, reason);
  }

 private:
  const std::shared_ptr<MemoryNetwork::State> state_;
  const std::shared_ptr<Counters> counters_ = std::make_shared<Counters>();
  std::vector<std::function<void()>> leave_;
};

}  // namespace

MemoryNetwork::MemoryNetwork() : state_(std::make_shared<State>()) {}
MemoryNetwork::~MemoryNetwork() = default;
std::unique_ptr<Bus> MemoryNetwork::make_bus() { return std::make_unique<MemoryBus>(state_); }

}  // namespace swallowtail
