// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the theatre looks: a material of six fields for each tissue, as data/materials.json has it, lamps,
// and what is shown of the bones' surfaces. A person may change all of it; it changes no figure.
import data from "../../../data/materials.json";

export const TISSUES = ["bone", "tendon", "artery", "nerve"] as const;
export type Tissue = (typeof TISSUES)[number];

/** Red, green, blue, sRGB, 0 to 1. */
export type Rgb = readonly [number, number, number];

export interface Material {
  readonly diffuse: Rgb;
  readonly emissive: Rgb;
  readonly specular: Rgb;
  /** Each 0 to 1. */
  readonly ambient: number;
  readonly shininess: number;
  readonly transparency: number;
}
export const COLOR_FIELDS = ["diffuse", "emissive", "specular"] as const;
export const NUMBER_FIELDS = ["ambient", "shininess", "transparency"] as const;

/** A lamp that turns with the viewer. */
export interface Lamp {
  readonly color: Rgb;
  /** 0 off to 5. */
  readonly strength: number;
  /** From the line of sight [degrees]: 0 behind the viewer, 90 from the right; above positive. */
  readonly right: number;
  readonly up: number;
}
export const MOST_LAMPS = 4;
export const MOST_STRENGTH = 5;

export interface Look {
  readonly materials: Readonly<Record<Tissue, Material>>;
  readonly lamps: readonly Lamp[];
  /** Bones painted with their bitmaps. */
  readonly texture: boolean;
  /** The facets' edges. */
  readonly facets: boolean;
  /** Each bone's convex hull. */
  readonly hulls: boolean;
}

const WHITE: Rgb = [1, 1, 1];
/** A warm lamp beside the surgeon's left shoulder, a dim cool one across. */
const LAMPS: readonly Lamp[] = [
  { color: [1, 0.945, 0.863], strength: 2.15, right: -56, up: 36 },
  { color: [0.561, 0.722, 0.839], strength: 0.3, right: 58, up: -18 },
];
/** What a further lamp begins as. */
export const NEW_LAMP: Lamp = { color: WHITE, strength: 0.8, right: 0, up: 60 };

function rgb(values: readonly number[]): Rgb {
  const [r = 0, g = 0, b = 0] = values;
  return [r, g, b];
}

/** As the data has it. */
export function materialOf(tissue: Tissue | "skin"): Material {
  const found = data.materials.find((material) => material.tissue === tissue);
  if (found === undefined) throw new Error(`no material of ${tissue}`);
  const { ambient, shininess, transparency } = found;
  return {
    diffuse: rgb(found.diffuse),
    emissive: rgb(found.emissive),
    specular: rgb(found.specular),
    ambient,
    shininess,
    transparency,
  };
}

export function titleOf(tissue: Tissue): string {
  return data.materials.find((material) => material.tissue === tissue)?.title ?? tissue;
}

export function defaultLook(): Look {
  return {
    materials: {
      bone: materialOf("bone"),
      tendon: materialOf("tendon"),
      artery: materialOf("artery"),
      nerve: materialOf("nerve"),
    },
    lamps: LAMPS,
    texture: true,
    facets: false,
    hulls: false,
  };
}

/** Blinn and Phong's shininess as a microfacets' roughness: as anatomy/material_table.hpp. */
export function roughnessOf({ shininess }: Material): number {
  return Math.pow(2 / (128 * shininess + 2), 0.25);
}

export function hexOf(color: Rgb): string {
  const part = (c: number): string =>
    Math.round(255 * Math.min(1, Math.max(0, c)))
      .toString(16)
      .padStart(2, "0");
  return `#${color.map(part).join("")}`;
}

/** @param hex  "#rrggbb"; anything else is black. */
export function rgbOf(hex: string): Rgb {
  const found = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(hex);
  if (found === null) return [0, 0, 0];
  const part = (i: number): number => parseInt(found[i] ?? "0", 16) / 255;
  return [part(1), part(2), part(3)];
}

function within(value: unknown, low: number, high: number): value is number {
  return typeof value === "number" && value >= low && value <= high;
}

function isRgb(value: unknown): value is Rgb {
  return Array.isArray(value) && value.length === 3 && value.every((c) => within(c, 0, 1));
}

function fieldsOf(value: unknown): Readonly<Record<string, unknown>> {
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>) : {};
}

function isMaterial(value: unknown): value is Material {
  const fields = fieldsOf(value);
  return (
    COLOR_FIELDS.every((name) => isRgb(fields[name])) &&
    NUMBER_FIELDS.every((name) => within(fields[name], 0, 1))
  );
}

function isLamp(value: unknown): value is Lamp {
  const { color, strength, right, up } = fieldsOf(value);
  return (
    isRgb(color) &&
    within(strength, 0, MOST_STRENGTH) &&
    within(right, -180, 180) &&
    within(up, -90, 90)
  );
}

/** What was remembered; the default look where it is none, or one of another time. */
export function lookOf(text: string): Look {
  const fallback = defaultLook();
  let read: unknown;
  try {
    read = JSON.parse(text);
  } catch {
    return fallback;
  }
  const { materials, lamps, texture, facets, hulls } = fieldsOf(read);
  const of = fieldsOf(materials);
  if (!TISSUES.every((tissue) => isMaterial(of[tissue]))) return fallback;
  if (!Array.isArray(lamps) || lamps.length < 1 || lamps.length > MOST_LAMPS) return fallback;
  if (!lamps.every(isLamp)) return fallback;
  return {
    materials: of as unknown as Look["materials"],
    lamps,
    texture: texture === true,
    facets: facets === true,
    hulls: hulls === true,
  };
}

/** With one tissue's field changed. */
export function withMaterial(look: Look, tissue: Tissue, change: Partial<Material>): Look {
  return {
    ...look,
    materials: { ...look.materials, [tissue]: { ...look.materials[tissue], ...change } },
  };
}

export function withLamp(look: Look, index: number, change: Partial<Lamp>): Look {
  return {
    ...look,
    lamps: look.lamps.map((lamp, i) => (i === index ? { ...lamp, ...change } : lamp)),
  };
}

/** @param count  1 to MOST_LAMPS */
export function withLampCount(look: Look, count: number): Look {
  const lamps = look.lamps.slice(0, count);
  while (lamps.length < count) lamps.push(LAMPS[lamps.length] ?? NEW_LAMP);
  return { ...look, lamps };
}
