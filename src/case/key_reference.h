// Lists of keys for readers: `rheocyte help case|table|synth`, and the documents made from it.
#pragma once
#include <string>

#include "case/key.h"

namespace rheocyte {

struct Reference {
  std::string title;        ///< of the document: "Case reference"
  std::string topic;        ///< of `rheocyte help`
  std::string declaration;  ///< file in which the keys stand
  std::string opening;      ///< the sentence before the example
  std::string example;      ///< the shortest file
  std::string rules;        ///< what holds for several keys
  KeyList keys;
};

/// Plain text for a terminal.
std::string reference_text(const Reference&);

/// A Markdown document.
std::string reference_markdown(const Reference&);

/// The keys of a case.
Reference case_reference();

}  // namespace rheocyte
