// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What of the bone in hand becomes another bone or none: a part, by a line, or all of it.
import { button, make, setText } from "../dom";
import type { Vec3 } from "../protocol";
import { nameOfLabel } from "./bones_now_model";
import type { CutLine } from "./cut_line_model";
import { CutTool } from "./cut_tool";
import { voxelVolume, type Volume } from "./nifti_model";
import { OtherBone } from "./other_bone";
import type { LabelPaint } from "./paint_model";
import type { Plane } from "./planes_model";
import { boneTitle } from "./scan_case_model";

export interface ReassignWishes {
  /** The label of the bone in hand. */
  inHand(): number;
  choose(label: number): void;
  /** The labels were changed. */
  changed(): void;
  /** What is shown of the tools is not what it was. */
  show(): void;
  /** What was done, until something else is. */
  tell(text: string): void;
  say(text: string): void;
  /** The focus has to go somewhere. */
  focus(): void;
}

const NO_LINE = "That is too short for a line: drag from one side of the bone to the other.";
const SECOND_END = "The first end lies at the crosshair. Go to the second, and Enter.";
const WHAT =
  "Choose what the side with the ticks becomes, a bone or none; until then nothing is cut.";
const READY = "Cut here, or Enter on the picture, cuts it off; Esc drops the line.";

export class ReassignTools {
  readonly elements: readonly HTMLElement[];
  private readonly cut = new CutTool();
  private readonly other: OtherBone;
  private readonly cutButton: HTMLButtonElement;
  private readonly mergeButton: HTMLButtonElement;

  constructor(
    private readonly labels: Volume,
    private readonly paint: LabelPaint,
    private readonly wishes: ReassignWishes,
  ) {
    this.other = new OtherBone(() => {
      this.askForCut();
      wishes.show();
    });
    this.cutButton = button("Cut here", "Enter", () => {
      this.makeCut();
    });
    this.mergeButton = button("Rename or merge", "", () => {
      this.merge();
    });
    this.elements = [
      this.other.element,
      make("div.scan-row", {}, this.cutButton, this.mergeButton),
    ];
  }

  /** As it is to be drawn. @param away  into the screen of the picture that has the keys */
  line(cross: Vec3, away: Vec3): CutLine | undefined {
    return this.cut.shown(cross, away);
  }

  dropLine(): void {
    this.cut.drop();
  }

  /** Another bone comes in hand: what the one before was to become says nothing of it. */
  forget(): void {
    this.other.clear();
    this.cut.drop();
  }

  press(plane: Plane, mm: Vec3, phase: "down" | "move" | "up"): void {
    if (this.cut.press(mm, plane.away, phase)) this.lineIsWhole();
    else if (phase === "up") this.wishes.say(NO_LINE);
    this.wishes.show();
  }

  /** Enter at the crosshair. @param plane  of the picture that has the keys */
  enter(plane: Plane, mm: Vec3): void {
    if (this.cut.whole !== undefined) this.makeCut();
    else if (this.cut.addEnd(mm, plane.away)) this.lineIsWhole();
    else this.wishes.say(this.cut.shown(mm, plane.away) === undefined ? NO_LINE : SECOND_END);
    this.wishes.show();
  }

  show(): void {
    const inHand = this.wishes.inHand();
    const count = (label: number): number => this.paint.count(label);
    this.other.show(inHand, count);
    const { label } = this.other;
    const how = label === undefined ? "Rename or merge" : count(label) > 0 ? "Merge" : "Rename";
    setText(this.mergeButton, label === 0 ? "Take all of it away" : how);
    const hasLine = this.cut.whole !== undefined;
    // The keys stay on the page.
    if (!hasLine && document.activeElement === this.cutButton) this.wishes.focus();
    this.cutButton.hidden = !hasLine;
    // A part is asked for: all of it is not to go by a slip of the hand.
    this.mergeButton.hidden = hasLine;
  }

  private titleOf(label: number): string {
    return boneTitle(nameOfLabel(label, (one) => this.paint.count(one)));
  }

  private volumeOf(voxels: number): string {
    return `${(voxels * voxelVolume(this.labels)).toFixed(0)} mm³`;
  }

  private lineIsWhole(): void {
    // Chosen for this bone already: the line was all that was missing.
    if (this.other.label === undefined) this.askForCut();
    else this.makeCut();
  }

  /** A line that is whole waits for what the part becomes, and for the word. */
  private askForCut(): void {
    if (this.cut.whole === undefined) return;
    this.wishes.say(this.other.label === undefined ? WHAT : READY);
  }

  private makeCut(): void {
    const line = this.cut.whole;
    const into = this.other.label;
    if (line === undefined) return;
    if (into === undefined) {
      this.askForCut();
      this.other.focus();
      return;
    }
    const whole = this.titleOf(this.wishes.inHand());
    const voxels = this.paint.split(this.wishes.inHand(), into, line);
    this.cut.drop();
    if (voxels === 0) {
      this.wishes.tell(`The line leaves all of ${whole} on one side: nothing was cut.`);
      this.wishes.show();
      return;
    }
    this.wishes.changed();
    const became = into === 0 ? "no bone" : this.titleOf(into);
    this.wishes.tell(`${this.volumeOf(voxels)} of ${whole} is ${became} now.`);
  }

  private merge(): void {
    const from = this.wishes.inHand();
    const into = this.other.label;
    if (into === undefined) {
      this.wishes.say("Choose first what the bone in hand becomes.");
      this.other.focus();
      return;
    }
    const voxels = this.paint.count(from);
    const was = this.titleOf(from);
    if (voxels === 0) {
      this.wishes.say(`${was} has no voxels that could become another bone.`);
      return;
    }
    const isMerged = into !== 0 && this.paint.count(into) > 0;
    this.paint.merge(from, into);
    if (into !== 0) this.wishes.choose(into);
    this.other.clear();
    this.wishes.changed();
    const became = into === 0 ? "no bone" : `${isMerged ? "part of " : ""}${this.titleOf(into)}`;
    this.wishes.tell(`${was}, ${this.volumeOf(voxels)}, is ${became} now.`);
  }
}
