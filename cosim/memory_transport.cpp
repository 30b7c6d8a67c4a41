#include "cosim/memory_transport.hpp"

#include <condition_variable>
#include <deque>
#include <mutex>

namespace ballbot {
namespace {

struct Queue {
  std::mutex mutex;
  std::condition_variable arrived;
  std::deque<Bytes> messages;
};

class MemoryTransport final : public Transport {
 public:
  MemoryTransport(std::shared_ptr<Queue> in, std::shared_ptr<Queue> out)
      : in_(std::move(in)), out_(std::move(out)) {}

  void send(const std::uint8_t* data, std::size_t size) override {
    {
      const std::lock_guard<std::mutex> lock(out_->mutex);
      out_->messages.emplace_back(data, data + size);
    }
    out_->arrived.notify_one();
  }

  bool receive(Bytes& out, WallDuration timeout) override {
    std::unique_lock<std::mutex> lock(in_->mutex);
    if (!in_->arrived.wait_for(lock, timeout, [&] { return !in_->messages.empty(); })) return false;
    out.swap(in_->messages.front());
    in_->messages.pop_front();
    return true;
  }

  std::string describe() const override { return "memory of this process"; }

 private:
  std::shared_ptr<Queue> in_, out_;
};

}  // namespace

std::pair<std::unique_ptr<Transport>, std::unique_ptr<Transport>> makeMemoryLink() {
  auto there = std::make_shared<Queue>();
  auto back = std::make_shared<Queue>();
  return {std::make_unique<MemoryTransport>(back, there),
          std::make_unique<MemoryTransport>(there, back)};
}

}  // namespace ballbot
