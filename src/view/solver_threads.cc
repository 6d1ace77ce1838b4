#include "view/solver_threads.h"

#include <algorithm>
#include <iterator>

namespace rheocyte {

namespace {

/// Whose states a session may still hold.
constexpr std::size_t most_streams = 8;

}  // namespace

SolverThreads::SolverThreads(int threads, std::size_t session_bytes)
    : session_bytes_(session_bytes), workers_(static_cast<std::size_t>(threads)) {
  if (!has_threads)
    session_here_ = std::make_unique<Session>(session_bytes);
  else
    threads_ = start_threads(threads, [this](int number) { work(*std::next(workers_.begin(), number)); });
}

SolverThreads::~SolverThreads() {
  stop();
  threads_.clear();  // joins
}

void SolverThreads::stop() {
  const std::scoped_lock lock(mutex_);
  is_over_ = true;
  for (const Worker& worker : workers_) {
    if (!worker.now) continue;
    worker.now->has_left = true;
    worker.now->stop = true;
  }
  to_do_.notify_all();
}

std::size_t SolverThreads::load() const {
  const std::scoped_lock lock(mutex_);
  return waiting_.size() + std::size_t(std::ranges::count_if(workers_, [](const Worker& w) { return w.now; }));
}

/// A stream stays with the thread whose session knows its states, even if that has to end an older job of the stream
/// first; where it is busy with something else, any thread is better.
std::list<SolverThreads::Task*>::iterator SolverThreads::find_for(const Worker& self) {
  return std::ranges::find_if(waiting_, [&](const Task* task) {
    const std::string& stream = task->job.stream;
    const auto home = std::ranges::find_if(workers_, [&](const Worker& worker) {
      return std::ranges::find(worker.streams, stream) != worker.streams.end();
    });
    if (home == workers_.end() || &*home == &self) return true;
    return home->now && home->now->job.stream != stream;
  });
}

void SolverThreads::take_over(const std::string& stream, Worker& self) {
  if (stream.empty()) return;
  for (Worker& worker : workers_) worker.streams.remove(stream);
  self.streams.push_front(stream);
  if (self.streams.size() > most_streams) self.streams.pop_back();
}

void SolverThreads::work(Worker& self) {
  Session session(session_bytes_);
  std::unique_lock lock(mutex_);
  for (;;) {
    std::list<Task*>::iterator found;
    to_do_.wait(lock, [&] { return is_over_ || (found = find_for(self)) != waiting_.end(); });
    if (is_over_) break;
    Task& task = **found;
    waiting_.erase(found);
    if (task.job.request.client_has_left()) {
      task.is_over = task.has_left = true;
      ended_.notify_all();
      continue;
    }
    take_over(task.job.stream, self);
    self.now = &task;
    lock.unlock();
    try {
      task.job.work(session, task.stop);
    } catch (...) {
      task.failure = std::current_exception();
    }
    lock.lock();
    self.now = nullptr;
    task.is_over = true;
    ended_.notify_all();
    to_do_.notify_all();
  }
  for (Task* task : waiting_) task->is_over = task->has_left = true;
  waiting_.clear();
  ended_.notify_all();
}

void SolverThreads::supersede(const std::string& stream) {
  if (stream.empty()) return;
  const auto end = [](Task& task) {
    task.is_superseded = true;
    task.stop = true;
  };
  std::erase_if(waiting_, [&](Task* task) {
    if (task->job.stream != stream) return false;
    end(*task);
    return task->is_over = true;
  });
  for (const Worker& worker : workers_)
    if (worker.now && worker.now->job.stream == stream) end(*worker.now);
  ended_.notify_all();
}

void SolverThreads::look_after_client(Task& task) {
  if (task.is_over || task.has_left || !task.job.request.client_has_left()) return;
  task.has_left = true;
  task.stop = true;
  if (std::erase(waiting_, &task) > 0) task.is_over = true;
}

JobEnd SolverThreads::run_here(const SolverJob& job) {
  if (job.request.client_has_left()) return JobEnd::left;
  std::atomic<bool> stop{false};
  const BetweenTasks looking([&] {
    if (job.request.client_has_left()) stop = true;
  });
  job.work(*session_here_, stop);
  return stop ? JobEnd::left : JobEnd::done;
}

JobEnd SolverThreads::run(const SolverJob& job) {
  if (!has_threads) return run_here(job);
  Task task{job};
  std::unique_lock lock(mutex_);
  supersede(job.stream);
  if (is_over_) return JobEnd::left;
  waiting_.push_back(&task);
  to_do_.notify_all();
  while (!ended_.wait_for(lock, Client::asked_every, [&] { return task.is_over; })) look_after_client(task);
  lock.unlock();
  if (task.failure) std::rethrow_exception(task.failure);
  return task.is_superseded ? JobEnd::superseded : task.has_left ? JobEnd::left : JobEnd::done;
}

}  // namespace rheocyte
