#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/cost/encoding.hpp"
#include "planner/cost/energy.hpp"
#include "planner/cost/objective.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// A weighted sum of objectives by name. D is start to goal.
///
/// | preset  | weight · objective                                                | encoding     | source | |
/// ------- | ----------------------------------------------------------------- | ------------ |
/// -------------- | | default | 1·length/D + 10·violation                                         | frame |
/// ours           | | BOA     | 1·length + Step·collision + 3·range                               | box |
/// [BOA Eq. 16]   | | PSO     | 1·length + hard·contact                                           | box |
/// [PSO Eq. 5–7]  | | IBABC   | ¼·(length/D + smoothness + concealment + threat) + hard·contact   | planes |
/// [IBABC Eq. 2–6] | | NMOPSO  | F1 + F2 + F3 + F4 + hard·contact                                  | frame |
/// [NMOPSO F1–F4] | | SPSO    | 5·length + 1·threat + 10·altitude + 1·smoothness                  | above
/// ground | [SPSO]         |
///
/// "hard" is more than any free path in the box can cost in length: IBABC and NMOPSO have it from us, so that
/// what is best can also be flown; weight 0 gives the documents' own sums. IBABC's weights are not printed.
/// The other objectives (energy, clearance, altitude) can be added to any preset by a weight.
struct CostSpec {
  std::string preset = "default";  ///< a name of the table, in upper or lower case
  /// By objective name, instead of the preset's own weight.
  std::vector<std::pair<std::string, double>> weights;

  double operating_range_m = 3.5;  ///< OP [BOA Eq. 11]
  double collision_power = 2.0;    ///< w1 [BOA Eq. 16]
  double step_end = 100.0;  ///< Step when it does not grow, and of `terms`: the document's 100 iterations
  bool step_grows = false;  ///< Step is the iteration's number, through swarm::Problem::begin_iteration
  double danger_distance_m = 0.0;  ///< d_safe [IBABC Eq. 4], S [NMOPSO F2]; 0: ten times the vehicle's
                                   ///< clearance, at least D/50
  Encoding::Band altitude;  ///< above ground [NMOPSO F3]; 0, 0: from the vehicle's clearance to the top of
                            ///< the bounds above the highest ground
  EnergyModel energy;
};

/// The presets' names, in the order of the table; and those of all objectives.
std::vector<std::string> preset_names();
std::vector<std::string> objective_names();
/// The name as it stands in the table. Errors name the known ones.
Result<std::string> preset_by_name(std::string_view name);

struct WeightedObjective {
  double weight = 0.0;
  std::unique_ptr<const Objective> objective;
};

/// A spec, looked at: what to sum and how to encode. Errors: an unknown preset or objective, an objective
/// weighted twice, a weight or parameter that is negative or not finite, an empty altitude band.
struct Preset {
  std::string name;
  EncodingKind encoding = EncodingKind::kFrame;
  Encoding::Band altitude;
  std::vector<WeightedObjective> objectives;
};
Result<Preset> make_preset(const CostSpec& spec, const std::shared_ptr<const CostScene>& scene,
                           int waypoints);

}  // namespace swallowtail::planner
