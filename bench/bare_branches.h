// The branches of a table whose surface is bare.
#pragma once
#include <vector>

#include "table/table_folder.h"

namespace rheocyte {

/// Those that are computed; the table need not be complete.
inline std::vector<SampledBranch> bare_branches(const TableFolder& folder) {
  std::vector<SampledBranch> branches;
  for (int i = 0; i < folder.branches(); ++i)
    if (folder.has(i, false)) branches.push_back(folder.read(i, false));
  return branches;
}

}  // namespace rheocyte
