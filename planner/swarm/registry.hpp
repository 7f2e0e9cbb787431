#pragma once

#include <string>
#include <string_view>
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
#include "planner/swarm/parameter.hpp"
#include "planner/swarm/pso.hpp"
#include "planner/swarm/pso_seed.hpp"

namespace swallowtail::swarm {

/// The parameters of any algorithm; which of them it holds says which algorithm runs.
using AnyParams = std::variant<BoaParams, PsoParams, IbabcParams, AcoParams, BoaSeedParams, PsoSeedParams,
                               IbabcSeedParams, AcoSeedParams>;

/// Every algorithm's name, in the order of the table; `-seed` is the form as published.
std::vector<std::string> algorithm_names();

/// Default parameters by name; for another population size `with_population`. Errors name the known ones.
Result<AnyParams> params_by_name(std::string_view name);
AnyParams with_population(AnyParams params, int population);

/// What can be tuned; points into `params`.
Parameters parameters(AnyParams& params);

/// Runs whichever algorithm the parameters belong to (see `run`).
Result<Report> optimize(const AnyParams& params, const Problem& problem, const RunOptions& options);

}  // namespace swallowtail::swarm
