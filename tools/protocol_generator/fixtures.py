# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""Fixtures that follow from the definition: of everything one text at its lowest, one at its highest, and,
where something is optional, one without it (protocol/fixtures/valid); and for every field the changes of the
highest that both sides must refuse (protocol/fixtures/refused_changes.json)."""

import json

# Lists of records are long; two show that there is more than one.
LISTED_RECORDS = 2


def value(schema, field, high, absent=False):
    kind = field["type"]
    if not high and "optional" in field:
        return None
    if kind == "array":
        count = field["length"] if "length" in field else field["max_items"] * high
        if high and schema.is_record(field["of"]):
            count = min(count, LISTED_RECORDS)
        return [value(schema, field["of"], high, absent)] * count
    if kind in schema.records:
        return fields(schema, schema.records[kind], high, absent)
    if kind in schema.enums:
        return schema.enums[kind]["values"][-1 if high else 0]
    if kind == "vec3":
        limit = field["limit"]
        return [limit, limit, 0.5] if high else [-limit, -limit, 0.5]
    return {"number": field.get("max" if high else "min"), "integer": field.get("max" if high else "min"),
            "boolean": high, "string": "é" * field.get("max_length", 0) if high else ""}[kind]


def fields(schema, definition, high, absent=False):
    return {key: value(schema, field, high, absent) for key, field in schema.fields(definition).items()
            if not (absent and "optional" in field)}


def everything(schema):
    """(folder, name, definition, what stands before the fields)."""
    for direction, group in schema.messages.items():
        for name, definition in group.items():
            yield direction, name, definition, {"type": name}
    for name, definition in schema.bodies.items():
        yield "http", name, definition, {}
    for name, definition in schema.stored.items():
        yield "stored", name, definition, {}


def whole(schema, definition, tag, high, absent=False):
    if "is" in definition:
        return value(schema, definition["is"], high, absent)
    return tag | fields(schema, definition, high, absent)


def text(root):
    return json.dumps(root, ensure_ascii=False)


def valid(schema):
    files = {}
    for folder, name, definition, tag in everything(schema):
        at = f"protocol/fixtures/valid/{folder}/{name}"
        low, high = (whole(schema, definition, tag, h) for h in (False, True))
        if low == high:
            files[f"{at}.json"] = text(low)
            continue
        files[f"{at}_lowest.json"], files[f"{at}_highest.json"] = text(low), text(high)
        absent = whole(schema, definition, tag, False, True)
        if absent != low:
            files[f"{at}_absent.json"] = text(absent)
    return files


def wrong_values(schema, field):
    """Values that no reader may take for this field."""
    kind = field["type"]
    if "optional" not in field:
        yield None
    if kind in ("number", "integer"):
        yield "1"
        yield True
        yield field["max"] + 1
        yield field["min"] - 1
        if kind == "integer" and field["min"] < field["max"]:
            yield field["min"] + 0.5
    elif kind == "boolean":
        yield from (0, "true")
    elif kind == "string":
        yield from (7, ["a"], "x" * (field["max_length"] + 1), "\x01")
    elif kind == "vec3":
        limit = field["limit"]
        yield from (7, [0, 0], [0, 0, 0, 0], [0, "0", 1], [limit + 1, 0, 0], [0, 0, None])
        if "min_length" in field:
            yield [0, 0, 0]
    elif kind == "array":
        item = value(schema, field["of"], False)
        yield from ({}, "list", [None])
        for count in (field["length"] - 1, field["length"] + 1) if "length" in field else (field["max_items"] + 1,):
            if count <= 100:
                yield [item] * count
    elif kind in schema.enums:
        yield from (0, "no such value", schema.enums[kind]["values"][0].upper())
    else:
        yield from (7, "{}", [])


def changes(schema, definition, path, seen):
    """[path, value] sets, [path] removes."""
    yield [[*path, "no_such_field"], 1]
    for key, field in schema.fields(definition).items():
        at = [*path, key]
        if "optional" not in field:
            yield [at]
        for wrong in wrong_values(schema, field):
            yield [at, wrong]
        yield from changes_within(schema, field, at, seen)


def changes_within(schema, field, at, seen):
    if field["type"] == "array":
        of = field["of"]
        at = [*at, min(field.get("length", field.get("max_items")), LISTED_RECORDS) - 1]
        if not schema.is_record(of):
            for wrong in wrong_values(schema, of):
                yield [at, wrong]
        field = of
    # A type is the same wherever it stands.
    if schema.is_record(field) and field["type"] not in seen:
        seen.add(field["type"])
        yield from changes(schema, schema.records[field["type"]], at, seen)


def refused_changes(schema):
    seen, blocks = set(), []
    for folder, name, definition, tag in everything(schema):
        if "is" in definition:
            found = list(changes_within(schema, definition["is"], [], set()))
        else:
            found = list(changes(schema, definition, [], seen))
        end = "" if whole(schema, definition, tag, False) == whole(schema, definition, tag, True) else "_highest"
        lines = ",\n".join("    " + json.dumps(change, ensure_ascii=False) for change in found)
        blocks.append(f'  "{folder}/{name}{end}.json": [\n{lines}\n  ]')
    return {"protocol/fixtures/refused_changes.json": "{\n" + ",\n".join(blocks) + "\n}\n"}
