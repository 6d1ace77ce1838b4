// An empty text is no value: each option refuses it in its own name.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "run_program.h"

namespace rheocyte::test::empty_arguments_test {
namespace {

/// The options of a command that take a value, as its help lists them: "  -o,--output DIR".
std::vector<std::string> options_with_values(std::vector<std::string> command) {
  command.insert(command.begin(), RHEOCYTE);
  command.push_back("--help");
  std::istringstream help(run({command}).out);
  const std::regex option(R"(^  (?:-[a-z],)?(--[A-Za-z0-9-]+)(?:,--[A-Za-z0-9-]+)? \S.*$)");
  std::vector<std::string> names;
  std::smatch found;
  for (std::string line; std::getline(help, line);)
    if (std::regex_match(line, found, option)) names.push_back(found[1]);
  return names;
}

void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) {
  std::vector<std::string> all{RHEOCYTE};
  all.insert(all.end(), arguments.begin(), arguments.end());
  expect_sentence(run({all}), words);
}

TEST(EmptyArguments, AreRefusedByEveryOptionOfEveryCommandInItsOwnName) {
  std::size_t options = 0;
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{{"extract"},
                                                                                       {"moduli"},
                                                                                       {"features"},
                                                                                       {"population"},
                                                                                       {"time-course"},
                                                                                       {"plan"},
                                                                                       {"plot"},
                                                                                       {"synth"},
                                                                                       {"scale"},
                                                                                       {"solve"},
                                                                                       {"table"},
                                                                                       {"view"},
                                                                                       {"analytic", "cell"},
                                                                                       {"analytic", "table"},
                                                                                       {"analytic", "lines"}})
    for (const std::string& option : options_with_values(command)) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.end(), {option, ""});
      expect_refusal(arguments, "rheocyte: " + option + " is empty");
      ++options;
    }
  EXPECT_GT(options, 150U) << "the help lists them otherwise than this test reads it";
}

TEST(EmptyArguments, AreFoundBehindAnEqualsSignInListsAndAmongFiles) {
  expect_refusal({"moduli", "a.rtdc", "--axial-tension-Pa="}, "--axial-tension-Pa is empty");
  expect_refusal({"moduli", "a.rtdc", "--axial-tension-Pa", " "}, "--axial-tension-Pa is empty");
  expect_refusal({"extract", "a.rtdc", "-o", ""}, "-o is empty");
  expect_refusal({"time-course", "a.rtdc", "-o", "a.tsv", "--contraction-um", "0,,20"},
                 "--contraction-um 0,,20: an entry of the list is empty");
  expect_refusal({"plan", "--radius-um", "7", "--young-modulus-kPa", "2", "--width-um", "20,"},
                 "--width-um 20,: an entry of the list is empty");
  expect_refusal({"extract", ""}, "an argument is empty");
  expect_refusal({"extract", "--no-asymmetry", "", "a.rtdc"}, "an argument is empty");
}

}  // namespace
}  // namespace rheocyte::test::empty_arguments_test
