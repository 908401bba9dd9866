# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""Reads protocol/device.json, refuses what the generators would not understand, and is itself a codec of
its frames, written without the generated one: the fixtures come from here."""

import json
import sys

from .schema import pascal, without_repeats

SIZES = {"u8": 1, "u16": 2, "u32": 4, "i16": 2, "i32": 4}
OVERHEAD = 5  # sync, kind, sequence, two of the checksum


def fail(where, what):
    sys.exit(f"device.json: {where}: {what}")


def crc16(data):
    """CRC-16 of CCITT's polynomial in the order of a serial line (MCRF4XX), bit by bit."""
    crc = 0xFFFF
    for byte in data:
        for i in range(8):
            bit = (byte >> i ^ crc) & 1
            crc = crc >> 1 ^ (0x8408 if bit else 0)
    return crc


class DeviceSchema:
    def __init__(self, path):
        root = json.loads(path.read_text(), object_pairs_hook=without_repeats)
        self.only(root, "top", {"version", "sync", "max_frame_bytes", "baud", "silence_ms", "packed", "flags",
                                "host_to_device", "device_to_host"})
        self.version, self.sync, self.max_frame_bytes = root["version"], root["sync"], root["max_frame_bytes"]
        self.baud, self.silence_ms = root["baud"], root["silence_ms"]
        self.packed, self.flags = root["packed"], root["flags"]
        self.directions = {name: root[name] for name in ("host_to_device", "device_to_host")}
        self.frames = self.directions["host_to_device"] | self.directions["device_to_host"]
        self.check()

    @staticmethod
    def only(definition, where, allowed, required=None):
        if set(definition) - allowed or (allowed if required is None else required) - set(definition):
            fail(where, f"has {sorted(definition)}, must have of {sorted(allowed)}")

    def check(self):
        if len(self.frames) != sum(map(len, self.directions.values())):
            fail("frames", "a name stands in both directions")
        kinds = [frame["kind"] for frame in self.frames.values()]
        if len(set(kinds)) != len(kinds) or not all(0 < kind < 256 and kind != self.sync for kind in kinds):
            fail("frames", "kinds are bytes, each once, and none is the sync byte")
        for name, packed in self.packed.items():
            self.only(packed, name, {"doc", "bits"})
            for key, part in packed["bits"].items():
                self.only(part, f"{name}.{key}", {"bits", "signed", "unit", "values", "doc"}, {"bits"})
                if "values" in part and len(part["values"]) != 1 << part["bits"]:
                    fail(f"{name}.{key}", "every pattern of its bits needs a name")
            if sum(part["bits"] for part in packed["bits"].values()) != 16:
                fail(name, "its bits do not fill 16")
        for name, flags in self.flags.items():
            self.only(flags, name, {"doc", "values"})
            if not 0 < len(set(flags["values"])) == len(flags["values"]) <= 8:
                fail(name, "one to eight names, each once")
        for direction, group in self.directions.items():
            for name, frame in group.items():
                self.only(frame, name, {"kind", "doc", "fields", "any_version"}, {"kind", "doc", "fields"})
                if (frame["kind"] >= 128) != (direction == "device_to_host"):
                    fail(name, "the host's kinds are below 128, the device's are not")
                for key, field in frame["fields"].items():
                    self.check_field(f"{name}.{key}", field)
                if self.frame_bytes(frame) > self.max_frame_bytes:
                    fail(name, f"is {self.frame_bytes(frame)} bytes long; allowed are {self.max_frame_bytes}")
        used = [f["type"] for frame in self.frames.values() for f in frame["fields"].values()]
        used += [f.get("flags") for frame in self.frames.values() for f in frame["fields"].values()]
        for name in [*self.packed, *self.flags]:
            if name not in used:
                fail(name, "is used by nothing")

    def check_field(self, where, field):
        self.only(field, where, {"type", "doc", "unit", "count", "min", "max", "flags", "values"}, {"type"})
        if field["type"] not in SIZES and field["type"] not in self.packed:
            fail(where, f"type {field['type']} is not known")
        if field["type"] in self.packed and set(field) & {"min", "max", "flags", "values"}:
            fail(where, "a packed field says no more")
        if field["type"] in SIZES:
            low, high = self.range_of(field)
            least, most = self.natural_range(field["type"])
            if not least <= low <= high <= most:
                fail(where, "its range is not one of its type")
            if "values" in field and high != len(field["values"]) - 1:
                fail(where, "max must be its last value")
        if field.get("flags", next(iter(self.flags), None)) not in self.flags:
            fail(where, "flags are not known")
        if field.get("count", 1) < 1:
            fail(where, "none of it")

    @staticmethod
    def natural_range(kind):
        bits = 8 * SIZES[kind]
        return (0, 2 ** bits - 1) if kind[0] == "u" else (-2 ** (bits - 1), 2 ** (bits - 1) - 1)

    def range_of(self, field):
        least, most = self.natural_range(field["type"])
        return field.get("min", least), field.get("max", most)

    def size_of(self, field):
        return SIZES.get(field["type"], 2) * field.get("count", 1)

    def payload_bytes(self, frame):
        return sum(map(self.size_of, frame["fields"].values()))

    def frame_bytes(self, frame):
        return OVERHEAD + self.payload_bytes(frame)

    # The codec of the fixtures.

    def encode(self, name, sequence, values):
        frame, payload = self.frames[name], b""
        for key, field in frame["fields"].items():
            for value in values[key] if "count" in field else [values[key]]:
                payload += self.encode_one(field, value)
        return self.enclose(frame, sequence, payload)

    def enclose(self, frame, sequence, payload, version=None):
        content = bytes([frame["kind"], sequence]) + payload
        version = self.version if version is None else version
        crc = crc16(bytes([0 if frame.get("any_version") else version]) + content)
        return bytes([self.sync]) + content + crc.to_bytes(2, "little")

    def encode_one(self, field, value):
        kind = field["type"]
        if kind in SIZES:
            return value.to_bytes(SIZES[kind], "little", signed=kind[0] == "i")
        word, shift = 0, 0
        for key, part in self.packed[kind]["bits"].items():
            word |= (value[key] & ((1 << part["bits"]) - 1)) << shift
            shift += part["bits"]
        return word.to_bytes(2, "little")

    def extreme(self, field, highest):
        """The lowest or the highest value of a field."""
        if field["type"] in SIZES:
            one = self.range_of(field)[highest]
        else:
            one = {}
            for key, part in self.packed[field["type"]]["bits"].items():
                bits = part["bits"] - (1 if part.get("signed") else 0)
                one[key] = 2 ** bits - 1 if highest else (-2 ** bits if part.get("signed") else 0)
        return [one] * field["count"] if "count" in field else one


