#include "report/row_column.h"

#include <fmt/format.h>

namespace rheocyte {

std::string cell_text(const CellValue& value, int digits) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return fmt::format("{:.{}g}", std::get<double>(value), digits);
}

}  // namespace rheocyte
