// `rheocyte table` with a spec of four branches, each in a moment, and what it has left in a folder.
#pragma once
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "run_program.h"

namespace rheocyte::test {

namespace fs = std::filesystem;

inline const std::string small_spec = R"([channel]
width_um = 20.0
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
[cell.bulk]
law = "linear"
[table]
identifier = "TEST"
min_area_um2 = 60
max_area_um2 = 120
max_deformation = 0.002
radii = 4
rows_per_radius = 10
accuracy = 1e-3
)";

class TableCommand : public testing::Test {
 protected:
  void SetUp() override { write_file(spec(), small_spec); }
  fs::path spec() const { return folder_.path() / "spec.toml"; }
  fs::path table(const std::string& name) const { return folder_.path() / name; }
  std::vector<std::string> command(const fs::path& output) const {
    return {RHEOCYTE, "table", spec().string(), "-o", output.string(), "--jobs", "2", "--no-picture"};
  }
  Ended make(const fs::path& output, std::map<std::string, std::string> environment = {}) const {
    return run({command(output), environment});
  }
  /// The table that `make` leaves, which is computed once for all tests.
  void copy_made(const fs::path& output) const {
    static const TemporaryFolder folder;
    const fs::path made = folder.path() / "made";
    if (!fs::exists(made)) {
      const Ended ended = make(made);
      ASSERT_EQ(ended.exit_code, 0) << ended.err;
    }
    fs::copy(made, output, fs::copy_options::recursive);
  }

  TemporaryFolder folder_;
};

/// Names and contents of the finished files.
inline std::map<std::string, std::string> finished(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) files[entry.path().filename().string()] = content_of(entry.path());
  }
  return files;
}

/// Names of the files that differ, are missing or are too many.
inline std::vector<std::string> differences(const fs::path& one, const fs::path& other) {
  const auto a = finished(one), b = finished(other);
  std::vector<std::string> names;
  for (const auto& [name, content] : a) {
    if (!b.contains(name) || b.at(name) != content) names.push_back(name);
  }
  for (const auto& [name, content] : b) {
    if (!a.contains(name)) names.push_back(name);
  }
  return names;
}

}  // namespace rheocyte::test
