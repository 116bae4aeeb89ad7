// Damages a plug-in worker's messages in many ways. The judge's side must get an answer of the right shape or report
// that there is no answer.
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <numeric>
#include <random>

#include "experiments/plugins/messages.hpp"
#include "tests/catch.hpp"

using namespace ogc::experiments;

namespace {

using Stream = std::vector<std::byte>;

struct NothingCame {};

/// Returns both ends of a socket.
std::array<Channel, 2> socket_ends() {
  int ends[2];
  REQUIRE(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0);
  return {Channel(ends[0]), Channel(ends[1])};
}

/// Returns the message that a worker sends: each block after its head.
Stream stream_of(const std::vector<Stream>& blocks) {
  Stream stream;
  for (const Stream& block : blocks) {
    const BlockHead head{.length = block.size()};
    for (const Bytes part : {bytes_of_one(head), bytes_of(block)})
      stream.insert(stream.end(), part.begin(), part.end());
  }
  return stream;
}

template <class Item>
Stream block_of(const Item& item) {
  const Bytes bytes = bytes_of_one(item);
  return {bytes.begin(), bytes.end()};
}

/// Writes the stream to a socket, closes this end, and applies `read` to the other end. Throws NothingCame if the
/// stream ends too early.
template <class Read>
auto read_stream(const Stream& stream, Read read) {
  std::array<Channel, 2> ends = socket_ends();
  REQUIRE(write(ends[1].descriptor(), stream.data(), stream.size()) == static_cast<ssize_t>(stream.size()));
  ends[1].close();
  return read([&](BlockLength allowed) {
    Stream block;
    if (ends[0].receive(block, allowed, {.seconds = 10}) != Transfer::whole) throw NothingCame{};
    return block;
  });
}

struct Question {
  const PluginStage* stage;
  QuestionSizes sizes;
  ListSizes counts;
};

/// Returns a question about the step of a small scene. Its answer has lists of all kinds.
Question step_question() {
  QuestionSizes sizes;
  sizes.vertices = 7, sizes.edges = 12, sizes.triangles = 6, sizes.hinges = 5, sizes.bodies = 2, sizes.tetrahedra = 3;
  sizes.settings.iterations = 3, sizes.settings.guess_rounds = 1;
  return {&plugin_stages()[find_plugin_stage("step").value()], sizes, {1, 4, 3, 6, 5, 3, 6, 2}};
}

Question activation_question() {
  QuestionSizes sizes;
  sizes.cases = 9;
  return {&plugin_stages()[find_plugin_stage("activation").value()], sizes, {1}};
}

Stream right_answer(const Question& question) {
  CallResult result;
  result.counts = question.counts;
  result.seconds = 0.25;
  std::vector<Stream> blocks{block_of(result), {}};
  for (const OutputInfo& info : question.stage->outputs)
    blocks.emplace_back(group_bytes(info) * groups(info, question.sizes, result.counts), std::byte{0x5a});
  return stream_of(blocks);
}

WorkerAnswer read_answer_of(const Question& question, const Stream& stream) {
  return read_stream(stream, [&](const NextBlock& next) { return read_answer(next, *question.stage, question.sizes); });
}

/// Returns whether a plug-in could give this answer: the counts are possible for the question, and the lengths of the
/// outputs follow from the counts.
bool fits(const WorkerAnswer& answer, const Question& question) {
  if (answer.result.status > CallResult::Status::broken || !(answer.result.seconds >= 0)) return false;
  if (answer.result.status != CallResult::Status::answered) return answer.outputs.empty();
  const ListSizes most = most_entries(question.sizes);
  for (std::size_t k = 0; k < list_count; ++k)
    if (answer.result.counts[k] < 0 || answer.result.counts[k] > most[k]) return false;
  for (std::size_t k = 0; k < question.stage->outputs.size(); ++k) {
    const OutputInfo& info = question.stage->outputs[k];
    if (answer.outputs.at(k).size() != group_bytes(info) * groups(info, question.sizes, answer.result.counts))
      return false;
  }
  return true;
}

using Generator = std::mt19937;

std::size_t below(std::size_t count, Generator& random) { return random() % std::max<std::size_t>(1, count); }

/// Replaces eight bytes, at a multiple of four, by an extreme length or count.
void put_number(Stream& stream, Generator& random) {
  const std::array<std::uint64_t, 8> numbers{0,
                                             1,
                                             0x7fffffff,
                                             std::uint64_t{1} << 40,
                                             std::uint64_t{1} << 62,
                                             ~std::uint64_t{0},
                                             random(),
                                             BlockHead::right_mark};
  if (stream.size() < 8) return;
  const Stream number = block_of(numbers[below(numbers.size(), random)]);
  std::copy(number.begin(), number.end(),
            stream.begin() + static_cast<std::ptrdiff_t>(below(stream.size() / 4 - 1, random) * 4));
}

Stream damaged(Stream stream, Generator& random) {
  const auto at = [&] { return stream.begin() + static_cast<std::ptrdiff_t>(below(stream.size(), random)); };
  switch (random() % 6) {
    case 0: *at() ^= static_cast<std::byte>(1 << random() % 8); break;
    case 1: stream.erase(at(), stream.end()); break;
    case 2: stream.insert(at(), 1 + random() % 200, std::byte{0}); break;
    case 3: stream.erase(stream.begin(), at()); break;
    case 4: std::generate(at(), stream.end(), [&] { return static_cast<std::byte>(random()); }); break;
    default: put_number(stream, random);
  }
  return stream;
}

}  // namespace

