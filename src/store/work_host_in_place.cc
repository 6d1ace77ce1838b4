// Of builds without processes: work is done where its answer is read, and what is not taken at once waits.
#include <fmt/format.h>

#include <deque>
#include <exception>
#include <map>
#include <new>
#include <utility>

#include "case/user_error.h"
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
  const std::function<bool()>* is_wanted = nullptr;  ///< of who reads now, as what follows
  const TellProgress* on_progress = nullptr;
};

/// By their numbers, which stand in the place of sockets. Nodes of a map stay where they are, also when work asks for
/// work.
std::map<int, Task>& tasks() {
  static std::map<int, Task> all;
  return all;
}

std::map<const WorkHost*, WorkHost::Work>& works() {
  static std::map<const WorkHost*, WorkHost::Work> all;
  return all;
}

void do_now(int number) {
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

void WorkReply::tell_progress(double fraction) const {
  const auto* const listener = tasks().at(socket_).on_progress;
  if (listener && *listener) (*listener)(fraction);
}

bool WorkReply::is_wanted() const {
  const auto* const asker = tasks().at(socket_).is_wanted;
  return !asker || !*asker || (*asker)();
}

void WorkReply::end_answer() const {}

/// Work that stays ends after each answer, and begins anew with the next question.
std::optional<std::string> WorkReply::next_request() const {
  auto& questions = tasks().at(socket_).questions;
  if (questions.empty()) return std::nullopt;
  std::string next = std::move(questions.front());
  questions.pop_front();
  return next;
}

HostedWork::HostedWork(HostedWork&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), is_wanted_(std::move(other.is_wanted_)) {}

HostedWork::~HostedWork() { tasks().erase(socket_); }

void HostedWork::stop() const {}

void HostedWork::ask(const std::string& request) const {
  Task& task = tasks().at(socket_);
  task.questions.push_back(request);
  task.is_asked = true;
}

void HostedWork::read(const Take& take, const TellProgress& on_progress) {
  Task& task = tasks().at(socket_);
  task.is_wanted = &is_wanted_;
  task.on_progress = &on_progress;
  if (task.is_asked) do_now(socket_);
  task.on_progress = nullptr;
  task.is_wanted = nullptr;
  while (!task.pieces.empty()) {
    const std::string piece = std::move(task.pieces.front());
    task.pieces.pop_front();
    if (!take(piece)) return;
  }
  if (task.failure) std::rethrow_exception(std::exchange(task.failure, nullptr));
}

WorkHost::WorkHost(const Work& work, const std::function<void()>& prepare) : folder_(new_private_folder()) {
  works()[this] = work;
  if (prepare) prepare();
}

WorkHost::~WorkHost() {
  works().erase(this);
  std::error_code error;
  std::filesystem::remove_all(folder_.path.parent_path(), error);
}

HostedWork WorkHost::ask(const std::string& request) const {
  static int last = 0;
  ++last;
  tasks().emplace(last, Task{works().at(this), request, WorkReply(last)});
  return HostedWork(last);
}

}  // namespace rheocyte
