// Work in processes of their own for a program that has threads: a fork of such a program is safe only for a program
// that starts again, so a host is forked while there is one thread yet, and forks for everybody from then on.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "store/isolated.h"
#include "store/scratch.h"

namespace rheocyte {

/// To whom a process of the host answers. Once no one listens any more, the process ends.
class WorkReply {
 public:
  explicit WorkReply(int socket) : socket_(socket) {}

  /// The next piece of the answer, handed on as pieces of at most 64 KiB; waits as long as they are not taken.
  void give(std::string_view piece) const;
  void report_progress(double fraction) const;
  /// Whether somebody still waits for the answer.
  bool is_wanted() const;
  /// For work that stays: what was given so far is a whole answer.
  void end_answer() const;
  /// What is asked next (HostedWork::ask), however long that takes; nothing once no one listens any more.
  std::optional<std::string> next_request() const;

  /// What work that stays has made for all questions. In builds without processes it starts again with each of them,
  /// and finds this again.
  template <class State, class... Given>
  State& kept(const Given&... given) const {
    if (!kept_) kept_ = std::make_shared<State>(given...);
    return *std::static_pointer_cast<State>(kept_);
  }

  /// What may break its process, in another one (run_isolated_bytes): it gives pieces itself and reports its progress.
  /// `file` is what it reads, for the sentence. UserError.
  void run_isolated(const std::filesystem::path& file, const std::function<void(const TellProgress&)>& work,
                    const Isolation& limits = {}) const;

 private:
  int socket_;
  mutable std::shared_ptr<void> kept_ = {};
};

/// The answer to one request, as it comes. Its end stops the work within 0.1 s, also if that has not finished.
class HostedWork {
 public:
  explicit HostedWork(int socket) : socket_(socket) {}
  ~HostedWork();
  HostedWork(HostedWork&& other) noexcept;
  HostedWork& operator=(HostedWork&&) = delete;

  /// Asks work that stays for another answer, once the one before has been read.
  void ask(const std::string& request) const;

  /// Hands on all pieces, until the work is done or `take` returns false. UserError with the sentence of the work
  /// (SystemLimit if it met one), because its process broke down, or the watch wanted the end.
  using Take = std::function<bool(std::string_view piece)>;
  void read(const Take& take, const Watch& watch = {});
  /// All pieces together.
  std::string all(const Watch& watch = {});

 private:
  int socket_;
};

class WorkHost {
 public:
  /// UserError of the work is reported to the caller.
  using Work = std::function<void(const std::string& request, const WorkReply&)>;

  /// Forks; the process must have a single thread. The host calls `prepare` once.
  explicit WorkHost(const Work& work, const std::function<void()>& prepare = {});
  /// Work that is not finished is stopped.
  ~WorkHost();
  WorkHost(const WorkHost&) = delete;
  WorkHost& operator=(const WorkHost&) = delete;

  /// A private folder that is removed when this program has ended, however it ended; if the host was killed, too, by
  /// the next program that has one.
  const std::filesystem::path& folder() const { return folder_.path; }

  /// Starts a process on the request. For several threads at once. SystemLimit if the system gives no more open
  /// files, UserError if the host has ended.
  HostedWork ask(const std::string& request) const;

 private:
  Scratch folder_;
  [[maybe_unused]] int control_ = -1;
  [[maybe_unused]] int host_ = -1;  ///< the process, where there is one
  mutable std::mutex mutex_;
};

}  // namespace rheocyte
