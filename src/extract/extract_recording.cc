#include "extract/extract_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "case/user_error.h"
#include "extract/companion_origin.h"
#include "extract/event_table.h"
#include "extract/extraction.h"
#include "measurement/companion_file.h"
#include "store/own_file.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

std::string meaning_of_states() {
  std::string text = "state of emodulus:";
  for (std::size_t k = 0; k < names_of_modulus_states.size(); ++k)
    text += fmt::format("{} {} {}", k == 0 ? "" : ",", k, names_of_modulus_states[k]);
  return text;
}

/// Names of features for what the field's programs have no name for: of userdef0 to userdef9 those that the recording
/// does not use itself. Empty if there are not enough.
struct FreeNames {
  std::string state, standard_error;

  FreeNames(const Recording& recording, bool has_errors) {
    std::vector<std::string> free;
    for (int k = 0; k < 10; ++k)
      if (const auto name = fmt::format("userdef{}", k); !recording.has_scalar(name)) free.push_back(name);
    if (!free.empty()) state = free[0];
    if (has_errors && free.size() > 1) standard_error = free[1];
  }
};

void describe(CompanionFile& companion, const fs::path& folder, const Recording& recording,
              const Extraction& extraction, const FreeNames& names) {
  companion.add_user_metadata("rheocyte emodulus", "Young's modulus (kPa), with the settings in the log");
  for (const auto& [name, role, meaning] :
       {std::tuple(names.state, "state", meaning_of_states()),
        std::tuple(names.standard_error, "standard error",
                   std::string("standard error of emodulus (kPa), of pixels, table and inertia"))}) {
    if (name.empty()) continue;
    companion.add_user_metadata("rheocyte " + name, meaning);
    companion.add_user_metadata(std::string("rheocyte ") + role, name);
  }
  companion.add_user_metadata("rheocyte table", extraction.table().origin().identifier);
  add_origin(companion, "extract", recording, folder, extraction.lines());
}

/// Both files of a recording, block by block. The companion holds area and deformation, too: the recording may only
/// imply them, or be moved away.
class Writers {
 public:
  Writers(const ExtractFiles& files, const Recording& recording, const Extraction& extraction)
      : companion_(files.companion(), recording, program()), names_(recording, extraction.table().is_own()) {
    describe(companion_, fs::absolute(files.companion()).parent_path(), recording, extraction, names_);
    for (const auto& feature :
         {std::string("emodulus"), std::string("area_um"), std::string("deform"), names_.state, names_.standard_error})
      if (!feature.empty()) companion_.add_feature(feature);
    if (!files.events()) return;
    auto remarks = extraction.lines();
    remarks.insert(remarks.begin(), {program() + " extract", "recording: " + recording.file().string()});
    table_.emplace(*files.events(), remarks, extraction.table().is_own());
  }

  void write(std::size_t first, const EventBlock& block) {
    states_.resize(block.state.size());
    std::ranges::transform(block.state, states_.begin(), [](ModulusState s) { return static_cast<double>(s); });
    companion_.write("emodulus", first, block.young_modulus_kPa);
    companion_.write("area_um", first, block.area_um2);
    companion_.write("deform", first, block.deformation);
    if (!names_.state.empty()) companion_.write(names_.state, first, states_);
    if (!names_.standard_error.empty()) companion_.write(names_.standard_error, first, block.standard_error_kPa);
    if (table_) table_->append(block);
  }

  void close() {
    companion_.close();
    if (table_) table_->close();
  }

  /// What has no place in the companion; empty if everything has.
  std::string missing(const Extraction& extraction) const {
    if (names_.state.empty())
      return "the recording uses userdef0 to userdef9 itself; states and standard errors are in the table of events "
             "only.";
    if (extraction.table().is_own() && names_.standard_error.empty())
      return "the recording uses nine userdef features itself; standard errors are in the table of events only.";
    return {};
  }

 private:
  CompanionFile companion_;
  FreeNames names_;
  std::optional<EventTable> table_;
  std::vector<double> states_;
};

}  // namespace

ExtractFiles::ExtractFiles(const ExtractOutput& output, bool with_events)
    : place_(output.companion), companion_(output.companion, [place = output.companion] { check_companion(place); }) {
  if (with_events)
    events_.emplace(output.events,
                    [place = output.events] { check_replaceable(place, mark_of_events(place), Foreign::keep); });
}

std::optional<fs::path> ExtractFiles::events() const {
  if (!events_) return {};
  return events_->scratch();
}

void ExtractFiles::publish() {
  // Two calls on one recording leave the files of one of them.
  const Claim alone = wait_for_folder(place_.parent_path());
  companion_.check();
  if (events_) events_->publish();
  companion_.publish();
}

ExtractSummary extract_recording(const fs::path& file, const ExtractFiles& files, const ExtractOptions& options,
                                 const ModulusTables& tables, const TellProgress& on_progress) {
  Recording recording(file);
  check_same_recording(files.place(), recording);
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
  ExtractSummary summary = extraction.summary();
  if (const auto missing = writers.missing(extraction); !missing.empty()) summary.warnings.push_back(missing);
  return summary;
}

}  // namespace rheocyte
