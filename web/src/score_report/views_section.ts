// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Debrief by view: the trainee's own pictures, made anew from the recording, with the true outlines on
// request, and which views would have shown what is wrong with the screw.
import { fetchPictureTruth, fetchReplayPicture, fetchViewDebrief } from "../case_data";
import { drawPicture } from "../c_arm";
import { make, makeSvg, setText } from "../dom";
import { tickText } from "../operation";
import type {
  Attempt,
  CArmPicture,
  FaultSeen,
  LoggedEvent,
  PictureOutline,
  PictureTruth,
  PlacementFault,
  ViewDebrief,
} from "../protocol";
import { polygonPoints } from "../view_quiz";
import {
  bestPreset,
  faultText,
  isTaken,
  shownText,
  shownWhen,
  verdictText,
  wireText,
} from "./views_model";

/** Pictures of an operation; who took more sees the last. */
const MOST_PICTURES = 24;
const PICTURE_PX = 512;

export function viewsSection(attempt: Attempt): HTMLElement {
  const faults = make("div.view-faults", {}, make("p.secondary", {}, "Going through the views…"));
  const section = make(
    "section.views-debrief",
    { "aria-labelledby": "views-title" },
    make("h2", { id: "views-title" }, "What the views show"),
    faults,
    picturesOf(attempt),
  );
  fetchViewDebrief(attempt.id).then(
    (debrief) => {
      faults.replaceChildren(...faultBlocks(debrief));
    },
    (error: unknown) => {
      const why = error instanceof Error ? error.message : String(error);
      faults.replaceChildren(make("p.secondary", {}, why));
    },
  );
  return section;
}

function faultBlocks(debrief: ViewDebrief): HTMLElement[] {
  if (debrief.screw === "") {
    return [make("p.secondary", {}, "No screw lay in the scaphoid at the end.")];
  }
  if (debrief.faults.length === 0) {
    return [make("p.good", {}, `✓ ${debrief.screw}: none of it is out of the bone.`)];
  }
  return [
    ...debrief.faults.map(faultBlock),
    ...shownWhen(debrief).map((text) => make("p.secondary", {}, text)),
  ];
}

function faultBlock(fault: PlacementFault): HTMLElement {
  const best = bestPreset(fault);
  const row = (seen: FaultSeen): HTMLElement =>
    make(
      "tr",
      seen === best && seen.reveals ? { class: "view-best" } : {},
      make("th", { scope: "row" }, isTaken(seen) ? `Shot ${seen.shot}, taken` : seen.label),
      make(
        `td.${seen.reveals ? "good" : "secondary"}` as "td",
        {},
        `${seen.reveals ? "✓" : "–"} ${shownText(fault.kind, seen)}`,
      ),
    );
  const presets = fault.seen.filter((seen) => !isTaken(seen));
  const taken = fault.seen.filter(isTaken);
  const column = (name: string, all: readonly FaultSeen[]): HTMLElement[] =>
    all.length === 0
      ? []
      : [make("table", {}, make("caption", {}, name), make("tbody", {}, ...all.map(row)))];
  return make(
    "div.view-fault",
    {},
    make("p.harm", {}, `✕ ${faultText(fault)}`),
    make("p", {}, verdictText(fault)),
    make(
      "div.view-columns",
      {},
      ...column("Preset views", presets),
      ...column("Taken of it", taken),
    ),
  );
}

function looksOf(events: readonly LoggedEvent[]): LoggedEvent[] {
  return events.filter(({ kind }) => kind === "shot_taken" || kind === "live_ended");
}

