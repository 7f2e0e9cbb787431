#include "planner/swarm/registry.hpp"

#include <gtest/gtest.h>

namespace swallowtail::swarm {
namespace {

TEST(Registry, KnowsBoa) {
  ASSERT_TRUE(params_by_name("boa").ok());
  EXPECT_TRUE(std::holds_alternative<BoaParams>(*params_by_name("boa")));
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

}  // namespace
}  // namespace swallowtail::swarm
