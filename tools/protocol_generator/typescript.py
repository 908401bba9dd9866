# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""TypeScript of the page: types and parsers (generated.ts), and the rules (generated_rules.ts) by which
web/src/protocol/validator.ts checks them."""

import json

from .schema import note, pascal

UNIONS = {"page_to_host": "PageMessage", "host_to_page": "HostMessage"}
# Fields that are for readers of the definition only.
UNCHECKED = ("doc", "unit")


def message_name(name):
    """With a suffix, because Event and Error are names of the platform."""
    return pascal(name) + "Message"


def item_type(schema, field):
    kind = field["type"]
    if kind in schema.enums or kind in schema.records:
        return pascal(kind)
    return {"number": "number", "integer": "number", "boolean": "boolean", "string": "string", "vec3": "Vec3"}[kind]


def field_type(schema, field):
    if field["type"] != "array":
        text = item_type(schema, field)
    elif "length" in field:
        text = f"readonly [{', '.join([item_type(schema, field['of'])] * field['length'])}]"
    else:
        text = f"readonly {item_type(schema, field['of'])}[]"
    return text + (" | null" if "optional" in field else "")


def interface(schema, name, definition, tag=None):
    extends = f" extends {pascal(definition['extends'])}" if "extends" in definition else ""
    lines = [f"/** {definition['doc']} */", f"export interface {name}{extends} {{"]
    if tag:
        lines.append(f'  readonly type: "{tag}";')
    for key, field in definition["fields"].items():
        if note(field):
            lines.append(f"  /** {note(field)} */")
        lines.append(f"  readonly {key}: {field_type(schema, field)};")
    return "\n".join(lines + ["}\n"])


def types(schema, origin):
    out = [origin,
           'import * as rules from "./generated_rules";',
           'import { parseBody, parseTagged, type Parsed } from "./validator";\n',
           f"export const PROTOCOL_VERSION = {schema.version};\n",
           "/** Three finite numbers: a position in mm or a direction, frame Patient (LPS). */",
           "export type Vec3 = readonly [number, number, number];\n"]
    for name, enum in schema.enums.items():
        values = " | ".join(f'"{value}"' for value in enum["values"])
        out.append(f"/** {enum['doc']} */\nexport type {pascal(name)} = {values};\n")
    out += [interface(schema, pascal(name), record) for name, record in schema.records.items()]
    for direction, group in schema.messages.items():
        out += [interface(schema, message_name(name), message, name) for name, message in group.items()]
        out.append(f"export type {UNIONS[direction]} =\n" + "\n".join(f"  | {message_name(name)}" for name in group) + ";\n")
    out += [interface(schema, pascal(name), body) for name, body in schema.bodies.items()]
    for direction in schema.messages:
        union = UNIONS[direction]
        out.append(f"/** Validates one text frame; never throws. */\nexport function parse{union}(text: string): Parsed<{union}> {{\n"
                   f"  return parseTagged(text, rules.{direction.upper()}, {schema.max_bytes[direction]}, rules.SCHEMA);\n}}\n")
    for name, body in schema.bodies.items():
        out.append(f"/** Validates the body of an HTTP answer; never throws. */\n"
                   f"export function parse{pascal(name)}(text: string): Parsed<{pascal(name)}> {{\n"
                   f"  return parseBody(text, rules.{name.upper()}, {body['max_bytes']}, rules.SCHEMA);\n}}\n")
    out.append("/** The text frame of a message. */\nexport function serialize(message: PageMessage | HostMessage): string {\n"
               "  return JSON.stringify(message);\n}\n")
    return "\n".join(out)


def checked(field):
    kept = {key: value for key, value in field.items() if key not in UNCHECKED}
    return kept | {"of": checked(field["of"])} if "of" in field else kept


def field_rules(schema, definition, indent):
    lines = [f"{indent}  {key}: {json.dumps(checked(field))}," for key, field in schema.fields(definition).items()]
    return "{\n" + "\n".join(lines) + f"\n{indent}}}" if lines else "{}"


def rules(schema, origin):
    named = [f"    {name}: {{ values: {json.dumps(enum['values'])} }}," for name, enum in schema.enums.items()]
    named += [f"    {name}: {{ fields: {field_rules(schema, record, '    ')} }}," for name, record in schema.records.items()]
    out = [origin, 'import type { Rules, Schema } from "./validator";\n',
           f"export const SCHEMA: Schema = {{\n  maxDepth: {schema.max_depth},\n  types: {{\n" + "\n".join(named) + "\n  },\n};\n"]
    for direction, group in schema.messages.items():
        table = "\n".join(f"  {name}: {field_rules(schema, message, '  ')}," for name, message in group.items())
        out.append(f"export const {direction.upper()}: Readonly<Record<string, Rules>> = {{\n{table}\n}};\n")
    for name, body in schema.bodies.items():
        out.append(f"export const {name.upper()}: Rules = {field_rules(schema, body, '')};\n")
    return "\n".join(out)
