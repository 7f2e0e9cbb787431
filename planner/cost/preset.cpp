#include "planner/cost/preset.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "planner/base/checks.hpp"
#include "planner/cost/altitude_band.hpp"
#include "planner/cost/clearance.hpp"
#include "planner/cost/collision.hpp"
#include "planner/cost/concealment.hpp"
#include "planner/cost/contact.hpp"
#include "planner/cost/length.hpp"
#include "planner/cost/nmopso_cost.hpp"
#include "planner/cost/range_penalty.hpp"
#include "planner/cost/smoothness.hpp"
#include "planner/cost/spso_cost.hpp"
#include "planner/cost/threat.hpp"
#include "planner/cost/violation.hpp"

namespace swallowtail::planner {
namespace {

using Scene = std::shared_ptr<const CostScene>;
using Made = std::unique_ptr<const Objective>;

constexpr std::array kObjectives{"length",     "energy",      "range",  "clearance", "altitude",
                                 "smoothness", "concealment", "threat", "violation", "contact",
                                 "collision",  "F1",          "F2",     "F3",        "F4"};

/// Stands for a weight that depends on the scene.
constexpr double kHard = -1.0;
constexpr double kStep = -2.0;

struct Entry {
  const char* name;
  EncodingKind encoding;
  std::vector<std::pair<const char*, double>> weights;
};

const std::vector<Entry>& table() {
  static const std::vector<Entry> kTable = {
      {"default", EncodingKind::kFrame, {{"length", 1.0}, {"violation", 10.0}}},
      {"BOA", EncodingKind::kBox, {{"length", 1.0}, {"collision", kStep}, {"range", 3.0}}},
      {"PSO", EncodingKind::kBox, {{"length", 1.0}, {"contact", kHard}}},
      {"IBABC",
       EncodingKind::kPlanes,
       {{"length", 0.25}, {"smoothness", 0.25}, {"concealment", 0.25}, {"threat", 0.25}, {"contact", kHard}}},
      {"NMOPSO",
       EncodingKind::kFrame,
       {{"F1", 1.0}, {"F2", 1.0}, {"F3", 1.0}, {"F4", 1.0}, {"contact", kHard}}},
      {"SPSO",
       EncodingKind::kAboveGround,
       {{"length", 5.0}, {"threat", 1.0}, {"altitude", 10.0}, {"smoothness", 1.0}}},
  };
  return kTable;
}

bool same_letters(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

template <class Names>
std::string listed(const Names& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

double hard_weight(const CostScene& scene, int waypoints, double unit_m) {
  const Bounds& bounds = scene.world->bounds();
  const double reach_m = std::min((bounds.max_m - bounds.min_m).norm(), 6.0 * scene.distance_m);
  return (waypoints + 1) * reach_m / unit_m;
}

Made make_objective(const std::string& name, const std::string& preset, const CostSpec& spec,
                    const Scene& scene) {
  const bool metres = preset == "BOA" || preset == "PSO" || preset == "SPSO";
  if (preset == "SPSO") {
    if (name == "threat") return std::make_unique<SpsoThreat>(scene);
    if (name == "altitude")
      return std::make_unique<SpsoAltitude>(scene, 0.5 * (spec.altitude.min_m + spec.altitude.max_m));
    if (name == "smoothness") return std::make_unique<SpsoSmoothness>();
  }
  if (name == "length") return std::make_unique<Length>(metres ? 1.0 : scene->distance_m);
  if (name == "energy") return std::make_unique<Energy>(spec.energy, scene->limits);
  if (name == "range") return std::make_unique<RangePenalty>(spec.operating_range_m);
  if (name == "clearance") return std::make_unique<ClearanceShortfall>(scene, spec.danger_distance_m);
  if (name == "altitude" || name == "F3")
    return std::make_unique<AltitudeBand>(scene, name == "F3" ? "F3" : "altitude", spec.altitude.min_m,
                                          spec.altitude.max_m);
  if (name == "smoothness") return std::make_unique<Smoothness>(scene->distance_m);
  if (name == "concealment") return std::make_unique<Concealment>(scene, spec.danger_distance_m);
  if (name == "threat") return std::make_unique<Threat>(scene);
  if (name == "violation") return std::make_unique<Violation>(scene);
  if (name == "contact") return std::make_unique<Contact>(scene);
  if (name == "collision") return std::make_unique<Collision>(scene, spec.collision_power);
  if (name == "F1") return std::make_unique<NmopsoLength>();
  if (name == "F2") return std::make_unique<NmopsoThreat>(scene, spec.danger_distance_m);
  if (name == "F4") return std::make_unique<NmopsoTurn>();
  return nullptr;
}

Status check_numbers(const CostSpec& spec) {
  for (std::size_t i = 0; i < spec.weights.size(); ++i) {
    const auto& [name, weight] = spec.weights[i];
    if (!is_non_negative(weight)) {
      return bad_input("The weight of objective '" + name + "' is " + std::to_string(weight) +
                       "; it must be finite and at least 0.");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (spec.weights[k].first == name) return bad_input("The objective '" + name + "' is weighted twice.");
    }
  }
  const std::array<std::pair<const char*, double>, 4> numbers = {
      std::pair{"operating range", spec.operating_range_m},
      std::pair{"collision power", spec.collision_power}, std::pair{"last step", spec.step_end},
      std::pair{"danger distance", spec.danger_distance_m}};
  for (const auto& [what, value] : numbers) {
    if (!is_non_negative(value)) {
      return bad_input("The " + std::string(what) + " is " + std::to_string(value) +
                       "; it must be finite and at least 0.");
    }
  }
  const Encoding::Band& band = spec.altitude;
  const bool chosen = band.min_m == 0.0 && band.max_m == 0.0;
  if (!chosen && !(is_non_negative(band.min_m) && is_finite(band.max_m) && band.min_m < band.max_m)) {
    return bad_input("The altitude band is " + std::to_string(band.min_m) + " to " +
                     std::to_string(band.max_m) +
                     " m above ground; it must be finite, at least 0 and not empty.");
  }
  return {};
}

/// With the values that 0 stands for.
CostSpec completed(CostSpec spec, const CostScene& scene) {
  if (spec.danger_distance_m == 0.0) {
    spec.danger_distance_m = std::max(10.0 * scene.limits.clearance_m(), scene.distance_m / 50.0);
  }
  if (spec.altitude.max_m == 0.0) {
    const double least = scene.limits.clearance_m();
    spec.altitude = {least, std::max(scene.world->bounds().max_m.z() - scene.ground_max_m, 2.0 * least)};
  }
  return spec;
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Entry& entry : table()) names.emplace_back(entry.name);
  return names;
}

std::vector<std::string> objective_names() { return {kObjectives.begin(), kObjectives.end()}; }

Result<std::string> preset_by_name(std::string_view name) {
  for (const Entry& entry : table()) {
    if (same_letters(entry.name, name)) return std::string(entry.name);
  }
  return bad_input("There is no cost preset '" + std::string(name) +
                   "'; known are: " + listed(preset_names()) + ".");
}

Result<Preset> make_preset(const CostSpec& given, const std::shared_ptr<const CostScene>& scene,
                           int waypoints) {
  Result<std::string> name = preset_by_name(given.preset);
  if (!name) return name.error();
  if (Status status = check_numbers(given); !status) return status.error();
  if (Status status = validate(given.energy, scene->limits); !status) return status.error();
  const CostSpec spec = completed(given, *scene);
  const Entry& entry = *std::ranges::find(table(), *name, [](const Entry& e) { return std::string(e.name); });

  Preset preset;
  preset.name = *name;
  preset.encoding = entry.encoding;
  preset.altitude = spec.altitude;
  std::vector<std::pair<std::string, double>> weights(entry.weights.begin(), entry.weights.end());
  for (auto& [objective, weight] : weights) {
    const bool metres = preset.name == "PSO";
    if (weight == kHard) weight = hard_weight(*scene, waypoints, metres ? 1.0 : scene->distance_m);
    if (weight == kStep) weight = spec.step_end;
  }
  for (const auto& [objective, weight] : spec.weights) {
    if (std::ranges::find(kObjectives, objective) == kObjectives.end()) {
      return bad_input("There is no objective '" + objective + "'; known are: " + listed(kObjectives) + ".");
    }
    const auto own = std::ranges::find(weights, objective, &std::pair<std::string, double>::first);
    if (own != weights.end()) {
      own->second = weight;
    } else {
      weights.emplace_back(objective, weight);
    }
  }
  for (const auto& [objective, weight] : weights) {
    preset.objectives.push_back({weight, make_objective(objective, preset.name, spec, scene)});
  }
  return preset;
}

}  // namespace swallowtail::planner
