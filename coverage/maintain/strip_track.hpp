#pragma once

#include <optional>
#include <vector>

#include "coverage/schedule/plan.hpp"

namespace swallowtail::coverage {

struct TrackParams {
  double lateral_m = 0.5;  ///< from the centre line, that still counts as flown
  double height_m = 2.0;   ///< above or below the leg's altitude
  double gap_m = 0.5;      ///< shorter gaps are none
  double speed_mps = 8.0;  ///< cruise
};

/// A stretch of a leg that was not flown, in metres from its entry.
struct Gap {
  double from_m = 0.0;
  double to_m = 0.0;
};

/// Follows what of one leg was really flown, from its entry towards its exit, from positions. Two positions
/// on the line with nothing off it between them are taken as joined, unless the aircraft covers at neither:
/// over what it goes round it may fly on the line and not look down. How finely the ends are known depends
/// on how often positions come.
class StripTrack {
 public:
  StripTrack(const Leg& leg, const TrackParams& params)
      : entry_m_(leg.entry_m), exit_m_(leg.exit_m), params_(params) {}

  void add(double time_s, const Vec3& position_m, bool covering = true);
  /// Nothing of it was flown, for certain.
  void miss() { samples_ = kWatched; }
  /// The leg now ends here, on its line.
  void end_at(const Vec3& exit_m) { exit_m_ = exit_m; }
  bool on_line(const Vec3& position_m) const;
  /// How far along the leg a position is, 0 … length.
  double along_m(const Vec3& position_m) const;
  double length_m() const { return (exit_m_ - entry_m_).norm(); }
  bool seen() const { return seen_; }

  /// What is missing once the leg is said to be flown. When no position was on its line, all of it, unless
  /// positions came so seldom that none had to be: then it is believed.
  std::vector<Gap> gaps() const;
  /// How much from the entry on is flown without a gap; 0 when it was not begun at the entry.
  double flown_from_entry_m() const;

 private:
  static constexpr int kWatched = 3;  ///< so many positions at least tell that a leg was not flown
  struct Sample {
    double time_s;
    double along_m;
    bool on_line;
    bool covering;
  };
  std::vector<Gap> merged() const;

  Vec3 entry_m_;
  Vec3 exit_m_;
  TrackParams params_;
  std::optional<Sample> last_;
  double longest_step_m_ = 0.0;
  double largest_move_m_ = 0.0;  ///< along the leg between two positions, on the line or off
  int samples_ = 0;
  bool seen_ = false;
  std::vector<Gap> flown_;
};

}  // namespace swallowtail::coverage
