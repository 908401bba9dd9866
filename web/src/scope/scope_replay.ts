// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the scope showed at a moment of an arthroscopy that is looked at again: the same picture as then, from
// what the host said then.
import type * as THREE from "three";
import { make, setText } from "../dom";
import type {
  BodyPose,
  ExerciseMessage,
  ScopeMessage,
  SkinMessage,
  SnapshotMessage,
} from "../protocol";
import { add, scaled } from "../tool_placement";
import { jointWallOf, type JointWall } from "./joint_wall";
import { ScopePicture } from "./scope_picture";
import { cutPlaces, DISC_JOINT, type Plan } from "./scope_plan";
import { ScopeTools } from "./scope_tools";

export interface ScopeMoment {
  readonly snapshot: SnapshotMessage;
  readonly bodies: readonly BodyPose[];
  readonly scope: ScopeMessage | undefined;
  /** Where portals are made in the exercise. */
  readonly skin: SkinMessage | undefined;
  /** By sheet, as of the messages `sheet`. */
  readonly sheetsUm: ReadonlyMap<number, readonly number[]>;
}

export class ScopeReplay {
  readonly element: HTMLElement;
  /** Where the scope is, and how much of the tour was seen. */
  readonly caption = make("span.secondary");
  private readonly picture: ScopePicture;
  private readonly outside = make("p.scope-replay-outside", {}, "The scope is outside.");
  private readonly walls: readonly JointWall[];
  private readonly radiusMm: number;
  private readonly tools = new ScopeTools();
  private moment: ScopeMoment | undefined;
  private changed = false;

  private constructor(
    private readonly plan: Plan,
    exercise: ExerciseMessage,
    walls: readonly JointWall[],
  ) {
    this.walls = walls;
    this.picture = new ScopePicture(walls, () => {
      this.changed = true;
    });
    this.picture.setField(plan.field_deg);
    this.picture.setInstruments(exercise.instruments);
    this.tools.begin(exercise);
    const bodies = exercise.bodies.map((one) => one.name);
    this.picture.setWrong(plan.lesions, plan.pieces, bodies);
    this.picture.setScrew(plan.screw, bodies);
    for (const wall of walls) wall.setSheets(plan.sheets, bodies);
    const scope = exercise.instruments.find((one) => one.id === plan.scope);
    this.radiusMm = scope?.parts.find((part) => part.end_radius_mm > 0)?.end_radius_mm ?? 1;
    this.element = make(
      "div.scope-replay",
      {},
      this.picture.canvas,
      this.picture.lost,
      this.outside,
    );
  }

  /** undefined where no scope is used, or the case has no joints to be seen. */
  static of(
    exercise: ExerciseMessage,
    surfaces: ReadonlyMap<string, THREE.BufferGeometry>,
  ): ScopeReplay | undefined {
    const walls = [...surfaces].flatMap(([joint, surface]) => jointWallOf(joint, surface) ?? []);
    const plan = exercise.arthroscopy;
    if (plan === null || walls.length === 0) return undefined;
    return new ScopeReplay(plan, exercise, walls);
  }

  take(moment: ScopeMoment): void {
    this.moment = moment;
    this.changed = true;
  }

  draw(): void {
    const { moment } = this;
    if (moment === undefined || !this.changed) return;
    this.changed = false;
    const { scope, snapshot, bodies } = moment;
    const portals = [...this.plan.portals, ...(moment.skin?.ways ?? [])];
    const item = snapshot.items.find((one) => one.hand === scope?.hand);
    const portal = portals.find((one) => one.id === scope?.portals[scope.hand]);
    const isIn = scope !== undefined && scope.in_joint[scope.hand] === 1;
    this.outside.hidden = isIn;
    this.picture.canvas.hidden = !isIn;
    const seen = scope?.points_seen.length ?? 0;
    const where = isIn ? `in the ${portal?.joint ?? ""} joint by ${portal?.id ?? ""}` : "outside";
    setText(
      this.caption,
      `${where}, ${seen} of ${this.plan.points.length} places seen · generated, not seen in the CT`,
    );
    if (!isIn || item === undefined || portal === undefined) return;
    for (const wall of this.walls) {
      if (wall.joint === DISC_JOINT) wall.cutDisc(cutPlaces(this.plan, scope.pieces_left));
      for (const [sheet, offUm] of moment.sheetsUm) wall.yieldSheet(sheet, offUm);
      if (wall.joint === portal.joint) wall.pose(bodies);
    }
    this.picture.lay(portal.joint, bodies);
    const other = snapshot.items.find((one) => one.hand === 1 - scope.hand);
    const box = this.element.getBoundingClientRect();
    this.picture.setFluid(scope.fluid, this.plan.distal);
    this.picture.draw(
      portal.joint,
      {
        // The lens lies in the middle of the rounded tip.
        eyeMm: add(item.tip_mm, scaled(item.shaft, this.radiusMm)),
        axis: scope.axis,
        up: scope.up,
      },
      other === undefined
        ? undefined
        : this.tools.rod(other, scope, this.plan.distal, snapshot.tick, moment.skin),
      scope,
      box.width * Math.min(1, window.devicePixelRatio),
      undefined,
    );
  }

  dispose(): void {
    this.picture.dispose();
  }
}
