// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera head's focus ring, by data/scope_camera.json: where it stands, and how soft what is out of
// focus is. As a thin lens has it, a point is seen as a disc, across as the lens's pupil is times how much
// 1/distance is off that of what is in focus; nothing is seen sharper than the pupil's diffraction allows. Pure.
import data from "../../../data/scope_camera.json";

const nearestMm = data.nearest_mm.value;
const steps = data.steps.value;

export const PUPIL_MM = data.pupil_mm.value;
export const SHARP_RAD = data.sharp_mrad.value / 1000;
export const BEHIND_MM = data.behind_mm.value;

/** Of the ring, from 0, endlessly far, to NEAREST_STEP. */
export const NEAREST_STEP = steps;
export const WELL_SET_STEP = Math.round((steps * nearestMm) / data.well_set_mm.value);

/** 1/distance of what is in focus [1/mm]. */
export function focusPerMm(step: number): number {
  return step / (steps * nearestMm);
}

/** @param by  steps, nearer or, below 0, farther */
export function focusTurned(step: number, by: number): number {
  return Math.min(NEAREST_STEP, Math.max(0, step + by));
}

/** Of the disc that a point is seen as, beyond what is as sharp as can be [rad]. */
export function blurRad(farMm: number, step: number): number {
  const acrossRad = PUPIL_MM * Math.abs(1 / farMm - focusPerMm(step));
  return Math.sqrt(Math.max(0, acrossRad ** 2 - SHARP_RAD ** 2));
}

/** From where to where a picture is as sharp as can be; the far end may be endless [mm]. */
export function sharpRangeMm(step: number): readonly [number, number] {
  const off = SHARP_RAD / PUPIL_MM;
  const far = focusPerMm(step) - off;
  return [1 / (focusPerMm(step) + off), far > 0 ? 1 / far : Infinity];
}

/** Nothing is so far away in a joint. */
const ENDLESS_MM = 60;

const mm = (value: number): string => String(Number(value.toPrecision(2)));

/** For people. */
export function focusWords(step: number): string {
  const [from, to] = sharpRangeMm(step);
  const at = step === 0 ? "far" : `${mm(1 / focusPerMm(step))} mm`;
  const sharp = to > ENDLESS_MM ? `from ${mm(from)} mm` : `${mm(from)} to ${mm(to)} mm`;
  return `Focus ${at} · sharp ${sharp}`;
}
