// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Holds text of unknown origin against the rules of generated_rules.ts: type, range, length, unknown
// and missing fields, depth and size. src/protocol/detail/fields.cpp is its other half; the fixtures of
// protocol/ keep them of one mind.

/** What a validator answers: the value, or why it was refused. */
export type Parsed<T> =
  { readonly ok: true; readonly value: T } | { readonly ok: false; readonly reason: string };

export interface Rule {
  /** A kind of value, or the name of one of the types. */
  readonly type: string;
  /** May be missing, which is the same as null. */
  readonly optional?: boolean;
  readonly min?: number;
  readonly max?: number;
  readonly max_length?: number;
  readonly limit?: number;
  readonly min_length?: number;
  readonly of?: Rule;
  readonly length?: number;
  readonly max_items?: number;
}
export type Rules = Readonly<Record<string, Rule>>;
/** The fields of a record, or the values of an enumeration. */
export type NamedType = { readonly fields: Rules } | { readonly values: readonly string[] };

export interface Schema {
  readonly maxDepth: number;
  readonly types: Readonly<Record<string, NamedType>>;
}
type Fields = Record<string, unknown>;

const LONE_SURROGATE = /[\ud800-\udbff](?![\udc00-\udfff])|(?<![\ud800-\udbff])[\udc00-\udfff]/;
// eslint-disable-next-line no-control-regex
const CONTROL = /[\u0000-\u0008\u000b-\u001f\u007f]/;

function isWithin(value: unknown, rule: Rule): boolean {
  return (
    typeof value === "number" &&
    Number.isFinite(value) &&
    value >= (rule.min ?? -Infinity) &&
    value <= (rule.max ?? Infinity)
  );
}

function isText(value: unknown, maxLength: number): boolean {
  return (
    typeof value === "string" &&
    !CONTROL.test(value) &&
    !LONE_SURROGATE.test(value) &&
    (value.length <= maxLength || [...value].length <= maxLength)
  );
}

function isVec3(value: unknown, rule: Rule): boolean {
  if (!Array.isArray(value) || value.length !== 3) return false;
  const limit = rule.limit ?? Infinity;
  let squared = 0;
  for (const component of value as readonly unknown[]) {
    if (typeof component !== "number" || !(Math.abs(component) <= limit)) return false;
    squared += component * component;
  }
  const shortest = rule.min_length ?? 0;
  return squared >= shortest * shortest;
}

