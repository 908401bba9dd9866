// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The desk on which a scan lies: four pictures with one crosshair, the bones beside them, the tools above.
import { make, setText } from "../dom";
import type { Vec3 } from "../protocol";
import { BoneList } from "./bone_list";
import { bonesNow, isThere, whyMissing, type BoneNow } from "./bones_now_model";
import { BonesPanel } from "./bones_panel";
import { takeKey, type DeskActs } from "./desk_keys";
import { placeOfLabel } from "./label_place_model";
import type { MeasureKind } from "./measure_model";
import { MeasureTool } from "./measure_tool";
import type { MendedBone } from "./mended_model";
import { NewCaseDialog } from "./new_case_dialog";
import { PaintTools } from "./paint_tools";
import { extentAlong, finestSpacing, heldInside, middleOf, type Volume } from "./nifti_model";
import { along, dot, PLANE_IDS, planesOf, type Alignment, type Plane } from "./planes_model";
import { labelAt, readingAt } from "./reading_model";
import { ScanBar } from "./scan_bar";
import { boneTitle, labelColors, type ScannedCase } from "./scan_case_model";
import { scanHelp } from "./scan_help";
import type { GreyWindow } from "./slice_model";
import { SlicePanel, type Shown } from "./slice_panel";
import { scanAddress } from "./volume_client";
import { draggedWindow, WINDOWS, windowText } from "./window_model";

export interface DeskCase {
  readonly id: string;
  readonly scanned: ScannedCase;
  readonly ct: Volume;
  readonly labels: Volume | undefined;
  readonly ways: readonly HTMLElement[];
  /** Whether who looks at it may make cases here. */
  readonly mayAdd: boolean;
  /** A case was made here. */
  added(id: string): void;
}

const into =
  (line: HTMLElement) =>
  (text: string): void => {
    setText(line, text);
  };

export class ScanDesk {
  readonly element: HTMLElement;
  private readonly colors = labelColors();
  private readonly panels: readonly SlicePanel[];
  private readonly sliders: readonly HTMLInputElement[];
  private bones: BonesPanel | undefined;
  private readonly list: BoneList;
  private readonly help = scanHelp();
  private readonly newCase = new NewCaseDialog((id) => {
    this.mend?.keptAsVersion();
    this.data.added(id);
  });
  private readonly reading = make("output.scan-reading", {
    "aria-label": "At the pointer or the crosshair",
  });
  private readonly said = make("p.scan-said", { role: "status" });
  /** What the host does with the surfaces: on their picture, as it may end while something else is said. */
  private readonly surfaces = make("p.scan-surfaces", { role: "status" });
  private readonly bar: ScanBar;
  private readonly step: number;
  private readonly sizes: ResizeObserver;
  private alignment: Alignment = "wrist";
  private grey: GreyWindow = WINDOWS[0] ?? { centre: 500, width: 2000 };
  private cross: Vec3;
  /** Where the pointer is in a picture; none once the crosshair has moved after it. */
  private pointed: Vec3 | undefined;
  private crossShown = true;
  private labelsShown = true;
  private mmPerPixel = 0.2;
  private readonly measures: MeasureTool;
  private focused: SlicePanel;
  private readonly mend: PaintTools | undefined;
  private isAsked = false;

