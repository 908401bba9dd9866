# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""What the language of protocol/device.json refuses; and that its checksum is the published one."""

import copy
import json
import pathlib
import tempfile
import unittest

from .device import DeviceSchema, crc16

DEFINITION = json.loads((pathlib.Path(__file__).resolve().parents[2] / "protocol/device.json").read_text())


class Refusals(unittest.TestCase):
    def read(self, definition):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "device.json"
            path.write_text(json.dumps(definition))
            return DeviceSchema(path)

    def refuses(self, change, words):
        definition = copy.deepcopy(DEFINITION)
        change(definition)
        with self.assertRaises(SystemExit) as refusal:
            self.read(definition)
        self.assertIn(words, str(refusal.exception))

    def test_the_definition_itself_is_taken(self):
        self.read(DEFINITION)

    def test_a_kind_twice_or_of_the_other_direction(self):
        self.refuses(lambda d: d["host_to_device"]["stop"].update(kind=1), "each once")
        self.refuses(lambda d: d["host_to_device"]["stop"].update(kind=200), "below 128")
        self.refuses(lambda d: d["host_to_device"]["stop"].update(kind=165), "sync")

    def test_fields_that_are_not_understood(self):
        fields = lambda d: d["host_to_device"]["leg_config"]["fields"]
        self.refuses(lambda d: fields(d)["leg"].update(type="u64"), "not known")
        self.refuses(lambda d: fields(d)["leg"].update(max=256), "its range")
        self.refuses(lambda d: fields(d)["leg"].update(colour=1), "must have")
        self.refuses(lambda d: fields(d)["leg"].update(count=0), "none of it")

    def test_bits_that_do_not_fill_a_word(self):
        self.refuses(lambda d: d["packed"]["leg_stop"]["bits"]["angle"].update(bits=13), "do not fill")
        self.refuses(lambda d: d["packed"]["leg_stop"]["bits"]["side"]["values"].pop(), "needs a name")

    def test_a_frame_that_is_too_long(self):
        self.refuses(lambda d: d.update(max_frame_bytes=20), "bytes long")

    def test_flags_that_nothing_uses(self):
        self.refuses(lambda d: d["flags"].update(other={"doc": "", "values": ["a"]}), "used by nothing")


class Checksum(unittest.TestCase):
    def test_is_the_published_one(self):
        self.assertEqual(crc16(b"123456789"), 0x6F91)  # the check value of CRC-16/MCRF4XX


if __name__ == "__main__":
    unittest.main()
