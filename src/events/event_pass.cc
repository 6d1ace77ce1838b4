#include "events/event_pass.h"

#include <algorithm>
#include <utility>

namespace rheocyte {

EventPass::EventPass(Recording& recording, TellProgress tell) : recording_(recording), tell_(std::move(tell)) {
  goes_on_ = now_and_then([this] { tell_(done_); });
  recording_.on_piece(goes_on_);
}

void EventPass::in_blocks(std::size_t at_a_time, const std::function<void(std::size_t, std::size_t)>& work) {
  const std::size_t events = recording_.events();
  for (std::size_t first = 0; first < events; first += at_a_time) {
    const std::size_t count = std::min(at_a_time, events - first);
    work(first, count);
    tell_(done_ = static_cast<double>(first + count) / static_cast<double>(events));
  }
}

}  // namespace rheocyte