  constructor(private readonly data: DeskCase) {
    this.measures = new MeasureTool(data.ct);
    this.bar = this.makeBar();
    const planes = this.planes();
    const events = {
      press: this.press.bind(this),
      hover: this.hover.bind(this),
      scroll: this.scroll.bind(this),
      zoom: this.zoom.bind(this),
      window: (right: number, down: number): void => {
        this.setWindow(draggedWindow(this.grey, right, down));
      },
      focus: (panel: SlicePanel): void => {
        this.focused = panel;
      },
    };
    this.panels = PLANE_IDS.map((id) => new SlicePanel(planes[id], events));
    this.focused = this.panels[0] as SlicePanel;
    this.sliders = this.panels.map((panel) => this.slider(panel));
    this.step = finestSpacing(data.ct);
    this.cross = middleOf(data.ct);
    this.list = new BoneList(this.colors, (bone) => {
      this.goTo(bone);
    });
    if (data.labels !== undefined) {
      this.mend = new PaintTools(data.labels, data.scanned.bones, {
        redraw: () => {
          this.ask();
        },
        say: into(this.said),
        makeVersion: data.mayAdd
          ? (labels) => this.newCase.makeVersion(this.data.id, labels)
          : undefined,
        taken: () => {
          this.measures.putDown();
        },
        bonesChanged: () => {
          this.list.show(this.bonesNow());
          this.ask();
        },
        look: data.mayAdd
          ? {
              of: data.id,
              show: this.showMended.bind(this),
              say: into(this.surfaces),
            }
          : undefined,
      });
    }
    this.list.show(this.bonesNow());
    const pictures = make("div.scan-pictures", {}, ...this.panels.map((panel) => panel.element));
    this.element = make(
      "main.scan",
      {},
      this.bar.element,
      pictures,
      make(
        "aside.scan-side",
        { "aria-label": "Bones and measures" },
        this.heading(),
        this.list.element,
        ...(this.mend === undefined ? [] : [this.mend.element]),
        make("div.scan-side-foot", {}, this.reading, this.said),
      ),
      this.help,
      this.newCase.element,
    );
    for (const name of ["dragover", "drop"] as const) {
      this.element.addEventListener(name, (event) => {
        event.preventDefault();
        if (name === "drop" && data.mayAdd) this.newCase.drop(event);
      });
    }
    try {
      this.bones = new BonesPanel((mm) => {
        this.setCross(mm, true);
      });
      this.bones.element.append(this.surfaces);
      pictures.append(this.bones.element);
    } catch {
      pictures.append(make("p.secondary", {}, "This browser draws no 3-D picture."), this.surfaces);
    }
    const acts = this.acts();
    this.element.addEventListener("keydown", (event) => {
      takeKey(event, acts);
    });
    this.sizes = new ResizeObserver(() => {
      this.ask();
    });
    this.sizes.observe(pictures);
  }

  /** Once it is on the page. */
  begin(): void {
    const { id, scanned } = this.data;
    this.fit();
    const [proximal, , volar] = scanned.wristFromPatient;
    const opposite = (v: Vec3): Vec3 => [-v[0], -v[1], -v[2]];
    const colors = scanned.bones.map(({ name, label }) => ({
      name,
      color: this.colors[label] ?? 0xffffff,
    }));
    this.bones
      ?.load(scanAddress(id, "bones.glb"), colors, opposite(proximal), opposite(volar))
      .catch(() => {
        setText(this.surfaces, "The bones' surfaces could not be loaded; the slices are whole.");
      });
    const bones = this.bonesNow().filter(isThere);
    const first =
      bones.find((bone) => bone.flagged) ?? bones.find((bone) => bone.name.startsWith("scaphoid"));
    if (first !== undefined) this.goTo(first);
    else this.setCross(this.cross, true);
    this.focused.canvas.focus({ preventScroll: true });
  }

  dispose(): void {
    this.sizes.disconnect();
    this.bones?.dispose();
    this.mend?.dispose();
    this.newCase.dispose();
  }

  private planes(): ReturnType<typeof planesOf> {
    const { wristFromPatient, side } = this.data.scanned;
    return planesOf(this.alignment, wristFromPatient, side);
  }

  private makeBar(): ScanBar {
    return new ScanBar(
      {
        setWindow: this.setWindow.bind(this),
        toggleLabels: this.toggleLabels.bind(this),
        opacityChanged: () => {
          this.labelsShown = true;
          this.ask();
        },
        measure: this.measure.bind(this),
        turnPlanes: this.turnPlanes.bind(this),
        addScan: this.data.mayAdd
          ? (): void => {
              this.newCase.open();
            }
          : undefined,
        help: () => {
          this.help.showModal();
        },
      },
      this.data.ways,
    );
  }

  private toggleLabels(): void {
    this.labelsShown = !this.labelsShown;
    this.ask();
  }

  private heading(): HTMLElement {
    const { scanned } = this.data;
    const patient = make("p", {}, scanned.pseudonym, ` · ${scanned.side} wrist`);
    if (scanned.simulated) patient.append(" ", make("span.badge", {}, "simulated"));
    const warnings = scanned.warnings.map((text) => make("p.scan-warning", { role: "note" }, text));
    return make("header.scan-heading", {}, make("h1", {}, "Scan"), patient, ...warnings);
  }

