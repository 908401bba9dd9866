// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is printed on a key. Keys act by where they are (KeyboardEvent.code), so that each can be reached
// on every layout; text names them as {KeyA} and shows what the person's own keyboard has there.

/** What keys show, by code; where it says nothing, they show what an English keyboard has. */
export type KeyLabels = ReadonlyMap<string, string>;

const ENGLISH: Readonly<Record<string, string>> = {
  Backquote: "`",
  Minus: "-",
  Equal: "=",
  BracketLeft: "[",
  BracketRight: "]",
  Backslash: "\\",
  Semicolon: ";",
  Quote: "'",
  Comma: ",",
  Period: ".",
  Slash: "/",
};

const CODE = /\{([A-Z][A-Za-z0-9]*)\}/g;

/** "Ü" for "ü"; what grows in capitals, as "ß" does, stays. */
function onTheCap(character: string): string {
  const capital = character.toLocaleUpperCase();
  return capital.length === character.length ? capital : character;
}

/** A digit is printed on its key even where it needs Shift. */
export function labelOf(code: string, labels: KeyLabels): string {
  const digit = /^(?:Digit|Numpad)(\d)$/.exec(code)?.[1];
  if (digit !== undefined) return digit;
  return labels.get(code) ?? ENGLISH[code] ?? /^Key([A-Z])$/.exec(code)?.[1] ?? code;
}

/** The text with what the keys show in place of their codes. */
export function labelled(text: string, labels: KeyLabels): string {
  return text.replace(CODE, (_, code: string) => labelOf(code, labels));
}

/** @param layout  code and character, as the browser tells them */
export function labelsOf(layout: Iterable<readonly [string, string]>): KeyLabels {
  return new Map([...layout].map(([code, character]) => [code, onTheCap(character)]));
}

export interface TypedKey {
  readonly code: string;
  readonly key: string;
  /** Any of Shift, Ctrl, Alt, AltGr, Meta: then the character is not what is printed first. */
  readonly modified: boolean;
}

/**
 * A browser that tells no layout shows it by each key that is typed.
 * @return the same labels where the key tells nothing new
 */
export function learnt(labels: KeyLabels, { code, key, modified }: TypedKey): KeyLabels {
  const isOne = [...key].length === 1 && key.trim() !== "";
  if (modified || !isOne || !(code in ENGLISH || /^Key[A-Z]$/.test(code))) return labels;
  const label = onTheCap(key);
  return labelOf(code, labels) === label ? labels : new Map([...labels, [code, label]]);
}
