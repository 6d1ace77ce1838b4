#include "app/extract_options.h"

#include <cmath>
#include <string>
#include <utility>

#include "app/cli.h"
#include "app/key_option.h"
#include "events/recording_settings.h"

namespace rheocyte {

namespace {

/// Declares the option of one setting.
struct SettingOption {
  CLI::App& command;
  const Setting& setting;
  const std::string option = option_of(setting);

  auto taking() const {
    return [wanted = setting, what = "rheocyte: " + option](const auto& value) { take(wanted, value, what); };
  }
  CLI::Option* operator()(std::optional<double>*) const {
    return add_number_option(command, option, std::string(setting.former_option), description_of(setting), taking());
  }
  // NOLINTNEXTLINE(readability-non-const-parameter): a pointer to const would be taken for a text below
  CLI::Option* operator()(double* number) const {
    return (*this)(static_cast<std::optional<double>*>(nullptr))->required(std::isnan(*number));
  }
  CLI::Option* operator()(std::vector<double>*) const {
    return command.add_option_function<std::vector<double>>(option, taking(), description_of(setting))
        ->delimiter(setting.separator)
        ->allow_extra_args(false);
  }
  CLI::Option* operator()(bool* flag) const { return command.add_flag(option, *flag, description_of(setting)); }
  CLI::Option* operator()(std::vector<std::string>* texts) const {
    auto* const declared = command.add_option(option, *texts, description_of(setting))->allow_extra_args(false);
    return setting.separator ? declared->delimiter(setting.separator) : declared;
  }
  template <class Text>
  CLI::Option* operator()(Text*) const {
    return command.add_option_function<std::string>(option, taking(), description_of(setting));
  }
};

}  // namespace

void declare_batch_options(CLI::App& command, BatchOptions& options) {
  command
      .add_option("FILES", options.inputs,
                  "recordings (.rtdc) or tables of events (.csv, .tsv, .txt); folders of .rtdc with -r")
      ->required();
  command.add_option("-o,--output", options.folder, "folder for the results; default: the folder of each recording")
      ->type_name("DIR");
  command.add_flag("-r,--recursive", options.recursive, "search the given folders for recordings");
  command.add_flag("--quiet", options.quiet, "print neither progress nor results");
}

void declare_jobs(CLI::App& command, BatchOptions& options, const std::string& meaning) {
  command
      .add_option("-j,--jobs", options.jobs, meaning + "; default: number of processors. Results do not depend on it")
      ->check(CLI::Range(1, 1024));
}

void declare_settings(CLI::App& command, const Settings& settings) {
  for (const Setting& setting : settings) {
    auto* const option = std::visit(SettingOption{command, setting}, setting.place);
    if (!setting.type_name.empty()) option->type_name(std::string(setting.type_name));
  }
}

void declare_extract_options(CLI::App& command, ExtractOptions& options, std::function<void()> run) {
  declare_batch_options(command, options.batch);
  declare_jobs(command, options.batch);
  declare_settings(command, settings_of(options));
  command.add_flag("--no-tsv", options.no_tsv, "do not write the table of events (.tsv)");
  command.callback([&options, run = std::move(run)] {
    check_options(options);
    run();
  });
}

}  // namespace rheocyte
