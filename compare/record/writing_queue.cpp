#include "compare/record/writing_queue.hpp"

#include <algorithm>
#include <utility>

namespace ogc::compare {
namespace {

unsigned preparing_threads(unsigned asked) {
  return asked > 0 ? asked : std::clamp(std::thread::hardware_concurrency() / 2, 1u, 8u);
}

}  // namespace

WritingQueue::WritingQueue(Work sync, const QueueLimits& limits) : sync_(std::move(sync)), limits_(limits) {
  for (unsigned i = 0; i < preparing_threads(limits.threads); ++i) threads_.emplace_back([this] { prepare_jobs(); });
  threads_.emplace_back([this] { write_jobs(); });
}

WritingQueue::~WritingQueue() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

/// Waits until a condition holds, then throws the queue's failure if there is one. After a failure the condition must
/// become true, too; otherwise the wait would not end.
template <class Condition>
void WritingQueue::wait(std::unique_lock<std::mutex>& lock, Condition condition) {
  const Clock::time_point begin = Clock::now();
  changed_.wait(lock, condition);
  waited_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
  rethrow();
}

bool WritingQueue::has_room(std::size_t bytes) const {
  return jobs_.empty() || (jobs_.size() < limits_.jobs && bytes_ + bytes <= limits_.bytes);
}

void WritingQueue::rethrow() const {
  if (failure_) std::rethrow_exception(failure_);
}

void WritingQueue::add(std::size_t bytes, Work prepare, Work write) {
  std::unique_lock lock(mutex_);
  wait(lock, [&] { return failure_ || has_room(bytes); });
  const bool ready = !prepare;
  draining_ = false;
  jobs_.push_back(std::make_shared<Job>(Job{bytes, std::move(prepare), std::move(write), ready, ready}));
  bytes_ += bytes;
  changed_.notify_all();
}

void WritingQueue::mark_dirty() {
  if (!std::exchange(dirty_, true)) dirty_since_ = Clock::now();
}

void WritingQueue::touch() {
  const std::lock_guard lock(mutex_);
  rethrow();
  mark_dirty();
  changed_.notify_all();
}

void WritingQueue::drain() {
  std::unique_lock lock(mutex_);
  draining_ = true;
  changed_.notify_all();
  wait(lock, [&] { return is_idle(); });
}

void WritingQueue::fail(std::exception_ptr failure) {
  if (!failure_) failure_ = std::move(failure);
  jobs_.clear();
  bytes_ = 0;
}

void WritingQueue::prepare_jobs() {
  std::unique_lock lock(mutex_);
  const auto next = [&] { return std::ranges::find(jobs_, false, [](const auto& job) { return job->taken; }); };
  while (true) {
    changed_.wait(lock, [&] { return next() != jobs_.end() || stop_; });
    if (next() == jobs_.end()) return;
    const std::shared_ptr<Job> job = *next();
    job->taken = true;
    lock.unlock();
    std::exception_ptr failure;
    try {
      job->prepare();
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    job->ready = true;
    if (failure) fail(failure);
    changed_.notify_all();
  }
}

bool WritingQueue::is_sync_due() const {
  if (!dirty_) return false;
  const bool nothing_else = jobs_.empty() && (draining_ || stop_);
  return nothing_else || failure_ || Clock::now() - dirty_since_ >= std::chrono::duration<double>(limits_.sync_seconds);
}

void WritingQueue::write_jobs() {
  std::unique_lock lock(mutex_);
  while (true) {
    const auto has_work = [&] { return is_sync_due() || (!jobs_.empty() && jobs_.front()->ready); };
    const auto is_over = [&] { return stop_ && jobs_.empty() && !dirty_; };
    const auto wakes = [&] { return has_work() || is_over(); };
    const std::chrono::duration<double> patience(limits_.sync_seconds);
    const auto due = dirty_since_ + std::chrono::duration_cast<Clock::duration>(patience);
    if (dirty_)
      changed_.wait_until(lock, due, wakes);
    else
      changed_.wait(lock, [&] { return wakes() || dirty_; });
    if (is_sync_due())
      sync_now(lock);
    else if (!jobs_.empty() && jobs_.front()->ready)
      write_front(lock);
    else if (is_over())
      return;
  }
}

void WritingQueue::sync_now(std::unique_lock<std::mutex>& lock) {
  dirty_ = false;
  busy_ = true;
  lock.unlock();
  std::exception_ptr failure;
  try {
    sync_();
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  busy_ = false;
  if (failure) fail(failure);
  changed_.notify_all();
}

void WritingQueue::write_front(std::unique_lock<std::mutex>& lock) {
  const std::shared_ptr<Job> job = jobs_.front();
  busy_ = true;
  mark_dirty();
  lock.unlock();
  std::exception_ptr failure;
  try {
    job->write();
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  busy_ = false;
  // The queue is already empty if the preparation of another job has failed.
  if (!jobs_.empty() && jobs_.front() == job) jobs_.pop_front(), bytes_ -= job->bytes;
  if (failure) fail(failure);
  changed_.notify_all();
}

}  // namespace ogc::compare
