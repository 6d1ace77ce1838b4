// `rheocyte solve` of a case with a [time] section: its folder, its restart, its refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../robustness/run_program.h"

namespace rheocyte::test::solve_in_time_test {
namespace {

namespace fs = std::filesystem;

class InTime : public testing::Test {
 protected:
  fs::path at(const std::string& name) const { return folder_.path() / name; }

  Command solve(const std::string& name, const std::vector<std::string>& more = {}) const {
    Command command{{RHEOCYTE, "solve", std::string(EXAMPLES) + "/paper-cell-in-time.toml", "-o", at(name),
                     "--no-picture", "--quiet", "--set", "time.degree=3", "--set", "time.output_every_us=5"}};
    command.arguments.insert(command.arguments.end(), more.begin(), more.end());
    return command;
  }
  std::string text(const std::string& name) const { return content_of(folder_.path() / name); }
  /// The command once more, with "killed" as the folder of its result: killed, and continued.
  void kill_and_continue(Command command) const {
    command.arguments[4] = at("killed");
    command.signal = SIGKILL;
    EXPECT_EQ(run(command).exit_code, 128 + SIGKILL);
    command.signal = 0;
    command.arguments.insert(command.arguments.end(), {"--continue", at("killed")});
    ASSERT_EQ(run(command).exit_code, 0);
  }

