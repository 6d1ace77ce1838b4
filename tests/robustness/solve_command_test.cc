// However a computation ends, its folder is whole or untouched, and exit code, status and sentence say the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>

#include "run_program.h"

namespace rheocyte::test::solve_command_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class SolveCommand : public testing::Test {
 protected:
  fs::path result() const { return folder_.path() / "result"; }

  Command solve(const std::string& failure = "", const std::vector<std::string>& more = {}) const {
    Command command{{FAILING_RHEOCYTE, "solve", std::string(EXAMPLES) + "/paper-cell.toml", "-o", result()}};
    command.arguments.insert(command.arguments.end(), more.begin(), more.end());
    command.environment["RHEOCYTE_TEST_SOLVER"] = failure;
    return command;
  }

  json numbers() const { return json::parse(content_of(result() / "result.json")); }

  // The number of a key.
  double number(const char* key) const { return numbers()[key].get<double>(); }

  // Nothing but the result itself may be left beside it.
  std::ptrdiff_t entries_beside() const { return std::distance(fs::directory_iterator(folder_.path()), {}); }

  TemporaryFolder folder_;
};

TEST_F(SolveCommand, EveryExampleIsSolved) {
  for (const auto& entry : fs::directory_iterator(EXAMPLES)) {
    if (entry.path().extension() != ".toml") continue;
    std::vector<std::string> words = {RHEOCYTE,
                                      "solve",
                                      entry.path(),
                                      "-o",
                                      folder_.path() / entry.path().stem(),
                                      "--no-picture",
                                      "--quiet",
                                      "--set",
                                      "numerics.accuracy=1e-2"};
    if (entry.path().stem().string().starts_with("transit"))  // into the funnel, and no further
      words.insert(words.end(), {"--set", "time.end_um=50", "--set", "time.accuracy=1e-2"});
    const auto ended = run({words});
    EXPECT_EQ(ended.exit_code, 0) << entry.path() << ended.err;
  }
  EXPECT_GE(entries_beside(), 10);
}

TEST_F(SolveCommand, ASquareChannelHasBothViewsAndTheCamerasOne) {
  const Command command{{RHEOCYTE, "solve", std::string(EXAMPLES) + "/square-channel.toml", "-o", result(), "--set",
                         "numerics.accuracy=0.05"}};
  const auto ended = run(command);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const auto* file : {"contour.csv", "contour_side.csv", "contour_diagonal.csv", "fields.vtu"})
    EXPECT_TRUE(fs::exists(result() / file)) << file;
  EXPECT_EQ(content_of(result() / "contour.csv"), content_of(result() / "contour_diagonal.csv"));
  EXPECT_EQ(number("deformation"), number("deformation_diagonal"));
  EXPECT_GT(number("deformation_side"), number("deformation_diagonal"));
  EXPECT_GT(number("volume_of_revolution_um3"), number("volume_um3"));  // the corners bulge
  EXPECT_TRUE(numbers()["tube_radius_um"].is_null());
  EXPECT_NEAR(number("flow_rate_ul_per_s"), 0.04, 1e-12);
}

TEST_F(SolveCommand, ARectangleIsSeenFromAnyAngle) {
  const Command command{{RHEOCYTE, "solve", std::string(EXAMPLES) + "/rectangle.toml", "-o", result(), "--set",
                         "numerics.accuracy=0.05"}};
  const auto ended = run(command);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(fs::exists(result() / "contour_side.csv"));
  EXPECT_FALSE(fs::exists(result() / "contour_diagonal.csv"));
  EXPECT_TRUE(fs::exists(result() / "picture.png"));
  EXPECT_TRUE(numbers()["deformation_diagonal"].is_null());
  EXPECT_NE(ended.out.find("by view"), std::string::npos) << ended.out;
  EXPECT_EQ(ended.out.find("diagonal"), std::string::npos) << ended.out;
  // Seen 11 degrees off the side, not the same and not much else.
  EXPECT_NE(number("deformation"), number("deformation_side"));
  EXPECT_NEAR(number("deformation") / number("deformation_side"), 1, 0.2);
}

