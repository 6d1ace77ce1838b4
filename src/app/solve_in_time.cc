#include "app/solve_in_time.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/checkpoint.h"
#include "app/exit_codes.h"
#include "app/finish_result.h"
#include "case/scales.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "result/judge_end.h"
#include "result/plural.h"
#include "result/result_in_time.h"
#include "result/write_result.h"
#include "store/standard_error.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

// The first one at once, later ones less and less often: a run that is killed has lost half of its time at most.
constexpr std::chrono::duration<double> min_time_between_checkpoints(0.25), max_time_between_checkpoints(10);
constexpr const char* fields_folder = "fields";

/// Keeps the record of a computation and writes what must not be lost.
class Recorder {
 public:
  Recorder(const Result& result, const SolveOptions& options, ResultFolder& folder)
      : result_(result), options_(options), folder_(folder) {
    if (!options.no_output_fields) fs::create_directory(folder_.scratch() / fields_folder);
  }

  /// Takes over what an earlier run has recorded, its field files included.
  void take_over(const FoundCheckpoint& from) {
    const TimeRecord& record = from.checkpoint.record;
    record_ = record;
    last_state_ = from.checkpoint.state;
    if (options_.no_output_fields) return;
    for (std::size_t i = 0; i < record.frames.size(); ++i) {
      const fs::path file = fs::path(fields_folder) / to_path(field_file(i));
      std::error_code error;
      fs::copy_file(from.folder / file, folder_.scratch() / file, error);
      if (error)
        throw UserError(fmt::format("{}: cannot be copied ({}); start again without --continue.",
                                    (from.folder / file).string(), error.message()));
    }
  }

  TimeObserver observer() {
    return {[this](const TimeFrame& frame) { add(frame); },
            [this](const TimePoint& point, const TimeState& state) { add(point, state); },
            [this](const TimeWay& errors) { add_errors(errors, result_.scales, record_); }};
  }

  TimeRecord& record() { return record_; }

  void write_all() {
    if (last_state_) write_checkpoint();
    folder_.write("history.csv", history_csv(record_));
    folder_.write("outputs.csv", outputs_csv(record_));
    folder_.write("contours.csv", contours_csv(record_));
    for (const auto& [name, text] : {std::pair("contours_across.csv", contours_across_csv(record_)),
                                     std::pair("contours_offset.csv", contours_offset_csv(record_)),
                                     std::pair("history_errors.csv", history_errors_csv(record_)),
                                     std::pair("outputs_errors.csv", outputs_errors_csv(record_))})
      if (!text.empty()) folder_.write(name, text);
    if (!options_.no_output_fields) folder_.write("fields.pvd", field_collection(record_, fields_folder));
    if (const WallTable& wall = result_.problem.wall; !wall.is_straight())
      folder_.write("channel.csv", channel_csv(result_.problem, result_.scales));
  }

 private:
  void add(const TimeFrame& frame) {
    const fs::path file = folder_.scratch() / fields_folder / to_path(field_file(record_.frames.size()));
    if (!options_.no_output_fields) write_field_file(frame.state.write_fields, result_.scales, file, options_.folder);
    add_frame(frame, result_.scales, record_);
  }

  void add(const TimePoint& point, const TimeState& state) {
    add_step(point, result_.scales, record_);
    last_state_ = state;
    write_checkpoint_if_due();
    const HistoryRow& row = record_.rows.back();
    if (!options_.quiet)
      tell(fmt::format("t {:>10.4f} us  step {:<9.3g} order {}  deformation {:.6f}  {}", row.t_us, row.step_us,
                       row.order, row.measure("deformation"), plural(row.newton_iterations, "Newton iteration")));
  }

  void write_checkpoint_if_due() {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_checkpoint_ < until_checkpoint_) return;
    last_checkpoint_ = now;
    until_checkpoint_ = std::clamp(2 * until_checkpoint_, min_time_between_checkpoints, max_time_between_checkpoints);
    write_checkpoint();
  }

  void write_checkpoint() {
    folder_.write(checkpoint_file(slot_), encode_checkpoint({*last_state_, record_}, result_.input));
    slot_ = 3 - slot_;
  }

  const Result& result_;
  const SolveOptions& options_;
  ResultFolder& folder_;
  TimeRecord record_;
  std::optional<TimeState> last_state_;
  int slot_ = 1;
  std::chrono::duration<double> until_checkpoint_{0};
  std::chrono::steady_clock::time_point last_checkpoint_ = std::chrono::steady_clock::now();
};

}  // namespace

int solve_in_time(const Case& c, const SolveOptions& options, std::optional<Drawing>& drawing) {
  Result result{c, scales_of(c), problem_of(c), {}};
  std::optional<FoundCheckpoint> from;
  std::optional<TimeStart> start;
  if (!options.continue_from.empty()) {
    from = find_checkpoint(options.continue_from, c);
    start = TimeStart{from->checkpoint.state, {}, from->checkpoint.record.way};
  } else if (!interrupted_results(options.folder).empty()) {
    tell(
        fmt::format("{0}: an earlier computation was interrupted; --continue {0} would continue from its last "
                    "checkpoint, which is kept until this computation is finished.",
                    one_line(options.folder.string(), 200)));
  }
  if (!options.start_from.empty()) start = read_start(options.start_from, c);
  ResultFolder folder(options.folder);
  Recorder recorder(result, options, folder);
  if (from) {
    recorder.take_over(*from);
    from->claim = {};  // what a killed run has left may go once there is a result
  }
  result.state = transient(result.problem, time_run_of(c, result.scales), recorder.observer(),
                           start ? &*start : nullptr, work_limits(options));
  if (result.state.outcome.status == Status::stopped && recorder.record().rows.empty()) {
    tell("rheocyte: stopped by a signal before the first state.");
    return exit_stopped();
  }
  recorder.write_all();
  judge_end(result, recorder.record(), work_limits(options));
  refuse_unfinite_numbers(result);
  const auto numbers = to_json(result, recorder.record());
  return finish_result(result, folder, options, numbers, drawing);
}

}  // namespace rheocyte
