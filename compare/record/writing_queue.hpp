// Writes the files of a run beside the simulation. Several threads prepare jobs at the same time; one thread writes
// them in the order of their arrival. Written files are synced in groups. Memory is bounded: adding to a full queue
// waits, so a slow disk slows the simulation down.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace ogc::compare {

/// Limits of a queue.
struct QueueLimits {
  std::size_t jobs = 64;  ///< jobs that wait or are in progress
  /// bytes of all jobs together; a larger job waits until the queue is empty
  std::size_t bytes = std::size_t{256} << 20;
  double sync_seconds = 1;  ///< from the first write after a sync to the next sync [s]
  unsigned threads = 0;     ///< threads that prepare; 0: half of the machine's, at most 8
};

/// Queue of jobs, filled by one thread.
class WritingQueue {
 public:
  using Work = std::function<void()>;
  /// Makes a queue. The writing thread calls `sync` if something was written and `sync_seconds` have passed, or if
  /// `drain` waits.
  explicit WritingQueue(Work sync, const QueueLimits& limits = {});
  /// Writes and syncs what was added; failures are not reported.
  ~WritingQueue();
  WritingQueue(const WritingQueue&) = delete;
  WritingQueue& operator=(const WritingQueue&) = delete;
  /// Adds a job that holds `bytes` bytes of memory; waits if the queue is full. `prepare` may be empty. Throws the
  /// failure of an earlier job or sync: after the first failure nothing more is written, but what was written is still
  /// synced.
  void add(std::size_t bytes, Work prepare, Work write);
  /// Tells the queue that a file was written without it and must be synced with the rest. Throws as `add` does.
  void touch();
  /// Waits until everything is written and synced, or a failure has stopped the queue. Throws as `add` does.
  void drain();
  /// Returns the time that add and drain waited [s].
  double waited_seconds() const { return waited_seconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Job {
    std::size_t bytes = 0;
    Work prepare, write;
    bool taken = false, ready = false;
  };
  template <class Condition>
  void wait(std::unique_lock<std::mutex>& lock, Condition condition);
  bool has_room(std::size_t bytes) const;
  bool is_sync_due() const;
  bool is_idle() const { return jobs_.empty() && !busy_ && !dirty_; }
  void rethrow() const;
  void fail(std::exception_ptr failure);
  void prepare_jobs();
  void write_jobs();
  void mark_dirty();
  void sync_now(std::unique_lock<std::mutex>& lock);
  void write_front(std::unique_lock<std::mutex>& lock);

  const Work sync_;
  const QueueLimits limits_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Job>> jobs_;
  std::size_t bytes_ = 0;  ///< sum over the jobs
  bool busy_ = false;      ///< whether the writing thread writes or syncs
  bool dirty_ = false;     ///< whether something is written and not synced
  bool draining_ = false;  ///< true from drain until the next add
  bool stop_ = false;
  Clock::time_point dirty_since_;
  std::exception_ptr failure_;
  double waited_seconds_ = 0;  ///< time that the caller's thread waited
  std::vector<std::thread> threads_;
};

}  // namespace ogc::compare
