#include "app/command_line.h"

#include <fmt/format.h>

#include <filesystem>
#include <new>
#include <system_error>
#include <vector>

#include "app/cli.h"
#include "app/empty_arguments.h"
#include "app/exit_codes.h"
#include "case/nearest_name.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace {

// CLI11 would only say that an argument was not expected.
void check_command_name(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  const std::vector<std::string_view> known(names.begin(), names.end());
  for (const auto name : known)
    if (name == argv[1]) return;
  const auto hint = did_you_mean(argv[1], known);
  throw UserError(fmt::format("rheocyte: unknown command {}{}", one_line(argv[1], 60),
                              hint.empty() ? "; `rheocyte --help` lists the commands." : hint));
}

// Results that a script reads there are lost without a word otherwise.
int with_output(int exit_code) {
  const int failed = finish_output();
  if (failed == 0) return exit_code;
  tell(fmt::format("rheocyte: standard output cannot be written ({}); files are complete.",
                   std::generic_category().message(failed)));
  return exit_code == exit_converged ? exit_user_error : exit_code;
}

// What the user may have meant by an argument that was taken for an option.
std::string file_like_an_option(int argc, char** argv) {
  std::error_code error;
  for (int i = 1; i < argc; ++i)
    if (argv[i][0] == '-' && std::filesystem::is_regular_file(to_path(argv[i]), error))
      return fmt::format("; the file {0} is given as ./{0}", one_line(argv[i], 200));
  return {};
}

// What is wrong with a number that was not understood.
std::string decimal_comma_in(const CLI::ParseError& error) {
  const std::string_view text = error.what();
  const auto comma = text.find(',');
  if (error.get_name() != "ConversionError" || comma == std::string_view::npos || comma + 1 == text.size()) return {};
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return comma > 0 && is_digit(text[comma - 1]) && is_digit(text[comma + 1]) ? "; decimals follow a point" : "";
}

int report(const std::string& sentence, int exit_code) {
  tell(one_line(sentence, 1000));
  return exit_code;
}

}  // namespace

int run_command_line(CLI::App& app, int argc, char** argv, const int& exit_code) {
  try {
    check_command_name(app, argc, argv);
    if (argc > 1) refuse_empty_arguments(app, {argv + 1, argv + argc});
    app.parse(argc, argv);
    return with_output(exit_code);
  } catch (const CLI::Success& wish) {  // --help, --version
    return with_output(app.exit(wish));
  } catch (const CLI::ParseError& error) {
    return report(fmt::format("rheocyte: {}{}{} (see `rheocyte --help`)", error.what(), decimal_comma_in(error),
                              file_like_an_option(argc, argv)),
                  exit_user_error);
  } catch (const StoppedBySignal&) {
    return exit_stopped();
  } catch (const UserError& error) {
    return report(error.what(), exit_user_error);
  } catch (const std::bad_alloc&) {
    return report("rheocyte: the memory of this machine does not suffice; try a larger numerics.accuracy.",
                  exit_own_bug);
  } catch (const std::exception& error) {
    return report(fmt::format("rheocyte: an error of the program itself, please report it: {}", error.what()),
                  exit_own_bug);
  }
}

}  // namespace rheocyte
