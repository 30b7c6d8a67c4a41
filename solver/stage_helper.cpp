#include "solver/stage_helper.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <thread>

#include <semaphore.h>

namespace ballbot {

class StageHelper::Impl {
 public:
  Impl(int stages, Work work, void* context)
      : stages_(stages), work_(work), context_(context), next_(stages) {
    sem_init(&wake_, 0, 0);
    thread_ = std::thread([this] { run(); });
  }
  ~Impl() {
    quit_.store(true);
    sem_post(&wake_);
    thread_.join();
    sem_destroy(&wake_);
  }

  void prepare() noexcept {
    ready_.store(false, std::memory_order_relaxed);
    sem_post(&wake_);
  }
  void cancel() noexcept { ready_.store(true, std::memory_order_release); }
  void share() noexcept {
    finished_.store(0, std::memory_order_relaxed);
    next_.store(0, std::memory_order_release);  // from here on blocks can be taken
    ready_.store(true, std::memory_order_release);
    takeBlocks();
    while (finished_.load(std::memory_order_acquire) < stages_) std::this_thread::yield();
  }

 private:
  static constexpr int kBlock = 4;

  void takeBlocks() noexcept {
    for (;;) {
      const int first = next_.fetch_add(kBlock, std::memory_order_acq_rel);
      if (first >= stages_) return;
      const int count = std::min(kBlock, stages_ - first);
      work_(context_, first, count);
      finished_.fetch_add(count, std::memory_order_release);
    }
  }
  void run() noexcept {
    for (;;) {
      while (sem_wait(&wake_) != 0 && errno == EINTR) {
      }
      if (quit_.load()) return;
      while (!ready_.load(std::memory_order_acquire)) std::this_thread::yield();
      takeBlocks();
    }
  }

  const int stages_;
  const Work work_;
  void* const context_;
  sem_t wake_;
  std::atomic<bool> quit_{false}, ready_{false};
  std::atomic<int> next_;         // stage nobody has taken yet
  std::atomic<int> finished_{0};  // stages that are done
  std::thread thread_;
};

StageHelper::StageHelper(int stages, Work work, void* context)
    : impl_(std::make_unique<Impl>(stages, work, context)) {}
StageHelper::~StageHelper() = default;

void StageHelper::prepare() noexcept { impl_->prepare(); }
void StageHelper::cancel() noexcept { impl_->cancel(); }
void StageHelper::share() noexcept { impl_->share(); }

}  // namespace ballbot