def fixtures(schema):
    """Text of the fixtures: what a decoder must read, and what it must refuse, with the reason."""
    valid, invalid = [], []
    for name, frame in schema.frames.items():
        for label, highest, sequence in (("lowest", 0, 0), ("highest", 1, 255)):
            values = {key: schema.extreme(field, highest) for key, field in frame["fields"].items()}
            valid.append({"name": f"{name}_{label}", "frame": name, "sequence": sequence, "fields": values,
                          "hex": schema.encode(name, sequence, values).hex()})
        values = {key: schema.extreme(field, 0) for key, field in frame["fields"].items()}
        good = schema.encode(name, 7, values)
        invalid.append({"name": f"{name}_cut", "why": "incomplete", "hex": good[:-1].hex()})
        for place, what in ((1, "kind"), (2, "sequence"), (len(good) - 1, "checksum"), (len(good) // 2, "middle")):
            bad = bytearray(good)
            bad[place] ^= 0x40
            invalid.append({"name": f"{name}_{what}_changed", "why": "checksum_or_kind", "hex": bytes(bad).hex()})
        payload = good[3:-2]
        other = schema.enclose(frame, 7, payload, schema.version + 1)
        if frame.get("any_version"):
            assert other == good
        else:
            invalid.append({"name": f"{name}_other_version", "why": "checksum_or_kind", "hex": other.hex()})
        for key, field in frame["fields"].items():
            if field["type"] not in SIZES:
                continue
            (low, high), (least, most) = schema.range_of(field), schema.natural_range(field["type"])
            for label, value in (("below", low - 1), ("above", high + 1)):
                if least <= value <= most:
                    wrong = values | {key: [value] + values[key][1:] if "count" in field else value}
                    invalid.append({"name": f"{name}_{key}_{label}", "why": "range",
                                    "hex": schema.encode(name, 7, wrong).hex()})
    unknown = next(kind for kind in range(1, 128) if kind not in {f["kind"] for f in schema.frames.values()})
    invalid.append({"name": "unknown_kind", "why": "checksum_or_kind", "hex": schema.enclose({"kind": unknown}, 7, b"").hex()})
    text = "[\n" + ",\n".join("  " + json.dumps(entry) for entry in valid) + "\n]\n"
    refused = "[\n" + ",\n".join("  " + json.dumps(entry) for entry in invalid) + "\n]\n"
    return {"protocol/device_fixtures/valid.json": text, "protocol/device_fixtures/invalid.json": refused}


