// One call of a command on many recordings: each is read in a process of its own, so that a damaged one ends nothing
// but itself.
#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/exit_codes.h"
#include "case/user_error.h"
#include "events/isolated_reading.h"
#include "events/options.h"
#include "events/recording_list.h"
#include "store/isolated.h"
#include "store/standard_error.h"

namespace rheocyte {

/// The folder of a result, below that of all results, while the result is written. Folders that were made for it and
/// are empty in the end go again; that of all results stays, in which other calls may be about to write.
class ResultFolderGuard {
 public:
  /// Makes the folder. UserError.
  ResultFolderGuard(const std::filesystem::path& folder, const std::filesystem::path& of_all);
  ~ResultFolderGuard();
  ResultFolderGuard(const ResultFolderGuard&) = delete;
  ResultFolderGuard& operator=(const ResultFolderGuard&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the deepest last
};

/// The recordings of one call; says what was passed over, unless it is to be quiet. UserError as list_recordings.
std::vector<RecordingTask> tasks_of(const BatchOptions& options);

/// UserError if there is no such file: before anything is made for its results.
void check_is_there(const std::filesystem::path& recording);

/// Until a signal comes; the progress of a recording stands on the terminal, unless that is to be quiet.
Watch watch_of(const std::filesystem::path& recording, bool quiet);

/// As many as the options say, or the machine has processors.
int jobs_at_once(const BatchOptions&);
/// Threads that are left for each of so many recordings.
int threads_for_each(const BatchOptions&, std::size_t recordings);

/// The recordings of one call: some are read at once, and reported in their order. See run_batch.
template <class Job>
class RecordingBatch {
 public:
  RecordingBatch(std::span<const RecordingTask> tasks, const BatchOptions& options, double patience_s, Job& job)
      : options_(options), patience_s_(patience_s), job_(job) {
    for (const RecordingTask& task : tasks) turns_.push_back(std::make_unique<Turn>(task));
  }

  int run() {
    IsolatedPool pool(jobs_at_once(options_));
    for (const auto& turn : turns_) {
      if (was_stopped_) break;
      begin(*turn, pool);
      tell_in_order();
    }
    pool.wait_for_all();
    for (const auto& turn : turns_) tell_of(*turn);  // the last ones, or those that a stop has left behind
    if (was_stopped_) return exit_stopped();
    return failed_ ? exit_user_error : empty_ ? exit_numerical : exit_converged;
  }

 private:
  using Files = decltype(std::declval<Job&>().files(std::declval<const RecordingTask&>()));
  using Result = std::decay_t<decltype(std::declval<Job&>().work(
      std::declval<const RecordingTask&>(), std::declval<const Files&>(), std::declval<const TellProgress&>()))>;

  struct Turn {
    explicit Turn(const RecordingTask& of) : task(of) {}
    const RecordingTask& task;
    std::unique_ptr<ResultFolderGuard> place = {};  ///< until all have ended: others may write there
    std::optional<Files> files = {};
    bool has_ended = false, is_told = false;
    std::optional<Result> result = {};
    std::string sentence = {};  ///< without a result
  };

  /// What fails is known at once.
  void begin(Turn& turn, IsolatedPool& pool) {
    try {
      check_is_there(turn.task.recording);
      turn.place = std::make_unique<ResultFolderGuard>(turn.task.results.parent_path(), options_.folder);
      turn.files.emplace(job_.files(turn.task));
      Isolation limits;
      limits.patience_s = patience_s_;
      pool.start(
          [this, &turn](const TellProgress& report_progress) {
            return to_bytes(job_.work(turn.task, *turn.files, report_progress));
          },
          limits, {.progress = FileProgress(one_line(turn.task.recording.string(), 200), options_.quiet)},
          [this, &turn](IsolatedEnd end) {
            this->end(turn, isolated_from<Result>(std::move(end)));
            tell_in_order();
          });
    } catch (const UserError& error) {
      fail(turn, error.what());
    }
  }

  /// What has finished is there at once, whatever comes of the others.
  void end(Turn& turn, Isolated<Result> done) {
    if (done.stopped()) {
      was_stopped_ = true;
      turn.files.reset();
      return;
    }
    if (!done.finished()) return fail(turn, sentence_for(turn.task.recording, done.end, patience_s_));
    try {
      turn.files->publish();
      turn.files.reset();
      turn.result = std::move(done.result);
      turn.has_ended = true;
    } catch (const UserError& error) {
      fail(turn, error.what());
    }
  }

  void fail(Turn& turn, std::string sentence) {
    turn.files.reset();
    turn.sentence = std::move(sentence);
    turn.has_ended = true;
  }

  void tell_in_order() {
    for (const auto& turn : turns_) {
      if (!turn->has_ended) return;
      tell_of(*turn);
    }
  }

  void tell_of(Turn& turn) {
    if (!turn.has_ended || std::exchange(turn.is_told, true)) return;
    try {
      if (turn.result) {
        if (!job_.take(turn.task, *turn.result)) empty_ = true;
        return;
      }
    } catch (const UserError& error) {
      turn.sentence = error.what();
    }
    failed_ = true;
    tell(turn.sentence);
    job_.fail(turn.task, turn.sentence);
  }

  const BatchOptions& options_;
  double patience_s_;
  Job& job_;
  std::vector<std::unique_ptr<Turn>> turns_;
  bool was_stopped_ = false, failed_ = false, empty_ = false;
};

/// Runs a job on the recordings and returns the exit code: of a failure, if there was any, else of a recording without
/// any result. The job says by
///   files(task)                                   which files are made, with publish(); here, UserError
///   work(task, files, report_progress) -> Result    what is read and written; in a process of its own, UserError
///   take(task, result) -> bool                    what is reported of the result; false: it has no modulus
///   fail(task, sentence)                          what else is done about a failure, which is reported already
template <class Job>
int run_batch(std::span<const RecordingTask> tasks, const BatchOptions& options, double patience_s, Job& job) {
  return RecordingBatch<Job>(tasks, options, patience_s, job).run();
}

}  // namespace rheocyte
