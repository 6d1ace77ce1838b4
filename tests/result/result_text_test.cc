// What is printed of a state.
#include <gtest/gtest.h>

#include "result/result.h"

namespace rheocyte::result_text_test {
namespace {

TEST(Summary, ShowsADeformationThatIsNextToNothing) {
  Result result{};
  result.scales = Scales{};
  result.state.shape.deformation = 2.1e-13;
  result.state.shape.deformation_raw = 0.01234567;
  result.state.errors.shape.deformation = 7e-13;
  result.state.errors.shape.deformation_raw = 2e-7;
  const std::string text = summary(result, "folder");
  EXPECT_NE(text.find("2.1e-13 +- 7e-13"), std::string::npos) << text;
  EXPECT_NE(text.find("raw 0.012346 +- 2e-07"), std::string::npos) << text;
}

TEST(Summary, TellsTheEffectiveModulusOfACellWithACortexAlone) {
  // Of a solid of 12 S it is its modulus; of a shell 3/5 E2D / r0 = 6 S, that is 60 Pa.
  Result result{};
  result.scales = Scales{1, 1, 10};
  result.problem.bulk.shear_modulus = 4;
  EXPECT_DOUBLE_EQ(effective_modulus_kPa(result), 0.12);
  EXPECT_EQ(summary(result, "folder").find("effective modulus"), std::string::npos);
  result.problem.bulk.law = BulkLaw::none;
  result.problem.cortex = {.law = CortexLaw::linear, .modulus = 5};
  const std::string text = summary(result, "folder");
  EXPECT_NE(text.find("effective modulus  0.06 kPa "), std::string::npos) << text;
}

}  // namespace
}  // namespace rheocyte::result_text_test
