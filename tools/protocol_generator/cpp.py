# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""C++ of src/protocol: types (enumerations and records), messages, bodies (of HTTP and of the records),
each with parse and serialize over src/protocol/detail/fields.hpp."""

from .schema import note, pascal

UNIONS = {"page_to_host": "PageMessage", "host_to_page": "HostMessage"}
KEYWORDS = {"case", "class", "default", "delete", "do", "double", "else", "enum", "export", "float", "for", "if",
            "int", "long", "new", "operator", "private", "public", "register", "return", "short", "signed", "static",
            "struct", "switch", "template", "this", "union", "unsigned", "using", "virtual", "void", "while"}
INCLUDES = ["#include <array>", "#include <cstddef>", "#include <cstdint>", "#include <optional>", "#include <string>",
            "#include <string_view>", "#include <variant>", "#include <vector>"]


def member(key):
    return key + "_" if key in KEYWORDS else key


def number(value):
    return repr(float(value))


def item_type(schema, field):
    kind = field["type"]
    if kind in schema.enums or kind in schema.records:
        return pascal(kind)
    return {"number": "double", "integer": "std::int64_t", "boolean": "bool", "string": "std::string", "vec3": "Vec3"}[kind]


def is_fixed(field):
    return field["type"] == "array" and "length" in field and field["of"]["type"] == "number"


def field_type(schema, field):
    if is_fixed(field):
        text = f"std::array<double, {field['length']}>"
    elif field["type"] == "array":
        text = f"std::vector<{item_type(schema, field['of'])}>"
    else:
        text = item_type(schema, field)
    return f"std::optional<{text}>" if "optional" in field else text


def default(schema, field):
    kind = field["type"]
    if "optional" in field:
        return ""
    if kind in schema.enums:
        return f" = {pascal(kind)}::{pascal(schema.enums[kind]['values'][0])}"
    if is_fixed(field):
        return "{}"
    return {"number": " = 0.0", "integer": " = 0", "boolean": " = false"}.get(kind, "")


def enum(name, definition):
    cpp, values = pascal(name), definition["values"]
    quoted = ", ".join(f'"{value}"' for value in values)
    return (f"/// {definition['doc']}\nenum class {cpp} : std::uint8_t {{ {', '.join(map(pascal, values))} }};\n"
            f"inline constexpr std::array<std::string_view, {len(values)}> k{cpp}Names{{{quoted}}};\n"
            f"[[nodiscard]] constexpr std::string_view name_of({cpp} value) noexcept {{\n"
            f"  return k{cpp}Names[static_cast<std::size_t>(value)];\n}}\n")


def struct(schema, name, definition):
    base = f" : {pascal(definition['extends'])}" if "extends" in definition else ""
    lines = [f"/// {definition['doc']}", f"struct {pascal(name)}{base} {{"]
    for key, field in definition["fields"].items():
        if note(field):
            lines.append(f"  /// {note(field)}")
        lines.append(f"  {field_type(schema, field)} {member(key)}{default(schema, field)};")
    return "\n".join(lines + [f"  bool operator==(const {pascal(name)}&) const = default;", "};\n"])


def read_value(schema, key, field):
    """The expression that reads one value from the FieldReader `in`."""
    kind, quoted = field["type"], f'"{key}"'
    if kind in schema.enums:
        return f"static_cast<{pascal(kind)}>(in.choice({quoted}, k{pascal(kind)}Names))"
    return {"number": lambda: f"in.number({quoted}, {number(field['min'])}, {number(field['max'])})",
            "integer": lambda: f"in.integer({quoted}, {field['min']}, {field['max']})",
            "boolean": lambda: f"in.boolean({quoted})",
            "string": lambda: f"in.string({quoted}, {field['max_length']})",
            "vec3": lambda: f"in.vec3({quoted}, {number(field['limit'])}, {number(field.get('min_length', 0))})"}[kind]()


def list_limits(of):
    return {"number": lambda: f"{number(of['min'])}, {number(of['max'])}",
            "integer": lambda: f"{of['min']}, {of['max']}",
            "string": lambda: f"{of['max_length']}",
            "vec3": lambda: f"{number(of['limit'])}, {number(of.get('min_length', 0))}"}[of["type"]]()


def read_into(schema, key, field, target):
    """The statement that reads one field into `target`."""
    kind = field["type"]
    if kind in schema.records:
        return f'in.record("{key}", {target});'
    if is_fixed(field):
        return f'in.fill("{key}", {list_limits(field["of"])}, {target});'
    if kind == "array":
        size = f"{field.get('length', 0)}, {field.get('length', field.get('max_items'))}"
        if field["of"]["type"] in schema.records:
            return f'in.records("{key}", {size}, {target});'
        return f'in.list("{key}", {size}, {list_limits(field["of"])}, {target});'
    return f"{target} = {read_value(schema, key, field)};"


def read_field(schema, key, field):
    target = f"out.{member(key)}"
    if "optional" not in field:
        return "  " + read_into(schema, key, field, target)
    if field["type"] in schema.records or field["type"] == "array":
        target += ".emplace()"
    return f'  if (in.has("{key}")) {read_into(schema, key, field, target)}'


def write_value(schema, key, field, value):
    kind = field["type"]
    if kind in schema.enums:
        return f'out.name("{key}", name_of({value}));'
    if kind in schema.records:
        return f'out.record("{key}", {value});'
    if kind == "array" and field["of"]["type"] in schema.records:
        return f'out.records("{key}", {value});'
    if kind == "array":
        return f'out.list("{key}", {value}' + (f", {field['of']['max_length']});" if field["of"]["type"] == "string" else ");")
    if kind == "string":
        return f'out.text("{key}", {value}, {field["max_length"]});'
    return f'out.{"vec3" if kind == "vec3" else "value"}("{key}", {value});'


def write_field(schema, key, field):
    value = f"in.{member(key)}"
    if "optional" not in field:
        return "  " + write_value(schema, key, field, value)
    return (f"  if ({value}) {{\n    {write_value(schema, key, field, '*' + value)}\n  }} else {{\n"
            f'    out.null("{key}");\n  }}')


def codec(schema, name, definition, tag=None):
    cpp, fields, base = pascal(name), definition["fields"], definition.get("extends")
    reads, writes = bool(fields or base), bool(fields or base or tag)
    lines = [f"void read(FieldReader&{' in' if reads else ' /*in*/'}, {cpp}&{' out' if reads else ' /*out*/'}) {{"]
    if base:
        lines.append(f"  read(in, static_cast<{pascal(base)}&>(out));")
    lines += [read_field(schema, key, field) for key, field in fields.items()]
    lines += ["}\n", f"void write(FieldWriter&{' out' if writes else ' /*out*/'}, const {cpp}&{' in' if reads else ' /*in*/'}) {{"]
    if tag:
        lines.append(f'  out.name("type", "{tag}");')
    if base:
        lines.append(f"  write(out, static_cast<const {pascal(base)}&>(in));")
    lines += [write_field(schema, key, field) for key, field in fields.items()]
    return "\n".join(lines + ["}\n"])


def opening(origin, about):
    return origin + "//\n" + "\n".join(f"// {line}".rstrip() for line in about)


def types_header(schema, origin):
    out = [opening(origin, ["What messages are made of (protocol/README.md): enumerations and records, as plain values."]),
           "#pragma once\n", *INCLUDES, '\n#include "geometry/vec3.hpp"\n', "namespace carpus::protocol {\n",
           f"inline constexpr std::int64_t kProtocolVersion = {schema.version};",
           f"/// Deepest nesting of arrays and objects in a message.\ninline constexpr int kMaxDepth = {schema.max_depth};\n"]
    out += [enum(name, definition) for name, definition in schema.enums.items()]
    out += [struct(schema, name, record) for name, record in schema.records.items()]
    return "\n".join(out + ["}  // namespace carpus::protocol\n"])


def codecs_header(schema, origin):
    out = [opening(origin, ["Reading and writing of records, for those that hold them."]), "#pragma once\n",
           '#include "protocol/detail/fields.hpp"', '#include "protocol/types.hpp"\n', "namespace carpus::protocol {\n"]
    for name in schema.records:
        out.append(f"void read(FieldReader& in, {pascal(name)}& out);\nvoid write(FieldWriter& out, const {pascal(name)}& in);\n")
    return "\n".join(out + ["}  // namespace carpus::protocol\n"])


def types_source(schema, origin):
    out = [origin, '#include "protocol/types.hpp"\n', '#include "protocol/detail/fields.hpp"',
           '#include "protocol/detail/type_codecs.hpp"\n', "namespace carpus::protocol {\n"]
    out += [codec(schema, name, record) for name, record in schema.records.items()]
    return "\n".join(out + ["}  // namespace carpus::protocol\n"])


def union_snake(union):
    return union.replace("Message", "_message").lower()


def messages_header(schema, origin):
    out = [opening(origin, ["Every message of the WebSocket (protocol/README.md) as a plain value, and its codec: what arrives is",
                            "checked for type, range, length and unknown fields before anything else sees it."]),
           "#pragma once\n", *INCLUDES, '\n#include "core/result.hpp"\n#include "geometry/vec3.hpp"\n#include "protocol/types.hpp"\n',
           "namespace carpus::protocol {\n",
           f"/// Largest text frame from the page [bytes].\ninline constexpr std::size_t kMaxTextBytes = {schema.max_bytes['page_to_host']};\n"]
    for direction, group in schema.messages.items():
        out += [struct(schema, name, message) for name, message in group.items()]
        out.append(f"using {UNIONS[direction]} = std::variant<{', '.join(pascal(name) for name in group)}>;\n")
    for union in UNIONS.values():
        out.append(f"/// Reads one text frame; the refusal says what is wrong with which field.\n"
                   f"[[nodiscard]] Result<{union}> parse_{union_snake(union)}(std::string_view text);\n"
                   f"/// The text frame of a message. @pre its numbers lie in their ranges; texts are made to fit.\n"
                   f"[[nodiscard]] std::string serialize(const {union}& message);\n")
    return "\n".join(out + ["}  // namespace carpus::protocol\n"])


def messages_source(schema, origin):
    out = [origin, '#include "protocol/messages.hpp"\n', "#include <array>\n", '#include "protocol/detail/fields.hpp"',
           '#include "protocol/detail/type_codecs.hpp"\n', "namespace carpus::protocol {\n\nnamespace {\n"]
    for group in schema.messages.values():
        out += [codec(schema, name, message, name) for name, message in group.items()]
    out.append(READ_AS)
    for direction, group in schema.messages.items():
        union = UNIONS[direction]
        rows = ", ".join(f'{{"{name}", &read_as<{union}, {pascal(name)}>}}' for name in group)
        out.append(f"constexpr std::array<MessageKind<{union}>, {len(group)}> k{union}Kinds{{{{{rows}}}}};\n")
    out.append("}  // namespace\n")
    for direction, union in UNIONS.items():
        out.append(f"Result<{union}> parse_{union_snake(union)}(std::string_view text) {{\n"
                   f"  return parse_tagged<{union}>(text, {schema.max_bytes[direction]}, k{union}Kinds);\n}}\n")
        out.append(f"std::string serialize(const {union}& message) {{\n  JsonWriter json;\n  FieldWriter out = json.root();\n"
                   "  std::visit([&](const auto& m) { write(out, m); }, message);\n  return json.dump(-1);\n}\n")
    return "\n".join(out + ["}  // namespace carpus::protocol\n"])


def stored_type(schema, definition):
    return field_type(schema, definition["is"])


def bodies_header(schema, origin):
    out = [opening(origin, ["Bodies of HTTP answers and texts of the records (protocol/README.md) as plain values, and their codecs."]),
           "#pragma once\n", *INCLUDES, '\n#include "core/result.hpp"\n#include "geometry/vec3.hpp"\n#include "protocol/types.hpp"\n',
           "namespace carpus::protocol {\n"]
    for name, body in schema.bodies.items():
        for key, field in body["fields"].items():
            if "max_items" in field:
                out.append(f"/// Most `{key}` of one {pascal(name)}.\ninline constexpr std::size_t kMax{pascal(name)}{pascal(key)} = {field['max_items']};")
        out.append(struct(schema, name, body))
        out.append(f"[[nodiscard]] Result<{pascal(name)}> parse_{name}(std::string_view text);\n"
                   f"/// @param indent  spaces a level; negative writes one line.\n"
                   f"[[nodiscard]] std::string serialize(const {pascal(name)}& body, int indent = -1);\n")
    for name, stored in schema.stored.items():
        kind, item = stored_type(schema, stored), stored["is"]
        if "max_items" in item:
            out.append(f"inline constexpr std::size_t kMax{pascal(name)} = {item['max_items']};")
        out.append(f"/// {stored['doc']}\n[[nodiscard]] Result<{kind}> parse_{name}(std::string_view text);\n"
                   f"[[nodiscard]] std::string serialize_{name}(const {kind}& value, int indent = -1);\n")
    return "\n".join(out + ["}  // namespace carpus::protocol\n"])


def bodies_source(schema, origin):
    out = [origin, '#include "protocol/bodies.hpp"\n', '#include "protocol/detail/fields.hpp"',
           '#include "protocol/detail/type_codecs.hpp"\n', "namespace carpus::protocol {\n\nnamespace {\n"]
    out += [codec(schema, name, body) for name, body in schema.bodies.items()]
    out.append("}  // namespace\n")
    for name, body in schema.bodies.items():
        out.append(parse_object(pascal(name), name, body["max_bytes"]))
        out.append(f"std::string serialize(const {pascal(name)}& body, int indent) {{\n{WRITE_OBJECT.format('body')}}}\n")
    for name, stored in schema.stored.items():
        kind, is_list = stored_type(schema, stored), stored["is"]["type"] == "array"
        if is_list:
            out.append(f"Result<{kind}> parse_{name}(std::string_view text) {{\n  JsonText json(text, {stored['max_bytes']});\n"
                       f'  json.wrap("{name}");\n  FieldReader in(json);\n  {kind} out;\n'
                       f"  {read_into(schema, name, stored['is'], 'out')}\n"
                       "  if (json.failure()) return Refusal{*json.failure()};\n  return out;\n}\n")
            write = (f"  JsonWriter json;\n  FieldWriter out = json.root();\n  {write_value(schema, name, stored['is'], 'value')}\n"
                     f'  return json.dump_field("{name}", indent);\n')
        else:
            out.append(parse_object(kind, name, stored["max_bytes"]))
            write = WRITE_OBJECT.format("value")
        out.append(f"std::string serialize_{name}(const {kind}& value, int indent) {{\n{write}}}\n")
    return "\n".join(out + ["}  // namespace carpus::protocol\n"])


def parse_object(kind, name, max_bytes):
    return (f"Result<{kind}> parse_{name}(std::string_view text) {{\n  JsonText json(text, {max_bytes});\n  FieldReader in(json);\n"
            f"  {kind} out;\n  read(in, out);\n  in.finish();\n"
            "  if (json.failure()) return Refusal{*json.failure()};\n  return out;\n}\n")


WRITE_OBJECT = "  JsonWriter json;\n  FieldWriter out = json.root();\n  write(out, {});\n  return json.dump(indent);\n"

READ_AS = """template <typename Union, typename Message>
Union read_as(FieldReader& in) {
  Message message;
  read(in, message);
  return message;
}

template <typename Union>
struct MessageKind {
  std::string_view type;
  Union (*read)(FieldReader&);
};

template <typename Union, std::size_t Count>
Result<Union> parse_tagged(std::string_view text,
                           std::size_t max_bytes,
                           const std::array<MessageKind<Union>, Count>& kinds) {
  JsonText json(text, max_bytes);
  FieldReader in(json);
  const std::string type = in.type();
  for (const MessageKind<Union>& kind : kinds) {
    if (!in.ok() || kind.type != type) continue;
    Union message = kind.read(in);
    in.finish();
    if (json.failure()) return Refusal{type + ": " + *json.failure()};
    return message;
  }
  if (json.failure()) return Refusal{*json.failure()};
  return Refusal{"unknown message type '" + type + "'"};
}
"""
