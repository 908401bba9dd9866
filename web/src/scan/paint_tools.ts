// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What mends labels: brush, eraser and marker, fill, rename or merge, split or cut by a line, undo and redo, and
// the mended labels as a file. What changed is marked until it is saved.
import { button, make, setText } from "../dom";
import { withKeys } from "../key_caps";
import type { Vec3 } from "../protocol";
import { nameOfLabel } from "./bones_now_model";
import type { CutLine } from "./cut_line_model";
import { MendedLooks, type MendedLooksWishes } from "./mended_looks";
import { voxelVolume, type Volume } from "./nifti_model";
import { packedLabels } from "./packed_labels";
import { LabelPaint } from "./paint_model";
import { along, type Plane } from "./planes_model";
import { ReassignTools } from "./reassign_tools";
import { boneTitle, type ScannedBone } from "./scan_case_model";
import type { Brush } from "./slice_panel";
import { Stroke } from "./stroke_model";

const TOOLS = ["paint", "erase", "mark", "move", "split"] as const;
export type PaintTool = (typeof TOOLS)[number];
type Phase = "down" | "move" | "up";

export interface PaintWishes {
  redraw(): void;
  say(text: string): void;
  /** The labels as they are now, packed, for a new version of the case; undefined for who may make none. */
  readonly makeVersion: ((labels: Blob) => Promise<void>) | undefined;
  /** A tool is in the hand: nothing else can be. */
  taken(): void;
  /** A bone has voxels now that had none, or the other way. */
  bonesChanged(): void;
  /** Shows mended surfaces, made by the host of this case; undefined for who may not ask it for any. */
  readonly look: ({ readonly of: string } & Pick<MendedLooksWishes, "say" | "show">) | undefined;
}

const SAID: Readonly<Partial<Record<PaintTool, string>>> = {
  split:
    "Drag a line across the bone in hand, or Enter lays its ends at the crosshair: the side with the ticks is cut off.",
  mark: "Mark what belongs to the bone in hand, roughly: how far it goes is found in the CT.",
  move: "Drag: the stroke that was painted last goes with the hand. Enter lays its middle at the crosshair.",
};
const NOTHING_TO_MOVE = "Nothing to move: only the stroke that was painted last can be.";

const RADII_MM = [0.3, 0.5, 0.8, 1.2, 2, 3, 5] as const;

export class PaintTools {
  readonly element: HTMLElement;
  tool: PaintTool | undefined;
  /** The label that is painted. */
  chosen = 0;
  private readonly paint: LabelPaint;
  private radius = 2;
  /** Where the hand went down to move. */
  private from: Vec3 | undefined;
  private stroke: Stroke | undefined;
  private isPainting = false;
  private isSaved = true;
  private readonly looks: MendedLooks | undefined;
  private readonly size = make("output", { "aria-label": "Radius of the brush" });
  private readonly reassign: ReassignTools;
  private readonly told = make("p.scan-told");
  private readonly title = make("strong");
  private readonly buttons: Readonly<Record<PaintTool, HTMLButtonElement>>;
  private readonly undoButton: HTMLButtonElement;
  private readonly redoButton: HTMLButtonElement;
  private readonly warn = (event: BeforeUnloadEvent): void => {
    if (!this.isSaved) event.preventDefault();
  };

  constructor(
    private readonly labels: Volume,
    bones: readonly ScannedBone[],
    private readonly wishes: PaintWishes,
  ) {
    this.paint = new LabelPaint(labels);
    this.chosen = bones[0]?.label ?? 1;
    const toggle = (tool: PaintTool, label: string, key: string): HTMLButtonElement =>
      button(label, key, () => {
        this.take(this.tool === tool ? undefined : tool);
      });
    this.buttons = {
      paint: toggle("paint", "Paint", "{KeyA}"),
      erase: toggle("erase", "Erase", "{KeyE}"),
      mark: toggle("mark", "Marker", "{KeyW}"),
      move: toggle("move", "Move", "{KeyV}"),
      split: toggle("split", "Split or cut by a line", "{KeyK}"),
    };
    this.reassign = new ReassignTools(labels, this.paint, {
      inHand: () => this.chosen,
      choose: this.choose.bind(this),
      changed: () => {
        this.changed();
      },
      show: this.show.bind(this),
      tell: this.tell.bind(this),
      say: wishes.say,
      focus: () => {
        this.buttons.split.focus();
      },
    });
    const { look } = wishes;
    if (look !== undefined) {
      this.looks = new MendedLooks(look.of, labels, this.paint, {
        say: look.say,
        show: look.show,
        labelsChanged: () => {
          wishes.bonesChanged();
          this.show();
        },
      });
    }
    this.undoButton = button("Undo", "{KeyZ}", () => {
      this.undo();
    });
    this.redoButton = button("Redo", "{KeyY}", () => {
      this.redo();
    });
    const fewer = button("Smaller", "{Comma}", () => {
      this.resize(-1);
    });
    const more = button("Larger", "{Period}", () => {
      this.resize(1);
    });
    this.element = make(
      "details.scan-mend",
      {},
      make("summary", {}, "Mend the labels"),
      make("p", {}, "Bone in hand: ", this.title),
      make(
        "div.scan-row",
        {},
        this.buttons.paint,
        this.buttons.erase,
        ...(this.looks === undefined ? [] : [this.buttons.mark]),
        this.buttons.move,
      ),
      make("div.scan-row", {}, fewer, this.size, more),
      make(
        "div.scan-row",
        {},
        this.undoButton,
        this.redoButton,
        button("Fill", "{KeyF}", () => {
          this.fill();
        }),
      ),
      make("div.scan-row", {}, this.buttons.split),
      ...this.reassign.elements,
      this.told,
      make(
        "div.scan-row",
        {},
        ...(wishes.makeVersion === undefined
          ? []
          : [
              button("Run again as a new version", "{KeyG}", () => {
                this.runAgain();
              }),
            ]),
        button("Save the labels as a file", "{KeyS}", () => {
          this.save();
        }),
      ),
    );
    window.addEventListener("beforeunload", this.warn);
    this.choose(this.chosen);
    this.show();
  }

