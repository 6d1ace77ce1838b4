// One call of a command on many recordings: each is read in a process of its own, so that a damaged one ends nothing
// but itself.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/exit_codes.h"
#include "case/user_error.h"
#include "extract/options.h"
#include "extract/recording_list.h"
#include "store/contained.h"
#include "store/standard_error.h"

namespace rheocyte {

/// The folder of a result, below that of all results, while the result is written. Folders that were made for it and
/// are empty in the end go again; that of all results stays, in which other calls may be about to write.
class ResultPlace {
 public:
  /// Makes the folder. UserError.
  ResultPlace(const std::filesystem::path& folder, const std::filesystem::path& of_all);
  ~ResultPlace();
  ResultPlace(const ResultPlace&) = delete;
  ResultPlace& operator=(const ResultPlace&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the deepest last
};

/// The recordings of one call; says what was passed over, unless it is to be quiet. UserError as list_recordings.
std::vector<RecordingTask> tasks_of(const BatchOptions& options);

/// UserError if there is no such file: before anything is made for its results.
void check_is_there(const std::filesystem::path& recording);

/// What `read(tell_progress)` gives of a recording, in a process of its own. UserError with the reason if it gives
/// nothing.
template <class Read>
auto read_contained(const std::filesystem::path& recording, const MeasuringOptions& measuring, bool quiet,
                    const Read& read) {
  Containment limits;
  limits.patience_s = measuring.patience_s.value_or(default_patience_s);
  auto done = run_contained(read, limits, FileProgress(one_line(recording.string(), 200), quiet));
  if (!done.finished()) throw UserError(sentence_for(recording, done.end, limits.patience_s));
  return std::move(done.result);
}

/// Runs a job on the recordings in turn and returns the exit code: of a failure, if there was any, else of a recording
/// without any result. The job says by
///   files(task)                                   which files are made, with publish(); here, UserError
///   work(task, files, tell_progress) -> Result    what is read and written; in a process of its own, UserError
///   take(task, result) -> bool                    what is told of the result; false: it has no modulus
///   fail(task, sentence)                          what else is done about a failure, which is told already
template <class Job>
int run_batch(std::span<const RecordingTask> tasks, const BatchOptions& options, double patience_s, Job& job) {
  bool failed = false, empty = false;
  for (const auto& task : tasks) {
    std::string sentence;
    try {
      check_is_there(task.recording);
      const ResultPlace place(task.results.parent_path(), options.folder);
      auto files = job.files(task);
      const auto work = [&](const TellProgress& tell_progress) { return job.work(task, files, tell_progress); };
      Containment limits;
      limits.patience_s = patience_s;
      const auto done =
          run_contained(work, limits, FileProgress(one_line(task.recording.string(), 200), options.quiet));
      if (done.stopped()) return exit_stopped();
      if (done.finished()) {
        files.publish();
        if (!job.take(task, done.result)) empty = true;
        continue;
      }
      sentence = sentence_for(task.recording, done.end, patience_s);
    } catch (const UserError& error) {
      sentence = error.what();
    }
    failed = true;
    tell(sentence);
    job.fail(task, sentence);
  }
  return failed ? exit_user_error : empty ? exit_numerical : exit_converged;
}

}  // namespace rheocyte
