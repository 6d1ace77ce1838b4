// `rheocyte scale TABLE`
// A look-up table or isoelasticity lines for another channel, flow rate or viscosity; of the tables that come with the
// program, the text files themselves.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/cli.h"
#include "app/commands.h"
#include "app/key_option.h"
#include "case/case_keys.h"
#include "case/joined.h"
#include "case/refuse_path.h"
#include "case/user_error.h"
#include "infer/map_as_lut.h"
#include "infer/read_modulus_map.h"
#include "shelf/find_table.h"
#include "store/build_info.h"
#include "store/own_file.h"
#include "table/scale.h"
#include "table/table_metadata.h"
#include "table/table_text.h"

namespace rheocyte {

namespace {

struct ScaleOptions {
  std::filesystem::path table, output;
  std::optional<double> channel_width_um, flow_rate_ul_s, viscosity_mPas;
  std::string identifier;
  bool lines = false, force = false, inexact = false;
};

bool is_text(const std::filesystem::path& table) {
  return table.extension() != ".cbor" && !std::filesystem::is_directory(table);
}

TableText read_text(const ScaleOptions& options, const std::filesystem::path& table) {
  if (is_text(table)) {
    if (options.lines) refuse_path(table, "--lines makes isoelasticity lines of rheocyte's own tables (grid_*.cbor).");
    return read_table_text(table);
  }
  const auto map = read_modulus_map(table);
  return options.lines ? lines_of_map(*map) : map_as_lut(*map);
}

ChannelFlow wanted_flow(const ScaleOptions& options, const TableText& table) {
  const auto own = channel_flow_of(table);
  return {options.channel_width_um.value_or(own.width_um), options.flow_rate_ul_s.value_or(own.rate_ul_s),
          options.viscosity_mPas.value_or(own.viscosity_mPas)};
}

// Programs know a table by its name: a scaled one needs another.
void rename(TableText& table, const ChannelFlow& to, const std::string& wanted) {
  const char* key = table.metadata.contains(table_identifier_key) ? table_identifier_key : lines_identifier_key;
  const std::string own = table.metadata.at(key);
  table.metadata[key] =
      !wanted.empty() ? wanted
                      : fmt::format("{}-{:g}um-{:g}uls-{:g}mPas", own, to.width_um, to.rate_ul_s, to.viscosity_mPas);
}

TableText rescaled(const ScaleOptions& options, const TableText& table, const std::string& name) {
  const auto to = wanted_flow(options, table);
  const auto doubts = doubts_of_scaling(table, to);
  if (!doubts.empty() && !options.inexact)
    throw UserError(
        fmt::format("{}: the scaling would not be exact: {}; --inexact scales anyway.", name, joined(doubts, "; ")));
  TableText result = scaled(table, to, version);
  rename(result, to, options.identifier);
  return result;
}

void run(const ScaleOptions& options) {
  const auto file = find_table(options.table.string(), "scale");
  const bool scales = options.channel_width_um || options.flow_rate_ul_s || options.viscosity_mPas;
  if (is_text(file) && !scales)
    throw UserError("rheocyte: give at least one of --channel-width-um, --flow-rate-ul-s and --viscosity-mPas.");
  std::error_code error;
  if (std::filesystem::equivalent(file, options.output, error))
    throw UserError(fmt::format("{}: is the table itself; give another name with -o.", options.output.string()));
  TableText table = read_text(options, file);
  if (scales) table = rescaled(options, table, file.string());
  replace_own_file(options.output, to_text(table), table_mark, foreign(options.force));
}

std::string check_identifier(const std::string& name) {
  const bool plain =
      std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_' || c == '.'; });
  return plain && !name.empty() && name.size() <= 80 ? "" : "may contain only letters, digits, -, _ and .";
}

}  // namespace

void add_scale_command(CLI::App& app, int&) {
  auto* command = app.add_subcommand("scale", "look-up table for another channel, flow rate or viscosity");
  command->footer("For example: rheocyte scale HE-3D-26 --channel-width-um 30 -o scaled.txt");
  auto options = std::make_shared<ScaleOptions>();
  command
      ->add_option(
          "TABLE", options->table,
          "look-up table or isoelasticity lines in dclab's format, or a table of rheocyte: its name or grid_*.cbor")
      ->required();
  const std::string otherwise = "the value of the table";
  add_key_option(*command, case_key("channel.width_um"), options->channel_width_um, otherwise);
  add_key_option(*command, case_key("flow.rate_ul_per_s"), options->flow_rate_ul_s, otherwise);
  add_key_option(*command, case_key("flow.viscosity_mPas"), options->viscosity_mPas, otherwise);
  command->add_flag("--lines", options->lines, "write isoelasticity lines of a table of rheocyte in place of its rows");
  command
      ->add_option("--identifier", options->identifier,
                   "identifier of the new table; default: derived from the original table")
      ->check(CLI::Validator(check_identifier, "NAME"));
  command->add_option("-o,--output", options->output, "file for the new table")->type_name("FILE.txt")->required();
  command->add_flag("--inexact", options->inexact,
                    "scale even if the scaling is not exact; the header gives the reason");
  command->add_flag("--force", options->force, "replace a file that rheocyte did not write");
  command->callback([options] { run(*options); });
}

}  // namespace rheocyte
