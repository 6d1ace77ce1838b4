#include <windows.h>
// After it.
#include <shellapi.h>

#include <cstdint>
#include <utility>

#include "case/to_path.h"
#include "serve/open_browser.h"

namespace rheocyte {

StartedBrowser::StartedBrowser(const std::string& address) : child_(-1) {
  constexpr std::intptr_t last_failure = 32;
  const auto done = ::ShellExecuteW(nullptr, L"open", to_path(address).c_str(), nullptr, nullptr, SW_SHOW);
  has_failed_ = reinterpret_cast<std::intptr_t>(done) <= last_failure;
}

bool StartedBrowser::has_just_failed() { return std::exchange(has_failed_, false); }

}  // namespace rheocyte
