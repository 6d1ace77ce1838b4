// Virtual recordings for tests of `rheocyte population`.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "../robustness/run_program.h"
#include "analytic/effective_modulus.h"

namespace rheocyte::test::population_test {

namespace fs = std::filesystem;

/// Cells with a mean of Young's modulus, whose standard deviation is 15 % of it, under a tension.
inline std::string cells(double modulus_kPa, double tension_Pa = 500) {
  return fmt::format(R"([recording]
cells = 250
[channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15
axial_tension_Pa = {{mean = {}, sd = {}}}
[cell]
radius_um = {{mean = 6.3, sd = 0.4}}
[cell.bulk]
young_modulus_kPa = {{mean = {}, sd = {}, distribution = "lognormal"}}
[shapes]
table = "HE-3D-el-26"
)",
                     tension_Pa, 0.2 * tension_Pa, modulus_kPa, 0.15 * modulus_kPa);
}

/// Standard deviation of ln E of these cells, and ln of their median.
inline const double spread = std::sqrt(std::log1p(0.15 * 0.15));
inline double log_median(double modulus_kPa) { return std::log(modulus_kPa) - 0.5 * spread * spread; }

class PopulationCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    write_file(folder_.path() / "cells.toml", cells(4));
    write_file(folder_.path() / "drug.toml", cells(5.2));
  }

  Ended call(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), RHEOCYTE);
    return run({.arguments = arguments, .folder = folder_.path()});
  }
  void synth(const std::string& file, const std::vector<std::string>& settings,
             const std::string& spec = "cells.toml") const {
    std::vector<std::string> arguments{"synth", spec, "-o", file, "--quiet", "--force"};
    for (const auto& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
    const Ended ended = call(arguments);
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
  }
  nlohmann::json record(const fs::path& folder = "population") const {
    return nlohmann::json::parse(content_of(folder_.path() / folder / "population.json"));
  }
  /// What is written of the recordings of one condition.
  nlohmann::json fitted_recordings(const std::string& condition, const std::string& folder,
                                   const std::vector<std::string>& options) const {
    std::vector<std::string> words{"population", "--condition", condition, "-o", folder, "--quiet", "--no-picture"};
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_EQ(call(words).exit_code, 0);
    return record(folder)["recordings"];
  }

  TemporaryFolder folder_;
};

}  // namespace rheocyte::test::population_test
