#include "shelf/tube_table.h"

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "shelf/find_table.h"
#include "store/read_file.h"

namespace rheocyte {

void provide_tube_table(const TableFolder& folder) {
  if (!folder.lacks_tube()) return;
  const auto file = find_table(*folder.spec().tube_table, "table.tube_table =");
  const std::string bytes = content_of_file(file, largest_grid);
  grid_from_bytes(bytes, one_line(file.string(), 300));
  folder.publish(TableFolder::tube_table_file, bytes);
}

}  // namespace rheocyte
