#include "planner/swarm/registry.hpp"

#include <array>
#include <utility>

namespace swallowtail::swarm {
namespace {

struct Entry {
  std::string_view name;
  AnyParams (*defaults)();
};

constexpr std::array kTable{
    Entry{"boa", [] { return AnyParams(BoaParams{}); }},
};

/// Which algorithm takes which parameters.
template <class Params>
struct AlgorithmOf;
template <>
struct AlgorithmOf<BoaParams> {
  using type = Boa;
};

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

Result<Report> optimize(const AnyParams& params, const Problem& problem, const RunOptions& options) {
  return std::visit(
      [&](const auto& p) {
        return run<typename AlgorithmOf<std::decay_t<decltype(p)>>::type>(p, problem, options);
      },
      params);
}

}  // namespace swallowtail::swarm
