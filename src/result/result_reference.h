// The files of a result for readers: `rheocyte help result` and docs/result-reference.md, made from the lists that the
// files themselves are made from.
#pragma once
#include <string>

namespace rheocyte {

/// Plain text for a terminal, or the Markdown document.
std::string result_reference(bool markdown);

}  // namespace rheocyte
