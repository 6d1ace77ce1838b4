#include "report/extract_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "case/json_guard.h"
#include "case/user_error.h"
#include "events/companion_origin.h"
#include "events/event_pass.h"
#include "extract/extraction.h"
#include "report/companion_shapes.h"
#include "report/companion_writer.h"
#include "report/event_columns.h"
#include "report/event_table.h"
#include "report/recommended_columns.h"
#include "store/own_file.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

/// Both files of a recording, block by block. The companion holds area, deformation, volume and inertia ratios, too:
/// the recording may only imply them, or be moved away.
class Writers {
 public:
  Writers(const ExtractFiles& files, const Recording& recording, Extraction& extraction)
      : companion_(files.companion(), recording), values_(event_columns(extraction.knowledge())) {
    companion_.add_metadata("rheocyte emodulus", "Young's modulus (kPa), with the settings in the log");
    companion_.add_metadata("rheocyte table", extraction.table().origin().identifier);
    const auto columns = descriptions(values_.columns());
    companion_.add(columns,
                   files.for_ourselves() ? CompanionWriter::Naming::roles : CompanionWriter::Naming::free_features);
    companion_.add_origin("extract", fs::absolute(files.companion()).parent_path(), extraction.lines());
    companion_.add_feature("area_um", extraction.shapes().area_from() == "area_um");
    companion_.add_feature("deform", extraction.shapes().deformation_from() == "deform");
    if (!files.for_ourselves()) shapes_.emplace(companion_, recording, extraction);
    if (!files.events()) return;
    auto remarks = extraction.lines();
    remarks.insert(remarks.begin(), {program() + " extract", "recording: " + recording.file().string()});
    table_.emplace(*files.events(), remarks, columns);
  }

  void write(std::size_t first, const EventBlock& block) {
    companion_.write("area_um", first, block.area_um2);
    companion_.write("deform", first, block.deformation);
    if (shapes_) shapes_->write(first, block);
    const auto values = values_.of(block);
    companion_.write(first, values);
    if (table_) table_->append(values);
  }

  void close(const ExtractSummary& summary) {
    companion_.add_metadata("rheocyte recommended", json_line(recommended_json(summary)));
    companion_.close();
    if (!table_) return;
    table_->remark(recommended_lines(summary));
    table_->close();
  }

  /// What has no place in the companion and would be missed there; empty if everything has.
  std::string missing() const {
    std::string roles;
    for (const auto& [role, word] :
         {std::pair("state", "state"), std::pair("young_modulus_kPa_error", "standard error")})
      if (std::ranges::count(companion_.missing(), role) > 0) roles.append(roles.empty() ? "" : " and ").append(word);
    if (roles.empty()) return {};
    return fmt::format(
        "the recording already uses so many of userdef0 to userdef9 that {} of the moduli {} only in the table of "
        "events.",
        roles, roles.find(" and ") == std::string::npos ? "is" : "are");
  }

 private:
  CompanionWriter companion_;
  std::optional<CompanionShapes> shapes_;
  BlockValues<EventBlock> values_;
  std::optional<EventTable> table_;
};

}  // namespace

ExtractFiles::ExtractFiles(const ExtractOutput& output, bool with_events)
    : place_(output.companion), for_ourselves_(output.for_ourselves) {
  if (with_events)
    events_ = files_.add(output.events,
                         [place = output.events] { check_replaceable(place, mark_of_events(place), Foreign::keep); });
  companion_ = files_.add(place_, [place = place_] { check_companion("extract", place); });
}

void check_against_tables(const ExtractOptions& options, const ModulusTables& tables) {
  if (options.no_area_correction && !tables.own())
    throw UserError(fmt::format(
        "rheocyte: --no-area-correction and --table {} contradict each other; published tables are used with areas "
        "as measured always.",
        one_line(options.table, 200)));
}

ExtractSummary extract_recording(const fs::path& file, const ExtractFiles& files, const ExtractOptions& options,
                                 const ModulusTables& tables, const TellProgress& on_progress) {
  Recording recording(file);
  check_same_recording(files.place(), recording);
  EventPass events(recording, on_progress);
  return extract_in_passes(recording, options, tables, events, [&](Extraction& extraction) {
    Writers writers(files, recording, extraction);
    events.in_blocks(extraction.block(), [&](std::size_t first, std::size_t count) {
      writers.write(first, extraction.compute(first, count));
    });
    ExtractSummary summary = extraction.summary();
    writers.close(summary);
    if (const auto missing = writers.missing(); !missing.empty()) summary.warnings.push_back(missing);
    return summary;
  });
}

}  // namespace rheocyte
