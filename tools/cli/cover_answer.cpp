#include "tools/cli/cover_answer.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include <fmt/core.h>

#include "planner/base/checks.hpp"
#include "tools/cli/cover_files.hpp"
#include "tools/cli/geojson.hpp"
#include "tools/cli/plan_file.hpp"
#include "tools/drawing/png.hpp"

namespace swallowtail::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Sums over all tasks.
struct Totals {
  double alone_s = 0.0;
  double cost = 0.0;
  double makespan_s = 0.0;
  double flight_m = 0.0;
  double wait_s = 0.0;
  double area_m2 = 0.0;
  double covered_m2 = 0.0;
  double energy_min = std::numeric_limits<double>::infinity();
  int recharges = 0;
  long long vertices = 0;
  std::size_t edges = 0;
  std::size_t legs = 0;
  double full_graph_gap_percent = -1.0;
};

Totals totals_of(const std::vector<Covered>& done) {
  Totals out;
  double before_s = 0.0;  // of the tasks before; the aircraft of one fly at once
  double before_cost = 0.0;
  for (const Covered& one : done) {
    if (!one.plan) continue;
    const coverage::Plan& plan = *one.plan;
    if (one.aircraft <= 1) {
      before_s = out.makespan_s;
      before_cost = out.cost;
      out.area_m2 += plan.area_m2;
      out.covered_m2 += plan.area_m2 * plan.covered_percent / 100.0;
      out.vertices += plan.statistics.vertices;
      out.edges += plan.statistics.edges;
      out.alone_s += one.alone_s;
    }
    out.cost = std::max(out.cost, before_cost + plan.cost);
    out.makespan_s = std::max(out.makespan_s, before_s + plan.makespan_s);
    out.flight_m += plan.flight_m;
    out.wait_s += plan.wait_s;
    if (!plan.legs.empty()) out.energy_min = std::min(out.energy_min, plan.energy_min);
    out.recharges += plan.recharges;
    out.legs += plan.legs.size();
    out.full_graph_gap_percent = std::max(out.full_graph_gap_percent, plan.statistics.full_graph_gap_percent);
  }
  return out;
}

const char* name_of(coverage::FieldStatus status) {
  constexpr std::array kNames = {"planned", "partly covered", "refused"};
  return kNames[static_cast<std::size_t>(status)];
}

/// Where to find the field: its first corner that is a place.
Json place_json(const coverage::Task& task, std::uint32_t id) {
  for (const auto& field : task.fields) {
    if (field.id != id) continue;
    for (const Vec2& corner : field.polygon.outline) {
      if (!is_finite(corner)) continue;
      Json out = {{"x_m", corner.x()}, {"y_m", corner.y()}};
      const auto degrees =
          task.origin ? planner::to_geodetic(*task.origin, corner) : Result<Vec2>(bad_input("local"));
      if (degrees) out["lat_deg"] = degrees->x();
      if (degrees) out["lon_deg"] = degrees->y();
      return out;
    }
  }
  return nullptr;
}

Json field_json(const coverage::FieldReport& field, const coverage::Task& task) {
  return {{"id", field.name},
          {"number", field.id},
          {"status", name_of(field.status)},
          {"reason", field.reason},
          {"place", place_json(task, field.id)},
          {"area_m2", field.area_m2},
          {"covered_m2", field.covered_m2},
          {"uncovered_m2", std::max(0.0, field.area_m2 - field.covered_m2)},
          {"outside_m2", field.outside_m2},
          {"cells", field.cells},
          {"sub_cells", field.sub_cells},
          {"sweep_deg", field.sweep_rad * 180.0 / std::numbers::pi},
          {"wall_ms", field.wall_ms}};
}

/// Fields of a task without a plan: all are refused, for their own reason or the task's.
Json unplanned_json(const Covered& one, std::size_t at) {
  const coverage::Field& field = one.task->fields[at];
  coverage::FieldReport report;
  report.id = field.id;
  report.name = field.name;
  report.area_m2 = coverage::area_m2(field.polygon);
  if (at < one.fields.size()) report.reason = one.fields[at].reason;
  if (report.reason.empty()) report.reason = one.reason;
  return field_json(report, *one.task);
}

Json places_json(const std::vector<Vec3>& places) {
  Json out = Json::array();
  for (const Vec3& place : places) out.push_back(to_json(place));
  return out;
}

