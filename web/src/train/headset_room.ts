// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a headset reaches in the room, and what it shows of it.
import type { HeadsetHandlers, HeadsetOnce, Words } from "../headset";
import { BY_CONTROLLERS, BY_KEYS, heldItem } from "../operation";
import type { CArmPicture, Instrument } from "../protocol";
import type { Theatre } from "../theatre";
import type { Actions } from "./actions";
import { drivenBy } from "./driven_by";
import type { Hand } from "./hand";
import type { Panels } from "./panels";
import type { TakingPart } from "./taking_part";
import type { WhatIsSeen } from "./what_is_seen";

export interface HeadsetSurroundings {
  readonly panels: Panels;
  readonly hand: Hand;
  readonly seen: WhatIsSeen;
  readonly part: TakingPart;
  readonly theatre: Theatre;
  actions(): Actions;
  /** The newest picture. */
  picture(): CArmPicture | undefined;
}

export function headsetRoom(around: HeadsetSurroundings): HeadsetHandlers {
  const { panels, hand, seen, part, theatre } = around;
  let chosen = "";

  const choose = (by: number): void => {
    const { instruments } = panels.tray;
    const at = instruments.findIndex((one) => one.id === chosen);
    const to = at < 0 ? 0 : (at + by + instruments.length) % instruments.length;
    chosen = instruments[to]?.id ?? "";
  };
  /** What is held already is put down. */
  const take = (): void => {
    const id = chosenNow()?.id;
    if (id === undefined) return;
    const held = seen.latest === undefined ? undefined : heldItem(seen.latest, hand.active);
    if (held?.instrument === id) around.actions().ask({ id: "put_down", hand: hand.active });
    else around.actions().ask({ id: "take", hand: hand.active, instrument: id });
  };
  const chosenNow = (): Instrument | undefined =>
    panels.tray.instruments.find((one) => one.id === (chosen || seen.wantedInstrument));

  return {
    ...drivenBy("headset", panels, hand, part),
    canBePlaced: () => hand.canBePlaced,
    tipMm: () => hand.tipMm,
    place: (tipMm, shaft) => {
      hand.place(tipMm, shaft);
    },
    act: (action: HeadsetOnce) => {
      if (action.kind === "next_shot") panels.arm.shootNext();
      else if (action.kind === "choose") choose(action.by);
      else if (action.kind === "take") take();
      else around.actions().act(action);
    },
    whyNot: () => seen.whyNoHeadset,
    stage: () => theatre.beWorn(),
    words: () => wordsOf(around, chosenNow()),
    picture: () => around.picture(),
    beat: (nowMs) => {
      hand.frame(nowMs);
    },
    worn: (on) => {
      hand.ledWith = on ? BY_CONTROLLERS : BY_KEYS;
      panels.top.showHeadset(on);
      panels.notice.say(
        on
          ? "The headset is worn: the controller on the right is the instrument."
          : "The headset is off: go on by mouse and keys.",
      );
    },
    say: (text) => {
      panels.notice.say(text);
    },
  };
}

/** Of an assessed operation no step is told, as on the page, but what is asked for. */
function wordsOf(
  { hand, panels, seen, part }: HeadsetSurroundings,
  chosen: Instrument | undefined,
): Words {
  const notice = panels.notice.element.textContent;
  const { latest, doing } = seen;
  if (latest === undefined || doing === undefined || !part.operates)
    return {
      title: "Nothing is operated on",
      instruction: "Take the headset off and begin an operation on the page.",
      readings: [],
      notice,
    };
  const step = doing.mode === "assessed" ? undefined : doing.steps[latest.step];
  const item = heldItem(latest, hand.active);
  const name = doing.instruments.find((one) => one.id === item?.instrument)?.name ?? "nothing";
  const force = Math.hypot(...latest.hands[hand.active].force_n);
  return {
    title: step?.title ?? doing.procedure.title,
    instruction: step?.instruction ?? doing.task ?? "",
    readings: [
      ["In the hand", name],
      ["Chosen", chosen?.name ?? "nothing"],
      ["Push, set to", `${hand.thrust} N`],
      ["Force felt", `${force.toFixed(1)} N`],
    ],
    notice: latest.paused ? `Time stands still: Y goes on. ${notice}` : notice,
  };
}
