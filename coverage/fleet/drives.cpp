#include "coverage/fleet/drives.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::coverage {
namespace {

constexpr double kSamePlace_m = 1e-9;
/// The ground under a piece is this near to a straight line.
constexpr double kLevel_m = 0.2;
constexpr double kShortest_m = 2.0;

double level_m(const Vec3& a, const Vec3& b) { return (b - a).head<2>().norm(); }

bool is_even(const FlightModel& model, const Vec3& from, const Vec3& to) {
  for (const double share : {0.25, 0.5, 0.75}) {
    const Vec3 at = from + (to - from) * share;
    if (std::abs(model.ground(at).z() - at.z()) > kLevel_m) return false;
  }
  return true;
}

void add(const FlightModel& model, const TimedPiece& piece, std::vector<TimedPiece>& out) {
  if (level_m(piece.from_m, piece.to_m) < kShortest_m || is_even(model, piece.from_m, piece.to_m)) {
    out.push_back(piece);
    return;
  }
  TimedPiece half = piece;
  half.to_m = model.ground((piece.from_m + piece.to_m) / 2.0);
  half.end_s = (piece.start_s + piece.end_s) / 2.0;
  add(model, half, out);
  add(model, {half.to_m, piece.to_m, half.end_s, piece.end_s, true}, out);
}

/// Seconds for each piece of a way.
std::vector<double> times_of(const Charger& charger, const std::vector<Vec3>& way) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) out.push_back(level_m(way[i], way[i + 1]));
  const auto spread = [](auto first, auto last, double time_s) {
    double length = 0.0;
    for (auto at = first; at != last; ++at) length += *at;
    for (auto at = first; at != last; ++at) *at = length > 0.0 ? *at * time_s / length : 0.0;
  };
  if (!charger.travel) {
    for (double& length : out) length /= charger.speed_mps;
    return out;
  }
  const double all_s = drive_s(charger, way.front(), way.back());
  if (out.size() < 3) {
    spread(out.begin(), out.end(), all_s);
    return out;
  }
  const double first_s = std::min(all_s, drive_s(charger, way[0], way[1]));
  const double last_s = std::min(all_s - first_s, drive_s(charger, way[way.size() - 2], way.back()));
  out.front() = first_s;
  out.back() = last_s;
  spread(out.begin() + 1, out.end() - 1, std::max(0.0, all_s - first_s - last_s));
  return out;
}

}  // namespace

std::vector<TimedPiece> drive_of(const Charger& charger, const FlightModel& model, const Vec3& from_m,
                                 std::span<const Vec3> bends_m, const Vec3& to_m, double start_s) {
  std::vector<Vec3> way{model.ground(from_m)};
  for (const Vec3& bend : bends_m) way.push_back(model.ground(bend));
  way.push_back(model.ground(to_m));
  const std::vector<double> times_s = times_of(charger, way);
  std::vector<TimedPiece> out;
  double time_s = start_s;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    if (level_m(way[i], way[i + 1]) > kSamePlace_m)
      add(model, {way[i], way[i + 1], time_s, time_s + times_s[i], true}, out);
    time_s += times_s[i];
  }
  return out;
}

}  // namespace swallowtail::coverage
