"""The wire format of docs/protocol.md, written from that page alone: no code of ours, no LCM library.
Reads and writes messages by their definitions in messages/*.lcm; sends them as single UDP packets."""
import ctypes
import re
import socket
import struct
from pathlib import Path

FORMATS = {"int8_t": "b", "int32_t": "i", "int64_t": "q", "double": "d", "boolean": "b", "byte": "B"}
MAGIC = 0x4C433032  # "LC02": a message in one packet
xxhash = ctypes.CDLL("libxxhash.so.0")
xxhash.XXH3_64bits.restype = ctypes.c_uint64


def xxh3(data):
    return xxhash.XXH3_64bits(data, ctypes.c_size_t(len(data)))


def readDefinitions(folder):
    """-> {type: [(type of the field, name, lengths as written)]}, and constants {type: {name: value}}."""
    structs, constants = {}, {}
    for path in sorted(Path(folder).glob("*.lcm")):
        text = re.sub(r"//.*", "", path.read_text())
        name, body = re.search(r"struct (\w+) \{(.*)\}", text, re.S).groups()
        structs[name], constants[name] = [], {}
        for statement in (s.split() for s in body.split(";") if s.strip()):
            if statement[0] == "const":
                constants[name][statement[2]] = int(statement[4])
            else:
                field, lengths = re.match(r"(\w+)((?:\[\w+\])*)", statement[1]).groups()
                structs[name].append((statement[0], field, re.findall(r"\[(\w+)\]", lengths)))
    return structs, constants


class Wire:
    """@param joints  of the robot: wheels and arm joints"""

    def __init__(self, folder, joints=6):
        self.robot = {"joints": joints, "coordinates": joints + 2}
        self.structs, self.constants = readDefinitions(folder)
        self.by_fingerprint = {self.fingerprint(name): name for name in self.structs}

    # --- fingerprints, as LCM defines them ---

    def _ownHash(self, name):
        value = 0x12345678

        def add(number):
            nonlocal value
            signed = value - (1 << 64) if value >> 63 else value
            value = (((value << 8) ^ (signed >> 55)) + number) & (2**64 - 1)

        def addText(text):
            add(len(text))
            for letter in text.encode():
                add(letter)

        for type_, field, lengths in self.structs[name]:
            addText(field)
            if type_ not in self.structs:
                addText(type_)
            add(len(lengths))
            for length in lengths:
                add(0 if length.isdigit() else 1)
                addText(length)
        return value

    def fingerprint(self, name):
        value = self._ownHash(name)
        for type_, _, _ in self.structs[name]:
            if type_ in self.structs:
                value += self.fingerprint(type_)
        value &= 2**64 - 1
        return ((value << 1) | (value >> 63)) & (2**64 - 1)

    # --- fields: in the order of the definition, big endian, without gaps ---

    def _length(self, lengths, message):
        return int(lengths[0]) if lengths[0].isdigit() else message[lengths[0]]

    def _encodeFields(self, name, message):
        out = b""
        for type_, field, lengths in self.structs[name]:
            values = message[field] if lengths else [message[field]]
            for value in values:
                if type_ in self.structs:
                    out += self._encodeFields(type_, value)
                elif type_ == "string":
                    text = value.encode() + b"\0"
                    out += struct.pack(">i", len(text)) + text
                else:
                    out += struct.pack(">" + FORMATS[type_], value)
        return out

    def _decodeFields(self, name, data, at):
        message = {}
        for type_, field, lengths in self.structs[name]:
            values = []
            for _ in range(self._length(lengths, message) if lengths else 1):
                if type_ in self.structs:
                    value, at = self._decodeFields(type_, data, at)
                elif type_ == "string":
                    size = struct.unpack_from(">i", data, at)[0]
                    value, at = data[at + 4:at + 3 + size].decode(), at + 4 + size
                else:
                    value = struct.unpack_from(">" + FORMATS[type_], data, at)[0]
                    at += struct.calcsize(">" + FORMATS[type_])
                values.append(value)
            message[field] = values if lengths else values[0]
        return message, at

    # --- whole messages ---

    @staticmethod
    def checksum(data):
        return xxh3(data[:8] + struct.pack("<Q", xxh3(data[16:])))

    def encode(self, name, message):
        data = struct.pack(">Q", self.fingerprint(name)) + self._encodeFields(name, message)
        return data[:8] + struct.pack(">Q", self.checksum(data)) + data[16:]

    def decode(self, data):
        """-> (type, message). Every byte must be accounted for."""
        name = self.by_fingerprint[struct.unpack_from(">Q", data)[0]]
        if struct.unpack_from(">Q", data, 8)[0] != self.checksum(data):
            raise ValueError(f"{name}: the checksum does not hold")
        message, end = self._decodeFields(name, data, 8)
        if end != len(data):
            raise ValueError(f"{name}: {len(data)} bytes, of which {end} are fields")
        return name, message

    def zero(self, name):
        """A message with every field zero, of the robot's size; other lists without fixed length are empty."""
        def value(type_, field):
            if type_ in self.structs:
                return self.zero(type_)
            return "" if type_ == "string" else self.robot.get(field, 0)

        message = {}
        for type_, field, lengths in self.structs[name]:
            if lengths:
                count = int(lengths[0]) if lengths[0].isdigit() else self.robot.get(lengths[0], 0)
                message[field] = [value(type_, field) for _ in range(count)]
            else:
                message[field] = value(type_, field)
        return message

    def size(self, name, **counts):
        """Bytes of a message whose lists without fixed length have the given numbers of elements."""
        message = self.zero(name)
        for type_, field, lengths in self.structs[name]:
            if lengths and lengths[0] in counts:
                message[lengths[0]] = counts[lengths[0]]
                one = self.zero(type_) if type_ in self.structs else 0
                message[field] = [one] * counts[lengths[0]]
        return len(self.encode(name, message))

    def messageDigest(self):
        names = ("step_request", "step_reply", "state_estimate", "plan_report", "tick_digests", "added_values")
        return xxh3(b"".join(struct.pack("<Q", self.fingerprint(name)) for name in names))


class Multicast:
    """LCM's UDP provider, as far as messages of one packet go."""

    def __init__(self, group, port):
        self.address, self.count = (group, port), 0
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        self.socket.bind((group, port))
        membership = struct.pack("4s4s", socket.inet_aton(group), socket.inet_aton("0.0.0.0"))
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)

    def close(self):
        self.socket.close()

    def send(self, channel, data):
        self.socket.sendto(struct.pack(">II", MAGIC, self.count) + channel.encode() + b"\0" + data, self.address)
        self.count += 1

    def receive(self, timeout_s):
        """-> (channel, data), or None."""
        self.socket.settimeout(timeout_s)
        try:
            packet = self.socket.recv(65536)
        except socket.timeout:
            return None
        if struct.unpack_from(">I", packet)[0] != MAGIC:
            return None
        channel, data = packet[8:].split(b"\0", 1)
        return channel.decode(), data


def readLog(path):
    """-> (microseconds, channel, data) of each event of an LCM log."""
    data, at = Path(path).read_bytes(), 0
    while at < len(data):
        sync, _, time_us, channel_size, size = struct.unpack_from(">IqqII", data, at)
        assert sync == 0xEDA1DA01, f"no event at byte {at}"
        at += 28
        yield time_us, data[at:at + channel_size].decode(), data[at + channel_size:at + channel_size + size]
        at += channel_size + size
