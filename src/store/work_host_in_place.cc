// Of builds without processes: work is done where its answer is read, and what is not taken at once waits.
#include <fmt/format.h>

#include <atomic>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <new>
#include <utility>

#include "case/user_error.h"
#include "store/in_place.h"
#include "store/private_folder.h"
#include "store/system_limit.h"
#include "store/work_host.h"

namespace rheocyte {

namespace {

struct Task {
  WorkHost::Work work;
  std::string request;
  WorkReply reply;
  bool is_asked = true;                    ///< and not yet done
  std::deque<std::string> questions = {};  ///< to work that stays
  std::deque<std::string> pieces = {};
  std::exception_ptr failure = {};
  const Watch* watch = nullptr;  ///< of who reads now
};

/// For several threads at once. Nodes of a map stay where they are, also when work asks for work.
template <class Key, class Value>
class SharedMap {
 public:
  Value& at(const Key& key) {
    const std::scoped_lock alone(mutex_);
    return all_.at(key);
  }
  void add(const Key& key, Value value) {
    const std::scoped_lock alone(mutex_);
    all_.insert_or_assign(key, std::move(value));
  }
  void remove(const Key& key) {
    typename std::map<Key, Value>::node_type removed;  // its end may ask for work, too
    const std::scoped_lock alone(mutex_);
    removed = all_.extract(key);
  }

 private:
  std::mutex mutex_;
  std::map<Key, Value> all_;
};

/// By their numbers, which stand in the place of sockets.
SharedMap<int, Task>& tasks() {
  static SharedMap<int, Task> all;
  return all;
}

SharedMap<const WorkHost*, WorkHost::Work>& works() {
  static SharedMap<const WorkHost*, WorkHost::Work> all;
  return all;
}

void do_now(int number) {
  const std::scoped_lock alone(turn_of_work());
  Task& task = tasks().at(number);
  task.is_asked = false;
  try {
    task.work(task.request, task.reply);
  } catch (const UserError&) {
    task.failure = std::current_exception();
  } catch (const std::bad_alloc&) {
    task.failure = std::make_exception_ptr(SystemLimit(memory_does_not_suffice));
  } catch (const std::exception& error) {
    task.failure = std::make_exception_ptr(
        UserError(fmt::format("An error of the program itself, please report it: {}", one_line(error.what(), 300))));
  }
}

}  // namespace

void WorkReply::give(std::string_view piece) const { tasks().at(socket_).pieces.emplace_back(piece); }

void WorkReply::report_progress(double fraction) const {
  if (const Watch* const watch = tasks().at(socket_).watch) watch->progress(fraction);
}

bool WorkReply::is_wanted() const {
  const Watch* const watch = tasks().at(socket_).watch;
  return !watch || !watch->stop();
}

void WorkReply::end_answer() const {}

/// Work that stays ends after each answer, and starts again with the next question.
std::optional<std::string> WorkReply::next_request() const {
  auto& questions = tasks().at(socket_).questions;
  if (questions.empty()) return std::nullopt;
  std::string next = std::move(questions.front());
  questions.pop_front();
  return next;
}

HostedWork::HostedWork(HostedWork&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

HostedWork::~HostedWork() { tasks().remove(socket_); }

void HostedWork::ask(const std::string& request) const {
  Task& task = tasks().at(socket_);
  task.questions.push_back(request);
  task.is_asked = true;
}

void HostedWork::read(const Take& take, const Watch& watch) {
  Task& task = tasks().at(socket_);
  task.watch = &watch;
  if (task.is_asked) do_now(socket_);
  task.watch = nullptr;
  while (!task.pieces.empty()) {
    const std::string piece = std::move(task.pieces.front());
    task.pieces.pop_front();
    if (!take(piece)) return;
  }
  if (task.failure) std::rethrow_exception(std::exchange(task.failure, nullptr));
}

WorkHost::WorkHost(const Work& work, const std::function<void()>& prepare) : folder_(new_private_folder()) {
  works().add(this, work);
  if (prepare) prepare();
}

WorkHost::~WorkHost() {
  works().remove(this);
  std::error_code error;
  std::filesystem::remove_all(folder_.path.parent_path(), error);
}

HostedWork WorkHost::ask(const std::string& request) const {
  static std::atomic<int> last = 0;
  const int number = ++last;
  tasks().add(number, Task{works().at(this), request, WorkReply(number)});
  return HostedWork(number);
}

}  // namespace rheocyte
