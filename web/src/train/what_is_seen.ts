// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the host has told: what is done, its last snapshot, what can be asked for; and all that shows it:
// the theatre at once, readings ten times a second.
import { isPushedWith } from "../devices";
import { BY_DEVICE, OfferedActions, whyStuck } from "../operation";
import type {
  ActionsMessage,
  BodyPose,
  ExerciseMessage,
  Instrument,
  SnapshotMessage,
  TissueMessage,
} from "../protocol";
import { worksOnSkin } from "../skin_work";
import type { Theatre } from "../theatre";
import type { ClosedWays } from "./bottom_bar";
import type { Hand } from "./hand";
import { offeredControls } from "./offered_controls_model";
import type { Panels } from "./panels";

const WHY_NO_HEADSET =
  "An arthroscopy is led at the page: a headset shows no scope's picture and leads nothing in a portal.";

export class WhatIsSeen {
  private snapshot: SnapshotMessage | undefined;
  private exercise: ExerciseMessage | undefined;
  private actions = new OfferedActions();
  private poses: readonly BodyPose[] = [];

  constructor(
    private readonly panels: Panels,
    private readonly theatre: Theatre,
  ) {}

  get latest(): SnapshotMessage | undefined {
    return this.snapshot;
  }

  get doing(): ExerciseMessage | undefined {
    return this.exercise;
  }

  get offered(): OfferedActions {
    return this.actions;
  }

  /** By name, as told last. */
  bodyPoses(): Readonly<Record<string, BodyPose>> {
    const bodies = this.exercise?.bodies ?? [];
    return Object.fromEntries(
      bodies.flatMap(({ name }, i) => {
        const pose = this.poses[i];
        return pose === undefined ? [] : [[name, pose]];
      }),
    );
  }

  /** What people call a body. */
  label(body: string): string {
    return this.exercise?.bodies.find((one) => one.name === body)?.label ?? body;
  }

  /** What a step is called. */
  titleOf(step: number): string {
    return this.exercise?.steps[step]?.title ?? "";
  }

  /** Id of what the current step is done with, or empty. */
  get wantedInstrument(): string {
    const { exercise, snapshot } = this;
    return (snapshot === undefined ? "" : exercise?.steps[snapshot.step]?.instrument) ?? "";
  }

  /** Undefined: what is done can be done with one. */
  get whyNoHeadset(): string | undefined {
    const { exercise } = this;
    return exercise === undefined || offeredControls(exercise).headset ? undefined : WHY_NO_HEADSET;
  }

  /** What is done from now on; its state follows. */
  begin(exercise: ExerciseMessage): void {
    const { arm, bottom, drive, steps, top, tray, views, wrist } = this.panels;
    this.exercise = exercise;
    this.snapshot = undefined;
    this.theatre.setInstruments(exercise.instruments);
    this.theatre.setTracks([]);
    const assessed = exercise.mode === "assessed";
    // A portal is made through closed skin, whoever looks on.
    const closed = assessed || worksOnSkin(exercise.instruments);
    this.theatre.showSkinWork(undefined);
    this.theatre.showOnlySkin(closed);
    this.theatre.setIdeal(exercise.ideal, exercise.instruments);
    views.showOnlySkin(closed);
    if (!assessed && closed) views.showGhostOnSkin();
    views.showAids(false, "off");
    top.showProcedure(exercise.procedure.title, assessed);
    top.allowHeadset(this.whyNoHeadset);
    steps.setSteps(exercise);
    arm.setViews(exercise.views);
    tray.setTray(exercise);
    bottom.setExercise(exercise);
    const offered = offeredControls(exercise);
    drive.element.hidden = !offered.drive;
    arm.element.hidden = !offered.cArm;
    if (!worksOnSkin(exercise.instruments)) views.offerPlan(offered.plan);
    // A scope's V is its next portal.
    views.offerKey(exercise.arthroscopy === null);
    bottom.offer(offered);
    wrist.reset(exercise.wrist_limits);
  }

  takeActions(message: ActionsMessage): void {
    this.actions = new OfferedActions(message.actions);
  }

  takeTissue(message: TissueMessage): void {
    this.theatre.setTracks(message.tracks);
  }

  take(s: SnapshotMessage, hand: Hand): void {
    const isFirst = this.snapshot === undefined;
    this.snapshot = s;
    this.poseBodies(s, isFirst);
    this.theatre.show(s);
    this.panels.bottom.sample(s, hand.active);
    this.panels.steps.show(s);
    hand.see(s);
  }

  private poseBodies(s: SnapshotMessage, isFirst: boolean): void {
    const { exercise, theatre } = this;
    if (exercise === undefined || s.bodies === null) return;
    this.poses = s.bodies;
    s.bodies.forEach((pose, index) => {
      const body = exercise.bodies[index];
      if (body !== undefined) theatre.setBonePose(body.name, pose);
    });
    if (!isFirst) return;
    theatre.setTarget(exercise.bodies.filter((one) => one.is_target).map((one) => one.name));
  }

  /** @param operates  whether this page does: only then is a pause said over the scene */
  showReadings(hand: Hand, ways: ClosedWays, operates: boolean): void {
    const s = this.snapshot;
    if (s === undefined) return;
    const { arm, bottom, drive, frozen, notice, pausedSign, top, wrist } = this.panels;
    top.showTiming(s);
    pausedSign.hidden = !s.paused || !operates || !frozen.hidden;
    const device = this.panels.devices.hands[hand.active];
    const isPressed = device !== undefined && isPushedWith(device);
    const thrustN = isPressed ? s.hands[hand.active].thrust_n : hand.thrust;
    bottom.show(s, hand.active, hand.driver, thrustN);
    bottom.showWays(ways);
    this.panels.steps.offer(this.offered);
    drive.show(hand.driver, hand.thrust, hand.coarse);
    wrist.show(s.wrist);
    arm.takeStand(s.c_arm);
    arm.takeWrist(s.wrist);
    arm.showCount(s.shots, s.dose_cgy_cm2);
    const stuck =
      hand.driver === "forward" && !s.paused && !worksOnSkin(this.exercise?.instruments ?? [])
        ? whyStuck(s, hand.active, thrustN, isPressed ? BY_DEVICE : hand.ledWith)
        : undefined;
    if (stuck !== undefined) notice.say(stuck);
  }

  /** Says what was taken, for who only hears. */
  sayTaken(instrument: Instrument): void {
    this.panels.notice.say(`Taken: ${instrument.name}. ${instrument.use}`);
  }

  /** Log and pictures of an exercise that is over. */
  clearRecord(): void {
    this.panels.steps.clearLog();
    this.panels.arm.clear();
  }

  /** Another exercise: nothing of it was seen yet. */
  forget(): void {
    this.clearRecord();
    this.snapshot = undefined;
    this.exercise = undefined;
    this.actions = new OfferedActions();
  }
}
