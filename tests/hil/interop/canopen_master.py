"""A small CANopen master of its own on python-can: nothing of it knows the C++ code. Frames are
built from CiA 301 and CiA 402 alone."""

import struct
import time

import can


class SdoAbort(Exception):
    """The server refused a transfer; `code` is the abort code of CiA 301."""

    def __init__(self, code):
        super().__init__(f"SDO abort {code:08X}")
        self.code = code


class Node:
    """One node behind a bus, as a master sees it."""

    def __init__(self, bus, number):
        self.bus, self.number = bus, number

    # Frames

    def send(self, identifier, data=b"", **more):
        message = can.Message(arbitration_id=identifier, data=bytes(data), is_extended_id=False, **more)
        self.bus.send(message)

    def receive(self, identifier, timeout=20.0):
        """The next data frame with this identifier; others are dropped. None after the timeout."""
        until = time.monotonic() + timeout
        while (left := until - time.monotonic()) > 0:
            message = self.bus.recv(left)
            if message is not None and message.arbitration_id == identifier and not message.is_remote_frame:
                return bytes(message.data)
        return None

    def nmt(self, command):
        self.send(0x000, [command, self.number])

    def sync(self):
        self.send(0x080)

    def heartbeat(self, timeout=20.0):
        """State byte of the next heartbeat."""
        data = self.receive(0x700 + self.number, timeout)
        return None if data is None else data[0]

    # SDO

    def ask(self, request):
        self.send(0x600 + self.number, request)
        answer = self.receive(0x580 + self.number)
        assert answer is not None and len(answer) == 8, f"no answer to {request.hex()}"
        if answer[0] == 0x80:
            raise SdoAbort(struct.unpack("<I", answer[4:])[0])
        return answer

    def upload(self, index, sub=0):
        answer = self.ask(struct.pack("<BHB4x", 0x40, index, sub))
        assert struct.unpack("<HB", answer[1:4]) == (index, sub)
        if answer[0] & 0x02:  # expedited
            return answer[4 : 8 - (answer[0] >> 2 & 3)] if answer[0] & 0x01 else answer[4:]
        size = struct.unpack("<I", answer[4:])[0]
        data, toggle = b"", 0
        while True:
            segment = self.ask(bytes([0x60 | toggle]) + bytes(7))
            assert segment[0] & 0xF0 == toggle, f"segment {segment.hex()}"
            data += segment[1 : 8 - (segment[0] >> 1 & 7)]
            if segment[0] & 0x01:
                break
            toggle ^= 0x10
        assert len(data) == size
        return data

    def read(self, index, sub=0, signed=False):
        return int.from_bytes(self.upload(index, sub), "little", signed=signed)

    def write(self, index, sub, value, size, signed=False):
        """Expedited download."""
        data = value.to_bytes(size, "little", signed=signed)
        command = 0x23 | (4 - size) << 2
        answer = self.ask(struct.pack("<BHB", command, index, sub) + data.ljust(4, b"\0"))
        assert answer[0] == 0x60 and struct.unpack("<HB", answer[1:4]) == (index, sub)

    def download_in_segments(self, index, sub, data):
        answer = self.ask(struct.pack("<BHBI", 0x21, index, sub, len(data)))
        assert answer[0] == 0x60
        toggle = 0
        for start in range(0, len(data), 7):
            part = data[start : start + 7]
            last = start + 7 >= len(data)
            segment = self.ask(bytes([toggle | (7 - len(part)) << 1 | last]) + part.ljust(7, b"\0"))
            assert segment[0] == 0x20 | toggle, f"segment {segment.hex()}"
            toggle ^= 0x10

    def map_pdo(self, transmit, number, entries, transmission):
        """The order of CiA 301: off, count 0, entries, count, on."""
        parameters, mapping = (0x1800, 0x1A00) if transmit else (0x1400, 0x1600)
        identifier = (0x180 if transmit else 0x200) + 0x100 * number + self.number
        self.write(parameters + number, 1, 0x80000000 | identifier, 4)
        self.write(parameters + number, 2, transmission, 1)
        self.write(mapping + number, 0, 0, 1)
        for sub, entry in enumerate(entries, 1):
            self.write(mapping + number, sub, entry, 4)
        self.write(mapping + number, 0, len(entries), 1)
        self.write(parameters + number, 1, identifier, 4)
        return identifier
