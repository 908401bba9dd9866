// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A field for a trainee's name that says what is wrong with one, and begins with the last.
import { make, remember, remembered } from "../dom";
import { nameProblem } from "./name_model";

const NAME_KEY = "carpus.trainee";
const MAX_NAME = 64;

export function rememberedName(): string {
  return remembered(NAME_KEY);
}

export function rememberName(name: string): void {
  remember(NAME_KEY, name);
}

export function nameField(id: string): HTMLInputElement {
  const field = make("input", {
    type: "text",
    id,
    maxlength: String(MAX_NAME),
    autocomplete: "off",
    spellcheck: "false",
    value: rememberedName(),
  });
  const judge = (): void => {
    field.setCustomValidity(nameProblem(field.value.trim()) ?? "");
  };
  field.addEventListener("input", judge);
  judge();
  return field;
}
