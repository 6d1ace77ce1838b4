#include "app/table_processes.h"

#include <fmt/format.h>
#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "app/exit_codes.h"
#include "case/user_error.h"
#include "store/child_process.h"
#include "store/progress.h"
#include "store/standard_error.h"
#include "store/stop_signal.h"
#include "table/table_folder.h"

namespace rheocyte {

namespace {

using namespace std::chrono_literals;

constexpr int greatest_replacements = 3;  ///< of killed workers without a finished branch in between
/// Workers that may end without a finished branch while one is free. More than one: between a look and the start of a
/// worker another machine may take the branch.
constexpr int greatest_fruitless = 3;
constexpr int rounds_between_looks = 10;

int number_in_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text && *text ? std::atoi(text) : otherwise;
}

std::string engine_program() { return (program_folder() / "rheocyte-engine").string(); }

// Once, before the workers would say it one by one.
void check_engine(const TableFolder& folder) {
  const ChildResult said =
      run_child({engine_program(), "table-worker", "--check", folder.path().string()}, {"OPENBLAS_NUM_THREADS=1"});
  if (said.exit_code != 0 && !signal_received())
    throw UserError(fmt::format("{}: cannot take part in this table ({}); build or install both programs together.",
                                engine_program(), said.last_line));
}

pid_t start_worker(const std::filesystem::path& folder) {
  ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
  const std::string engine = engine_program(), place = folder.string();
  const char* arguments[] = {engine.c_str(), "table-worker", place.c_str(), nullptr};
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, engine.c_str(), nullptr, nullptr, const_cast<char**>(arguments), environ);
  if (failed)
    throw UserError(fmt::format("cannot start {} ({}); build or install both programs.", engine,
                                std::generic_category().message(failed)));
  return child;
}

class Workers {
 public:
  Workers(const TableFolder& folder, int jobs, bool quiet)
      : folder_(folder), progress_("branches", folder.branches(), folder.done(), quiet), quiet_(quiet) {
    for (int i = 0; i < jobs; ++i) children_.insert(start_worker(folder.path()));
  }
  ~Workers() {
    for (const pid_t child : children_) ::kill(child, SIGTERM);
    for (const pid_t child : children_) ::waitpid(child, nullptr, 0);
  }

  ProcessesEnd wait() {
    ProcessesEnd end;
    for (int done = folder_.done();; std::this_thread::sleep_for(100ms), done = folder_.done()) {
      if (done > done_) done_ = done, replacements_ = 0, fruitless_ = 0;
      progress_.show(done);
      end.complete = done == folder_.branches();
      end.signal = signal_received();
      collect(end);
      if (end.complete || end.signal || end.worker_code) break;
      if (children_.empty() && idle_++ % rounds_between_looks == 0) look_again(end);
    }
    progress_.finish();
    return end;
  }

 private:
  void collect(ProcessesEnd& end) {
    int status = 0;
    for (pid_t child = ::waitpid(-1, &status, WNOHANG); child > 0; child = ::waitpid(-1, &status, WNOHANG)) {
      children_.erase(child);
      if (WIFEXITED(status) && WEXITSTATUS(status) != 0) end.worker_code = WEXITSTATUS(status);
      if (!WIFSIGNALED(status) || end.complete) continue;
      if (replacements_++ < greatest_replacements) {
        children_.insert(start_worker(folder_.path()));
      } else {
        tell(fmt::format("rheocyte: the solver's processes are killed again and again (signal {}); is memory short?",
                         WTERMSIG(status)));
        end.worker_code = exit_own_bug;
      }
    }
  }

  // All of ours have ended, and branches are missing: others work on them, or were lost, or ours do not want them.
  void look_again(ProcessesEnd& end) {
    const auto free = folder_.first_free();
    if (!free) {
      if (!quiet_ && !std::exchange(has_told_, true)) tell("the rest is being computed by other processes");
      return;
    }
    if (fruitless_++ < greatest_fruitless) {
      children_.insert(start_worker(folder_.path()));
    } else {
      tell(
          fmt::format("rheocyte: {} is missing, and {} ends without computing it; build or install both programs "
                      "together and start again with the same command, what is finished is kept.",
                      folder_.missing_record(*free).string(), engine_program()));
      end.worker_code = exit_own_bug;
    }
  }

  const TableFolder& folder_;
  Progress progress_;
  bool quiet_, has_told_ = false;
  std::set<pid_t> children_;
  int done_ = 0, replacements_ = 0, fruitless_ = 0, idle_ = 0;
};

}  // namespace

Rank rank_from_environment() {
  for (const auto& [rank, size] : {std::pair{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                   {"PMI_RANK", "PMI_SIZE"},
                                   {"SLURM_PROCID", "SLURM_NTASKS"}}) {
    const int count = number_in_environment(size, 1), number = number_in_environment(rank, -1);
    if (number >= 0 && count > 1) return {number, count};
  }
  return {};
}

int available_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  return std::max(1u, std::thread::hardware_concurrency());
}

ProcessesEnd run_workers(const TableFolder& folder, int jobs, bool quiet) {
  folder.take_over();
  const int left = folder.branches() - folder.done();
  watch_signals();
  if (left > 0) check_engine(folder);
  return Workers(folder, std::min(jobs, std::max(left, 1)), quiet).wait();
}

}  // namespace rheocyte