TEST_F(SolveCommand, WritesEveryFileAndEveryNumber) {
  const auto ended = run(solve("", {"--no-picture"}));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (const auto* file : {"result.json", "contour.csv", "fields.vtu", "case.toml"})
    EXPECT_TRUE(fs::exists(result() / file)) << file;
  const auto written = numbers();
  for (const auto* key : {"status",
                          "deformation",
                          "deformation_raw",
                          "area_um2",
                          "area_raw_um2",
                          "perimeter_um",
                          "volume_um3",
                          "relative_volume_change",
                          "moment_ratio",
                          "inertia_ratio",
                          "cell_velocity_m_per_s",
                          "pressure_drop_Pa",
                          "additional_pressure_drop_Pa",
                          "reynolds",
                          "least_meridional_stretch",
                          "unknowns",
                          "newton_iterations",
                          "residual",
                          "estimated_error",
                          "wall_time_s",
                          "version",
                          "case",
                          "case_hash",
                          "message",
                          "statistics",
                          "branch",
                          "compiler",
                          "threads"})
    EXPECT_TRUE(written.contains(key)) << key;
  EXPECT_EQ(written["status"], "converged");
  EXPECT_EQ(written["case"]["cell"]["radius_um"], 7.66);
  EXPECT_EQ(entries_beside(), 1);
}

TEST_F(SolveCommand, ConvertsToPhysicalUnits) {
  run(solve("", {"--no-picture"}));
  const auto written = numbers();
  const double pi = std::acos(-1.0), r0 = 7.66;
  // The half circle of degree-4 pieces is off by 1e-5.
  EXPECT_NEAR(written["area_um2"].get<double>() / (pi * r0 * r0), 1, 1e-4);
  EXPECT_NEAR(written["volume_um3"].get<double>() / (4 * pi / 3 * r0 * r0 * r0), 1, 1e-4);
  // 1.5 U with U = Q / (pi R^2) = 0.04e-9 / (pi (10.94e-6)^2); rounding only.
  EXPECT_NEAR(written["cell_velocity_m_per_s"].get<double>() / (1.5 * 0.04e-9 / (pi * 10.94e-6 * 10.94e-6)), 1, 1e-12);
  EXPECT_TRUE(written["branch"][0]["young_modulus_kPa"].is_null());  // rigid
  EXPECT_NEAR(written["branch"][1]["young_modulus_kPa"].get<double>(), 2 * 3.437, 1e-12);
}

TEST_F(SolveCommand, TheWrittenCaseGivesTheSameResultAgain) {
  run(solve("", {"--no-picture"}));
  const auto first = numbers();
  auto again = solve("", {"--no-picture"});
  const auto copy = folder_.path() / "copy.toml";
  write_file(copy, content_of(result() / "case.toml"));
  again.arguments[2] = copy;
  EXPECT_EQ(run(again).exit_code, 0);
  EXPECT_EQ(numbers()["case_hash"], first["case_hash"]);
  EXPECT_EQ(numbers()["case"], first["case"]);
}

TEST_F(SolveCommand, JsonIsTheOnlyThingOnStandardOutput) {
  const auto ended = run(solve("", {"--no-picture", "--json"}));
  EXPECT_EQ(ended.out, content_of(result() / "result.json"));
  EXPECT_NE(ended.err.find("Newton"), std::string::npos);  // progress goes to standard error
}

TEST_F(SolveCommand, JsonNeedsNoFolder) {
  auto command = solve("", {"--json", "--quiet"});
  const auto option = std::find(command.arguments.begin(), command.arguments.end(), "-o");
  ASSERT_NE(option, command.arguments.end());
  command.arguments.erase(option, option + 2);
  const auto ended = run(command);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(json::parse(ended.out)["status"], "converged");
  EXPECT_FALSE(std::filesystem::exists(result()));
}

TEST_F(SolveCommand, QuietIsSilent) {
  const auto ended = run(solve("", {"--no-picture", "--quiet"}));
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.out + ended.err, "");
}

TEST_F(SolveCommand, EveryNumericalFailureIsExitCode3WithItsNameAndTheLastState) {
  for (const std::string failure : {"iteration-limit", "mesh-folded", "surface-unstable", "branch-ended",
                                    "singular-matrix", "not-finite", "accuracy-not-reached"}) {
    expect_sentence(run(solve(failure, {"--no-picture", "--quiet"})), failure + ": It failed at E = 1.2 kPa", 3);
    EXPECT_EQ(numbers()["status"], failure);
    EXPECT_GT(content_of(result() / "contour.csv").size(), 1000u);
  }
}

TEST_F(SolveCommand, ANumberThatIsNotFiniteIsNeverASuccess) {
  const auto ended = run(solve("nan", {"--no-picture"}));
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_EQ(numbers()["status"], "not-finite");
  EXPECT_TRUE(numbers()["pressure_drop_Pa"].is_null());
}

