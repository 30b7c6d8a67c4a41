#include "hil/record/fault_record.hpp"

#include <algorithm>

namespace ballbot {

std::vector<const RecordedFrame*> FaultRecord::frames() const {
  std::vector<const RecordedFrame*> list;
  const auto& ring = recorder.frames();
  for (std::size_t i = 0; i < ring.size(); ++i) list.push_back(&ring[i]);
  if (recorder.hasClock()) return list;
  // A set-up is one cycle to this clock, and what asks and what answers must stay in order there.
  const auto running =
      std::find_if(list.begin(), list.end(), [](const RecordedFrame* f) { return f->cycle > 0; });
  std::stable_sort(running, list.end(), [](const RecordedFrame* a, const RecordedFrame* b) {
    return a->cycle != b->cycle ? a->cycle < b->cycle : a->bus < b->bus;
  });
  return list;
}

}  // namespace ballbot
