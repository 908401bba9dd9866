# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""Reads protocol/protocol.json and refuses what the generators would not understand: protocol/README.md
describes the language."""

import json
import sys

LIMITS = {"number": {"min", "max"}, "integer": {"min", "max"}, "boolean": set(), "string": {"max_length"},
          "vec3": {"limit"}}
EXTRA = {"number": {"unit"}, "integer": {"unit"}, "vec3": {"min_length"}}
# Integers beyond this are not whole in a page.
LARGEST_INTEGER = 2 ** 53 - 1
# What lists can hold besides records.
LISTED = {"number", "integer", "string", "vec3"}


def fail(where, what):
    sys.exit(f"protocol.json: {where}: {what}")


class Schema:
    """enums and records by name (a record after those that it holds), messages by direction, bodies of
    HTTP answers, stored texts."""

    def __init__(self, path):
        self.root = json.loads(path.read_text(), object_pairs_hook=without_repeats)
        self.only(self.root, "top", {"protocol_version", "max_depth", "types", "page_to_host", "host_to_page",
                                     "http", "stored"})
        self.version, self.max_depth = self.root["protocol_version"], self.root["max_depth"]
        types = self.root["types"]
        self.enums = {name: d for name, d in types.items() if "values" in d}
        self.records = {name: d for name, d in types.items() if "values" not in d}
        self.messages = {direction: self.root[direction]["messages"] for direction in ("page_to_host", "host_to_page")}
        self.max_bytes = {direction: self.root[direction]["max_bytes"] for direction in self.messages}
        self.bodies, self.stored = self.root["http"], self.root["stored"]
        self.check()

    @staticmethod
    def only(definition, where, allowed, required=None):
        if set(definition) - allowed or (allowed if required is None else required) - set(definition):
            fail(where, f"has {sorted(definition)}, must have of {sorted(allowed)}")

    def objects(self):
        """(name, definition) of everything that has fields."""
        for group in (self.records, *self.messages.values(), self.bodies):
            yield from group.items()

    def fields(self, definition):
        """All fields, those of the extended record first."""
        base = self.fields(self.records[definition["extends"]]) if "extends" in definition else {}
        return base | definition["fields"]

    def check(self):
        names = [n for n, _ in self.objects()] + list(self.enums) + list(self.stored)
        for name in names:
            if names.count(name) > 1:
                fail(name, "is defined twice")
        for direction in self.messages:
            self.only(self.root[direction], direction, {"max_bytes", "messages"})
        for name, enum in self.enums.items():
            self.only(enum, name, {"doc", "values"})
            if not enum["values"] or len(set(enum["values"])) != len(enum["values"]):
                fail(name, "needs values, each once")
        for name, definition in self.objects():
            extra = {"max_bytes"} if name in self.bodies else set()
            self.only(definition, name, {"doc", "extends", "fields"} | extra, {"doc", "fields"} | extra)
            if definition.get("extends", next(iter(self.records))) not in self.records:
                fail(name, "extends what is no record")
            inherited = self.fields(self.records[definition["extends"]]) if "extends" in definition else {}
            for key, field in definition["fields"].items():
                if key == "type" or key in inherited:
                    fail(f"{name}.{key}", "the name is taken")
                self.check_field(f"{name}.{key}", field)
        for name, definition in self.stored.items():
            self.only(definition, name, {"doc", "max_bytes", "is"})
            self.check_field(name, definition["is"])
            if not self.is_record(definition["is"]) and not self.is_record(definition["is"].get("of", {})):
                fail(name, "must be a record or a list of records")
        self.records = {name: self.records[name] for name in self.in_order()}
        self.check_use()
        self.check_sizes()

    def is_record(self, field):
        return field.get("type") in self.records

    def check_field(self, where, field):
        kind = field.get("type")
        allowed, needed = {"type", "doc", "optional"}, {"type"}
        if kind == "array":
            of = field.get("of", {})
            size = {"length"} if "length" in field else {"max_items"}
            allowed, needed = allowed | {"of"} | size, needed | {"of"} | size
            if of.get("type") not in LISTED and not self.is_record(of):
                fail(where, f"a list can hold {sorted(LISTED)} and records")
            self.check_field(f"{where}[]", of)
            if "optional" in of:
                fail(where, "items of a list cannot be missing")
        elif kind in LIMITS:
            allowed, needed = allowed | LIMITS[kind] | EXTRA.get(kind, set()), needed | LIMITS[kind]
        elif kind not in self.enums and kind not in self.records:
            fail(where, f"type {kind} is not known")
        self.only(field, where, allowed, needed)
        if "min" in field and not field["min"] <= field["max"]:
            fail(where, "no number lies in its range")
        if kind == "integer" and max(abs(field["min"]), abs(field["max"])) > LARGEST_INTEGER:
            fail(where, "reaches beyond the integers that a page can hold")
        if field.get("optional", True) is not True:
            fail(where, "optional is true or not there")

    def held(self, definition):
        """Names of the types that this definition uses itself."""
        used = {definition["extends"]} if "extends" in definition else set()
        for field in (definition["fields"].values() if "fields" in definition else [definition["is"]]):
            used |= {field["type"], field.get("of", {}).get("type")}
        return used & (set(self.records) | set(self.enums))

    def in_order(self):
        """Records, each after those that it holds; refuses one that holds itself."""
        done, path = [], []

        def visit(name):
            if name in path:
                fail(name, f"holds itself: {' > '.join(path[path.index(name):] + [name])}")
            if name in done:
                return
            path.append(name)
            for other in self.records:
                if other in self.held(self.records[name]):
                    visit(other)
            done.append(path.pop())

        for name in self.records:
            visit(name)
        return done

    def check_use(self):
        used = set().union(*(self.held(d) for _, d in self.objects()), *(self.held(d) for d in self.stored.values()))
        for name in [*self.enums, *self.records]:
            if name not in used:
                fail(name, "is used by nothing")

    def check_sizes(self):
        """What a writer makes must be what a reader takes: deepest nesting and longest text."""
        limits = [(n, d, self.max_bytes[direction]) for direction, group in self.messages.items() for n, d in group.items()]
        limits += [(n, d, d["max_bytes"]) for n, d in [*self.bodies.items(), *self.stored.items()]]
        for name, definition, limit in limits:
            if "is" in definition:
                depth, size = self.extent(definition["is"])
            else:
                depth, size = self.object_extent(definition)
                size += len(name) + len('"type":"",')
            if depth > self.max_depth or size > limit:
                fail(name, f"may be {size} bytes long and {depth} deep; allowed are {limit} and {self.max_depth}")

    def object_extent(self, definition):
        extents = [(key, *self.extent(field)) for key, field in self.fields(definition).items()]
        return (1 + max((depth for _, depth, _ in extents), default=0),
                2 + sum(len(key) + 4 + size for key, _, size in extents))

    def extent(self, field):
        """(depth, bytes) of the largest value as JSON without spaces."""
        kind = field["type"]
        if kind == "array":
            depth, size = self.extent(field["of"])
            return depth + 1, 2 + field.get("length", field.get("max_items")) * (size + 1)
        if kind in self.records:
            return self.object_extent(self.records[kind])
        if kind in self.enums:
            return 0, 2 + max(map(len, self.enums[kind]["values"]))
        # A double has at most 24 characters, a code point 4 bytes.
        return {"vec3": (1, 76), "boolean": (0, 5), "string": (0, 2 + 4 * field.get("max_length", 0))}.get(kind, (0, 24))


def without_repeats(pairs):
    keys = [key for key, _ in pairs]
    for key in keys:
        if keys.count(key) > 1:
            fail(key, "stands twice in one object")
    return dict(pairs)


def pascal(name):
    return "".join(word.capitalize() for word in name.split("_"))


def note(field):
    parts = [field["doc"]] if "doc" in field else []
    if "unit" in field:
        parts.append(f"[{field['unit']}]")
    if "min" in field:
        parts.append(f"{field['min']} to {field['max']}")
    return " ".join(parts)
