#include "planner/swarm/registry.hpp"

#include <array>
#include <utility>

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
    Entry{"boa", defaults<BoaParams>},
    Entry{"pso", defaults<PsoParams>},
    Entry{"ibabc", defaults<IbabcParams>},
    Entry{"aco", defaults<AcoParams>},
    Entry{"boa-seed", defaults<BoaSeedParams>},
    Entry{"pso-seed", defaults<PsoSeedParams>},
    Entry{"ibabc-seed", defaults<IbabcSeedParams>},
    Entry{"aco-seed", defaults<AcoSeedParams>},
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

Result<Report> optimize(const AnyParams& params, const Problem& problem, const RunOptions& options) {
  return std::visit(
      [&](const auto& p) {
        return run<typename AlgorithmOf<std::decay_t<decltype(p)>>::type>(p, problem, options);
      },
      params);
}

}  // namespace swallowtail::swarm
