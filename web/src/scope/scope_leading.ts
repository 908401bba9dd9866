// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Leads two hands at a scope: mouse, keys and the first finger one of them, a gamepad or a second finger the
// other, both at once. What they wish is sent; where things really are, the host says.
import type {
  ExerciseMessage,
  HandMessage,
  Item,
  ScopeMessage,
  SnapshotMessage,
  Vec3,
} from "../protocol";
import { scaled } from "../tool_placement";
import { HandsToSend, PEDAL_REPEAT_MS } from "./hands_to_send";
import { withPortals } from "./portal_words_model";
import { wrappedDeg } from "./scope_hand_model";
import { ScopeHands, type HandIndex, type Lead } from "./scope_hands";
import type { ScopeMotion } from "./scope_keys";
import { makesPortal } from "./scope_plan";
import { ScopeTools, type ToolKind } from "./scope_tools";
import type { SecondLead } from "./second_lead";

export interface LeadingRoom {
  operates(): boolean;
  send(hand: Omit<HandMessage, "type" | "sequence">): void;
  turn(shaftDeg: number, cameraDeg: number): void;
  turnMouth(hand: HandIndex, mouthDeg: number): void;
  take(instrument: string, hand: HandIndex): void;
  /** @param byN  more traction, or less */
  pull(byN: number): void;
  say(text: string): void;
  /** The panorama shows what faces this way, in Patient. */
  showSide(facing: Vec3): void;
  /** Hands are before other portals. @param words  a step's, of the portals that they are before now */
  tellPortals(words: (text: string) => string): void;
  /** Mouse and keys move this hand from now on. */
  showHand(hand: HandIndex): void;
}

const LEAN_RAD_PER_S = (28 * Math.PI) / 180;
const TURN_DEG_PER_S = 75;
/** Within it the host has answered what a hand asked to take [ms]. */
const TAKING_MS = 1000;

export class ScopeLeading {
  readonly hands = new ScopeHands();
  readonly tools = new ScopeTools();
  private readonly sending = new HandsToSend();
  private exercise: ExerciseMessage | undefined;
  private scope: ScopeMessage | undefined;
  private snapshot: SnapshotMessage | undefined;
  private readonly keys = new Map<string, { readonly lead: Lead; readonly motion: ScopeMotion }>();
  private shaftDeg = 0;
  private cameraDeg = 0;
  private turned = false;
  private isPlaced = false;
  private waitsForScope = false;
  private lastMs = 0;
  private askedToTakeMs = -Infinity;
  private pedalTimer: ReturnType<typeof setInterval> | undefined;

  /** @param onPortal  a hand went on to another portal */
  constructor(
    private readonly room: LeadingRoom,
    private readonly onPortal: () => void,
  ) {}

  begin(exercise: ExerciseMessage): void {
    this.exercise = exercise;
    this.scope = undefined;
    this.snapshot = undefined;
    this.isPlaced = this.waitsForScope = false;
    this.hands.begin(exercise);
    this.tools.begin(exercise);
    this.sending.begin();
    this.shaftDeg = this.cameraDeg = 0;
    this.askedToTakeMs = -Infinity;
    this.keys.clear();
    this.tellPortals();
  }

  private tellPortals(): void {
    const hand = this.scope?.hand === 1 ? 1 : 0;
    const chosen = {
      scope: this.hands.portalOf(hand),
      tool: this.hands.portalOf(hand === 0 ? 1 : 0),
    };
    const portals = this.exercise?.arthroscopy?.portals ?? [];
    this.room.tellPortals((text) => withPortals(text, portals, chosen));
  }

  see(snapshot: SnapshotMessage): void {
    this.snapshot = snapshot;
    if (snapshot.bodies !== null) this.hands.poses = snapshot.bodies;
    if (!this.isPlaced) return;
    const inPortal = this.scope?.portals.map((id) => id !== "") ?? [];
    this.hands.holdBack(snapshot, inPortal, performance.now()).forEach((isNew, hand) => {
      if (isNew) this.sending.mark(hand === 0 ? 0 : 1);
    });
  }

  seeScope(message: ScopeMessage): void {
    this.scope = message;
    this.waitsForScope = false;
  }

  private get moved(): HandIndex {
    return this.hands.moved;
  }

  /** Once per frame: what is held goes on, the newest wishes are sent. */
  frame(nowMs: number): void {
    const seconds = Math.min(0.1, Math.max(0, (nowMs - this.lastMs) / 1000));
    this.lastMs = nowMs;
    if (!this.room.operates()) return;
    this.place();
    for (const hand of [0, 1] as const) {
      if (this.hands.goRound(hand, this.snapshot?.items ?? [])) this.sending.mark(hand);
    }
    for (const { lead, motion } of this.keys.values()) {
      const hand = this.hands.ledBy(lead);
      if (lead === "first" || !this.fill(hand)) this.move(hand, motion, seconds);
    }
    if (this.turned) {
      this.turned = false;
      this.room.turn(this.shaftDeg, this.cameraDeg);
    }
    this.sendDue(nowMs);
  }

