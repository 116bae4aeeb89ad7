#include "compare/record/writing_queue.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <random>
#include <stdexcept>

#include "tests/catch.hpp"

using namespace ogc::compare;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

namespace {

/// Makes writers wait, like a slow disk, until it is opened.
class Gate {
 public:
  void open() { opened_.set_value(); }
  void pass() const { open_.wait(); }

 private:
  std::promise<void> opened_;
  std::shared_future<void> open_ = opened_.get_future();
};

QueueLimits limits(std::size_t jobs, std::size_t bytes) { return {.jobs = jobs, .bytes = bytes, .threads = 3}; }

/// Returns whether the condition becomes true within 10 s, which is enough on a busy machine.
template <class Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 1000 && !condition(); ++i) std::this_thread::sleep_for(10ms);
  return condition();
}

}  // namespace

TEST_CASE("jobs are prepared in any order and written in their own, and a drain ends with a sync after the last",
          "[property]") {
  std::vector<int> written;
  std::atomic<int> syncs = 0, written_at_sync = 0;
  WritingQueue queue([&] { ++syncs, written_at_sync = static_cast<int>(written.size()); }, limits(8, 1000));
  std::mt19937 random(1);
  std::vector<int> expected;
  for (int i = 0; i < 200; ++i) {
    const auto time = std::chrono::microseconds(random() % 500);
    const auto prepared = std::make_shared<int>(-1);
    const WritingQueue::Work prepare = [i, time, prepared] { std::this_thread::sleep_for(time), *prepared = i; };
    queue.add(100, prepare, [&written, prepared] { written.push_back(*prepared); });
    expected.push_back(i);
  }
  queue.drain();
  CHECK(written == expected);
  CHECK(syncs >= 1);
  CHECK(written_at_sync == 200);
}

TEST_CASE("a disk that stands still stops who adds, with no more jobs and bytes at hand than the limits",
          "[property]") {
  for (const auto& [most_jobs, most_bytes, bytes] :
       {std::tuple<std::size_t, std::size_t, std::size_t>{5, 1000, 10}, {50, 1000, 300}, {50, 100, 500}}) {
    Gate gate;
    std::atomic<std::size_t> alive = 0, most_alive = 0, added = 0;
    const std::size_t expected = std::max<std::size_t>(1, std::min(most_jobs, most_bytes / bytes));
    std::thread producer;
    {
      WritingQueue queue([] {}, limits(most_jobs, most_bytes));
      producer = std::thread([&] {
        for (int i = 0; i < 100; ++i) {
          const std::shared_ptr<void> memory(nullptr, [&](void*) { --alive; });
          queue.add(
              bytes, [&] { most_alive = std::max<std::size_t>(most_alive, ++alive); }, [&, memory] { gate.pass(); });
          ++added;
        }
        queue.drain();
      });
      CHECK(soon([&] { return added == expected; }));
      std::this_thread::sleep_for(50ms);
      CHECK(added == expected);
      gate.open();
      producer.join();
      CHECK(queue.waited_seconds() > 0.05);
    }
    CHECK(added == 100);
    CHECK(most_alive <= expected);
  }
}

TEST_CASE("what is written is synced within the time of a group, also what was written past the queue", "[property]") {
  std::atomic<int> syncs = 0;
  WritingQueue queue([&] { ++syncs; }, {.sync_seconds = 0.05});
  queue.add(1, {}, [] {});
  CHECK(soon([&] { return syncs == 1; }));
  queue.touch();
  CHECK(soon([&] { return syncs == 2; }));
  std::this_thread::sleep_for(150ms);
  CHECK(syncs == 2);  // nothing new has to be synced
  const Clock::time_point begin = Clock::now();
  while (Clock::now() - begin < 500ms) queue.add(1, {}, [] { std::this_thread::sleep_for(1ms); });
  CHECK(syncs >= 4);   // syncs continue although there is always another job
  CHECK(syncs <= 13);  // but there are fewer syncs than jobs
}

TEST_CASE(
    "the first failure, of whatever part, is thrown to who adds; what was written before is synced, nothing is written "
    "after",
    "[property]") {
  const std::string part = GENERATE("prepare", "write", "sync");
  std::atomic<int> written = 0, synced = 0;
  const auto failing = [&](const char* here) {
    if (part == here) throw std::runtime_error("no room for " + part);
  };
  WritingQueue queue([&] { synced = written.load(), failing("sync"); }, limits(4, 1000));
  queue.add(1, {}, [&] { ++written; });
  if (part != "sync") queue.drain();
  const auto add_many = [&] {
    for (int i = 0; i < 1000; ++i)
      queue.add(
          1, [&] { failing("prepare"); }, [&] { failing("write"), ++written; });
    queue.drain();
  };
  CHECK_THROWS_WITH(add_many(), ContainsSubstring("no room for " + part));
  CHECK_THROWS_WITH(queue.drain(), ContainsSubstring("no room for " + part));
  const int before = written;
  CHECK_THROWS_AS(queue.add(1, {}, [&] { ++written; }), std::runtime_error);
  CHECK_THROWS_AS(queue.touch(), std::runtime_error);
  std::this_thread::sleep_for(20ms);
  CHECK(written == before);
  if (part != "sync") CHECK(synced == before);
}

TEST_CASE("a queue that ends writes and syncs what it was given", "[unit]") {
  int written = 0, synced = 0;
  {
    WritingQueue queue([&] { synced = written; });
    for (int i = 0; i < 10; ++i)
      queue.add(
          1, [] {}, [&] { ++written; });
  }
  CHECK(written == 10);
  CHECK(synced == 10);
}
