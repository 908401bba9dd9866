# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""What a definition may say and what it may not: PYTHONPATH=tools python3 -B -m unittest protocol_generator.schema_test"""

import copy
import json
import pathlib
import tempfile
import unittest

from protocol_generator import cpp, fixtures, typescript
from protocol_generator.schema import Schema

STRING = {"type": "string", "max_length": 16}
# A procedure that describes itself: lists of records with an optional record and a shared enumeration within.
DEFINITION = {
    "protocol_version": 1, "max_depth": 8,
    "types": {
        "hand": {"doc": "A hand.", "values": ["left_hand", "right_hand"]},
        "key": {"doc": "A key.", "fields": {"code": STRING, "hand": {"type": "hand", "optional": True}}},
        "named": {"doc": "Has a name.", "fields": {"id": STRING, "class": STRING}},
        "step": {"doc": "A step.", "extends": "named", "fields": {
            "key": {"type": "key", "optional": True},
            "views": {"type": "array", "of": STRING, "max_items": 4, "optional": True}}},
        "action": {"doc": "What may be done.", "extends": "named", "fields": {
            "allowed": {"type": "boolean"}, "reason": STRING,
            "counts": {"type": "array", "of": {"type": "integer", "min": 0, "max": 9}, "length": 2},
            "corners_mm": {"type": "array", "of": {"type": "vec3", "limit": 10}, "max_items": 3}}}},
    "page_to_host": {"max_bytes": 100, "messages": {"ask": {"doc": "Asks.", "fields": {}}}},
    "host_to_page": {"max_bytes": 4000, "messages": {"procedure": {"doc": "What it is.", "fields": {
        "steps": {"type": "array", "of": {"type": "step"}, "max_items": 3},
        "actions": {"type": "array", "of": {"type": "action"}, "max_items": 3}}}}},
    "http": {}, "stored": {},
}


def schema_of(definition):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "protocol.json"
        path.write_text(definition if isinstance(definition, str) else json.dumps(definition))
        return Schema(path)


class Definition(unittest.TestCase):
    def refused(self, why, change):
        definition = copy.deepcopy(DEFINITION)
        change(definition)
        with self.assertRaisesRegex(SystemExit, why):
            schema_of(definition)

    def field(self, field):
        return lambda d: d["types"]["named"]["fields"].update(other=field)

    def test_records_come_after_those_that_they_hold(self):
        order = list(schema_of(DEFINITION).records)
        self.assertLess(order.index("key"), order.index("step"))
        self.assertLess(order.index("named"), order.index("action"))

    def test_a_record_that_holds_itself_is_refused(self):
        self.refused("key > named > key|named > key > named",
                     lambda d: (d["types"]["key"]["fields"].update(of={"type": "array", "of": {"type": "named"}, "max_items": 1}),
                                d["types"]["named"]["fields"].update(by={"type": "key", "optional": True})))

    def test_what_is_not_understood_is_refused(self):
        self.refused("type json is not known", self.field({"type": "json"}))
        self.refused("has", self.field({"type": "string", "max_length": 3, "max": 4}))
        self.refused("has", self.field({"type": "number", "min": 0}))
        self.refused("no number", self.field({"type": "number", "min": 1, "max": 0}))
        self.refused("beyond the integers", self.field({"type": "integer", "min": 0, "max": 2 ** 53}))
        self.refused("a list can hold", self.field({"type": "array", "of": {"type": "hand"}, "max_items": 2}))
        self.refused("cannot be missing", self.field({"type": "array", "of": STRING | {"optional": True}, "max_items": 2}))
        self.refused("the name is taken", lambda d: d["types"]["step"]["fields"].update(id=STRING))
        self.refused("the name is taken", lambda d: d["types"]["step"]["fields"].update(type=STRING))
        self.refused("is defined twice", lambda d: d["types"].update(ask=d["types"]["hand"]))
        self.refused("used by nothing", lambda d: d["types"].update(lonely=d["types"]["hand"]))
        with self.assertRaisesRegex(SystemExit, "stands twice"):
            schema_of('{"protocol_version": 1, "protocol_version": 2}')

    def test_a_message_that_may_not_fit_is_refused(self):
        self.refused("procedure: may be", lambda d: d["host_to_page"].update(max_bytes=1000))
        self.refused("procedure: may be", lambda d: d.update(max_depth=3))


class Generated(unittest.TestCase):
    def test_both_sides_have_every_kind_of_field(self):
        schema = schema_of(DEFINITION)
        header, source = cpp.types_header(schema, ""), cpp.types_source(schema, "")
        for line in ("struct Step : Named {", "std::optional<Key> key;", "std::optional<Hand> hand;",
                     "std::optional<std::vector<std::string>> views;", "std::vector<Vec3> corners_mm;", "std::string class_;"):
            self.assertIn(line, header)
        self.assertIn('if (in.has("key")) in.record("key", out.key.emplace());', source)
        types = typescript.types(schema, "")
        for line in ("export interface Step extends Named {", "readonly key: Key | null;", "readonly hand: Hand | null;",
                     "readonly counts: readonly [number, number];", "readonly corners_mm: readonly Vec3[];"):
            self.assertIn(line, types)

    def test_fixtures_break_every_rule_of_every_type_once(self):
        changes = json.loads(*fixtures.refused_changes(schema_of(DEFINITION)).values())
        found = [tuple(change[0]) for change in changes["host_to_page/procedure_highest.json"]]
        for path in (("steps",), ("steps", 1, "key", "hand"), ("steps", 1, "id"), ("actions", 1, "counts", 1)):
            self.assertIn(path, found)


if __name__ == "__main__":
    unittest.main()
