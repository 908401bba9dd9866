// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An arthroscopy on the page: the scope's picture as the main monitor with the theatre beside it as a
// panorama, and keys and mouse that lead what is in the portals. The host owns the truth: where a tip
// really is, where the scope looks and what was seen, it says.
import { button, make } from "../dom";
import type {
  ExerciseMessage,
  ScopeMessage,
  SheetMessage,
  SkinMessage,
  SnapshotMessage,
} from "../protocol";
import { add, dot, scaled, subtract } from "../tool_placement";
import { FindingsDialog } from "./findings_dialog";
import { FocusControls } from "./focus_controls";
import { FluidControls } from "./fluid_controls";
import { settingOf, type FluidAct, type FluidSetting } from "./fluid_model";
import { forcesInJoint, gradeOf, type ForceGrade } from "./force_limits";
import { ScopeDrillOverlay } from "./scope_drill";
import { beadsOf } from "./scope_drill_model";
import { makeScopeControls, offerScopeAids, WHY_NO_AID } from "./scope_controls";
import type { JointWall } from "./joint_wall";
import type { HandIndex } from "./scope_hands";
import { focusBy, type ScopeAct } from "./scope_keys";
import { ScopeLeading, type LeadingRoom } from "./scope_leading";
import { listenForScope, type ScopeAsked } from "./scope_listening";
import { PicturePace } from "./picture_pace";
import { ScopePicture } from "./scope_picture";
import { cutPlaces, DISC_JOINT, isAtScope, makesPortal, type Plan } from "./scope_plan";
import { ScopeReadings } from "./scope_readings";
import { hasJaws, type ToolKind } from "./scope_tools";
import type { SecondLead } from "./second_lead";
import "./scope.css";
import "./scope_small.css";

export interface ScopeRoom extends LeadingRoom {
  /** Where the picture goes: over the theatre. */
  readonly stage: HTMLElement;
  answer(finding: string, grade: string): void;
  setFluid(setting: FluidSetting): void;
  /** That mouse and keys move, also where nothing of the scope's is led. */
  activeHand(): HandIndex;
  /** It leads the other hand. */
  hasGamepad(): boolean;
}

/** Within it the host answers what was asked of the fluid. */
const ANSWERED_MS = 5000;

export class ScopeDesk {
  readonly element = make("section.scope", { "aria-label": "Arthroscope" });
  /** Under the picture. */
  readonly controls: HTMLElement;
  private readonly findings: FindingsDialog;
  private readonly readings = new ScopeReadings();
  private readonly drill = new ScopeDrillOverlay();
  private readonly fluid = new FluidControls((act) => {
    this.actOnFluid(act);
  });
  /** A wish of whoever looks at this page: the host is not told, and counts as seen what it would else. */
  private readonly focus = new FocusControls((step) => {
    this.picture?.setFocus(step);
  });
  private picture: ScopePicture | undefined;
  private readonly pace = new PicturePace();
  private plan: Plan | undefined;
  private exercise: ExerciseMessage | undefined;
  private scope: ScopeMessage | undefined;
  private snapshot: SnapshotMessage | undefined;
  /** Joints whose wall lies as the bones do now: only one that is looked at is laid. */
  private readonly posed = new Set<string>();
  private readonly leading: ScopeLeading;
  private inflow = { mmhg: 0, askedMs: -Infinity };
  /** What is said and done while it stands beside the skin that a hand works on. */
  private readonly beside = make(
    "div.scope-beside",
    {},
    make("strong", {}, "Scope, live"),
    button("Change places", "7", () => {
      this.act("panorama");
    }),
  );
  private hasPanorama = true;
  private isThere = false;
  /** Its portals are made in the exercise: there is no scope to be led before. */
  private makesPortals = false;
  private skin: SkinMessage | undefined;
  private isShown = false;
  private wasOn = false;
  /** Beside the skin: it is the large one. */
  private isLarge = false;
  /** Of the scope's rounded tip. */
  private radiusMm = 1;

  constructor(
    private readonly room: ScopeRoom,
    private readonly walls: readonly JointWall[],
    signal: AbortSignal,
  ) {
    this.leading = new ScopeLeading(room, () => {
      this.showPoints();
    });
    this.controls = makeScopeControls({
      hold: (holder, motion) => {
        if (this.room.operates()) this.leading.press(holder, motion);
      },
      letGo: (holder) => {
        this.leading.letGo(holder);
      },
      act: (act) => {
        this.act(act);
      },
      pull: (byN) => {
        this.room.pull(byN);
      },
    });
    this.findings = new FindingsDialog((finding, grade) => {
      this.room.answer(finding, grade);
    });
    this.controls.append(this.focus.ring, this.fluid.taps);
    this.readings.column.children[0]?.after(this.fluid.reading, this.focus.reading);
    this.element.append(
      this.readings.column,
      this.drill.element,
      this.readings.words,
      this.readings.press,
      this.beside,
      this.findings.element,
    );
    this.controls.hidden = true;
    this.element.hidden = true;
    listenForScope(this.element, this.asked(), signal);
  }

