// Work in tasks of which some make others possible, shared by several threads.
#pragma once
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>

namespace rheocyte {

class Tasks {
 public:
  /// Gets the number of the thread that does it, from 0 on; may add others. It must not wait for another task.
  using Task = std::function<void(int thread)>;

  /// Of the tasks at hand those of the lowest rank are done first, and of these the one that was added first.
  void add(int rank, Task);

  /// Does all tasks, those that are added meanwhile, too. The caller is thread 0; with one thread it does all of them,
  /// and where the system gives fewer threads than requested, those that there are do. The first exception of a task
  /// ends the work: the tasks that wait are dropped, and it is thrown once no thread is left.
  void run(int threads);

  /// What the tasks have taken, added over the threads.
  double seconds() const { return seconds_; }

 private:
  void work(int thread);
  Task next();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<int, std::deque<Task>> waiting_;
  int running_ = 0;
  double seconds_ = 0;
  std::exception_ptr failure_;
};

}  // namespace rheocyte
