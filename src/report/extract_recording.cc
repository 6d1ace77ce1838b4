#include "report/extract_recording.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/json_guard.h"
#include "case/user_error.h"
#include "events/companion_origin.h"
#include "events/event_pass.h"
#include "extract/extraction.h"
#include "measurement/companion_file.h"
#include "report/companion_shapes.h"
#include "report/event_columns.h"
#include "report/event_table.h"
#include "report/recommended_columns.h"
#include "store/own_file.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

/// A column of the companion for which the field's programs have no name.
struct OwnColumn {
  std::size_t number;  ///< of the column
  std::string role, meaning;
  int rank;
  std::string name = {};  ///< of the feature; empty if there are not enough
};

/// The most important first.
std::vector<OwnColumn> own_columns(const ColumnsOf<EventBlock>& columns) {
  std::vector<OwnColumn> own;
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (const ColumnDescription& c = columns[k]; c.rank > 0) own.push_back({k, c.role, c.sentence, c.rank});
  std::ranges::stable_sort(own, {}, &OwnColumn::rank);
  return own;
}

void give_names(const Recording& recording, std::vector<OwnColumn>& columns) {
  const std::vector<std::string> names = free_features(recording);
  for (std::size_t k = 0; k < std::min(names.size(), columns.size()); ++k) columns[k].name = names[k];
}

void describe(CompanionFile& companion, const fs::path& folder, const Recording& recording,
              const Extraction& extraction, const std::vector<OwnColumn>& columns) {
  companion.add_user_metadata("rheocyte emodulus", "Young's modulus (kPa), with the settings in the log");
  for (const auto& column : columns)
    if (!column.name.empty()) describe_feature(companion, column.name, column.role, column.meaning);
  companion.add_user_metadata("rheocyte table", extraction.table().origin().identifier);
  add_origin(companion, "extract", recording, folder, extraction.lines());
}

/// Both files of a recording, block by block. The companion holds area, deformation, volume and inertia ratios, too:
/// the recording may only imply them, or be moved away.
class Writers {
 public:
  Writers(const ExtractFiles& files, const Recording& recording, Extraction& extraction)
      : companion_(files.companion(), recording, program()),
        values_(event_columns(extraction.knowledge())),
        columns_(own_columns(values_.columns())) {
    if (files.for_ourselves())
      for (auto& column : columns_) column.name = column.role;
    else
      give_names(recording, columns_);
    describe(companion_, fs::absolute(files.companion()).parent_path(), recording, extraction, columns_);
    companion_.add_feature("emodulus");
    add_shape(recording, "area_um", extraction.shapes().area_from());
    add_shape(recording, "deform", extraction.shapes().deformation_from());
    if (!files.for_ourselves()) shapes_.emplace(companion_, recording, extraction);
    for (const auto& column : columns_)
      if (!column.name.empty()) companion_.add_feature(column.name);
    if (!files.events()) return;
    auto remarks = extraction.lines();
    remarks.insert(remarks.begin(), {program() + " extract", "recording: " + recording.file().string()});
    table_.emplace(*files.events(), remarks, descriptions(values_.columns()));
  }

  void write(std::size_t first, const EventBlock& block) {
    companion_.write("emodulus", first, block.young_modulus_kPa);
    companion_.write("area_um", first, block.area_um2);
    companion_.write("deform", first, block.deformation);
    if (shapes_) shapes_->write(first, block);
    const auto values = values_.of(block);
    for (const auto& column : columns_)
      if (!column.name.empty()) companion_.write(column.name, first, values[column.number]);
    if (table_) table_->append(values);
  }

  void close(const ExtractSummary& summary) {
    companion_.add_user_metadata("rheocyte recommended", json_line(recommended_json(summary)));
    companion_.close();
    if (!table_) return;
    table_->remark(recommended_lines(summary));
    table_->close();
  }

  /// What has no place in the companion and would be missed there; empty if everything has.
  std::string missing() const {
    std::string roles;
    for (const auto& column : columns_)
      if (column.name.empty() && (column.role == "state" || column.role == "standard error"))
        roles += (roles.empty() ? "" : " and ") + column.role;
    if (roles.empty()) return {};
    return fmt::format(
        "the recording uses so many of userdef0 to userdef9 itself that {} of the moduli {} in the table "
        "of events only.",
        roles, roles.find(" and ") == std::string::npos ? "is" : "are");
  }

 private:
  void add_shape(const Recording& recording, const std::string& feature, const std::string& source) {
    if (source == feature)
      companion_.add_feature_of(recording, feature);
    else
      companion_.add_feature(feature);
  }

  CompanionFile companion_;
  std::optional<CompanionShapes> shapes_;
  BlockValues<EventBlock> values_;
  std::vector<OwnColumn> columns_;
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
  EventPass pass(recording, on_progress);
  Extraction extraction(recording, options, tables);
  Writers writers(files, recording, extraction);
  pass.in_blocks(extraction.block(),
                 [&](std::size_t first, std::size_t count) { writers.write(first, extraction.compute(first, count)); });
  ExtractSummary summary = extraction.summary();
  writers.close(summary);
  if (const auto missing = writers.missing(); !missing.empty()) summary.warnings.push_back(missing);
  return summary;
}

}  // namespace rheocyte
