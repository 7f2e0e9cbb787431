#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/swarm/aco.hpp"
#include "planner/swarm/aco_seed.hpp"
#include "planner/swarm/boa.hpp"
#include "planner/swarm/boa_seed.hpp"
#include "planner/swarm/driver.hpp"
#include "planner/swarm/ibabc.hpp"
#include "planner/swarm/ibabc_seed.hpp"
#include "planner/swarm/multi_driver.hpp"
#include "planner/swarm/nmopso.hpp"
#include "planner/swarm/nmopso_seed.hpp"
#include "planner/swarm/parameter.hpp"
#include "planner/swarm/pso.hpp"
#include "planner/swarm/pso_seed.hpp"

namespace swallowtail::swarm {

/// The parameters of any algorithm; which of them it holds says which algorithm runs.
using AnyParams = std::variant<BoaParams, PsoParams, IbabcParams, AcoParams, BoaSeedParams, PsoSeedParams,
                               IbabcSeedParams, AcoSeedParams, NmopsoParams, NmopsoSeedParams>;

/// Every algorithm's name, in the order of the table; `-seed` is the form as published.
std::vector<std::string> algorithm_names();

/// Default parameters by name; for another population size `with_population`. Errors name the known ones.
Result<AnyParams> params_by_name(std::string_view name);
AnyParams with_population(AnyParams params, int population);

/// What can be tuned; points into `params`.
Parameters parameters(AnyParams& params);

/// Values by parameter name, as they come from a user or from tuning.
using Settings = std::vector<std::pair<std::string, double>>;
/// Errors: as `set` (parameter.hpp).
Result<AnyParams> with_settings(AnyParams params, const Settings& settings);

/// Runs whichever algorithm the parameters belong to (see `run`). One for several objectives takes the cost
/// as its only one.
Result<Report> optimize(const AnyParams& params, const Problem& problem, const RunOptions& options);

/// Whether the algorithm can return a front.
bool takes_several_objectives(const AnyParams& params);
/// Runs it on several objectives (see `run_multi`). Refuses an algorithm that takes one only.
Result<MultiReport> optimize_multi(const AnyParams& params, const MultiProblem& problem,
                                   const MultiRunOptions& options);

}  // namespace swallowtail::swarm
