// The keys of a spec's section [table].
#pragma once
#include <span>

#include "case/key_reference.h"
#include "table/table_spec.h"

namespace rheocyte {

/// In the order in which they are documented and written.
std::span<const Key<TableSpec>> table_keys();

/// The section [table]; the other keys of a spec are those of a case.
Reference table_reference();

}  // namespace rheocyte