  private slider(panel: SlicePanel): HTMLInputElement {
    const input = make("input.scan-slider", {
      type: "range",
      step: "any",
      "aria-label": `Slice, ${panel.planeNow.id}`,
    });
    input.addEventListener("input", () => {
      const { away } = panel.planeNow;
      const by = Number(input.value) - dot(this.cross, away);
      this.setCross(along(this.cross, by, away), false);
    });
    panel.element.append(input);
    return input;
  }

  private press(plane: Plane, mm: Vec3, phase: "down" | "move" | "up"): void {
    if (this.measures.kind !== undefined) {
      this.sayMeasure(this.measures.press(mm, plane.away, phase));
      return;
    }
    if (this.mend?.press(plane, mm, phase) === true) return;
    if (phase === "up") return;
    this.setCross(mm, false, plane);
  }

  private hover(mm: Vec3 | undefined): void {
    this.pointed = mm;
    this.read();
  }

  /** What is at the pointer or at the crosshair, whichever moved last. */
  private read(): void {
    const { ct, labels } = this.data;
    setText(this.reading, readingAt(ct, labels, this.pointed ?? this.cross, this.count));
  }

  private labelAt(mm: Vec3): number {
    return labelAt(this.data.labels, mm);
  }

  /** @param middle  in the middle of all pictures; else they stay where they are */
  private setCross(mm: Vec3, middle: boolean, from?: Plane): void {
    const clamped = heldInside(this.data.ct, mm);
    for (const panel of this.panels) {
      if (middle) panel.pan = [0, 0];
      // In the picture that is pressed nothing may slip away under the pointer.
      else if (panel.planeNow === from) {
        const d = along(clamped, -1, this.cross);
        panel.pan = [
          panel.pan[0] - dot(d, panel.planeNow.right),
          panel.pan[1] - dot(d, panel.planeNow.down),
        ];
      } else panel.keepStill(this.cross, clamped, this.mmPerPixel);
    }
    this.cross = clamped;
    this.pointed = undefined;
    this.ask();
  }

  private scroll(plane: Plane, slices: number): void {
    this.setCross(along(this.cross, slices * this.step, plane.away), false);
  }

  private zoom(factor: number): void {
    this.mmPerPixel = Math.min(1, Math.max(0.01, this.mmPerPixel / factor));
    this.ask();
  }

  private setWindow(grey: GreyWindow): void {
    this.grey = { centre: grey.centre, width: grey.width };
    setText(this.said, windowText(grey));
    this.ask();
  }

  private fit(): void {
    const [across] = this.panels;
    if (across === undefined) return;
    let worst = 0.01;
    for (const panel of this.panels) {
      const { clientWidth: w, clientHeight: h } = panel.canvas;
      const { right, down } = panel.planeNow;
      const [l, r] = extentAlong(this.data.ct, right);
      const [u, d] = extentAlong(this.data.ct, down);
      if (w > 2 && h > 2) worst = Math.max(worst, Math.min((r - l) / w, (d - u) / h));
      panel.pan = [0, 0];
    }
    this.mmPerPixel = worst;
    this.ask();
  }

  /** How many voxels have a label now; without labels, whether the case has the bone. */
  private readonly count = (label: number): number =>
    this.mend?.count(label) ?? this.data.scanned.bones.filter((one) => one.label === label).length;

  /** Those that are missing are there to be painted; where nothing can be, they are left out. */
  private bonesNow(): readonly BoneNow[] {
    const all = bonesNow(this.data.scanned.bones, this.count);
    return this.mend === undefined ? all.filter(isThere) : all;
  }

  private goTo(bone: BoneNow): void {
    const { labels } = this.data;
    const title = boneTitle(bone.name);
    if (!isThere(bone)) {
      setText(
        this.said,
        `${title} ${whyMissing(bone)}. ${this.mend?.chooseMissing(bone.label) ?? ""}`,
      );
      return;
    }
    const mm = labels === undefined ? undefined : placeOfLabel(labels, bone.label);
    const why = bone.why === "" ? "" : `: ${bone.why}`;
    setText(this.said, `${title}${bone.flagged ? why : ""}`);
    this.mend?.choose(bone.label);
    if (mm !== undefined) this.setCross(mm, true);
  }

  private nextBone(by: number): void {
    const bones = this.bonesNow().filter(isThere);
    const now = bones.findIndex((bone) => bone.label === this.labelAt(this.cross));
    const next = bones[(now + by + bones.length) % bones.length];
    if (next !== undefined) this.goTo(next);
  }

