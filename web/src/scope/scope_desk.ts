// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An arthroscopy on the page: the scope's picture as the main monitor with the theatre beside it as a
// panorama, and keys and mouse that lead what is in the portals. The host owns the truth: where a tip
// really is, where the scope looks and what was seen, it says.
import { make } from "../dom";
import type {
  ExerciseMessage,
  HandMessage,
  ScopeMessage,
  SheetMessage,
  SnapshotMessage,
} from "../protocol";
import { add, dot, scaled, subtract } from "../tool_placement";
import { FindingsDialog } from "./findings_dialog";
import { FluidControls } from "./fluid_controls";
import { settingOf, type FluidAct, type FluidSetting } from "./fluid_model";
import { ScopeDrillOverlay } from "./scope_drill";
import { beadsOf } from "./scope_drill_model";
import { makeScopeControls } from "./scope_controls";
import type { JointWall } from "./joint_wall";
import { wrappedDeg } from "./scope_hand_model";
import { ScopeHands, type HandIndex } from "./scope_hands";
import type { ScopeAct, ScopeMotion } from "./scope_keys";
import { listenForScope, type ScopeAsked } from "./scope_listening";
import { ScopePicture } from "./scope_picture";
import { cutPlaces, DISC_JOINT, type Plan } from "./scope_plan";
import { ScopeReadings } from "./scope_readings";
import { hasJaws, ScopeTools, type ToolKind } from "./scope_tools";
import "./scope.css";

export interface ScopeRoom {
  /** Where the picture goes: over the theatre. */
  readonly stage: HTMLElement;
  operates(): boolean;
  send(hand: Omit<HandMessage, "type" | "sequence">): void;
  turn(shaftDeg: number, cameraDeg: number): void;
  turnMouth(hand: HandIndex, mouthDeg: number): void;
  take(instrument: string, hand: HandIndex): void;
  /** @param byN  more traction, or less */
  pull(byN: number): void;
  answer(finding: string, grade: string): void;
  setFluid(setting: FluidSetting): void;
  say(text: string): void;
  /** Mouse and keys move this hand from now on. */
  showHand(hand: HandIndex): void;
}

