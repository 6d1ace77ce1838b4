// The browser of the desktop.
#pragma once
#include <functional>
#include <string>

namespace rheocyte {

/// Opens the address by xdg-open, in a process that outlives this one. `fail` is called, by a thread of its own, if
/// there is no such program or it finds no browser.
void open_browser(const std::string& address, std::function<void()> fail);

}  // namespace rheocyte
