#include "hil/socketcan_bus.hpp"

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/error.hpp"

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

}  // namespace
}  // namespace ballbot