  dispose(): void {
    window.removeEventListener("beforeunload", this.warn);
    this.looks?.dispose();
  }

  get brush(): Brush | undefined {
    if (this.tool === undefined || this.tool === "split" || this.tool === "move") return undefined;
    return { radiusMm: RADII_MM[this.radius] ?? 1, isEraser: this.tool === "erase" };
  }

  /** How many voxels have a label now. */
  readonly count = (label: number): number => this.paint.count(label);

  /** As it is to be drawn. @param away  into the screen of the picture that has the keys */
  cutLine(cross: Vec3, away: Vec3): CutLine | undefined {
    return this.tool === "split" ? this.reassign.line(cross, away) : undefined;
  }

  choose(label: number): void {
    if (label !== this.chosen) this.reassign.forget();
    this.chosen = label;
    this.show();
  }

  /** A bone that has no voxels. @return what can be done */
  chooseMissing(label: number): string {
    this.choose(label);
    this.open();
    const marker =
      this.looks === undefined ? "" : "mark it where it lies ({KeyW}) and its border is found, or ";
    return withKeys(`It is in hand: ${marker}paint it ({KeyA}).`);
  }

  private open(): void {
    (this.element as HTMLDetailsElement).open = true;
  }

  private titleOf(label: number): string {
    return boneTitle(nameOfLabel(label, this.count));
  }

  /** What was done, until something else is. */
  private tell(text: string): void {
    setText(this.told, text);
    this.wishes.say(text);
  }

  take(tool: PaintTool | undefined): void {
    this.tool = tool;
    this.reassign.dropLine();
    if (tool !== undefined) {
      this.wishes.taken();
      this.open();
    }
    this.wishes.say(tool === undefined ? "" : (SAID[tool] ?? ""));
    this.show();
  }

  /** @return whether the hand holds something that it did it with */
  press(plane: Plane, mm: Vec3, phase: Phase): boolean {
    const { tool } = this;
    if (tool === undefined) return false;
    if (tool === "split") this.reassign.press(plane, mm, phase);
    else if (tool === "move") this.pressToMove(mm, phase);
    else this.pressToPaint(mm, phase);
    return true;
  }

  private pressToPaint(mm: Vec3, phase: Phase): void {
    if (phase === "down") this.beginStroke(mm);
    else if (this.isPainting) this.stroke?.goOn(mm);
    if (phase === "up") this.endStroke();
    else this.wishes.redraw();
  }

  private pressToMove(mm: Vec3, phase: Phase): void {
    const { stroke } = this;
    if (phase === "down") {
      this.from = stroke?.isLatest === true ? mm : undefined;
      if (this.from === undefined) this.wishes.say(NOTHING_TO_MOVE);
      else stroke?.beginMove();
      return;
    }
    if (stroke === undefined || this.from === undefined) return;
    const offset = along(mm, -1, this.from);
    stroke.moveBy(offset);
    if (phase === "move") {
      this.wishes.redraw();
      return;
    }
    this.from = undefined;
    stroke.endMove(offset);
    this.changed(stroke.kind.grows);
  }

  /** With what is in hand, once, where the crosshair is. @return whether it does anything there */
  dab(plane: Plane, mm: Vec3): boolean {
    if (this.tool === "split") {
      this.reassign.enter(plane, mm);
      return true;
    }
    if (this.tool === "move") {
      const { stroke } = this;
      if (stroke?.isLatest === true) {
        const { middle } = stroke;
        this.pressToMove(middle, "down");
        this.pressToMove(mm, "up");
      } else this.wishes.say(NOTHING_TO_MOVE);
      return true;
    }
    if (this.brush === undefined) return false;
    this.beginStroke(mm);
    this.endStroke();
    return true;
  }

