// Whatever is wrong with the command line, the files or the folders: exit code 2 and one sentence, nothing written.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "run_program.h"

namespace rheocyte::test::command_line_test {
namespace {

namespace fs = std::filesystem;

const std::string good_case = std::string(EXAMPLES) + "/paper-cell.toml";

void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) {
  std::vector<std::string> all{RHEOCYTE};
  all.insert(all.end(), arguments.begin(), arguments.end());
  expect_sentence(run({all}), words);
}

TEST(CommandLine, MistakesAreNamed) {
  expect_refusal({}, "subcommand is required");
  expect_refusal({"sovle"}, "did you mean solve?");
  expect_refusal({"solve"}, "CASE is required");
  expect_refusal({"solve", good_case}, "give one with -o");
  expect_refusal({"solve", good_case, "-o", "x", "--jsn"}, "--jsn");
  expect_refusal({"help", "cass"}, "cass");
  expect_refusal({"picture", "/nowhere"}, "no result.json");
  expect_refusal({"extract", "a.rtdc", "--pixel-size-um", "0,34"}, "decimals follow a point");
  expect_refusal({"plot", "a.rtdc", "--levels", "0,5"}, "decimals follow a point");
}

TEST(CommandLine, WrongSettingsAreNamedWithTheirSource) {
  const auto refuse = [](const std::string& setting, const std::string& words) {
    expect_refusal({"solve", "--check", good_case, "--set", setting}, "--set" + words);
  };
  refuse("cell.radius_um", " cell.radius_um: write key=value");
  refuse("cell.radius_um=", ": cell.radius_um = \"\" is not a number");
  refuse("cell.radius_um=nan", ": cell.radius_um = nan is not finite");
  refuse("cell.radius_um=-3", ": cell.radius_um = -3 is outside its range");
  refuse("cell.radius=3", ": unknown key cell.radius = 3, did you mean cell.radius_um?");
  refuse("flow.exponent=0.6", ": flow.exponent = 0.6 has no effect");
  refuse("=3", " =3: write key=value");
}

TEST(CommandLine, CaseFilesThatCannotBeReadAreNamed) {
  const TemporaryFolder folder;
  expect_refusal({"solve", "--check", folder.path() / "missing.toml"}, "missing.toml: there is no such case file");
  expect_refusal({"solve", "--check", folder.path()}, "is a folder");
  expect_refusal({"solve", "--check", "/dev/zero"}, "is not a regular file");
  write_file(folder.path() / "empty.toml", "");
  expect_refusal({"solve", "--check", folder.path() / "empty.toml"}, "the case file is empty");
  if (::geteuid() == 0) return;  // root may read everything
  write_file(folder.path() / "secret.toml", content_of(good_case));
  fs::permissions(folder.path() / "secret.toml", fs::perms::none);
  expect_refusal({"solve", "--check", folder.path() / "secret.toml"}, "Permission denied");
}

TEST(CommandLine, AFifoInPlaceOfAProgramTextIsNamedAndNotWaitedFor) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "rheocyte");
  const auto text = folder.path() / "rheocyte" / "modulus_plugin.py";
  const Command plugin{.arguments = {RHEOCYTE, "dclab-plugin"}, .environment = {{"RHEOCYTE_PYTHON", folder.path()}}};
  expect_sentence(run(plugin), "modulus_plugin.py: cannot be read (No such file or directory).");
  ASSERT_EQ(::mkfifo(text.c_str(), 0600), 0);
  expect_sentence(run(plugin), "modulus_plugin.py: is not a regular file.");
  fs::remove(text);
  write_file(text, "");
  expect_sentence(run(plugin), "modulus_plugin.py: is empty");
}

TEST(CommandLine, FoldersThatCannotTakeAResultAreNamedBeforeAnythingIsSolved) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "file", foreign = folder.path() / "foreign";
  write_file(file, "not a folder");
  fs::create_directory(foreign);
  write_file(foreign / "thesis.tex", "precious");
  expect_refusal({"solve", good_case, "-o", file}, "is a file");
  expect_refusal({"solve", good_case, "-o", file / "result"}, "Not a directory");
  expect_refusal({"solve", good_case, "-o", foreign}, "contains files but no result of rheocyte");
  expect_refusal({"solve", good_case, "-o", "/proc/result"}, "/proc/result: cannot write a result there");
  expect_refusal({"solve", good_case, "-o", "/"}, "/");
  EXPECT_EQ(content_of(foreign / "thesis.tex"), "precious");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
}

TEST(CommandLine, HelpAndVersionAnswerOnStandardOutput) {
  for (const auto& arguments : std::vector<std::vector<std::string>>{{RHEOCYTE, "--help"},
                                                                     {RHEOCYTE, "help"},
                                                                     {RHEOCYTE, "help", "case"},
                                                                     {RHEOCYTE, "help", "solve"},
                                                                     {RHEOCYTE, "help", "moduli"},
                                                                     {RHEOCYTE, "--version"},
                                                                     {RHEOCYTE, "help", "case", "--markdown"}}) {
    const auto ended = run({arguments});
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_EQ(ended.err, "");
    EXPECT_NE(ended.out.find("rheocyte"), std::string::npos) << ended.out;
  }
}

TEST(CommandLine, EveryExampleIsAGoodCase) {
  int examples = 0;
  for (const auto& entry : fs::directory_iterator(EXAMPLES)) {
    if (entry.path().extension() != ".toml") continue;
    ++examples;
    const auto ended = run({{RHEOCYTE, "solve", "--check", entry.path()}});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.out + ended.err, "");
  }
  EXPECT_GE(examples, 5);
}

}  // namespace
}  // namespace rheocyte::test::command_line_test
