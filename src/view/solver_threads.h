// Threads that solve, each with a session of its own, for streams of requests of which the latest alone matters.
#pragma once
#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "serve/http.h"
#include "solve/session.h"
#include "store/thread.h"

namespace rheocyte {

/// What became of a job.
enum class JobEnd {
  done,
  superseded,  ///< by a later one of its stream
  left         ///< by its client
};

/// One job for one request: whether it goes on is asked while it is waited for.
struct SolverJob {
  std::string stream;  ///< jobs of one stream replace each other; empty: of none
  const Request& request;
  std::function<void(Session&, const std::atomic<bool>& stop)> work;
};

/// Called by the threads of connections.
class SolverThreads {
 public:
  /// As many as the system gives, at least one: SystemLimit.
  SolverThreads(int threads, std::size_t session_bytes);
  ~SolverThreads();
  SolverThreads(const SolverThreads&) = delete;
  SolverThreads& operator=(const SolverThreads&) = delete;

  /// Runs the job, if possible on the session that has answered its stream before, stops an earlier one of the stream,
  /// and waits until it has ended. What the work throws is thrown here.
  JobEnd run(const SolverJob&);

  /// Ends what runs and takes nothing more; waiting threads must be back before the threads are destroyed.
  void stop();

  /// Jobs that wait or run.
  std::size_t load() const;

 private:
  struct Task {
    const SolverJob& job;
    std::atomic<bool> stop{false};
    bool is_superseded = false, has_left = false, is_over = false;
    std::exception_ptr failure = {};
  };
  struct Worker {
    std::list<std::string> streams = {};  ///< of its latest jobs, unless another thread has had a later one
    Task* now = nullptr;
  };

  void work(Worker&);
  std::list<Task*>::iterator find_for(const Worker&);
  void take_over(const std::string& stream, Worker&);
  void supersede(const std::string& stream);
  void look_after_client(Task&);

  JobEnd run_here(const SolverJob&);

  std::size_t session_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable to_do_, ended_;
  std::list<Task*> waiting_;
  std::list<Worker> workers_;
  bool is_over_ = false;
  std::vector<Thread> threads_;
  std::unique_ptr<Session> session_here_;  ///< where there are no threads
};

}  // namespace rheocyte