  TemporaryFolder folder_;
};

TEST_F(InTime, WritesEveryFile) {
  const auto ended = run(solve("result", {"--set", "time.end_us=12"}));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (const auto* file : {"result.json", "contour.csv", "fields.vtu", "case.toml", "history.csv", "contours.csv",
                           "fields.pvd", "checkpoint-1.bin", "history_errors.csv", "outputs_errors.csv"})
    EXPECT_TRUE(fs::exists(at("result") / file)) << file;
  // Outputs at 0, 5, 10 us and the end.
  EXPECT_EQ(std::distance(fs::directory_iterator(at("result") / "fields"), {}), 4);
  const auto numbers = nlohmann::json::parse(text("result/result.json"));
  EXPECT_EQ(numbers["status"], "converged");
  EXPECT_DOUBLE_EQ(numbers["time"]["t_us"], 12);
  EXPECT_LT(numbers["time"]["greatest_relative_volume_change"], 1e-6);
  // Errors line by line, under the same names.
  const auto count_lines = [](const std::string& table) { return std::count(table.begin(), table.end(), '\n'); };
  for (const std::string file : {"history", "outputs"}) {
    const std::string table = text("result/" + file + ".csv"), errors = text("result/" + file + "_errors.csv");
    EXPECT_EQ(count_lines(errors), count_lines(table)) << file;
    EXPECT_TRUE(errors.starts_with("t_us,position_um,deformation,")) << errors;
  }
  const std::string outputs = text("result/outputs.csv"), outputs_errors = text("result/outputs_errors.csv");
  EXPECT_EQ(outputs.substr(0, outputs.find('\n')), outputs_errors.substr(0, outputs_errors.find('\n')));
}

TEST_F(InTime, TheEndIsComparedWithTheStationaryShape) {
  // Early it has not settled and its error is that of its steps and its mesh, from coarser ones; at last the distance
  // is the error of the mesh, which is stated.
  ASSERT_EQ(run(solve("early", {"--set", "time.end_us=20"})).exit_code, 0);
  ASSERT_EQ(run(solve("late", {"--set", "time.end_us=1500"})).exit_code, 0);
  const auto early = nlohmann::json::parse(text("early/result.json")),
             late = nlohmann::json::parse(text("late/result.json"));
  const double stationary = late["time"]["stationary_deformation"];
  EXPECT_DOUBLE_EQ(early["time"]["stationary_deformation"], stationary);
  EXPECT_NE(early["message"].get<std::string>().find("A mesh of degree 2 changes its last deformation by"),
            std::string::npos)
      << early["message"];
  EXPECT_EQ(early["time"]["comparison"], "converged");
  EXPECT_NE(early["message"].get<std::string>().find("Steps with time.accuracy = 0.0001 change it by"),
            std::string::npos)
      << early["message"];
  // The numbers of the way have errors from the same run with other steps and on the other mesh, that of the stationary
  // shape from its own meshes.
  const auto& errors = early["time"]["errors"];
  for (const auto* number : {"position_um", "least_tension_mN_per_m", "greatest_relative_volume_change"}) {
    EXPECT_GE(errors[number], 0) << number;
    EXPECT_GE(late["time"]["errors"][number], 0) << number;
  }
  EXPECT_EQ(errors["t_us"], 0);
  EXPECT_GT(errors["position_um"], 0);
  EXPECT_LT(errors["position_um"], 2e-3 * early["time"]["position_um"].get<double>()) << "1.2e-3, mostly of the steps";
  EXPECT_GT(errors["stationary_deformation"], 0);
  EXPECT_LT(errors["stationary_deformation"], 1e-3 * stationary);
  EXPECT_EQ(late["time"]["comparison"], "converged");
  EXPECT_GT(early["estimated_error"], 1e-5);
  EXPECT_LT(early["estimated_error"], 0.1);
  EXPECT_NE(early["message"].get<std::string>().find("it has not settled"), std::string::npos) << early["message"];
  EXPECT_NE(late["message"].get<std::string>().find("the cell has settled"), std::string::npos) << late["message"];
  const double distance = std::abs(late["deformation"].get<double>() / stationary - 1);
  EXPECT_GT(distance, 5e-5) << "degree 3 is coarse";
  EXPECT_NEAR(late["estimated_error"], distance, 1e-4);
}

TEST_F(InTime, EndsAndOutputsCanBeGivenByPlace) {
  // Outputs at 0, 1, 2 um and the end; places to 1e-6 um, as the run's position is a number like others.
  const auto by_place = [&](const std::string& name, const std::string& end,
                            const std::vector<std::string>& more = {}) {
    Command command = solve(name, {"--set", "time.end_um=" + end});
    std::ranges::replace(command.arguments, std::string("time.output_every_us=5"),
                         std::string("time.output_every_um=1"));
    command.arguments.insert(command.arguments.end(), more.begin(), more.end());
    return run(command);
  };
  const auto ended = by_place("way", "2.5");
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  std::istringstream lines(text("way/outputs.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_TRUE(line.starts_with("t_us,position_um,deformation,")) << line;
  std::vector<double> places;
  while (std::getline(lines, line)) places.push_back(std::stod(line.substr(line.find(',') + 1)));
  ASSERT_EQ(places.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(places[i], std::min(1.0 * i, 2.5), 1e-6);
  const auto numbers = nlohmann::json::parse(text("way/result.json"));
  EXPECT_EQ(numbers["time"]["ended_by"], "place");
  EXPECT_NEAR(numbers["time"]["position_um"], 2.5, 1e-6);
  EXPECT_EQ(by_place("further", "4", {"--continue", at("way")}).exit_code, 0);
  const auto beyond = by_place("beyond", "1", {"--continue", at("way")});
  EXPECT_EQ(beyond.exit_code, 2);
  EXPECT_NE(beyond.err.find("must be larger"), std::string::npos) << beyond.err;
}

TEST_F(InTime, ACompressedShellIsTold) {
  // A shell without tension and bending stiffness, pulled along by the flow, is slack at its rear from the start.
  const auto ended = run(solve("shell", {"--set", "time.end_us=5", "--set", "cell.bulk.law=none", "--set",
                                         "cell.cortex.law=neo-hookean", "--set", "cell.cortex.modulus_mN_per_m=20"}));
  const auto numbers = nlohmann::json::parse(text("shell/result.json"));
  EXPECT_EQ(ended.exit_code, 3) << "its last state is beyond the limit";
  EXPECT_EQ(numbers["status"], "surface-unstable");
  EXPECT_EQ(numbers["time"]["ended_by"], "time");
  EXPECT_LT(numbers["stability_margin"], 0);
  EXPECT_LT(numbers["time"]["least_tension_mN_per_m"], 0);
  EXPECT_NE(numbers["message"].get<std::string>().find("beyond its limit against short wrinkles"), std::string::npos)
      << numbers["message"];
}

TEST_F(InTime, WhatItsMessageDisownsIsNoSuccess) {
  // A shell that wants 1 % of its mesh, whose last deformation another mesh changes by 9 %, and whose surface is beyond
  // its limit: exit code 3, one status in file and message, and a way out.
  const fs::path given = fs::path(EXAMPLES) / "../../shared/cases/time-18-percent.toml";
  if (!fs::exists(given)) GTEST_SKIP() << given << " is not there";
  const auto ended = run({{RHEOCYTE, "solve", given, "-o", at("shell"), "--no-picture", "--quiet"}});
  const auto numbers = nlohmann::json::parse(text("shell/result.json"));
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_EQ(numbers["status"], "surface-unstable") << numbers["message"];
  EXPECT_NE(ended.err.find("rheocyte: surface-unstable: "), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("raise the moduli"), std::string::npos) << ended.err;
}

TEST_F(InTime, ARestartContinuesToTheBit) {
  // The second part begins where the first one ended and repeats none of its rows, whichever folder it is written to; a
  // run that has arrived stays as it is. (tests/solve: a resumed state takes the same steps, bit by bit.)
  ASSERT_EQ(run(solve("first", {"--set", "time.end_us=20"})).exit_code, 0);
  ASSERT_EQ(run(solve("second", {"--set", "time.end_us=60", "--continue", at("first")})).exit_code, 0);
  ASSERT_EQ(run(solve("third", {"--set", "time.end_us=60", "--continue", at("second")})).exit_code, 0);
  EXPECT_EQ(text("second/history.csv"), text("third/history.csv"));
  EXPECT_EQ(text("second/contours.csv"), text("third/contours.csv"));
  EXPECT_TRUE(text("second/history.csv").starts_with(text("first/history.csv")));
  EXPECT_TRUE(text("second/contours.csv").starts_with(text("first/contours.csv")));
  ASSERT_EQ(run(solve("first", {"--set", "time.end_us=60", "--continue", at("first")})).exit_code, 0);  // in place
  EXPECT_EQ(text("first/history.csv"), text("second/history.csv"));
  // Its error is that of a run that was not interrupted, but for the step that ended at 20 us.
  ASSERT_EQ(run(solve("whole", {"--set", "time.end_us=60"})).exit_code, 0);
  const auto whole = nlohmann::json::parse(text("whole/result.json"));
  for (const auto* name : {"first/result.json", "third/result.json"}) {
    const auto continued = nlohmann::json::parse(text(name));
    const double error = whole["estimated_error"];
    EXPECT_NEAR(continued["estimated_error"].get<double>(), error, 0.05 * error) << name;
    EXPECT_EQ(continued["time"]["comparison"], whole["time"]["comparison"]) << name;
    // Of all steps, those before the checkpoint, too.
    const std::string folder = std::string(name).substr(0, std::string(name).find('/'));
    const std::string rows = text(folder + "/history.csv"), errors = text(folder + "/history_errors.csv");
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), std::count(rows.begin(), rows.end(), '\n')) << name;
  }
}

TEST_F(InTime, AKilledRunGoesOnFromItsHiddenFolder) {
  // kill -9 after the first step is reported: its checkpoint is found by the name of the result, and what goes on from
  // there equals the undisturbed run byte by byte. Once the result is there, nothing hidden is left.
  ASSERT_EQ(run(solve("undisturbed", {"--set", "time.end_us=60"})).exit_code, 0);
  auto command = solve("killed", {"--set", "time.end_us=60"});
  std::erase(command.arguments, "--quiet");
  command.signal = SIGKILL;
  EXPECT_EQ(run(command).exit_code, 128 + SIGKILL);
  EXPECT_FALSE(fs::exists(at("killed")));
  for (const char* name : {"continued", "killed"}) {
    const auto ended = run(solve(name, {"--set", "time.end_us=60", "--continue", at("killed")}));
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(text(name + std::string("/history.csv")), text("undisturbed/history.csv"));
    EXPECT_EQ(text(name + std::string("/contours.csv")), text("undisturbed/contours.csv"));
  }
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
}

TEST_F(InTime, WhoStartsAnewIsToldOfAKilledRun) {
  auto command = solve("killed", {"--set", "time.end_us=60"});
  std::erase(command.arguments, "--quiet");
  command.signal = SIGKILL;
  ASSERT_EQ(run(command).exit_code, 128 + SIGKILL);
  const auto anew = run(solve("killed", {"--set", "time.end_us=1"}));
  EXPECT_EQ(anew.exit_code, 0);
  EXPECT_NE(anew.err.find("was interrupted; --continue"), std::string::npos) << anew.err;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "the new result is there";
}

TEST_F(InTime, AChannelEntryWritesTheWallAndKeepsWhatItHasWhenItFails) {
  // The wall goes from one radius of the table to the other; a cell that is far too soft for the contraction ends with
  // exit code 3, its last good state and its history.
  const auto enter = [&](const std::string& name, double young_modulus_kPa, double end_us) {
    return run({{RHEOCYTE, "solve", std::string(EXAMPLES) + "/channel-entry.toml", "-o", at(name), "--no-picture",
                 "--quiet", "--set", "time.degree=3", "--set", "time.accuracy=1e-3", "--set",
                 "time.output_every_us=500", "--set", "time.end_us=" + std::to_string(end_us), "--set",
                 "cell.bulk.young_modulus_kPa=" + std::to_string(young_modulus_kPa)}});
  };
  ASSERT_EQ(enter("sound", 4.58, 100).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(text("sound/result.json"))["time"]["ended_by"], "time");
  const std::string wall = text("sound/channel.csv");
  EXPECT_TRUE(wall.starts_with("x_um,R_um\n"));
  EXPECT_NE(wall.find(",21.88\n"), std::string::npos);
  EXPECT_TRUE(wall.ends_with(",10.94\n"));
  const auto ended = enter("soft", 0.1, 5000);
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_NE(ended.err.find("the last good state is kept"), std::string::npos) << ended.err;
  const auto numbers = nlohmann::json::parse(text("soft/result.json"));
  EXPECT_NE(numbers["status"], "converged");
  EXPECT_TRUE(numbers["deformation"].is_number());
  EXPECT_GT(numbers["time"]["steps"], 10);
  EXPECT_TRUE(fs::exists(at("soft") / "checkpoint-1.bin"));
}

TEST_F(InTime, AFunnelIntoASquareWritesBothViewsAndGoesOnWhenKilled) {
  // The wall goes from half of one width to half of the other; a killed run goes on with the factors that it kept, so
  // byte by byte as an undisturbed one.
  const Command command{{RHEOCYTE, "solve", std::string(EXAMPLES) + "/transit-square.toml", "-o", at("whole"),
                         "--no-picture", "--set", "time.degree=2", "--set", "time.output_every_um=1", "--set",
                         "time.end_um=4", "--set", "channel.profile.x_um=[3, 8]", "--set",
                         "channel.profile.width_um=[30, 20]"}};
  const auto whole = run(command);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const std::string outputs = text("whole/outputs.csv"), wall = text("whole/channel.csv");
  EXPECT_EQ(std::count(outputs.begin(), outputs.end(), '\n'), 6);  // the head, 0 to 4 um
  EXPECT_NE(outputs.find(",deformation_side,deformation_across,"), std::string::npos) << outputs;
  EXPECT_NE(wall.find(",14.99999"), std::string::npos);
  EXPECT_TRUE(wall.ends_with(",10.000004\n")) << wall;
  EXPECT_EQ(nlohmann::json::parse(text("whole/result.json"))["time"]["ended_by"], "place");
  ASSERT_NO_FATAL_FAILURE(kill_and_continue(command));
  EXPECT_EQ(text("killed/history.csv"), text("whole/history.csv"));
  EXPECT_EQ(text("killed/contours.csv"), text("whole/contours.csv"));
  // The outline seen along the width has the same outputs; in the funnel it is another one.
  const std::string across = text("whole/contours_across.csv");
  EXPECT_EQ(text("killed/contours_across.csv"), across);
  EXPECT_TRUE(across.starts_with("t_us,x_um,r_um\n0,"));
  EXPECT_NE(across, text("whole/contours.csv"));
}

TEST_F(InTime, ACellOffTheAxisOfAFunnelTellsItsPlaceAndGoesOnWhenKilled) {
  const Command command{{RHEOCYTE, "solve", std::string(EXAMPLES) + "/transit-off-axis.toml", "-o", at("whole"),
                         "--no-picture", "--set", "time.degree=2", "--set", "time.output_every_um=1", "--set",
                         "time.end_um=3", "--set", "channel.profile.x_um=[3, 8]", "--set",
                         "channel.profile.width_um=[30, 20]", "--set", "cell.offset_um=[2, 0]"}};
  const auto whole = run(command);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const std::string outputs = text("whole/outputs.csv"), outlines = text("whole/contours_offset.csv");
  for (const char* column :
       {",drift_velocity_m_per_s", ",rotation_rate_per_s", ",offset_um", ",sine_mode_2", ",flank_slope"})
    EXPECT_NE(outputs.find(column), std::string::npos) << outputs;
  EXPECT_TRUE(outlines.starts_with("t_us,x_um,y_um\n0,5.999")) << outlines.substr(0, 60);
  const double offset = nlohmann::json::parse(text("whole/result.json"))["offset_um"];
  EXPECT_LT(offset, 2);
  EXPECT_GT(offset, 1);
  ASSERT_NO_FATAL_FAILURE(kill_and_continue(command));
  EXPECT_EQ(text("killed/history.csv"), text("whole/history.csv"));
  EXPECT_EQ(text("killed/contours_offset.csv"), outlines);
}

TEST_F(InTime, ARunThatStopsTellsThatTheCellHasNoStationaryShape) {
  // The paper's cell with less than a third of its modulus is drawn out in the straight channel.
  const auto ended = run(solve("soft", {"--set", "cell.bulk.young_modulus_kPa=1", "--set", "time.end_us=2000"}));
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_NE(ended.err.find("There is no stationary shape of this cell (surface-unstable)."), std::string::npos)
      << ended.err;
}

TEST_F(InTime, ACellThatWillNotSettleIsConvergedWhereItIs) {
  // The same cell after 20 us: its shape there is right, and the message states that it goes on changing.
  const auto ended = run(solve("soft", {"--set", "cell.bulk.young_modulus_kPa=1", "--set", "time.end_us=20"}));
  const auto numbers = nlohmann::json::parse(text("soft/result.json"));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(numbers["message"].get<std::string>().find("it has not settled, and will not"), std::string::npos)
      << numbers["message"];
}

TEST_F(InTime, AnotherCaseStartsFromALastState) {
  // From its own end state nothing but the formulas' start changes: d at 40 + 20 us as in one run, within 1e-5. With
  // ten times less flow the cell relaxes towards the sphere. Other sizes are refused.
  const auto deformation = [&](const std::string& name) {
    return nlohmann::json::parse(text(name + "/result.json"))["deformation"].get<double>();
  };
  ASSERT_EQ(run(solve("whole", {"--set", "time.end_us=60"})).exit_code, 0);
  ASSERT_EQ(run(solve("first", {"--set", "time.end_us=40"})).exit_code, 0);
  ASSERT_EQ(run(solve("second", {"--set", "time.end_us=20", "--start", at("first")})).exit_code, 0);
  EXPECT_NEAR(deformation("second"), deformation("whole"), 1e-5);
  const auto slow = run(solve("slow", {"--set", "time.end_us=100", "--start", at("whole"), "--set",
                                       "flow.rate_ul_per_s=0.004", "--set", "time.output_every_us=50"}));
  ASSERT_EQ(slow.exit_code, 0) << slow.err;
  EXPECT_LT(deformation("slow"), 0.3 * deformation("whole"));
  const auto refused = run(solve("never", {"--start", at("whole"), "--set", "cell.radius_um=6"}));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("differs too much from this case"), std::string::npos) << refused.err;
  EXPECT_EQ(run(solve("never", {"--start", at("nowhere")})).exit_code, 2);
}

TEST_F(InTime, InASquareACaseStartsFromALastStateInTheSameDuct) {
  // No inertia, as a message states. As in the tube: d at 100 + 50 us is that of one run within the accuracy of the
  // steps, the cell's place begins at 0, with ten times less flow the cell relaxes. Another width is refused, and a
  // tube.
  write_file(folder_.path() / "square.toml", R"([channel]
section = "square"
width_um = 20.0
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
[cell]
radius_um = 6.0
viscosity_mPas = 15.0
[cell.bulk]
young_modulus_kPa = 4.0
[time]
end_us = 150
output_every_us = 25
accuracy = 1e-4
degree = 2
)");
  const auto run_in_square = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.begin(), {RHEOCYTE, "solve", at("square.toml"), "-o", at(name), "--no-picture", "--quiet",
                               "--no-output-fields"});
    return run({more});
  };
  const auto of = [&](const std::string& name) { return nlohmann::json::parse(text(name + "/result.json")); };
  ASSERT_EQ(run_in_square("whole", {}).exit_code, 0);
  EXPECT_FALSE(fs::exists(at("whole") / "fields.pvd"));
  EXPECT_TRUE(fs::exists(at("whole") / "fields.vtu"));
  ASSERT_EQ(run_in_square("first", {"--set", "time.end_us=100"}).exit_code, 0);
  ASSERT_EQ(run_in_square("second", {"--set", "time.end_us=50", "--start", at("first")}).exit_code, 0);
  const double whole = of("whole")["deformation"];
  // rho v R / eta = 1000 kg/m3 x 0.15 m/s x 10 um / 15 mPa s; v is half again the mean velocity.
  EXPECT_NEAR(of("whole")["reynolds"], 0.1, 0.03);
  const std::string message = of("whole")["message"];
  EXPECT_NE(message.find("Inertia is left out (Reynolds number 0.1"), std::string::npos) << message;
  EXPECT_NEAR(of("second")["deformation"], whole, 1e-4);
  const double way = of("whole")["time"]["position_um"], part = of("first")["time"]["position_um"];
  EXPECT_NEAR(of("second")["time"]["position_um"], way - part, 1e-3 * way);
  const auto slow =
      run_in_square("slow", {"--start", at("whole"), "--set", "flow.rate_ul_per_s=0.004", "--set", "time.end_us=300"});
  ASSERT_EQ(slow.exit_code, 0) << slow.err;
  EXPECT_LT(of("slow")["deformation"], 0.3 * whole);
  expect_sentence(run_in_square("never", {"--start", at("whole"), "--set", "channel.width_um=22"}),
                  "differs too much from this case");
  const auto tube = solve("never", {"--start", at("whole")});
  expect_sentence(run(tube), "differs too much from this case");
}

TEST_F(InTime, RefusesWhatCannotBeContinued) {
  ASSERT_EQ(run(solve("first", {"--set", "time.end_us=5"})).exit_code, 0);
  const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
    const auto ended = run(solve("second", more));
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(at("second")));
  };
  refused({"--continue", at("first"), "--set", "cell.radius_um=6"}, "another case");
  refused({"--continue", at("first"), "--set", "time.end_us=2"}, "must be larger");
  refused({"--continue", at("nowhere")}, "contains no checkpoint");
  const auto stationary = run(
      {{RHEOCYTE, "solve", std::string(EXAMPLES) + "/paper-cell.toml", "-o", at("second"), "--continue", at("first")}});
  EXPECT_EQ(stationary.exit_code, 2);
  EXPECT_NE(stationary.err.find("--continue is for a case with a [time] section"), std::string::npos) << stationary.err;
}

}  // namespace
}  // namespace rheocyte::test::solve_in_time_test