/// Of the task's local frame; null: metres of no place on Earth.
Json origin_json(const coverage::Task& task) {
  if (!task.origin) return nullptr;
  return {{"lat_deg", task.origin->lat_deg},
          {"lon_deg", task.origin->lon_deg},
          {"elevation_m", task.origin->elevation_m}};
}

/// Whose something is.
struct Part {
  std::size_t task = 0;
  int aircraft = 0;
  Json json() const {
    Json out = {{"task", task}};
    if (aircraft > 0) out["aircraft"] = aircraft;
    return out;
  }
};

/// Of each entry of `done`: aircraft of one task follow each other.
std::vector<Part> parts_of(const std::vector<Covered>& done) {
  std::vector<Part> out;
  std::size_t task = 0;
  for (const Covered& one : done) {
    if (one.aircraft <= 1 && !out.empty()) ++task;
    out.push_back({task, one.aircraft});
  }
  return out;
}

Json aircraft_json(const Covered& one, const Part& part) {
  Json out = part.json();
  out.update(Json({{"vehicle", one.task->vehicle_id}, {"charger", one.task->charger.id}}));
  out["start_m"] = to_json(one.task->start_m);
  out["charger_start_m"] = to_json(one.task->charger.start_m);
  out["take_off_s"] = one.plan->take_off_s;
  out["makespan_s"] = one.plan->makespan_s;
  out["delay_s"] = one.delay_s;
  out["sub_cells"] = one.plan->sub_cells.size();
  out["flight_m"] = one.plan->flight_m;
  out["recharges"] = one.plan->recharges;
  if (one.plan->robot_home_s > 0.0) out["robot_home_s"] = one.plan->robot_home_s;
  return out;
}

Json leg_json(const coverage::Leg& leg, const Part& part) {
  Json out = part.json();
  out.update(Json({{"field", leg.field_id},
                   {"sub_cell", leg.sub_cell_id},
                   {"kind", leg.kind == coverage::LegKind::kCover ? "cover" : "reposition"},
                   {"from_m", to_json(leg.entry_m)},
                   {"to_m", to_json(leg.exit_m)},
                   {"height_m", leg.height_m},
                   {"width_m", leg.width_m},
                   {"transfer", coverage::name_of(leg.transfer)},
                   {"transfer_m", places_json(leg.transfer_m)},
                   {"energy_before", leg.energy_before},
                   {"energy_after", leg.energy_after},
                   {"start_s", leg.start_s},
                   {"end_s", leg.end_s}}));
  return out;
}

Json rendezvous_json(const coverage::Rendezvous& meeting, const Part& part) {
  Json out = part.json();
  out.update(Json({{"id", meeting.id},
                   {"site_m", to_json(meeting.site_m)},
                   {"arrive_s", meeting.robot_arrives_s},
                   {"land_s", meeting.land_s},
                   {"depart_s", meeting.depart_s},
                   {"charge", meeting.charge_to - meeting.energy_from},
                   {"charge_to", meeting.charge_to},
                   {"wait_s", meeting.wait_s},
                   {"carry", meeting.carry}}));
  if (!meeting.robot_bends_m.empty()) out["robot_bends_m"] = places_json(meeting.robot_bends_m);
  if (meeting.carry) out["carry_to_m"] = to_json(meeting.carry_to_m);
  return out;
}

/// Of the task's fields.
void add_reports(const Covered& one, Json& out) {
  for (const auto& field : one.plan->fields) {
    out["fields"].push_back(field_json(field, *one.task));
    if (out["reason"] == "" && field.status != coverage::FieldStatus::kPlanned) out["reason"] = field.reason;
  }
  for (const std::string& note : one.plan->notes) out["notes"].push_back(note);
}

