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

}  // namespace
}  // namespace rheocyte::result_text_test
