#include <iostream>

#include "planner/base/clock.hpp"
#include "qos/cyclone/bus.hpp"
#include "qos/participant/run_loop.hpp"
#include "qos/participant/signals.hpp"
#include "qos/participant/status.hpp"
#include "tools/record/cyclone/receiver.hpp"
#include "tools/record/options.hpp"
#include "tools/record/report.hpp"

namespace {

using namespace swallowtail;

constexpr int kBadInput = 2;
constexpr int kInternalError = 4;
constexpr double kStepPeriod_s = 0.25;

int fail(const Error& error, int code = kInternalError) {
  std::cerr << "swallowtail-record: " << error.message << '\n';
  return code;
}

int fail_to_start(const Error& error) {
  return fail(error, error.code == Error::Code::kBadInput ? kBadInput : kInternalError);
}

int finish(const record::Options& options, record::Session& session) {
  const auto summary = session.finish();
  if (!summary) return fail(summary.error());
  if (options.json) {
    std::cout << record::summary_json(options, *summary) << '\n';
  } else if (!options.quiet) {
    std::cout << record::summary_text(options, *summary);
  }
  return 0;
}

int run(const record::Options& options, const StopSignals& stop) {
  record::SessionParams params;
  params.file.compression = options.compression;
  auto session = record::Session::start(options.output, options.topics, params);
  if (!session) return fail_to_start(session.error());
  // The bus sets the domain's configuration: it comes before the receiver and goes after it.
  auto bus = make_cyclone_bus({.domain = options.domain, .participant_name = "swallowtail-record"});
  if (!bus) return fail_to_start(bus.error());
  const SteadyClock clock;
  auto status =
      StatusPublisher::make(**bus, clock, {.participant_id = data::kRecorderId, .name = "recorder"});
  if (!status) return fail(status.error());
  auto receiver = record::cyclone::Receiver::open(options.domain, **session);
  if (!receiver) return fail(receiver.error());
  (*status)->set_health(data::Health::kReady, options.output.filename().string());
  if (!options.quiet)
    std::cerr << "recording domain " << options.domain << " into " << options.output.string() << std::endl;

  run_loop(stop, kStepPeriod_s, [&] {
    (*receiver)->update_counts();
    const Status failure = (*session)->failure();
    if (!failure) (*status)->set_health(data::Health::kFailed, failure.error().message);
    static_cast<void>((*status)->step());  // nobody may be listening; the recording goes on
    return failure.ok();
  });
  (*receiver)->update_counts();
  receiver->reset();
  return finish(options, **session);
}

}  // namespace

int main(int argc, char** argv) {
  const StopSignals stop;
  const auto options = record::parse_options(argc, argv);
  if (const int* code = std::get_if<int>(&options)) return *code;
  return run(std::get<record::Options>(options), stop);
}
