// What is said of the shapes of a recording.
#pragma once
#include <string>
#include <vector>

#include "extract/shape_verdict.h"

namespace rheocyte {

/// For the terminal: the sentence, the trend, both moduli, the recommended one, and how many red cells there are;
/// nothing if nothing is known.
std::vector<std::string> shape_lines(const ShapeVerdict& verdict);

/// "1.357 +- 0.01 +- 0.027", with the errors that are known.
std::string text_with_errors(const Median& median, int digits = 4);

}  // namespace rheocyte
