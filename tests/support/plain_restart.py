# SPDX-License-Identifier: BSD-3-Clause
"""Restart files of LIGGGHTS, taken apart by plain code: little endian, ids of 4 and counts of 8 bytes."""
import struct

TEXTS = {0, 4, 22}
COUNTS = {5, 23, 25, 28, 31, 34}
STEP, PROCESSES, STYLE, ATOMS = 5, 7, 22, 23


class Restart:
    """header (by flag), styles, records: lists of doubles, as bytes where they are integers."""

    def __init__(self, path, parts=()):
        with open(path, "rb") as file:
            self.bytes = file.read()
        self.place = 0
        self._read_header()
        if parts:
            chunks = []
            for part in parts:
                with open(part, "rb") as file:
                    chunks.append(file.read())
        else:
            chunks = self._find_chunks()
        self.records = []
        for chunk in chunks:
            values = struct.unpack(f"<{struct.unpack_from('<i', chunk)[0]}d", chunk[4:])
            while values:
                self.records.append(values[:int(values[0])])
                values = values[int(values[0]):]

    def _int(self):
        self.place += 4
        return struct.unpack_from("<i", self.bytes, self.place - 4)[0]

    def _text(self):
        size = self._int()
        self.place += size
        return self.bytes[self.place - size:self.place - 1].decode()

    def _read_header(self):
        self.header, self.styles = {}, []
        while (flag := self._int()) != -1:
            if flag in TEXTS:
                self.header[flag] = self._text()
            else:
                kind = "q" if flag in COUNTS else "d" if flag >= 37 else "i"
                size = struct.calcsize("<" + kind)
                self.header[flag] = struct.unpack_from("<" + kind, self.bytes, self.place)[0]
                self.place += size
            if flag == STYLE:
                self.styles = [self._text() for _ in range(self._int())] if self.header[flag] == "hybrid" else \
                    [self.header[flag]]
                self.place += 8 * self.styles.count("bond/gran")

    def _find_chunks(self):
        """The first place from which as many chunks as processes lead to the end, with all particles."""
        for begin in range(self.place, len(self.bytes)):
            chunks, place = [], begin
            for _ in range(self.header[PROCESSES]):
                if place + 4 > len(self.bytes):
                    break
                end = place + 4 + 8 * struct.unpack_from("<i", self.bytes, place)[0]
                if not place < end <= len(self.bytes):
                    break
                chunks.append(self.bytes[place:end])
                place = end
            if len(chunks) == self.header[PROCESSES] and place == len(self.bytes):
                return chunks
        raise ValueError("no particles")


def whole(number):
    """A double as a whole number: its value, or its bits."""
    return int(number) if number >= 1 else struct.unpack("<q", struct.pack("<d", number))[0]


def image(number):
    """The three counts in 10 bits each, 12 of the last."""
    bits = whole(number)
    return [(bits & 1023) - 512, (bits >> 10 & 1023) - 512, (bits >> 20) - 512]


def bonds(record, begin):
    """(type, partner, history) of the block of bond/gran that begins there."""
    count = int(record[begin + 12])
    values = int(record[begin + 13 + 2 * count])
    history = begin + 14 + 2 * count
    return [(int(record[begin + 13 + 2 * k]), int(record[begin + 14 + 2 * k]),
             record[history + values * k:history + values * (k + 1)]) for k in range(count)]
