// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A gamepad that is not there, for whoever tests what one does.

/** A gamepad of the standard mapping that the test holds. */
export const PAD = () => {
  const pad = {
    connected: true,
    mapping: "standard",
    axes: [0, 0, 0, 0],
    buttons: Array.from({ length: 17 }, () => ({ value: 0, pressed: false })),
  };
  window.pressPad = (button, value) => {
    pad.buttons[button] = { value, pressed: value > 0.5 };
  };
  window.tiltPad = (...axes) => {
    pad.axes = axes;
  };
  window.plugPad = (on) => {
    pad.connected = on;
  };
  navigator.getGamepads = () => [pad];
};
