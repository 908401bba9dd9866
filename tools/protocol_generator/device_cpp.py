# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""The codec of the device's frames: one header for firmware and host, C++14, no library but two C headers."""

from .device import SIZES, OVERHEAD
from .schema import note, pascal

CTYPES = {"u8": "uint8_t", "u16": "uint16_t", "u32": "uint32_t", "i16": "int16_t", "i32": "int32_t"}


def ctype(field):
    return CTYPES.get(field["type"], pascal(field["type"]))


def enumeration(name, values, doc):
    listed = ", ".join(f"{pascal(value)} = {i}" for i, value in enumerate(values))
    return f"/// {doc}\nenum class {name} : uint8_t {{ {listed} }};\n"


def packed(name, definition):
    cpp = pascal(name)
    out, members, reads, writes, visits, shift = [], [], [], [], [], 0
    for key, part in definition["bits"].items():
        bits, mask = part["bits"], (1 << part["bits"]) - 1
        if note(part):
            members.append(f"  /// {note(part)}")
        if "values" in part:
            enum = cpp + pascal(key)
            out.append(enumeration(enum, part["values"], part["doc"]))
            members.append(f"  {enum} {key} = {enum}::{pascal(part['values'][0])};")
            reads.append(f"  out.{key} = static_cast<{enum}>((word{f' >> {shift}' if shift else ''}) & {mask:#x}U);")
            bits_of = f"static_cast<uint16_t>(value.{key})"
        else:
            members.append(f"  int16_t {key} = 0;")
            sign = 1 << (bits - 1)
            reads.append(f"  const uint16_t {key} = static_cast<uint16_t>((word{f' >> {shift}' if shift else ''}) & {mask:#x}U);")
            reads.append(f"  out.{key} = static_cast<int16_t>(static_cast<int16_t>({key} ^ {sign:#x}U) - {sign:#x});"
                         if part.get("signed") else f"  out.{key} = static_cast<int16_t>({key});")
            bits_of = f"static_cast<uint16_t>(value.{key})"
        writes.append(f"(({bits_of} & {mask:#x}U){f' << {shift}' if shift else ''})")
        visits.append(f'  v("{key}", value.{key});')
        shift += bits
    out.append(f"/// {definition['doc']}\nstruct {cpp} {{\n" + "\n".join(members) + "\n};\n")
    out.append(f"inline void read(const uint8_t* from, {cpp}& out) {{\n  uint16_t word = 0;\n  read(from, word);\n"
               + "\n".join(reads) + "\n}\n")
    out.append(f"inline void write({cpp} value, uint8_t* to) {{\n  write(static_cast<uint16_t>(" + " | ".join(writes) + "), to);\n}\n")
    out.append(f"template <typename Value, typename Visitor>\nvoid visit_parts_{name}(Value& value, Visitor&& v) {{\n" + "\n".join(visits) + "\n}\n")
    return "\n".join(out)


def flags(name, definition):
    lines = [f"/// {definition['doc']}"]
    lines += [f"constexpr uint8_t k{pascal(name)}{pascal(value)} = {1 << i};" for i, value in enumerate(definition["values"])]
    return "\n".join(lines) + "\n"


def checks(schema, key, field):
    if field["type"] not in SIZES:
        return []
    (low, high), (least, most) = schema.range_of(field), schema.natural_range(field["type"])
    value = f"out.{key}[i]" if "count" in field else f"out.{key}"
    conditions = [f"{value} < {low}"] * (low > least) + [f"{value} > {high}"] * (high < most)
    return [f"if ({' || '.join(conditions)}) return false;"] if conditions else []


def frame(schema, name, definition):
    cpp, members, reads, writes, visits, at = pascal(name), [], [], [], [], 0
    for key, field in definition["fields"].items():
        if note(field):
            members.append(f"  /// {note(field)}")
        count, size = field.get("count"), schema.size_of(field) // field.get("count", 1)
        tests = checks(schema, key, field)
        if count:
            members.append(f"  {ctype(field)} {key}[{count}] = {{}};")
            reads += [f"  for (uint8_t i = 0; i < {count}; ++i) {{",
                      f"    read(payload + {at} + {size} * i, out.{key}[i]);", *(f"    {t}" for t in tests), "  }"]
            writes.append(f"  for (uint8_t i = 0; i < {count}; ++i) write(frame.{key}[i], payload + {at} + {size} * i);")
            visits.append(f'  v("{key}", frame.{key}, {count});')
        else:
            members.append(f"  {ctype(field)} {key} = 0;")
            reads += [f"  read(payload + {at}, out.{key});", *(f"  {t}" for t in tests)]
            writes.append(f"  write(frame.{key}, payload + {at});")
            visits.append(f'  v("{key}", frame.{key});')
        at += schema.size_of(field)
    unused = "" if reads else "*/"
    opened = "" if reads else "/*"
    out = [f"/// {definition['doc']}", f"struct {cpp} {{", *members, "};",
           f"constexpr uint8_t kind_of(const {cpp}&) {{ return {definition['kind']}; }}",
           f"constexpr uint8_t kPayloadBytesOf{cpp} = {at};",
           f"/// False where a field is out of its range.",
           f"inline bool read_payload(const uint8_t* {opened}payload{unused}, {cpp}& {opened}out{unused}) {{", *reads, "  return true;", "}",
           f"inline void write_payload(const {cpp}& {opened}frame{unused}, uint8_t* {opened}payload{unused}) {{", *writes, "}",
           f"constexpr uint8_t payload_bytes_of(const {cpp}&) {{ return {at}; }}",
           f"template <typename Frame, typename Visitor>",
           f"void visit_fields_{name}(Frame& {opened}frame{unused}, Visitor&& {opened}v{unused}) {{", *visits, "}", ""]
    return "\n".join(out)


