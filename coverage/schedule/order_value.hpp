#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "coverage/schedule/stops.hpp"

namespace swallowtail::coverage {

/// The end of an order's schedule with its best stops, the same that StopPlanner finds, kept up while the
/// order changes a little at a time: a change costs about as much as it has legs, plus what a battery reaches
/// on either side of it.
///
/// Docked with energy e at a site, the rest takes min over its corners of time_s + price · max(0, energy −
/// e), price being the seconds to charge one unit: flights, charging and carrying all lead from such a
/// function to another of its kind. These functions are kept for the sites after a change, and the labels
/// (time, energy) of StopPlanner for the sites before it; both only move in time far from a change.
class OrderValue {
 public:
  OrderValue(LinkCache& links, const StopParams& params, const ScheduleStart& start)
      : links_(&links), params_(params), start_(start) {}

  /// Takes an order; at least one leg.
  void set(std::vector<RouteLeg> legs);
  const std::vector<RouteLeg>& legs() const { return legs_; }
  /// Infinite when no schedule exists.
  double end_s() const { return end_s_; }
  /// Looked at so far, to tell how much work it was: the shorter the legs, the more of them hang on a change.
  std::uint64_t flights() const { return flights_; }

  /// The end if these legs stood in place of as many from `first` on; infinite when it is not below cutoff_s.
  double end_with(std::size_t first, std::span<const RouteLeg> legs, double cutoff_s);
  /// Puts them there.
  void replace(std::size_t first, std::span<const RouteLeg> legs);

 private:
  struct Cost {
    double time_s = 0.0;
    double energy = 0.0;
    Cost() = default;
    explicit Cost(const FlightCost& c) : time_s(c.time_s), energy(c.energy) {}
    Cost& operator+=(const Cost& other) {
      time_s += other.time_s;
      energy += other.energy;
      return *this;
    }
    friend Cost operator+(Cost a, const Cost& b) { return a += b; }
  };
  /// A leg, and the way from it to the next.
  struct Step {
    Cost cover;
    Cost lift_at_entry;  ///< ground at its own entry → entry
    Cost hop;
    Cost land_at_exit;
    Cost land_at_next;  ///< exit → ground at the next entry
    Cost lift_at_exit;  ///< ground at the exit → next entry
    Cost by_air;        ///< ground at the exit → ground at the next entry
    double drive_s = 0.0;
    Vec2 entry_m = Vec2::Zero();
    Vec2 exit_m = Vec2::Zero();
    bool same_site = false;
  };
  /// A corner of what is left, or a label.
  struct Point {
    double time_s;
    double energy;
  };
  struct Points {
    std::vector<Point> all;
    double least_time_s = std::numeric_limits<double>::infinity();
    double least_priced_s =
        std::numeric_limits<double>::infinity();  ///< time and the energy's price; of labels, less its price
  };
  /// From docked (or from the start) to docked (or to the end).
  struct Flight {
    double time_s = 0.0;    ///< charging left aside
    double needs = 0.0;     ///< energy on take-off
    double consumes = 0.0;  ///< until charging begins
  };
  struct Settling {
    double by_s = std::numeric_limits<double>::infinity();
    double reach = 0.0;
    bool is_first = true;
    bool settled(double moved_s, double energy, double most);
  };

  // Nodes as in StopPlanner: 0 the start, 2i + 1 the exit of leg i, 2i the entry of leg i > 0.
  std::size_t end_node() const { return 2 * legs_.size() - 1; }
  static std::size_t first_leg(std::size_t node) { return (node + 1) / 2; }
  static std::size_t last_leg(std::size_t node) { return (node - 1) / 2; }

  const Step& step(std::size_t leg) const;
  const Points& value(std::size_t node) const;
  Step make_step(const RouteLeg& leg) const;
  void link(Step& from, const RouteLeg& from_leg, Step& to, const RouteLeg& to_leg) const;
  void finish(Step& last, const RouteLeg& leg) const;
  Cost start_lift(const RouteLeg& first) const;
  Vec2 site(std::size_t node) const;
  Cost lift(std::size_t node) const;
  Cost landing(std::size_t node) const;
  double drive_s(const Vec2& from, const Vec2& to) const;
  double handling_s(std::size_t to) const;
  /// On take-off, for what is flown until the landing.
  double least_needs(const Cost& air) const {
    return params_.battery.reserve + air.energy * params_.energy_factor + params_.spare;
  }
  double most_flown() const { return params_.battery.capacity - params_.battery.reserve; }

  bool make_flight(std::size_t from, std::size_t to, const Cost& air, Flight& out) const;
  bool first_flight(std::size_t to, const Cost& air, Point& docked) const;
  template <class Take>
  void for_each_flight_from(std::size_t node, std::size_t least_to, const Take& take) const;
  template <class Take>
  void for_each_flight_to(std::size_t node, const Take& take) const;

  void add_corner(Points& to, double time_s, double energy) const;
  void add_label(Points& to, double time_s, double energy) const;
  void compute_value(std::size_t node, Points& out) const;
  void compute_labels(std::size_t node, Points& out) const;
  double rest(std::size_t node, double energy) const;
  double best_over(std::size_t border, double cutoff_s) const;
  double best_from_start(std::size_t border, double cutoff_s) const;
  void lay(std::size_t first, std::span<const RouteLeg> legs);
  void forget_change();
  static double moved_by(const Points& before, const Points& now);
  static void move(Points& points, double by_s);
  void refresh_values(std::size_t first, std::size_t past);
  void refresh_labels(std::size_t first, std::size_t past);
  bool is_docked() const { return start_.kind == StartKind::kDocked; }

  LinkCache* links_;
  StopParams params_;
  ScheduleStart start_;
  std::vector<RouteLeg> legs_;
  std::vector<Step> steps_;
  std::vector<Points> values_;  ///< by node; what is left after docking there
  std::vector<Points> labels_;  ///< by node; how one can have docked there
  Cost start_lift_;
  double end_s_ = std::numeric_limits<double>::infinity();

  // A change that is looked at: legs [changed_first_, changed_past_) have other steps, nodes from
  // 2·changed_first on other values.
  std::vector<Step> changed_;
  std::size_t changed_first_ = 0;
  std::size_t changed_past_ = 0;
  std::vector<Points> changed_values_;
  std::size_t changed_node_ = 0;
  std::size_t changed_node_past_ = 0;
  Cost changed_lift_;
  bool is_lift_changed_ = false;
  mutable std::vector<Cost> reach_;
  mutable std::uint64_t flights_ = 0;
  mutable Points scratch_;
};

}  // namespace swallowtail::coverage
