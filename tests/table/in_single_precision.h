// Numbers as the file of a table keeps them.
#pragma once
#include <vector>

namespace rheocyte::test {

inline std::vector<double> in_single_precision(std::vector<double> values) {
  for (double& value : values) value = static_cast<float>(value);
  return values;
}

}  // namespace rheocyte::test
