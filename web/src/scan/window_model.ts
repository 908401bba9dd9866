// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which densities are told apart in grey: windows that radiology reads wrists with, and one of one's own.
import type { GreyWindow } from "./slice_model";

export interface NamedWindow extends GreyWindow {
  readonly name: string;
}

export const WINDOWS: readonly NamedWindow[] = [
  { name: "Bone", centre: 500, width: 2000 },
  { name: "Soft tissue", centre: 50, width: 400 },
  { name: "All", centre: 600, width: 3600 },
];

/** Dragged: right widens, down brightens; finer in narrow windows. */
export function draggedWindow(from: GreyWindow, right: number, down: number): GreyWindow {
  const step = Math.max(0.5, from.width / 400);
  return {
    width: Math.round(Math.min(6000, Math.max(10, from.width + step * right))),
    centre: Math.round(Math.min(4000, Math.max(-1500, from.centre - step * down))),
  };
}

export function windowText(grey: GreyWindow): string {
  const named = WINDOWS.find((w) => w.centre === grey.centre && w.width === grey.width);
  return `${named?.name ?? "Own"}: centre ${grey.centre}, width ${grey.width} HU`;
}
