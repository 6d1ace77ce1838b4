#include "report/companion_writer.h"

#include <algorithm>
#include <numeric>

#include "events/companion_origin.h"
#include "measurement/text_table.h"

namespace rheocyte {

CompanionWriter::CompanionWriter(const std::filesystem::path& file, const Recording& recording)
    : file_(file, recording, program()), recording_(recording), free_(free_features(recording)) {
  std::ranges::reverse(free_);
}

void CompanionWriter::add(const std::vector<ColumnDescription>& columns, Naming naming) {
  std::vector<std::size_t> order(columns.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return columns[k].rank; });
  for (const std::size_t k : order)
    if (!columns[k].role.empty()) name(k, columns[k], naming);
}

void CompanionWriter::name(std::size_t column, const ColumnDescription& about, Naming naming) {
  const bool is_known = about.rank == 0, is_free = !is_known && naming == Naming::free_features;
  if (is_free && free_.empty()) return missing_.push_back(about.role);
  const std::string& feature = names_.emplace_back(column, is_free ? free_.back() : about.role).second;
  if (is_free) free_.pop_back();
  add_feature(feature);
  if (!is_known) describe_feature(file_, feature, about.role, about.sentence);
}

void CompanionWriter::add_feature(const std::string& name, bool is_stored) {
  features_.insert(name);
  if (is_stored)
    file_.add_feature_of(recording_, name);
  else
    file_.add_feature(name);
}

void CompanionWriter::add_origin(const std::string& command, const std::filesystem::path& folder,
                                 const std::vector<std::string>& lines) {
  rheocyte::add_origin(file_, command, recording_, folder, lines);
}

void CompanionWriter::write(std::size_t first, std::span<const std::span<const double>> columns) {
  for (const auto& [column, feature] : names_) file_.write(feature, first, columns[column]);
}

void CompanionWriter::close() {
  if (is_text_table(recording_.file())) write_other_columns();
  file_.close();
}

void CompanionWriter::write_other_columns() {
  std::vector<double> values(recording_.events());
  for (const std::string& feature : recording_.scalar_names()) {
    if (features_.contains(feature)) continue;
    recording_.read_scalar(feature, 0, values);
    add_feature(feature, true);
    write(feature, 0, values);
  }
}

}  // namespace rheocyte
