// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The keys of the scan's page, and what its help says of them. By where they are on the keyboard.
export interface KeyLine {
  /** As KeyboardEvent.code, in braces for the person's own layout. */
  readonly keys: string;
  readonly text: string;
}

export const SCAN_HELP: readonly { readonly title: string; readonly lines: readonly KeyLine[] }[] =
  [
    {
      title: "Look",
      lines: [
        { keys: "Click, drag", text: "crosshair" },
        { keys: "Wheel", text: "slice by slice" },
        { keys: "Ctrl + wheel", text: "zoom" },
        { keys: "Middle drag, Alt + drag", text: "shift the picture" },
        { keys: "Right drag", text: "own window: across its width, up and down its centre" },
      ],
    },
    {
      title: "Keys, in the picture that has the focus",
      lines: [
        { keys: "Arrows", text: "crosshair by 0.3 mm, with Shift by 3 mm" },
        { keys: "Page up / down", text: "slice by slice, with Shift ten" },
        { keys: "+ −", text: "zoom" },
        { keys: "Ctrl + arrows", text: "shift the picture" },
        { keys: "{Digit0}", text: "all of it in the pictures" },
        { keys: "{Digit1} {Digit2} {Digit3}", text: "bone, soft tissue, all densities" },
        { keys: "{BracketLeft} {BracketRight}", text: "labels fainter, stronger" },
        { keys: "{KeyO}", text: "labels on and off" },
        { keys: "{KeyX}", text: "crosshair on and off" },
        { keys: "{KeyB}, Shift + {KeyB}", text: "next bone, previous" },
        { keys: "{KeyM}, {KeyN}", text: "measure a distance (2 places), an angle (3)" },
        { keys: "{KeyR}", text: "HU in a circle: drag from its middle to its rim" },
        { keys: "Enter", text: "a place of the measure, at the crosshair" },
        { keys: "Backspace", text: "the last measure away" },
        { keys: "{KeyP}", text: "planes along the wrist, or as scanned" },
        { keys: "Esc", text: "put down what is in hand" },
        { keys: "?", text: "this help" },
      ],
    },
    {
      title: "Mend",
      lines: [
        {
          keys: "{KeyA}, {KeyE}",
          text: "paint the bone in hand, erase it; drag, or Enter at the crosshair",
        },
        {
          keys: "{KeyW}",
          text: "marker: mark roughly what belongs to it, and its border is found in the CT",
        },
        { keys: "{KeyV}", text: "move the last stroke: drag, or Enter lays it at the crosshair" },
        { keys: "{Comma} {Period}", text: "brush smaller, larger" },
        { keys: "{KeyZ}, {KeyY}", text: "undo, redo" },
        { keys: "{KeyF}", text: "fill the bone's hollows" },
        {
          keys: "{KeyK}",
          text: "split it, or cut something off, by a line: drag, or Enter at both ends",
        },
        { keys: "{KeyG}", text: "run again with these labels, as a new version of the case" },
        { keys: "{KeyS}", text: "save the labels as a file" },
      ],
    },
    {
      title: "Touch",
      lines: [
        { keys: "One finger", text: "crosshair" },
        { keys: "Two fingers", text: "zoom and shift" },
        { keys: "Slider under a picture", text: "slice by slice" },
      ],
    },
  ];
