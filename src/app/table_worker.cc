#include "app/table_worker.h"

#include <sys/prctl.h>

#include <csignal>

#include "app/exit_codes.h"
#include "solve/outcome.h"
#include "store/stop_signal.h"
#include "table/sample_branch.h"
#include "table/table_folder.h"

namespace rheocyte {

namespace {

bool is_stopped(const SampledBranch& branch) { return branch.end.status == name(Status::stopped); }

/// False if a signal ended it.
bool sample_place(const TableFolder& folder, int i) {
  if (!folder.has(i, false)) {
    const SampledBranch own = sample_branch(folder.spec(), folder.place(i), &stop_wanted());
    if (is_stopped(own)) return false;
    folder.keep(i, own, false);
  }
  if (!folder.wants_held() || folder.has(i, true)) return true;
  // Read back: an interrupted table goes on from the record, and its bytes must not depend on that.
  const SampledBranch held = sample_held_branch(folder.spec(), folder.read(i, false), &stop_wanted());
  if (is_stopped(held)) return false;
  folder.keep(i, held, true);
  return true;
}

TableFolder opened(const std::filesystem::path& path) { return {path, read_table_spec(path / "spec.toml")}; }

}  // namespace

void check_table(const std::filesystem::path& path) { opened(path); }

int work_on_table(const std::filesystem::path& path) {
  watch_signals();
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // no work for nobody when the command is killed
  const TableFolder folder = opened(path);
  for (int i = 0; i < folder.branches(); ++i) {
    if (folder.is_done(i)) continue;
    const Claim claim = folder.claim(i);
    if (!claim || folder.is_done(i)) continue;  // somebody else works on it, or has just finished it
    if (!sample_place(folder, i)) return exit_signal + signal_received();
  }
  return exit_converged;
}

}  // namespace rheocyte
