#include "shelf/shipped_tables.h"

#include <fmt/format.h>

#include <system_error>

#include "case/user_error.h"
#include "store/build_info.h"
#include "store/supplied_folder.h"
#include "table/table_files.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

fs::path tables_folder(const fs::path& given = {}) {
  return given.empty() ? supplied_folder("RHEOCYTE_TABLES", "../share/rheocyte/tables", data_folder) : given;
}

/// A name that is no table of this kind.
[[noreturn]] void refuse(const std::string& wanted, std::string_view kind, std::string_view noun,
                         const std::string& usual) {
  const std::string place = fmt::format("rheocyte: --table {}: ", one_line(wanted, 200));
  for (const std::string_view other : {"grid", "elongated", "combined", "dynamic"})
    if (other != kind && table_files(tables_folder(), other).contains(wanted))
      throw UserError(fmt::format("{}it is not a {}; the program provides {}.", place, noun, usual));
  throw UserError(
      fmt::format("{}there is no such file or folder. The program provides {}; `rheocyte table` computes any other {} "
                  "in two minutes to two hours (docs/tables.md).",
                  place, usual, noun));
}

/// `usual`: the identifier of the one that is taken where none is wanted.
fs::path wanted_or_shipped(const fs::path& wanted, std::string_view kind, std::string_view noun,
                           const std::string& usual) {
  std::error_code error;
  if (!wanted.empty() && fs::exists(wanted, error)) return wanted;
  const auto shipped = table_files(tables_folder(), kind);
  const auto found = shipped.find(wanted.empty() ? usual : wanted.string());
  if (wanted.empty() && found == shipped.end())
    throw UserError(fmt::format(
        "rheocyte: the {} that comes with the program is missing in {}; install the program again, or give --table.",
        noun, tables_folder().string()));
  if (found == shipped.end()) refuse(wanted.string(), kind, noun, usual);
  return found->second;
}

}  // namespace

std::map<std::string, fs::path> shipped_tables(const fs::path& folder) {
  return table_files(tables_folder(folder), "grid");
}

std::map<std::string, fs::path> shipped_elongated_tables(const fs::path& folder) {
  return table_files(tables_folder(folder), "elongated");
}

std::map<std::string, fs::path> shipped_combined_tables(const fs::path& folder) {
  return table_files(tables_folder(folder), "combined");
}

std::map<std::string, fs::path> shipped_dynamic_tables() { return table_files(tables_folder(), "dynamic"); }

fs::path combined_table_or_shipped(const fs::path& wanted) {
  return wanted_or_shipped(wanted, "combined", "table of cells with bulk and cortex", "HC-2D-NH-26");
}

fs::path dynamic_table_or_shipped(const fs::path& wanted) {
  return wanted_or_shipped(wanted, "dynamic", "dynamic table", "HE-chip-26");
}

}  // namespace rheocyte
