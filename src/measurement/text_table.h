// A table of events as text: columns of numbers under the names of features, and comments with metadata
// (docs/text-recordings.md).
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rheocyte {

/// Metadata by "section:key", as text.
using MetadataTexts = std::map<std::string, std::string>;

struct TextTable {
  struct Column {
    std::string feature;
    std::vector<double> values;  ///< one per event; NaN in empty cells
  };
  std::vector<Column> columns;
  MetadataTexts metadata;             ///< of comments "# section:key = value"
  std::vector<std::string> left_out;  ///< columns that are no features, or contain no numbers: which, and why
};

/// By its name: .csv, .tsv, .txt.
bool is_text_table(const std::filesystem::path& file);

/// Cells are separated by tabs, semicolons or commas and may be quoted; numbers have decimal points. Names of columns
/// are in the first line that is no comment, or, as dclab exports them, in a comment. `file` stands in messages.
/// UserError with the line.
TextTable parse_text_table(std::string_view text, const std::string& file);

/// Adds one value. UserError, which begins with `place`, if the key has another value already.
void add_metadata(MetadataTexts& metadata, const std::string& key, const std::string& value, const std::string& place);

}  // namespace rheocyte
