// Names of columns, and their roles in companions, in files of the version before, which this one still reads.
#pragma once
#include <span>
#include <string_view>

namespace rheocyte {

struct FormerName {
  std::string_view former, present;
};

std::span<const FormerName> former_names();

/// The present name of a column; of a name that has not changed the name itself.
std::string_view present_name(std::string_view name);

}  // namespace rheocyte
