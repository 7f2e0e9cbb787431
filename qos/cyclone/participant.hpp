#pragma once

#include <memory>

#include "planner/base/result.hpp"
#include "qos/cyclone/entity.hpp"
#include "qos/options.hpp"

namespace swallowtail::cyclone {

/// A participant and its share of the domain, which the participants of a process have in common: only the
/// first can configure it, the last ends it.
class Participant {
 public:
  static Result<std::unique_ptr<Participant>> create(const BusOptions& options);

  dds_entity_t get() const { return participant_.get(); }

 private:
  Participant(std::shared_ptr<const Entity> domain, Entity participant)
      : domain_(std::move(domain)), participant_(std::move(participant)) {}

  std::shared_ptr<const Entity> domain_;
  Entity participant_;
};

}  // namespace swallowtail::cyclone