  private sendDue(nowMs: number): void {
    if (!this.isPlaced) return;
    for (const hand of [0, 1] as const) {
      const runs = this.toolOf(hand) === "shaver" && this.driverOf(hand) === "forward";
      if (this.sending.isDue(hand, { isLed: hand === this.moved, runs }, nowMs)) {
        this.sendHand(hand, nowMs);
      }
    }
  }

  private sendHand(hand: HandIndex, nowMs = performance.now()): void {
    const wish = this.hands.wishOf(hand);
    if (wish === undefined || this.isForSkin(hand)) return;
    this.sending.sent(hand, nowMs);
    this.room.send({
      hand,
      tip_mm: wish.tipMm,
      shaft: wish.shaft,
      thrust_n: 0,
      driver: this.driverOf(hand),
      guidance: "planned",
    });
  }

  private takeTools(): void {
    const { snapshot } = this;
    this.tools.take(
      this.scope,
      (hand) => snapshot?.items.some((one) => one.hand === hand) ?? false,
    );
  }

  private driverOf(hand: HandIndex): HandMessage["driver"] {
    const pedalIsDown = [...this.keys.values()].some(
      ({ lead, motion }) => motion.kind === "run" && this.hands.ledBy(lead) === hand,
    );
    return this.tools.driver(hand, this.itemOf(hand)?.instrument, pedalIsDown);
  }

  /** What is held now was led from elsewhere: where it is the host says. */
  beginAnew(): void {
    this.keys.clear();
    this.isPlaced = false;
    this.waitsForScope = this.scope === undefined;
  }

  /** No hand holds the scope. */
  forgetScope(): void {
    this.scope = undefined;
  }

  /** The hand begins where the host has the scope. */
  private place(): void {
    if (this.isPlaced || this.snapshot === undefined || this.hands.poses.length === 0) return;
    if (this.waitsForScope) return;
    // Not told yet: what the other hand holds may be anywhere.
    const inPortal = this.scope?.portals.map((id) => id !== "") ?? [true, true];
    this.hands.place(this.snapshot.items, inPortal);
    if (this.scope !== undefined) {
      this.shaftDeg = this.scope.shaft_deg;
      this.cameraDeg = this.scope.camera_deg;
      this.takeTools();
    }
    this.isPlaced = true;
  }

