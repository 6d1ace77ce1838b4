#include "extract/extract_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <system_error>

#include "case/user_error.h"
#include "extract/event_table.h"
#include "extract/extraction.h"
#include "measurement/companion_file.h"
#include "store/build_info.h"
#include "store/contained.h"
#include "store/own_file.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark_of_tables = "# rheocyte ";

std::string program() { return fmt::format("rheocyte {}", version); }

std::string meaning_of_states() {
  std::string text = "state of emodulus:";
  for (std::size_t k = 0; k < names_of_modulus_states.size(); ++k)
    text += fmt::format("{} {} {}", k == 0 ? "" : ",", k, names_of_modulus_states[k]);
  return text;
}

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  char text[32] = "";
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

// Paths under which the original is looked for: where it is now, seen from the companion's folder, and in that folder.
std::vector<std::string> paths_to(const fs::path& original, const fs::path& folder) {
  std::error_code error;
  const fs::path absolute = fs::weakly_canonical(fs::absolute(original), error);
  const fs::path relative = fs::relative(absolute, folder, error);
  std::vector<std::string> paths{absolute.string()};
  for (const auto& path : {relative.string(), original.filename().string()})
    if (!path.empty() && std::ranges::find(paths, path) == paths.end()) paths.push_back(path);
  return paths;
}

void describe(CompanionFile& companion, const fs::path& folder, const Recording& recording,
              const Extraction& extraction) {
  companion.add_user_metadata("rheocyte emodulus", "Young's modulus (kPa), with the settings in the log");
  companion.add_user_metadata("rheocyte userdef0", meaning_of_states());
  if (extraction.table().is_own())
    companion.add_user_metadata("rheocyte userdef1", "standard error of emodulus (kPa), of pixels and of the table");
  companion.add_user_metadata("rheocyte table", extraction.table().origin().identifier);
  std::vector<std::string> log{program() + " extract", "time: " + now_utc(),
                               "recording: " + recording.file().filename().string()};
  const auto settings = extraction.lines();
  log.insert(log.end(), settings.begin(), settings.end());
  companion.add_log("rheocyte-extract", log);
  companion.add_basin(paths_to(recording.file(), folder));
}

// Our own say in their metadata which program has written them. Read in a process of its own, as it may be any file.
void check_companion(const fs::path& place) {
  std::error_code error;
  if (!fs::exists(place, error)) return;
  const auto is_ours = [&](const TellProgress&) {
    try {
      const auto programs = Recording(place).metadata().text("setup:software version");
      return programs && programs->find("rheocyte ") != std::string::npos;
    } catch (const UserError&) {
      return false;  // no recording at all
    }
  };
  const auto looked = run_contained(is_ours, {}, [](double) {});
  if (!looked.stopped() && !(looked.finished() && looked.result))
    throw UserError(
        fmt::format("{}: is there and was not written by rheocyte; move it away, or name another folder with -o.",
                    one_line(place.string(), 300)));
}

/// Both files of a recording, block by block.
class Writers {
 public:
  Writers(const ExtractFiles& files, const Recording& recording, const Extraction& extraction)
      : companion_(files.companion(), recording, program()), has_errors_(extraction.table().is_own()) {
    describe(companion_, fs::absolute(files.companion()).parent_path(), recording, extraction);
    companion_.add_feature("emodulus");
    companion_.add_feature("userdef0");
    if (has_errors_) companion_.add_feature("userdef1");
    if (!files.events()) return;
    auto remarks = extraction.lines();
    remarks.insert(remarks.begin(), {program() + " extract", "recording: " + recording.file().string()});
    table_.emplace(*files.events(), remarks, has_errors_);
  }

  void write(std::size_t first, const EventBlock& block) {
    states_.resize(block.state.size());
    std::ranges::transform(block.state, states_.begin(), [](ModulusState s) { return static_cast<double>(s); });
    companion_.write("emodulus", first, block.young_modulus_kPa);
    companion_.write("userdef0", first, states_);
    if (has_errors_) companion_.write("userdef1", first, block.standard_error_kPa);
    if (table_) table_->append(block);
  }

  void close() {
    companion_.close();
    if (table_) table_->close();
  }

 private:
  CompanionFile companion_;
  bool has_errors_;
  std::optional<EventTable> table_;
  std::vector<double> states_;
};

}  // namespace

ExtractFiles::ExtractFiles(const ExtractOutput& output, bool with_events)
    : folder_(output.companion.parent_path()),
      companion_(output.companion, [place = output.companion] { check_companion(place); }) {
  if (with_events)
    events_.emplace(output.events,
                    [place = output.events] { check_replaceable(place, mark_of_tables, Foreign::keep); });
}

std::optional<fs::path> ExtractFiles::events() const {
  if (!events_) return {};
  return events_->scratch();
}

void ExtractFiles::publish() {
  const Claim alone = wait_for_folder(folder_);  // two calls on one recording leave the files of one of them
  companion_.check();
  if (events_) events_->publish();
  companion_.publish();
}

ExtractSummary extract_recording(const fs::path& file, const ExtractFiles& files, const ExtractOptions& options,
                                 const ModulusTables& tables, const TellProgress& on_progress) {
  Recording recording(file);
  double done = 0;
  recording.on_piece(now_and_then([&] { on_progress(done); }));
  Extraction extraction(recording, options, tables);
  Writers writers(files, recording, extraction);
  const std::size_t events = recording.events(), block = extraction.block();
  for (std::size_t first = 0; first < events; first += block) {
    const std::size_t count = std::min(block, events - first);
    writers.write(first, extraction.compute(first, count));
    on_progress(done = static_cast<double>(first + count) / static_cast<double>(events));
  }
  writers.close();
  return extraction.summary();
}

}  // namespace rheocyte
