#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "coverage/fleet/trace.hpp"

namespace swallowtail::coverage {

/// Two aircraft aloft keep one of the first two distances at all times. Where one or both have landed (the
/// place of the last landing included, for good), or a robot waits at a rendezvous, `landed_m` takes the
/// first one's place.
struct Separation {
  double horizontal_m = 10.0;
  double vertical_m = 5.0;
  double landed_m = 3.0;
};

/// Whether two pieces, the first `shift_s` later than it says, come closer than they should: closed form of
/// the times at which both distances are too small.
bool conflict(const TimedPiece& a, double shift_s, const TimedPiece& b, const Separation& separation);

/// Whether two traces do anywhere.
bool conflict(const Trace& a, const Trace& b, const Separation& separation);

/// How much later each stretch of `mover` begins so that it keeps its distance from all others, which stay as
/// they are; never falling from stretch to stretch: the time is waited out on the ground before it. The first
/// schedule found by looking for the least delay stretch by stretch, going back where a place to wait is not
/// free for long enough. Nothing when there is none with at most `most_s`.
std::optional<std::vector<double>> delays_of(const Trace& mover, std::span<const Trace> others,
                                             const Separation& separation, double most_s);

/// The plan with its stretches so much later.
void delay(Plan& plan, const Trace& trace, std::span<const double> delays_s);

}  // namespace swallowtail::coverage