function picturesOf(attempt: Attempt): HTMLElement {
  const all = looksOf(attempt.events ?? []);
  const looks = all.slice(-MOST_PICTURES);
  if (looks.length === 0) return make("p.secondary", {}, "No picture was taken.");
  const wish = make("input", { type: "checkbox", id: "true-outlines" });
  const pictures = looks.map((look) => new TakenPicture(attempt.id, look.tick));
  wish.addEventListener("change", () => {
    for (const picture of pictures) picture.showOutlines(wish.checked);
  });
  // One after another, once they are on the page: each is made from the recording.
  void (async () => {
    await new Promise((then) => requestAnimationFrame(then));
    for (const picture of pictures) {
      if (!picture.element.isConnected) break;
      await picture.load();
    }
  })();
  const left = all.length - looks.length;
  return make(
    "div.taken",
    {},
    make(
      "label.taken-switch",
      { for: "true-outlines" },
      wish,
      make(
        "span",
        {},
        "True outlines of ",
        make("span.outline-bone-word", {}, "bone"),
        ", ",
        make("span.outline-screw-word", {}, "screw"),
        " and ",
        make("span.outline-wire-word", {}, "wire"),
      ),
    ),
    make("div.taken-pictures", {}, ...pictures.map((picture) => picture.element)),
    ...(left > 0 ? [make("p.secondary", {}, `and ${left} earlier, in the replay`)] : []),
  );
}

class TakenPicture {
  readonly element: HTMLElement;
  private readonly canvas = make("canvas", {
    width: String(PICTURE_PX),
    height: String(PICTURE_PX),
    role: "img",
    "aria-label": "Picture that is being made",
  });
  private readonly outlines = makeSvg("svg", { class: "taken-outlines", "aria-hidden": "true" });
  private readonly name = make("span", {}, "…");
  private readonly wire = make("span.harm");
  private picture: CArmPicture | undefined;
  private truth: PictureTruth | undefined;
  private asked = false;
  private wished = false;

  constructor(
    private readonly attempt: number,
    private readonly tick: number,
  ) {
    this.element = make(
      "figure",
      {},
      make(
        "a.taken-frame",
        { href: `#/replay/${attempt}?t=${(tick / 1000).toFixed(1)}`, title: "To this moment" },
        this.canvas,
        this.outlines,
      ),
      make("figcaption", {}, this.name, this.wire),
    );
  }

  async load(): Promise<void> {
    try {
      this.picture = await fetchReplayPicture(this.attempt, this.tick);
    } catch (error) {
      setText(this.name, error instanceof Error ? error.message : String(error));
      return;
    }
    const { shot, rotationDeg, tiltDeg } = this.picture;
    const angles = `${Math.round(rotationDeg)}° / ${Math.round(tiltDeg)}°`;
    setText(this.name, `Shot ${shot}, ${angles}, ${tickText(this.tick)}`);
    this.canvas.setAttribute("aria-label", `Shot ${shot}, from ${angles}`);
    drawPicture(this.canvas, this.picture, false, undefined);
    await this.loadTruth();
  }

  showOutlines(on: boolean): void {
    this.wished = on;
    void this.loadTruth();
    this.draw();
  }

  private async loadTruth(): Promise<void> {
    if (!this.wished || this.asked || this.picture === undefined) return;
    this.asked = true;
    try {
      this.truth = await fetchPictureTruth(this.attempt, this.tick);
      setText(this.wire, wireText(this.truth));
    } catch (error) {
      setText(this.wire, error instanceof Error ? error.message : String(error));
    }
    this.draw();
  }

  private draw(): void {
    this.outlines.replaceChildren();
    this.wire.hidden = !this.wished;
    const { picture, truth } = this;
    if (!this.wished || picture === undefined || truth === undefined) return;
    this.outlines.setAttribute("viewBox", `0 0 ${picture.width} ${picture.height}`);
    const add = (kind: string, all: readonly PictureOutline[]): void => {
      for (const { pixels } of all) {
        this.outlines.append(makeSvg("polygon", { class: kind, points: polygonPoints(pixels) }));
      }
    };
    add("outline-bone", truth.bone);
    add("outline-wire", truth.wires);
    add("outline-screw", truth.screws);
  }
}
