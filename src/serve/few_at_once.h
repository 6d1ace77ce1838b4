// Work that takes long: only a few requests of its kind go on at once, so that threads are left for all others.
#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "serve/http.h"

namespace rheocyte {

class FewAtOnce {
  struct Leave {
    void operator()(std::atomic<int>* under_way) const { --*under_way; }
  };

 public:
  /// One of them, as long as it lives.
  using Turn = std::unique_ptr<std::atomic<int>, Leave>;

  /// `sentence` states that there are so many already.
  FewAtOnce(int most, std::string sentence) : most_(most), sentence_(std::move(sentence)) {}

  /// For all threads. Refused (503).
  Turn begin() {
    const bool is_too_many = ++under_way_ > most_;
    Turn turn(&under_way_);
    if (is_too_many) throw Refused(503, "busy", sentence_);
    return turn;
  }

 private:
  int most_;
  std::string sentence_;
  std::atomic<int> under_way_ = 0;
};

}  // namespace rheocyte