  /** Whether mouse and keys lead at the scope. Where portals are made, that is so while their hand works there. */
  get isOn(): boolean {
    const { plan, snapshot } = this;
    if (!this.isThere || !this.makesPortals) return this.isThere;
    if (snapshot === undefined || (plan?.portals.length ?? 0) === 0) return false;
    return isAtScope(snapshot.items, this.exercise?.instruments ?? [], this.room.activeHand());
  }

  /** A hand works on skin while the other one holds the scope. */
  private get isBeside(): boolean {
    return this.isShown && !this.isOn;
  }

  /** What the host said of it last. */
  get told(): ScopeMessage | undefined {
    return this.scope;
  }

  /** How hard the hands press in a joint, of what was told last. */
  get pressGrade(): ForceGrade {
    const { scope, snapshot } = this;
    if (!this.isShown || scope === undefined || snapshot === undefined) return "good";
    return gradeOf(Math.max(...forcesInJoint(scope, snapshot)));
  }

  begin(exercise: ExerciseMessage): void {
    this.exercise = exercise;
    this.plan = exercise.arthroscopy ?? undefined;
    this.scope = undefined;
    this.snapshot = undefined;
    this.leading.begin(exercise);
    this.inflow = { mmhg: 0, askedMs: -Infinity };
    this.isThere = this.plan !== undefined && this.walls.length > 0;
    this.makesPortals = this.isThere && this.plan?.portals.length === 0;
    this.skin = undefined;
    this.wasOn = this.isLarge = false;
    this.arrange(undefined);
    offerScopeAids(this.controls, this.isAssessed);
    if (!this.isThere || this.plan === undefined) return;
    if (this.picture === undefined) {
      this.picture = new ScopePicture(this.walls);
      this.element.prepend(this.picture.canvas, this.picture.lost);
    }
    this.picture.setField(this.plan.field_deg);
    this.picture.setInstruments(exercise.instruments);
    const bodies = exercise.bodies.map((one) => one.name);
    this.picture.setWrong(this.plan.lesions, this.plan.pieces, bodies);
    this.picture.setScrew(this.plan.screw, bodies);
    this.picture.setBeads([]);
    this.focus.reset();
    this.findings.set(this.plan.findings, this.plan.screw);
    for (const wall of this.walls) wall.setSheets(this.plan.sheets, bodies);
    this.controls.classList.toggle("asks", this.plan.findings.length > 0);
    this.showTool();
    const scope = exercise.instruments.find((one) => one.id === this.plan?.scope);
    this.radiusMm = scope?.parts.find((part) => part.end_radius_mm > 0)?.end_radius_mm ?? 1;
    this.showPoints();
  }

  /** What stands where: one of scope and theatre is large, the other, if it is there, small beside it. */
  private arrange(snapshot: SnapshotMessage | undefined): void {
    const { stage } = this.room;
    const { isOn } = this;
    const isHeld = snapshot?.items.some(
      (one) => one.hand >= 0 && one.instrument === this.plan?.scope,
    );
    this.isShown = isOn || (this.makesPortals && isHeld === true);
    const isInset = this.isShown && !isOn && !this.isLarge;
    this.element.hidden = !this.isShown;
    this.controls.hidden = !isOn;
    this.beside.hidden = !this.isBeside;
    this.element.classList.toggle("is-beside", this.isBeside);
    this.element.classList.toggle("is-inset", isInset);
    stage.classList.toggle("is-panorama", this.isShown && !isInset);
    stage.classList.toggle("is-worked-on", this.isBeside && !isInset);
    stage.hidden = isOn && (this.isAssessed || !this.hasPanorama);
  }

  /** The skin, and portals as they were made. */
  seeSkin(message: SkinMessage): void {
    if (!this.makesPortals || this.plan === undefined) return;
    this.skin = message;
    this.plan = { ...this.plan, portals: message.ways };
    this.leading.hands.setPortals(message.ways);
  }

  /** A hand that holds the scope leads it from here; one that works on skin, from there. */
  private followHands(snapshot: SnapshotMessage): void {
    const isHeld = snapshot.items.some(
      (item) => item.hand >= 0 && item.instrument === this.plan?.scope,
    );
    if (!isHeld) {
      this.scope = undefined; // once it is taken again the host tells where it is
      this.leading.forgetScope();
    }
    this.arrange(snapshot);
    const { isOn } = this;
    if (isOn === this.wasOn) return;
    this.wasOn = isOn;
    this.leading.beginAnew();
    if (!isOn) return;
    this.leading.hands.moved = this.room.activeHand();
    this.showPoints();
  }