  private beginStroke(mm: Vec3): void {
    const { brush } = this;
    if (brush === undefined) return;
    const { radiusMm, isEraser } = brush;
    const label = isEraser ? 0 : this.chosen;
    const only = isEraser ? this.chosen : undefined;
    this.stroke = new Stroke(
      { radiusMm, label, only, grows: this.tool === "mark" },
      this.paint,
      mm,
    );
    this.isPainting = true;
  }

  private endStroke(): void {
    if (!this.isPainting) return;
    this.isPainting = false;
    this.stroke?.end();
    // Where it changed nothing it marked nothing.
    this.changed(this.stroke?.isLatest === true && this.stroke.kind.grows);
  }

  fill(): void {
    const before = this.paint.count(this.chosen);
    const title = this.titleOf(this.chosen);
    this.paint.fill(this.chosen);
    const filled = this.paint.count(this.chosen) - before;
    if (filled === 0) {
      this.tell(before === 0 ? `${title} has no voxels yet.` : `${title} has no hollow.`);
      return;
    }
    this.changed();
    this.tell(
      `${(filled * voxelVolume(this.labels)).toFixed(0)} mm³ of hollows in ${title} are filled.`,
    );
  }

  undo(): void {
    if (this.paint.undo()) this.changed();
  }

  redo(): void {
    if (this.paint.redo()) this.changed();
  }

  resize(by: number): void {
    this.radius = Math.min(RADII_MM.length - 1, Math.max(0, this.radius + by));
    this.show();
  }

  /** @param grows  by the marker */
  private changed(grows = false): void {
    this.paint.end();
    this.isSaved = false;
    setText(this.told, "");
    this.looks?.changed(grows);
    this.wishes.bonesChanged();
    this.show();
  }

  /** On the host, from the labels as they are now. */
  runAgain(): void {
    const { makeVersion } = this.wishes;
    if (makeVersion === undefined) {
      this.wishes.say("New versions are made by who came by an instructor's link.");
      return;
    }
    const make = async (): Promise<void> => {
      await makeVersion(await packedLabels(this.labels));
    };
    (this.looks === undefined ? make() : this.looks.whileHeld(make)).catch(() => {
      this.wishes.say("The labels could not be packed.");
    });
  }

  /** They are in a case of their own now. */
  keptAsVersion(): void {
    this.isSaved = true;
  }

  save(): void {
    packedLabels(this.labels).then(
      (blob) => {
        const address = URL.createObjectURL(blob);
        make("a", { href: address, download: "labels.nii.gz" }).click();
        setTimeout(() => {
          URL.revokeObjectURL(address);
        }, 10_000);
        this.isSaved = true;
        this.wishes.say(
          "Saved as labels.nii.gz; the case itself is as it was. " +
            "`carpus reconstruct CASE --labels labels.nii.gz --out NEW` makes a new version of it" +
            (this.wishes.makeVersion === undefined ? "." : ", and G does here."),
        );
      },
      () => {
        this.wishes.say("The labels could not be packed.");
      },
    );
  }

  /** @return whether the key was one of these */
  onKey(event: KeyboardEvent): boolean {
    const acts: Readonly<Record<string, () => void>> = {
      KeyA: () => {
        this.take(this.tool === "paint" ? undefined : "paint");
      },
      KeyE: () => {
        this.take(this.tool === "erase" ? undefined : "erase");
      },
      KeyW: () => {
        if (this.looks !== undefined) this.take(this.tool === "mark" ? undefined : "mark");
      },
      KeyV: () => {
        this.take(this.tool === "move" ? undefined : "move");
      },
      KeyK: () => {
        this.take(this.tool === "split" ? undefined : "split");
      },
      KeyZ: () => {
        if (event.shiftKey) this.redo();
        else this.undo();
      },
      KeyY: () => {
        this.redo();
      },
      KeyF: () => {
        this.fill();
      },
      KeyG: () => {
        this.runAgain();
      },
      KeyS: () => {
        this.save();
      },
      Comma: () => {
        this.resize(-1);
      },
      Period: () => {
        this.resize(1);
      },
    };
    const act = acts[event.code];
    act?.();
    return act !== undefined;
  }

  private show(): void {
    for (const tool of TOOLS) {
      this.buttons[tool].setAttribute("aria-pressed", String(this.tool === tool));
    }
    const { count, chosen } = this;
    const title = this.titleOf(chosen);
    setText(this.title, count(chosen) > 0 ? title : `${title} (not there)`);
    this.reassign.show();
    this.undoButton.disabled = !this.paint.canUndo;
    this.redoButton.disabled = !this.paint.canRedo;
    setText(this.size, `${(RADII_MM[this.radius] ?? 1).toFixed(1)} mm`);
    this.wishes.redraw();
  }
}
