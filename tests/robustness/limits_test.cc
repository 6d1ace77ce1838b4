// Whatever the system allows the program, it ends with a sentence and an exit code of its own: no crash, no endless
// run.
#include <gtest/gtest.h>

#include "run_program.h"

namespace rheocyte::test::limits_test {
namespace {

namespace fs = std::filesystem;

Ended in_shell(const std::string& before, const std::string& arguments) {
  return run({{"/bin/sh", "-c", before + "exec \"$0\" " + arguments, RHEOCYTE}});
}

const std::string good_case = std::string(EXAMPLES) + "/paper-cell.toml";

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need terabytes of addresses themselves
TEST(Limits, TooLittleMemoryIsASentence) {
  const TemporaryFolder folder;
  const auto result = (folder.path() / "result").string();
  int refused = 0;
  // Small steps: what fails last in a solve, a matrix or the stack, changes with each of them.
  for (int kB = 500000; kB > 26000; kB -= kB > 44000 ? kB / 5 : 250) {
    const std::string limit = "ulimit -v " + std::to_string(kB) + "; ";
    const auto ended = in_shell(limit, "solve " + good_case + " --no-picture --quiet -o " + result);
    if (ended.exit_code == 0 || ended.exit_code == 127) continue;  // enough; not even enough to be loaded
    // Libraries that HDF5 needs may crash while they start, before the program does.
    if (ended.exit_code > 127 && in_shell(limit, "--version").exit_code == ended.exit_code) continue;
    ++refused;
    expect_sentence(ended, "the memory does not suffice", 1);
  }
  EXPECT_GE(refused, 3);
  EXPECT_EQ(run({{RHEOCYTE, "solve", good_case, "--no-picture", "--quiet", "-o", result}}).exit_code, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << "nothing is left of those that ended";
}

// numpy would ask for memory without end.
TEST(Limits, WithoutMemoryForAPictureThereIsAWarning) {
  const TemporaryFolder folder;
  const auto ended =
      in_shell("ulimit -v 250000; ", "solve " + good_case + " --quiet -o " + (folder.path() / "result").string());
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_NE(ended.err.find("the pictures need 400 MB of memory"), std::string::npos) << ended.err;
}

TEST(Limits, TooFewOpenFilesAreNamedAndNoPermissionOrDiskIsAccused) {
  // What the program needs itself comes on top of standard input, output and error.
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "virtual.rtdc").string();
  ASSERT_EQ(
      in_shell("", "synth " EXAMPLES "/recordings/virtual-cells.toml -o " + file + " --quiet --set recording.cells=5")
          .exit_code,
      0);
  int refused = 0;
  for (int most = 6; most < 12; ++most) {
    const Ended ended = in_shell("ulimit -n " + std::to_string(most) + "; ",
                                 "extract " + file + " --quiet -o " + folder.path().string());
    if (ended.exit_code == 0 || ended.exit_code == 127) continue;  // enough; not even enough to be loaded
    ++refused;
    EXPECT_EQ(ended.exit_code, 2) << most;
    EXPECT_NE(ended.err.find("(ulimit -n)"), std::string::npos) << most << ": " << ended.err;
    EXPECT_EQ(ended.err.find("permissions"), std::string::npos) << most << ": " << ended.err;
    EXPECT_EQ(ended.err.find("disk"), std::string::npos) << most << ": " << ended.err;
  }
  EXPECT_GE(refused, 1);
}

TEST(Limits, ASmallStackIsLiftedOrNamed) {
  expect_sentence(in_shell("ulimit -s 64; ", "help case"), "the stack is limited to 64 kB");
  EXPECT_EQ(in_shell("ulimit -S -s 64; ", "solve --check " + good_case).exit_code, 0);
}
#endif

TEST(Limits, OutputThatCannotBePrintedIsASentence) {
  for (const std::string arguments : {"help case", "--version", "--help", "analytic --help"})
    expect_sentence(in_shell("", arguments + " > /dev/full"), "standard output cannot be written");
}

TEST(Limits, ALinkThatLeadsNowhereTakesNoResult) {
  const TemporaryFolder folder;
  const auto link = folder.path() / "link";
  fs::create_symlink(folder.path() / "nowhere", link);
  expect_sentence(run({{RHEOCYTE, "solve", good_case, "-o", link}}), "is a link that leads nowhere");
}

}  // namespace
}  // namespace rheocyte::test::limits_test
