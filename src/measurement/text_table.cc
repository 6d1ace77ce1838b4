#include "measurement/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>

#include "case/stripped.h"
#include "case/user_error.h"
#include "numeric/no_value.h"
#include "numeric/number_from_chars.h"

namespace rheocyte {

namespace {

constexpr std::size_t longest_shown = 40;  // bytes of a cell in a message

/// Takes the cells of a line one by one.
class Cells {
 public:
  Cells(std::string_view line, char separator) : rest_(line), separator_(separator) {}

  bool are_left() const { return are_left_; }

  /// Without blanks and quotes around it.
  std::string_view next() {
    while (rest_.starts_with(' ')) rest_.remove_prefix(1);
    const std::size_t quote = rest_.starts_with('"') ? rest_.find('"', 1) : std::string_view::npos;
    const std::size_t end = rest_.find(separator_, quote == std::string_view::npos ? 0 : quote);
    std::string_view cell = rest_.substr(0, end);
    are_left_ = end != std::string_view::npos;
    rest_.remove_prefix(are_left_ ? end + 1 : rest_.size());
    while (cell.ends_with(' ')) cell.remove_suffix(1);
    return without_quotes(cell);
  }

  static std::string_view without_quotes(std::string_view text) {
    return text.size() > 1 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
  }

 private:
  std::string_view rest_;
  char separator_;
  bool are_left_ = true;
};

std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (Cells rest(line, separator); rest.are_left();) cells.emplace_back(rest.next());
  return cells;
}

/// That of a line of names, in which quoted names may contain the others.
char separator_of(std::string_view line) {
  for (const char separator : {'\t', ';'})
    if (cells_of(line, separator).size() > 1) return separator;
  return ',';
}

/// NaN of an empty cell and of the words of R, Python and databases for one; nothing of another text.
std::optional<double> number_in(std::string_view cell) {
  double value = no_value;
  const auto [end, error] = number_from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error == std::errc() && end == cell.data() + cell.size()) return value;
  constexpr std::array<std::string_view, 7> missing{"", "NA", "N/A", "<NA>", "None", "null", "NULL"};
  return std::ranges::find(missing, cell) != missing.end() ? std::optional(no_value) : std::nullopt;
}

bool has_decimal_comma(std::string_view cell) {
  std::string with_point(cell);
  std::ranges::replace(with_point, ',', '.');
  return with_point != cell && number_in(with_point);
}

/// All names of dclab's features are of this form.
bool is_feature(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; }) &&
         std::isdigit(static_cast<unsigned char>(name.front())) == 0;
}

