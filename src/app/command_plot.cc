// `rheocyte plot FILES... [--table TABLE]`
// Each recording is read in a process of its own; the Python package draws. `exit_code`: 0, 1 if the drawing program
// fails, 2 if a recording could not be used (no picture then), 128 + signal.
#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <system_error>
#include <vector>

#include "app/cli.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/plot_options.h"
#include "case/json_guard.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "report/plot_gates.h"
#include "report/plot_lines.h"
#include "report/plot_panel.h"
#include "store/atomic_file.h"
#include "store/file_writer.h"
#include "store/isolated.h"
#include "store/own_file.h"
#include "store/python_package.h"
#include "store/scratch.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

/// A folder for what goes to the drawing program; removed with the object.
class HandOver {
 public:
  HandOver() {
    std::error_code error;
    const fs::path place = fs::temp_directory_path(error);
    if (!error) folder_ = new_scratch_folder(place / "rheocyte-plot");
    if (error || folder_.failed)
      throw UserError("rheocyte: there is no folder for temporary files; name one in TMPDIR.");
  }
  ~HandOver() { remove_scratch(folder_); }
  HandOver(const HandOver&) = delete;
  HandOver& operator=(const HandOver&) = delete;
  const fs::path& path() const { return folder_.path; }

 private:
  Scratch folder_;
};

/// The picture of one call.
class Plot {
 public:
  explicit Plot(const PlotOptions& options) : options_(options), stem_(picture_stem(options)), lines_(options) {}

  int run() {
    for (const char* const ending : {".png", ".svg"})
      check_replaceable_picture(to_path(stem_.string() + ending), "give another name with -o");
    json panels = json::array();
    for (const auto& recording : options_.inputs) {
      const auto name = fmt::format("events-{}", panels.size());
      const auto read = read_panel(recording, folder_.path() / to_path(name));
      if (read.stopped()) return exit_stopped();
      if (!read.finished())
        throw UserError(sentence_for(recording, read.end, options_.measuring.patience_s.value_or(default_patience_s)));
      panels.push_back(described(recording, read.result));
      panels.back()["events_file"] = name;
    }
    if (const std::string why = lines_.why_none(); !why.empty() && !options_.quiet) tell(why);
    const auto text = json_line({{"panels", panels}, {"gates", gates_in_picture(options_)}});
    if (write_part(folder_.path() / "plot.json", text))
      throw UserError("rheocyte: the disk for temporary files is full; name another folder in TMPDIR.");
    return draw();
  }

 private:
  Isolated<PlotPanel> read_panel(const fs::path& recording, const fs::path& events) const {
    Isolation limits;
    limits.patience_s = options_.measuring.patience_s.value_or(default_patience_s);
    const auto work = [&](const TellProgress& on_progress) {
      FileWriter file(events, "is the disk full? Name another folder in TMPDIR.");
      const auto write = [&](std::span<const float> pairs) {
        file.append({reinterpret_cast<const char*>(pairs.data()), pairs.size_bytes()});
      };
      PlotPanel panel = plot_panel(recording, options_, lines_.wanted(), write, on_progress);
      file.close();
      return panel;
    };
    return run_isolated(work, limits);
  }

  json described(const fs::path& recording, const PlotPanel& panel) {
    json j{{"title", one_line(recording.filename().string(), 100)},
           {"sample", panel.sample},
           {"measured", panel.measured},
           {"recommended", panel.recommended},
           {"events", panel.events},
           {"gated", panel.gated},
           {"drawable", panel.drawable},
           {"x", options_.x},
           {"y", options_.y},
           {"width_um", panel.width_um},
           {"lines", json::array()}};
    if (!options_.quiet)
      for (const auto& warning : panel.warnings)
        tell(fmt::format("{}: {}", one_line(recording.string(), 200), warning));
    if (!panel.has_conditions) return j;
    j.update(lines_.for_panel(panel));
    return j;
  }

  int draw() {
    if (stop_wanted()) return exit_stopped();
    const auto drawn = drawing_.finish(std::vector{folder_.path().string(), stem_.string()});
    if (stop_wanted()) return exit_stopped();
    if (drawn.exit_code == exit_user_error) throw UserError(drawn.last_line);
    if (drawn.exit_code != 0) {
      tell(fmt::format("rheocyte: the picture could not be drawn ({}).",
                       drawn.last_line.empty() ? "the drawing program failed" : one_line(drawn.last_line, 300)));
      return exit_own_bug;
    }
    if (!options_.quiet) print(fmt::format("{0}.png and {0}.svg\n", stem_.string()));
    return exit_converged;
  }

  const PlotOptions& options_;
  fs::path stem_;
  PlotLines lines_;
  HandOver folder_;
  Drawing drawing_{"event_plot"};  // loads while the recordings are read
};

}  // namespace

void add_plot_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "plot", "deformation against area of the cells in recordings (.rtdc), with isoelasticity lines");
  command->footer("For example: rheocyte plot cells.rtdc --levels 0.5,1,2");
  auto options = std::make_shared<PlotOptions>();
  declare_plot_options(*command, *options, [options, &exit_code] {
    watch_signals();
    exit_code = Plot(*options).run();
  });
}

}  // namespace rheocyte