  /** Name of what works on skin in the hand beside the scope. */
  private get toolOnSkin(): string {
    if (!this.makesPortals) return "";
    const instruments = this.exercise?.instruments ?? [];
    const held = this.snapshot?.items.find(
      (item) => item.hand >= 0 && makesPortal(item.instrument, instruments),
    );
    const name = instruments.find((one) => one.id === held?.instrument)?.name;
    return name === undefined ? "" : name.charAt(0).toLowerCase() + name.slice(1);
  }

  /** The controls that it has. */
  private showTool(): void {
    this.controls.classList.toggle("grasps", hasJaws(this.leading.tool));
    this.controls.classList.toggle("shaves", this.leading.tool === "shaver");
  }

  /** Without aids. */
  private get isAssessed(): boolean {
    return this.exercise?.mode === "assessed";
  }

  private get moved(): HandIndex {
    return this.leading.hands.moved;
  }

  /** The joint that the scope's portal leads into. */
  private get joint(): string {
    const hand = this.scope?.hand === 1 ? 1 : 0;
    return this.leading.hands.portalOf(hand)?.joint ?? "";
  }

  private showPoints(): void {
    if (this.plan !== undefined) this.readings.showPoints(this.plan, this.scope, this.joint);
  }

  see(snapshot: SnapshotMessage): void {
    if (this.plan === undefined) return;
    this.snapshot = snapshot;
    if (this.makesPortals) this.followHands(snapshot);
    if (snapshot.bodies !== null) {
      this.posed.clear(); // the scope's joint is laid when it is drawn
    }
    this.leading.see(snapshot);
  }

  seeScope(message: ScopeMessage): void {
    const before = this.scope?.points_seen.length;
    if (this.hasCutDisc(message)) this.cutDisc(message.pieces_left);
    this.scope = message;
    this.leading.seeScope(message);
    this.findings.see(message.answers);
    if (before !== message.points_seen.length) this.showPoints();
  }

  private hasCutDisc({ pieces_left: left }: ScopeMessage): boolean {
    if (this.plan?.pieces[0]?.kind !== "disc") return false;
    const before = this.scope?.pieces_left;
    return left.some((percent, i) => percent === 0 && before?.[i] !== 0);
  }

  private cutDisc(left: readonly number[]): void {
    const { plan } = this;
    if (plan === undefined) return;
    this.walls.find((one) => one.joint === DISC_JOINT)?.cutDisc(cutPlaces(plan, left));
    this.posed.delete(DISC_JOINT);
  }

  seeSheet({ sheet, off_um: offUm }: SheetMessage): void {
    for (const wall of this.walls) {
      if (wall.yieldSheet(sheet, offUm)) this.posed.delete(wall.joint);
    }
  }

  /** Once per frame: what is held goes on, the newest wishes are sent. */
  frame(nowMs: number): void {
    if (!this.isOn) return;
    // Hands may have been exchanged since the host was heard of last.
    if (this.makesPortals && this.snapshot !== undefined) this.followHands(this.snapshot);
    this.leading.frame(nowMs);
  }

  /** Whoever leads the hand that mouse and keys do not. */
  get second(): SecondLead {
    return this.leading.second;
  }

  /** @param steps  nearer or, below 0, farther */
  turnFocus(steps: number): void {
    if (this.isOn) this.focus.turn(steps);
  }

  draw(): void {
    const { picture, plan, scope, snapshot } = this;
    if (!this.isShown || picture === undefined) return;
    if (plan === undefined || snapshot === undefined) return;
    const item = snapshot.items.find((one) => one.hand === (scope?.hand ?? 0));
    if (item === undefined || scope === undefined) return;
    const other = snapshot.items.find((one) => one.hand === 1 - scope.hand);
    // The lens lies in the middle of the rounded tip.
    const eyeMm = add(item.tip_mm, scaled(item.shaft, this.radiusMm));
    const hand: HandIndex = scope.hand === 1 ? 1 : 0;
    const portal = this.leading.hands.portalNowOf(hand);
    const isOutside =
      portal !== undefined &&
      scope.in_joint[hand] !== 1 &&
      dot(subtract(eyeMm, portal.skinMm), portal.inwards) < 0;
    const { joint } = this;
    if (!this.posed.has(joint)) {
      this.walls.find((wall) => wall.joint === joint)?.pose(this.leading.hands.poses);
      picture.lay(joint, this.leading.hands.poses);
      this.posed.add(joint);
    }
    const box = picture.canvas.getBoundingClientRect();
    const sidePx = Math.min(box.width, box.height) * Math.min(1, window.devicePixelRatio);
    picture.setFluid(scope.fluid, portal?.up ?? plan.distal);
    picture.draw(
      joint,
      {
        eyeMm,
        axis: scope.axis,
        up: scope.up,
      },
      other === undefined
        ? undefined
        : this.leading.tools.rod(other, scope, portal?.up ?? plan.distal, picture.nowMs, this.skin),
      scope,
      this.pace.pixels(sidePx, performance.now()),
      isOutside ? portal : undefined,
    );
  }

