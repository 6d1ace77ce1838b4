// What `rheocyte solve` does once its command line is known.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "fem/work_limits.h"

namespace rheocyte {

struct SolveOptions {
  std::filesystem::path case_file;
  std::filesystem::path folder;         ///< of the results; empty, with json: a stationary one is only printed
  std::filesystem::path continue_from;  ///< folder of an earlier result in time; empty: from the sphere
  std::filesystem::path start_from;     ///< folder of a result in time whose last state is the start; or empty
  std::vector<std::string> settings;    ///< "key=value"
  std::vector<std::string> gradients;   ///< keys, or "all"
  bool json = false;                    ///< result.json on standard output and nothing else there
  bool quiet = false;                   ///< no progress, no summary
  bool no_picture = false;
  bool no_output_fields = false;  ///< in time, no fields but those of the last state
  int threads = 0;                ///< at most; 0: all processors
  bool check_only = false;        ///< validate the case, solve nothing
};

/// When and with how many threads it works.
WorkLimits work_limits(const SolveOptions&);

/// Reads, solves, writes the folder, prints. Returns the exit code (exit_codes.h); UserError for the case and the disk.
int solve_case(const SolveOptions&);

}  // namespace rheocyte
