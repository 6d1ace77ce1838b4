// `rheocyte plan`: which channel, flow rate and medium, and how many cells and sessions a difference takes.
#include <fmt/format.h>

#include <memory>

#include "app/cli.h"
#include "app/commands.h"
#include "experiment/experiment_plan.h"
#include "store/own_file.h"
#include "store/standard_output.h"

namespace rheocyte {

namespace {

void run(const PlanOptions& options, const std::filesystem::path& file) {
  if (!file.empty()) check_replaceable(file, mark_of_plan, Foreign::keep);
  const ExperimentPlan plan = plan_experiment(options);
  if (file.empty())
    print(plan_table(plan));
  else
    replace_own_file(file, plan_table(plan), mark_of_plan, Foreign::keep);
  for (const std::string& line : plan.lines) print(line + "\n");
}

}  // namespace

void add_plan_command(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "plan", "channel, flow rate, medium and numbers of cells and sessions that show a difference between conditions");
  auto options = std::make_shared<PlanOptions>();
  auto file = std::make_shared<std::filesystem::path>();
  command->add_option("--radius-um", options->radius_um, "radius of the median cell at rest")->required();
  command->add_option("--young-modulus-kPa", options->young_modulus_kPa, "Young's modulus of the median cell")
      ->required();
  command->add_option("--spread", options->spread, "standard deviation of ln E between cells")->capture_default_str();
  command->add_option("--radius-spread", options->radius_spread, "standard deviation of ln r0 between cells")
      ->capture_default_str();
  command
      ->add_option("--between-recordings", options->between_recordings,
                   "standard deviation of ln E between recordings of one condition")
      ->capture_default_str();
  command->add_option("--difference", options->difference, "of E between conditions, 0.1 = 10 %")
      ->capture_default_str();
  command->add_option("--power", options->power, "wanted probability to find it")->capture_default_str();
  command->add_option("--cells", options->cells, "cells of each recording")->capture_default_str();
  command->add_option("--mode-2", options->mode_2, "how elongated the cells are: c2 of their outlines")
      ->capture_default_str();
  command->add_option("--pixel-size-um", options->pixel_size_um, "size of a pixel")->capture_default_str();
  command->add_option("--temperature", options->temperature_C, "of the medium (degC)")->capture_default_str();
  command->add_option("--width-um", options->widths_um, "widths of the channels, comma-separated; default: 15,20,30")
      ->delimiter(',');
  command->add_option("--medium", options->media, "media, comma-separated; default: 0.49% MC-PBS,0.83% MC-PBS")
      ->delimiter(',');
  command
      ->add_option("--rate-ul-s", options->rates_ul_s,
                   "flow rates, comma-separated; default: those of 0.04, 0.1, 0.2 and 0.4 m/s")
      ->delimiter(',');
  command->add_option("-o,--output", *file, "file for the table of the channels; without it it is printed")
      ->type_name("FILE.tsv");
  command->callback([options, file] { run(*options, *file); });
}

}  // namespace rheocyte
