/* Prints each revision of the plans as it arrives, from the IDL alone: cyclone_plan_watch DOMAIN SECONDS
   The network is configured by CYCLONEDDS_URI, for one by file://<share>/swallowtail/profiles/cyclone.xml. */
#include <stdio.h>
#include <stdlib.h>
#include "dds/dds.h"
#include "plan.h"
static dds_entity_t make_reader(dds_entity_t participant, const dds_topic_descriptor_t* type,
                                const char* name, dds_duration_t deadline) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
  dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_MSECS(300));
  dds_qset_deadline(qos, deadline);
  const dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  if (reader < 0) {
    fprintf(stderr, "cyclone_plan_watch: no reader of %s: %s\n", name, dds_strretcode(reader));
    exit(1);
  }
  return reader;
}

int main(int argc, char** argv) {
  if (argc != 3) return fprintf(stderr, "usage: cyclone_plan_watch DOMAIN SECONDS\n"), 2;
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  if (participant < 0) return fprintf(stderr, "cyclone_plan_watch: %s\n", dds_strretcode(participant)), 1;
  const dds_entity_t paths = make_reader(participant, &swallowtail_PathPlan_desc, "PathPlan", DDS_SECS(20));
  const dds_entity_t covers =
      make_reader(participant, &swallowtail_CoveragePlan_desc, "CoveragePlan", DDS_INFINITY);
  const dds_entity_t set = dds_create_waitset(participant);
  dds_set_status_mask(paths, DDS_DATA_AVAILABLE_STATUS);
  dds_set_status_mask(covers, DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(set, paths, 0);
  dds_waitset_attach(set, covers, 0);
  const dds_time_t end = dds_time() + DDS_SECS(atoi(argv[2]));
  while (dds_time() < end) {
    dds_waitset_wait_until(set, NULL, 0, end);
    void* sample[1] = {NULL};
    dds_sample_info_t info;
    while (dds_take(paths, sample, &info, 1, 1) > 0) {
      const swallowtail_PathPlan* p = sample[0];
      if (info.valid_data)
        printf("PathPlan vehicle %u revision %u: %u waypoints, %s\n", p->vehicle_id, p->revision,
               p->waypoints._length, p->reason);
      dds_return_loan(paths, sample, 1);
    }
    while (dds_take(covers, sample, &info, 1, 1) > 0) {
      const swallowtail_CoveragePlan* p = sample[0];
      if (info.valid_data)
        printf("CoveragePlan task %u revision %u: %u legs, %s\n", p->task_id, p->revision, p->legs._length,
               p->reason);
      dds_return_loan(covers, sample, 1);
    }
    fflush(stdout);
  }
  return dds_delete(participant) == DDS_RETCODE_OK ? 0 : 1;
}
