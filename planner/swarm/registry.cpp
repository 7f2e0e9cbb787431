#include "planner/swarm/registry.hpp"

#include <array>
#include <utility>

#include "planner/swarm/scalar.hpp"

namespace swallowtail::swarm {
namespace {

struct Entry {
  std::string_view name;
  AnyParams (*defaults)();
};

template <class Params>
AnyParams defaults() {
  return AnyParams(Params{});
}

constexpr std::array kTable{
    Entry{"boa", defaults<BoaParams>},          Entry{"pso", defaults<PsoParams>},
    Entry{"ibabc", defaults<IbabcParams>},      Entry{"aco", defaults<AcoParams>},
    Entry{"nmopso", defaults<NmopsoParams>},    Entry{"boa-seed", defaults<BoaSeedParams>},
    Entry{"pso-seed", defaults<PsoSeedParams>}, Entry{"ibabc-seed", defaults<IbabcSeedParams>},
    Entry{"aco-seed", defaults<AcoSeedParams>}, Entry{"nmopso-seed", defaults<NmopsoSeedParams>},
};

/// Which algorithm takes which parameters.
template <class Params>
struct AlgorithmOf;
// clang-format off
template <> struct AlgorithmOf<BoaParams> { using type = Boa; };
template <> struct AlgorithmOf<PsoParams> { using type = Pso; };
template <> struct AlgorithmOf<IbabcParams> { using type = Ibabc; };
template <> struct AlgorithmOf<AcoParams> { using type = Aco; };
template <> struct AlgorithmOf<BoaSeedParams> { using type = BoaSeed; };
template <> struct AlgorithmOf<PsoSeedParams> { using type = PsoSeed; };
template <> struct AlgorithmOf<IbabcSeedParams> { using type = IbabcSeed; };
template <> struct AlgorithmOf<AcoSeedParams> { using type = AcoSeed; };
template <> struct AlgorithmOf<NmopsoParams> { using type = Scalar<Nmopso>; };
template <> struct AlgorithmOf<NmopsoSeedParams> { using type = Scalar<NmopsoSeed>; };
// clang-format on

}  // namespace

std::vector<std::string> algorithm_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kTable) names.emplace_back(entry.name);
  return names;
}

Result<AnyParams> params_by_name(std::string_view name) {
  std::string known;
  for (const Entry& entry : kTable) {
    if (entry.name == name) return entry.defaults();
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  return bad_input("There is no algorithm '" + std::string(name) + "'; known are: " + known + ".");
}

AnyParams with_population(AnyParams params, int population) {
  std::visit([population](auto& p) { p.population = population; }, params);
  return params;
}

Parameters parameters(AnyParams& params) {
  return std::visit([](auto& p) { return parameters(p); }, params);
}

Result<AnyParams> with_settings(AnyParams params, const Settings& settings) {
  const Parameters known = parameters(params);
  for (const auto& [name, value] : settings) {
    if (Status status = set(known, name, value); !status) return status.error();
  }
  return params;
}

Result<Report> optimize(const AnyParams& params, const Problem& problem, const RunOptions& options) {
  return std::visit(
      [&](const auto& p) {
        return run<typename AlgorithmOf<std::decay_t<decltype(p)>>::type>(p, problem, options);
      },
      params);
}

bool takes_several_objectives(const AnyParams& params) {
  return std::holds_alternative<NmopsoParams>(params) || std::holds_alternative<NmopsoSeedParams>(params);
}

Result<MultiReport> optimize_multi(const AnyParams& params, const MultiProblem& problem,
                                   const MultiRunOptions& options) {
  if (const auto* p = std::get_if<NmopsoParams>(&params)) return run_multi<Nmopso>(*p, problem, options);
  if (const auto* p = std::get_if<NmopsoSeedParams>(&params)) {
    return run_multi<NmopsoSeed>(*p, problem, options);
  }
  return bad_input("This algorithm minimises one objective; 'nmopso' and 'nmopso-seed' take several.");
}

}  // namespace swallowtail::swarm
