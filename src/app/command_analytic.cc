// `rheocyte analytic cell|table|lines`
// The analytical model for small deformations. They print to standard output and write only the files that are asked
// for.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/analytic_cell.h"
#include "app/analytic_table.h"
#include "app/cli.h"
#include "app/commands.h"
#include "app/key_option.h"
#include "case/case_keys.h"
#include "case/json_guard.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "store/own_file.h"
#include "store/standard_output.h"
#include "table/table_metadata.h"

namespace rheocyte {

namespace {

constexpr double default_tension_ratio = 0.1;

struct CellOptions {
  AnalyticCellInput input;
  std::optional<double> tension_ratio;
  std::filesystem::path contour;
  bool json = false, force = false;
};

struct AnalyticTableOptions {
  AnalyticTableInput input;
  std::filesystem::path folder;
  bool force = false;
};

void check_stiffness(const CellOptions& options) {
  const bool solid = options.input.young_modulus_kPa.has_value();
  if (solid == options.input.cortex_modulus_mN_per_m.has_value())
    throw UserError("rheocyte: give either --young-modulus-kPa, for a solid, or --cortex-modulus-mN-m, for a shell.");
  if (solid && options.tension_ratio)
    throw UserError("rheocyte: --tension-ratio is for shells; leave it out, or give --cortex-modulus-mN-m.");
}

void run_cell(CellOptions& options) {
  check_stiffness(options);
  complete(options.input.conditions);
  options.input.tension_ratio = options.tension_ratio.value_or(default_tension_ratio);
  const AnalyticCell cell = analytic_cell(options.input);
  if (!options.contour.empty())
    replace_own_file(options.contour, contour_text(cell), contour_mark, foreign(options.force));
  print(options.json ? json_text(to_json(cell)) + "\n" : summary(cell));
}

void add_cell_command(CLI::App& analytic) {
  auto* command = analytic.add_subcommand("cell", "shape, velocity and pressure drop of one cell");
  auto options = std::make_shared<CellOptions>();
  AnalyticCellInput& input = options->input;
  const auto add = [&](std::string_view key, auto& target) {
    return add_key_option(*command, case_key(key), [&target](double value) { target = value; });
  };
  add("cell.radius_um", input.radius_um)->required();
  add("cell.bulk.young_modulus_kPa", input.young_modulus_kPa);
  add("cell.cortex.modulus_mN_per_m", input.cortex_modulus_mN_per_m);
  add("cell.cortex.tension_ratio", options->tension_ratio)->default_str(fmt::format("{:g}", default_tension_ratio));
  declare_conditions(*command, input.conditions);
  add("channel.radius_um", input.conditions.input.channel.radius_um)
      ->description("radius of the tube, in place of the channel width");
  command->add_option("-o,--output", options->contour, "file for the contour (columns x_um,r_um; from front to rear)")
      ->type_name("FILE.csv");
  command->add_flag("--json", options->json, "print one JSON object");
  command->add_flag("--force", options->force, "replace a file that rheocyte did not write");
  command->callback([options] { run_cell(*options); });
}

void run_table(AnalyticTableOptions& options, TextFile (*make)(const AnalyticTableInput&)) {
  complete(options.input.conditions);
  const TextFile file = make(options.input);
  const auto path = options.folder / to_path(file.name);
  replace_own_file(path, file.content, table_mark, foreign(options.force));
  print(fmt::format("{}: {} rows\n", path.string(), file.rows));
}

void declare_table_options(CLI::App& command, AnalyticTableOptions& options) {
  AnalyticTableInput& input = options.input;
  declare_conditions(command, input.conditions);
  const auto& radius = case_key("cell.radius_um");
  add_key_option(command, radius, "--least-radius-um",
                 "radius of the smallest cell; default: 0.1 tube radii (0.0547 channel widths)",
                 [&](double value) { input.min_radius_um = value; });
  add_key_option(command, radius, "--greatest-radius-um",
                 "radius of the largest cell; default: 0.8 tube radii (0.4376 channel widths)",
                 [&](double value) { input.max_radius_um = value; });
  command.add_option("--radii", input.radii, "number of radii, equally spaced in radius^2")
      ->check(CLI::Range(2, 2000))
      ->capture_default_str();
  command
      .add_option("--max-deformation,--greatest-deformation", input.max_deformation, "maximum deformation of the cells")
      ->capture_default_str();
  command
      .add_option("--identifier", input.identifier,
                  "identifier of the table in dclab; default: LE-2D-ANA-26, with --square-duct LE-2D-ANA-26-duct")
      ->check(CLI::Validator(
          [](const std::string& name) {
            const bool plain =
                name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.") ==
                std::string::npos;
            return plain && name.size() <= 80 ? std::string()
                                              : std::string("may contain only letters, digits, -, _ and .");
          },
          "NAME"));
  command.add_option("-o,--output", options.folder, "folder for the file")->type_name("DIR")->required();
  command.add_flag("--force", options.force, "replace a file that rheocyte did not write");
}

void add_table_command(CLI::App& analytic) {
  auto* command = analytic.add_subcommand("table", "look-up table for dclab: area, deformation, Young's modulus");
  auto options = std::make_shared<AnalyticTableOptions>();
  AnalyticTableInput& input = options->input;
  declare_table_options(*command, *options);
  const auto& modulus = case_key("cell.bulk.young_modulus_kPa");
  add_key_option(*command, modulus, "--least-modulus-kPa",
                 "Young's modulus of the softest cell; default: 0.5 kPa under standard conditions, otherwise "
                 "proportional to viscosity x flow rate / width^3",
                 [&](double value) { input.min_modulus_kPa = value; });
  add_key_option(*command, modulus, "--greatest-modulus-kPa",
                 "Young's modulus of the stiffest cell; default: 30 kPa under standard conditions",
                 [&](double value) { input.max_modulus_kPa = value; });
  command->add_option("--moduli", input.moduli, "number of moduli, equally spaced in modulus^(-1/2)")
      ->check(CLI::Range(2, 2000))
      ->capture_default_str();
  command->callback([options] { run_table(*options, analytic_table); });
}

void add_lines_command(CLI::App& analytic) {
  auto* command = analytic.add_subcommand("lines", "isoelasticity lines for dclab");
  auto options = std::make_shared<AnalyticTableOptions>();
  declare_table_options(*command, *options);
  command
      ->add_option("--moduli-kPa", options->input.levels_kPa,
                   "Young's moduli of the lines (kPa); default: the eleven values of the published lines")
      ->delimiter(',')
      ->type_name("E1,E2,...")
      ->expected(1, 200);
  command->callback([options] { run_table(*options, analytic_lines); });
}

}  // namespace

void add_analytic_command(CLI::App& app, int&) {
  auto* command = app.add_subcommand("analytic", "analytical model of small deformations: one cell, table, lines");
  command->require_subcommand(1);
  command->footer("For example: rheocyte analytic cell --radius-um 6 --young-modulus-kPa 5");
  add_cell_command(*command);
  add_table_command(*command);
  add_lines_command(*command);
}

}  // namespace rheocyte
