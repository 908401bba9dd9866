// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Begins, goes on with, pauses and leaves an exercise, and shows which of these can be done.
import { setText } from "../dom";
import type { LinkState } from "../host_link";
import type { PageMessage } from "../protocol";
import type { StartChoice } from "../start_dialog";
import type { Hand } from "./hand";
import type { Panels } from "./panels";
import { openStepsText } from "./open_steps_model";
import { Participation } from "./participation_model";
import { lostText, waitingText, type WaitingOperation } from "./waiting_model";
import type { WhatIsSeen } from "./what_is_seen";

/** What an exercise takes hold of in the room. */
export interface ExerciseRoom {
  readonly panels: Panels;
  readonly hand: Hand;
  readonly seen: WhatIsSeen;
  /** Where the keys belong while one operates. */
  readonly canvas: HTMLCanvasElement;
  /** Whether one is plugged in: with what an operation was begun is kept with it. */
  hasGamepad(): boolean;
  /** @return whether it was sent */
  tell(message: PageMessage): boolean;
}

export class TakingPart {
  private readonly part = new Participation();
  private pausedByHand = false;
  /** Reading how to operate is no operating. */
  private helpIsOpen = false;
  private waiting: WaitingOperation = { trainee: "", startedAt: "", isOwn: false };
  /** How far the operation had come when the connection was lost; until the host has told again. */
  private seenTick: number | undefined;
  /** Said before what waits. */
  private waitingLead = "";
  private chosen: StartChoice = { trainee: "", procedure: "", mode: "practice" };
  private wanted: StartChoice = this.chosen;

  constructor(private readonly room: ExerciseRoom) {}

  get operates(): boolean {
    return this.part.operates;
  }

  /** Asks first where an exercise waits that would be given up. */
  start(choice: StartChoice): void {
    this.wanted = choice;
    if (this.part.endsOne) this.room.panels.anewQuestion.ask();
    else this.begin(choice);
  }

  restart(): void {
    this.wanted = this.chosen;
    this.room.panels.anewQuestion.ask();
  }

  startAnew(): void {
    this.begin(this.wanted);
  }

  private begin(choice: StartChoice): void {
    this.chosen = choice;
    const sent = this.room.tell({
      type: "start",
      trainee: choice.trainee,
      procedure: choice.procedure,
      mode: choice.mode,
      input_device: this.room.hasGamepad() ? "gamepad" : "mouse",
      seed: crypto.getRandomValues(new Uint32Array(1))[0] ?? 1,
    });
    if (!sent) return;
    this.part.ask();
    this.pausedByHand = false;
    this.room.seen.clearRecord();
    this.room.panels.notice.say("Help (?) shows mouse, keys, touch and gamepad.");
    this.enter();
    // Until the host has begun it, where the hand is belongs to the operation before.
    this.room.hand.setEnabled(false);
  }

  resume(choice: StartChoice): void {
    // Restart does again what goes on, whatever else was chosen.
    const { doing } = this.room.seen;
    const procedure = doing?.procedure.id ?? choice.procedure;
    this.chosen = { ...choice, procedure, mode: doing?.mode ?? choice.mode };
    this.part.goOn();
    this.pausedByHand = false;
    this.goOn();
    this.enter();
  }

  /** The page operates from now on. */
  private enter(): void {
    const { canvas, hand, panels } = this.room;
    panels.start.offerResume(false);
    panels.start.close();
    hand.setEnabled(true);
    canvas.focus({ preventScroll: true });
  }

  /** The page does not operate any more; `note` says why. */
  private leave(note: string): void {
    const { hand, panels } = this.room;
    hand.setEnabled(false);
    panels.arm.pedal.releaseAll();
    panels.frozen.hidden = panels.pausedSign.hidden = true;
    for (const { element } of [
      panels.finishQuestion,
      panels.declineQuestion,
      panels.anewQuestion,
      panels.returnQuestion,
      panels.endQuestion,
      panels.tray,
      panels.help,
    ])
      element.close();
    panels.start.offerResume(this.part.isOffered);
    panels.start.setReady(true, note);
    panels.start.open();
  }

