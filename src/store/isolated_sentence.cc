#include <fmt/format.h>

#include "case/user_error.h"
#include "store/isolated.h"

namespace rheocyte {

std::string sentence_for(const std::filesystem::path& recording, const IsolatedEnd& end, double patience_s) {
  const std::string name = one_line(recording.string(), 300);
  using Kind = IsolatedEnd::Kind;
  switch (end.kind) {
    case Kind::user_error: return end.text;
    case Kind::no_memory:
      return fmt::format("{}: reading it needs more memory than any intact recording does; it is damaged.", name);
    case Kind::hung:
      return fmt::format(
          "{}: nothing could be read for {} s; it is damaged, or its drive does not answer (--patience "
          "waits longer).",
          name, patience_s);
    case Kind::killed:
      return fmt::format("{}: reading it was ended from outside ({}), perhaps for lack of memory; try again.", name,
                         one_line(end.text, 100));
    case Kind::broke_down:
      return fmt::format(
          "{}: the HDF5 library broke down while reading it ({}); most likely it is damaged: copy it once "
          "more from where it was recorded, and if that changes nothing, please report it.",
          name, one_line(end.text, 100));
    default:
      return fmt::format("{}: an error of the program itself, please report it: {}", name, one_line(end.text, 300));
  }
}

}  // namespace rheocyte
