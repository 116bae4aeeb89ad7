// Copies the judge's arrays to the backend and back.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "compare/problem/vector.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// Holds the arrays of one probe on the backend: cases are uploaded, answers are downloaded.
template <class Backend>
class ProbeMemory {
 public:
  explicit ProbeMemory(Backend& backend) : backend_(backend) {}

  /// Uploads items as type To, which has the same layout. The result is valid as long as this object.
  template <class To, class From>
  const To* in(const std::vector<From>& items) {
    static_assert(sizeof(To) == sizeof(From) && alignof(To) == alignof(From));
    auto buffer = std::make_shared<typename Backend::template Buffer<To>>();
    buffer->upload(reinterpret_cast<const To*>(items.data()), items.size());
    kept_.push_back(buffer);
    return buffer->data();
  }

  /// Returns memory for n answers on the backend. Resizes `to`, and `fetch` copies the answers there.
  template <class From, class To>
  From* out(std::vector<To>& to, std::size_t n) {
    static_assert(sizeof(To) == sizeof(From) && alignof(To) == alignof(From));
    auto buffer = std::make_shared<typename Backend::template Buffer<From>>();
    buffer->resize(n);
    to.resize(n);
    fetches_.push_back([buffer, &to] { buffer->download(reinterpret_cast<From*>(to.data()), to.size()); });
    return buffer->data();
  }

  /// Uploads positions as a sweep gathers them, in `copies` copies one after the other.
  PaddedVec* padded(const std::vector<compare::Vec3f>& positions, int copies = 1) {
    std::vector<PaddedVec> all;
    for (int k = 0; k < copies; ++k) {
      for (const compare::Vec3f& x : positions) all.emplace_back(Vec{x.x, x.y, x.z});
    }
    auto buffer = std::make_shared<typename Backend::template Buffer<PaddedVec>>();
    buffer->upload(all.data(), all.size());
    kept_.push_back(buffer);
    return buffer->data();
  }

  /// Waits for all enqueued work and fills all answers.
  void fetch() {
    backend_.synchronize();
    for (const auto& download : fetches_) download();
  }

 private:
  Backend& backend_;
  std::vector<std::shared_ptr<void>> kept_;
  std::vector<std::function<void()>> fetches_;
};

}  // namespace ogc::fast
