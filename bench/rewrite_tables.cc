// Replaces files of tables from former versions by what this one writes: rewrite_tables FILE...
#include <fmt/format.h>

#include <filesystem>

#include "program.h"
#include "store/file_writer.h"
#include "store/read_file.h"
#include "table/rewritten_table.h"

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("rewrite_tables FILE...\n"), 2;
  constexpr std::size_t largest = std::size_t{256} << 20U;
  for (int k = 1; k < argc; ++k) {
    const std::filesystem::path place = argv[k];
    const std::string bytes = content_of_file(place, largest);
    const std::string written = rewritten_table(bytes, place.filename().string());
    FileWriter file(place);
    file.append(written);
    file.close();
    fmt::print("{}: {} bytes, before {}\n", argv[k], written.size(), bytes.size());
  }
  return 0;
}
