// A record gives back the same branch to the last bit; one that is cut, changed or foreign is refused by name.
#include <gtest/gtest.h>

#include "../refusal.h"
#include "case/user_error.h"
#include "invented_branch.h"

namespace rheocyte::branch_record_test {
namespace {

using namespace test;

const std::string hash = "0123456789abcdef";

std::string refusal(const std::string& bytes, const std::string& spec = hash) {
  return test::refusal_of([&] { branch_from_bytes(bytes, spec, "branch-007.cbor"); });
}

TEST(BranchRecord, RoundTripIsExact) {
  auto branch = invented_branch(7, {30, 0.3, 5, 1e4, Status::surface_unstable});
  branch.value(2, 3) = std::numeric_limits<double>::quiet_NaN();
  branch.value(2, 4) = -0.0;
  const auto bytes = to_bytes(branch, hash);
  const auto back = branch_from_bytes(bytes, hash, "x");
  EXPECT_EQ(back.stiffness, branch.stiffness);
  EXPECT_EQ(back.error, branch.error);
  EXPECT_TRUE(std::isnan(back.value(2, 3)));
  EXPECT_TRUE(std::signbit(back.value(2, 4)));
  EXPECT_EQ(back.slope, branch.slope);
  EXPECT_EQ(back.contour, branch.contour);
  EXPECT_EQ(back.contour_slope, branch.contour_slope);
  EXPECT_EQ(back.end.status, Status::surface_unstable);
  EXPECT_EQ(back.end.message, branch.end.message);
  EXPECT_EQ(back.bending_kBT, 1e4);
  EXPECT_EQ(back.solves, branch.solves);
  EXPECT_EQ(to_bytes(back, hash), bytes);  // NaN included
}

TEST(BranchRecord, ABranchWithoutSamplesIsARecord) {
  SampledBranch branch;
  branch.radius_um = 3;
  branch.end = {Status::iteration_limit, "nothing converged"};
  const auto back = branch_from_bytes(to_bytes(branch, hash), hash, "x");
  EXPECT_TRUE(back.empty());
  EXPECT_EQ(back.end.message, "nothing converged");
}

TEST(BranchRecord, NumbersOfShapesAndStiffnessesAreFinite) {
  // Also under a right checksum; only a measure may be one that the state does not have.
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto stiffness = invented_branch(7), error = invented_branch(7), contour = invented_branch(7);
    stiffness.stiffness[1] = wrong;
    error.error[1] = wrong;
    contour.contour[1](0, 1) = wrong;
    for (const auto& branch : {stiffness, error, contour})
      EXPECT_NE(refusal(to_bytes(branch, hash)).find("branch-007.cbor: "), std::string::npos);
  }
}

TEST(BranchRecord, EveryCutIsRefused) {
  const auto bytes = to_bytes(invented_branch(7, {30, 0.3, 2}), hash);
  for (std::size_t length = 0; length < bytes.size(); length += length < 200 ? 1 : 37)
    EXPECT_NE(refusal(bytes.substr(0, length)).find("branch-007.cbor: "), std::string::npos) << length;
  EXPECT_NE(refusal(bytes + '\0').find("branch-007.cbor: "), std::string::npos);
}

TEST(BranchRecord, EveryFlippedBitIsRefused) {
  const auto bytes = to_bytes(invented_branch(7, {30, 0.3, 2}), hash);
  for (std::size_t at = 0; at < bytes.size(); at += at < 300 ? 1 : 23)
    for (const int bit : {0, 3, 7}) {
      auto damaged = bytes;
      damaged[at] = char(damaged[at] ^ (1 << bit));
      EXPECT_NE(refusal(damaged).find("branch-007.cbor: "), std::string::npos) << at << " " << bit;
    }
}

TEST(BranchRecord, AForeignRecordIsNamed) {
  const auto bytes = to_bytes(invented_branch(7), hash);
  EXPECT_NE(refusal(bytes, "fedcba9876543210").find("belongs to another spec"), std::string::npos);
  EXPECT_NE(refusal("").find("cut or damaged"), std::string::npos);
  EXPECT_NE(refusal("\xA1"
                    "aa\x01")
                .find("branch-007.cbor"),
            std::string::npos);
}

}  // namespace
}  // namespace rheocyte::branch_record_test
