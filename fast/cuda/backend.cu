#include "fast/cuda/backend.cuh"

#include <utility>

#include "fast/cuda/cuda.hpp"

namespace ogc::fast {

void CudaRecording::clear() noexcept {
  if (graph_ != nullptr) cudaGraphExecDestroy(graph_);
  graph_ = nullptr;
}

CudaBackend::CudaBackend(const LaunchShape& shape)
    : block_threads_(shape.block_threads), multiprocessors_(shape.multiprocessors) {
  const BackendInfo info = cuda_info();
  if (!info.usable) throw compare::ResourceError(info.description + "; run with the backend cpu");
  if (block_threads_ % 32 != 0 || block_threads_ <= 0 || block_threads_ > cuda_block_size)
    throw compare::InputError("LaunchShape: " + std::to_string(block_threads_) +
                              " threads a block; give a multiple of 32, at most " + std::to_string(cuda_block_size));
  OGC_CUDA_CHECK(cudaGetDevice(&device_));
  if (multiprocessors_ <= 0)
    OGC_CUDA_CHECK(cudaDeviceGetAttribute(&multiprocessors_, cudaDevAttrMultiProcessorCount, device_));
  OGC_CUDA_CHECK(cudaStreamCreate(&stream_));
  current_ = stream_;
}

CudaBackend::CudaBackend(CudaBackend&& other) noexcept
    : stream_(std::exchange(other.stream_, nullptr)),
      current_(std::exchange(other.current_, nullptr)),
      device_(other.device_),
      block_threads_(other.block_threads_),
      multiprocessors_(other.multiprocessors_),
      scratch_(std::move(other.scratch_)),
      branch_scratch_(std::move(other.branch_scratch_)),
      hall_(other.hall_),
      own_part_(other.own_part_),
      meetings_(std::move(other.meetings_)),
      flags_(std::move(other.flags_)),
      done_(std::move(other.done_)),
      others_flags_(std::move(other.others_flags_)),
      events_(std::exchange(other.events_, {})),
      is_end_(std::exchange(other.is_end_, {})) {}

CudaBackend::~CudaBackend() {
  if (stream_ == nullptr) return;
  cudaStreamSynchronize(stream_);
  for (cudaEvent_t event : events_) cudaEventDestroy(event);
  cudaStreamDestroy(stream_);
}

bool CudaBackend::read_flag(const int* flag) {
  int value = 0;
  OGC_CUDA_CHECK(cudaMemcpyAsync(&value, flag, sizeof(value), cudaMemcpyDeviceToHost, current_));
  OGC_CUDA_CHECK(cudaStreamSynchronize(current_));
  return value != 0;
}

// Starts to record. The capture mode is relaxed, so that scratch memory may grow and kernels may be loaded while the
// body is recorded.
void CudaBackend::begin_recording() {
  OGC_CUDA_CHECK(cudaStreamBeginCapture(stream_, cudaStreamCaptureModeRelaxed));
  recording_ = true;
  follows_ = false;
}

void CudaBackend::end_recording(Recording& recording) {
  recording_ = false;
  cudaGraph_t graph = nullptr;
  OGC_CUDA_CHECK(cudaStreamEndCapture(stream_, &graph));
  end_branches();
  const cudaError_t error = cudaGraphInstantiate(&recording.graph_, graph, 0);
  cudaGraphDestroy(graph);
  OGC_CUDA_CHECK(error);
  recording.generation_ = buffer_generation;
  OGC_CUDA_CHECK(cudaGraphUpload(recording.graph_, stream_));
}

void CudaBackend::abandon_recording() noexcept {
  recording_ = false;
  cudaGraph_t graph = nullptr;
  if (current_ != stream_) {
    cudaStreamEndCapture(current_, &graph);  // the body belongs to its node and must not be destroyed here
    cudaStreamDestroy(current_);
    graph = nullptr;
  }
  current_ = stream_;
  cudaStreamEndCapture(stream_, &graph);
  if (graph != nullptr) cudaGraphDestroy(graph);
  end_branches();
  cudaGetLastError();
}

// Makes one stream wait for another. The event also makes the waiting stream part of the capture. Streams and events of
// branches are part of the recording, so they live until it ends.
void CudaBackend::wait_for(cudaStream_t waiting, cudaStream_t other) {
  cudaEvent_t crossing = nullptr;
  OGC_CUDA_CHECK(cudaEventCreateWithFlags(&crossing, cudaEventDisableTiming));
  crossings_.push_back(crossing);
  OGC_CUDA_CHECK(cudaEventRecord(crossing, other));
  OGC_CUDA_CHECK(cudaStreamWaitEvent(waiting, crossing, 0));
}

// Makes a new stream current. It begins after all work that `current_` has captured so far.
cudaStream_t CudaBackend::begin_branch() {
  cudaStream_t branch = nullptr;
  OGC_CUDA_CHECK(cudaStreamCreateWithFlags(&branch, cudaStreamNonBlocking));
  branches_.push_back(branch);
  wait_for(branch, current_);
  follows_ = false;
  in_branch_ = true;
  return std::exchange(current_, branch);
}

void CudaBackend::end_branch(cudaStream_t main) {
  follows_ = in_branch_ = false;
  current_ = main;
}

void CudaBackend::join(cudaStream_t branch) {
  wait_for(current_, branch);
  follows_ = false;
}

void CudaBackend::end_branches() noexcept {
  for (cudaEvent_t crossing : crossings_) cudaEventDestroy(crossing);
  for (cudaStream_t branch : branches_) cudaStreamDestroy(branch);
  crossings_.clear();
  branches_.clear();
}

cudaGraphConditionalHandle CudaBackend::new_condition() {
  cudaStreamCaptureStatus status = cudaStreamCaptureStatusNone;
  cudaGraph_t graph = nullptr;
  OGC_CUDA_CHECK(cudaStreamGetCaptureInfo(current_, &status, nullptr, &graph, nullptr, nullptr, nullptr));
  cudaGraphConditionalHandle handle{};
  OGC_CUDA_CHECK(cudaGraphConditionalHandleCreate(&handle, graph, 0, cudaGraphCondAssignDefault));
  return handle;
}

// Adds a conditional node after all work that `current_` has captured so far. Makes a new stream current, which
// captures the node's body.
cudaStream_t CudaBackend::begin_condition(cudaGraphConditionalHandle handle, cudaGraphConditionalNodeType type) {
  cudaStreamCaptureStatus status = cudaStreamCaptureStatusNone;
  cudaGraph_t graph = nullptr;
  const cudaGraphNode_t* before = nullptr;
  std::size_t before_count = 0;
  OGC_CUDA_CHECK(cudaStreamGetCaptureInfo(current_, &status, nullptr, &graph, &before, nullptr, &before_count));
  cudaGraphNodeParams parameters{};
  parameters.type = cudaGraphNodeTypeConditional;
  parameters.conditional.handle = handle;
  parameters.conditional.type = type;
  parameters.conditional.size = 1;
  cudaGraphNode_t node = nullptr;
  OGC_CUDA_CHECK(cudaGraphAddNode(&node, graph, before, nullptr, before_count, &parameters));
  OGC_CUDA_CHECK(cudaStreamUpdateCaptureDependencies(current_, &node, nullptr, 1, cudaStreamSetCaptureDependencies));

  const cudaStream_t outer = current_;
  OGC_CUDA_CHECK(cudaStreamCreateWithFlags(&current_, cudaStreamNonBlocking));
  OGC_CUDA_CHECK(cudaStreamBeginCaptureToGraph(current_, parameters.conditional.phGraph_out[0], nullptr, nullptr, 0,
                                               cudaStreamCaptureModeRelaxed));
  follows_ = false;
  return outer;
}

void CudaBackend::end_condition(cudaStream_t outer) {
  cudaGraph_t body = nullptr;
  const cudaError_t error = cudaStreamEndCapture(current_, &body);
  cudaStreamDestroy(current_);
  current_ = outer;
  follows_ = false;
  OGC_CUDA_CHECK(error);
}

void CudaBackend::join(Hall& hall, int own) {
  hall_ = &hall;
  own_part_ = own;
  const auto parts = static_cast<std::size_t>(hall.parts());
  meetings_.resize(1), done_.resize(1), flags_.resize(parts);
  hall.devices[static_cast<std::size_t>(own)] = device_;
  hall.inbox_flags[static_cast<std::size_t>(own)] = flags_.data();
  hall.meet();
  for (const int other : hall.devices) {
    if (other == device_) continue;
    int can = 0;
    OGC_CUDA_CHECK(cudaDeviceCanAccessPeer(&can, device_, other));
    if (can == 0)
      throw compare::ResourceError("device " + std::to_string(device_) + " can't write into the memory of device " +
                                   std::to_string(other) + ": choose others by CUDA_VISIBLE_DEVICES, or one device");
    const cudaError_t error = cudaDeviceEnablePeerAccess(other, 0);
    if (error == cudaErrorPeerAccessAlreadyEnabled)
      cudaGetLastError();
    else
      OGC_CUDA_CHECK(error);
  }
  others_flags_.upload(hall.inbox_flags.data(), parts);
  OGC_CUDA_CHECK(cudaDeviceSynchronize());
  hall.meet();
}

// A device of several parts waits inside its graph for the others. So all parts come here, with their graphs
// instantiated and their memory allocated, before one of them launches.
void CudaBackend::launch(const Recording& recording, int times) {
  if (hall_ != nullptr) {
    OGC_CUDA_CHECK(cudaStreamSynchronize(stream_));
    hall_->meet();
  }
  const auto record = [this](bool is_end) {
    if (events_.size() == is_end_.size()) {
      cudaEvent_t event = nullptr;
      OGC_CUDA_CHECK(cudaEventCreate(&event));
      events_.push_back(event);
    }
    OGC_CUDA_CHECK(cudaEventRecord(events_[is_end_.size()], stream_));
    is_end_.push_back(is_end);
  };
  record(false);
  for (int k = 0; k < times; ++k) {
    OGC_CUDA_CHECK(cudaGraphLaunch(recording.graph_, stream_));
    record(true);
  }
}

std::vector<double> CudaBackend::replay_milliseconds() {
  std::vector<double> result;
  for (std::size_t k = 1; k < is_end_.size(); ++k) {
    if (!is_end_[k]) continue;
    float milliseconds = 0;
    OGC_CUDA_CHECK(cudaEventElapsedTime(&milliseconds, events_[k - 1], events_[k]));
    result.push_back(static_cast<double>(milliseconds));
  }
  is_end_.clear();
  return result;
}

}  // namespace ogc::fast