  /** An exercise waits, this page's or another's. */
  private offer(lead: string): void {
    this.room.seen.forget();
    this.room.hand.reset();
    this.waitingLead = lead;
    this.leave(lead + waitingText(this.waiting, undefined, [], new Date()));
  }

  /** The host lets time pass again, unless the trainee had stopped it. */
  private goOn(): void {
    this.room.tell({ type: "pause", on: this.pausedByHand || this.helpIsOpen });
  }

  togglePause(): void {
    const { latest } = this.room.seen;
    if (latest === undefined || !this.operates) return;
    this.pausedByHand = !latest.paused;
    this.goOn();
  }

  /** Time stands still while the help is read. */
  showHelp(isOpen: boolean): void {
    if (this.helpIsOpen === isOpen) return;
    this.helpIsOpen = isOpen;
    if (this.operates) this.goOn();
  }

  /** Asks before the operation ends. */
  askToFinish(): void {
    if (!this.operates) return;
    const { doing, latest } = this.room.seen;
    // In an assessed operation nobody tells which are done.
    const open =
      doing?.mode === "assessed"
        ? ""
        : openStepsText(doing?.steps ?? [], latest?.completed_steps ?? []);
    this.room.panels.finishQuestion.ask(open);
  }

  /** Asks for what reasons it is declined. */
  askToDecline(): void {
    if (!this.operates) return;
    this.room.panels.declineQuestion.ask(this.room.seen.doing?.decline_reasons ?? []);
  }

  /** The operation was scored. */
  finished(): void {
    this.part.finish();
  }

  /** The line to the host is open, or `text` says why not. */
  showLink(state: LinkState, text: string): void {
    const { hand, panels } = this.room;
    const open = state === "open";
    if (!open) {
      this.part.lose();
      panels.start.offerResume(false);
    }
    panels.frozen.hidden = open || !this.operates;
    setText(panels.frozen, text);
    panels.top.showLink(state === "lost" ? "not connected" : state === "busy" ? "busy" : "");
    panels.start.offerEnd(false);
    panels.start.setReady(open, text);
    hand.setEnabled(open && this.operates);
    if (!open) panels.arm.pedal.releaseAll();
  }

  /** Another page operates; @param mayEnd  this one may end that. */
  wait(mayEnd: boolean): void {
    this.room.panels.start.offerEnd(mayEnd);
  }

  /** Says of what waits, or was gone on with, how far it has come. */
  showWaiting(): void {
    const { panels, seen } = this.room;
    const lost = lostText(this.seenTick, seen.latest?.tick ?? 0);
    this.seenTick = undefined;
    if (lost !== "") panels.notice.say(lost);
    if (!this.part.endsOne || this.operates) return;
    panels.start.setReady(
      true,
      this.waitingLead +
        waitingText(this.waiting, seen.latest, seen.doing?.steps ?? [], new Date()),
    );
  }

  /** The host takes this page, for the first time or again, or has begun what it asked for. */
  arrive(exercise: number, waiting: WaitingOperation): void {
    const { hand, panels, seen } = this.room;
    this.waiting = waiting;
    switch (this.part.arrive(exercise, waiting.isOwn)) {
      case "begun":
        // Pictures of the exercise before may have come after the request.
        seen.forget();
        hand.reset();
        hand.setEnabled(true);
        break;
      case "goes_on":
        this.seenTick = seen.latest?.tick;
        // The host tells the log again.
        panels.steps.clearLog();
        this.goOn();
        panels.notice.say("Connected again: the operation goes on where it was.");
        break;
      case "ended":
        this.leave("The operation has ended; it is among the past attempts.");
        break;
      case "replaced":
        this.offer("Your operation has ended; it is among the past attempts. ");
        break;
      case "offered":
      case "foreign":
        this.offer("");
        break;
      case "free":
        this.leave("");
        break;
    }
  }
}
