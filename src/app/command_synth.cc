// `rheocyte synth SPEC.toml -o FILE.rtdc`
// The file appears whole or not at all. `exit_code`: 0, 2 for the user's errors, 128 + signal.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <new>
#include <system_error>

#include "app/cli.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "case/case_text.h"
#include "case/key_reading.h"
#include "case/refuse_path.h"
#include "case/user_error.h"
#include "shelf/virtual_cells.h"
#include "store/atomic_file.h"
#include "store/build_info.h"
#include "store/isolated.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"
#include "synth/synth_keys.h"
#include "synth/virtual_recording.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

struct SynthOptions {
  fs::path spec, output;
  std::vector<std::string> settings;  ///< "key=value"
  bool force = false, quiet = false;
};

void check_output(const SynthOptions& options) {
  const std::string name = one_line(options.output.string(), 300);
  std::error_code error;
  if (options.output.extension() != ".rtdc")
    throw UserError(fmt::format("{}: recordings have names that end in .rtdc; give such a name with -o.", name));
  if (fs::is_directory(options.output, error))
    throw UserError(fmt::format("{}: is a folder; give the name of a file with -o.", name));
  if (!options.force && fs::exists(options.output, error))
    throw UserError(fmt::format("{}: already exists; give another name with -o, or --force to replace it.", name));
  const auto parent = fs::absolute(options.output, error).parent_path();
  if (!fs::is_directory(parent, error)) refuse_path(parent, "there is no such folder.");
}

void report(const SynthOptions& options, const VirtualRecording& r) {
  print(fmt::format("{}: {} events; areas measured {:+.2f} %, deformations {:+.5f} from the true ones on average\n",
                    options.output.string(), r.events, 100 * r.mean_area_error, r.mean_deformation_error));
  for (std::size_t k = 0; k < r.missing.size(); ++k)
    if (r.missing[k] > 0)
      tell(fmt::format("{} of {} {} are left out: {}.", r.missing[k], r.pictures, noun_of_missing(r),
                       names_of_missing_shapes[k]));
}

[[noreturn]] void refuse(const IsolatedEnd& end) {
  if (end.kind == IsolatedEnd::Kind::user_error) throw UserError(end.text);
  if (end.kind == IsolatedEnd::Kind::no_memory) throw std::bad_alloc();
  throw std::runtime_error(end.kind == IsolatedEnd::Kind::hung ? "writing the recording hung" : end.text);
}

int run(const SynthOptions& options) {
  check_output(options);
  const std::string text = read_case_text(options.spec, specification("synth"));
  for (const auto& remark : remarks_on_names(
           key_list(synth_keys()), given_keys(text, options.spec.string(), options.settings, specification("synth"))))
    if (!options.quiet) tell(remark);
  SynthSpec spec = parse_synth_spec(text, options.spec.string(), options.settings);
  const auto shapes = virtual_cells(spec, options.spec.parent_path());
  const RecordingProvenance provenance{fmt::format("rheocyte {}", version), text};
  AtomicFile file(options.output, [&] { check_output(options); });
  const auto work = [&](const TellProgress& report_progress) {
    return write_virtual_recording(spec, *shapes, provenance, file.scratch(), report_progress);
  };
  const auto done =
      run_isolated(work, {}, {.progress = FileProgress(one_line(options.output.string(), 200), options.quiet)});
  if (done.stopped()) return exit_stopped();
  if (!done.finished()) refuse(done.end);
  file.publish();
  if (!options.quiet) report(options, done.result);
  return exit_converged;
}

}  // namespace

void add_synth_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("synth", "a virtual recording (.rtdc) of a population of cells");
  command->footer("For example: rheocyte synth examples/recordings/virtual-cells.toml -o virtual.rtdc");
  auto options = std::make_shared<SynthOptions>();
  command
      ->add_option("SPEC", options->spec,
                   "population, channel, camera and noise, a TOML file (see `rheocyte help synth`)")
      ->required();
  command->add_option("-o,--output", options->output, "the recording")->type_name("FILE.rtdc")->required();
  command->add_option("--set", options->settings, "replace a key of the spec; may be repeated")
      ->type_name("key=value")
      ->allow_extra_args(false);
  command->add_flag("--force", options->force, "replace an existing file");
  command->add_flag("--quiet", options->quiet, "print only errors");
  command->callback([options, &exit_code] {
    watch_signals(SecondSignal::waits);
    exit_code = run(*options);
  });
}

}  // namespace rheocyte