TEST_F(SolveCommand, ASignalStopsItWithTheLastStateWritten) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    auto slow = solve("slow", {"--no-picture"});
    slow.signal = signal;
    const auto ended = run(slow);
    EXPECT_EQ(ended.exit_code, 128 + signal);
    EXPECT_EQ(numbers()["status"], "stopped");
    EXPECT_LT(ended.seconds, 10);
  }
  EXPECT_EQ(entries_beside(), 1);
}

TEST_F(SolveCommand, AFullDiskLeavesTheOldResultAsItWas) {
  ASSERT_EQ(run(solve("", {"--no-picture"})).exit_code, 0);
  const auto before = content_of(result() / "result.json");
  for (const long bytes : {0L, 200L, 5000L}) {  // in case.toml, contour.csv, fields.vtu
    auto full = solve("", {"--no-picture", "--quiet"});
    full.max_file_bytes = bytes;
    const auto ended = run(full);
    EXPECT_EQ(ended.exit_code, 2) << bytes;
    if (bytes > 0) {  // at 0 bytes the sentence itself cannot be written
      EXPECT_NE(ended.err.find("older result is left as it was"), std::string::npos) << ended.err;
    }
    EXPECT_EQ(content_of(result() / "result.json"), before);
    EXPECT_EQ(entries_beside(), 1);
  }
}

TEST_F(SolveCommand, FieldsThatCannotBeWrittenLeaveTheOldResultAsItWas) {
  ASSERT_EQ(run(solve("", {"--no-picture"})).exit_code, 0);
  const auto before = content_of(result() / "result.json");
  for (const std::string failure : {"fields-throw", "fields-cut", "fields-false"}) {
    expect_sentence(run(solve(failure, {"--no-picture", "--quiet"})), "cannot write fields.vtu");
    EXPECT_EQ(content_of(result() / "result.json"), before);
    EXPECT_EQ(entries_beside(), 1);
  }
}

TEST_F(SolveCommand, AnErrorOfTheProgramItselfIsExitCode1) {
  expect_sentence(run(solve("throw", {"--no-picture", "--quiet"})), "please report it: a bug?of the solver", 1);
  EXPECT_EQ(entries_beside(), 0);
}

TEST_F(SolveCommand, TheUsersOwnFilesInAnOldResultAreKept) {
  ASSERT_EQ(run(solve("", {"--no-picture"})).exit_code, 0);
  write_file(result() / "notes.txt", "precious");
  write_file(result() / "picture.png", std::string("\x89PNG Software\0rheocyte", 22));
  ASSERT_EQ(run(solve("", {"--no-picture", "--set", "cell.radius_um=6"})).exit_code, 0);
  EXPECT_EQ(content_of(result() / "notes.txt"), "precious");
  EXPECT_FALSE(fs::exists(result() / "picture.png"));
  EXPECT_EQ(numbers()["case"]["cell"]["radius_um"], 6.0);
  EXPECT_EQ(entries_beside(), 1);
}

TEST_F(SolveCommand, PicturesOfOthersAreNeitherReplacedNorRemoved) {
  const Command with_fields{{RHEOCYTE, "solve", std::string(EXAMPLES) + "/paper-cell.toml", "-o", result(),
                             "--no-picture", "--quiet", "--set", "numerics.accuracy=1e-2"}};
  ASSERT_EQ(run(with_fields).exit_code, 0);
  write_file(result() / "picture.png", "theirs");
  expect_sentence(run(solve("", {"--no-picture"})),
                  "picture.png: already exists and was not written by rheocyte; move it away");
  expect_sentence(run({{RHEOCYTE, "picture", result()}}), "picture.png already exists and was not drawn by rheocyte");
  EXPECT_EQ(content_of(result() / "picture.png"), "theirs");
  fs::remove(result() / "picture.png");
  ASSERT_EQ(run({{RHEOCYTE, "picture", result()}}).exit_code, 0);
  ASSERT_EQ(run({{RHEOCYTE, "picture", result()}}).exit_code, 0) << "its own are";
}

TEST_F(SolveCommand, APictureThatFailsIsAWarning) {
  auto without_package = solve("", {"--quiet"});
  without_package.environment["RHEOCYTE_PYTHON"] = folder_.path();
  const auto ended = run(without_package);
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("warning: no picture"), std::string::npos) << ended.err;
  EXPECT_TRUE(fs::exists(result() / "result.json"));
}

}  // namespace
}  // namespace rheocyte::test::solve_command_test
