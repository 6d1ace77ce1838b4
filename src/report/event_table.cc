#include "report/event_table.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

#include "case/user_error.h"
#include "store/read_file.h"

namespace rheocyte {

namespace {

constexpr std::size_t longest_cell = 32;

template <class Number>
char* put(char* at, Number number) {
  return std::to_chars(at, at + longest_cell, number).ptr;
}

char* put_word(char* at, std::string_view word) {
  for (const char c : word) *at++ = c == ' ' ? '_' : c;
  return at;
}

char* put_value(char* at, const ColumnDescription& column, double value) {
  if (!column.words.empty()) return put_word(at, column.words[static_cast<std::size_t>(value)]);
  if (column.digits > 0) return fmt::format_to(at, "{:.{}g}", value, column.digits);
  return std::isnan(value) ? put_word(at, "nan") : put(at, static_cast<float>(value));
}

}  // namespace

std::string_view mark_of_events(const std::filesystem::path& file) {
  constexpr std::string_view former = "# rheocyte ";
  return first_bytes(file, former.size()) == former ? former : first_columns_of_events;
}

std::string commented(const std::vector<std::string>& remarks) {
  std::string text;
  for (const auto& remark : remarks) text.append("# ").append(one_line(remark, 1000)).append("\n");
  return text;
}

EventTable::EventTable(const std::filesystem::path& file, const std::vector<std::string>& remarks,
                       std::vector<ColumnDescription> columns)
    : file_(file), columns_(std::move(columns)) {
  std::string head = "event";
  for (const ColumnDescription& column : columns_) head.append("\t").append(column.name);
  file_.append(head + "\n" + commented(remarks));
}

void EventTable::append(std::span<const std::span<const double>> values) {
  std::vector<std::vector<double>> kept;
  for (const auto& column : values) kept.emplace_back(column.begin(), column.end());
  writing_.add([this, kept = std::move(kept)] { write(kept); });
}

void EventTable::remark(const std::vector<std::string>& remarks) {
  writing_.finish();
  file_.append(commented(remarks));
}

void EventTable::close() {
  writing_.finish();
  file_.close();
}

void EventTable::write(std::span<const std::vector<double>> values) {
  std::vector<char> line(longest_cell * (columns_.size() + 2));
  text_.clear();
  for (std::size_t i = 0; i < values.front().size(); ++i) {
    char* at = put(line.data(), ++events_);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      *at++ = '\t';
      at = put_value(at, columns_[k], values[k][i]);
    }
    *at++ = '\n';
    text_.append(line.data(), at);
  }
  file_.append(text_);
}

}  // namespace rheocyte
