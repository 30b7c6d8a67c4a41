"""python-can's slcan interface and an independent CANopen master against `ballbot drives`.

Usage: python_can_test.py BALLBOT BENCH_FILE
"""

import json
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import can
import serial

from canopen_master import Node, SdoAbort

BALLBOT, BENCH = sys.argv[1:3]


class Drives:
    """`ballbot drives` on links of its own."""

    def __init__(self, *settings):
        self.folder = tempfile.TemporaryDirectory()
        self.links = [os.path.join(self.folder.name, f"can{i}") for i in (0, 1)]
        arguments = [BALLBOT, "drives", BENCH, "--json"]
        links = [f"emulator.buses.{i}.link={link}" for i, link in enumerate(self.links)]
        for setting in [*links, *settings]:
            arguments += ["--set", setting]
        self.process = subprocess.Popen(
            arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        while not os.path.islink(self.links[1]):
            if self.process.poll() is not None:
                raise RuntimeError(self.process.stderr.read())
            time.sleep(0.02)

    def open(self, bus=0):
        return can.Bus(
            interface="slcan", channel=self.links[bus], bitrate=1000000, sleep_after_open=0
        )

    def finish(self):
        self.process.send_signal(signal.SIGINT)
        out, err = self.process.communicate(timeout=60)
        assert self.process.returncode == 0, err
        self.folder.cleanup()
        return json.loads(out)


class BenchCase(unittest.TestCase):
    settings = ()

    def setUp(self):
        self.drives = Drives(*self.settings)
        self.bus = self.drives.open()
        self.node = Node(self.bus, 2)

    def tearDown(self):
        self.bus.shutdown()
        self.report = self.drives.finish()

    def refused(self, code, call, *arguments):
        with self.assertRaises(SdoAbort) as refusal:
            call(*arguments)
        self.assertEqual(f"{refusal.exception.code:08X}", code)


class NetworkManagement(BenchCase):
    def test_states_and_heartbeat(self):
        node = self.node
        node.nmt(0x81)
        self.assertEqual(node.heartbeat(), 0x00, "boot-up message after a reset")
        node.write(0x1017, 0, 20, 2)
        self.assertEqual(node.read(0x1017), 20)
        for command, state in ((0x01, 0x05), (0x02, 0x04), (0x80, 0x7F)):
            node.nmt(command)
            while (seen := node.heartbeat()) != state:
                self.assertIsNotNone(seen, f"heartbeat {state:02X} after NMT {command:02X}")
        node.nmt(0x02)
        node.send(0x602, struct.pack("<BHB4x", 0x40, 0x1000, 0))
        self.assertIsNone(node.receive(0x582, 0.3), "no SDO while stopped")
        node.nmt(0x82)
        while node.heartbeat() != 0x00:
            pass
        self.assertEqual(node.read(0x1017), 0, "reset of communication restores 1017")

    def test_emergency_when_the_heartbeat_it_watches_ends(self):
        node = self.node
        node.write(0x1016, 1, 0x7F << 16 | 50, 4)
        node.nmt(0x01)
        node.send(0x77F, [0x05])
        emergency = node.receive(0x082)
        self.assertEqual(struct.unpack("<HB", emergency[:3])[0], 0x8130)
        self.assertEqual(len(emergency), 8)
        self.assertEqual(emergency[2] & 0x11, 0x11, "generic and communication error")
        self.assertEqual(node.read(0x1001), emergency[2])
        self.assertEqual(node.read(0x1003, 1), 0x8130)


class ServiceData(BenchCase):
    def test_standard_objects(self):
        node = self.node
        self.assertEqual(node.read(0x1000), 0x00020192)
        self.assertEqual(node.read(0x1001), 0)
        self.assertEqual(node.upload(0x1008), b"ballbot emulated drive", "four segments")
        self.assertEqual(node.upload(0x1009), b"emulated")
        self.assertEqual(node.upload(0x100A), b"1.0")
        self.assertEqual(node.read(0x1018, 0), 4)
        self.assertEqual(node.read(0x1018, 4), 2)
        self.assertEqual(node.read(0x6502), 1 << 7 | 1 << 9)
        self.assertEqual(node.read(0x603F), 0)
        for index in (0x6041, 0x6061, 0x6064, 0x606C, 0x6077):
            node.read(index)

    def test_segmented_download(self):
        self.node.download_in_segments(0x6072, 0, struct.pack("<H", 900))
        self.assertEqual(self.node.read(0x6072), 900)

    def test_refusals(self):
        node = self.node
        self.refused("06020000", node.read, 0x5FFF)
        self.refused("06090011", node.read, 0x1018, 9)
        self.refused("06010002", node.write, 0x1000, 0, 1, 4)
        self.refused("06070010", node.write, 0x6072, 0, 1, 4)
        self.refused("06090030", node.write, 0x6060, 0, 3, 1)
        self.refused("05040001", node.ask, bytes([0xE0, 0, 0x10, 0, 0, 0, 0, 0]))
        node.ask(struct.pack("<BHB4x", 0x40, 0x1008, 0))
        self.refused("05030000", node.ask, bytes([0x70]) + bytes(7))


class ProcessData(BenchCase):
    def test_remapping_and_torque(self):
        node = self.node
        self.refused("06010000", node.write, 0x1A00, 0, 0, 1)  # while the PDO is on
        node.map_pdo(False, 0, [0x60400010, 0x60710010], 255)
        inputs = node.map_pdo(True, 0, [0x60410010, 0x60610008, 0x60770010], 1)
        self.refused("06040041", node.map_pdo, True, 3, [0x60760020], 1)
        node.write(0x6060, 0, 10, 1)
        self.assertEqual(node.read(0x6061), 10)
        node.nmt(0x01)
        for controlword, wanted in ((0x06, 0x21), (0x07, 0x23), (0x0F, 0x27)):
            node.send(0x202, struct.pack("<Hh", controlword, 0))
            node.sync()
            status, mode, _ = struct.unpack("<Hbh", node.receive(inputs))
            self.assertEqual(status & 0x6F, wanted, f"statusword {status:04X} after {controlword:02X}")
            self.assertEqual(mode, 10)
        node.send(0x202, struct.pack("<Hh", 0x0F, 25))
        for _ in range(100):
            node.sync()
            torque = struct.unpack("<Hbh", node.receive(inputs))[2]
        self.assertAlmostEqual(torque, 25, delta=10, msg="per mille of 6076")
        node.send(0x202, struct.pack("<Hh", 0x00, 0))
        self.assertEqual(node.read(0x6041) & 0x4F, 0x40)


class Faults(BenchCase):
    settings = ("emulator.faults=[{at_cycle: 5, kind: emergency, drive: 2, value: 8976}]",)

    def test_emergency_and_reset(self):
        node = self.node
        node.nmt(0x01)
        for _ in range(5):
            node.sync()
        emergency = node.receive(0x082)
        self.assertEqual(struct.unpack("<H", emergency[:2])[0], 0x2310)
        self.assertEqual(node.read(0x603F), 0x2310)
        self.assertEqual(node.read(0x6041) & 0x4F, 0x08)
        node.write(0x6040, 0, 0x0F, 2)
        self.assertEqual(node.read(0x6041) & 0x4F, 0x08, "a fault is left by a reset only")


class Adapter(BenchCase):
    def test_python_can_reads_version_and_serial_number(self):
        self.assertEqual(self.bus.get_version(10), (10, 13))
        self.assertEqual(self.bus.get_serial_number(10), "BALL")

    def test_answers_byte_by_byte(self):
        port = serial.Serial(self.drives.links[1], timeout=10)

        def say(command, *parts):
            for part in (command, *parts):  # a line may come in pieces
                port.write(part)
                port.flush()
            answer = b""
            while not answer.endswith((b"\r", b"\a")):
                byte = port.read(1)
                self.assertTrue(byte, f"no answer to {command}")
                answer += byte
            return answer

        self.assertEqual(say(b"t20", b"12060", b"0\r"), b"\a", "closed: nothing is sent")
        for rate in range(9):
            self.assertEqual(say(b"S%d\r" % rate), b"\r")
        self.assertEqual(say(b"S9\r"), b"\a")
        self.assertEqual(say(b"O\r"), b"\r")
        self.assertEqual(say(b"S8\r"), b"\a", "not while open")
        self.assertEqual(say(b"t2012", b"0600\r"), b"z\r")
        self.assertEqual(say(b"T000002012", b"0600\r"), b"Z\r")
        self.assertEqual(say(b"r1818\r"), b"z\r")
        self.assertEqual(say(b"R000001818\r"), b"Z\r")
        self.assertEqual(say(b"t2019\r"), b"\a")
        self.assertEqual(say(b"t8000\r"), b"\a", "11 bits end at 7FF")
        self.assertEqual(say(b"F\r"), b"F00\r")
        self.assertEqual(say(b"V\r"), b"V1013\r")
        self.assertEqual(say(b"N\r"), b"NBALL\r")
        self.assertEqual(say(b"\r"), b"\r")
        self.assertEqual(say(b"C\r"), b"\r")
        self.assertEqual(say(b"Z1\r"), b"\r")
        self.assertEqual(say(b"O\r"), b"\r")
        port.write(b"t00028104\r")  # reset node 4: its boot-up message with a time stamp
        answer = port.read(2 + 11)
        self.assertEqual(answer[:8], b"z\rt70410")
        port.close()


class Records(unittest.TestCase):
    """The frames that a stopped bench leaves, as other people's tools read them."""

    def test_candump_and_asc_are_read_frame_by_frame(self):
        drives = Drives(
            "emulator.rig={blocked: true}",
            "emulator.faults=[{at_cycle: 300, kind: emergency, drive: 2, value: 17168}]",
        )
        with tempfile.TemporaryDirectory() as folder:
            arguments = [BALLBOT, "identify", BENCH, "--drive", "1", "--records", folder]
            for i, link in enumerate(drives.links):
                arguments += ["--set", f'buses.{i}.address="slcan:{link}"']
            done = subprocess.run(arguments, stderr=subprocess.PIPE, text=True, timeout=120)
            drives.finish()
            self.assertEqual(done.returncode, 3, done.stderr)
            (name,) = os.listdir(folder)
            self.assertTrue(name.startswith("bench-node_trouble-"), name)
            record = os.path.join(folder, name)
            with open(os.path.join(record, "record.json")) as file:
                count = json.load(file)["frames"]["count"]
            candump = list(can.LogReader(os.path.join(record, "frames.log")))
            with can.ASCReader(os.path.join(record, "frames.asc"), relative_timestamp=True) as reader:
                asc = list(reader)
        self.assertEqual((len(candump), len(asc)), (count, count))
        for a, b in zip(candump, asc):
            self.assertEqual(
                (a.arbitration_id, a.data, a.dlc, a.is_rx), (b.arbitration_id, b.data, b.dlc, b.is_rx)
            )
            self.assertEqual(int(a.channel[3:]), b.channel)
            self.assertAlmostEqual(a.timestamp, b.timestamp, places=5)
        self.assertTrue(all(a.timestamp <= b.timestamp for a, b in zip(candump, candump[1:])))
        (emergency,) = [f for f in candump if f.arbitration_id == 0x082]
        self.assertEqual(emergency.data[:2], struct.pack("<H", 17168))
        self.assertTrue(emergency.is_rx)
        self.assertFalse(next(f for f in candump if f.arbitration_id == 0x080).is_rx, "SYNC is ours")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
