// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the quiz says, in words; and its answers, their keys and what is still open.
import type { QuizTally, QuizTruthMessage, QuizView, ScrewPlace } from "../protocol";

export interface PlaceChoice {
  readonly place: ScrewPlace;
  readonly label: string;
  readonly key: string;
}

export const PLACES: readonly PlaceChoice[] = [
  { place: "inside", label: "In: bone covers all of it", key: "I" },
  { place: "distal", label: "Out at its distal end", key: "D" },
  { place: "proximal", label: "Out at its proximal end", key: "P" },
  { place: "side", label: "Out at the side", key: "S" },
];

const IN_WORDS: Readonly<Record<ScrewPlace, string>> = {
  inside: "in",
  distal: "out at its distal end",
  proximal: "out at its proximal end",
  side: "out at the side",
};

export function mm(value: number): string {
  return `${Math.abs(value).toFixed(1)} mm`;
}

/** "It is out at its distal end by 1.3 mm, towards the trapezium." */
export function truthText(truth: QuizTruthMessage): string {
  if (truth.place === "inside") {
    return `It is in: at least ${mm(truth.depth_mm)} of bone cover it everywhere.`;
  }
  const towards = truth.towards === "" ? "" : `, towards the ${truth.towards}`;
  return `It is ${IN_WORDS[truth.place]} by ${mm(truth.depth_mm)}${towards}.`;
}

/** How the answer was, with a word before the colour. */
export function verdictText(truth: QuizTruthMessage): string {
  if (truth.is_place_right) return `Right: ${IN_WORDS[truth.answered]}.`;
  if (truth.is_false_safety) return "False safety: you called it in, and it is out.";
  return `Not right: you called it ${IN_WORDS[truth.answered]}.`;
}

export function nameOf(views: readonly QuizView[], id: string): string {
  return views.find((view) => view.id === id)?.name ?? id;
}

/** What is said of the view that was chosen. */
export function viewVerdictText(truth: QuizTruthMessage, views: readonly QuizView[]): string {
  const chosen = nameOf(views, truth.next_view);
  const best = nameOf(views, truth.best_view);
  const shown = truth.views.find((view) => view.view === truth.next_view);
  const lead = truth.is_view_right ? "Right view" : "Another view would tell";
  if (truth.place === "inside") {
    return `${lead}. Were it longer, it would come out where ${best} shows it best.`;
  }
  const beyond = shown?.overhang_mm ?? 0;
  const does =
    shown?.reveals === true
      ? `shows it ${mm(beyond)} beyond the bone`
      : beyond > 0
        ? `shows only ${mm(beyond)} beyond the bone`
        : "hides it behind the bone's own outline";
  return `${lead}: ${chosen} ${does}; best is ${best}.`;
}

/** "4 of 5" and the like; a dash before the first answer. */
export function tallyRows(tally: QuizTally): readonly (readonly [string, string])[] {
  const of = (count: number): string =>
    tally.answers === 0 ? "–" : `${count} of ${tally.answers}`;
  return [
    ["Where", of(tally.right_places)],
    ["Which view", of(tally.right_views)],
    ["False safety", String(tally.false_safety)],
    ["Views taken", String(tally.views_taken)],
  ];
}

/** Index of the view whose angles a picture has; undefined for another's. */
export function viewOfPicture(
  views: readonly QuizView[],
  rotationDeg: number,
  tiltDeg: number,
): number | undefined {
  const SAME_DEG = 0.5;
  const index = views.findIndex(
    (view) =>
      Math.abs(view.rotation_deg - rotationDeg) < SAME_DEG &&
      Math.abs(view.tilt_deg - tiltDeg) < SAME_DEG,
  );
  return index < 0 ? undefined : index;
}

/** Corners for an SVG polygon; a pixel's centre is half a pixel in. */
export function polygonPoints(pixels: readonly number[]): string {
  const points: string[] = [];
  for (let i = 0; i + 1 < pixels.length; i += 2) {
    points.push(`${(pixels[i] ?? 0) + 0.5},${(pixels[i + 1] ?? 0) + 0.5}`);
  }
  return points.join(" ");
}

/** The seed that an address such as "#/views?seed=7" names. */
export function seedOf(hash: string): number | undefined {
  const text = /^#\/views\?seed=(\d{1,10})$/.exec(hash)?.[1];
  const seed = Number(text);
  return text !== undefined && seed <= 0xffffffff ? seed : undefined;
}
