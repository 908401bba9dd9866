// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What works beside the scope: a probe, forceps whose jaws lock, a punch whose jaws bite, or a shaver with pedal
// and mouth, by hand.
import type {
  ExerciseMessage,
  HandMessage,
  Instrument,
  Item,
  ScopeMessage,
  SkinMessage,
  Vec3,
} from "../protocol";
import { cross, dot, normalized, rotated, scaled, subtract } from "../tool_placement";
import { wrappedDeg } from "./scope_hand_model";
import type { HandIndex } from "./scope_hands";
import { rodLook, type RodLook } from "./scope_rod";

export type ToolKind = "probe" | "grasper" | "punch" | "shaver";

/** As the picture draws it. */
export interface Rod {
  readonly tipMm: Vec3;
  readonly shaft: Vec3;
  readonly look: RodLook;
  /** Unit: where a shaver's mouth looks, or a punch's jaw opens to. */
  readonly mouth: Vec3 | undefined;
  /** Of what makes a portal: it looks as its parts do. */
  readonly instrument?: string;
}

export class ScopeTools {
  private readonly areClosed: [boolean, boolean] = [false, false];
  private readonly mouthDeg: [number, number] = [0, 0];
  /** By instrument; and that of the tray's last one. */
  private kinds: ReadonlyMap<string, ToolKind> = new Map();
  private usual: ToolKind = "probe";
  /** Of the instruments that work on skin what each does. */
  private skinWork: ReadonlyMap<string, Instrument["skin_work"]> = new Map();

  begin(exercise: ExerciseMessage): void {
    this.kinds = new Map(exercise.instruments.map((one) => [one.id, kindOf(one)]));
    this.usual = this.kindOf(exercise.instruments.at(-1)?.id ?? "");
    this.skinWork = new Map(exercise.instruments.map((one) => [one.id, one.skin_work]));
    this.areClosed.fill(false);
    this.mouthDeg.fill(0);
  }

  /** Of what a hand holds; an empty hand stands for what it will take by itself. */
  kindOf(instrument: string | undefined): ToolKind {
    return instrument === undefined ? this.usual : (this.kinds.get(instrument) ?? "probe");
  }

  /** As the host has them: a page that comes back must not open what holds something. */
  take(scope: ScopeMessage | undefined, isHeld: (hand: HandIndex) => boolean): void {
    for (const hand of [0, 1] as const) {
      this.areClosed[hand] = isHeld(hand) && scope?.jaws_closed[hand] === 1;
      this.mouthDeg[hand] = scope?.mouth_deg[hand] ?? 0;
    }
  }

  hasJaws(instrument: string): boolean {
    return hasJaws(this.kindOf(instrument));
  }

  hasMouth(instrument: string | undefined): boolean {
    return instrument !== undefined && this.kindOf(instrument) === "shaver";
  }

  /** @param closed  undefined: the other way than now. @returns  whether that is another way */
  setJaws(hand: HandIndex, closed: boolean | undefined): boolean {
    const before = this.areClosed[hand];
    this.areClosed[hand] = closed ?? !before;
    return this.areClosed[hand] !== before;
  }

  /** @returns  how the mouth is turned then */
  turnMouth(hand: HandIndex, byDeg: number): number {
    this.mouthDeg[hand] = wrappedDeg(this.mouthDeg[hand] + byDeg);
    return this.mouthDeg[hand];
  }

  /**
   * Jaws lock: they close by one way of the driver, and open by the other. A shaver runs by the pedal.
   * @param held  what is in that hand
   */
  driver(hand: HandIndex, held: string | undefined, pedalIsDown: boolean): HandMessage["driver"] {
    const kind = this.kindOf(held);
    if (hasJaws(kind)) return this.areClosed[hand] ? "forward" : "reverse";
    return kind === "shaver" && pedalIsDown ? "forward" : "off";
  }

  /** @param level  up in a level picture. @param nowMs  a running blade turns by it; the same where nothing is to move
   * @param skin  where portals are made. @returns  undefined: nothing that comes into a joint */
  rod(
    item: Item,
    scope: ScopeMessage,
    level: Vec3,
    nowMs: number,
    skin: SkinMessage | undefined,
  ): Rod | undefined {
    const hand = item.hand === 1 ? 1 : 0;
    const work = this.skinWork.get(item.instrument) ?? "none";
    if (work === "palpate" || work === "mark") return undefined;
    const bare = { tipMm: item.tip_mm, shaft: item.shaft, mouth: undefined };
    if (skin?.hands[hand]?.is_spreading === true) return { ...bare, look: "open" };
    if (work !== "none") return { ...bare, look: "probe", instrument: item.instrument };
    const runs = scope.running[hand] === 1;
    const look = this.hasMouth(item.instrument)
      ? shaverLook(runs, nowMs)
      : rodLook(this.kindOf(item.instrument), scope.jaws_closed[hand] === 1);
    // A punch is held so that its jaw opens upwards in a level picture.
    const turnDeg = {
      shaver: scope.mouth_deg[hand] ?? 0,
      punch: 0,
      grasper: undefined,
      probe: undefined,
    };
    const deg = turnDeg[this.kindOf(item.instrument)];
    const mouth = deg === undefined ? undefined : mouthTowards(item.shaft, level, deg);
    return { tipMm: item.tip_mm, shaft: item.shaft, look, mouth };
  }
}

function kindOf(one: Pick<Instrument, "has_bite" | "has_jaws" | "has_mouth">): ToolKind {
  if (one.has_mouth) return "shaver";
  if (!one.has_jaws) return "probe";
  return one.has_bite ? "punch" : "grasper";
}

/** Closed and opened by one key. */
export function hasJaws(kind: ToolKind): boolean {
  return kind === "grasper" || kind === "punch";
}

/** The blade oscillates: it opens and shuts the window. */
const BLADE_MS = 90;
function shaverLook(runs: boolean, nowMs: number): RodLook {
  return runs && Math.floor(nowMs / BLADE_MS) % 2 === 1 ? "blade" : "shaver";
}

/** As the host has it: at 0 towards what is level, turning right-handed about the shaft. */
export function mouthTowards(shaft: Vec3, level: Vec3, turnDeg: number): Vec3 {
  const across = subtract(level, scaled(shaft, dot(level, shaft)));
  const flat =
    Math.hypot(...across) > 1e-6 ? normalized(across) : normalized(cross(shaft, [1, 0, 0]));
  return rotated(flat, shaft, (turnDeg * Math.PI) / 180);
}
