// The user's browser.
#pragma once
#include <string>

namespace rheocyte {

/// Opened by the desktop's own means (xdg-open), which other users see in the list of processes with the address.
class StartedBrowser {
 public:
  explicit StartedBrowser(const std::string& address);
  /// True once, when no browser could be opened. To be asked now and then.
  bool has_just_failed();

 private:
  int child_;
  bool has_failed_ = false;
};

}  // namespace rheocyte
