#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "coverage/maintain/plan_keeper.hpp"
#include "coverage/schedule/improve.hpp"

/// How PlanKeeper takes up changed fields, and another aircraft, while a mission is under way.
namespace swallowtail::coverage {
namespace {

constexpr double kAtStart_m = 1.5;               ///< that counts as the task's start
constexpr double kStation_m = 1.0;               ///< between places of a strip that are looked at
constexpr double kOverlap_m = 0.5;               ///< that a piece reaches into what is flown
constexpr double kSwathEdge_m = 0.1;             ///< that a swath may be narrower by
constexpr std::array kAcross{-0.48, 0.0, 0.48};  ///< of the width: where a station is looked at

/// Whether a flight along the leg has seen a place that is to be seen from this altitude.
bool has_seen(const Leg& leg, const Vec3& place_m, double height_tolerance_m) {
  const Vec2 way = (leg.exit_m - leg.entry_m).head<2>();
  const double length = way.norm();
  if (leg.kind != LegKind::kCover || length < 1e-9) return false;
  const Vec2 off = (place_m - leg.entry_m).head<2>();
  const double along = off.dot(way) / length;
  const double across = std::abs(off.x() * way.y() - off.y() * way.x()) / length;
  if (along < 0.0 || along > length || across > 0.5 * leg.width_m + kSwathEdge_m) return false;
  const double altitude = leg.entry_m.z() + (leg.exit_m.z() - leg.entry_m.z()) * along / length;
  return std::abs(altitude - place_m.z()) <= height_tolerance_m;
}

}  // namespace

/// The stretches of a new sub-cell that no flown leg has seen at full width.
std::vector<Leg> PlanKeeper::unseen_parts(const SubCell& cell, const std::vector<Leg>& flown) {
  const double length = cell.length_m();
  if (length < 1e-9) return {};
  const Vec3 along = (cell.beta_m - cell.alpha_m) / length;
  const Vec3 across = Vec3(-along.y(), along.x(), 0.0) * cell.width_m;
  const int stations = std::max(1, static_cast<int>(std::ceil(length / kStation_m)));
  const double step = length / stations;
  const auto seen = [&](int station) {
    const Vec3 middle = cell.alpha_m + along * ((station + 0.5) * step);
    return std::all_of(kAcross.begin(), kAcross.end(), [&](double share) {
      return std::any_of(flown.begin(), flown.end(), [&](const Leg& leg) {
        return has_seen(leg, middle + share * across, task_.height_tolerance_m);
      });
    });
  };
  std::vector<Leg> out;
  for (int i = 0; i < stations; ++i) {
    if (seen(i)) continue;
    const int first = i;
    while (i + 1 < stations && !seen(i + 1)) ++i;
    Leg piece;
    piece.sub_cell_id = next_id_++;
    piece.field_id = cell.field_id;
    piece.height_m = cell.height_m;
    piece.width_m = cell.width_m;
    piece.entry_m = cell.alpha_m + along * std::max(0.0, first * step - kOverlap_m);
    piece.exit_m = cell.alpha_m + along * std::min(length, (i + 1) * step + kOverlap_m);
    piece.transfer = Transfer::kFF;
    out.push_back(piece);
  }
  return out;
}

/// What is flown: legs done, and those begun before a change can reach the aircraft; of the leg that was
/// broken off its beginning.
std::vector<Leg> PlanKeeper::flown_legs(std::size_t committed) const {
  const std::size_t past = std::min(plan_.legs.size(), plan_.legs_done + committed);
  std::vector<Leg> out(plan_.legs.begin(), plan_.legs.begin() + static_cast<std::ptrdiff_t>(past));
  if (committed == 0 && track_ && tracked_leg_ == plan_.legs_done && plan_.legs_done < plan_.legs.size()) {
    Leg begun = plan_.legs[plan_.legs_done];
    const double length = track_->length_m();
    if (length > 1e-9) {
      begun.exit_m = begun.entry_m + (begun.exit_m - begun.entry_m) * (track_->flown_from_entry_m() / length);
      out.push_back(begun);
    }
  }
  out.insert(out.end(), retired_.begin(), retired_.end());
  return out;
}

/// It counts its legs from where it begins: the plan becomes what those before it left.
bool PlanKeeper::replace_aircraft(const AircraftView& vehicle) {
  const std::string flown = std::to_string(plan_.legs_done);
  retired_ = flown_legs(0);
  vehicle_.reset();  // nobody covers the leg under way
  gaps_ = unflown_legs();
  plan_.legs.clear();
  plan_.approach_m.clear();
  plan_.rendezvous.clear();
  later_.clear();
  track_.reset();
  battery_.reset();
  consumption_ = {};
  path_.clear();
  task_.battery.capacity = capacity_as_asked_;
  lands_at_once_ = false;
  detour_energy_ = 0.0;
  told_no_plan_ = false;
  told_overdue_.clear();
  told_short_ = false;
  solved_slack_.reset();
  retry_s_ = vehicle.time_s;
  return begin_anew(vehicle, "another aircraft goes on after " + flown + " legs flown");
}

void PlanKeeper::start_over_after(const AircraftView& vehicle) {
  shift_times(plan_, 0, vehicle.time_s);
  begin_anew(vehicle, "made anew in the middle of the mission");
}

/// Legs that this aircraft has flown, which are not known, stand in front as points.
bool PlanKeeper::begin_anew(const AircraftView& vehicle, const std::string& reason) {
  Leg point = point_leg(vehicle.position_m);
  point.transfer = Transfer::kFF;
  std::vector<Leg> prefix(vehicle.legs_done, point);
  if (!prefix.empty()) prefix.back().transfer_m = std::exchange(plan_.approach_m, {});
  plan_.legs.insert(plan_.legs.begin(), prefix.begin(), prefix.end());
  for (Rendezvous& meeting : plan_.rendezvous) meeting.id += entry_id(vehicle.legs_done);
  plan_.legs_done = vehicle.legs_done;
  vehicle_ = vehicle;
  landed_since_s_ = vehicle.time_s;
  // At the start it takes off by itself, elsewhere from the robot only.
  const bool at_start = (vehicle.position_m - task_.start_m).head<2>().norm() < kAtStart_m;
  has_flown_ = vehicle.legs_done > 0 || !vehicle.on_ground() || !at_start;
  const bool solved = vehicle.on_ground() ? solve_on_ground(reason) : solve_in_flight(reason);
  if (!solved && !(vehicle.on_ground() && tell_no_plan())) note_revision(reason);
  return true;
}

Status PlanKeeper::change_task(Task task) {
  if (const Status good = validate(task); !good) return good;
  if (task.vehicle_id != task_.vehicle_id || task.charger.id != task_.charger.id) {
    return bad_input("Task revision " + std::to_string(task.revision) +
                     " names another aircraft or robot while a mission is under way: only its fields may "
                     "change. Send it as a new task.");
  }
  task.battery.capacity = std::min(task.battery.capacity, task_.battery.capacity);
  FieldsCut cut = cut_fields(task, terrain_, params_.planning);
  if (cut.sub_cells.empty())
    return infeasible("No changed field can be planned. " + cut.reports.front().reason);
  PlanKeeper changed = *this;
  changed.task_ = std::move(task);
  changed.ways_ = std::make_shared<const Ways>(ways_of(changed.task_, cut.polygons));
  changed.fields_ = std::move(cut.reports);
  if (const Status taken = changed.take_cells(cut.sub_cells); !taken) return taken;
  *this = std::move(changed);
  return {};
}

Status PlanKeeper::take_cells(const std::vector<SubCell>& cells) {
  const std::string reason = "the fields were changed (task revision " + std::to_string(task_.revision) + ")";
  const std::size_t committed = this->committed().legs;
  const std::vector<Leg> flown = flown_legs(committed);
  plan_.legs.resize(std::min(plan_.legs.size(), plan_.legs_done + committed));
  if (committed == 0) track_.reset();
  gaps_.clear();
  const Vec3 from = vehicle_ ? vehicle_->position_m : task_.start_m;
  for (const Visit& visit : boustrophedon_order(cells, from)) {
    std::vector<Leg> parts = unseen_parts(cells[visit.sub_cell], flown);
    plan_.legs.insert(plan_.legs.end(), parts.begin(), parts.end());
  }
  plan_.area_m2 = 0.0;
  for (const FieldReport& field : fields_) plan_.area_m2 += field.area_m2;
  plan_.lacks = lacking_field(fields_);
  const bool aloft = vehicle_ && !vehicle_->on_ground();
  if (aloft && plan_.legs.size() == plan_.legs_done) plan_.legs.push_back(point_leg(point_ahead()));
  if (plan_.legs.size() == plan_.legs_done) {
    plan_.rendezvous.clear();
    note_revision(reason + ": all of them is flown");
    return {};
  }
  const bool docked = vehicle_ && vehicle_->mode == AircraftMode::kDocked && !plan_.rendezvous.empty();
  const bool solved =
      aloft ? solve_in_flight(reason) : vehicle_ && (docked ? solve_docked(reason) : solve_on_ground(reason));
  if (!solved) {
    return infeasible(
        "The changed fields cannot be flown from where the aircraft is with the reserve kept: "
        "the plan before stays.");
  }
  return {};
}

}  // namespace swallowtail::coverage