def header(schema, origin):
    out = [origin.replace("protocol/protocol.json", "protocol/device.json") + "//\n"
           "// The frames between host and arm (protocol/README.md): plain values, and how each stands on the wire.\n"
           "// C++14 and two headers of C, for firmware and host alike. Little-endian.\n",
           "#pragma once\n", "#include <stddef.h>\n#include <stdint.h>\n", "namespace carpus {\nnamespace firmware {\n",
           f"constexpr uint8_t kProtocolVersion = {schema.version};\nconstexpr uint8_t kSync = {schema.sync};",
           f"constexpr uint8_t kFrameOverhead = {OVERHEAD};\n/// Of the longest frame.\nconstexpr uint8_t kMaxFrameBytes = "
           f"{max(map(schema.frame_bytes, schema.frames.values()))};",
           f"constexpr uint8_t kMaxDeviceFrameBytes = {max(map(schema.frame_bytes, schema.directions['device_to_host'].values()))};",
           f"/// Of a serial line [1/s].\nconstexpr uint32_t kBaud = {schema.baud};",
           f"/// A device that hears nothing new for so long takes its force away [ms].\nconstexpr uint8_t kSilenceMs = {schema.silence_ms};\n"]
    for size in (1, 2, 4):
        for kind in ("u", "i"):
            name = f"{kind}{8 * size}"
            if name not in CTYPES:
                continue
            c, u = CTYPES[name], CTYPES[f"u{8 * size}"]
            word = " | ".join(f"static_cast<{u}>(static_cast<{u}>(from[{i}]){f' << {8 * i}' if i else ''})" for i in range(size))
            read = "from[0]" if size == 1 else f"static_cast<{c}>({word})"
            lines = [f"to[{i}] = static_cast<uint8_t>(static_cast<{u}>(value) >> {8 * i});" if i else
                     "to[0] = static_cast<uint8_t>(value);" for i in range(size)]
            out.append(f"inline void read(const uint8_t* from, {c}& out) {{ out = {read}; }}")
            out.append(f"inline void write({c} value, uint8_t* to) {{ {' '.join(lines)} }}\n")
    out += [packed(name, d) for name, d in schema.packed.items()]
    out += [flags(name, d) for name, d in schema.flags.items()]
    for name, d in schema.frames.items():
        for key, field in d["fields"].items():
            if "values" in field:
                out.append(enumeration(pascal(key), field["values"], field["doc"]))
    out += [frame(schema, name, d) for name, d in schema.frames.items()]
    for direction in schema.directions:
        cases = "\n".join(f"    case {d['kind']}: return {schema.payload_bytes(d)};" for d in schema.directions[direction].values())
        out.append(f"/// Length of the payload of a kind that goes this way; 255: there is no such kind.\n"
                   f"inline uint8_t {direction}_payload_bytes(uint8_t kind) {{\n  switch (kind) {{\n{cases}\n    default: return 255;\n  }}\n}}\n")
    old = " || ".join(f"kind == {d['kind']}" for d in schema.frames.values() if d.get("any_version"))
    out.append(f"/// What the checksum begins with: frames by which versions are compared are the same in all of them.\n"
               f"inline uint8_t version_in_checksum(uint8_t kind) {{\n  return {old} ? uint8_t{{0}} : kProtocolVersion;\n}}\n")
    calls = "\n".join(f"  v(\"{name}\", {pascal(name)}{{}});" for name in schema.frames)
    out.append(f"/// Shows every frame, by name and as it is made.\ntemplate <typename Visitor>\nvoid visit_frames(Visitor&& v) {{\n{calls}\n}}\n")
    for name in schema.frames:
        out.append(f"template <typename Visitor>\nvoid visit_fields({pascal(name)}& frame, Visitor&& v) {{ visit_fields_{name}(frame, v); }}\n")
    for name in schema.packed:
        out.append(f"template <typename Visitor>\nvoid visit_parts({pascal(name)}& value, Visitor&& v) {{ visit_parts_{name}(value, v); }}\n")
    return "\n".join(out + ["}  // namespace firmware\n}  // namespace carpus\n"])