  private move(hand: HandIndex, motion: ScopeMotion, seconds: number): void {
    switch (motion.kind) {
      case "lean": {
        // The hand goes the other way than the tip.
        const by = LEAN_RAD_PER_S * seconds;
        this.lean(hand, motion.yaw * by, motion.pitch * by);
        return;
      }
      case "advance":
        if (this.hands.advanceFor(hand, motion.by * seconds, performance.now()))
          this.sending.mark(hand);
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

  private itemOf(hand: HandIndex): Item | undefined {
    return this.snapshot?.items.find((one) => one.hand === hand);
  }

  /** Of what works beside the scope, or will. */
  get tool(): ToolKind {
    return this.toolOf(this.scope?.hand === 1 ? 0 : 1);
  }

  /** What it holds works on skin: it is led over that, and not from here. */
  private isForSkin(hand: HandIndex): boolean {
    const item = this.itemOf(hand);
    return item !== undefined && makesPortal(item.instrument, this.exercise?.instruments ?? []);
  }

  private toolOf(hand: HandIndex): ToolKind {
    return this.tools.kindOf(this.itemOf(hand)?.instrument);
  }

  /** The scope's shaft; or the shaver, where that is in the hand that mouse and keys lead. */
  turnHeld(deg: number): void {
    if (!this.turnMouth(this.moved, deg)) this.turnBy(deg, 0);
  }

  /** @returns  whether this hand holds what has one */
  private turnMouth(hand: HandIndex, deg: number): boolean {
    if (!this.tools.hasMouth(this.itemOf(hand)?.instrument)) return false;
    if (deg !== 0) this.room.turnMouth(hand, this.tools.turnMouth(hand, deg));
    return true;
  }

  /** By mouse or finger. */
  leanBy(lead: Lead, yawRad: number, pitchRad: number): void {
    if (lead === "second") this.second.lean(yawRad, pitchRad);
    else this.lean(this.moved, yawRad, pitchRad);
  }

  /** The hand that mouse and keys lead. */
  advance(mm: number): void {
    if (this.hands.advance(this.moved, mm, performance.now())) this.sending.mark(this.moved);
  }

  /** Up in the picture is distal where the camera head is not turned. */
  level(): void {
    this.turnBy(0, -this.cameraDeg);
  }

  private lean(hand: HandIndex, yaw: number, pitch: number): void {
    this.hands.lean(hand, yaw, pitch, performance.now());
    this.sending.mark(hand);
  }

  private turnBy(shaftDeg: number, cameraDeg: number): void {
    this.shaftDeg = wrappedDeg(this.shaftDeg + shaftDeg);
    this.cameraDeg = wrappedDeg(this.cameraDeg + cameraDeg);
    this.turned = true;
  }

  setJaws(hand: HandIndex, closed: boolean | undefined): void {
    const held = this.itemOf(hand);
    if (held === undefined || !this.tools.hasJaws(held.instrument)) {
      this.room.say("This hand holds nothing with jaws: take it in the other hand first.");
      return;
    }
    if (this.tools.setJaws(hand, closed)) this.sending.mark(hand);
  }

  goToNextPortal(hand: HandIndex): void {
    // The host's word counts: it may have drawn the tip farther out than the page wished, or less.
    if ((this.scope?.portals[hand] ?? "") !== "") {
      this.room.say("Draw it out of this portal first.");
      return;
    }
    this.hands.goToNextPortal(hand);
    this.sending.mark(hand);
    this.onPortal();
    this.tellPortals();
    const now = this.hands.portalNowOf(hand);
    if (now !== undefined) this.room.showSide(scaled(now.inwards, -1));
    const next = this.hands.portalOf(hand);
    this.room.say(`${next?.name ?? ""}: ${next?.landmarks ?? ""}.`);
  }

  switchHands(): void {
    this.keys.clear();
    if (this.isPlaced) {
      // A pedal that was down is let go with the hand.
      for (const hand of [0, 1] as const) if (this.itemOf(hand) !== undefined) this.sendHand(hand);
    }
    this.hands.moved = this.moved === 0 ? 1 : 0;
    this.takeTools();
    this.room.showHand(this.moved);
    this.sending.mark(this.moved);
    this.fill(this.moved);
  }

  /** The second hand takes what works beside the scope, where it is empty. @returns  whether it holds nothing yet */
  private fill(hand: HandIndex): boolean {
    const probe = this.exercise?.tray.at(-1);
    if (hand !== 1 || this.itemOf(1) !== undefined || probe === undefined) return false;
    const portal = this.hands.portalOf(1);
    if (portal === undefined) {
      this.room.say("There is no second portal to go in by yet: take what makes one, {KeyC}.");
      return true;
    }
    if (performance.now() - this.askedToTakeMs < TAKING_MS) return true;
    this.askedToTakeMs = performance.now();
    // The hand is there before it takes anything: it comes in from behind, through no bone.
    this.sendHand(1);
    this.room.take(probe, 1);
    const name = this.exercise?.instruments.find((one) => one.id === probe)?.name ?? "";
    const others = (this.exercise?.tray.length ?? 0) > 2 ? " Other tools: {KeyC}." : "";
    this.room.say(`${name} at the ${portal.name}: ${portal.landmarks}.${others}`);
    return true;
  }

  /** Who leads the hand that mouse and keys do not: it takes what it is to hold when it is first led. */
  get second(): SecondLead {
    const isReady = (): boolean =>
      this.isPlaced && this.room.operates() && !this.fill(this.hands.ledBy("second"));
    const tool = (): ToolKind => this.tool;
    return {
      get tool() {
        return tool();
      },
      lean: (yawRad, pitchRad) => {
        if (isReady()) this.lean(this.hands.ledBy("second"), yawRad, pitchRad);
      },
      turn: (shaftDeg, cameraDeg) => {
        const hand = this.hands.ledBy("second");
        if (!isReady() || this.turnMouth(hand, shaftDeg)) return;
        if (hand === this.scope?.hand) this.turnBy(shaftDeg, cameraDeg);
      },
      hold: (holder, motion) => {
        if (this.isPlaced && this.room.operates()) this.press(holder, motion, "second");
      },
      letGo: (holder) => {
        this.letGo(holder);
      },
      setJaws: (closed) => {
        if (isReady()) this.setJaws(this.hands.ledBy("second"), closed);
      },
      goToNextPortal: () => {
        if (isReady()) this.goToNextPortal(this.hands.ledBy("second"));
      },
      switchHands: () => {
        if (this.isPlaced) this.switchHands();
      },
      pull: (byN) => {
        this.room.pull(byN);
      },
    };
  }

  press(holder: string, motion: ScopeMotion, lead: Lead = "first"): void {
    this.keys.set(holder, { lead, motion });
    if (motion.kind !== "run") return;
    this.sending.mark(this.hands.ledBy(lead));
    this.pedalTimer ??= setInterval(() => {
      this.repeatPedal();
    }, PEDAL_REPEAT_MS);
  }

  /** Also between pictures: where those come slowly the host would take the pedal for let go. */
  private repeatPedal(): void {
    const isDown = [...this.keys.values()].some(({ motion }) => motion.kind === "run");
    if (isDown) {
      if (this.room.operates()) this.sendDue(performance.now());
      return;
    }
    clearInterval(this.pedalTimer);
    this.pedalTimer = undefined;
  }

  letGo(holder: string): void {
    const held = this.keys.get(holder);
    // At once: a pedal is no pedal else.
    if (held?.motion.kind === "run") this.sending.mark(this.hands.ledBy(held.lead));
    this.keys.delete(holder);
  }

  letGoOfAll(): void {
    this.keys.clear();
    for (const hand of [0, 1] as const) {
      if (this.itemOf(hand) !== undefined) this.sending.mark(hand);
    }
  }
}
