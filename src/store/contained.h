// Work that may break its process, done in a process of its own: HDF5 is known to crash on some damaged files.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "store/bytes.h"
#include "store/progress.h"

namespace rheocyte {

/// What the contained work may use.
struct Containment {
  std::size_t memory_bytes = std::size_t{4} << 30U;
  double patience_s = 60;                ///< without a word of progress it counts as hanging
  std::function<bool()> is_wanted = {};  ///< asked several times a second; once it is false, the work is stopped
};

struct ContainedEnd {
  enum class Kind {
    finished,
    user_error,  ///< `text` is the sentence
    own_error,   ///< another exception; `text` says which
    broke_down,  ///< a signal ended it; `text` names it
    killed,      ///< by somebody else, for example by the system that is short of memory; `text` names the signal
    no_memory,   ///< the limit was reached
    hung,        ///< killed, because it was silent for too long
    stopped      ///< killed, because the user wants to stop
  };
  Kind kind = Kind::broke_down;
  std::string text = {};
};

template <class Result>
struct Contained {
  ContainedEnd end;
  Result result{};  ///< of work that has finished

  bool finished() const { return end.kind == ContainedEnd::Kind::finished; }
  bool stopped() const { return end.kind == ContainedEnd::Kind::stopped; }
};

/// What it returns comes back as the text of the end.
using ContainedWork = std::function<std::string(const TellProgress&)>;

/// As run_contained; `text` of work that has finished is what it returned. SystemLimit if the system gives no process.
ContainedEnd run_contained_bytes(const ContainedWork& work, const Containment& limits, const TellProgress& on_progress);

/// Several works, each as by run_contained_bytes, some at once; what they tell and how they ended is told in the
/// caller's thread, while it starts the next one or waits. Where there are no processes, one after another.
class ContainedPool {
 public:
  using OnEnd = std::function<void(ContainedEnd)>;

  explicit ContainedPool(int at_once);
  /// What still runs is ended.
  ~ContainedPool();
  ContainedPool(const ContainedPool&) = delete;
  ContainedPool& operator=(const ContainedPool&) = delete;

  /// Waits for a place. SystemLimit if the system gives no process.
  void start(const ContainedWork& work, const Containment& limits, const TellProgress& on_progress,
             const OnEnd& on_end);
  void wait_for_all();

 private:
  class Run;
  void look();

  int at_once_;
  std::vector<std::unique_ptr<Run>> runs_;
};

/// The result of work that returned it as bytes.
template <class Result>
Contained<Result> contained_from(ContainedEnd end) {
  Contained<Result> contained{std::move(end)};
  if (!contained.finished()) return contained;
  if (auto result = from_bytes<Result>(contained.end.text))
    contained.result = std::move(*result);
  else
    contained.end = {ContainedEnd::Kind::own_error, "its result came back incomplete"};
  return contained;
}

/// Forks, runs `work` in the child, where it may tell its progress, and returns what became of it; the result comes
/// back as bytes (store/bytes.h). The child prints nothing; it does not see SIGINT, SIGTERM and SIGHUP and is killed
/// when the parent has got one. `on_progress` is called in the parent. Of several threads only
/// the one that calls is there in the child: the work must not need what others may hold, such as an interpreter's
/// lock.
template <class Work>
auto run_contained(const Work& work, const Containment& limits, const TellProgress& on_progress) {
  using Result = std::invoke_result_t<const Work&, const TellProgress&>;
  const auto as_bytes = [&](const TellProgress& tell_progress) { return to_bytes(work(tell_progress)); };
  return contained_from<Result>(run_contained_bytes(as_bytes, limits, on_progress));
}

/// What the user is told of a recording whose reading has not finished: one sentence.
std::string sentence_for(const std::filesystem::path& recording, const ContainedEnd& end, double patience_s);

}  // namespace rheocyte
