// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which controls a procedure has use for: by what lies on its tray and what it declares. Pure.
import type { ExerciseMessage } from "../protocol";

export interface OfferedControls {
  /** Something is pushed or turned into bone. */
  readonly drive: boolean;
  readonly cArm: boolean;
  /** A planned line and screw can be shown. */
  readonly plan: boolean;
  readonly gauge: boolean;
  readonly decline: boolean;
  /** A headset's controllers lead what is held, but nothing in a portal. */
  readonly headset: boolean;
}

export type Declared = Pick<ExerciseMessage, "views" | "mode" | "decline_reasons"> & {
  readonly ideal: unknown;
  readonly arthroscopy: unknown;
  readonly instruments: readonly { readonly drive: string; readonly is_gauge: boolean }[];
};

export function offeredControls(declared: Declared): OfferedControls {
  return {
    drive: declared.instruments.some((one) => one.drive !== "none"),
    cArm: declared.views.length > 0,
    plan: declared.mode !== "assessed" && declared.ideal !== null,
    gauge: declared.instruments.some((one) => one.is_gauge),
    decline: declared.decline_reasons.length > 0,
    headset: declared.arthroscopy === null,
  };
}
