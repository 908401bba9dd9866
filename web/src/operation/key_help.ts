// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the help and the steps say of the keys (key_map.ts), each named as {KeyA}.

export interface HelpLine {
  readonly keys: string;
  readonly text: string;
}
export interface HelpGroup {
  readonly title: string;
  readonly lines: readonly HelpLine[];
}

/** What the help overlay shows. */
export const HELP: readonly HelpGroup[] = [
  {
    title: "Hands",
    lines: [
      { keys: "Left drag", text: "tip follows the pointer over the bone" },
      { keys: "Shift + left drag", text: "turn the shaft about its tip" },
      { keys: "Arrows", text: "tip by 0.1 mm; hold to go on, faster and faster" },
      { keys: "Shift + arrows", text: "shaft by 0.5°; hold to go on, faster and faster" },
      { keys: "{KeyY}", text: "coarse steps, 1 mm and 5°, or fine again" },
      {
        keys: "Enter",
        text: "aim as you look: tip onto the bone in the middle, shaft along your sight",
      },
      { keys: "{KeyA} / {KeyD}", text: "advance to the bone / draw back, 0.1 mm" },
      { keys: "{KeyH}", text: "move the other hand; this one stays where it is" },
    ],
  },
  {
    title: "Drive",
    lines: [
      { keys: "Space", text: "hold: drive forward" },
      { keys: "{KeyR}", text: "hold: reverse" },
      { keys: "{BracketLeft} / {BracketRight}, 9 / 0", text: "push less / more, 5 N" },
    ],
  },
  {
    title: "Instruments",
    lines: [
      { keys: "{KeyC}", text: "tray: arrows and Enter take" },
      { keys: "{KeyQ}", text: "put down what the hand holds" },
      { keys: "{KeyG}", text: "take hold of what lies in bone" },
      { keys: "Shift + {KeyG}", text: "take the wire at its other end, beyond the bone" },
      { keys: "{KeyM}", text: "other hand: gauge over the wire, read, put down" },
      { keys: "Page up / down", text: "next shorter / longer screw" },
    ],
  },
  {
    title: "Wrist",
    lines: [
      { keys: "{KeyJ} / {KeyU}", text: "flex / extend, 1°; hold to go on" },
      { keys: "{KeyK} / {KeyO}", text: "bend to the thumb / to the little finger" },
      { keys: "{KeyN} / {KeyB}", text: "pronate / supinate" },
      { keys: "{KeyW} / {KeyS}", text: "pull more / less at the fingers" },
    ],
  },
  {
    title: "C-arm",
    lines: [
      { keys: "1 … 6", text: "picture of the view on that button" },
      { keys: "{Comma} / {Period}", text: "turn the C-arm by 5°; with Shift: tilt" },
      { keys: "{KeyX}", text: "picture from where the C-arm stands" },
      { keys: "{KeyE}", text: "hold: live pictures, 10 a second" },
      { keys: "7", text: "enlarge: pictures and theatre change places" },
      { keys: "8", text: "keep the picture as reference, on the second monitor" },
      { keys: "{KeyI}", text: "invert black and white" },
      { keys: "{Quote}", text: "ruler: two clicks, or arrows and Enter: mm at the isocentre" },
      { keys: "{Semicolon}", text: "draw the beam in the theatre" },
      { keys: "{Backslash}", text: "save the picture" },
      { keys: "F9 / F10", text: "the tube's voltage / dose: next" },
    ],
  },
  {
    title: "On closed skin",
    lines: [
      { keys: "Drag, arrows", text: "lead finger, marker or blade over the skin" },
      {
        keys: "{KeyA} / {KeyD}",
        text: "press, prick, go in / draw back: what is in deep goes by these alone",
      },
      { keys: "Shift + arrows", text: "the needle's direction, before it is in" },
      { keys: "Space", text: "hold: open the clamp" },
      { keys: "{KeyC}", text: "finger, marker, needle, blade, clamp, sheath" },
    ],
  },
  {
    title: "At a scope",
    lines: [
      { keys: "{KeyA} / {KeyD}, wheel", text: "go in / draw back" },
      { keys: "Arrows, drag", text: "lean what is held about its hole" },
      {
        keys: "{Comma} / {Period}",
        text: "turn the shaft, or the mouth of a shaver; with Shift: the camera head",
      },
      {
        keys: "{KeyG}",
        text: "close the jaws, or open them: a punch bites as they close; hold: a shaver's pedal",
      },
      {
        keys: "{BracketLeft} / {BracketRight}, Shift + wheel",
        text: "focus the camera head nearer / farther",
      },
      { keys: "{KeyV}", text: "the next portal" },
      { keys: "7 / 8 / 9", text: "panorama / level, both in practice alone / findings" },
      {
        keys: "{KeyH}, 7",
        text: "where a second portal is made: the other hand works on the skin while the scope looks on / which of them is large",
      },
    ],
  },
  {
    title: "Fluid, at a scope",
    lines: [
      { keys: "Page up / down", text: "pressure of the inflow by 5 mmHg, more / less" },
      { keys: "End", text: "open or close the outflow" },
      { keys: "Home", text: "flush for some seconds; dry: rinse the lens" },
      { keys: "0", text: "without fluid, or with it again" },
    ],
  },
  {
    title: "Aids, in practice",
    lines: [
      { keys: "F2", text: "ghost: the planned line and screw" },
      { keys: "F4", text: "cut the bones along that line, then across the sight" },
      { keys: "F8", text: "hint: what to change, in words; all are counted" },
    ],
  },
  {
    title: "Look",
    lines: [
      { keys: "Right drag, Ctrl + arrows", text: "turn the view" },
      { keys: "Wheel, {Equal} / {Minus}", text: "nearer / farther" },
      { keys: "Middle drag", text: "shift the view" },
      { keys: "{KeyV}", text: "next view: four sides, along the shaft" },
      { keys: "{KeyT} / {KeyL}", text: "skin / names" },
      { keys: "F7", text: "tendons, arteries, nerves: generated, not seen in the CT" },
    ],
  },
  {
    title: "Exercise",
    lines: [
      { keys: "{KeyZ}", text: "undo: back to the last checkpoint" },
      { keys: "{KeyF}", text: "finish (asks first)" },
      { keys: "Home / End", text: "say: the fracture is aligned / displaced" },
      { keys: "Del", text: "decline to operate (asks for the reasons)" },
      { keys: "{KeyP}", text: "pause" },
      { keys: "{Backquote}", text: "sound on or off" },
      { keys: "?, F1", text: "this help" },
      { keys: "Esc", text: "close what is open; theatre large again" },
    ],
  },
];

