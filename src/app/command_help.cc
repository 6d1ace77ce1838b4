// `rheocyte help [case|table|dynamic|synth|COMMAND]`
// It prints to standard output.
#include <fmt/format.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/cli.h"
#include "app/commands.h"
#include "case/key_reference.h"
#include "result/result_reference.h"
#include "store/standard_output.h"
#include "synth/synth_keys.h"
#include "table/dynamic_spec.h"
#include "table/table_keys.h"

namespace rheocyte {

namespace {

std::string reference(const Reference& keys, bool markdown) {
  return markdown ? reference_markdown(keys) : reference_text(keys);
}

struct HelpOptions {
  std::string topic;
  bool markdown = false;
};

// What is read and written, rather than a command; a topic of both is this one, and `rheocyte table --help` the other.
const std::map<std::string, std::function<std::string(bool markdown)>> references{
    {"case", [](bool markdown) { return reference(case_reference(), markdown); }},
    {"table", [](bool markdown) { return reference(table_reference(), markdown); }},
    {"dynamic", [](bool markdown) { return reference(dynamic_reference(), markdown); }},
    {"result", result_reference},
    {"synth", [](bool markdown) { return reference(synth_reference(), markdown); }},
};

void print_help(const CLI::App& app, const HelpOptions& options) {
  if (const auto found = references.find(options.topic); found != references.end())
    print(found->second(options.markdown));
  else if (!options.topic.empty())
    print(app.get_subcommand(options.topic)->help("rheocyte"));
  else
    print(app.help());
}

}  // namespace

void add_help_command(CLI::App& app, int&) {
  auto* command =
      app.add_subcommand("help", "explain the keys of a case or a spec, the files of a result, or a command");
  auto options = std::make_shared<HelpOptions>();
  auto* topic = command->add_option(
      "TOPIC", options->topic,
      "case, table, dynamic (tables) or synth: all keys with unit, default and range; result: all numbers with "
      "unit and meaning; or another command");
  std::vector<std::string> topics;
  for (const auto& [name, text] : references) topics.push_back(name);
  for (const auto* known : app.get_subcommands([](const CLI::App*) { return true; }))
    topics.push_back(known->get_name());
  topic->check(CLI::IsMember(topics));
  command->add_flag("--markdown", options->markdown, "the reference as a Markdown document");
  command->callback([&app, options] { print_help(app, *options); });
}

}  // namespace rheocyte
