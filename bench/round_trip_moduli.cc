// How well the moduli of virtual combined cells come back: round_trip_moduli RECORDING MODULI.tsv
//
// RECORDING: of `rheocyte synth` with cell.kind = "combined"; MODULI: what `rheocyte moduli` wrote for it. The truth is
// in the recording (userdef1, 2, 7, 8).
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "columns.h"
#include "numeric/quantile.h"
#include "program.h"

namespace {

using namespace rheocyte;

/// One modulus of many cells against the truth.
struct Tally {
  std::vector<double> ratio, error;  ///< estimate / truth - 1, and what the program says
  int in_68 = 0, in_90 = 0;

  void take(double estimate, double standard_error, double truth) {
    if (!std::isfinite(estimate) || !(truth > 0)) return;
    ratio.push_back(estimate / truth - 1);
    error.push_back(standard_error / estimate);
    in_68 += std::abs(estimate - truth) < 0.9945 * standard_error;
    in_90 += std::abs(estimate - truth) < 1.6449 * standard_error;
  }

  void print(const std::string& what) const {
    if (ratio.empty()) return fmt::print("  {}: none\n", what);
    auto off = ratio;
    for (double& r : off) r = std::abs(r);
    double mean = 0;
    for (const double r : ratio) mean += r / double(ratio.size());
    const auto percent = [&](int n) { return 100.0 * n / double(ratio.size()); };
    fmt::print(
        "  {}: bias {:+.1f} % (median), {:+.1f} % (mean); error {:.1f} % (median), 90 % below {:.1f} %; said {:.1f} %; "
        "in the 68 % interval {:.1f} %, in the 90 % interval {:.1f} %\n",
        what, 100 * quantile(ratio, 0.5), 100 * mean, 100 * quantile(off, 0.5), 100 * quantile(off, 0.9),
        100 * quantile(error, 0.5), percent(in_68), percent(in_90));
  }
};

/// Of the cells with one status, or of all.
struct Group {
  int cells = 0;
  Tally young, cortex, stiffness;
};

struct Truth {
  std::vector<double> radius, young, cortex;
};

void take(const std::string& line, const Truth& truth, std::map<std::string, Group>& groups) {
  std::istringstream fields(line);
  std::vector<double> number(13, NAN);  // up to chi_squared
  std::string word;
  for (double& n : number) fields >> word, n = std::stod(word);
  fields >> word;
  const auto i = static_cast<std::size_t>(number[0]) - 1;
  for (const auto& name : {word, std::string("all")}) {
    Group& group = groups[name];
    ++group.cells;
    group.young.take(number[4], number[5], truth.young.at(i));
    group.cortex.take(number[6], number[7], truth.cortex.at(i));
    group.stiffness.take(number[10], number[11], truth.young.at(i) + truth.cortex.at(i) / truth.radius.at(i));
  }
}

void report(const char* file, const char* moduli) {
  const Recording recording(file);
  const Truth truth{column(recording, "userdef1"), column(recording, "userdef2"), column(recording, "userdef7")};
  const auto deformation = column(recording, "userdef4");
  fmt::print("{}: {} cells, deformation {:.4f} ({:.4f} to {:.4f})\n", file, recording.events(),
             quantile(deformation, 0.5), quantile(deformation, 0.05), quantile(deformation, 0.95));
  std::ifstream lines(moduli);
  std::map<std::string, Group> groups;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#') && !line.starts_with("event")) take(line, truth, groups);
  for (const auto& [name, group] : groups) {
    fmt::print("{}: {} ({:.1f} %)\n", name, group.cells, 100.0 * group.cells / double(recording.events()));
    group.young.print("E");
    group.cortex.print("E2D");
    group.stiffness.print("E + E2D / r0");
  }
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc != 3) return fmt::print("round_trip_moduli RECORDING MODULI.tsv\n"), 2;
  report(argv[1], argv[2]);
  return 0;
}