Json document(const CoverJob& job, const std::vector<Covered>& done, CoverStatus status, double wall_s) {
  const Totals totals = totals_of(done);
  Json out;
  out["scenario"] = job.name;
  out["status"] = name(status);
  out["reason"] = "";
  const std::vector<Part> parts = parts_of(done);
  out["tasks"] = done.empty() ? 0 : parts.back().task + 1;
  out["origins"] = Json::array();
  out["approaches_m"] = Json::array();
  out["fields"] = Json::array();
  out["notes"] = Json::array();
  Json legs = Json::array();
  Json meetings = Json::array();
  Json aircraft = Json::array();
  for (std::size_t at = 0; at < done.size(); ++at) {
    const Covered& one = done[at];
    if (one.aircraft <= 1) out["origins"].push_back(origin_json(*one.task));
    if (!one.plan) {
      if (out["reason"] == "") out["reason"] = one.reason;
      for (std::size_t field = 0; field < one.task->fields.size(); ++field)
        out["fields"].push_back(unplanned_json(one, field));
      continue;
    }
    if (one.aircraft <= 1) add_reports(one, out);
    if (one.aircraft > 0) aircraft.push_back(aircraft_json(one, parts[at]));
    for (const auto& leg : one.plan->legs) legs.push_back(leg_json(leg, parts[at]));
    const std::size_t first = meetings.size();
    for (const auto& meeting : one.plan->rendezvous) meetings.push_back(rendezvous_json(meeting, parts[at]));
    for (const auto& visit : one.plan->depot_visits)
      meetings[first + visit.before]["from_depot_s"] = {visit.arrives_s, visit.leaves_s};
    out["approaches_m"].push_back(places_json(approach_of(one)));
  }
  const bool has_plan = totals.legs > 0;
  out["covered_percent"] = totals.area_m2 > 0.0 ? 100.0 * totals.covered_m2 / totals.area_m2 : 0.0;
  out["cost"] = has_plan ? Json(totals.cost) : Json(nullptr);
  out["makespan_s"] = totals.makespan_s;
  if (!aircraft.empty()) {
    out["alone_s"] = totals.alone_s;
    out["gain_percent"] = 100.0 * (1.0 - totals.makespan_s / totals.alone_s);
    out["aircraft"] = std::move(aircraft);
  }
  out["flight_m"] = totals.flight_m;
  out["recharges"] = totals.recharges;
  out["wait_s"] = totals.wait_s;
  out["vertices"] = totals.vertices;
  out["edges"] = totals.edges;
  out["full_graph_gap_percent"] =
      totals.full_graph_gap_percent < 0.0 ? Json(nullptr) : Json(totals.full_graph_gap_percent);
  out["legs"] = std::move(legs);
  out["rendezvous"] = std::move(meetings);
  out["energy_min"] = has_plan ? Json(totals.energy_min) : Json(nullptr);
  out["wall_s"] = wall_s;
  return out;
}

std::string aircraft_table(const Json& json) {
  std::string out;
  for (const Json& one : json["aircraft"]) {
    out += fmt::format(
        "  aircraft {:<3}{:.1f} s, {} sub-cells, {:.1f} m, {} recharges, {:.1f} s waiting for the others\n",
        one["aircraft"].get<int>(), one["makespan_s"].get<double>(), one["sub_cells"].get<std::size_t>(),
        one["flight_m"].get<double>(), one["recharges"].get<int>(), one["delay_s"].get<double>());
  }
  return out + fmt::format("  alone       {:.1f} s with one aircraft: {:.1f} % less\n",
                           json["alone_s"].get<double>(), json["gain_percent"].get<double>());
}

std::string table_of(const CoverJob& job, const Json& json) {
  std::string out = fmt::format("{}: {}\n", job.name, json["status"].get<std::string>());
  out += fmt::format("  {:<22}{:<9}{:>12}{:>10}{:>9}{:>7}{:>10}{:>9}\n", "field", "status", "area m2",
                     "covered %", "beyond %", "cells", "sub-cells", "sweep °");
  for (const Json& field : json["fields"]) {
    const double area = std::max(field["area_m2"].get<double>(), 1e-9);
    out += fmt::format("  {:<22}{:<9}{:>12.1f}{:>10.2f}{:>9.2f}{:>7}{:>10}{:>9.1f}\n",
                       field["id"].get<std::string>(), field["status"].get<std::string>(), area,
                       100.0 * field["covered_m2"].get<double>() / area,
                       100.0 * field["outside_m2"].get<double>() / area, field["cells"].get<int>(),
                       field["sub_cells"].get<int>(), field["sweep_deg"].get<double>());
    if (field["reason"] != "") out += fmt::format("    {}\n", field["reason"].get<std::string>());
  }
  for (const Json& note : json["notes"]) out += fmt::format("  note        {}\n", note.get<std::string>());
  if (json["legs"].empty()) return out;
  out += fmt::format(
      "  covered     {:.3f} % of the planned fields\n  makespan    {:.1f} s, {} recharges, {:.1f} s waiting "
      "for the robot\n  flight      {:.1f} m in {} legs\n",
      json["covered_percent"].get<double>(), json["makespan_s"].get<double>(), json["recharges"].get<int>(),
      json["wait_s"].get<double>(), json["flight_m"].get<double>(), json["legs"].size());
  if (json.contains("aircraft")) out += aircraft_table(json);
  out += fmt::format(
      "  energy      {:.2f} left at the lowest landing\n  graph       {} vertices, {} edges\n  time        "
      "{:.2f} s\n",
      json["energy_min"].get<double>(), json["vertices"].get<long long>(), json["edges"].get<std::size_t>(),
      json["wall_s"].get<double>());
  return out;
}

