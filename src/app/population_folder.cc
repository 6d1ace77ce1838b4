#include "app/population_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "app/recording_batch.h"
#include "case/refuse_path.h"
#include "case/to_path.h"
#include "events/companion_origin.h"
#include "report/population_companion.h"
#include "report/population_files.h"
#include "store/own_file.h"
#include "store/scratch.h"
#include "store/standard_error.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::array pictures{"population.png", "population.svg", "population-checks.png", "population-checks.svg"};
constexpr const char *command = "population", *way_out = "move it away, or name another folder with -o";

std::string events_name(const std::string& condition, std::size_t session) {
  return fmt::format("events_{}_{}", condition, session + 1);
}

/// A folder from which pictures are drawn, and to which.
class DrawingFolder {
 public:
  explicit DrawingFolder(const fs::path& folder) {
    const fs::path place = folder / "population-pictures";
    for (const Scratch& left_over : left_over_folders(place)) remove_scratch(left_over);
    folder_ = new_scratch_folder(place);
  }
  ~DrawingFolder() { remove_scratch(folder_); }
  DrawingFolder(const DrawingFolder&) = delete;
  DrawingFolder& operator=(const DrawingFolder&) = delete;
  const fs::path& path() const { return folder_.path; }

 private:
  Scratch folder_;
};

}  // namespace

PopulationFolder::PopulationFolder(const PopulationOptions& options, const std::vector<PopulationCondition>& conditions,
                                   bool with_pictures)
    : options_(options) {
  const fs::path& folder = options.folder;
  check_replaceable(folder / "population.json", mark_of_population_json, Foreign::keep);
  check_replaceable(folder / "population.tsv", mark_of_population_table, Foreign::keep);
  for (const char* const picture : pictures)
    if (with_pictures) check_replaceable_picture(folder / picture, way_out);
  for (const auto& [name, recordings] : conditions)
    recordings_.insert(recordings_.end(), recordings.begin(), recordings.end());
  for (const auto& [name, recordings] : conditions)
    for (std::size_t session = 0; session < recordings.size(); ++session)
      check(folder / to_path(events_name(name, session)));
  if (with_pictures) drawing_.emplace("population_picture");
}

/// Table and companion of a recording's events, which go to this place with endings of their own.
void PopulationFolder::check(const fs::path& place) const {
  const fs::path companion = fs::path(place) += ".rtdc";
  std::error_code error;
  for (const fs::path& recording : recordings_)
    if (fs::equivalent(companion, recording, error))
      refuse_path(companion,
                  "is one of the given recordings, which the results would replace; name another folder with -o.");
  check_replaceable(fs::path(place) += ".tsv", mark_of_population_events, Foreign::keep);
  check_companion(command, companion);
}

void PopulationFolder::write(const PopulationReport& report) {
  const std::string json = population_json(report);
  const auto add = [&](const char* name, const std::string& content, std::string_view mark) {
    written_.push_back(options_.folder / to_path(name));
    files_.add_text(written_.back(), content, mark);
  };
  for (const RecordingReport& recording : report.recordings) add_events(recording, report);
  add("population.tsv", population_table(report), mark_of_population_table);
  add("population.json", json, mark_of_population_json);
  if (drawing_) add_pictures(json);
  files_.publish();
  remove_earlier();
}

void PopulationFolder::add_events(const RecordingReport& recording, const PopulationReport& report) {
  const std::string events = population_events_table(recording);
  if (events.empty()) return;
  const fs::path place =
      options_.folder / to_path(events_name(report.conditions[recording.condition].name, recording.session));
  const fs::path table = fs::path(place) += ".tsv", companion = fs::path(place) += ".rtdc";
  files_.add_text(table, events, mark_of_population_events);
  const fs::path scratch = files_.add(companion, [companion] { check_companion(command, companion); });
  written_.insert(written_.end(), {table, companion});
  const std::string missing =
      read_isolated(recording.recording, options_.measuring, watch_of(recording.recording, options_.quiet),
                    [&](const TellProgress& report_progress) {
                      return write_population_companion(scratch, recording, report_progress);
                    });
  if (!missing.empty())
    tell(fmt::format("{}: already uses so many of userdef0 to userdef9 that its companion lacks: {}.",
                     one_line(recording.recording.string(), 200), missing));
}

void PopulationFolder::add_pictures(const std::string& json) {
  const DrawingFolder folder(options_.folder);
  std::string failure = "there is no room for temporary files";
  if (!folder.path().empty() && write_part(folder.path() / "population.json", json) == 0)
    failure = drawing_->finish(folder.path());
  if (!failure.empty())
    return tell(fmt::format("rheocyte: warning: no pictures ({}); the numbers are complete.", one_line(failure, 300)));
  for (const char* const picture : pictures) {
    std::error_code error;
    if (!fs::exists(folder.path() / picture, error)) continue;
    const fs::path place = options_.folder / picture;
    const fs::path scratch = files_.add(place, [place] { check_replaceable_picture(place, way_out); });
    fs::copy_file(folder.path() / picture, scratch, fs::copy_options::overwrite_existing, error);
    if (error) refuse_path(place, fmt::format("cannot be written ({}).", error.message()));
    written_.push_back(place);
  }
}

void PopulationFolder::remove_earlier() const {
  const auto is_earlier = [](const fs::path& file) {
    const std::string name = file.filename().string();
    if (std::ranges::find(pictures, name) != pictures.end()) return is_own_picture(file);
    if (!name.starts_with("events_")) return false;
    return is_own_file(file, mark_of_population_events) ||
           (file.extension() == ".rtdc" && is_companion_of(command, file));
  };
  std::error_code error;
  const auto is_among = [&](const std::vector<fs::path>& files, const fs::path& file) {
    return std::ranges::any_of(files, [&](const fs::path& each) { return fs::equivalent(each, file, error); });
  };
  for (const auto& entry : fs::directory_iterator(options_.folder, error))
    if (entry.is_regular_file(error) && !is_among(written_, entry.path()) && !is_among(recordings_, entry.path()) &&
        is_earlier(entry.path()))
      fs::remove(entry.path(), error);
}

}  // namespace rheocyte
