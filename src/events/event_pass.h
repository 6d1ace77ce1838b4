// All events of a recording in turn, and how far that has come.
#pragma once
#include <cstddef>
#include <functional>

#include "measurement/recording.h"
#include "store/watch.h"

namespace rheocyte {

class EventPass {
 public:
  /// As long as it lives, reading the recording reports that it goes on, also where a single read takes long. The
  /// recording must outlive it.
  EventPass(Recording& recording, TellProgress tell);
  ~EventPass() { recording_.on_piece({}); }
  EventPass(const EventPass&) = delete;
  EventPass& operator=(const EventPass&) = delete;

  /// For long work on single events: reports that it goes on. It may be asked as often as one likes.
  Watch watch() const { return {.alive = goes_on_}; }

  /// work(first, count) on events [first, first + count), with `at_a_time` events but for the last block.
  void in_blocks(std::size_t at_a_time, const std::function<void(std::size_t first, std::size_t count)>& work);

 private:
  Recording& recording_;
  TellProgress tell_;
  double done_ = 0;
  std::function<void()> goes_on_;
};

}  // namespace rheocyte
