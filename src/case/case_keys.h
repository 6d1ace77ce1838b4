// All keys of a case file.
#pragma once
#include <span>
#include <string_view>

#include "case/case.h"
#include "case/key.h"

namespace rheocyte {

/// In the order in which they are documented and written.
std::span<const Key<Case>> case_keys();

/// The key with this name; it must exist.
const Key<Case>& case_key(std::string_view name);

/// The option of a choice that a case has, e.g. "newtonian" for "flow.law".
std::string_view chosen_option(const Case&, std::string_view key);

}  // namespace rheocyte
