// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { HandDevice, Vec3 } from "../protocol";
import {
  aimsOf,
  figures,
  forceArrow,
  forceText,
  heldText,
  isPushedWith,
  isWell,
  lostText,
  timeText,
} from "./device_model";
import { DeviceView } from "./device_view_model";

const PAGE: HandDevice = {
  id: "",
  name: "",
  health: "closed",
  words: "",
  can: "",
  rate_hz: 0,
  late_p99_us: 0,
  late_p999_us: 0,
  missed: 0,
  round_trip_us: 0,
  real_time: false,
  force_n: 0,
  most_force_n: 0,
  force: [0, 0, 0],
  aim: "page",
  has_portal: false,
  has_rotation: false,
  position_mm: [0, 0, 0],
  is_testing: false,
  may_calibrate: false,
  calibration: "",
  calibration_note: "",
};
const ARM: HandDevice = {
  ...PAGE,
  id: "arm:/dev/ttyACM0",
  name: "Arm",
  health: "good",
  words: "good",
  rate_hz: 999.7,
  late_p99_us: 33.4,
  late_p999_us: 2400,
  force_n: 1.24,
  most_force_n: 8,
};

describe("what is said of a device", () => {
  it("has figures with units, and none of the page itself", () => {
    expect(figures(PAGE)).toEqual([]);
    expect(Object.fromEntries(figures(ARM))).toMatchObject({
      Rate: "1000 Hz",
      "Jitter, 99 of 100": "33 µs",
      "Jitter, 999 of 1000": "2.4 ms",
      "Round trip": "–",
      Class: "ordinary",
    });
    expect(timeText(3.21)).toBe("3.2 µs");
    expect(forceText(ARM)).toBe("1.2 N of 8.0 N");
    expect(forceText(PAGE)).toBe("gives no force");
  });

  it("names what its direction can follow, what it does best first", () => {
    expect(aimsOf(PAGE).map(([aim]) => aim)).toEqual(["page"]);
    expect(aimsOf({ ...ARM, has_portal: true }).map(([, text]) => text)).toEqual([
      "points from the portal",
      "page's wheel",
    ]);
    expect(aimsOf({ ...ARM, has_portal: true, has_rotation: true })[0]?.[0]).toBe("own");
  });

  it("points its force as on the screen, never longer than the dial", () => {
    expect(forceArrow({ ...ARM, force: [0, 0, 4] })).toEqual({ x: 0, y: 0.5, depth: 0 });
    expect(forceArrow({ ...ARM, force: [0, -2, 0] }).depth).toBe(0.25);
    const long = forceArrow({ ...ARM, force: [30, 0, 40] });
    expect([long.x, long.y]).toEqual([0.6, 0.8]);
    expect(forceArrow(PAGE)).toEqual({ x: 0, y: 0, depth: 0 });
  });

  it("says in the bar what is held and how it is, without the advice", () => {
    expect(heldText([PAGE, PAGE], "mouse and keys")).toBe("mouse and keys");
    const gone: HandDevice = { ...ARM, health: "gone", words: "unplugged. Plug it in." };
    expect(heldText([gone, PAGE], "mouse and keys")).toBe("unplugged: Arm");
    expect(lostText([gone, PAGE])).toBe("unplugged: Arm");
    expect(lostText([PAGE, PAGE])).toBe("");
    expect(figures(gone)).toEqual([]);
    expect(isWell(gone)).toBe(false);
    expect(isWell({ ...ARM, health: "holding_back" })).toBe(true);
    expect(isPushedWith({ ...ARM, can: "position, force" })).toBe(true);
    expect(isPushedWith({ ...ARM, can: "position, stops" })).toBe(false);
  });
});

describe("DeviceView", () => {
  const axes = (deg: number): { right: Vec3; up: Vec3 } => {
    const [c, s] = [Math.cos((deg * Math.PI) / 180), Math.sin((deg * Math.PI) / 180)];
    return { right: [c, s, 0], up: [-s, c, 0] };
  };
  it("tells a turn once, when the view rests", () => {
    const view = new DeviceView();
    expect(view.turned(axes(50), 0)).toBe(false);
    view.tell(axes(0));
    expect(view.turned(axes(0.5), 100)).toBe(false);
    expect(view.turned(axes(10), 200)).toBe(false);
    expect(view.turned(axes(20), 300)).toBe(false);
    expect(view.turned(axes(20), 500)).toBe(false);
    expect(view.turned(axes(20), 700)).toBe(true);
    expect(view.turned(axes(20), 1100)).toBe(false);
  });
});
