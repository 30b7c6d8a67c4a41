#pragma once

#include <memory>

namespace ballbot {

/// A second thread that shares work on the stages of a horizon. Blocks of stages go to whoever is
/// free, so that a helper that does not get a processor holds nobody up for longer than one block.
/// A stage is computed by the same call whoever makes it: the result does not depend on the
/// sharing. Only the constructor allocates.
class StageHelper {
 public:
  /// Does `count` stages from `first` on; called by both threads, for different stages.
  using Work = void (*)(void* context, int first, int count) noexcept;

  StageHelper(int stages, Work work, void* context);
  ~StageHelper();
  StageHelper(const StageHelper&) = delete;
  StageHelper& operator=(const StageHelper&) = delete;

  /// Wakes the helper ahead of time, so that it is there when the stages can be worked on.
  void prepare() noexcept;
  /// After prepare(), when there is nothing to share after all.
  void cancel() noexcept;
  /// After prepare(): does all stages, together with the helper.
  void share() noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ballbot
