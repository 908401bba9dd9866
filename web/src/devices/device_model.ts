// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is said of a device in words. Pure.
import type { DeviceAim, HandDevice } from "../protocol";

/** Its microseconds as people read them. */
export function timeText(us: number): string {
  if (!(us > 0)) return "–";
  return us < 1000 ? `${us.toFixed(us < 10 ? 1 : 0)} µs` : `${(us / 1000).toFixed(1)} ms`;
}

/** Name and value of each figure of its loop; none where the page itself is held. */
export function figures(device: HandDevice): readonly (readonly [name: string, value: string])[] {
  // What was measured before it went says nothing of now.
  if (device.id === "" || device.health === "gone" || device.health === "closed") return [];
  return [
    ["Rate", device.rate_hz > 0 ? `${Math.round(device.rate_hz)} Hz` : "–"],
    ["Jitter, 99 of 100", timeText(device.late_p99_us)],
    ["Jitter, 999 of 1000", timeText(device.late_p999_us)],
    ["Round trip", timeText(device.round_trip_us)],
    ["Missed", String(device.missed)],
    ["Class", device.real_time ? "real time" : "ordinary"],
    ["Place", device.position_mm.map((mm) => mm.toFixed(1)).join(", ") + " mm"],
    ["Able to", device.can],
  ];
}

const AIMS: Readonly<Record<DeviceAim, string>> = {
  portal: "points from the portal",
  own: "own rotation",
  page: "page's wheel",
};

/** What the direction of what it holds can follow, what it does best first. */
export function aimsOf(device: HandDevice): readonly (readonly [aim: DeviceAim, text: string])[] {
  const can: DeviceAim[] = [];
  if (device.has_rotation) can.push("own");
  if (device.has_portal) can.push("portal");
  return [...can, "page" as const].map((aim) => [aim, AIMS[aim]]);
}

/** An arrow as on the screen, whose right and up the device's are: from the middle, at most 1 long. */
export interface ForceArrow {
  readonly x: number;
  readonly y: number;
  /** 0 to 1: of it that points away from or to whoever sits there */
  readonly depth: number;
}

export function forceArrow({ force, most_force_n }: HandDevice): ForceArrow {
  const most = most_force_n > 0 ? most_force_n : 1;
  const [right, away, up] = force;
  const size = Math.hypot(right, away, up);
  const scale = size > most ? 1 / size : 1 / most;
  return { x: right * scale, y: up * scale, depth: Math.abs(away) * scale };
}

export function forceText(device: HandDevice): string {
  return device.most_force_n > 0
    ? `${device.force_n.toFixed(1)} N of ${device.most_force_n.toFixed(1)} N`
    : "gives no force";
}

/** For the bar: what the hands hold. @param page  what the page itself is moved by */
export function heldText(hands: readonly HandDevice[], page: string): string {
  const held = hands.filter((one) => one.id !== "");
  if (held.length === 0) return page;
  return held.map((one) => `${one.words.split(/[.:]/)[0] ?? ""}: ${one.name}`).join(", ");
}

/** What keeps time still: the devices that a hand holds and that cannot be felt; empty where all can. */
export function lostText(hands: readonly HandDevice[]): string {
  return heldText(
    hands.filter((one) => one.id !== "" && !isWell(one)),
    "",
  );
}

/** Whether what its hand presses is what it pushes with. */
export function isPushedWith(device: HandDevice): boolean {
  return isWell(device) && device.can.split(", ").includes("force");
}

/** Whether it can be felt now. */
export function isWell(device: HandDevice): boolean {
  return device.health === "good" || device.health === "holding_back";
}
