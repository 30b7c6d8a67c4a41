#include "hil/latency/answer_probe.hpp"

#include <algorithm>
#include <limits>

#include "hil/canopen_codec.hpp"
#include "hil/frame_bits.hpp"

namespace ballbot {
namespace {

constexpr std::uint8_t kImuPdos = 0b11;
constexpr double kNsPerUs = 1000;

}  // namespace

AnswerProbe::AnswerProbe(const BenchConfig& config)
    : now_(config.buses.size()), buses_(config.buses.size()) {
  for (const BusConfig& bus : config.buses) rates_.push_back(bus.settings);
  for (std::size_t i = 0; i < kNodes; ++i) {
    const bool imu = i == kDriveCount;
    bus_of_[i] = imu ? config.imu.bus : config.drives[i].bus;
    id_of_[i] = static_cast<std::uint32_t>(imu ? config.imu.node : config.drives[i].node);
    all_pdos_[i] = imu ? kImuPdos : static_cast<std::uint8_t>((1U << config.inputs.size()) - 1);
  }
}

std::int64_t AnswerProbe::wireNs(std::size_t bus, const WireBits& bits) const noexcept {
  if (!buses_[bus].has_wire) return 0;
  const double us = bits.microseconds(rates_[bus].bitrate_kbps, rates_[bus].data_bitrate_kbps);
  return static_cast<std::int64_t>(kNsPerUs * us);
}

void AnswerProbe::onSync(std::int64_t time_ns, std::size_t bus) noexcept {
  BusNow& b = now_[bus];
  b.sync_ns = time_ns;
  b.bits = bitsOf(syncFrame()).nominal;
  b.waiting = true;
  for (std::size_t i = 0; i < kNodes; ++i) {
    if (bus_of_[i] == static_cast<int>(bus)) answers_[i] = {all_pdos_[i], 0, 0, false};
  }
}

void AnswerProbe::onFrame(std::int64_t time_ns, int bus_number, const CanFrame& f,
                          bool sent) noexcept {
  const auto bus = static_cast<std::size_t>(bus_number);
  const std::uint32_t node = f.id & 0x7FU, function = f.id & 0x780U;
  const bool plain = !f.extended && !f.remote;
  if (sent && plain && f.id == kCobSync) return onSync(time_ns, bus);
  now_[bus].bits += bitsOf(f).nominal;
  if (sent || !plain || !now_[bus].waiting) return;
  const auto pdo = std::find(kCobTpdo.begin(), kCobTpdo.end(), function);
  if (pdo == kCobTpdo.end()) return;
  for (std::size_t i = 0; i < kNodes; ++i) {
    if (bus_of_[i] == bus_number && id_of_[i] == node) {
      return onPdo(time_ns, bus, i, static_cast<int>(pdo - kCobTpdo.begin()));
    }
  }
}

void AnswerProbe::onPdo(std::int64_t time_ns, std::size_t bus, std::size_t node, int pdo) noexcept {
  NodeNow& n = answers_[node];
  if (n.complete) return;
  n.missing = static_cast<std::uint8_t>(n.missing & ~(1U << pdo));
  if (n.missing != 0) return;
  n.complete = true;
  n.answer_ns = time_ns - now_[bus].sync_ns;
  n.wire_ns = wireNs(bus, now_[bus].bits);
}

void AnswerProbe::endCycle() noexcept {
  for (std::size_t bus = 0; bus < now_.size(); ++bus) {
    if (now_[bus].waiting) onAnswers(bus);
    now_[bus].waiting = false;
  }
}

void AnswerProbe::onAnswers(std::size_t bus) noexcept {
  const auto isHere = [&](std::size_t i) { return bus_of_[i] == static_cast<int>(bus); };
  Bus& b = buses_[bus];
  bool whole = true, any = false;
  for (std::size_t i = 0; i < kNodes; ++i) {
    if (!isHere(i)) continue;
    whole = whole && answers_[i].complete;
    any = any || answers_[i].complete;
    if (answers_[i].complete && answers_[i].answer_ns < answers_[i].wire_ns) b.has_wire = false;
  }
  if (!any) return;
  std::int64_t quickest = std::numeric_limits<std::int64_t>::max();
  const NodeNow* last = nullptr;
  for (std::size_t i = 0; i < kNodes; ++i) {
    NodeNow& n = answers_[i];
    if (!isHere(i) || !n.complete) continue;
    if (!b.has_wire) n.wire_ns = 0;
    quickest = std::min(quickest, n.answer_ns - n.wire_ns);
    if (last == nullptr || n.answer_ns > last->answer_ns) last = &n;
  }
  b.shared.add(quickest);
  if (whole) {
    b.answers.add(last->answer_ns);
    b.wire.add(last->wire_ns);
  }
  for (std::size_t i = 0; i < kNodes; ++i) {
    if (!isHere(i) || !answers_[i].complete) continue;
    nodes_[i].answer.add(answers_[i].answer_ns);
    nodes_[i].own.add(answers_[i].answer_ns - answers_[i].wire_ns - quickest);
  }
}

}  // namespace ballbot
