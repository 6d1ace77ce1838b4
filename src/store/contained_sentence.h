// What the user is told when a recording could not be read.
#pragma once
#include <filesystem>
#include <string>

#include "store/contained.h"

namespace rheocyte {

/// One sentence for an end of contained work that is not `finished`.
std::string sentence_for(const std::filesystem::path& recording, const ContainedEnd& end, double patience_s);

}  // namespace rheocyte
