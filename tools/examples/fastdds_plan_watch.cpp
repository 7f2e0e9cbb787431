// Prints each revision of the plans as it arrives, from the IDL alone: fastdds_plan_watch DOMAIN SECONDS
// Network: FASTRTPS_DEFAULT_PROFILES_FILE, e.g. <share>/swallowtail/profiles/fastdds.xml.
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <thread>

#include "planPubSubTypes.h"

using namespace eprosima::fastdds::dds;
static void print(const swallowtail::PathPlan& p) {
  std::printf("PathPlan vehicle %u revision %u: %zu waypoints, %s\n", p.vehicle_id(), p.revision(), p.waypoints().size(), p.reason().c_str());
}
static void print(const swallowtail::CoveragePlan& p) {
  std::printf("CoveragePlan task %u revision %u: %zu legs, %s\n", p.task_id(), p.revision(), p.legs().size(), p.reason().c_str());
}

template <class Plan>
struct Watch : DataReaderListener {
  void on_data_available(DataReader* reader) override {
    Plan plan;
    SampleInfo info;
    while (reader->take_next_sample(&plan, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data) print(plan);
    std::fflush(stdout);
  }
};

DataReader* make_reader(DomainParticipant* participant, TypeSupport type, const char* name, DataReaderListener* watch) {
  type.register_type(participant);
  DataReaderQos qos;
  qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = TRANSIENT_LOCAL_DURABILITY_QOS;
  qos.ownership().kind = EXCLUSIVE_OWNERSHIP_QOS;
  qos.liveliness().kind = MANUAL_BY_TOPIC_LIVELINESS_QOS;
  qos.liveliness().lease_duration = eprosima::fastrtps::Duration_t(0, 300000000);
  qos.resource_limits().max_instances = qos.resource_limits().max_samples = 64;  // the default of 10 instances rejects the rest
  qos.resource_limits().max_samples_per_instance = 1;
  Topic* topic = participant->create_topic(name, type.get_type_name(), TOPIC_QOS_DEFAULT);
  return participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT)->create_datareader(topic, qos, watch);
}

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: fastdds_plan_watch DOMAIN SECONDS\n"), 2;
  auto* factory = DomainParticipantFactory::get_instance();
  factory->load_profiles();
  DomainParticipant* participant = factory->create_participant(std::atoi(argv[1]), factory->get_default_participant_qos());
  if (!participant) return std::fprintf(stderr, "fastdds_plan_watch: no participant\n"), 1;
  Watch<swallowtail::PathPlan> paths; Watch<swallowtail::CoveragePlan> covers;
  if (!make_reader(participant, TypeSupport(new swallowtail::PathPlanPubSubType), "PathPlan", &paths) ||
      !make_reader(participant, TypeSupport(new swallowtail::CoveragePlanPubSubType), "CoveragePlan", &covers)) return 1;
  std::this_thread::sleep_for(std::chrono::seconds(std::atoi(argv[2])));
  participant->delete_contained_entities();
  factory->delete_participant(participant);
}
