// One call of a command on many recordings: each is read in a process of its own, so that a damaged one ends nothing
// but itself.
#pragma once
#include <span>
#include <string>

#include "app/exit_codes.h"
#include "case/user_error.h"
#include "extract/recording_list.h"
#include "store/contained.h"
#include "store/standard_error.h"

namespace rheocyte {

/// Makes the folders in which the results go. UserError.
void make_folders(std::span<const RecordingTask> tasks);

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
