#pragma once

#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "tools/cli/cover_answer.hpp"

namespace swallowtail::cli {

/// The flight from the start on the ground to the first leg, ends included; nothing without legs.
std::vector<Vec3> approach_of(const Covered& one);
/// The transfer after a leg, ends included.
std::vector<Vec3> transfer_after(const coverage::Plan& plan, std::size_t leg);

/// The legs of answer_of's document, one a line.
std::string cover_csv(const nlohmann::ordered_json& json);

/// Placemarks of fields, no-fly areas, legs with their transfers, and rendezvous; heights absolute. Tasks
/// without an origin (local metres) are left out: KML knows degrees only.
std::string cover_kml(const std::vector<Covered>& done);

/// A QGroundControl plan file [QGC-PLAN] (fileType Plan, version 1, mission version 2): take-off, waypoints
/// of legs and transfers, at each rendezvous a landing, a delay for docking and charging and another
/// take-off, and the last landing; heights relative to the home position; holes and no-fly areas as exclusion
/// fences. An autopilot that ends a mission at its first landing flies the first sortie only. Errors: more
/// than one task, no plan, a task in local metres.
Result<std::string> cover_qgc_plan(const std::vector<Covered>& done);

/// A picture of each task (at most kMaxPictures, the rest named): fields, no-fly areas, strips coloured by
/// height and numbered in order, transfers by type, rendezvous, and energy along time below.
std::string cover_svg(const CoverJob& job, const std::vector<Covered>& done);
inline constexpr std::size_t kMaxPictures = 24;

}  // namespace swallowtail::cli
