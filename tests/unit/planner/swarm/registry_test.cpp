#include "planner/swarm/registry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace swallowtail::swarm {
namespace {

TEST(Registry, KnowsFiveAlgorithmsInBothForms) {
  const std::vector<std::string> names = algorithm_names();
  const std::set<std::string> known(names.begin(), names.end());
  for (const char* name : {"boa", "pso", "ibabc", "aco", "nmopso"}) {
    EXPECT_TRUE(known.contains(name));
    EXPECT_TRUE(known.contains(std::string(name) + "-seed"));
  }
  EXPECT_EQ(known.size(), names.size()) << "no name twice";
  EXPECT_TRUE(std::holds_alternative<BoaParams>(*params_by_name("boa")));
  EXPECT_TRUE(std::holds_alternative<BoaSeedParams>(*params_by_name("boa-seed")));
}

TEST(Registry, NamesWhatItKnowsWhenAskedForSomethingElse) {
  Result<AnyParams> params = params_by_name("simulated-annealing");
  ASSERT_FALSE(params.ok());
  EXPECT_EQ(params.error().code, Error::Code::kBadInput);
  EXPECT_NE(params.error().message.find("'simulated-annealing'"), std::string::npos);
  for (const std::string& name : algorithm_names()) {
    EXPECT_NE(params.error().message.find(name), std::string::npos);
  }
}

TEST(Registry, SetsThePopulation) {
  EXPECT_EQ(std::get<BoaParams>(with_population(*params_by_name("boa"), 77)).population, 77);
}

/// Every tunable of every algorithm: named once, in range by default, refused out of range.
TEST(Registry, EveryParameterHoldsToItsRange) {
  Problem problem;
  problem.lower = Eigen::VectorXd::Constant(2, -1.0);
  problem.upper = Eigen::VectorXd::Constant(2, 1.0);
  problem.evaluate = [](Candidates x, Costs costs) { costs = x.colwise().squaredNorm().transpose(); };
  RunOptions options;
  options.stop.max_evaluations = 1;
  for (const std::string& algorithm : algorithm_names()) {
    AnyParams params = *params_by_name(algorithm);
    EXPECT_TRUE(optimize(params, problem, options).ok());
    std::set<std::string_view> names;
    for (const Parameter& parameter : parameters(params)) {
      EXPECT_TRUE(names.insert(parameter.name).second) << algorithm << ' ' << parameter.name;
      EXPECT_FALSE(parameter.source.empty()) << algorithm << ' ' << parameter.name;
      EXPECT_GE(parameter.get(), parameter.min) << algorithm << ' ' << parameter.name;
      EXPECT_LE(parameter.get(), parameter.max) << algorithm << ' ' << parameter.name;
      const std::string name(parameter.name);
      EXPECT_FALSE(with_settings(params, {{name, std::numeric_limits<double>::infinity()}}).ok())
          << algorithm << ' ' << name;
      EXPECT_FALSE(with_settings(params, {{name, parameter.min - 1.0}}).ok()) << algorithm << ' ' << name;
      EXPECT_FALSE(with_settings(params, {{name, std::nan("")}}).ok()) << algorithm << ' ' << name;
      AnyParams changed = *with_settings(params, {{name, parameter.max}});
      for (const Parameter& now : parameters(changed)) {
        EXPECT_TRUE(now.name != parameter.name || now.get() == parameter.max) << name;
      }
    }
    EXPECT_TRUE(names.contains("population")) << algorithm;
    EXPECT_FALSE(with_settings(params, {{"population", 20.5}}).ok()) << "not a whole number";
    EXPECT_NE(with_settings(params, {{"colour", 1.0}}).error().message.find("population"), std::string::npos);
  }
}

TEST(Registry, RunsOnSeveralObjectivesWhatCan) {
  MultiProblem problem;
  problem.lower = Eigen::VectorXd::Constant(2, -1.0);
  problem.upper = Eigen::VectorXd::Constant(2, 2.0);
  problem.objectives = 2;
  problem.evaluate = [](Candidates x, Objectives f) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      f(0, i) = x.col(i).squaredNorm();
      f(1, i) = (x.col(i).array() - 1.0).square().sum();
    }
  };
  MultiRunOptions options;
  options.stop.max_evaluations = 500;
  for (const std::string& name : algorithm_names()) {
    const AnyParams params = *params_by_name(name);
    EXPECT_EQ(optimize_multi(params, problem, options).ok(), takes_several_objectives(params)) << name;
  }
}

}  // namespace
}  // namespace swallowtail::swarm
