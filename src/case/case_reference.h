// The table of parameters for readers: `rheocyte help case` and docs/case-reference.md.
#pragma once
#include <string>

namespace rheocyte {

/// Plain text for a terminal.
std::string case_reference_text();

/// The Markdown document docs/case-reference.md.
std::string case_reference_markdown();

}  // namespace rheocyte
