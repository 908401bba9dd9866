// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which view would have told, in words.
import type {
  FaultKind,
  FaultSeen,
  PictureTruth,
  PlacementFault,
  ScrewPlace,
  ViewDebrief,
} from "../protocol";

const PLACES: Readonly<Record<ScrewPlace, string>> = {
  inside: "inside",
  distal: "at its distal end",
  proximal: "at its proximal end",
  side: "at its side",
};

const WHERE_SEEN: Readonly<Record<FaultKind, string>> = {
  screw_out: "beyond the bone",
  gap: "clear between the pieces",
  step: "between their edges",
};

/** "The screw is 1.2 mm out at its distal end, towards the trapezium." */
export function faultText(fault: PlacementFault): string {
  if (fault.kind === "gap") return `The pieces lie ${fault.depth_mm.toFixed(1)} mm apart.`;
  if (fault.kind === "step") {
    return `The fracture has a step of ${fault.depth_mm.toFixed(1)} mm.`;
  }
  const towards = fault.towards === "" ? "" : `, towards the ${fault.towards}`;
  // The score looks at the middle of its rounded ends, an X-ray shows their rim.
  const part = fault.place === "side" ? "The screw" : "The rim of the screw";
  return `${part} is ${fault.depth_mm.toFixed(1)} mm out ${PLACES[fault.place]}${towards}.`;
}

/** When a view counts as one that shows these faults. */
export function shownWhen({ faults, revealed_mm }: ViewDebrief): string[] {
  const least = `at least ${revealed_mm.toFixed(1)} mm`;
  const isOut = faults.some(({ kind }) => kind === "screw_out");
  const isApart = faults.some(({ kind }) => kind !== "screw_out");
  return [
    ...(isOut ? [`A view shows metal that is ${least} beyond the bone's outline.`] : []),
    ...(isApart ? [`It shows a gap that is clear by ${least}, a step that is ${least} high.`] : []),
  ];
}

export function isTaken(seen: FaultSeen): boolean {
  return seen.view === "";
}

/** Whether what was taken showed it, and what would have. */
export function verdictText(fault: PlacementFault): string {
  const taken = fault.seen.filter(isTaken);
  const showed = taken.filter((seen) => seen.reveals);
  const best = bestPreset(fault);
  const would =
    best === undefined || !best.reveals
      ? "None of the preset views shows it enough."
      : `${best.label} shows it best: ${best.overhang_mm.toFixed(1)} mm ${WHERE_SEEN[fault.kind]}.`;
  if (taken.length === 0) return `No picture was taken of it as it lies. ${would}`;
  const shots = showed.map((seen) => seen.shot);
  if (showed.length > 0) {
    return `Shot ${shots.join(", ")} showed it. ${would}`;
  }
  const count = taken.length === 1 ? "The picture" : `None of the ${taken.length} pictures`;
  const says = taken.length === 1 ? "taken of it did not show it." : "taken of it showed it.";
  return `${count} ${says} ${would}`;
}

export function bestPreset(fault: PlacementFault): FaultSeen | undefined {
  return fault.seen
    .filter((seen) => !isTaken(seen))
    .reduce<FaultSeen | undefined>(
      (best, seen) => (best === undefined || seen.overhang_mm > best.overhang_mm ? seen : best),
      undefined,
    );
}

/** "1.2 mm", or that nothing of it is seen. */
export function shownText(kind: FaultKind, seen: FaultSeen): string {
  if (seen.overhang_mm <= 0) return "hidden by the bone";
  const mm = `${seen.overhang_mm.toFixed(1)} mm ${WHERE_SEEN[kind]}`;
  return seen.reveals ? mm : `${mm}: too little to see`;
}

/** Of a wire on a picture that was taken; empty where none was out. */
export function wireText(truth: PictureTruth): string {
  if (truth.wire_out_mm === null) return "";
  const shown = truth.wire_shown_mm ?? 0;
  const here =
    shown > 0 ? `this picture shows ${shown.toFixed(1)} mm of it` : "this picture hides it";
  return `Wire ${truth.wire_out_mm.toFixed(1)} mm out of the far side: ${here}.`;
}