function isObject(value: unknown): value is Fields {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function isSimple(value: unknown, rule: Rule): boolean {
  switch (rule.type) {
    case "number":
      return isWithin(value, rule);
    case "integer":
      return isWithin(value, rule) && Number.isInteger(value);
    case "boolean":
      return typeof value === "boolean";
    case "string":
      return isText(value, rule.max_length ?? 0);
    case "vec3":
      return isVec3(value, rule);
    default:
      return false;
  }
}

function describe(rule: Rule): string {
  if (rule.min !== undefined) return `${rule.type} from ${rule.min} to ${rule.max ?? ""}`;
  if (rule.max_length !== undefined) return `string of at most ${rule.max_length} characters`;
  return rule.type;
}

/** Why a list is refused; null where it holds what the rule says. */
function problemOfList(value: unknown, rule: Rule, where: string, schema: Schema): string | null {
  const { of } = rule;
  const low = rule.length ?? 0;
  const high = rule.length ?? rule.max_items ?? 0;
  if (!Array.isArray(value) || of === undefined || value.length < low || value.length > high) {
    return `field '${where}' must be a list of ${low === high ? low : `at most ${high}`}`;
  }
  for (const [i, item] of (value as readonly unknown[]).entries()) {
    const problem = problemOf(item, of, `${where}[${i}]`, schema);
    if (problem !== null) return problem;
  }
  return null;
}

function problemOf(value: unknown, rule: Rule, where: string, schema: Schema): string | null {
  if (rule.type === "array") return problemOfList(value, rule, where, schema);
  const named = Object.hasOwn(schema.types, rule.type) ? schema.types[rule.type] : undefined;
  if (named === undefined) {
    return isSimple(value, rule) ? null : `field '${where}' must be ${describe(rule)}`;
  }
  if ("values" in named) {
    if (typeof value === "string" && named.values.includes(value)) return null;
    return `field '${where}' must be one of ${named.values.join(", ")}`;
  }
  if (!isObject(value)) return `field '${where}' must be an object`;
  return problemOfFields(value, named.fields, `${where}.`, schema);
}

/** Writes null for optional fields that are missing, so that readers meet one form of nothing. */
function problemOfFields(
  fields: Fields,
  rules: Rules,
  prefix: string,
  schema: Schema,
): string | null {
  for (const key of Object.keys(fields)) {
    if (!Object.hasOwn(rules, key)) return `unknown field '${prefix}${key.slice(0, 64)}'`;
  }
  for (const [key, rule] of Object.entries(rules)) {
    if (rule.optional === true && (!Object.hasOwn(fields, key) || fields[key] === null)) {
      fields[key] = null;
      continue;
    }
    if (!Object.hasOwn(fields, key)) return `field '${prefix}${key}' is missing`;
    const problem = problemOf(fields[key], rule, prefix + key, schema);
    if (problem !== null) return problem;
  }
  return null;
}

/** Whether arrays and objects nest deeper than allowed; looked at before parsing. */
function isTooDeep(text: string, maxDepth: number): boolean {
  let depth = 0;
  let inString = false;
  for (let i = 0; i < text.length; ++i) {
    const c = text[i];
    if (inString) {
      if (c === "\\") ++i;
      else if (c === '"') inString = false;
    } else if (c === '"') inString = true;
    else if (c === "{" || c === "[") {
      if (++depth > maxDepth) return true;
    } else if (c === "}" || c === "]") --depth;
  }
  return false;
}

/** A UTF-16 unit makes one to three bytes of UTF-8. */
function isTooLong(text: string, maxBytes: number): boolean {
  if (text.length > maxBytes) return true;
  return 3 * text.length > maxBytes && new TextEncoder().encode(text).length > maxBytes;
}

function parseObject(text: string, maxBytes: number, schema: Schema): Parsed<Fields> {
  if (isTooLong(text, maxBytes)) return { ok: false, reason: `longer than ${maxBytes} bytes` };
  if (isTooDeep(text, schema.maxDepth)) return { ok: false, reason: "nested too deeply" };
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return { ok: false, reason: "not valid JSON" };
  }
  return isObject(value) ? { ok: true, value } : { ok: false, reason: "not a JSON object" };
}

/** One of several messages, told apart by `type`. Never throws. */
export function parseTagged<T>(
  text: string,
  kinds: Readonly<Record<string, Rules>>,
  maxBytes: number,
  schema: Schema,
): Parsed<T> {
  const parsed = parseObject(text, maxBytes, schema);
  if (!parsed.ok) return parsed;
  const { type, ...fields } = Object.hasOwn(parsed.value, "type") ? parsed.value : { type: 0 };
  if (typeof type !== "string") return { ok: false, reason: "field 'type' must be a string" };
  const rules = Object.hasOwn(kinds, type) ? kinds[type] : undefined;
  if (rules === undefined) return { ok: false, reason: `unknown message type '${type}'` };
  const problem = problemOfFields(fields, rules, "", schema);
  if (problem !== null) return { ok: false, reason: `${type}: ${problem}` };
  return { ok: true, value: { type, ...fields } as T };
}

/** One object. Never throws. */
export function parseBody<T>(
  text: string,
  rules: Rules,
  maxBytes: number,
  schema: Schema,
): Parsed<T> {
  const parsed = parseObject(text, maxBytes, schema);
  if (!parsed.ok) return parsed;
  const problem = problemOfFields(parsed.value, rules, "", schema);
  return problem === null ? { ok: true, value: parsed.value as T } : { ok: false, reason: problem };
}
