"""docs/protocol.md suffices to read a log and to step the plant: done here in Python, with lcm_wire.py.

    protocol_test.py --source ROOT --bin build/release/bin
"""
import argparse
import json
import os
import random
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

from lcm_wire import Multicast, Wire, readLog, xxh3

parser = argparse.ArgumentParser()
parser.add_argument("--source", type=Path, required=True)
parser.add_argument("--bin", type=Path, required=True)
given, others = parser.parse_known_args()

PROGRAM = str(given.bin / "ballbot")
SCENARIO = str(given.source / "configs/scenarios/balance.yaml")
SETTINGS = ["--set", "duration_s=0.6"]
GROUP = "239.255.76.67"
STEP_NS = 400_000


class Master:
    """The controller's side of the protocol, one request at a time."""

    def __init__(self, wire, port, channel, config_digest):
        self.wire, self.channel = wire, channel
        self.network = Multicast(GROUP, port)
        self.request = wire.zero("step_request")
        self.request["message_digest"] = signed(wire.messageDigest())
        self.request["config_digest"] = signed(config_digest)
        self.request["header"].update(protocol_version=1, session=random.getrandbits(62) + 1)

    def ask(self, kind, **fields):
        header = self.request["header"]
        header["sequence"] += 1
        header["kind"] = self.wire.constants["step_header"][kind]
        self.request.update(fields)
        data = self.wire.encode("step_request", self.request)
        for _ in range(100):
            self.network.send(self.channel + "_REQUEST", data)
            while packet := self.network.receive(0.2):
                if packet[0] != self.channel + "_REPLY":
                    continue
                name, reply = self.wire.decode(packet[1])
                if name == "step_reply" and reply["header"]["sequence"] == header["sequence"]:
                    return reply
        raise AssertionError(f"no reply to {kind}")


def signed(value):
    return value - 2**64 if value >> 63 else value


class Protocol(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="ballbot-docs-")
        cls.run_folder = Path(cls.folder.name) / "run"
        subprocess.run([PROGRAM, "run", SCENARIO, *SETTINGS, "--in-process", "--no-report", "--quiet", "--out",
                        str(cls.run_folder), "--set", "requirements={fell: {below: 1}}"], check=True, stdout=subprocess.DEVNULL)
        cls.manifest = json.loads((cls.run_folder / "manifest.json").read_text())
        cls.wire = Wire(given.source / "messages")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_a_log_is_read_to_the_last_byte(self):
        seen = {}
        for _, channel, data in readLog(self.run_folder / "run.lcmlog"):
            name, message = self.wire.decode(data)
            self.assertEqual(self.wire.encode(name, message), data, channel)
            seen[name] = message
        self.assertEqual(set(seen), {"actuator_command", "added_values", "plan_report", "sensor_frame", "state_estimate",
                                     "tick_digests", "truth_frame"})
        self.assertGreater(seen["truth_frame"]["sim_time_ns"], 590_000_000)
        self.assertAlmostEqual(sum(c * c for c in seen["truth_frame"]["quat_WE"]), 1, delta=1e-9)

    def test_a_damaged_message_is_noticed(self):
        _, _, data = next(iter(readLog(self.run_folder / "run.lcmlog")))
        damaged = data[:20] + bytes([data[20] ^ 1]) + data[21:]
        with self.assertRaisesRegex(ValueError, "checksum"):
            self.wire.decode(damaged)

    def test_a_foreign_master_steps_the_plant(self):
        channel, port = f"FOREIGN{os.getpid()}", random.randint(20_000, 29_999)
        plant = subprocess.Popen([PROGRAM, "plant", SCENARIO, *SETTINGS, "--set", "requirements={fell: {below: 1}}",
                                  "--channel", channel, "--lcm-url", f"udpm://{GROUP}:{port}?ttl=0"],
                                 stderr=subprocess.PIPE, text=True)
        try:
            config_digest = xxh3(self.manifest["config_digest"].encode())
            master = Master(self.wire, port, channel, config_digest)
            self.addCleanup(master.network.close)
            self.step(master)
            self.assertEqual(plant.wait(20), 0)
        finally:
            if plant.poll() is None:
                plant.send_signal(signal.SIGKILL)
            plant.communicate()

    def step(self, master):
        hello = master.ask("HELLO")
        self.assertEqual((hello["status"], hello["text"], hello["truth_count"]), (0, "", 1))
        for k in range(10):
            reply = master.ask("STEP", time_ns=k * STEP_NS, step_ns=STEP_NS)
            self.assertEqual((reply["status"], reply["text"]), (0, ""))
            self.assertEqual(reply["time_ns"], (k + 1) * STEP_NS)
            self.assertEqual(reply["sensors"]["sim_time_ns"], reply["time_ns"])
        gap = master.ask("STEP", time_ns=0, step_ns=STEP_NS)
        self.assertNotEqual(gap["status"], 0, "a step from another time")
        self.assertEqual(master.ask("BYE")["status"], 0)
        # Once more, unanswered, so that the plant need not wait for it.
        request = master.request
        request["header"]["sequence"] += 1
        master.network.send(master.channel + "_REQUEST", self.wire.encode("step_request", request))


if __name__ == "__main__":
    unittest.main(argv=["protocol_test", "-v", *others])