/// Written only where all tasks share one frame, or each its own origin: features of tasks in local metres
/// would lie upon each other.
std::string plan_geojson(const std::vector<Covered>& done) {
  Json features = Json::array();
  const std::vector<Part> parts = parts_of(done);
  for (std::size_t at = 0; at < done.size(); ++at) {
    if (!done[at].plan) continue;
    const Part& part = parts[at];
    GeoJsonWriter writer(done[at].task->origin);
    for (const auto& leg : done[at].plan->legs) {
      Json properties = leg_json(leg, part);
      properties.erase("from_m");
      properties.erase("to_m");
      properties.erase("transfer_m");
      writer.add_line({leg.entry_m, leg.exit_m}, std::move(properties));
    }
    const auto& legs = done[at].plan->legs;
    if (!legs.empty()) {
      Json properties = part.json();
      properties["kind"] = "approach";
      writer.add_line(approach_of(done[at]), std::move(properties));
    }
    for (std::size_t i = 0; i + 1 < legs.size(); ++i) {
      Json properties = part.json();
      properties["kind"] = "transfer";
      properties["after_leg"] = i;
      properties["transfer"] = coverage::name_of(legs[i].transfer);
      writer.add_line(transfer_after(*done[at].plan, i), std::move(properties));
    }
    for (const auto& meeting : done[at].plan->rendezvous) {
      Json properties = rendezvous_json(meeting, part);
      properties["kind"] = "rendezvous";
      properties.erase("site_m");
      properties.erase("carry_to_m");
      writer.add_point(meeting.site_m, std::move(properties));
    }
    const Json written = Json::parse(writer.text());
    for (const Json& feature : written["features"]) features.push_back(feature);
  }
  return Json({{"type", "FeatureCollection"}, {"features", features}}).dump(1) + "\n";
}

}  // namespace

const char* name(CoverStatus status) {
  switch (status) {
    case CoverStatus::kCertified:
      return "certified";
    case CoverStatus::kPartial:
      return "partial";
    case CoverStatus::kInfeasible:
      return "infeasible";
    case CoverStatus::kInterrupted:
      return "interrupted";
  }
  return "unknown";
}

CoverStatus status_of(const std::vector<Covered>& done) {
  const auto has_plan = [](const Covered& one) { return one.plan.has_value(); };
  const auto is_complete = [](const Covered& one) {
    return one.plan && one.plan->status == coverage::PlanStatus::kComplete;
  };
  if (std::ranges::all_of(done, is_complete)) return CoverStatus::kCertified;
  return std::ranges::any_of(done, has_plan) ? CoverStatus::kPartial : CoverStatus::kInfeasible;
}

Answer answer_of(const CoverJob& job, const std::vector<Covered>& done, CoverStatus status, double wall_s) {
  Answer answer;
  answer.json = document(job, done, status, wall_s);
  answer.table = table_of(job, answer.json);
  answer.files[".csv"] = [json = answer.json] { return cover_csv(json); };
  answer.files[".geojson"] = [&done] { return plan_geojson(done); };
  answer.files[".kml"] = [&done] { return cover_kml(done); };
  answer.files[".svg"] = [&job, &done] { return cover_svg(job, done); };
  answer.writers[".png"] = [&job, &done](const std::string& path) {
    return drawing::write_png(cover_svg(job, done), path);
  };
  answer.files[".plan"] = [&done] {
    const Result<std::string> plan = cover_qgc_plan(done);
    return plan ? *plan : std::string();
  };
  for (const Covered& one : done) {
    if (one.aircraft == 0) continue;
    answer.series[".plan"].push_back([&one] {
      const Result<std::string> plan = cover_qgc_plan({one});
      return plan ? *plan : std::string();
    });
  }
  return answer;
}

}  // namespace swallowtail::cli