/** What the help says of a gamepad. */
export const GAMEPAD_HELP: HelpGroup = {
  title: "Gamepad",
  lines: [
    { keys: "Left stick", text: "move the tip; fine near the middle" },
    { keys: "Right stick", text: "turn the shaft" },
    { keys: "Right trigger", text: "drive: as deep as it is pressed, up to the push that is set" },
    { keys: "Left trigger", text: "reverse" },
    { keys: "LB / RB", text: "back / nearer" },
    { keys: "A / Y / X", text: "picture / of the next view / hold: live" },
    { keys: "B", text: "aim as you look" },
    { keys: "Cross", text: "turn the view; right stick pressed: next view" },
    { keys: "Left stick pressed", text: "the other hand" },
    { keys: "Back / Start", text: "undo / pause" },
    { keys: "Back held, sticks", text: "left: down flexes, sideways deviates; right: pronates" },
    { keys: "Back held, A / X", text: "measure / open the tray" },
    { keys: "Back held, B / Y", text: "put down / take hold; LB: at the other end" },
    { keys: "Back held, cross", text: "left: aligned, right: displaced" },
    { keys: "Back held, Start", text: "finish (asks first)" },
    { keys: "In a dialog", text: "cross: go through it, A: choose, B: close" },
    {
      keys: "At a scope, sticks",
      text: "lead the hand that mouse and keys do not: left leans, right turns scope and camera head, or a shaver",
    },
    { keys: "At a scope, LB / RB", text: "draw back / go in" },
    {
      keys: "At a scope, triggers",
      text: "right: close the jaws, or hold: a shaver's pedal; left: open the jaws",
    },
    {
      keys: "At a scope, B / cross",
      text: "the next portal / up, down: pull more, less at the fingers; left, right: focus nearer, farther",
    },
    { keys: "At a scope, left stick pressed", text: "exchange the hands" },
  ],
};

/** And of fingers. */
export const TOUCH_HELP: HelpGroup = {
  title: "Touch",
  lines: [
    {
      keys: "One finger",
      text: "pushes the tip along, or turns the shaft: chosen under the theatre",
    },
    { keys: "Two fingers", text: "turn the view and bring it nearer" },
    { keys: "View chosen", text: "one finger turns it, two shift it" },
    { keys: "Drive, Reverse", text: "for as long as they are held" },
    {
      keys: "At a scope",
      text: "one finger leans the hand that is led; a second, on the other half of the picture, the other hand",
    },
    { keys: "Two on one half", text: "spread: go in; pinch: draw back" },
  ],
};

/** Keys of what a step's `actions` name: of the protocol's action_id, or what the page does itself. */
const KEYS_OF: Readonly<Record<string, string>> = {
  move_tip: "Left drag, arrows",
  turn_shaft: "Shift + drag, Shift + arrows, Enter",
  approach: "{KeyA} / {KeyD}",
  drive: "Hold Space",
  reverse: "{KeyR} reverses",
  judge: "Home aligned, End displaced",
  move_wrist: "{KeyJ} {KeyU}, {KeyK} {KeyO}, {KeyN} {KeyB}, {KeyW} {KeyS}",
  switch_hand: "{KeyH}",
  shot: "1 … 6, {KeyX}, hold {KeyE}",
  take_shot: "1 … 6, {KeyX}, hold {KeyE}",
  take: "{KeyC}",
  pick_up: "{KeyG}",
  pick_up_far_end: "Shift + {KeyG}",
  put_down: "{KeyQ}",
  read_gauge: "{KeyM}",
  undo: "{KeyZ}",
  finish: "{KeyF}",
  decline: "Del",
};

/** Of those that are led otherwise at a scope; empty: another key does it. */
const KEYS_AT_SCOPE: Readonly<Record<string, string>> = {
  move_tip: "Arrows, drag, {KeyA} / {KeyD}",
  turn_shaft: "{Comma} {Period}, Shift + drag",
  move_wrist: "{KeyW} {KeyS}",
  drive: "{KeyG}",
  take: "",
  answer: "9",
};

/** Each action's keys; one that the page has no key for is passed over. */
export function keysOf(actions: readonly string[], atScope = false): readonly string[] {
  const keys = atScope ? { ...KEYS_OF, ...KEYS_AT_SCOPE } : KEYS_OF;
  return [...new Set(actions.flatMap((action) => keys[action] || []))];
}
