// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `window.carpus`: for tests and screenshots, what is shown; never a way to act.
import type { Headset } from "../headset";
import type {
  BodyPose,
  ExerciseMessage,
  ScopeMessage,
  SkinMessage,
  SnapshotMessage,
  Vec3,
} from "../protocol";
import type { ScopeDesk } from "../scope";
import type { SkinDesk } from "../skin_work";
import type { Sound, SoundState } from "../sound";
import type { Theatre } from "../theatre";
import type { WhatIsSeen } from "./what_is_seen";

declare global {
  interface Window {
    carpus?: {
      snapshot(): SnapshotMessage | undefined;
      scope(): ScopeMessage | undefined;
      skin(): SkinMessage | undefined;
      exercise(): ExerciseMessage | undefined;
      /** By the body's name, as the host told them last. */
      bodyPoses(): Readonly<Record<string, BodyPose>>;
      pagePoint(mm: Vec3): { readonly x: number; readonly y: number };
      beamIsDrawn(): boolean;
      sound(): SoundState;
      headset(): Headset["shown"];
      screenAxes(): { readonly right: Vec3; readonly up: Vec3 };
    };
  }
}

/** @return takes it away */
export function showToTests(
  theatre: Theatre,
  seen: WhatIsSeen,
  scope: ScopeDesk,
  skin: SkinDesk,
  sound: Sound,
  headset: Headset,
): () => void {
  window.carpus = {
    snapshot: () => seen.latest,
    scope: () => scope.told,
    skin: () => skin.told,
    exercise: () => seen.doing,
    bodyPoses: () => seen.bodyPoses(),
    pagePoint: (mm) => theatre.pagePoint(mm),
    beamIsDrawn: () => theatre.beamIsDrawn,
    sound: () => sound.state,
    headset: () => headset.shown,
    screenAxes: () => theatre.screenAxes(),
  };
  return () => {
    delete window.carpus;
  };
}
