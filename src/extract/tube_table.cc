#include "extract/tube_table.h"

#include <fstream>
#include <iterator>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "extract/find_table.h"

namespace rheocyte {

void provide_tube_table(const TableFolder& folder) {
  if (!folder.lacks_tube()) return;
  const auto file = find_table(*folder.spec().tube_table, "table.tube_table =");
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) refuse_path(file, "cannot be read.");
  grid_from_bytes(bytes, one_line(file.string(), 300));
  folder.publish(TableFolder::tube_table_file, bytes);
}

}  // namespace rheocyte