  private measure(kind: MeasureKind): void {
    this.mend?.take(undefined);
    setText(this.said, this.measures.toggle(kind));
    this.ask();
  }

  private sayMeasure(told: string | undefined): void {
    if (told !== undefined) setText(this.said, told);
    this.ask();
  }

  private turnPlanes(): void {
    this.alignment = this.alignment === "wrist" ? "scan" : "wrist";
    const planes = this.planes();
    for (const panel of this.panels) panel.setPlane(planes[panel.planeNow.id]);
    const how = this.alignment === "wrist" ? "along the wrist" : "as scanned";
    setText(this.said, `Planes lie ${how}.`);
    this.ask();
  }

  private acts(): DeskActs {
    return {
      isAway: () => this.help.open || this.newCase.element.open,
      shiftPicture: (right, down) => {
        this.focused.shift(right, down);
      },
      moveCross: (rightMm, downMm) => {
        const { right, down } = this.focused.planeNow;
        this.setCross(along(along(this.cross, rightMm, right), downMm, down), false);
      },
      scroll: (slices) => {
        this.scroll(this.focused.planeNow, slices);
      },
      zoom: this.zoom.bind(this),
      fit: this.fit.bind(this),
      atCross: this.atCross.bind(this),
      mend: (event) => this.mend?.onKey(event) === true,
      window: (which) => {
        this.setWindow(WINDOWS[which] ?? this.grey);
      },
      changeOpacity: this.changeOpacity.bind(this),
      toggleLabels: this.toggleLabels.bind(this),
      toggleCross: () => {
        this.crossShown = !this.crossShown;
        this.ask();
      },
      nextBone: this.nextBone.bind(this),
      measure: this.measure.bind(this),
      dropMeasure: () => {
        this.measures.dropLast();
        this.ask();
      },
      turnPlanes: this.turnPlanes.bind(this),
      putDown: () => {
        this.measures.putDown();
        this.mend?.take(undefined);
        setText(this.said, "");
        this.ask();
      },
      help: () => {
        this.help.showModal();
      },
    };
  }

  /** With what is in hand. */
  private atCross(): boolean {
    const { planeNow } = this.focused;
    if (this.measures.kind === undefined) return this.mend?.dab(planeNow, this.cross) === true;
    this.sayMeasure(this.measures.addByKey(this.cross, planeNow.away));
    return true;
  }

  private showMended(bones: readonly MendedBone[], glb: ArrayBuffer | undefined): void {
    const mended = bones.map(({ name, label }) => ({
      name,
      color: this.colors[label] ?? 0xffffff,
    }));
    this.bones?.mend(mended, glb).catch(() => {
      setText(this.surfaces, "The mended surface could not be shown; the slices are right.");
    });
    this.ask();
  }

  private changeOpacity(by: number): void {
    this.labelsShown = true;
    this.bar.changeOpacity(by);
    this.ask();
  }

  /** Once, before the next picture on the screen. */
  private ask(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      if (this.element.isConnected) this.draw();
    });
  }

  private draw(): void {
    const { ct, labels } = this.data;
    const { away } = this.focused.planeNow;
    const shown: Shown = {
      ct,
      labels: this.labelsShown ? labels : undefined,
      grey: this.grey,
      overlay: { colors: this.colors, opacity: this.bar.opacity },
      cross: this.cross,
      crossShown: this.crossShown,
      measures: this.measures.shown(this.cross, away),
      mmPerPixel: this.mmPerPixel,
      brush: this.measures.kind === undefined ? this.mend?.brush : undefined,
      cut: this.mend?.cutLine(this.cross, away),
    };
    this.panels.forEach((panel, i) => {
      panel.draw(shown);
      const slider = this.sliders[i];
      if (slider === undefined) return;
      const [low, high] = extentAlong(ct, panel.planeNow.away);
      slider.min = low.toFixed(2);
      slider.max = high.toFixed(2);
      slider.value = dot(this.cross, panel.planeNow.away).toFixed(2);
    });
    this.bones?.setCross(this.cross, this.crossShown);
    this.list.mark(this.labelAt(this.cross), this.mend?.chosen);
    this.read();
    this.bar.show({
      grey: this.grey,
      labelsShown: this.labelsShown,
      measure: this.measures.kind,
      alignment: this.alignment,
    });
  }
}
