#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "coverage/schedule/improve.hpp"
#include "coverage/schedule/near_sites.hpp"
#include "coverage/schedule/order_value.hpp"

namespace swallowtail::coverage {

/// The descent to a local optimum within improve_order, step by step. An order with no schedule may turn into
/// one that has.
class Descent {
 public:
  Descent(std::span<const SubCell> cells, std::vector<Visit> visits, const ScheduleStart& start,
          LinkCache& links, const ImproveParams& params);

  /// Until nothing that was touched can be made better.
  void run();
  bool stopped() const {
    return params_.stop.reached(evaluations_, 0) || (value_ && value_->flights() >= params_.flights);
  }

  /// The visits from `first` on become these, better or not; what stands there is looked at again.
  void put(std::size_t first, std::span<const Visit> visits);
  /// Begins to note where visits change; changed(): the stretch that holds all changes since.
  void mark() { changed_first_ = changed_past_ = 0; }
  std::pair<std::size_t, std::size_t> changed() const { return {changed_first_, changed_past_}; }
  /// Nothing is waiting to be looked at any more.
  void forget_touched();

  const std::vector<Visit>& visits() const { return visits_; }
  double objective_s() const { return objective_s_; }
  std::uint64_t evaluations() const { return evaluations_; }

 private:
  bool improve_around(std::size_t cell);
  bool improve_ends(std::size_t cell);
  bool improve_exit(std::size_t cell, const NearSites::Near& near);
  bool improve_entry(std::size_t cell, const NearSites::Near& near);
  double turning_gain_s(std::size_t first, std::size_t last);
  bool try_reversal(std::size_t first, std::size_t last);
  enum class Turn : std::uint8_t { kNo, kYes };
  bool try_move(std::size_t first, std::size_t count, std::size_t to, Turn turn);
  bool try_chains_from(std::size_t first, std::size_t to, Turn turn);
  bool try_chains_to(std::size_t last, std::size_t to, Turn turn);
  bool is_worth_it(double gain_s, std::size_t length) const;
  bool accept(std::size_t first, double gain_s);

  double hop_s(const Visit* from, const Visit* to);
  double least_hop_s(const Visit* from, const Visit* to) const;
  const Visit* at(std::size_t i) const { return i < visits_.size() ? &visits_[i] : nullptr; }
  const Visit* before(std::size_t i) const { return i == 0 ? nullptr : &visits_[i - 1]; }
  void touch(std::size_t position);
  void write(std::size_t first, std::span<const Visit> visits);
  double flight_s(std::size_t first, std::size_t past);
  std::span<const RouteLeg> route(std::span<const Visit> visits);

  std::span<const SubCell> cells_;
  std::vector<Visit> visits_;
  const ScheduleStart& start_;
  LinkCache& links_;
  const ImproveParams& params_;
  std::optional<OrderValue> value_;                 ///< under kSchedule
  std::vector<std::vector<NearSites::Near>> near_;  ///< by site
  std::vector<std::size_t> position_;               ///< by sub-cell
  std::deque<std::size_t> touched_;
  std::vector<char> is_touched_;
  std::vector<Visit> candidate_;
  std::vector<RouteLeg> route_;
  double objective_s_ = 0.0;
  double tolerance_s_ = 0.0;
  std::uint64_t evaluations_ = 0;
  std::size_t changed_first_ = 0;
  std::size_t changed_past_ = 0;
};

}  // namespace swallowtail::coverage
