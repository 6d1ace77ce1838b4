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
#include "store/watch.h"

namespace rheocyte {

/// What the isolated work may use.
struct Isolation {
  std::size_t memory_bytes = std::size_t{4} << 30U;
  double patience_s = 60;  ///< without a word of progress it counts as hanging
};

struct IsolatedEnd {
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
struct Isolated {
  IsolatedEnd end;
  Result result{};  ///< of work that has finished

  bool finished() const { return end.kind == IsolatedEnd::Kind::finished; }
  bool stopped() const { return end.kind == IsolatedEnd::Kind::stopped; }
};

/// What it returns comes back as the text of the end.
using IsolatedWork = std::function<std::string(const TellProgress&)>;

/// As run_isolated; `text` of work that has finished is what it returned. SystemLimit if the system gives no process.
IsolatedEnd run_isolated_bytes(const IsolatedWork& work, const Isolation& limits, const Watch& watch);

/// Several works, each as by run_isolated_bytes, some at once; what they report and how they ended is reported in the
/// caller's thread, while it starts the next one or waits. Where there are no processes, one after another.
class IsolatedPool {
 public:
  using OnEnd = std::function<void(IsolatedEnd)>;

  explicit IsolatedPool(int at_once);
  /// What still runs is ended.
  ~IsolatedPool();
  IsolatedPool(const IsolatedPool&) = delete;
  IsolatedPool& operator=(const IsolatedPool&) = delete;

  /// Waits for a place. SystemLimit if the system gives no process.
  void start(const IsolatedWork& work, const Isolation& limits, const Watch& watch, const OnEnd& on_end);
  void wait_for_all();

 private:
  class Run;
  void look();

  int at_once_;
  std::vector<std::unique_ptr<Run>> runs_;
};

/// The result of work that returned it as bytes.
template <class Result>
Isolated<Result> isolated_from(IsolatedEnd end) {
  Isolated<Result> isolated{std::move(end)};
  if (!isolated.finished()) return isolated;
  if (auto result = from_bytes<Result>(isolated.end.text))
    isolated.result = std::move(*result);
  else
    isolated.end = {IsolatedEnd::Kind::own_error, "its result came back incomplete"};
  return isolated;
}

/// Forks, runs `work` in the child, where it may report its progress, and returns what became of it; the result comes
/// back as bytes (store/bytes.h). The child prints nothing; it does not see SIGINT, SIGTERM and SIGHUP and is killed
/// when the parent has got one, or when the watch, which is asked in the parent, wants that. Of several threads only
/// the one that calls is there in the child: the work must not need what others may hold, such as an interpreter's
/// lock.
template <class Work>
auto run_isolated(const Work& work, const Isolation& limits = {}, const Watch& watch = {}) {
  using Result = std::invoke_result_t<const Work&, const TellProgress&>;
  const auto as_bytes = [&](const TellProgress& report_progress) { return to_bytes(work(report_progress)); };
  return isolated_from<Result>(run_isolated_bytes(as_bytes, limits, watch));
}

/// What the user reads about a recording whose reading has not finished: one sentence.
std::string sentence_for(const std::filesystem::path& recording, const IsolatedEnd& end, double patience_s);

}  // namespace rheocyte