const LEAN_RAD_PER_S = (28 * Math.PI) / 180;
const TURN_DEG_PER_S = 75;
const REPEAT_MS = 200;
/** A pedal that is held is told again before the host takes it for let go. */
const PEDAL_REPEAT_MS = 40;
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
  private picture: ScopePicture | undefined;
  private plan: Plan | undefined;
  private exercise: ExerciseMessage | undefined;
  private scope: ScopeMessage | undefined;
  private snapshot: SnapshotMessage | undefined;
  /** Joints whose wall lies as the bones do now: only one that is looked at is laid. */
  private readonly posed = new Set<string>();
  private readonly hands = new ScopeHands();
  private readonly tools = new ScopeTools();
  private inflow = { mmhg: 0, askedMs: -Infinity };
  private shaftDeg = 0;
  private cameraDeg = 0;
  private isPlaced = false;
  private changed = true;
  private turned = false;
  private lastMs = 0;
  private lastSentMs = -Infinity;
  private readonly keys = new Map<string, ScopeMotion>();
  private hasPanorama = true;
  /** Of the scope's rounded tip. */
  private radiusMm = 1;

  constructor(
    private readonly room: ScopeRoom,
    private readonly walls: readonly JointWall[],
    signal: AbortSignal,
  ) {
    this.controls = makeScopeControls({
      hold: (holder, motion) => {
        if (this.room.operates()) this.press(holder, motion);
      },
      letGo: (holder) => {
        this.letGo(holder);
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
    this.controls.append(this.fluid.taps);
    this.readings.column.children[0]?.after(this.fluid.reading);
    this.element.append(
      this.readings.column,
      this.drill.element,
      this.readings.words,
      this.findings.element,
    );
    this.controls.hidden = true;
    this.element.hidden = true;
    listenForScope(this.element, this.asked(), signal);
  }

  /** Whether the exercise is led from here. */
  get isOn(): boolean {
    return this.plan !== undefined;
  }

  /** What the host said of it last. */
  get told(): ScopeMessage | undefined {
    return this.scope;
  }

  begin(exercise: ExerciseMessage): void {
    this.exercise = exercise;
    this.plan = exercise.arthroscopy ?? undefined;
    this.isPlaced = false;
    this.scope = undefined;
    this.snapshot = undefined;
    this.hands.begin(exercise);
    this.tools.begin(exercise);
    this.inflow = { mmhg: 0, askedMs: -Infinity };
    this.shaftDeg = this.cameraDeg = 0;
    this.keys.clear();
    const isOn = this.plan !== undefined && this.walls.length > 0;
    this.element.hidden = this.controls.hidden = !isOn;
    this.room.stage.classList.toggle("is-panorama", isOn);
    this.room.stage.hidden = isOn && !this.hasPanorama;
    if (!isOn || this.plan === undefined) return;
    if (this.picture === undefined) {
      this.picture = new ScopePicture(this.walls);
      this.element.prepend(this.picture.canvas);
    }
    this.picture.setField(this.plan.field_deg);
    const bodies = exercise.bodies.map((one) => one.name);
    this.picture.setWrong(this.plan.lesions, this.plan.pieces, bodies);
    this.picture.setScrew(this.plan.screw, bodies);
    this.picture.setBeads([]);
    this.findings.set(this.plan.findings, this.plan.screw);
    for (const wall of this.walls) wall.setSheets(this.plan.sheets, bodies);
    this.controls.classList.toggle("asks", this.plan.findings.length > 0);
    this.showTool();
    const scope = exercise.instruments.find((one) => one.id === this.plan?.scope);
    this.radiusMm = scope?.parts.find((part) => part.end_radius_mm > 0)?.end_radius_mm ?? 1;
    this.showPoints();
  }

  /** Of what works beside the scope, or will. */
  private get tool(): ToolKind {
    return this.tools.kindOf(this.heldIn(this.scope?.hand === 1 ? 0 : 1));
  }

  private heldIn(hand: HandIndex): string | undefined {
    return this.snapshot?.items.find((one) => one.hand === hand)?.instrument;
  }

  /** The controls that it has. */
  private showTool(): void {
    this.controls.classList.toggle("grasps", hasJaws(this.tool));
    this.controls.classList.toggle("shaves", this.tool === "shaver");
  }

  private get moved(): HandIndex {
    return this.hands.moved;
  }

  /** The joint that the scope's portal leads into. */
  private get joint(): string {
    const hand = this.scope?.hand === 1 ? 1 : 0;
    return this.hands.portalOf(hand)?.joint ?? "";
  }

  private showPoints(): void {
    if (this.plan !== undefined) this.readings.showPoints(this.plan, this.scope, this.joint);
  }

  see(snapshot: SnapshotMessage): void {
    if (this.plan === undefined) return;
    this.snapshot = snapshot;
    if (snapshot.bodies !== null) {
      this.hands.poses = snapshot.bodies;
      this.posed.clear(); // the scope's joint is laid when it is drawn
    }
    if (this.isPlaced) this.hands.holdBack(snapshot.items);
  }

  seeScope(message: ScopeMessage): void {
    const before = this.scope?.points_seen.length;
    if (this.hasCutDisc(message)) this.cutDisc(message.pieces_left);
    this.scope = message;
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

  /** Once per frame: what is held goes on, the newest wish is sent, the picture drawn. */
  frame(nowMs: number): void {
    const seconds = Math.min(0.1, Math.max(0, (nowMs - this.lastMs) / 1000));
    this.lastMs = nowMs;
    if (this.plan === undefined || !this.room.operates()) return;
    this.place();
    if (this.hands.goRound(this.snapshot?.items ?? [])) this.changed = true;
    for (const motion of this.keys.values()) this.move(motion, seconds);
    if (this.turned) {
      this.turned = false;
      this.room.turn(this.shaftDeg, this.cameraDeg);
    }
    const runs = this.tool === "shaver" && this.driverNow() === "forward";
    const repeatMs = runs ? PEDAL_REPEAT_MS : REPEAT_MS;
    if (!this.isPlaced || (!this.changed && nowMs - this.lastSentMs < repeatMs)) return;
    this.changed = false;
    this.lastSentMs = nowMs;
    this.sendHand();
  }

  private sendHand(): void {
    const { wish } = this.hands;
    if (wish === undefined) return;
    this.room.send({
      hand: this.moved,
      tip_mm: wish.tipMm,
      shaft: wish.shaft,
      thrust_n: 0,
      driver: this.driverNow(),
      guidance: "planned",
    });
  }

  draw(): void {
    const { picture, plan, scope, snapshot } = this;
    if (picture === undefined || plan === undefined || snapshot === undefined) return;
    const item = snapshot.items.find((one) => one.hand === (scope?.hand ?? 0));
    if (item === undefined || scope === undefined) return;
    const other = snapshot.items.find((one) => one.hand === 1 - scope.hand);
    // The lens lies in the middle of the rounded tip.
    const eyeMm = add(item.tip_mm, scaled(item.shaft, this.radiusMm));
    const hand: HandIndex = scope.hand === 1 ? 1 : 0;
    const portal = this.hands.portalNowOf(hand);
    const isOutside =
      portal !== undefined &&
      scope.in_joint[hand] !== 1 &&
      dot(subtract(eyeMm, portal.skinMm), portal.inwards) < 0;
    const { joint } = this;
    if (!this.posed.has(joint)) {
      this.walls.find((wall) => wall.joint === joint)?.pose(this.hands.poses);
      picture.lay(joint, this.hands.poses);
      this.posed.add(joint);
    }
    const box = picture.canvas.getBoundingClientRect();
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
        : this.tools.rod(other, scope, portal?.up ?? plan.distal, picture.nowMs),
      scope,
      Math.min(box.width, box.height) * Math.min(1, window.devicePixelRatio),
      isOutside ? portal : undefined,
    );
  }

  /** Readings, ten times a second. */
  showReadings(): void {
    const { scope, snapshot, plan } = this;
    if (plan === undefined) return;
    const wanted = this.hands.portalOf(0)?.name ?? "";
    this.readings.show({ plan, scope, snapshot, moved: this.moved, wanted, tool: this.tool });
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

  private takeTools(): void {
    const { snapshot } = this;
    this.tools.take(
      this.scope,
      (hand) => snapshot?.items.some((one) => one.hand === hand) ?? false,
    );
  }

  private driverNow(): HandMessage["driver"] {
    const pedalIsDown = [...this.keys.values()].some((motion) => motion.kind === "run");
    return this.tools.driver(this.moved, this.heldIn(this.moved), pedalIsDown);
  }

  /** The hand begins where the host has the scope. */
  private place(): void {
    if (this.isPlaced || this.snapshot === undefined || this.hands.poses.length === 0) return;
    this.hands.place(this.snapshot.items);
    if (this.scope !== undefined) {
      this.shaftDeg = this.scope.shaft_deg;
      this.cameraDeg = this.scope.camera_deg;
      this.takeTools();
    }
    this.isPlaced = true;
  }

  private move(motion: ScopeMotion, seconds: number): void {
    switch (motion.kind) {
      case "lean": {
        // The hand goes the other way than the tip.
        const by = LEAN_RAD_PER_S * seconds;
        this.lean(motion.yaw * by, motion.pitch * by);
        return;
      }
      case "advance":
        if (this.hands.advanceFor(motion.by * seconds)) this.changed = true;
        return;
      case "turn_shaft":
        this.turnHeld(motion.by * TURN_DEG_PER_S * seconds);
        return;
      case "turn_camera":
        this.turnBy(0, motion.by * TURN_DEG_PER_S * seconds);
        return;
      case "run": // told with the hand
    }
  }

  /** The scope's shaft; or the shaver, where that is in the hand that is led. */
  private turnHeld(deg: number): void {
    const held = this.snapshot?.items.find((one) => one.hand === this.moved);
    if (!this.tools.hasMouth(held?.instrument)) {
      this.turnBy(deg, 0);
      return;
    }
    this.room.turnMouth(this.moved, this.tools.turnMouth(this.moved, deg));
  }

  private lean(yaw: number, pitch: number): void {
    this.hands.lean(yaw, pitch);
    this.changed = true;
  }

  private turnBy(shaftDeg: number, cameraDeg: number): void {
    this.shaftDeg = wrappedDeg(this.shaftDeg + shaftDeg);
    this.cameraDeg = wrappedDeg(this.cameraDeg + cameraDeg);
    this.turned = true;
  }

  private act(act: ScopeAct): void {
    const { plan, snapshot } = this;
    if (plan === undefined) return;
    switch (act) {
      case "panorama":
        this.hasPanorama = !this.hasPanorama;
        this.room.stage.hidden = !this.hasPanorama;
        return;
      case "findings":
        this.findings.open(this.scope?.answers ?? []);
        return;
      case "jaws": {
        const held = snapshot?.items.find((one) => one.hand === this.moved);
        if (held === undefined || !this.tools.hasJaws(held.instrument)) {
          this.room.say("This hand holds nothing with jaws: take it in the other hand first.");
          return;
        }
        this.tools.turnJaws(this.moved);
        this.changed = true;
        return;
      }
      case "level":
        // Up in the picture is distal where the camera head is not turned.
        this.turnBy(0, -this.cameraDeg);
        return;
      case "next_portal": {
        // The host's word counts: it may have drawn the tip farther out than the page wished, or less.
        const isIn = (this.scope?.portals[this.moved] ?? "") !== "";
        if (isIn) {
          this.room.say("Draw it out of this portal first.");
          return;
        }
        this.hands.goToNextPortal();
        this.changed = true;
        this.showPoints();
        const next = this.hands.portalOf(this.moved);
        this.room.say(`${next?.name ?? ""}: ${next?.landmarks ?? ""}.`);
        return;
      }
      case "switch_hand": {
        this.keys.clear();
        if (this.isPlaced) this.sendHand(); // a pedal that was down is let go with the hand
        this.hands.moved = this.moved === 0 ? 1 : 0;
        this.takeTools();
        this.room.showHand(this.moved);
        this.changed = true;
        const isEmpty = !(snapshot?.items.some((one) => one.hand === this.moved) ?? false);
        const probe = this.exercise?.tray.at(-1);
        if (this.moved === 1 && isEmpty && probe !== undefined) {
          // The hand is there before it takes anything: it comes in from behind, through no bone.
          this.sendHand();
          this.room.take(probe, 1);
          const portal = this.hands.portalOf(1);
          const name = this.exercise?.instruments.find((one) => one.id === probe)?.name ?? "";
          const others = (this.exercise?.tray.length ?? 0) > 2 ? " Other tools: {KeyC}." : "";
          this.room.say(
            `${name} at the ${portal?.name ?? ""}: ${portal?.landmarks ?? ""}.${others}`,
          );
        }
      }
    }
  }

  /** Of keys and mouse. */
  private asked(): ScopeAsked {
    const takesKeys = (): boolean => this.plan !== undefined && this.room.operates();
    const tool = (): ToolKind => this.tool;
    const hasFluid = (): boolean => (this.scope?.fluid ?? null) !== null;
    return {
      takesKeys,
      get tool() {
        return tool();
      },
      get hasFluid() {
        return hasFluid();
      },
      press: (holder, motion) => {
        this.press(holder, motion);
      },
      letGo: (holder) => {
        this.letGo(holder);
      },
      letGoOfAll: () => {
        this.keys.clear();
        this.changed = true;
      },
      act: (act) => {
        this.act(act);
      },
      actOnFluid: (act) => {
        this.actOnFluid(act);
      },
      lean: (yawRad, pitchRad) => {
        this.lean(yawRad, pitchRad);
      },
      turn: (deg) => {
        this.turnHeld(deg);
      },
      advance: (mm) => {
        if (this.hands.advance(mm)) this.changed = true;
      },
    };
  }

  private press(holder: string, motion: ScopeMotion): void {
    this.keys.set(holder, motion);
    if (motion.kind === "run") this.changed = true;
  }

  private letGo(holder: string): void {
    if (this.keys.get(holder)?.kind === "run") this.changed = true; // at once: a pedal is no pedal else
    this.keys.delete(holder);
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
