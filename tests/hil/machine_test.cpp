#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "hil/machine/machine_facts.hpp"
#include "hil/machine/proc_text.hpp"
#include "hil/machine/realtime_rows.hpp"
#include "hil/machine/worth.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// /proc and /sys of a machine that does not exist.
class FakeMachine : public ::testing::Test {
 protected:
  FakeMachine() : root_(fs::temp_directory_path() / ("machine" + std::to_string(::getpid()))) {
    fs::remove_all(root_);
    const std::string cpus = "/sys/devices/system/cpu/";
    put("/proc/cmdline", "quiet isolcpus=managed_irq,domain,3 rcu_nocbs=2-3");
    put("/proc/sys/kernel/osrelease", "6.1.0-rt");
    put("/proc/sys/kernel/version", "#1 SMP PREEMPT_RT Debian");
    put("/proc/sys/kernel/sched_rt_runtime_us", "950000");
    put("/proc/cpuinfo", "flags : fpu sse");
    put(cpus + "online", "0-3");
    put(cpus + "isolated", "3");
    put(cpus + "nohz_full", "2-3");
    put(cpus + "cpuidle/current_driver", "intel_idle");
    idleState(0, "POLL", 0, false);
    idleState(1, "C1", 2, false);
    idleState(2, "C6", 133, false);
    put(cpus + "cpu3/cpufreq/scaling_governor", "powersave");
    put("/proc/interrupts",
        "           CPU0       CPU1       CPU2       CPU3\n"
        " 16:         10          0          0          7   IO-APIC   16-fasteoi   xhci_hcd:usb1\n"
        " 17:          1          0          0          0   IO-APIC   17-fasteoi   nvme0q1\n"
        " 18:          0          5          0          0   PCI-MSI 32-edge      virtio2-input.0\n"
        "LOC:        100        200        300        400   Local timer interrupts\n"
        "ERR:          0\n");
    put("/proc/irq/16/smp_affinity_list", "0-3");
    put("/proc/irq/17/smp_affinity_list", "0-3");
    put("/proc/irq/18/smp_affinity_list", "0-1");
    put("/sys/class/net/can0/type", "280");
    put("/sys/class/net/can0/tx_queue_len", "10");
    put("/sys/class/net/eth0/type", "1");
    fs::create_symlink("../../virtio2", root_ / "sys/class/net/eth0/device");
    put("/proc/812/comm", "irqbalance");
  }
  ~FakeMachine() override { fs::remove_all(root_); }

  void put(const std::string& path, const std::string& text) {
    const fs::path file = root_.string() + path;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text << '\n';
  }
  void idleState(int number, const std::string& name, int latency_us, bool disabled) {
    const std::string folder =
        "/sys/devices/system/cpu/cpu3/cpuidle/state" + std::to_string(number) + "/";
    put(folder + "name", name);
    put(folder + "latency", std::to_string(latency_us));
    put(folder + "disable", disabled ? "1" : "0");
  }
  std::map<std::string, RealtimeRow> rows(ProcessRights rights = {false, 95, -1}) {
    std::map<std::string, RealtimeRow> by_name;
    for (const RealtimeRow& r : realtimeRows(readMachine(root_, 3), rights, 3)) {
      by_name[r.name] = r;
    }
    return by_name;
  }
  const fs::path root_;
};

TEST(ProcText, ReadsListsOfProcessorsAndWritesThem) {
  EXPECT_THAT(parseCpuList("0-2,5"), ElementsAre(0, 1, 2, 5));
  EXPECT_THAT(parseCpuList("managed_irq,domain,2-3"), ElementsAre(2, 3));
  EXPECT_THAT(parseCpuList(""), ElementsAre());
  EXPECT_THAT(parseCpuList("3-,x,-,9999999999"), ElementsAre());
  EXPECT_EQ(cpuListText({0, 1, 2, 5}), "0-2,5");
  EXPECT_EQ(cpuListText({}), "none");
  EXPECT_EQ(bootParameter("a isolcpus=2 nohz", "isolcpus"), "2");
  EXPECT_EQ(bootParameter("a isolcpus=2 nohz", "nohz"), "on");
  EXPECT_EQ(bootParameter("a isolcpus=2 nohz", "cpus"), "");
}

TEST_F(FakeMachine, IsReadAsItIs) {
  const MachineFacts f = readMachine(root_, 3);
  EXPECT_TRUE(f.preempt_rt);
  EXPECT_TRUE(f.irqbalance);
  EXPECT_FALSE(f.virtual_machine);
  EXPECT_THAT(f.isolated, ElementsAre(3));
  EXPECT_THAT(f.callbacks_away, ElementsAre(2, 3));
  ASSERT_EQ(f.interrupts.size(), 2U) << "USB and the network, not the disk";
  EXPECT_EQ(f.interrupts[0].name, "xhci_hcd:usb1");
  EXPECT_THAT(f.interrupts[1].may_go_to, ElementsAre(0, 1));
  ASSERT_EQ(f.can.size(), 1U);
  EXPECT_EQ(f.can[0].queue_length, 10);
}

