#include "coverage/field/places.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace swallowtail::coverage {
namespace {

Ring square(double at, double size) {
  return {{at, at}, {at + size, at}, {at + size, at + size}, {at, at + size}};
}

TEST(Places, AreBarredInHolesAndNoFlyAreasByName) {
  std::vector<Field> fields{{1, "meadow", {square(0, 100), {square(20, 30)}}, 20.0}};
  const std::vector<Polygon> no_fly{{square(200, 50), {square(210, 10)}}};
  EXPECT_EQ(barred_at(fields, no_fly, {30, 30}), "a hole of field 'meadow'");
  EXPECT_EQ(barred_at(fields, no_fly, {240, 240}), "no-fly area 0");
  EXPECT_FALSE(barred_at(fields, no_fly, {10, 10})) << "on the field";
  EXPECT_FALSE(barred_at(fields, no_fly, {150, 150})) << "beside it";
  EXPECT_FALSE(barred_at(fields, no_fly, {215, 215})) << "in a hole of the no-fly area";
  EXPECT_FALSE(barred_at(fields, no_fly, {20, 30})) << "on the hole's border";
  fields.push_back({2, "garden", {square(25, 10), {}}, 20.0});
  EXPECT_FALSE(barred_at(fields, no_fly, {30, 30})) << "a field in the hole";
}

TEST(Places, AreFreeWhereFieldsAreEmpty) {
  const std::vector<Field> fields{{1, "nothing", {{}, {{}}}, 20.0}};
  EXPECT_FALSE(barred_at(fields, {}, {0, 0}));
}

}  // namespace
}  // namespace swallowtail::coverage