  /** Readings, ten times a second. */
  showReadings(): void {
    const { scope, snapshot, plan } = this;
    if (!this.isShown || plan === undefined) return;
    const wanted = this.leading.hands.portalOf(0)?.name ?? "";
    this.readings.show({
      plan,
      scope,
      snapshot,
      moved: this.makesPortals ? this.room.activeHand() : this.moved,
      onSkin: this.toolOnSkin,
      hasGamepad: this.room.hasGamepad(),
      wanted,
      tool: this.leading.tool,
    });
    this.showTool();
    this.showDrill(plan, scope);
    this.fluid.show(scope?.fluid ?? null);
    const budget = this.picture?.budget;
    this.element.dataset["calls"] = String(budget?.calls ?? 0);
    this.element.dataset["triangles"] = String(budget?.triangles ?? 0);
  }

  private showDrill(plan: Plan, scope: ScopeMessage | undefined): void {
    const state = scope?.drill ?? null;
    this.drill.show(plan, plan.drill, state, scope?.in_joint[scope.hand] === 1);
    if (plan.drill === null || state === null) return;
    const helps = this.exercise?.mode === "practice";
    this.picture?.setBeads(beadsOf(plan, plan.drill, state, helps));
  }

  dispose(): void {
    this.picture?.dispose();
  }

  private act(act: ScopeAct): void {
    if (this.isBeside && act === "panorama") {
      this.isLarge = !this.isLarge;
      this.arrange(this.snapshot);
      return;
    }
    if (!this.isOn) return;
    if (this.isAssessed && (act === "panorama" || act === "level")) {
      this.room.say(WHY_NO_AID[act]);
      return;
    }
    switch (act) {
      case "panorama":
        this.hasPanorama = !this.hasPanorama;
        this.arrange(this.snapshot);
        return;
      case "findings":
        this.findings.open(this.scope?.answers ?? []);
        return;
      case "jaws":
        this.leading.setJaws(this.moved, undefined);
        return;
      case "level":
        this.leading.level();
        return;
      case "next_portal":
        this.leading.goToNextPortal(this.moved);
        return;
      case "switch_hand":
        this.leading.switchHands();
        return;
      case "focus_nearer":
      case "focus_farther":
        this.focus.turn(focusBy(act));
    }
  }

  /** Of keys and mouse. */
  private asked(): ScopeAsked {
    const takesKeys = (): boolean => this.isOn && this.room.operates();
    const isBeside = (): boolean => this.isBeside;
    const tool = (): ToolKind => this.leading.tool;
    const hasFluid = (): boolean => (this.scope?.fluid ?? null) !== null;
    return {
      takesKeys,
      isBeside,
      get tool() {
        return tool();
      },
      get hasFluid() {
        return hasFluid();
      },
      press: (holder, motion) => {
        this.leading.press(holder, motion);
      },
      letGo: (holder) => {
        this.leading.letGo(holder);
      },
      letGoOfAll: () => {
        this.leading.letGoOfAll();
      },
      act: (act) => {
        this.act(act);
      },
      actOnFluid: (act) => {
        this.actOnFluid(act);
      },
      lean: (lead, yawRad, pitchRad) => {
        if (this.isOn) this.leading.leanBy(lead, yawRad, pitchRad);
      },
      turn: (deg) => {
        if (this.isOn) this.leading.turnHeld(deg);
      },
      advance: (mm) => {
        if (this.isOn) this.leading.advance(mm);
      },
    };
  }

  private actOnFluid(act: FluidAct): void {
    const fluid = this.scope?.fluid ?? null;
    if (fluid === null || !this.room.operates()) return;
    // What was asked for and not answered yet counts: keys come faster than the host's word.
    const isAsked = performance.now() - this.inflow.askedMs < ANSWERED_MS;
    const now = isAsked ? { ...fluid, inflow_mmhg: this.inflow.mmhg } : fluid;
    const setting = settingOf(act, now);
    if (setting === undefined) return;
    if (setting.control === "inflow") {
      this.inflow = { mmhg: setting.value * fluid.step_mmhg, askedMs: performance.now() };
    }
    this.room.setFluid(setting);
  }
}
