// `rheocyte features FILES... [-o DIR]`
// Each recording is read in a process of its own, so that a damaged one harms no other. `exit_code`: 0, 2 if a
// recording could not be used, 3 if one has no event with an outline, 128 + signal.
#include <fmt/format.h>

#include <memory>

#include "app/cli.h"
#include "app/commands.h"
#include "app/extract_options.h"
#include "app/recording_batch.h"
#include "events/recording_facts.h"
#include "events/recording_settings.h"
#include "report/features_recording.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace {

/// All recordings of one call.
class FeaturesJob {
 public:
  explicit FeaturesJob(const FeaturesOptions& options) : options_(options) {}

  int run() {
    const auto tasks = tasks_of(options_.batch);
    return run_batch(tasks, options_.batch, options_.patience_s.value_or(default_patience_s), *this);
  }

  AtomicFile files(const RecordingTask& task) const { return features_file(place_for(task)); }

  FeaturesSummary work(const RecordingTask& task, const AtomicFile& file, const TellProgress& report_progress) const {
    return features_of_recording(task.recording, place_for(task), file.scratch(), options_.pixel_size_um,
                                 report_progress);
  }

  bool take(const RecordingTask& task, const FeaturesSummary& summary) const {
    const std::string name = one_line(task.recording.string(), 200);
    if (!options_.batch.quiet)
      print(fmt::format("{}: {} features of {} of {} events, see {}\n", name, summary.features, summary.with_outline,
                        summary.events, place_for(task).string()));
    if (summary.cut > 0 && !options_.batch.quiet) tell(fmt::format("{}: {}", name, cut_text(summary.cut)));
    if (summary.with_outline == 0) tell(fmt::format("{}: no event has an outline.", name));
    return summary.with_outline > 0;
  }

  void fail(const RecordingTask&, const std::string&) const {}

 private:
  static std::filesystem::path place_for(const RecordingTask& task) {
    return task.result("_features" + std::string(companion_suffix) + ".rtdc");
  }

  const FeaturesOptions& options_;
};

}  // namespace

void add_features_command(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("features", "shape features of the cells in recordings (.rtdc), from contours or masks");
  command->footer("For example: rheocyte features cells.rtdc -o features");
  auto options = std::make_shared<FeaturesOptions>();
  declare_batch_options(*command, options->batch);
  declare_jobs(*command, options->batch);
  declare_settings(*command, settings_of(*options));
  command->callback([options, &exit_code] {
    watch_signals(SecondSignal::waits);
    exit_code = FeaturesJob(*options).run();
  });
}

}  // namespace rheocyte
