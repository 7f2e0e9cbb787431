#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "coverage/fleet/trace.hpp"

namespace swallowtail::coverage {

/// Two aircraft aloft keep one of the first two distances at all times. Where one or both have landed (the
/// place of the last landing included, for good), or it is a robot, `landed_m` takes the first one's place;
/// two on the ground keep it whatever their heights.
struct Separation {
  double horizontal_m = 10.0;
  double vertical_m = 5.0;
  double landed_m = 3.0;
};

struct Times {
  double from_s = -std::numeric_limits<double>::infinity();
  double to_s = std::numeric_limits<double>::infinity();

  /// Just touching is no time.
  static constexpr double kTouch_s = 1e-7;
  bool last() const { return to_s - from_s > kTouch_s; }
};

/// Whether two pieces come closer than they should at whatever times.
bool boxes_meet(const TimedPiece& a, const TimedPiece& b, const Separation& separation);

/// When two pieces, the first `shift_s` later than it says, are closer than they should be, in closed form;
/// times that do not last: never.
Times close_times(const TimedPiece& a, double shift_s, const TimedPiece& b, const Separation& separation);

/// Whether two pieces, the first `shift_s` later than it says, come closer than they should.
bool conflict(const TimedPiece& a, double shift_s, const TimedPiece& b, const Separation& separation);

/// Whether two traces do anywhere.
bool conflict(const Trace& a, const Trace& b, const Separation& separation);

/// By stretch.
struct Delays {
  std::vector<double> stretch_s;  ///< never falling: the time is waited out on the ground before it
  std::vector<double> robot_s;    ///< the robot leaves so much later than its aircraft, as its slack allows
};

/// How much later each stretch of `mover` begins so that it keeps its distance from all others, which stay as
/// they are. The first schedule found by looking for the least delay stretch by stretch, going back where a
/// place to wait is not free for long enough. Nothing when there is none with at most `most_s`.
std::optional<Delays> delays_of(const Trace& mover, std::span<const Trace> others,
                                const Separation& separation, double most_s);

/// The plan with its stretches so much later.
void delay(Plan& plan, const Trace& trace, const Delays& delays);

}  // namespace swallowtail::coverage
