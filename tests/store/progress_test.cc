// How far a file has come is reported if somebody looks on.
#include "store/progress.h"

#include <gtest/gtest.h>

#include <thread>

namespace rheocyte::progress_test {
namespace {

TEST(FileProgress, IsNoPartOfAnErrorOutputThatIsCaptured) {
  testing::internal::CaptureStderr();  // a file
  FileProgress progress("a.rtdc", false);
  std::this_thread::sleep_for(std::chrono::milliseconds(2100));  // from 2 s on a terminal would get a report
  progress(0.63);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace rheocyte::progress_test