TEST_CASE("an answer that nothing damaged comes through, and one whose worker found fault brings the reason alone",
          "[property]") {
  for (const Question& question : {step_question(), activation_question()}) {
    const WorkerAnswer answer = read_answer_of(question, right_answer(question));
    CHECK(fits(answer, question));
    CHECK(answer.result.counts == question.counts);
    CallResult failed;
    failed.status = CallResult::Status::failed;
    const Stream why(3, std::byte{'n'});
    CHECK(read_answer_of(question, stream_of({block_of(failed), why})).why == "nnn");
  }
}

TEST_CASE("20,000 damaged answers: each is one of the right shape, or is refused, or lacks its end", "[property]") {
  Generator random(20261123);
  std::array<std::size_t, 3> ends{};
  for (const Question& question : {step_question(), activation_question()}) {
    const Stream right = right_answer(question);
    for (int i = 0; i < 10000; ++i) {
      const Stream stream = damaged(right, random);
      try {
        const WorkerAnswer answer = read_answer_of(question, stream);
        REQUIRE(fits(answer, question));
        ++ends[0];
      } catch (const MalformedBlock&) {
        ++ends[1];
      } catch (const NothingCame&) {
        ++ends[2];
      }
    }
  }
  // Damage inside an output is not detected here; the judge checks outputs.
  for (const std::size_t count : ends) CHECK(count > 1000);
}

TEST_CASE("a greeting of random bytes is refused", "[property]") {
  Generator random(7);
  for (int i = 0; i < 2000; ++i) {
    Stream stream(random() % 400);
    std::generate(stream.begin(), stream.end(), [&] { return static_cast<std::byte>(random()); });
    const bool is_long = stream.size() >= sizeof(BlockHead);
    if (is_long)
      CHECK_THROWS_AS(read_stream(stream, read_greeting), MalformedBlock);
    else
      CHECK_THROWS_AS(read_stream(stream, read_greeting), NothingCame);
  }
}

TEST_CASE("counts beyond all pairs of a mesh, and more than a product of sizes can hold, are refused", "[unit]") {
  const Question question = step_question();
  for (const std::size_t k : {1u, 2u, 3u, 4u, 5u, 6u})
    for (const std::int64_t count : {std::int64_t{-1}, most_entries(question.sizes)[k] + 1, std::int64_t{1} << 60,
                                     std::numeric_limits<std::int64_t>::max()}) {
      CallResult result;
      result.counts = question.counts;
      result.counts[k] = count;
      CHECK_THROWS_AS(read_answer_of(question, stream_of({block_of(result), {}})), MalformedBlock);
    }
  QuestionSizes largest;
  largest.vertices = largest.edges = largest.triangles = std::numeric_limits<std::int32_t>::max();
  largest.settings.iterations = 1000000;
  const ListSizes most = most_entries(largest), first = first_capacities(largest);
  for (std::size_t k = 0; k < list_count; ++k) {
    CHECK(most[k] >= first[k]);
    CHECK(most[k] <= std::int64_t{1} << 40);
  }
}

TEST_CASE("memory for a block follows what was sent, not what was announced", "[unit]") {
  std::array<Channel, 2> ends = socket_ends();
  const BlockHead head{.length = std::uint64_t{1} << 40};
  REQUIRE(write(ends[1].descriptor(), &head, sizeof head) == sizeof head);
  Stream block;
  CHECK(ends[0].receive(block, {}, {.seconds = 0.01}) == Transfer::timeout);
  CHECK(block.capacity() < 100u << 20);
}

TEST_CASE("a side that has ended is noticed where others hold its socket, after what it had sent", "[unit]") {
  std::array<Channel, 2> ends = socket_ends();  // this process keeps the other end open
  const Patience patience{.seconds = 60, .other_runs = [] { return false; }};
  Stream block;
  const Stream last(5, std::byte{1});
  REQUIRE(ends[1].send(last) == Transfer::whole);
  CHECK(ends[0].receive(block, {}, patience) == Transfer::whole);
  CHECK(block == last);
  CHECK(ends[0].receive(block, {}, patience) == Transfer::end);
  // The message is larger than a socket's buffer, and nothing reads it.
  CHECK(ends[0].send(Stream(64u << 20), patience) == Transfer::end);
  CHECK(ends[0].send(Stream(64u << 20), {.seconds = 0.01}) == Transfer::timeout);
}
