#include "hil/socketcan_bus.hpp"

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/error.hpp"
#include "hil/socketcan_frame.hpp"
#include "tests/hil/support/random_bytes.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

bool kernelHasCan() {
  const int s = ::socket(PF_CAN, SOCK_RAW, CAN_RAW);
  if (s >= 0) ::close(s);
  return s >= 0;
}

TEST(SocketCanBus, SaysWhatIsMissing) {
  try {
    SocketCanBus bus("ballbot_no_can");
    FAIL() << "opened an interface that does not exist";
  } catch (const InputError& e) {
    if (kernelHasCan()) {
      EXPECT_THAT(e.what(), HasSubstr("ballbot_no_can: there is no such interface"));
    } else {
      EXPECT_THAT(e.what(), HasSubstr("this kernel has no CAN (AF_CAN). Load it with"));
    }
  }
}

// `ip link add dev vcan0 type vcan && ip link set vcan0 up` makes this test run.
TEST(SocketCanBus, CarriesFramesOverVcan) {
  if (!kernelHasCan()) GTEST_SKIP() << "this kernel has no CAN";
  std::unique_ptr<SocketCanBus> a, b;
  try {
    a = std::make_unique<SocketCanBus>("vcan0");
    b = std::make_unique<SocketCanBus>("vcan0");
  } catch (const InputError& e) {
    GTEST_SKIP() << e.what();
  }
  const CanFrame frame{0x1ABCDEF, true, false, 3, {1, 2, 3}};
  ASSERT_TRUE(a->send(frame));
  CanFrame back;
  ASSERT_TRUE(b->waitReadable(std::chrono::seconds(1)));
  ASSERT_TRUE(b->receive(back));
  EXPECT_EQ(back, frame);
}

// Where the kernel has no CAN a pair of sockets carries the very bytes that its CAN sockets would.
TEST(SocketCanBus, CarriesClassicAndFlexibleFrames) {
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends), 0);
  SocketCanBus a(ends[0], "a"), b(ends[1], "b");
  RandomBytes random(31);
  for (int i = 0; i < 2000; ++i) {
    const CanFrame frame = i % 2 == 0 ? random.frame() : random.flexibleFrame();
    ASSERT_TRUE(a.send(frame));
    CanFrame back;
    ASSERT_TRUE(b.receive(back));
    ASSERT_EQ(back, frame) << i;
  }
  CanFrame bad;
  bad.size = 9;
  EXPECT_FALSE(a.send(bad));
  bad.flexible = true;
  EXPECT_FALSE(a.send(bad)) << "nine bytes are no length of CAN FD";
  EXPECT_EQ(a.counters().refused, 2);
  CanFrame none;
  EXPECT_FALSE(b.receive(none));
}

TEST(SocketCanFrame, HasTheLayoutOfTheKernel) {
  CanFrame frame{0x181, false, false, 20, {}};
  frame.flexible = frame.fast = true;
  frame.data[19] = 7;
  canfd_frame raw;
  ASSERT_EQ(toKernel(frame, raw), CANFD_MTU);
  EXPECT_EQ(raw.can_id, 0x181U);
  EXPECT_EQ(raw.len, 20);
  EXPECT_EQ(raw.flags & CANFD_BRS, CANFD_BRS);
  EXPECT_EQ(raw.data[19], 7);
  EXPECT_EQ(toKernel({0x181, false, false, 8, {}}, raw), CAN_MTU);
  CanFrame out;
  raw.len = 65;
  EXPECT_EQ(fromKernel(raw, CANFD_MTU, out), KernelFrame::kMalformed);
  raw.len = 13;
  EXPECT_EQ(fromKernel(raw, CANFD_MTU, out), KernelFrame::kMalformed);
  raw.len = 9;
  EXPECT_EQ(fromKernel(raw, CAN_MTU, out), KernelFrame::kMalformed);
  raw.len = 8;
  EXPECT_EQ(fromKernel(raw, CAN_MTU - 1, out), KernelFrame::kMalformed);
  raw.can_id = CAN_ERR_FLAG;
  EXPECT_EQ(fromKernel(raw, CAN_MTU, out), KernelFrame::kError);
}

}  // namespace
}  // namespace ballbot
