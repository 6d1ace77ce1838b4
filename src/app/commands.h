// The commands of rheocyte. Each stands in command_NAME.cc; a new one is that file and its name in the two lists here.
#pragma once
#include <array>

namespace CLI {
class App;
}

namespace rheocyte {

/// Adds a command, whose callback leaves the exit code of the process in `exit_code` (0 if it says nothing). UserError.
using AddCommand = void(CLI::App&, int& exit_code);

AddCommand add_solve_command, add_picture_command, add_analytic_command, add_extract_command, add_moduli_command,
    add_features_command, add_plot_command, add_scale_command, add_synth_command, add_figure_command, add_table_command,
    add_time_course_command, add_population_command, add_plan_command, add_dclab_plugin_command, add_view_command,
    add_help_command;

/// In the order of the help; `help` is last, because it knows the others.
inline constexpr std::array all_commands{
    add_solve_command,        add_picture_command,     add_analytic_command,   add_extract_command, add_moduli_command,
    add_features_command,     add_plot_command,        add_scale_command,      add_synth_command,   add_figure_command,
    add_table_command,        add_time_course_command, add_population_command, add_plan_command,    add_view_command,
    add_dclab_plugin_command, add_help_command};

}  // namespace rheocyte
