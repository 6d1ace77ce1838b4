// `rheocyte plan`: which channel, flow rate and medium, and how many cells and sessions a difference takes.
#include <memory>

#include "app/cli.h"
#include "app/commands.h"
#include "app/extract_options.h"
#include "experiment/plan_settings.h"
#include "experiment/plan_words.h"
#include "report/plan_columns.h"
#include "report/rows_text.h"
#include "store/own_file.h"
#include "store/standard_output.h"

namespace rheocyte {

namespace {

void run(const PlanOptions& options, const std::filesystem::path& file) {
  const std::string_view mark = is_own_file(file, former_mark_of_plan) ? former_mark_of_plan : mark_of_plan;
  if (!file.empty()) check_replaceable(file, mark, Foreign::keep);
  const ExperimentPlan plan = plan_experiment(options);
  const std::string table = rows_text(plan_columns(), plan.channels);
  if (file.empty())
    print(table);
  else
    replace_own_file(file, table, mark, Foreign::keep);
  for (const std::string& line : plan_lines(options, plan)) print(line + "\n");
}

}  // namespace

void add_plan_command(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "plan",
      "channel, flow rate, medium and numbers of cells and sessions that detect a difference between conditions");
  command->footer("For example: rheocyte plan --radius-um 6.5 --young-modulus-kPa 2");
  auto options = std::make_shared<PlanOptions>();
  auto file = std::make_shared<std::filesystem::path>();
  declare_settings(*command, settings_of(*options));
  command->add_option("-o,--output", *file, "file for the table of channels; default: the table is printed")
      ->type_name("FILE.tsv");
  command->callback([options, file] { run(*options, *file); });
}

}  // namespace rheocyte
