// The nearest name is what a person would have meant, and nothing if there is nothing near.
#include "case/nearest_name.h"

#include <gtest/gtest.h>

#include <array>

namespace rheocyte::nearest_name_test {
namespace {

constexpr std::array<std::string_view, 5> keys{"channel.width_um", "channel.radius_um", "cell.radius_um",
                                               "cell.bulk.young_modulus_kPa", "flow.viscosity_mPas"};

TEST(EditDistance, CountsChangesAndSwapsAndIgnoresCapitals) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1);
  EXPECT_EQ(edit_distance("KPA", "kPa"), 0);
}

TEST(EditDistance, IsSymmetric) {
  for (const auto a : keys)
    for (const auto b : keys) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
}

TEST(NearestName, FindsWhatWasMeant) {
  EXPECT_EQ(nearest_name("cell.raduis_um", keys), "cell.radius_um");
  EXPECT_EQ(nearest_name("cell.radius", keys), "cell.radius_um");
  EXPECT_EQ(nearest_name("channel.radius", keys), "channel.radius_um");
  EXPECT_EQ(nearest_name("chanel.width", keys), "channel.width_um");
  EXPECT_EQ(nearest_name("cell.young_modulus_kPa", keys), "cell.bulk.young_modulus_kPa");
  EXPECT_EQ(nearest_name("flow.viscosity_mPa_s", keys), "flow.viscosity_mPas");
  EXPECT_EQ(nearest_name("radius_um", keys), "cell.radius_um");
}

TEST(NearestName, IsSilentWhenNothingIsNear) {
  EXPECT_FALSE(nearest_name("wall.slip_length_nm", keys));
  EXPECT_FALSE(nearest_name("", keys));
  EXPECT_FALSE(nearest_name(std::string(10000, 'x'), keys));
  EXPECT_EQ(did_you_mean("wall.slip_length_nm", keys), "");
}

}  // namespace
}  // namespace rheocyte::nearest_name_test