class TextReader {
 public:
  TextReader(std::string_view text, const std::string& file) : rest_(text), file_(file) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";  // of the order of bytes
    if (rest_.starts_with(mark)) rest_.remove_prefix(mark.size());
  }

  TextTable read() {
    while (const auto line = next_line()) {
      const std::size_t begin = line->find_first_not_of(' ');
      if (begin == std::string_view::npos) continue;
      if (line->at(begin) == '#')
        take_comment(line->substr(begin));
      else if (sources_.empty())
        take_first_line(*line);
      else
        take_event(*line);
    }
    if (sources_.empty())
      throw UserError(fmt::format("{}: is empty; its first line must name columns, such as area_um,deform.", file_));
    return std::move(table_);
  }

 private:
  [[noreturn]] void refuse(std::string_view reason) const {
    throw UserError(fmt::format("{}: line {}{}", file_, line_, reason));
  }

  /// Without its end, whatever system wrote it.
  std::optional<std::string_view> next_line() {
    if (rest_.empty()) return {};
    ++line_;
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  /// "# section:key = value", before which dclab writes "dc:", or perhaps the names of the columns.
  void take_comment(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of("# "), line.size()));
    const std::size_t equals = line.find('=');
    std::string_view key = stripped(line.substr(0, equals));
    if (key.starts_with("dc:")) key.remove_prefix(3);
    const std::size_t colon = key.find(':');
    if (equals == std::string_view::npos || colon == std::string_view::npos || !is_feature(key.substr(0, colon))) {
      if (sources_.empty()) comments_.push_back(line);
      return;
    }
    const std::string_view value = Cells::without_quotes(stripped(line.substr(equals + 1)));
    add_metadata(table_.metadata, std::string(key), std::string(value), fmt::format("{}: line {}", file_, line_));
  }

  /// Names, or numbers whose names are in a comment.
  void take_first_line(std::string_view line) {
    separator_ = separator_of(line);
    const std::vector<std::string> cells = cells_of(line, separator_);
    const auto is_number = [](std::string_view cell) { return number_in(cell).has_value(); };
    if (!std::ranges::all_of(cells, is_number)) return take_names(cells);
    for (const std::string_view comment : comments_)
      if (const auto names = cells_of(comment, separator_);
          names.size() == cells.size() && std::ranges::all_of(names, is_feature)) {
        take_names(names);
        return take_event(line);
      }
    refuse(" contains numbers, but no line before names their columns; put one before it, such as area_um,deform.");
  }

  void take_names(const std::vector<std::string>& names) {
    if (names.size() == 1 && names.front().find(' ') != std::string::npos)
      refuse(" has no comma, semicolon or tab between the names of columns; separate columns by one of these.");
    std::set<std::string_view> seen;
    for (const std::string& name : names) {
      if (is_feature(name) && !seen.insert(name).second)
        refuse(fmt::format(" names the column {} twice; give each column its own name.", shown(name)));
      if (!is_feature(name) && !name.empty()) table_.left_out.push_back(shown(name) + " (no name of a feature)");
    }
    sources_ = names;
    columns_.assign(names.size(), none);
  }

  void take_event(std::string_view line) {
    if (!has_events_) begin_events(line);
    std::size_t place = 0;
    for (Cells cells(line, separator_); cells.are_left(); ++place) {
      const std::string_view cell = cells.next();
      const std::size_t column = place < columns_.size() ? columns_[place] : none;
      if (column == none) continue;
      const auto value = number_in(cell);
      if (!value) refuse_cell(place, cell);
      table_.columns[column].values.push_back(*value);
    }
    if (place != columns_.size()) refuse_length(place);
  }

  /// What is no number in the first event is taken for words in all events.
  void begin_events(std::string_view line) {
    has_events_ = true;
    std::size_t place = 0;
    for (Cells cells(line, separator_); cells.are_left() && place < sources_.size(); ++place) {
      const std::string_view cell = cells.next();
      const std::string& name = sources_[place];
      if (!is_feature(name)) continue;
      if (has_decimal_comma(cell)) refuse_cell(place, cell);
      if (!number_in(cell)) {
        table_.left_out.push_back(
            fmt::format("{} (\"{}\" in line {} is not a number)", shown(name), shown(cell), line_));
        continue;
      }
      columns_[place] = table_.columns.size();
      table_.columns.push_back({name, {}});
    }
  }

  [[noreturn]] void refuse_cell(std::size_t place, std::string_view cell) const {
    refuse(fmt::format(", column {}: \"{}\" {}.", shown(sources_[place]), shown(cell),
                       has_decimal_comma(cell)
                           ? "has a decimal comma; export the table with decimal points"
                           : "is not a number; correct it, leave the cell empty or remove the column"));
  }

  [[noreturn]] void refuse_length(std::size_t cells) const {
    const std::size_t names = sources_.size();
    const bool is_first = table_.columns.empty() || table_.columns.front().values.size() == 1;
    const char* hint = "export the table again";
    if (is_first && cells == names + 1) hint = "give each column a name (in R: row.names = FALSE)";
    if (is_first && separator_ == ',' && cells == 2 * names) hint = "export numbers with decimal points, not commas";
    refuse(fmt::format(" has {} cell{}, but there are {} names of columns; {}.", cells, cells == 1 ? "" : "s", names,
                       hint));
  }

  static std::string shown(std::string_view text) { return one_line(text, longest_shown); }

  static constexpr auto none = static_cast<std::size_t>(-1);

  std::string_view rest_;
  const std::string& file_;
  std::size_t line_ = 0;
  std::vector<std::string_view> comments_;  ///< before the names
  char separator_ = ',';
  std::vector<std::string> sources_;  ///< names of the columns of the text
  std::vector<std::size_t> columns_;  ///< where each of them goes
  bool has_events_ = false;
  TextTable table_;
};

}  // namespace

bool is_text_table(const std::filesystem::path& file) {
  const std::string ending = in_small_letters(file.extension().string());
  return ending == ".csv" || ending == ".tsv" || ending == ".txt";
}

TextTable parse_text_table(std::string_view text, const std::string& file) { return TextReader(text, file).read(); }

void add_metadata(MetadataTexts& metadata, const std::string& key, const std::string& value, const std::string& place) {
  const auto [there, is_new] = metadata.try_emplace(key, value);
  if (is_new || there->second == value) return;
  if (const auto number = number_in(value); number && number == number_in(there->second)) return;
  throw UserError(fmt::format("{}: {} is \"{}\", but elsewhere \"{}\"; keep one of them.", place, one_line(key, 60),
                              one_line(value, longest_shown), one_line(there->second, longest_shown)));
}

}  // namespace rheocyte