TEST_F(FakeMachine, GetsARowForEachThingWithWhatMendsIt) {
  const auto r = rows();
  for (const char* good :
       {"kernel", "priority", "locked_memory", "throttling", "isolation", "tickless", "machine"}) {
    EXPECT_TRUE(r.at(good).good) << good;
    EXPECT_EQ(r.at(good).mend, "") << good;
  }
  EXPECT_FALSE(r.at("interrupts").good);
  EXPECT_THAT(r.at("interrupts").found, HasSubstr("16 (xhci_hcd:usb1); irqbalance is running"));
  EXPECT_THAT(
      r.at("interrupts").mend,
      HasSubstr("for i in 16; do echo 0-2 | sudo tee /proc/irq/$i/smp_affinity_list; done"));
  EXPECT_FALSE(r.at("idle_states").good);
  EXPECT_THAT(r.at("idle_states").found, HasSubstr("C6, 133 us to wake up (intel_idle)"));
  EXPECT_FALSE(r.at("frequency").good);
  EXPECT_EQ(r.at("frequency").mend, "sudo cpupower -c 3 frequency-set -g performance");
  EXPECT_FALSE(r.at("can_queues").good);
  EXPECT_EQ(r.at("can_queues").mend, "sudo ip link set can0 txqueuelen 64");
}

TEST_F(FakeMachine, IsGoodOnceWhatIsWrongHasBeenMended) {
  idleState(2, "C6", 133, true);
  put("/sys/devices/system/cpu/cpu3/cpufreq/scaling_governor", "performance");
  put("/proc/irq/16/smp_affinity_list", "0-2");
  put("/proc/812/comm", "cron");
  put("/sys/class/net/can0/tx_queue_len", "128");
  for (const auto& [name, row] : rows()) EXPECT_TRUE(row.good) << name << ": " << row.found;
}

TEST_F(FakeMachine, WithoutAnythingTunedIsLate) {
  put("/proc/sys/kernel/version", "#1 SMP PREEMPT_DYNAMIC");
  put("/sys/devices/system/cpu/isolated", "");
  put("/sys/devices/system/cpu/nohz_full", "(null)");
  put("/proc/cpuinfo", "flags : fpu hypervisor");
  const auto r = rows({false, 0, 8 << 20});
  for (const char* late :
       {"kernel", "priority", "locked_memory", "isolation", "tickless", "machine"}) {
    EXPECT_FALSE(r.at(late).good) << late;
    EXPECT_NE(r.at(late).mend, "") << late;
  }
}

TEST(Worth, IsWhatWasMeasuredOrWhyItCouldNotBe) {
  FloorMeasurements m;
  m.seconds = 2;
  m.stolen_ms = 30;
  for (int i = 0; i < 100; ++i) {
    m.fifo.add(40'000);
    m.ordinary.add(900'000);
  }
  m.interrupts_before = parseInterrupts("  CPU0 CPU1\n 5: 10 100 chip dev\nLOC: 0 1000 timer\n");
  m.interrupts_after = parseInterrupts("  CPU0 CPU1\n 5: 10 120 chip dev\nLOC: 9 3500 timer\n");
  std::vector<RealtimeRow> rows = realtimeRows({}, {true, 0, 0}, 1);
  m.grant.text = "no SCHED_FIFO";
  addWorth(rows, m, 1);
  std::map<std::string, RealtimeRow> r;
  for (const RealtimeRow& row : rows) {
    EXPECT_NE(row.worth, "") << row.name;
    EXPECT_EQ(row.measured, row.worth.find("not measurable here") != 0) << row.worth;
    r[row.name] = row;
  }
  EXPECT_FALSE(r["priority"].good) << "root, and refused all the same";
  EXPECT_THAT(r["idle_states"].worth, HasSubstr("/dev/cpu_dma_latency cannot be opened"));
  EXPECT_EQ(r["interrupts"].worth, "core 1 had 10 interrupts of devices a second meanwhile");
  EXPECT_THAT(r["tickless"].worth, HasSubstr("core 1 had 1250 timer interrupts a second"));
  EXPECT_THAT(r["machine"].worth, HasSubstr("took 30 ms of 2.0 s from core 1"));
  m.grant.fifo = true;
  rows = realtimeRows({}, {true, 0, 0}, 1);
  addWorth(rows, m, 1);
  EXPECT_THAT(rows.front().worth, HasSubstr("p50 900 -> 40, p99 900 -> 40, max 900 -> 40 us"));
}

}  // namespace
}  // namespace ballbot
