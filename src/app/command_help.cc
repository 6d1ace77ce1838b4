#include "app/command_help.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "case/case_reference.h"

namespace rheocyte {

namespace {

struct HelpOptions {
  std::string topic;
  bool markdown = false;
};

void print_help(const CLI::App& app, const HelpOptions& options) {
  if (options.topic == "case")
    fmt::print("{}", options.markdown ? case_reference_markdown() : case_reference_text());
  else if (!options.topic.empty())
    fmt::print("{}", app.get_subcommand(options.topic)->help("rheocyte"));
  else
    fmt::print("{}", app.help());
}

}  // namespace

void add_help_command(CLI::App& app) {
  auto* command = app.add_subcommand("help", "explain the keys of a case, or a command");
  auto options = std::make_shared<HelpOptions>();
  auto* topic = command->add_option("TOPIC", options->topic,
                                    "case: all keys with unit, default and range; or the name of a command");
  std::vector<std::string> topics{"case"};
  for (const auto* known : app.get_subcommands([](const CLI::App*) { return true; }))
    topics.push_back(known->get_name());
  topic->check(CLI::IsMember(topics));
  command->add_flag("--markdown", options->markdown, "the case's keys as a Markdown document");
  command->callback([&app, options] { print_help(app, *options); });
}

}  // namespace rheocyte
