#include "report/summary_table.h"

#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "case/split.h"
#include "report/former_names.h"
#include "report/rows_text.h"
#include "report/summary_columns.h"
#include "store/claim.h"
#include "store/own_file.h"
#include "store/read_file.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

/// The words with which one of ours begins, or those of an older version if the file begins with them.
std::string_view mark_of_summary(const fs::path& file) {
  constexpr std::string_view mark = "recording\trecommended_modulus\t", former = "recording\tevents\tvalid\t";
  return first_bytes(file, former.size()) == former ? former : mark;
}

/// By the names of their columns.
using Row = std::map<std::string, std::string, std::less<>>;

Row row_of(const SummaryLine& line) {
  Row row{{"recording", line.recording.string()}};
  if (line.error.empty())
    for (const auto& column : summary_columns()) row[column.name] = summary_text(column, line.summary);
  else
    row["remarks"] = line.error;
  return row;
}

std::vector<Row> rows_in(std::string_view text) {
  std::vector<Row> rows;
  const auto lines = split(text, '\n');
  const auto names = split(lines.front(), '\t');
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const auto cells = split(lines[k], '\t');
    if (cells.size() != names.size()) continue;  // the end of the text
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) row[std::string(present_name(names[i]))] = cells[i];
  }
  return rows;
}

std::string content_of(const fs::path& path) {
  constexpr std::size_t enough = std::size_t{64} << 20U;
  return first_bytes(path, enough).value_or("");
}

fs::path name_in_summary(const fs::path& recording, const fs::path& folder) {
  std::error_code error;
  const fs::path full = fs::weakly_canonical(fs::absolute(recording).parent_path(), error) / recording.filename();
  const fs::path relative = full.lexically_relative(folder);
  return relative.empty() || *relative.begin() == ".." ? full : relative;
}

}  // namespace

std::string summary_table(std::span<const SummaryLine> lines, std::string_view earlier) {
  std::map<std::string, Row> by_recording;
  for (auto& row : rows_in(earlier)) by_recording[row["recording"]] = std::move(row);
  for (const auto& line : lines) by_recording[table_cell(line.recording.string())] = row_of(line);
  std::string text = "recording\t" + header_text(summary_columns());
  for (auto& [recording, row] : by_recording) {
    text.append(recording);
    for (const auto& column : summary_columns()) text.append("\t").append(table_cell(row[column.name]));
    text.append("\n");
  }
  return text;
}

void check_place_of_summary(const fs::path& file) { check_replaceable(file, mark_of_summary(file), Foreign::keep); }

void add_to_summary(const fs::path& file, std::span<const SummaryLine> lines) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(fs::absolute(file).parent_path(), error);
  fs::create_directories(folder, error);
  std::vector<SummaryLine> named(lines.begin(), lines.end());
  for (auto& line : named) line.recording = name_in_summary(line.recording, folder);
  const Claim alone = wait_for_folder(folder);
  check_place_of_summary(file);
  replace_own_file(file, summary_table(named, content_of(file)), mark_of_summary(file), Foreign::keep);
}

}  // namespace rheocyte
