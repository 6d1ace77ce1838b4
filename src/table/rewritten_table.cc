#include "table/rewritten_table.h"

#include <fmt/format.h>

#include "case/user_error.h"
#include "table/combined_table.h"
#include "table/dynamic_table.h"
#include "table/elongated_table.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

std::string rewritten_table(std::string_view bytes, const std::string& name) {
  if (name.starts_with("grid_")) return to_bytes(grid_from_bytes(bytes, name));
  if (name.starts_with("elongated_")) return to_bytes(elongated_from_bytes(bytes, name));
  if (name.starts_with("combined_")) return to_bytes(combined_from_bytes(bytes, name));
  if (name.starts_with("dynamic_")) return to_bytes(dynamic_from_bytes(bytes, name));
  throw UserError(fmt::format("{}: the name does not say which kind of table it is.", one_line(name, 300)));
}

}  // namespace rheocyte
