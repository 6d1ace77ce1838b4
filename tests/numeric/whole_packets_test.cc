#include "numeric/whole_packets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rheocyte::whole_packets_test {
namespace {

TEST(Packet, IsClampedAsANumberIsAndANumberThatIsMissingStaysMissing) {
  const Packet x(-3, 0.5, NAN, 7), held = clamped(x, 0, 1), raised = at_least(x, 0);
  for (Eigen::Index i : {0, 1, 3}) {
    EXPECT_EQ(held[i], clamped(x[i], 0, 1));
    EXPECT_EQ(raised[i], at_least(x[i], 0));
  }
  EXPECT_TRUE(std::isnan(held[2]));
  EXPECT_TRUE(std::isnan(raised[2]));
  EXPECT_TRUE(std::isnan(clamped(x[2], 0, 1)));
  EXPECT_TRUE(std::isnan(at_least(x[2], 0)));
}

}  // namespace
}  // namespace rheocyte::whole_packets_test
